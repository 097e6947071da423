//! CPU twins of the passes that this crate owns.

pub(crate) mod surface;
