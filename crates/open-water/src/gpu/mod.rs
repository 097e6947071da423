//! The GPU side: what is drawn, and the bind group that others read.
//!
//! Everything that runs on the GPU is decided by [`FramePlan`](crate::FramePlan) and recorded by `encode.rs`.

mod carry;
mod copies;
mod dry;
mod encode;
mod fault;
pub(crate) mod grids;
mod host;
pub(crate) mod hulls;
mod judge;
pub(crate) mod land;
mod limits;
mod mirror;
mod sea;
mod surface;
mod timer;
mod uploads;

use floating_body::DryHull;
use ocean_spectrum::Ocean;
use ocean_spectrum::gpu::GpuOcean;
use open_water_shaders::pipeline::Staging;

use crate::OpenWaterError;
use crate::bodies::Bodies;
use crate::dry::DryHulls;
use crate::grids::{Grid, Grids, Sim};
use crate::plan::FramePlan;
use crate::planner::Shown;
use crate::store::BodyId;
pub use encode::Encoded;
pub use fault::DeviceLoss;
use surface::SurfaceBinding;
pub use timer::GpuTimes;
use timer::Timer;
use uploads::Uploads;

pub(crate) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    ocean: Option<GpuOcean>,
    next: sea::Next,
    surface: SurfaceBinding,
    pub(crate) remote: grids::RemoteGrids,
    /// Not there while a frame writes.
    staging: Option<Staging>,
    /// What the last frame encoded, unless uploads were lost since; and how often they had been.
    shown: Shown,
    losses: u64,
    /// What the last frame recorded.
    pub(crate) encoded: Encoded,
    /// The device is lost, or has failed: nothing is made or recorded any more.
    pub(crate) lost: bool,
    /// Cells that the pool has room for, and that it never has less.
    pool: [u32; 2],
    /// Elements of it behind them, for the rasters of dry hulls.
    dry: u32,
    /// Time of the last looks, seconds: foam fades by the difference.
    looks_time: f64,
    uploads: Uploads,
    timer: Option<Timer>,
}

