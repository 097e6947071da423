//! Wakes without grids to manage: the bodies that matter most get a grid each, as many as a budget holds.
//!
//! A body matters by how long it looks from the eye, and by its speed: waves grow with its Froude number. What is far
//! away gets larger cells. Grids come calm and go by fading, and a grid of other cells takes the waves over and fades in
//! while the old one fades out, so nothing pops.

mod budget;

use glam::Vec2;
use slotmap::SecondaryMap;

use crate::store::{BodyId, GridId};
use crate::water::OpenWater;
use crate::{GridDesc, GridHome, OpenWaterError, Preset};
#[cfg(doc)]
use wave_grid::Scheme;

/// Cells double this often at most, and a grid has as many on a side at least.
const COARSEST: u32 = 2;
const FEWEST: u32 = 64;
/// Beyond a distance where cells change, this share farther or nearer, they do.
const BAND: f32 = 0.15;
/// Longest hull that water waves are made for, cells: what is wider than that rings. Half as much again are the longest waves
/// of a hull that is not planing, 2 pi Fr^2 L with Fr = .5: well within the 128 cells that the scheme is made for.
const LONGEST: f32 = 48.0;
/// Cells double this often at most for the hull's sake.
const LARGEST: u32 = 4;

/// Grids that bodies get by themselves, see [`OpenWater::set_wakes`].
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WakesDesc {
    /// The grid of a body near the eye, on the CPU; whom it follows is not read. With [`Scheme::Dispersive`] and
    /// [`Scheme::Spectral`], hulls longer than 48 of its cells get as many larger ones: twice, four times, up to 16 times as
    /// large.
    pub grid: GridDesc,
    /// Cells that all of these grids together may have, those that fade too, at least those of `grid`; a quarter more for
    /// the second in which one takes over from another. A cell takes about 40 bytes.
    pub cells: u64,
    /// Distance from the eye ([`OpenWater::look`]), metres, from where on cells are twice as large; from twice that distance
    /// on they are four times as large.
    pub fine: f32,
    /// Bodies shorter than this get no grid, metres.
    pub least_length: f32,
}

impl Default for WakesDesc {
    /// Room for eight boats near by.
    fn default() -> Self {
        let grid = Preset::Medium.grid();
        Self { cells: 8 * cells_of(&grid), grid, fine: 120.0, least_length: 2.5 }
    }
}

/// Whether a body has a grid by [`OpenWater::set_wakes`], or why not.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Wake {
    /// It has one.
    Grid {
        /// The grid.
        grid: GridId,
        /// Its cells, metres.
        cell_size: [f32; 2],
    },
    /// Nobody asked for wakes, or the body takes no part.
    NotAsked,
    /// The game gave it a grid.
    OwnGrid,
    /// It is shorter than the least length.
    Short,
    /// It makes no way.
    Still,
    /// Others matter more than it does.
    NoRoom,
}

impl std::fmt::Display for Wake {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Grid { cell_size, .. } => write!(f, "cells of {} m", cell_size[0]),
            Self::NotAsked => f.write_str("no grid: not asked for"),
            Self::OwnGrid => f.write_str("a grid of the game's"),
            Self::Short => f.write_str("no grid: short"),
            Self::Still => f.write_str("no grid: makes no way"),
            Self::NoRoom => f.write_str("no grid: no room"),
        }
    }
}

impl Wakes {
    /// Whether a grid is one of these.
    pub(crate) fn owns(&self, id: GridId) -> bool {
        let mut told = self.known.iter().flat_map(|known| known.told.values());
        told.any(|wake| matches!(wake, Wake::Grid { grid, .. } if *grid == id))
    }
}

fn cells_of(desc: &GridDesc) -> u64 {
    u64::from(desc.cells[0]) * u64::from(desc.cells[1])
}

impl WakesDesc {
    fn check(&self, tick: f32) -> Result<(), OpenWaterError> {
        let invalid = |field, value, bound| Err(OpenWaterError::InvalidValue { field, value, bound });
        for level in 0..=self.coarsest() {
            self.level(level, 0).wave_grid(tick).stepping()?;
        }
        if self.grid.home == GridHome::Gpu || self.grid.feed.any() {
            return invalid("wakes: grid", 1.0, "homed on the CPU and not fed");
        }
        if self.cells < cells_of(&self.grid) {
            return invalid("wakes: cells", self.cells as f64, "at least those of one grid");
        }
        if !(self.fine > 0.0 && self.fine.is_finite()) {
            return invalid("wakes: fine", self.fine.into(), "positive and finite");
        }
        if !(self.least_length >= 0.0 && self.least_length.is_finite()) {
            return invalid("wakes: least_length", self.least_length.into(), "0 or positive, and finite");
        }
        Ok(())
    }

    /// How often cells may double.
    fn coarsest(&self) -> u32 {
        let fewest = self.grid.cells[0].min(self.grid.cells[1]);
        (0..COARSEST).take_while(|level| fewest >> (level + 1) >= FEWEST).count() as u32
    }

