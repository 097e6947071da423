//! What a frame will run on the GPU, and what it will not and why: plain data, made before anything is encoded.
//!
//! It says *what*; `gpu/encode.rs` is the one place that turns it into passes.

use std::fmt;

use arrayvec::ArrayVec;

use crate::GridId;
use crate::dry::DryPlan;
use crate::grids::MAX_GRIDS;
use crate::land::ShoreMark;

/// A piece of GPU work of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Work {
    /// The cascades' spectra at the drawn time, and their transforms.
    Ocean {
        /// Number of cascades that are made, the longest first.
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
    /// All awake GPU-homed grids are stepped, whether somebody looks or not.
    GridSteps {
        /// Dispatches of the ticks since the last frame.
        dispatches: u32,
    },
    /// Heights at alpha of GPU-homed grids go to the pool, and from there to the CPU.
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
    /// It has moved by less than a quarter of the finest pixel since it was made.
    Still,
    /// No view is near enough to resolve it.
    BelowAPixel,
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
            Self::Still => "moved by less than a quarter of a pixel",
            Self::BelowAPixel => "below a pixel",
            Self::Headless => "headless",
            Self::DeviceLost => "the device is lost",
        })
    }
}

/// What was left out, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// The shortest cascades of the sea.
    Cascades {
        /// How many.
        count: u32,
    },
    /// Mips and foam of the sea.
    OceanLooks,
    /// A grid's upload, steps or drawing.
    Grid(GridId),
    /// Hulls that are to be kept dry.
    DryHulls {
        /// How many.
        count: u32,
    },
}

/// Most pieces of work of a frame: the table, the sea and its looks, an upload for each grid or steps and drawing.
pub const MAX_WORK: usize = MAX_GRIDS + 5;

/// The GPU work of one frame. `Display` prints it in a few lines. Plain data of a few KiB, without memory of its own.
///
/// It may be encoded late, more than once or never: what is there no more is left out then.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FramePlan {
    /// The drawn time, seconds since the start.
    pub time: f64,
    /// The last tick run.
    pub tick: u64,
    /// How far the drawn moment lies between the last two ticks.
    pub alpha: f32,
    /// What will run, in order.
    pub work: ArrayVec<Work, MAX_WORK>,
    /// What will not.
    pub skipped: ArrayVec<Skipped, MAX_WORK>,
    pub(crate) dispatches: u32,
    /// Grids that are drawn.
    pub(crate) listed: ArrayVec<GridId, MAX_GRIDS>,
    pub(crate) shore: ShoreMark,
    pub(crate) dry: DryPlan,
}

impl FramePlan {
    /// There is room for all that a water may have: see [`MAX_WORK`].
    pub(crate) fn run(&mut self, work: Work) {
        let _ = self.work.try_push(work);
    }

    pub(crate) fn skip(&mut self, work: SkippedWork, reason: Reason) {
        let _ = self.skipped.try_push(Skipped { work, reason });
    }

    pub(crate) fn list(&mut self, grid: GridId) {
        let _ = self.listed.try_push(grid);
    }

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
                SkippedWork::Cascades { count } => write!(f, "\n- the {count} shortest cascades: {reason}")?,
                SkippedWork::Grid(_) => write!(f, "\n- grid: {reason}")?,
                SkippedWork::DryHulls { count } => write!(f, "\n- {count} dry hulls: {reason}")?,
            }
        }
        Ok(())
    }
}
