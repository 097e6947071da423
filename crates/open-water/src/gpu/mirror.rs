//! The heights of a GPU-homed grid as they came back to the CPU, carried on to the last tick.

use glam::{DVec2, Vec2};
use open_water_shaders::cubic::{slopes, weights};
use wave_grid::{GridSample, Hole, Window};

use super::carry::{Carry, most, sum};
use super::judge::Judge;

/// Heights after a tick and after the one before, of the cells of a window.
#[derive(Debug)]
struct Copy {
    tick: u64,
    corner: [i64; 2],
    /// Without fade.
    heights: [Vec<f32>; 2],
}

/// See the module.
pub(crate) struct Mirror {
    window: Window,
    /// World place of the local origin, metres.
    pub(crate) origin: DVec2,
    dt: f32,
    /// The newest first; older ones are kept for their memory.
    copies: [Copy; 2],
    /// How many of them show anything.
    known: usize,
    /// The newest that was ever taken.
    taken: Option<u64>,
    /// The last tick.
    now: u64,
    /// How the newest is carried on with the older one, and where that has no heights.
    carries: [Carry; 2],
    /// Heights that are carried on stay within this, metres.
    limit: f32,
    judge: Judge,
}

/// Limit over the largest height of the newest copy.
const LIMIT: f32 = 1.5;

impl Mirror {
    /// Of a grid that ticks every `dt` seconds.
    pub(crate) fn new(cells: [u32; 2], cell_size: [f32; 2], dt: f32) -> Self {
        let copy = || Copy { tick: 0, corner: [0; 2], heights: Default::default() };
        Self {
            window: Window { corner: [0; 2], cells, cell_size },
            origin: DVec2::ZERO,
            dt,
            copies: [copy(), copy()],
            known: 0,
            taken: None,
            now: 0,
            carries: [Carry::new(0, None, dt); 2],
            limit: 0.0,
            judge: Judge::new(cells),
        }
    }

    /// The tick of the newest copy; `None` while nothing is known.
    pub(crate) fn tick(&self) -> Option<u64> {
        (self.known > 0).then_some(self.copies[0].tick)
    }

    /// Takes a copy of the heights after `tick` if it is newer than all before: `fill` writes them and those of the tick
    /// before as cells of the window at `corner`, and returns whether it could.
    pub(crate) fn take(&mut self, tick: u64, corner: [i64; 2], fill: impl FnOnce([&mut Vec<f32>; 2]) -> bool) {
        if self.taken.is_some_and(|taken| taken >= tick) {
            return;
        }
        self.taken = Some(tick);
        let [newest, older] = &mut self.copies;
        std::mem::swap(newest, older);
        (newest.tick, newest.corner) = (tick, corner);
        let [now, before] = &mut newest.heights;
        if !fill([now, before]) {
            self.still();
            return;
        }
        self.known = (self.known + 1).min(2);
        self.limit = LIMIT * now.iter().fold(0.0f32, |most, height| most.max(height.abs()));
        self.judge.measure(tick, &Window { corner, ..self.window }, &self.copies[0].heights[0]);
    }

    /// The grid sleeps, or begins anew: whatever came back last is over.
    pub(crate) fn still(&mut self) {
        self.known = 0;
        self.judge.forget();
    }

    /// Tick number `now` has run: samples are of its end from here on.
    pub(crate) fn follow(&mut self, now: u64) {
        self.now = now;
        let Some(newest) = self.tick() else { return };
        let age = now.saturating_sub(newest);
        let older = (self.known > 1).then(|| (newest - self.copies[1].tick).max(2));
        let older = older.filter(|older| *older <= most(self.dt));
        self.carries = [older, None].map(|older| Carry::new(age, older, self.dt));
        let Self { copies, judge, carries, window, limit, .. } = self;
        let nx = window.cells[0] as usize;
        let window = Window { corner: copies[0].corner, ..*window };
        let moments = Moments { copies, carries, cells: window.cells };
        let limit = *limit;
        judge.expect(now, &window, carries[0].growth, |at| {
            let [x, z] = [(at % nx) as i64, (at / nx) as i64];
            let ([heights], carry) = moments.cells_from([window.corner[0] + x, window.corner[1] + z]);
            sum(heights, carry.value).clamp(-limit, limit)
        });
    }

    /// Answers at local points, as `grid_at` in `wgsl/shared/surface.wgsl` does for what is drawn: `seen` is what the grid
    /// shows, `holes` are cut out of it.
    pub(crate) fn sample(&self, points: &[Vec2], seen: &Hole, holes: &[Hole], out: &mut [GridSample]) {
        for (point, out) in points.iter().zip(out) {
            *out = self.sample_one(*point, seen, holes).unwrap_or_default();
        }
    }