impl Gpu {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        ocean: Option<&Ocean>,
    ) -> Result<Self, OpenWaterError> {
        limits::check(&device.limits())?;
        fault::guard(device, "the sea", || {
            let gpu_ocean = ocean.map(|ocean| GpuOcean::new(device, ocean)).transpose()?;
            let surface = SurfaceBinding::new(device, gpu_ocean.as_ref());
            Ok(Self {
                device: device.clone(),
                queue: queue.clone(),
                ocean: gpu_ocean,
                next: sea::Next::default(),
                surface,
                remote: grids::RemoteGrids::new(device),
                staging: Some(Staging::new(device)),
                shown: Shown::default(),
                losses: 0,
                encoded: Encoded::default(),
                lost: false,
                pool: [0; 2],
                dry: 0,
                looks_time: 0.0,
                uploads: Uploads::default(),
                timer: Timer::new(device, queue),
            })
        })
    }

    /// The grids have other places in the pool; it grows, and shrinks when most of it is empty.
    ///
    /// # Errors
    /// There is no room for them; then it is as it was.
    pub(crate) fn resize_pool(&mut self, cells: u32) -> Result<(), OpenWaterError> {
        if self.lost {
            return Ok(());
        }
        let [room, least] = self.pool;
        if cells > room || cells.max(least) < room / 4 {
            return self.make_pool(cells.max(least), self.dry);
        }
        self.forget_pool();
        Ok(())
    }

    /// What was drawn of grids is not where it was.
    fn forget_pool(&mut self) {
        self.shown.grids = None;
        self.uploads.forget();
    }

    /// A pool for so many cells of grids, then so many elements of the rasters of dry hulls.
    fn make_pool(&mut self, cells: u32, dry: u32) -> Result<(), OpenWaterError> {
        self.check_pool(u64::from(cells) + u64::from(dry))?;
        let made = self.guard("the drawn heights of the grids", |gpu| {
            Ok(gpu.surface.make_pool(&gpu.device, gpu.ocean.as_ref(), cells + dry))
        });
        match made {
            Ok(made) => self.surface.set_pool(made),
            error => return fault::or_without(error.map(|_| ())),
        }
        (self.pool[0], self.dry) = (cells, dry);
        self.forget_pool();
        Ok(())
    }

    /// Refuses more cells than a device can bind.
    pub(crate) fn check_pool(&self, cells: u64) -> Result<(), OpenWaterError> {
        let limits = self.device.limits();
        let found = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let needed = cells * size_of::<[f32; 2]>() as u64;
        if needed > found {
            let limit = "max_storage_buffer_binding_size";
            return Err(OpenWaterError::DeviceLimit { limit, found, needed });
        }
        Ok(())
    }

    /// The water has become another one: nothing that the device holds is known to be right.
    ///
    /// # Errors
    /// There is no room for it.
    pub(crate) fn restore(&mut self, ocean: Option<&Ocean>, cells: u32) -> Result<(), OpenWaterError> {
        self.shown = Shown::default();
        if !self.lost && self.ocean.is_some() != ocean.is_some() {
            let made = self.guard("the sea", |gpu| {
                let made = ocean.map(|ocean| GpuOcean::new(&gpu.device, ocean)).transpose()?;
                gpu.surface.bind(&gpu.device, made.as_ref());
                Ok(made)
            });
            match made {
                Ok(made) => (self.ocean, self.next) = (made, sea::Next::default()),
                error => return fault::or_without(error.map(|_| ())),
            }
        }
        self.resize_pool(cells)
    }

    /// Takes over what does not depend on the device.
    fn inherit(&mut self, old: &Self) {
        self.pool[1] = old.pool[1];
        self.looks_time = old.looks_time;
    }

    /// Keeps room for grids that come and go while the water runs.
    pub(crate) fn reserve_pool(&mut self, cells: u32) {
        self.pool[1] = cells;
    }

    /// Makes room for land of that size.
    ///
    /// # Errors
    /// The device has no room for it; nothing has changed then.
    pub(crate) fn room_for_land(&mut self, size: Option<[u32; 2]>) -> Result<(), OpenWaterError> {
        match size {
            Some(size) if !self.lost => {
                let made = self.guard("the land's rasters", |gpu| gpu.surface.room_for_land(&gpu.device, size));
                if made.is_err() {
                    self.surface.let_room_go();
                }
                fault::or_without(made)
            }
            _ => Ok(()),
        }
    }

    /// Runs tick number `tick` of the grids that are homed here, and notes where the others have waves; on a lost device
    /// these are calm.
    pub(crate) fn tick_grids(&mut self, grids: &mut Grids, tick: u64) {
        if !self.lost {
            for grid in grids.iter() {
                if let Sim::Cpu(waves) = &grid.sim {
                    self.uploads.note(grid.id, waves);
                }
            }
            return self.remote.tick(grids, tick);
        }
        for grid in grids.iter_mut() {
            if let Sim::Gpu(grid) = &mut grid.sim {
                grid.end();
            }
        }
    }

    /// Replaces the land that the composite surface reads.
    ///
    /// # Errors
    /// The device has no room for it.
    pub(crate) fn set_land(&mut self, texels: Option<&land::LandTexels>) -> Result<(), OpenWaterError> {
        if self.lost {
            return Ok(());
        }
        let set = self.guard("the land's rasters", |gpu| {
            gpu.surface.set_land(&gpu.device, &gpu.queue, gpu.ocean.as_ref(), texels)
        });
        fault::or_without(set)
    }

    /// Adds a grid.
    pub(crate) fn add_grid(&mut self, desc: wave_grid::GridDesc) -> Result<grids::RemoteGrid, OpenWaterError> {
        if self.lost {
            return Err(OpenWaterError::DeviceLost);
        }
        let mut id = None;
        let added = self.guard("a grid homed on the GPU", |gpu| {
            let added = gpu.remote.add(desc)?;
            id = Some(added.id);
            gpu.remote.prepare();
            Ok(added)
        });
        if let (Err(_), Some(id)) = (&added, id) {
            self.remote.take_back(id);
        }
        added
    }

    /// Replaces the rasters of the hulls that are kept dry.
    ///
    /// # Errors
    /// There is no room for them; then it is as it was.
    pub(crate) fn set_dry(&mut self, rasters: &[DryHull]) -> Result<(), OpenWaterError> {
        if self.lost {
            return Ok(());
        }
        let needed = dry::elements(rasters);
        if needed > self.dry {
            self.make_pool(self.pool[0], needed.next_power_of_two())?;
        }
        self.surface.dry.set(rasters);
        Ok(())
    }

    /// Says which hulls the next table has.
    pub(crate) fn place_dry(&mut self, plan: &FramePlan, dry: &DryHulls, bodies: &Bodies) {
        let place = |body: &BodyId| Some((dry.get(*body)?.raster, bodies.drawn(*body, plan.alpha)?));
        self.surface.dry.place(plan.dry.bodies.iter().filter_map(place), self.pool[0]);
    }

    /// What the GPU holds: nothing that is known, once uploads were lost.
    pub(crate) fn shown(&self) -> Shown {
        let losses = self.staging.as_ref().map_or(0, Staging::losses);
        if losses == self.losses { self.shown.clone() } else { Shown::default() }
    }

    /// Bytes that the next upload of a CPU-homed grid takes.
    pub(crate) fn upload_bytes(&self, grid: &Grid) -> u64 {
        self.uploads.bytes(grid.id, grid.desc.cells)
    }

    pub(crate) fn surface(&self) -> &SurfaceBinding {
        &self.surface
    }
}
