//! Devices that fail: what is made is made under guard, and a lost device is replaced.

use open_water_shaders::pipeline::{Refusal, guarded, is_alive};

use super::Gpu;
use crate::OpenWaterError;
use crate::grids::Sim;
use crate::store::GridId;
use crate::water::OpenWater;

/// What a device took with it. Sea, bodies, CPU-homed grids and land are the CPU's: nothing of them is lost.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct DeviceLoss {
    /// The GPU-homed grids: they begin anew, calm, where they were.
    pub calmed: Vec<GridId>,
    /// Whether there was foam of the ambient sea: it comes back within seconds.
    pub foam: bool,
}

/// Runs what makes resources; what the device says against it comes back as a value.
pub(super) fn guard<T>(
    device: &wgpu::Device,
    what: &'static str,
    make: impl FnOnce() -> Result<T, OpenWaterError>,
) -> Result<T, OpenWaterError> {
    match guarded(device, make) {
        Err(Refusal::OutOfMemory) => Err(OpenWaterError::OutOfMemory { what }),
        // A lost device makes nothing and says nothing of it.
        _ if !is_alive(device) => Err(OpenWaterError::DeviceLost),
        Ok(made) => made,
        Err(Refusal::Refused(reason)) => Err(OpenWaterError::Device { what, reason }),
    }
}

impl Gpu {
    /// As [`guard`]; notes a lost device.
    pub(super) fn guard<T>(
        &mut self,
        what: &'static str,
        make: impl FnOnce(&mut Self) -> Result<T, OpenWaterError>,
    ) -> Result<T, OpenWaterError> {
        let device = self.device.clone();
        let made = guard(&device, what, || make(self));
        self.lost |= matches!(made, Err(OpenWaterError::DeviceLost));
        made
    }
}

/// What needs no device does without.
pub(super) fn or_without(made: Result<(), OpenWaterError>) -> Result<(), OpenWaterError> {
    match made {
        Err(OpenWaterError::DeviceLost) => Ok(()),
        made => made,
    }
}

impl OpenWater {
    /// Whether the device was found lost. Ticks go on, on the CPU; plans say [`Reason::DeviceLost`](crate::Reason::DeviceLost) and
    /// `encode` records nothing, until there is another: see [`Self::replace_device`].
    pub fn is_device_lost(&self) -> bool {
        self.gpu.as_ref().is_some_and(|gpu| gpu.lost)
    }

    /// Tells that the device is lost, as a callback of `wgpu::Device::set_device_lost_callback` was told. Without a word
    /// the next `encode` finds out. GPU-homed grids are calm from the next tick on.
    pub fn lose_device(&mut self) {
        if let Some(gpu) = &mut self.gpu {
            gpu.lost = true;
        }
    }

    /// Goes on with another device: in place of one that was lost, one that is still there (another adapter), or none (a
    /// water made by [`Self::headless`]). What is drawn is made anew from the CPU's state; what was on the old device alone
    /// is in the answer. Layout and bind group of the surface are others afterwards: the host's pipelines that read it are
    /// to be made again.
    ///
    /// # Errors
    /// As [`Self::new`]; then nothing was changed.
    pub fn replace_device(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<DeviceLoss, OpenWaterError> {
        let mut gpu = Gpu::new(device, queue, self.ocean.as_ref())?;
        let mut loss = DeviceLoss::default();
        let mut remotes = Vec::new();
        gpu.remote.set_medium(self.shore.medium());
        gpu.remote.set_origin(self.shore.origin);
        for grid in self.grids.iter() {
            let Sim::Gpu(old) = &grid.sim else { continue };
            let mut remote = gpu.add_grid(grid.desc.wave_grid(self.clock.dt()))?;
            gpu.remote.place(&mut remote, old);
            remotes.push(remote);
            loss.calmed.push(grid.id);
        }
        if let Some(old) = &self.gpu {
            gpu.inherit(old);
            loss.foam = self.ocean.is_some();
        }
        gpu.resize_pool(self.grids.pool_cells())?;
        let terrain = self.shore.terrain.as_ref();
        gpu.set_land(terrain.map(|terrain| self.shore.baked.texels(terrain.bed())).as_ref())?;
        gpu.set_dry(self.dry.rasters())?;
        let mut remotes = remotes.into_iter();
        for grid in self.grids.iter_mut() {
            if let Sim::Gpu(old) = &mut grid.sim
                && let Some(new) = remotes.next()
            {
                **old = new;
                old.set_origin(self.shore.origin);
            }
        }
        self.gpu = Some(gpu);
        Ok(loss)
    }
}