    /// World cell of the first of 4 x 4 cells around a local point, and the place of the point between the middle ones.
    fn stencil(&self, point: Vec2) -> Option<([i64; 2], Vec2)> {
        let window = Window { corner: self.copies[0].corner, ..self.window };
        let at = window.cells_from_corner(point, self.origin) - 0.5;
        let base = at.floor();
        let inside = |x: f64, n: u32| x >= 1.0 && x <= f64::from(n) - 3.0;
        if self.known == 0 || !(inside(base.x, window.cells[0]) && inside(base.y, window.cells[1])) {
            return None;
        }
        let first = [window.corner[0] + base.x as i64 - 1, window.corner[1] + base.y as i64 - 1];
        Some((first, (at - base).as_vec2()))
    }

    fn sample_one(&self, point: Vec2, seen: &Hole, holes: &[Hole]) -> Option<GridSample> {
        let (first, t) = self.stencil(point)?;
        let (wx, wz, dx, dz) = (weights(t.x), weights(t.y), slopes(t.x), slopes(t.y));
        let moments = Moments { copies: &self.copies, carries: &self.carries, cells: self.window.cells };
        let fades = self.fades(first, seen, holes);
        let mut sample = GridSample::default();
        for (j, fades) in (0..).zip(fades) {
            let (heights, carry) = moments.cells_from::<4>([first[0], first[1] + j as i64]);
            for (i, (heights, fade)) in heights.into_iter().zip(fades).enumerate() {
                let height = fade * sum(heights, carry.value).clamp(-self.limit, self.limit);
                sample.height += wx[i] * wz[j] * height;
                sample.slope += Vec2::new(dx[i] * wz[j], wx[i] * dz[j]) * height;
                sample.vertical_velocity += wx[i] * wz[j] * fade * sum(heights, carry.rate);
            }
        }
        sample.slope /= Vec2::from(self.window.cell_size);
        Some(sample)
    }

    /// How much of each of 4 x 4 cells is seen, row by row.
    fn fades(&self, first: [i64; 2], seen: &Hole, holes: &[Hole]) -> [[f32; 4]; 4] {
        let along = |hole: &Hole, axis: usize| -> [f32; 4] {
            let h = f64::from(self.window.cell_size[axis]);
            std::array::from_fn(|i| hole.fade(axis, (first[axis] as f64 + i as f64 + 0.5) * h))
        };
        let product = |hole: &Hole| {
            let [x, z] = [0, 1].map(|axis| along(hole, axis));
            z.map(|z| x.map(|x| x * z))
        };
        let mut fades = product(seen);
        for hole in holes {
            for (fade, cut) in fades.as_flattened_mut().iter_mut().zip(product(hole).as_flattened()) {
                *fade *= (1.0 - hole.gain() * cut).max(0.0);
            }
        }
        fades
    }

    /// Age in seconds and standard deviation in metres of what [`Self::sample`] answers at a point; `None` where it answers
    /// that there is nothing.
    pub(crate) fn doubt(&self, point: Vec2, seen: &Hole) -> Option<[f32; 2]> {
        let (first, _) = self.stencil(point)?;
        let cell = first.map(|first| first + 1);
        let fade = (0..2).map(|k| seen.fade(k, (cell[k] as f64 + 0.5) * f64::from(self.window.cell_size[k])));
        let fade: f32 = fade.product();
        let age = self.now.saturating_sub(self.copies[0].tick) as f32 * self.dt;
        (fade > 0.0).then(|| [age, fade * self.judge.error(cell, self.carries[0].growth)])
    }
}

/// Heights of three moments, cell by cell.
struct Moments<'a> {
    copies: &'a [Copy; 2],
    carries: &'a [Carry; 2],
    cells: [u32; 2],
}

