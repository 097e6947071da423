//! The dispersion of water waves by local fields; see [`crate::Scheme::Dispersive`].

/// Largest `g dt^2 / h` that the coefficients are fitted for.
pub(crate) const MOST_G: f64 = 0.006;
