//! Rigid bodies floating on a water surface: hulls, forces, integration.