impl Moments<'_> {
    /// The heights of N cells of a row from a world cell on, and how they are carried on. The cells are the newest copy's.
    fn cells_from<const N: usize>(&self, world: [i64; 2]) -> ([[f32; 3]; N], &Carry) {
        let [newest, older] = self.copies;
        let nx = self.cells[0] as usize;
        let [x, z] = [0, 1].map(|k| (world[k] - newest.corner[k]) as usize);
        let [now, before] = newest.heights.each_ref().map(|heights| &heights[z * nx + x..][..N]);
        // In the window then as now, or of no use.
        let [x, z] = [0, 1].map(|k| world[k].saturating_sub(older.corner[k]));
        let held = self.carries[0] != self.carries[1]
            && (0..=i64::from(self.cells[0]) - N as i64).contains(&x)
            && (0..i64::from(self.cells[1])).contains(&z);
        let third = if held {
            let heights = &older.heights[usize::from(older.tick + 1 == newest.tick)];
            &heights[z as usize * nx + x as usize..][..N]
        } else {
            before
        };
        (std::array::from_fn(|i| [now[i], before[i], third[i]]), &self.carries[usize::from(!held)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wave_grid::{GridDesc, WaveGrid};

    const DT: f32 = 1.0 / 60.0;

    /// A wave that swings up and down everywhere, and what a window of it shows.
    struct Swing {
        mirror: Mirror,
        seen: Hole,
        omega: f32,
    }

    impl Swing {
        fn new(omega: f32) -> Self {
            let desc = GridDesc { cells: [96, 64], cell_size: [0.5; 2], ..GridDesc::default() };
            let seen = WaveGrid::new(desc).unwrap().hole(1.0);
            Self { mirror: Mirror::new(desc.cells, desc.cell_size, DT), seen, omega }
        }

        fn height(&self, tick: u64, x: f32) -> f32 {
            0.3 * (self.omega * tick as f32 * DT - 0.6 * x).sin()
        }

        fn copy(&mut self, tick: u64, corner: [i64; 2]) {
            let heights = [tick, tick - 1].map(|tick| -> Vec<f32> {
                let x = |at: usize| (corner[0] as f32 + (at % 96) as f32 + 0.5) * 0.5;
                (0..96 * 64).map(|at| self.height(tick, x(at))).collect()
            });
            self.mirror.take(tick, corner, |out| {
                out.into_iter().zip(heights).for_each(|(out, heights)| *out = heights);
                true
            });
        }

        fn sample(&self, point: Vec2) -> GridSample {
            let mut out = [GridSample::default()];
            self.mirror.sample(&[point], &self.seen, &[], &mut out);
            out[0]
        }
    }

    const CORNER: [i64; 2] = [-48, -32];

    #[test]
    fn waves_are_carried_on_to_the_last_tick() {
        let mut swing = Swing::new(5.0);
        assert_eq!((swing.sample(Vec2::ZERO), swing.mirror.tick()), (GridSample::default(), None));
        for (tick, corner) in [(10, CORNER), (12, [-47, -32])] {
            swing.copy(tick, corner);
        }
        swing.mirror.follow(18);
        for x in [-3.0, 0.2, 5.3] {
            let (found, truth) = (swing.sample(Vec2::new(x, 1.0)), swing.height(18, x));
            assert!((found.height - truth).abs() < 0.02, "{x}: {found:?}, {truth}");
            let rate = (truth - swing.height(17, x)) / DT;
            assert!((found.vertical_velocity - rate).abs() < 0.25, "{x}: {found:?}, {rate}");
            let slope = (swing.height(18, x + 0.01) - truth) / 0.01;
            assert!((found.slope - Vec2::X * slope).length() < 0.03, "{x}: {found:?}, {slope}");
        }
        // Outside, and nowhere.
        for point in [Vec2::new(23.4, 0.0), Vec2::splat(f32::NAN), Vec2::splat(f32::INFINITY)] {
            assert_eq!(swing.sample(point), GridSample::default());
            assert_eq!(swing.mirror.doubt(point, &swing.seen), None);
        }
        // Over a copy that came twice or too late nothing changes.
        swing.copy(11, CORNER);
        assert_eq!(swing.mirror.tick(), Some(12));
        swing.mirror.still();
        swing.copy(12, CORNER);
        assert_eq!(swing.mirror.tick(), None);
    }

    #[test]
    fn the_error_is_as_expected() {
        for (omega, lag) in [(3.0, 6), (6.0, 6), (6.0, 3), (4.0, 12)] {
            let mut swing = Swing::new(omega);
            let points: Vec<Vec2> = (0..60).map(|i| Vec2::new(-9.0 + 0.3 * i as f32, 2.0)).collect();
            let (mut errors, mut expected) = (0.0, 0.0);
            for tick in 2..200 {
                if tick > lag {
                    swing.copy(tick - lag, CORNER);
                }
                swing.mirror.follow(tick);
                if tick > 60 {
                    for point in &points {
                        errors += (swing.sample(*point).height - swing.height(tick, point.x)).powi(2);
                        let [age, error] = swing.mirror.doubt(*point, &swing.seen).unwrap();
                        assert!((age - lag as f32 * DT).abs() < 1e-6);
                        expected += error * error;
                    }
                }
            }
            let ratio = (expected / errors).sqrt();
            assert!((0.7..1.4).contains(&ratio), "{omega} {lag}: {ratio}");
        }
    }

    #[test]
    fn what_comes_no_more_stays_bounded() {
        let mut swing = Swing::new(9.0);
        (10..20).for_each(|tick| swing.copy(tick, CORNER));
        for tick in 20..400 {
            swing.mirror.follow(tick);
            let sample = swing.sample(Vec2::new(1.0, 1.0));
            let [_, error] = swing.mirror.doubt(Vec2::new(1.0, 1.0), &swing.seen).unwrap();
            assert!(sample.height.abs() < 0.5 && error < 0.5, "{tick}: {sample:?} {error}");
            if tick > 60 {
                assert!((sample.height - swing.height(19, 1.0)).abs() < 0.03 && sample.vertical_velocity == 0.0);
            }
        }
    }
}
