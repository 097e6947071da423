//! The grids of a snapshot.

use floating_body::Arena;
use glam::{DVec2, Vec2};
use wave_grid::{GridSnapshot, WaveGrid};

use crate::grids::{Grid, Grids, MAX_GRIDS, Sim};
use crate::{GridDesc, GridHome, GridId, OpenWaterError};

/// All grids at a moment.
#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct GridsMoment {
    ids: Arena<GridId, ()>,
    pub(super) list: Vec<GridMoment>,
}

/// A grid at a moment.
#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct GridMoment {
    id: GridId,
    root: GridId,
    desc: GridDesc,
    /// None where it is homed on the GPU.
    pub(super) waves: Option<GridSnapshot>,
    /// World place of its window's middle, metres.
    stands: DVec2,
    gain: f32,
    leaving: bool,
    into: Option<GridId>,
    ebb: Option<f32>,
    trail: DVec2,
    point: Option<DVec2>,
    middle: Vec2,
}

impl GridMoment {
    /// A grid with these waves, or with none yet.
    pub(super) fn of(grid: &Grid, waves: impl FnOnce(&WaveGrid) -> GridSnapshot) -> Self {
        let Grid {
            id,
            root,
            desc,
            sim,
            base: _,
            origin: _,
            gain,
            leaving,
            into,
            ebb,
            trail,
            point,
            middle,
            feeding: _,
        } = grid;
        let window = grid.window();
        let extent = DVec2::from(window.cells.map(f64::from)) * Vec2::from(window.cell_size).as_dvec2();
        Self {
            id: *id,
            root: *root,
            desc: desc.clone(),
            waves: match sim {
                Sim::Cpu(sim) => Some(waves(sim)),
                #[cfg(feature = "gpu")]
                Sim::Gpu(_) => None,
            },
            stands: window.world_corner() + 0.5 * extent,
            gain: *gain,
            leaving: *leaving,
            into: *into,
            ebb: *ebb,
            trail: *trail,
            point: *point,
            middle: *middle,
        }
    }

    fn is_sane(&self) -> bool {
        let places = [self.stands, self.trail, self.point.unwrap_or_default(), self.middle.as_dvec2()];
        let ebbs = self.ebb.is_none_or(f32::is_finite);
        ebbs && (0.0..=1.0).contains(&self.gain) && places.iter().all(|place| place.is_finite())
    }
}

/// Where a restored grid comes from.
pub(super) enum Source {
    /// It is still there.
    Here,
    /// It was made anew.
    New(Sim),
}

impl GridsMoment {
    pub(super) fn of(grids: &Grids) -> Self {
        Self {
            ids: grids.ids.clone(),
            list: grids.list.iter().map(|grid| GridMoment::of(grid, WaveGrid::snapshot)).collect(),
        }
    }

    /// Refuses what no water can have come to.
    pub(super) fn check(&self) -> Result<(), OpenWaterError> {
        let listed = |id: GridId, before: usize| self.list[..before].iter().any(|grid| grid.id == id);
        let sane = self.list.iter().enumerate().all(|(at, grid)| {
            let once = self.ids.get(grid.id).is_some() && !listed(grid.id, at);
            let homed = grid.waves.is_some() == (grid.desc.home == GridHome::Cpu);
            // What a grid lies in was there before it.
            once && homed && grid.is_sane() && grid.desc.within.is_none_or(|within| listed(within, at))
        });
        if sane && self.ids.len() == self.list.len() && self.list.len() <= MAX_GRIDS {
            return Ok(());
        }
        let (value, bound) = (self.list.len() as f64, "one of each handle, 32 at most");
        Err(OpenWaterError::InvalidValue { field: "snapshot: grids", value, bound })
    }

    /// Where each grid comes from: grids that are still there are kept if the snapshot is `shared`.
    pub(super) fn sources(
        &self,
        grids: &Grids,
        tick: f32,
        shared: bool,
        make: &mut dyn FnMut(&GridMoment, wave_grid::GridDesc) -> Result<Sim, OpenWaterError>,
    ) -> Result<Vec<Source>, OpenWaterError> {
        let source = |moment: &GridMoment| {
            moment.desc.check_home()?;
            let desc = moment.desc.wave_grid(tick);
            let fits = |grid: &Grid| match &grid.sim {
                Sim::Cpu(sim) => shared && moment.waves.is_some() && *sim.desc() == desc,
                #[cfg(feature = "gpu")]
                Sim::Gpu(sim) => moment.waves.is_none() && sim.window().cells == desc.cells,
            };
            match grids.get(moment.id).is_ok_and(fits) {
                true => Ok(Source::Here),
                false => make(moment, desc).map(Source::New),
            }
        };
        self.list.iter().map(source).collect()
    }

    /// Puts grids in the place of others, with the local origin there in the world. Returns those that are gone.
    pub(super) fn put(
        &self,
        sources: Vec<Source>,
        origin: DVec2,
        grids: &mut Grids,
    ) -> Result<Vec<Grid>, OpenWaterError> {
        let mut old = std::mem::take(&mut grids.list);
        grids.ids = self.ids.clone();
        let mut done = Ok(());
        for (moment, source) in self.list.iter().zip(sources) {
            let at = old.iter().position(|grid| grid.id == moment.id);
            let was = at.map(|at| old.swap_remove(at));
            let (sim, feeding) = match (source, was) {
                (Source::Here, Some(grid)) => (grid.sim, grid.feeding),
                (Source::New(sim), was) => {
                    old.extend(was);
                    (sim, None)
                }
                (Source::Here, None) => continue,
            };
            let GridMoment { id, root, desc, waves, stands: _, gain, leaving, into, ebb, trail, point, middle } =
                moment;
            let mut grid = Grid {
                id: *id,
                root: *root,
                desc: desc.clone(),
                sim,
                base: 0,
                origin: DVec2::ZERO,
                gain: *gain,
                leaving: *leaving,
                into: *into,
                ebb: *ebb,
                trail: *trail,
                point: *point,
                middle: *middle,
                feeding,
            };
            if let (Sim::Cpu(sim), Some(waves)) = (&mut grid.sim, waves) {
                done = done.and(sim.restore(waves));
            }
            grid.set_origin(origin);
            grids.list.push(grid);
        }
        grids.place();
        done?;
        Ok(old)
    }
}

impl GridMoment {
    /// Where its window stands, if it is homed on the GPU.
    #[cfg(feature = "gpu")]
    pub(super) fn remote(&self) -> Option<DVec2> {
        self.waves.is_none().then_some(self.stands)
    }
}
