//! What can be wrong with a description or a call.

use crate::{BodyId, FleetId, GridId, MooringId};

/// Why the water refused a description or a call. Nothing is lost: the water stays as it was.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OpenWaterError {
    /// A value is outside its range.
    #[error("{field} is {value}, but must be {bound}")]
    InvalidValue {
        /// The field of the description.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// A value of a map is outside its range.
    #[error("{map}: {field} is {value}, but must be {bound}")]
    Map {
        /// The file, or which map it is.
        map: String,
        /// What of it.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// A pixel of a map is outside its range.
    #[error("{map}: {field} at pixel ({}, {}) is {value}, but must be {bound}", pixel[0], pixel[1])]
    MapPixel {
        /// The file, or which map it is.
        map: String,
        /// What of it.
        field: &'static str,
        /// Column and row.
        pixel: [u32; 2],
        /// What was given.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// A map's file cannot be used.
    #[error("{map}: {reason}")]
    MapFile {
        /// The file.
        map: String,
        /// Why.
        reason: String,
    },
    /// A grid with `feed` that cannot be fed.
    #[error("a grid can be fed only {0}")]
    Feed(&'static str),
    /// A grid whose scheme needs something else.
    #[error("a grid with `Scheme::{scheme:?}` needs {needs}")]
    Scheme {
        /// The scheme.
        scheme: wave_grid::Scheme,
        /// What it needs.
        needs: &'static str,
    },
    /// A grid that cannot lie in the one it names.
    #[error("a grid can lie only {0}")]
    Within(&'static str),
    /// A change of the sea where there is none.
    #[error("calm water has no sea that could change: begin with a light wind")]
    CalmSea,
    /// The ambient sea was refused.
    #[error(transparent)]
    Ocean(#[from] ocean_spectrum::OceanError),
    /// An interactive grid was refused.
    #[error(transparent)]
    Grid(#[from] wave_grid::GridError),
    /// A body was refused.
    #[error(transparent)]
    Body(#[from] floating_body::BodyError),
    /// The handle's body was removed, or is another water's.
    #[error("body {0:?} does not exist: it was removed, or is another water's; forget its handle")]
    UnknownBody(BodyId),
    /// The handle's fleet was removed, or is another water's.
    #[error("fleet {0:?} does not exist: it was removed, or is another water's; forget its handle")]
    UnknownFleet(FleetId),
    /// The handle's grid was removed, or is another water's.
    #[error("grid {0:?} does not exist: it was removed, or is another water's; forget its handle")]
    UnknownGrid(GridId),
    /// The grid follows something else than a point that the game sets.
    #[error("grid {0:?} cannot be given a point to follow: it was not made with `Follow::Point`")]
    NotAPoint(GridId),
    /// The handle's mooring was removed, or its body was, or it is another water's.
    #[error("mooring {0:?} does not exist: it was removed, or is another water's; forget its handle")]
    UnknownMooring(MooringId),
    /// The snapshot was made on other land.
    #[error("the snapshot was made on other land: give this water the same by `OpenWater::set_land` before `restore`")]
    OtherLand,
    /// Ticks must be run in the order in which `advance` gave them.
    #[error("tick {found} was given, but tick {expected} is due: run the ticks of `advance` in order, each once")]
    TickOutOfOrder {
        /// The tick that is due.
        expected: u64,
        /// The tick that was given.
        found: u64,
    },
    /// A grid homed on the GPU needs a water that was made with a device.
    #[error(
        "a grid with `GridHome::Gpu` needs a device, and this water is headless: make it with `OpenWater::new`, give it one by \
         `OpenWater::replace_device`, or home the grid on the CPU: `GridHome::Cpu`"
    )]
    NoGpu,
    /// The device cannot do what the water needs.
    #[cfg(feature = "gpu")]
    #[error(
        "the device's limit {limit} is {found}, but the water needs {needed}: ask the adapter for \
         `OpenWater::required_limits()`, make seas, grids and maps smaller, or, if the adapter has no more, go on without it \
         by `OpenWater::headless`"
    )]
    DeviceLimit {
        /// Name of the limit in `wgpu::Limits`.
        limit: &'static str,
        /// What the device has.
        found: u64,
        /// What is needed.
        needed: u64,
    },
    /// The device has no memory left.
    #[cfg(feature = "gpu")]
    #[error(
        "the device has no memory for {what}: let go of other resources, take fewer or smaller cascades, grids or maps, or \
         a lower `Preset`"
    )]
    OutOfMemory {
        /// What it was for.
        what: &'static str,
    },
    /// The device, its driver or its shader compiler refused what should work everywhere.
    #[cfg(feature = "gpu")]
    #[error(
        "the device refused {what}: try another backend or driver, or go on without it by `OpenWater::headless`, and report \
         this: {reason}"
    )]
    Device {
        /// What it refused.
        what: &'static str,
        /// What it says, with the name of the shader if it is one.
        reason: String,
    },
    /// The device is lost or was destroyed.
    #[cfg(feature = "gpu")]
    #[error("the device is lost: ask the adapter for another and hand it to `OpenWater::replace_device`")]
    DeviceLost,
    /// The GPU side of the ambient sea was refused.
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    OceanGpu(#[from] ocean_spectrum::gpu::GpuError),
}
