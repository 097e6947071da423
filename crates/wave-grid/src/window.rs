//! Where a grid stands: whole world cells, and the fraction of a cell that only its fade knows.

use glam::{DVec2, Vec2};

use crate::feed::{Edges, contour};
use crate::{Border, GridDesc, desc::TILE};

/// How far, in cells, the target may stray from the middle of the window before it shifts: one cell keeps a bobbing
/// body from shifting the window to and fro.
pub(crate) const DEAD_BAND: f64 = 1.0;
/// The fade is zero this close to the edge (cells), so that a cubic kernel of two cells reads only zeros there.
const MARGIN: f64 = 3.0;
/// Cells over which the fade rises from a feed's contour: the farther from it, the more the waves of the grid, of another
/// dispersion, have come apart from those of the sea.
const FED_FADE: f64 = 4.0;
/// Cell indices beyond this are refused: f64 no longer resolves a cell there.
const FARTHEST: f64 = 1e14;

/// A rectangle of world cells. Cell (i, j) is centred at world ((corner.x + i + .5) h.x, (corner.z + j + .5) h.z).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Window {
    /// World index of cell (0, 0).
    pub corner: [i64; 2],
    /// Cells along x and z.
    pub cells: [u32; 2],
    /// Cell size h along x and z, metres.
    pub cell_size: [f32; 2],
}

impl Window {
    /// Cell size, metres.
    pub(crate) fn h(&self) -> DVec2 {
        Vec2::from(self.cell_size).as_dvec2()
    }

    /// World position of the corner, metres.
    pub fn world_corner(&self) -> DVec2 {
        DVec2::new(self.corner[0] as f64, self.corner[1] as f64) * self.h()
    }

    /// Position of the corner relative to `origin`, metres.
    pub fn local_corner(&self, origin: DVec2) -> Vec2 {
        let d = self.world_corner() - origin;
        Vec2::new(d.x as f32, d.y as f32)
    }

    /// A local point in units of cells from the corner; cell (i, j) covers [i, i + 1) x [j, j + 1).
    pub fn cells_from_corner(&self, point: Vec2, origin: DVec2) -> DVec2 {
        let corner = self.world_corner() - origin;
        (DVec2::new(f64::from(point.x), f64::from(point.y)) - corner) / self.h()
    }

    /// Cells of the window's first tile that lie before its corner, per axis; tiles stand on world multiples of 16.
    pub(crate) fn tile_offset(&self) -> [usize; 2] {
        self.corner.map(|c| c.rem_euclid(TILE as i64) as usize)
    }
}

/// What following a target asks of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Move {
    /// Nothing.
    Stay,
    /// Shift the contents so that cell i becomes cell i - shift.
    Shift([i64; 2]),
    /// Nothing of the old window remains.
    Clear,
}

/// A window with the place it leans to.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Place {
    pub(crate) window: Window,
    /// Target minus middle of the window, cells, within the dead-band.
    pub(crate) lean: [f64; 2],
    /// Extent without the border layer, cells.
    interior: [i64; 2],
    border: Border,
    /// Sides where the fade ends at the feed's contour.
    pub(crate) fed: Edges,
    /// The fade ends where the border layer begins.
    pub(crate) nested: bool,
}

impl Place {
    /// A window whose middle is the world's origin.
    pub(crate) fn new(desc: &GridDesc) -> Self {
        let rim = 2 * (i64::from(desc.border.width()) + 1);
        let window =
            Window { corner: desc.cells.map(|n| -(i64::from(n) / 2)), cells: desc.cells, cell_size: desc.cell_size };
        let interior = desc.cells.map(|n| i64::from(n) - rim);
        let mut place =
            Self { window, lean: [0.0; 2], interior, border: desc.border, fed: Edges::default(), nested: false };
        place.lean = place.stray(DVec2::ZERO);
        place
    }

    /// A local point in units of cells from the corner, within the window where that repeats.
    pub(crate) fn cell_of(&self, point: Vec2, origin: DVec2) -> DVec2 {
        let at = self.window.cells_from_corner(point, origin);
        if self.border != Border::Periodic {
            return at;
        }
        // The four cells around it are then within the window, ring included.
        let period = self.period();
        at - ((at - 1.5) / period).floor() * period
    }

