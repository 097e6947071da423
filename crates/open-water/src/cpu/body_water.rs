//! The water as a body and as the pieces of a fleet see it: each knows which waves are its own.

use floating_body::{Home, SurfacePatch, SurfaceSample, Touch, WaterSurface};
use glam::{Vec2, Vec3};
use ocean_spectrum::{Ocean, OceanSample};
use wave_grid::{GridSample, Pattern};

use super::surface::{BATCH, Composite, NO_WATER, add, tilt};
use crate::bodies::carries;
use crate::grids::{Grid, Sim};
use crate::handover::Homes;
use crate::store::BodyId;

/// The water as one body sees it.
pub(crate) struct BodyWater<'a> {
    pub(crate) water: Composite<'a>,
    pub(crate) body: BodyId,
    /// The grid that the body disturbs, and what else holds its waves. They go into `own` and nowhere else: what the body
    /// displaces is measured against everything else, and would grow if any of its own waves were in there.
    pub(crate) homes: &'a Homes,
    /// The body feels its own waves.
    pub(crate) by_grid: bool,
    /// Its textures, as the home grid writes and reads them.
    pub(crate) pattern: Option<&'a Pattern>,
}

impl BodyWater<'_> {
    /// A body that makes no waves has none of its own to tell apart.
    fn others_and_own(&self, points: &[Vec2], others: &mut [GridSample], own: &mut [GridSample]) {
        for grid in self.water.grids.iter() {
            let share = self.homes.share(grid);
            if share == 0.0 || share == 1.0 {
                add(grid, points, 1.0, if share == 1.0 { &mut *own } else { &mut *others });
            } else {
                add(grid, points, share, own);
                add(grid, points, 1.0 - share, others);
            }
        }
    }
}

impl WaterSurface for BodyWater<'_> {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (points, out) in points.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let n = points.len().min(out.len());
            let points = &points[..n];
            let mut ambient = [OceanSample::default(); BATCH];
            self.water.ambient(points, &mut ambient[..n]);
            let mut others = [GridSample::default(); BATCH];
            let mut own = [GridSample::default(); BATCH];
            self.others_and_own(points, &mut others[..n], &mut own[..n]);
            let k = self.water.ocean.map_or(0.0, Ocean::peak_wavenumber);
            let level = self.water.shore.level;
            for (i, out) in out[..n].iter_mut().enumerate() {
                let (a, g) = (&ambient[i], &others[i]);
                if self.water.shore.is_kept_dry(points[i]) {
                    *out = SurfaceSample { height: NO_WATER, level: NO_WATER, ..SurfaceSample::CALM };
                    continue;
                }
                *out = SurfaceSample {
                    height: level + a.height + g.height,
                    level,
                    own: own[i].height,
                    normal: tilt(a.normal, g.slope),
                    velocity: a.velocity + Vec3::Y * g.vertical_velocity,
                    acceleration: a.vertical_acceleration,
                    decay_wavenumber: k,
                };
            }
        }
    }

    fn home(&self) -> Home {
        let grid = self.homes.now().and_then(|home| self.water.grids.get(home).ok());
        match grid {
            Some(grid) if grid.follows(self.body) => Home::Own,
            Some(_) => Home::Shared,
            // The waves it left behind are felt on as they were.
            None if self.by_grid && self.homes.any() => Home::Shared,
            None => Home::None,
        }
    }

    fn radiated(&self, at: Vec2, heading: f32) -> Option<[f32; 3]> {
        let grid = self.homes.now().and_then(|home| self.water.grids.get(home).ok())?;
        match &grid.sim {
            Sim::Cpu(sim) if carries(grid).is_some() => {
                let [heave, roll, pitch, _] = sim.read_pattern(self.pattern?, at, heading);
                Some([heave, roll, pitch])
            }
            _ => None,
        }
    }

    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        let mut out = [SurfacePatch::default()];
        self.patches(&[center], radius, &mut out);
        out[0]
    }

    fn patches(&self, centers: &[Vec2], radius: f32, out: &mut [SurfacePatch]) {
        for (centers, out) in centers.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let mut others = [GridSample::default(); BATCH];
            let mut own = [GridSample::default(); BATCH];
            self.others_and_own(centers, &mut others[..centers.len()], &mut own[..centers.len()]);
            self.water.patches(centers, radius, (&others, &own), out);
        }
    }

    fn is_calm(&self, low: Vec2, high: Vec2) -> bool {
        self.water.is_calm(low, high)
    }

    fn touch(&self, points: &[Vec3], out: &mut [Touch]) -> bool {
        self.water.touch(points, out)
    }

    fn wind(&self) -> Vec3 {
        Vec3::new(self.water.wind.x, 0.0, self.water.wind.y)
    }
}

/// The water as the pieces of a fleet see it.
pub(crate) struct FleetWater<'a> {
    pub(crate) water: Composite<'a>,
    /// They make waves in whatever grid they are in. Then the waves of all grids count as their own, since those that they
    /// made go from one into another; rain and the like, in which nobody makes waves, are others'.
    pub(crate) by_grid: bool,
}

impl FleetWater<'_> {
    fn is_own(&self, grid: &Grid) -> bool {
        self.by_grid && !grid.repeats()
    }
}

