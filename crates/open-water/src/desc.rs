//! Descriptions: what a water, a grid and a view are made from, and the presets.

use floating_body::BodyDesc;
use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::{CascadeDesc, OceanDesc, SeaState};
use wave_grid::{Border, Edges, Rain, Scheme};

use crate::{Follow, GridId, OpenWaterError};

/// Describes an [`OpenWater`](crate::OpenWater).
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OpenWaterDesc {
    /// The ambient sea; without partitions it is flat calm and costs nothing.
    pub sea: SeaState,
    /// Chooses the phases of the waves: the same sea state and seed give the same sea everywhere.
    pub seed: u64,
    /// FFT tiles that make up the sea, 1 to 8; [`OceanDesc::for_sea`] finds some that suit it. They stay when the sea
    /// changes.
    pub cascades: Vec<CascadeDesc>,
    /// How far crests are sharpened, 0 to 1.
    pub choppiness: f32,
    /// Velocity of the wind 10 m above the water (x, z), m/s, within 100 m/s. It pushes bodies that have a wind drag and
    /// makes no waves: those are the sea's.
    pub wind: Vec2,
    /// Length of the fixed tick, seconds, 0.001 to 0.1.
    pub tick: f32,
    /// Most ticks that one frame may run, 1 to 64; what is due beyond them is dropped and reported.
    pub max_ticks_per_frame: u32,
}

impl Default for OpenWaterDesc {
    fn default() -> Self {
        Preset::Medium.water()
    }
}

impl OpenWaterDesc {
    pub(crate) fn check(&self) -> Result<(), OpenWaterError> {
        let invalid = |field, value, bound| Err(OpenWaterError::InvalidValue { field, value, bound });
        if !(0.001..=0.1).contains(&self.tick) {
            return invalid("tick", f64::from(self.tick), "0.001 to 0.1 s");
        }
        if !(1..=64).contains(&self.max_ticks_per_frame) {
            return invalid("max_ticks_per_frame", f64::from(self.max_ticks_per_frame), "1 to 64");
        }
        check_wind(self.wind)
    }

    pub(crate) fn ocean(&self) -> OceanDesc {
        OceanDesc {
            sea: self.sea.clone(),
            seed: self.seed,
            cascades: self.cascades.clone(),
            choppiness: self.choppiness,
            ..OceanDesc::default()
        }
    }
}

/// Refuses a wind that is none.
pub(crate) fn check_wind(wind: Vec2) -> Result<(), OpenWaterError> {
    if wind.length() <= 100.0 {
        return Ok(());
    }
    Err(OpenWaterError::InvalidValue { field: "wind", value: wind.length().into(), bound: "within 100 m/s" })
}

/// Where a grid is stepped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GridHome {
    /// On the CPU: bodies feel it at once, and what is drawn is what they feel.
    #[default]
    Cpu,
    /// On the GPU, for looks and for large grids: the CPU's samples of it are some frames old
    /// (see [`OpenWater::grid_age`](crate::OpenWater::grid_age)).
    Gpu,
}

/// Describes an interactive grid.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridDesc {
    /// What the window stays around.
    pub follow: Follow,
    /// Where it is stepped.
    pub home: GridHome,
    /// Cells along x and z.
    pub cells: [u32; 2],
    /// Cell size along x and z, metres.
    pub cell_size: [f32; 2],
    /// Which waves it carries: water waves, of which long ones are faster ([`Scheme::Dispersive`]), or those of the wave
    /// equation, which all have one speed. Only the latter can be fed; [`Scheme::Spectral`] knows no land and needs a home on
    /// the CPU.
    pub scheme: Scheme,
    /// Speed of the wave equation's waves in deep water, metres per second. Over a bed they slow down as waves of that
    /// period do. Water waves have no use for it.
    pub wave_speed: f32,
    /// Depth that water waves feel where there is no [`Land`](crate::Land), metres, 0.01 and more, infinite too.
    #[cfg_attr(feature = "serde", serde(with = "floating_body::endless"))]
    pub depth: f32,
    /// What is at the edge of its window. One with [`Border::Periodic`] is for detail such as rain: it repeats over the whole
    /// plane, fades from 30 to 60 m from the eye ([`OpenWater::look`](crate::OpenWater::look)), or from the world's origin
    /// while nobody looks, and is no body's home. Needs a home on the CPU unless it absorbs by a matched layer.
    pub border: Border,
    /// Linear damping, 1/s, 0 to 10: without any, rain on a tile that repeats would never calm down.
    pub damping: f32,
    /// Rain that falls into it, on the CPU only.
    pub rain: Option<Rain>,
    /// The coarser grid that this one lies in, if any: fine cells where a bow wave is, coarse ones for the wake far behind.
    /// Both carry the waves of the bodies in this one, and where this one is seen the coarser one is not. Waves that come in
    /// from the coarser grid alone, such as those of a body outside this one, are not seen here. One that is made while
    /// there are waves begins with those of the coarser grid if both are on the CPU.
    pub within: Option<GridId>,
    /// Sides through which the ambient sea comes in; needs [`Land`](crate::Land), a fixed place on its depth map and a
    /// home on the CPU. Where such a grid is, the ambient sea leaves the waves to it that it can carry: of the longest
    /// cascades those whose shortest wave has six cells.
    pub feed: Edges,
}

