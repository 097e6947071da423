//! The heights of a GPU-homed grid as they came back to the CPU, carried on to the last tick.

use glam::{DVec2, Vec2};
use open_water_shaders::cubic::{slopes, weights};
use wave_grid::{GridSample, Hole, Window};

use super::carry::{Carry, most, sum as weigh};
use super::copies::{Carried, Copy, Value, stencil};
use super::hulls::{Hull, Hulls};
use super::judge::Judge;

/// See the module.
pub(crate) struct Mirror {
    carried: Carried,
    /// World place of the local origin, metres.
    pub(crate) origin: DVec2,
    dt: f32,
    /// How many copies show anything.
    known: usize,
    /// The newest that was ever taken.
    taken: Option<u64>,
    /// The last tick.
    now: u64,
    judge: Judge,
}

/// Limit over the largest height of the newest copy.
const LIMIT: f32 = 1.5;

impl Mirror {
    /// Of a grid that ticks every `dt` seconds.
    pub(crate) fn new(cells: [u32; 2], cell_size: [f32; 2], dt: f32) -> Self {
        let copy = || Copy { tick: 0, corner: [0; 2], heights: Default::default() };
        Self {
            carried: Carried {
                copies: [copy(), copy()],
                carries: [Carry::new(0, None, dt); 2],
                hulls: Hulls::default(),
                window: Window { corner: [0; 2], cells, cell_size },
                limit: 0.0,
            },
            origin: DVec2::ZERO,
            dt,
            known: 0,
            taken: None,
            now: 0,
            judge: Judge::new(cells),
        }
    }

    /// The tick of the newest copy; `None` while nothing is known.
    pub(crate) fn tick(&self) -> Option<u64> {
        (self.known > 0).then_some(self.carried.copies[0].tick)
    }

    /// Takes a copy of the heights after `tick` if it is newer than all before: `fill` writes them and those of the tick
    /// before as cells of the window at `corner`, and returns whether it could.
    pub(crate) fn take(&mut self, tick: u64, corner: [i64; 2], fill: impl FnOnce([&mut Vec<f32>; 2]) -> bool) {
        if self.taken.is_some_and(|taken| taken >= tick) {
            return;
        }
        self.taken = Some(tick);
        let [newest, older] = &mut self.carried.copies;
        std::mem::swap(newest, older);
        (newest.tick, newest.corner) = (tick, corner);
        self.carried.window.corner = corner;
        let [now, before] = &mut newest.heights;
        if !fill([now, before]) {
            self.still();
            return;
        }
        self.known = (self.known + 1).min(2);
        self.carried.limit = LIMIT * now.iter().fold(0.0f32, |most, height| most.max(height.abs()));
        self.judge.measure(tick, &self.carried.window, &self.carried.copies[0].heights[0]);
    }

    /// The grid sleeps, or begins anew: whatever came back last is over.
    pub(crate) fn still(&mut self) {
        self.known = 0;
        self.judge.forget();
    }

    /// Tick number `now` has run, and these hulls were in the grid: samples are of its end from here on.
    pub(crate) fn follow(&mut self, now: u64, hulls: &[Hull]) {
        self.now = now;
        self.carried.hulls.go(now, hulls);
        let Some(newest) = self.tick() else { return };
        let carried = &mut self.carried;
        let age = now.saturating_sub(newest);
        let older = (self.known > 1).then(|| (newest - carried.copies[1].tick).max(2));
        let older = older.filter(|older| *older <= most(self.dt));
        carried.carries = [older, None].map(|older| Carry::new(age, older, self.dt));
        if let Some(older) = older {
            carried.hulls.carry(age, older, self.dt, carried.window.cell_size);
        }
        let nx = carried.window.cells[0] as usize;
        self.judge.expect(now, &carried.window, carried.carries[0].growth, |at| carried.height([at % nx, at / nx]));
    }

    /// Answers at local points, as `grid_at` in `wgsl/shared/surface.wgsl` does for what is drawn: `seen` is what the grid
    /// shows, `holes` are cut out of it.
    pub(crate) fn sample(&self, points: &[Vec2], seen: &Hole, holes: &[Hole], out: &mut [GridSample]) {
        for (point, out) in points.iter().zip(out) {
            *out = self.sample_one(*point, seen, holes).unwrap_or_default();
        }
    }

    /// World place of a local point, and its 4 x 4 cells in the newest copy; `None` where that has none.
    fn stencil(&self, point: Vec2) -> Option<(DVec2, [usize; 2], Vec2)> {
        let place = self.origin + point.as_dvec2();
        let (first, t) = stencil(&self.carried.window, place).filter(|_| self.known > 0)?;
        Some((place, first, t))
    }

    fn sample_one(&self, point: Vec2, seen: &Hole, holes: &[Hole]) -> Option<GridSample> {
        let carried = &self.carried;
        let (place, first, t) = self.stencil(point)?;
        let (wx, wz, dx, dz) = (weights(t.x), weights(t.y), slopes(t.x), slopes(t.y));
        let fades = self.fades(self.world(first), seen, holes);
        let (mut sum, mut shown) = (Value::default(), Value::default());
        for (j, fades) in fades.into_iter().enumerate() {
            let (heights, carry) = carried.cells_from::<4>([first[0], first[1] + j]);
            for (i, (heights, fade)) in heights.into_iter().zip(fades).enumerate() {
                let height = fade * weigh(heights, carry.value).clamp(-carried.limit, carried.limit);
                let (weight, slope) = (wx[i] * wz[j], Vec2::new(dx[i] * wz[j], wx[i] * dz[j]));
                sum.height += weight * height;
                sum.slope += slope * height;
                sum.rate += weight * fade * weigh(heights, carry.rate);
                shown.height += weight * fade;
                shown.slope += slope * fade;
            }
        }
        let cell = Vec2::from(self.carried.window.cell_size);
        sum.slope /= cell;
        if let Some((share, moved)) = carried.moved(place) {
            let slope = shown.height * moved.slope + moved.height * shown.slope / cell;
            sum.height += share * (shown.height * moved.height - sum.height);
            sum.slope += share * (slope - sum.slope);
            sum.rate += share * (shown.height * moved.rate - sum.rate);
        }
        Some(GridSample { height: sum.height, slope: sum.slope, vertical_velocity: sum.rate })
    }

    /// World index of a cell of the newest copy.
    fn world(&self, cell: [usize; 2]) -> [i64; 2] {
        [0, 1].map(|k| self.carried.copies[0].corner[k] + cell[k] as i64)
    }

    /// How much of each of 4 x 4 cells is seen, row by row.
    fn fades(&self, first: [i64; 2], seen: &Hole, holes: &[Hole]) -> [[f32; 4]; 4] {
        let along = |hole: &Hole, axis: usize| -> [f32; 4] {
            let h = f64::from(self.carried.window.cell_size[axis]);
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
        let (_, first, _) = self.stencil(point)?;
        let cell = self.world(first).map(|first| first + 1);
        let fade = (0..2).map(|k| seen.fade(k, (cell[k] as f64 + 0.5) * f64::from(self.carried.window.cell_size[k])));
        let fade: f32 = fade.product();
        let age = self.now.saturating_sub(self.carried.copies[0].tick) as f32 * self.dt;
        (fade > 0.0).then(|| [age, fade * self.judge.error(cell, self.carried.carries[0].growth)])
    }
}

#[cfg(test)]
mod tests;
