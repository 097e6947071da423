//! CPU twins of the passes that this crate owns.

pub(crate) mod body_water;
pub(crate) mod surface;
