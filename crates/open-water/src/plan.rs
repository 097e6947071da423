//! What a frame will run on the GPU, and what it will not and why: plain data, made before anything is encoded.
//!
//! It says *what*; `gpu/encode.rs` is the one place that turns it into passes.

use std::fmt;

use crate::GridId;
use crate::dry::DryPlan;
use crate::land::ShoreMark;

/// A piece of GPU work of a frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Work {
    /// The cascades' spectra at the drawn time, and their transforms.
    Ocean {
        /// Number of cascades, the longest first.
        cascades: u32,
    },
    /// Half-float mips and foam of the cascades, for looks.
    OceanLooks,
    /// A CPU-homed grid's drawn heights go to the pool, where there are waves or were any.
    GridUpload {
        /// The grid.
        grid: GridId,
        /// Size of the upload.
        bytes: u64,
    },
    /// All awake GPU-homed grids are stepped.
    GridSteps {
        /// Dispatches of the ticks since the last frame.
        dispatches: u32,
    },
    /// All awake GPU-homed grids' heights at alpha go to the pool.
    GridDraw {
        /// How many grids.
        grids: u32,
    },
    /// The table of the composite surface.
    Table,
}

/// Why something was left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// The sea has no waves.
    Calm,
    /// No view and no consumer reads it.
    NobodyLooks,
    /// The consumers given do not read it.
    NotAskedFor,
    /// The grid sleeps: its waves have died down.
    Asleep,
    /// The same moment was encoded before.
    Unchanged,
    /// The water was made without a device.
    Headless,
    /// The device is lost: see [`OpenWater::replace_device`](crate::OpenWater::replace_device).
    DeviceLost,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Calm => "the sea is calm",
            Self::NobodyLooks => "nobody looks",
            Self::NotAskedFor => "not asked for",
            Self::Asleep => "asleep",
            Self::Unchanged => "unchanged",
            Self::Headless => "headless",
            Self::DeviceLost => "the device is lost",
        })
    }
}

/// What was left out, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Skipped {
    /// The work that is not done.
    pub work: SkippedWork,
    /// Why.
    pub reason: Reason,
}

/// Work that can be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SkippedWork {
    /// The ambient sea on the GPU.
    Ocean,
    /// Mips and foam of the sea.
    OceanLooks,
    /// A grid's upload, steps or drawing.
    Grid(GridId),
}

/// The GPU work of one frame. `Display` prints it in a few lines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FramePlan {
    /// The drawn time, seconds since the start.
    pub time: f64,
    /// The last tick run.
    pub tick: u64,
    /// How far the drawn moment lies between the last two ticks.
    pub alpha: f32,
    /// What will run, in order.
    pub work: Vec<Work>,
    /// What will not.
    pub skipped: Vec<Skipped>,
    pub(crate) dispatches: u32,
    pub(crate) shore: ShoreMark,
    pub(crate) dry: DryPlan,
}

impl FramePlan {
    /// Number of compute dispatches that `encode` will record.
    pub fn dispatches(&self) -> u32 {
        self.dispatches
    }

    /// Bytes that `encode` will upload for grids.
    pub fn upload_bytes(&self) -> u64 {
        self.work.iter().map(|work| if let Work::GridUpload { bytes, .. } = work { *bytes } else { 0 }).sum()
    }
}

impl fmt::Display for FramePlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "t {:.3} s, {} dispatches, {} KiB up", self.time, self.dispatches, self.upload_bytes() / 1024)?;
        for work in &self.work {
            match work {
                Work::Ocean { cascades } => write!(f, "\n+ ocean, {cascades} cascades")?,
                Work::OceanLooks => write!(f, "\n+ mips and foam")?,
                Work::GridUpload { bytes, .. } => write!(f, "\n+ grid up, {} KiB", bytes / 1024)?,
                Work::GridSteps { dispatches } => write!(f, "\n+ grid steps, {dispatches} dispatches")?,
                Work::GridDraw { grids } => write!(f, "\n+ grids drawn, {grids}")?,
                Work::Table => {}
            }
        }
        match (self.dry.bodies.len(), self.dry.of) {
            (0, _) => {}
            (drawn, of) if drawn < of => write!(f, "\n+ dry hulls, the nearest {drawn} of {of}")?,
            (drawn, _) => write!(f, "\n+ dry hulls, {drawn}")?,
        }
        for Skipped { work, reason } in &self.skipped {
            match work {
                SkippedWork::Ocean => write!(f, "\n- ocean: {reason}")?,
                SkippedWork::OceanLooks => write!(f, "\n- mips and foam: {reason}")?,
                SkippedWork::Grid(_) => write!(f, "\n- grid: {reason}")?,
            }
        }
        Ok(())
    }
}