    /// Cells after which a window that repeats does.
    pub(crate) fn period(&self) -> DVec2 {
        DVec2::new(f64::from(self.window.cells[0]), f64::from(self.window.cells[1])) - 2.0
    }

    /// Whether it is a place for the same window as another, and none that is absurd.
    pub(crate) fn is_one_of(&self, other: &Self) -> bool {
        let Self { window, lean, interior, border, fed: _, nested: _ } = self;
        let near = window.corner.iter().all(|corner| corner.unsigned_abs() <= FARTHEST as u64);
        near && lean.iter().all(|lean| lean.is_finite())
            && (window.cells, window.cell_size) == (other.window.cells, other.window.cell_size)
            && (interior, border) == (&other.interior, &other.border)
    }

    fn stray(&self, target: DVec2) -> [f64; 2] {
        let at = (target / self.window.h()).to_array();
        std::array::from_fn(|k| at[k] - (self.window.corner[k] as f64 + f64::from(self.window.cells[k]) / 2.0))
    }

    /// Brings the middle within the dead-band of a world point. Points that are not finite or absurdly far are ignored.
    pub(crate) fn follow(&mut self, target: DVec2) -> Move {
        if self.border == Border::Periodic {
            return Move::Stay;
        }
        let stray = self.stray(target);
        if !stray.iter().all(|s| s.is_finite()) || (target / self.window.h()).abs().max_element() > FARTHEST {
            return Move::Stay;
        }
        let shift: [i64; 2] = std::array::from_fn(|k| {
            let beyond = (stray[k].abs() - DEAD_BAND).max(0.0).ceil() as i64;
            if stray[k] < 0.0 { -beyond } else { beyond }
        });
        if shift == [0; 2] {
            self.lean = stray;
            return Move::Stay;
        }
        let far = (0..2).any(|k| shift[k].abs() >= self.interior[k]);
        for k in 0..2 {
            self.window.corner[k] += if far { stray[k].round() as i64 } else { shift[k] };
        }
        self.lean = self.stray(target);
        if far { Move::Clear } else { Move::Shift(shift) }
    }

    /// Fade at each cell centre along one axis: 1 inside, 0 within three cells of the edge wherever the window leans.
    /// The fade of a cell is the product of both axes'.
    pub(crate) fn fade(&self, axis: usize, out: &mut [f32]) {
        for (i, f) in out.iter_mut().enumerate() {
            *f = self.fade_of(axis, i as f64 + 0.5);
        }
    }

    /// One axis' factor of the fade at a place in cells from the corner.
    pub(crate) fn fade_of(&self, axis: usize, x: f64) -> f32 {
        if self.border.has_ring() {
            return 1.0;
        }
        let [middle, outer] = self.fade_reach(axis);
        let cells = f64::from(self.window.cells[axis]);
        let [fed_low, fed_high] = self.fed.of(axis);
        let contour = contour(self.border.width()) as f64;
        let low = if fed_low { contour } else { middle - outer };
        let high = if fed_high { cells - contour } else { middle + outer };
        let width = |fed: bool| if fed { FED_FADE } else { self.fade_width() };
        let t = ((x - low) / width(fed_low)).min((high - x) / width(fed_high)).clamp(0.0, 1.0);
        // NaN outside.
        if t > 0.0 { (t * t * (3.0 - 2.0 * t)) as f32 } else { 0.0 }
    }

    /// Middle of the fade (cells from the corner) and the distance from it where it reaches zero.
    pub(crate) fn fade_reach(&self, axis: usize) -> [f64; 2] {
        let half = f64::from(self.window.cells[axis]) / 2.0;
        let margin = if self.nested { MARGIN.max(self.fade_width() + 1.0) } else { MARGIN };
        [half + self.lean[axis], half - margin - DEAD_BAND]
    }

    /// Cells over which the fade rises.
    pub(crate) fn fade_width(&self) -> f64 {
        f64::from(self.border.width())
    }
}
