//! The grid's passes on the CPU, the twins of the WGSL passes of the same names.

pub(crate) mod band;
pub(crate) mod boost;
pub(crate) mod current;
pub(crate) mod dispersive;
pub(crate) mod draw;
pub(crate) mod foam;
pub(crate) mod ghosts;
pub(crate) mod kernels;
pub(crate) mod lanes;
#[cfg(test)]
mod levels;
pub(crate) mod mixed;
pub(crate) mod moving;
pub(crate) mod plain;
pub(crate) mod sample;
pub(crate) mod shift;
pub(crate) mod step;
pub(crate) mod tiles;