impl WaterSurface for FleetWater<'_> {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        // Fleets ask for patches; one of no width is a sample.
        for (point, out) in points.iter().zip(out) {
            let p = self.patch(*point, 0.0);
            *out = SurfaceSample {
                height: p.height,
                own: p.own,
                normal: Vec3::new(-p.gradient.x, 1.0, -p.gradient.y).normalize(),
                velocity: p.velocity,
                acceleration: p.acceleration,
                decay_wavenumber: p.decay_wavenumber,
                level: p.level,
            };
        }
    }

    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        let mut out = [SurfacePatch::default()];
        self.patches(&[center], radius, &mut out);
        out[0]
    }

    fn patches(&self, centers: &[Vec2], radius: f32, out: &mut [SurfacePatch]) {
        for (centers, out) in centers.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let mut others = [GridSample::default(); BATCH];
            let mut own = [GridSample::default(); BATCH];
            for grid in self.water.grids.iter() {
                let sum = if self.is_own(grid) { &mut own } else { &mut others };
                add(grid, centers, 1.0, &mut sum[..centers.len()]);
            }
            self.water.patches(centers, radius, (&others, &own), out);
        }
    }

    fn is_calm(&self, low: Vec2, high: Vec2) -> bool {
        self.water.is_calm(low, high)
    }

    fn touch(&self, points: &[Vec3], out: &mut [Touch]) -> bool {
        self.water.touch(points, out)
    }

    fn wind(&self) -> Vec3 {
        Vec3::new(self.water.wind.x, 0.0, self.water.wind.y)
    }

    fn home(&self) -> Home {
        if self.water.grids.iter().any(|grid| self.is_own(grid)) { Home::Shared } else { Home::None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{GridDesc, OpenWater, Preset};

    fn calm(water: &OpenWater, low: [f32; 2], high: [f32; 2]) -> bool {
        FleetWater { water: water.composite(), by_grid: false }.is_calm(low.into(), high.into())
    }

    fn tick(water: &mut OpenWater) {
        for tick in water.advance(1.0 / 60.0) {
            water.tick(tick, &mut crate::BodyStates::default()).unwrap();
        }
    }

    #[test]
    fn calm_is_where_nothing_moves() {
        let mut desc = Preset::Low.water();
        assert!(!calm(&OpenWater::headless(desc.clone()).unwrap(), [0.0; 2], [1.0; 2]));
        desc.sea.partitions.clear();
        let mut water = OpenWater::headless(desc).unwrap();
        // 96 m a side around the origin.
        let id = water.add_grid(GridDesc { ..Preset::Low.grid() }).unwrap();
        tick(&mut water);
        let (low, high) = ([-20.0, -20.0], [20.0, 20.0]);
        assert!(calm(&water, low, high));
        let source = wave_grid::Source::Displacement { center: Vec2::new(14.0, 3.0), radius: 2.0, volume: 20.0 };
        water.grids.get_mut(id).unwrap().add(source);
        tick(&mut water);
        assert!(!calm(&water, low, high) && !calm(&water, [13.0, 2.0], [14.0, 3.0]));
        assert!(calm(&water, [-20.0, -20.0], [-12.0, 20.0]) && calm(&water, [60.0, 0.0], [70.0, 9.0]));
        // The waves get there.
        (0..480).for_each(|_| tick(&mut water));
        assert!(!calm(&water, [-20.0, -20.0], [-12.0, 20.0]));
        assert!(calm(&water, [60.0, 0.0], [70.0, 9.0]));
        water.set_level(0.5).unwrap();
        assert!(!calm(&water, [60.0, 0.0], [70.0, 9.0]));
        tick(&mut water);
        assert!(calm(&water, [60.0, 0.0], [70.0, 9.0]));
    }

    #[test]
    fn patches_are_those_of_one_after_the_other() {
        let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
        let id = water.add_grid(GridDesc { ..Preset::Low.grid() }).unwrap();
        let source = wave_grid::Source::Displacement { center: Vec2::ZERO, radius: 3.0, volume: 9.0 };
        water.grids.get_mut(id).unwrap().add(source);
        (0..60).for_each(|_| tick(&mut water));
        let centers: Vec<Vec2> = (0..100).map(|i| Vec2::from_angle(i as f32) * (0.6 * i as f32)).collect();
        for by_grid in [false, true] {
            let fleet = FleetWater { water: water.composite(), by_grid };
            let mut all = vec![SurfacePatch::default(); 100];
            fleet.patches(&centers, 0.6, &mut all);
            for (center, patch) in centers.iter().zip(&all) {
                assert_eq!(fleet.patch(*center, 0.6), *patch);
                let sea = water.ocean().map_or(f32::NAN, |ocean| ocean.patch(*center, 0.6).height);
                assert!(patch.height == sea || !by_grid);
            }
            // What the grid adds is felt either way, and is own where they make waves.
            let own = all.iter().any(|patch| patch.own != 0.0);
            assert!(own == by_grid && (fleet.home() == Home::Shared) == by_grid);
            let mut samples = [crate::WaterSample::default()];
            water.composite().surface_at(&centers[7..8], &mut samples);
            let patch = fleet.patch(centers[7], 0.0);
            assert!((samples[0].height - patch.height - patch.own).abs() < 2e-3);
        }
    }
}
