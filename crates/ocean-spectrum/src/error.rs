//! What can be wrong with a description of a sea.

/// A description that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OceanError {
    /// A field has a value outside its bound.
    #[error("{field} is {value}; allowed: {bound}")]
    InvalidValue {
        /// Name of the field.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// A sea file does not say what it should.
    #[error("{file}, line {line}: found {found}; allowed: {allowed}")]
    File {
        /// Name of the file.
        file: String,
        /// Line, from 1; one past the last line when something is missing at the end.
        line: usize,
        /// What was found there.
        found: String,
        /// What is allowed there.
        allowed: String,
    },
    /// A sea file cannot be read.
    #[error("{file}: {reason}")]
    Unreadable {
        /// Name of the file.
        file: String,
        /// Why.
        reason: String,
    },
}

/// `Ok` when `value` is finite and `ok` holds.
pub(crate) fn check(field: &'static str, value: f64, ok: bool, bound: &'static str) -> Result<(), OceanError> {
    if value.is_finite() && ok { Ok(()) } else { Err(OceanError::InvalidValue { field, value, bound }) }
}

/// Something that was understood but changed or left out; nothing failed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Notice {
    /// The fetch exceeds what the wind can use, so the sea is fully grown at the shorter one.
    FetchClamped {
        /// Fetch of the description, metres.
        given: f64,
        /// Fetch used, metres.
        used: f64,
    },
    /// The cascades hold less than 99 % of the variance of the sea state: waves longer than the largest tile, between
    /// two bands, or shorter than the finest texel are missing.
    VarianceLost {
        /// Share of the variance that is missing, 0 to 1.
        share: f64,
    },
}

impl std::fmt::Display for Notice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::FetchClamped { given, used } => {
                write!(f, "fetch of {given:.0} m shortened to {used:.0} m, where this wind's sea is fully grown")
            }
            Self::VarianceLost { share } => {
                write!(f, "the cascades do not hold {:.1} % of the sea's variance", 100.0 * share)
            }
        }
    }
}
