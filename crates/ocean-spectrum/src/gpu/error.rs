/// A sea that cannot be put on a device.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// A value outside its bound.
    #[error("{field} is {value}; allowed on this device: {bound} {limit}: take fewer or smaller cascades")]
    InvalidValue {
        /// What is out of bound.
        field: &'static str,
        /// What was given.
        value: f64,
        /// How it is bound.
        bound: &'static str,
        /// The bound.
        limit: f64,
    },
}

pub(super) fn at_most(field: &'static str, value: u64, limit: u64) -> Result<(), GpuError> {
    if value <= limit {
        return Ok(());
    }
    Err(GpuError::InvalidValue { field, value: value as f64, bound: "at most", limit: limit as f64 })
}

pub(super) fn equal(field: &'static str, value: u32, limit: u32) -> Result<(), GpuError> {
    if value == limit {
        return Ok(());
    }
    Err(GpuError::InvalidValue { field, value: value.into(), bound: "exactly", limit: limit.into() })
}
