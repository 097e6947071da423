//! One sub-step of the dispersive scheme on the CPU: open water, the border layer and varying media with their own inner
//! loops, every row in one pass. The layer's psi is made before, as neighbours read it.

pub(crate) mod band;
pub(crate) mod general;
pub(crate) mod plain;
pub(crate) mod psi;
pub(crate) mod sponge;
pub(crate) mod step;