impl Default for GridDesc {
    fn default() -> Self {
        Preset::Medium.grid()
    }
}

impl GridDesc {
    pub(crate) fn wave_grid(&self, tick: f32) -> wave_grid::GridDesc {
        wave_grid::GridDesc {
            cells: self.cells,
            cell_size: self.cell_size,
            wave_speed: self.wave_speed,
            depth: self.depth,
            scheme: self.scheme,
            border: self.border,
            damping: self.damping,
            tick,
            ..wave_grid::GridDesc::default()
        }
    }
}

/// Quality in one word. What each costs and leaves out on a machine: `frame_presets` of the evidence. Of the slopes of the
/// default sea, which make its glitter, arrays of 128 texels leave a quarter to roughness, of 256 a sixth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Preset {
    /// Integrated graphics and busy servers: three cascades of 128, a grid of 192 cells of 50 cm.
    Low,
    /// The default: three cascades of 256, a grid of 384 cells of 25 cm; two to three times the cost.
    #[default]
    Medium,
    /// A strong GPU: four cascades of 256 that reach from a tile of 901 m down to waves of centimetres, a grid of 512.
    High,
    /// The strongest, and pictures: the same cascades of 512, so that the shortest waves of each are exact, and a grid of
    /// 768 cells of 19 cm.
    Ultra,
    /// The set-up of Yang et al. 2017: one FFT tile of 1024^2, the 5-point scheme on a moving grid of 512^2.
    Paper,
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Low, Self::Medium, Self::High, Self::Ultra, Self::Paper];

    /// The water of this quality, with its default sea.
    pub fn water(self) -> OpenWaterDesc {
        let (size, tiles): (u32, &[f32]) = match self {
            Self::Low => (128, &[485.0, 72.0, 10.8]),
            Self::Medium => (256, &[485.0, 72.0, 10.8]),
            // Another cascade holds more of the slopes than larger ones, for a third of the time.
            Self::High => (256, &[901.0, 134.0, 20.0, 3.0]),
            Self::Ultra => (512, &[901.0, 134.0, 20.0, 3.0]),
            Self::Paper => (1024, &[500.0]),
        };
        OpenWaterDesc {
            sea: OceanDesc::default().sea,
            seed: 1,
            cascades: tiles.iter().map(|&tile| CascadeDesc::new(size, tile)).collect(),
            choppiness: 1.0,
            wind: Vec2::ZERO,
            tick: 1.0 / 60.0,
            max_ticks_per_frame: 8,
        }
    }

    /// The grid of this quality that follows a boat: water waves of 6 to 128 cells. [`Self::Paper`]'s have one speed, the
    /// phase speed of waves about 17 m long; cell size and speed keep its scheme near the stability bound, where its phase
    /// error is least.
    pub fn grid(self) -> GridDesc {
        let (cells, cell, scheme, width) = match self {
            Self::Low => (192, 0.5, Scheme::Dispersive, 12),
            Self::Medium => (384, 0.25, Scheme::Dispersive, 16),
            Self::High => (512, 0.25, Scheme::Dispersive, 20),
            Self::Ultra => (768, 0.1875, Scheme::Dispersive, 20),
            Self::Paper => (512, 0.125, Scheme::FivePoint, 12),
        };
        // 5-point: a = (5.2/60/.125)^2 = .481 <= .49.
        let wave_speed = if scheme == Scheme::FivePoint { 5.2 } else { 6.2 };
        GridDesc {
            follow: Follow::Fixed(DVec2::ZERO),
            home: GridHome::Cpu,
            cells: [cells; 2],
            cell_size: [cell; 2],
            wave_speed,
            depth: f32::INFINITY,
            scheme,
            within: None,
            border: Border::Absorbing { width },
            damping: 0.0,
            rain: None,
            feed: Edges::default(),
        }
    }

    /// A boat of this quality: the paper's preset makes it pre-rigid.
    pub fn body(self, desc: BodyDesc) -> BodyDesc {
        match self {
            Self::Paper => BodyDesc { inertia: floating_body::Inertia::PreRigid, ..desc },
            _ => desc,
        }
    }
}

/// Who looks at the water: decides what is worth drawing, never what is simulated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct View {
    /// The eye's local position, metres.
    pub eye: Vec3,
    /// Angle that a pixel covers, radians.
    pub pixel_angle: f32,
}

bitflags::bitflags! {
    /// What reads the drawn surface beside its heights.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Consumers: u32 {
        /// Filtered displacement and normals (`surface_vertex`, `surface_shading`).
        const NORMALS = 1;
        /// Foam.
        const FOAM = 2;
    }
}