    /// How often cells are doubled for the sake of a hull so long, metres.
    fn size(&self, length: f32) -> u32 {
        if self.grid.scheme.is_wave_equation() {
            return 0;
        }
        let cell = self.grid.cell_size[0].max(self.grid.cell_size[1]);
        (0..LARGEST).take_while(|size| length > LONGEST * cell * (1u32 << size) as f32).count() as u32
    }

    /// The grid whose cells were doubled so often for the sake of the distance, which leaves fewer of them, and so often for
    /// that of the hull.
    fn level(&self, level: u32, size: u32) -> GridDesc {
        let larger = (1u32 << (level + size)) as f32;
        GridDesc {
            cells: self.grid.cells.map(|n| n >> level),
            cell_size: self.grid.cell_size.map(|h| h * larger),
            ..self.grid.clone()
        }
    }

    /// How often they should be doubled at a distance, for a hull whose sake has doubled them `size` times and a grid where
    /// they are `now`.
    fn wanted(&self, distance: f32, size: u32, now: Option<u32>) -> u32 {
        let beyond = |band: f32| {
            let fine = self.fine * (1u32 << size) as f32;
            let bounds = [fine, 2.0 * fine];
            (bounds.iter().filter(|bound| distance > **bound * band).count() as u32).min(self.coarsest())
        };
        match now {
            None => beyond(1.0),
            Some(now) => now.clamp(beyond(1.0 + BAND), beyond(1.0 - BAND)),
        }
    }
}

/// A body with a grid.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Kept {
    body: BodyId,
    grid: GridId,
    level: u32,
    size: u32,
    weight: f32,
}

/// What is known of all bodies' wakes.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Wakes {
    desc: Option<WakesDesc>,
    kept: Vec<Kept>,
    /// Grids that were let go and still fade.
    fading: Vec<(GridId, u64)>,
    /// None without wakes: empty maps have a place on the heap too, which no tick is to ask for.
    known: Option<Known>,
    /// Scratch of a decision.
    #[cfg_attr(feature = "serde", serde(skip))]
    asking: Vec<budget::Asking>,
}

/// What is known of bodies.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Known {
    /// Mean velocities, m/s.
    ways: SecondaryMap<BodyId, Vec2>,
    told: SecondaryMap<BodyId, Wake>,
}

impl Wakes {
    fn known(&mut self) -> &mut Known {
        self.known.get_or_insert_default()
    }

    /// Mean velocity of a body, m/s.
    fn way(&self, body: BodyId) -> Option<Vec2> {
        self.known.as_ref()?.ways.get(body).copied()
    }

    /// Refuses what no water can have come to.
    pub(crate) fn check(&self, tick: f32) -> Result<(), OpenWaterError> {
        self.desc.as_ref().map_or(Ok(()), |desc| desc.check(tick))?;
        match self.kept.iter().find(|kept| kept.level > COARSEST || kept.size > LARGEST) {
            None => Ok(()),
            Some(kept) => {
                let value = kept.level.max(kept.size).into();
                Err(OpenWaterError::InvalidValue {
                    field: "snapshot: wakes",
                    value,
                    bound: "cells doubled 4 times at most",
                })
            }
        }
    }
}

impl OpenWater {
    /// Lets the water give grids to the bodies that need them: all that are long enough and make way, the ones that matter
    /// most first, while the budget lasts. What matters is size and speed over the distance from the eye
    /// ([`Self::look`]; without one, size and speed). Decided four times a second at 60 ticks; a body that matters half as
    /// much again takes the place of the one that matters least. `None` lets all of these grids fade.
    ///
    /// # Errors
    /// A value of the description is out of its range; then nothing was changed.
    pub fn set_wakes(&mut self, desc: Option<WakesDesc>) -> Result<(), OpenWaterError> {
        if let Some(desc) = &desc {
            desc.check(self.clock.dt())?;
            #[cfg(feature = "gpu")]
            if let Some(gpu) = &self.gpu {
                // Those that fade meanwhile, and the game's own.
                gpu.check_pool(desc.cells.saturating_add(desc.cells / 4 + u64::from(self.grids.pool_cells())))?;
            }
        }
        let mut wakes = std::mem::take(&mut self.wakes);
        for kept in std::mem::take(&mut wakes.kept) {
            self.let_go(&mut wakes, &kept);
        }
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.reserve_pool(desc.as_ref().map_or(0, |desc| desc.cells.min(u32::MAX.into()) as u32));
        }
        if let Some(known) = &mut wakes.known {
            known.told.clear();
        }
        wakes.desc = desc;
        self.wakes = wakes;
        note!(self, Input::Wakes(Box::new(self.wakes.desc.clone())));
        Ok(())
    }

    /// Whether the body has a grid by [`Self::set_wakes`], or why not.
    ///
    /// # Errors
    /// There is no such body.
    pub fn wake(&self, body: BodyId) -> Result<Wake, OpenWaterError> {
        self.bodies.body(body)?;
        let told = self.wakes.known.as_ref().and_then(|known| known.told.get(body));
        Ok(told.copied().unwrap_or(Wake::NotAsked))
    }
}
