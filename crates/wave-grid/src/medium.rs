//! What the water of a grid lies in: wave speed, damping and walls, given by the host as a function of the place.

use std::sync::Arc;

use glam::{DVec2, Vec2};

use crate::dispersive::{DEEP, Table};
use crate::{GridDesc, Stepping};

/// What a cell is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CellKind {
    /// Water.
    #[default]
    Open,
    /// A reflecting wall: nothing flows through its faces.
    Wall,
    /// Water held at height zero, which reflects with the opposite sign.
    Fixed,
}

/// The medium of one cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MediumCell {
    /// Wave speed, m/s. At most the grid's [`GridDesc::wave_speed`], more counts as that; an open cell whose speed is
    /// not above zero is a wall.
    pub speed: f32,
    /// Damping sigma, 1/s, added to the grid's own: 0 to 10^6, anything else counts as the nearer of the two.
    pub damping: f32,
    /// Water or wall.
    pub kind: CellKind,
    /// Current that carries waves, m/s. Along either axis at most half a cell per sub-step counts: 0.6 of
    /// [`GridDesc::wave_speed`] or more. Within four cells of a wall
    /// less does. What is not finite counts as still. It fades to zero in 24 cells before the border layer.
    pub current: Vec2,
    /// Depth of the water, metres: what [`crate::Scheme::Dispersive`] reads instead of the speed. There an open cell whose
    /// depth is not above zero is a wall.
    pub depth: f32,
}

impl Default for MediumCell {
    /// Open deep water.
    fn default() -> Self {
        Self { speed: f32::INFINITY, depth: f32::INFINITY, damping: 0.0, kind: CellKind::Open, current: Vec2::ZERO }
    }
}

/// The medium of the whole world. Cells read it at their centres as they enter a window.
pub trait Medium: Send + Sync {
    /// The medium at a world place (x, z), for a grid whose speed in deep water is `deep_speed`.
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell;

    /// Whether all water between two world corners is open, undamped, still and as fast as in deep water. Where it is, nothing
    /// is stored and the step costs what it does without a medium. `false` is always allowed.
    fn is_plain(&self, low: DVec2, high: DVec2, deep_speed: f32) -> bool;

    /// The same for [`crate::Scheme::Dispersive`]: whether all water between two world corners is open, undamped, still and at
    /// least `depth` metres deep. `false` is always allowed, and the default.
    fn is_deep(&self, low: DVec2, high: DVec2, depth: f32) -> bool {
        let _ = (low, high, depth);
        false
    }
}

/// A shared medium.
#[derive(Clone)]
pub(crate) struct SharedMedium(pub(crate) Arc<dyn Medium>);

impl std::fmt::Debug for SharedMedium {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Medium")
    }
}

/// Turns what a medium says into coefficients of a grid.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CellLaw {
    pub(crate) deep_speed: f32,
    pub(crate) cell_size: DVec2,
    /// `(c dt / h)^2` along x in deep water.
    a: f32,
    /// a along z over a along x.
    pub(crate) aspect: f32,
    half_dt: f32,
    damping: f32,
    /// Of a face's own jump and of the two beside it.
    pub(crate) weights: [f32; 2],
    /// dt / h along x and z.
    drift: Vec2,
    /// Of the dispersive scheme.
    pub(crate) table: Option<Arc<Table>>,
    /// Depth of the water that is plain, cells.
    depth: f32,
}

/// Coefficients of a cell: a = (c dt / h)^2 along x, at most 0 for walls; r = 1 / (1 + sigma dt / 2), 0 for what is not water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coefficient {
    pub(crate) a: f32,
    pub(crate) r: f32,
    /// Cells that the current moves in a sub-step.
    pub(crate) drift: Vec2,
    /// Depth in cells.
    pub(crate) depth: f32,
}

/// Most cells that a current moves in a sub-step.
pub(crate) const MOST_DRIFT: f32 = 0.5;

/// `a` of a wall that no water is within two cells of.
pub(crate) const DEEP_WALL: f32 = -1.0;
/// `a` of a wall beside water.
pub(crate) const NEAR_WALL: f32 = 0.0;

impl CellLaw {
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping, table: Option<Arc<Table>>) -> Self {
        let (straight, beside) = desc.scheme.weights();
        Self {
            table,
            depth: desc.depth / desc.cell_size[0],
            weights: [straight as f32, beside as f32],
            deep_speed: desc.wave_speed,
            cell_size: Vec2::from(desc.cell_size).as_dvec2(),
            a: stepping.a[0] as f32,
            aspect: stepping.aspect(),
            half_dt: (0.5 * stepping.dt) as f32,
            damping: desc.damping,
            drift: Vec2::from(desc.cell_size.map(|h| (stepping.dt / f64::from(h)) as f32)),
        }
    }

    /// Of open deep water.
    pub(crate) fn plain(&self) -> Coefficient {
        let a = if self.table.is_some() { self.a * self.depth.min(DEEP) } else { self.a };
        Coefficient { a, r: 1.0 / (1.0 + self.half_dt * self.damping), drift: Vec2::ZERO, depth: self.depth }
    }

    /// Whether the water between two world corners is as [`Self::plain`] says.
    pub(crate) fn is_plain(&self, medium: &dyn Medium, low: DVec2, high: DVec2) -> bool {
        match self.table {
            Some(_) => self.depth >= DEEP && medium.is_deep(low, high, DEEP * self.cell_size.x as f32),
            None => medium.is_plain(low, high, self.deep_speed),
        }
    }

    /// Of a world cell.
    pub(crate) fn cell(&self, medium: &dyn Medium, cell: [i64; 2]) -> Coefficient {
        let place = DVec2::new(cell[0] as f64 + 0.5, cell[1] as f64 + 0.5) * self.cell_size;
        let MediumCell { speed, damping, kind, current, depth } = medium.at(place, self.deep_speed);
        let depth = depth / self.cell_size.x as f32;
        // (c dt / h)^2 of the longest waves.
        let a = if self.table.is_some() {
            self.a * depth.min(DEEP)
        } else {
            let ratio = if speed < self.deep_speed { speed / self.deep_speed } else { 1.0 };
            self.a * ratio * ratio
        };
        // Also a speed or a depth that is NaN, negative or so low that nothing is left of `a`.
        let wet = a > 1e-12 && (self.table.is_some() || speed > 0.0);
        let damping = if damping > 0.0 { damping.min(1e6) } else { 0.0 };
        let current = if current.is_finite() { current } else { Vec2::ZERO };
        let drift = (current * self.drift).clamp(Vec2::splat(-MOST_DRIFT), Vec2::splat(MOST_DRIFT));
        match kind {
            CellKind::Open if wet => {
                Coefficient { a, r: 1.0 / (1.0 + self.half_dt * (self.damping + damping)), drift, depth }
            }
            CellKind::Fixed if wet => Coefficient { a, r: 0.0, drift: Vec2::ZERO, depth },
            CellKind::Fixed => Coefficient { r: 0.0, ..self.plain() },
            _ => Coefficient { a: DEEP_WALL, r: 0.0, drift: Vec2::ZERO, depth: 0.0 },
        }
    }
}
