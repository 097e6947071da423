//! Grids that are stepped on the GPU.

use glam::{DVec2, Vec2};
use wave_grid::{GridSample, Source, Window};

use crate::OpenWaterError;
use crate::plan::FramePlan;
use crate::water::OpenWater;

pub(crate) enum RemoteGrid {}

impl RemoteGrid {
    pub(crate) fn sample(&self, _points: &[Vec2], _out: &mut [GridSample]) {
        match *self {}
    }
    pub(crate) fn window(&self) -> Window {
        match *self {}
    }
    pub(crate) fn center_on(&mut self, _target: DVec2) {
        match *self {}
    }
    pub(crate) fn add(&mut self, _source: Source) {
        match *self {}
    }
    pub(crate) fn tick(&mut self) {
        match *self {}
    }
    pub(crate) fn is_awake(&self) -> bool {
        match *self {}
    }
}

pub(crate) struct RemoteGrids;

impl RemoteGrids {
    pub(crate) fn new(_device: &wgpu::Device) -> Self {
        Self
    }
    pub(crate) fn add(&mut self, _desc: wave_grid::GridDesc) -> Result<RemoteGrid, OpenWaterError> {
        Err(OpenWaterError::NoGpu)
    }
}

impl OpenWater {
    pub(crate) fn plan_remote(&self, _plan: &mut FramePlan, _nobody: bool) {}
}
