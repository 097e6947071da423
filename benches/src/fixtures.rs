//! Inputs that cases and criterion benches share.
