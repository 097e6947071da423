//! What can be wrong with the description of a grid.

/// A description that cannot be simulated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// A field is outside its range.
    #[error("{field} = {value}: must be {bound}")]
    InvalidValue {
        /// Name of the field.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// The explicit scheme would blow up: `a = (c dt / h)^2` is above its bound.
    #[error(
        "unstable: wave speed c = {c} m/s, cell size h = {h} m, sub-step dt = {dt} s give (c dt/h)^2 = {a}, above {bound}; \
         use larger cells, a lower speed or more sub-steps"
    )]
    Unstable {
        /// Sub-step, seconds.
        dt: f64,
        /// The lesser cell size, metres.
        h: f64,
        /// Wave speed, m/s.
        c: f64,
        /// `(c dt / h)^2`, of oblong cells that of square ones as close to the bound.
        a: f64,
        /// Largest stable value of `a` for the scheme.
        bound: f64,
    },
}
