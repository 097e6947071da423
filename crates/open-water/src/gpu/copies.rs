//! Copies of a grid's heights as they came back, and what they are carried on to.

use glam::{DVec2, Vec2};
use open_water_shaders::cubic::{slopes, weights};
use wave_grid::Window;

use super::carry::{Carry, sum};
use super::hulls::Hulls;

/// Heights after a tick and after the one before, of the cells of a window.
#[derive(Debug)]
pub(super) struct Copy {
    pub(super) tick: u64,
    pub(super) corner: [i64; 2],
    /// Without fade.
    pub(super) heights: [Vec<f32>; 2],
}

/// Of the water in a place: metres, metres per metre, metres a second.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Value {
    pub(super) height: f32,
    pub(super) slope: Vec2,
    pub(super) rate: f32,
}

/// First of 4 x 4 cells of a window around a world place, from its corner, and the place between the middle ones.
pub(super) fn stencil(window: &Window, place: DVec2) -> Option<([usize; 2], Vec2)> {
    let corner = DVec2::new(window.corner[0] as f64, window.corner[1] as f64);
    let at = place / Vec2::from(window.cell_size).as_dvec2() - corner - 0.5;
    let base = at.floor();
    let inside = |x: f64, n: u32| x >= 1.0 && x <= f64::from(n) - 3.0;
    let all = inside(base.x, window.cells[0]) && inside(base.y, window.cells[1]);
    all.then(|| ([base.x as usize - 1, base.y as usize - 1], (at - base).as_vec2()))
}

/// Heights of one moment.
pub(super) struct Field<'a> {
    window: Window,
    heights: &'a [f32],
}

impl Field<'_> {
    /// Height and slope at a world place.
    pub(super) fn at(&self, place: DVec2) -> Option<Value> {
        let ([x, z], t) = stencil(&self.window, place)?;
        let (wx, wz, dx, dz) = (weights(t.x), weights(t.y), slopes(t.x), slopes(t.y));
        let nx = self.window.cells[0] as usize;
        let mut value = Value::default();
        for j in 0..4 {
            for (i, height) in self.heights[(z + j) * nx + x..][..4].iter().enumerate() {
                value.height += wx[i] * wz[j] * height;
                value.slope += Vec2::new(dx[i] * wz[j], wx[i] * dz[j]) * *height;
            }
        }
        value.slope /= Vec2::from(self.window.cell_size);
        Some(value)
    }
}

/// Heights of three moments, and how they are carried on.
pub(super) struct Carried {
    /// The newest first; older ones are kept for their memory.
    pub(super) copies: [Copy; 2],
    /// How the newest is carried on with the older one, and where that has no heights.
    pub(super) carries: [Carry; 2],
    pub(super) hulls: Hulls,
    /// The newest copy's.
    pub(super) window: Window,
    /// Heights that are carried on stay within this, metres.
    pub(super) limit: f32,
}

impl Carried {
    /// The older copy's heights that are taken: two ticks back at least.
    fn older(&self) -> &[f32] {
        let [newest, older] = &self.copies;
        &older.heights[usize::from(older.tick + 1 == newest.tick)]
    }

    /// The heights of N cells of a row of the window, and how they are carried on.
    pub(super) fn cells_from<const N: usize>(&self, [x, z]: [usize; 2]) -> ([[f32; 3]; N], &Carry) {
        let [newest, older] = &self.copies;
        let cells = self.window.cells.map(|n| n as usize);
        let [now, before] = newest.heights.each_ref().map(|heights| &heights[z * cells[0] + x..][..N]);
        // In the window then as now, or of no use.
        let then = |k: usize, at: usize| (newest.corner[k] + at as i64).saturating_sub(older.corner[k]);
        let [x, z] = [then(0, x), then(1, z)];
        let held = self.carries[0] != self.carries[1]
            && (0..=cells[0] as i64 - N as i64).contains(&x)
            && (0..cells[1] as i64).contains(&z);
        let third = if held { &self.older()[z as usize * cells[0] + x as usize..][..N] } else { before };
        (std::array::from_fn(|i| [now[i], before[i], third[i]]), &self.carries[usize::from(!held)])
    }

    /// How much of the water at a world place moves along with a hull, and what is expected of that.
    pub(super) fn moved(&self, place: DVec2) -> Option<(f32, Value)> {
        let (share, frame) = self.hulls.around(place)?;
        let field = |corner, heights| Field { window: Window { corner, ..self.window }, heights };
        let [newest, older] = &self.copies;
        let fields = [field(newest.corner, newest.heights[0].as_slice()), field(older.corner, self.older())];
        let mut value = frame.value(place, fields)?;
        value.height = value.height.clamp(-self.limit, self.limit);
        Some((share, value))
    }

    /// What is expected of a cell of the window.
    pub(super) fn height(&self, cell: [usize; 2]) -> f32 {
        let ([heights], carry) = self.cells_from(cell);
        let height = sum(heights, carry.value).clamp(-self.limit, self.limit);
        let h = Vec2::from(self.window.cell_size).as_dvec2();
        let world = |k: usize| (self.window.corner[k] + cell[k] as i64) as f64 + 0.5;
        let moved = self.moved(DVec2::new(world(0), world(1)) * h);
        moved.map_or(height, |(share, value)| height + share * (value.height - height))
    }
}
