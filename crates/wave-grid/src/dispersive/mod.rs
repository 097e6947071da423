//! The dispersion of water waves by local fields; see [`crate::Scheme::Dispersive`].

mod fitted;
// Until the scheme uses all of it.
#[allow(dead_code)]
pub(crate) mod table;

pub(crate) use table::MOST_G;
