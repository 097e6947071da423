//! From modes to arrays.
use crate::{CascadeModes, OceanDesc};

pub(crate) struct Synthesis {
    out: [Vec<[f32; 4]>; 3],
}

impl Synthesis {
    pub(crate) fn all(modes: &[CascadeModes], _desc: &OceanDesc) -> Vec<Self> {
        modes
            .iter()
            .map(|m| Self {
                out: [0; 3].map(|_| vec![[0.0; 4]; m.amp.len()]),
            })
            .collect()
    }
    pub(crate) fn run(_all: &mut [Self], _modes: &[CascadeModes], _phase: u32) {}
    pub(crate) fn displacement(&self) -> &[[f32; 4]] {
        &self.out[0]
    }
    pub(crate) fn derivative(&self) -> &[[f32; 4]] {
        &self.out[1]
    }
    pub(crate) fn velocity(&self) -> &[[f32; 4]] {
        &self.out[2]
    }
}
