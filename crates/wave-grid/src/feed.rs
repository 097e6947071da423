//! Waves fed into a grid through sides of its window: total field inside a contour, scattered field outside.
//!
//! The contour runs between two rows of cells just inside the border layer. Inside it the grid holds all waves, outside
//! only what the inside sends back, which leaves through the layer. A cell beside the contour reads cells of the other
//! kind: their incident height is added or taken away, with the very coefficients of the step, so waves that solve the
//! discrete scheme enter without a trace outside. Feeds are meant for grids that stand still.
//!
//! Give all fed sides the same waves, those that leave included: then the contour cuts off nothing. Towards a side that
//! is not fed a line's waves are tapered within the layer; a wave that crosses the end of a line bends round it.

use crate::desc::GridDesc;
use crate::ground::Cells;
use crate::source::HEIGHT_LIMIT;
use crate::{Stepping, Window, cpu::tiles::Tiles};

/// Sides of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Edges {
    /// The side of least x.
    pub low_x: bool,
    /// The side of greatest x.
    pub high_x: bool,
    /// The side of least z.
    pub low_z: bool,
    /// The side of greatest z.
    pub high_z: bool,
}

impl Edges {
    /// Whether there is one.
    pub fn any(self) -> bool {
        self.low_x || self.high_x || self.low_z || self.high_z
    }

    /// (low, high) of an axis.
    pub(crate) fn of(self, axis: usize) -> [bool; 2] {
        if axis == 0 { [self.low_x, self.high_x] } else { [self.low_z, self.high_z] }
    }
}

/// A side of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The side of least x.
    LowX,
    /// The side of greatest x.
    HighX,
    /// The side of least z.
    LowZ,
    /// The side of greatest z.
    HighZ,
}

/// Where incident heights are asked for: two rows of cell centres along one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedLine {
    /// The side.
    pub side: Side,
    /// World coordinate, across the side, of the row outside the contour and of the row inside, metres.
    pub across: [f64; 2],
    /// World coordinate, along the side, of the first point, metres.
    pub first: f64,
    /// Distance between points, metres: the cell size along the side.
    pub step: f64,
    /// How many points a row has.
    pub count: usize,
    /// Mean wave speed of the open cells along the inner row, m/s; that of deep water when there are none.
    pub speed: f64,
}

/// Distance of the contour from the window's edge, cells.
pub(crate) fn contour(width: u32) -> usize {
    width as usize + 3
}

/// One line with the coefficients that carry one row's heights to the other.
#[derive(Debug, Clone)]
struct Line {
    public: FeedLine,
    /// First cell of the outer and of the inner row, and the distance between two cells of a row.
    rows: [usize; 2],
    step: usize,
    /// Per point of the outer and of the inner row: factors on the heights of the three points opposite.
    factors: [Vec<[f32; 3]>; 2],
    /// Incident heights, outer and inner row.
    heights: [Vec<f32>; 2],
}

/// What a grid with fed sides keeps.
#[derive(Debug, Clone)]
pub(crate) struct Feed {
    pub(crate) edges: Edges,
    lines: Vec<Line>,
}

/// Answers with incident heights, see [`crate::WaveGrid::tick_fed`]: index of the line, sub-step, heights at the points
/// outside the contour and inside.
pub type Incident<'a> = dyn FnMut(usize, u32, [&mut [f32]; 2]) + 'a;

impl Feed {
    pub(crate) fn new(
        edges: Edges,
        desc: &GridDesc,
        stepping: &Stepping,
        window: &Window,
        cells: Option<&Cells>,
    ) -> Self {
        let size = desc.cells.map(|n| n as usize);
        let at = contour(desc.border.width());
        // First and last cell that holds the total field, per axis.
        let inside: [[usize; 2]; 2] = std::array::from_fn(|k| {
            let [low, high] = edges.of(k);
            [if low { at } else { 1 }, if high { size[k] - at - 1 } else { size[k] - 2 }]
        });
        let scheme = Scheme { nx: size[0], desc, stepping, cells };
        let sides = [
            (Side::LowX, edges.low_x),
            (Side::HighX, edges.high_x),
            (Side::LowZ, edges.low_z),
            (Side::HighZ, edges.high_z),
        ];
        let lines = sides.into_iter().filter(|(_, fed)| *fed).map(|(side, _)| {
            let (axis, high) = match side {
                Side::LowX => (0, false),
                Side::HighX => (0, true),
                Side::LowZ => (1, false),
                Side::HighZ => (1, true),
            };
            scheme.line(side, axis, high, inside, edges, window)
        });
        Self { edges, lines: lines.collect() }
    }

    pub(crate) fn lines(&self) -> impl Iterator<Item = FeedLine> + '_ {
        self.lines.iter().map(|line| line.public)
    }

    /// Asks for the incident heights of a sub-step. What is not finite counts as zero.
    pub(crate) fn ask(&mut self, incident: &mut Incident, substep: u32) {
        for (index, line) in self.lines.iter_mut().enumerate() {
            let [outer, inner] = &mut line.heights;
            incident(index, substep, [outer, inner]);
            for z in outer.iter_mut().chain(inner) {
                *z = if z.is_finite() { z.clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT) } else { 0.0 };
            }
        }
    }

    /// Keeps the tiles awake that are to be fed.
    pub(crate) fn wake(&self, tiles: &mut Tiles, nx: usize) {
        for line in &self.lines {
            for (row, heights) in line.rows.iter().zip(&line.heights) {
                for (k, z) in heights.iter().enumerate().filter(|(_, z)| **z != 0.0) {
                    let at = row + k * line.step;
                    let tile = tiles.of(1, at / nx) * tiles.count[0] + tiles.of(0, at % nx);
                    tiles.tiles[tile].height = tiles.tiles[tile].height.max(z.abs());
                }
            }
        }
    }

    /// Corrects heights that a sub-step has just made of fields of both kinds.
    pub(crate) fn correct(&self, z: &mut [f32]) {
        for line in &self.lines {
            for (row, sign) in [(0, -1.0f32), (1, 1.0)] {
                let opposite = &line.heights[1 - row];
                for (k, f) in line.factors[row].iter().enumerate() {
                    let before = if k > 0 { opposite[k - 1] } else { 0.0 };
                    let after = opposite.get(k + 1).copied().unwrap_or(0.0);
                    let sum = f[0] * before + f[1] * opposite[k] + f[2] * after;
                    z[line.rows[row] + k * line.step] += sign * sum;
                }
            }
        }
    }
}

/// The scheme's coefficients between cells.
struct Scheme<'a> {
    nx: usize,
    desc: &'a GridDesc,
    stepping: &'a Stepping,
    cells: Option<&'a Cells>,
}

impl Scheme<'_> {
    fn line(
        &self,
        side: Side,
        axis: usize,
        high: bool,
        inside: [[usize; 2]; 2],
        edges: Edges,
        window: &Window,
    ) -> Line {
        let along = 1 - axis;
        let inner = inside[axis][usize::from(high)];
        let outer = if high { inner + 1 } else { inner - 1 };
        let [first, last] = [inside[along][0] - 1, inside[along][1] + 1];
        let size = self.desc.cells[along] as usize;
        // Towards a side that is not fed, waves cease within its layer.
        let taper = |k: usize| {
            let cell = first + k;
            let t = (cell.min(size - 1 - cell) as f64 / f64::from(self.desc.border.width() + 1)).min(1.0);
            (t * t * (3.0 - 2.0 * t)) as f32
        };
        let cell = |across: usize, k: usize| if axis == 0 { [across, first + k] } else { [first + k, across] };
        let holds_total = |[i, j]: [usize; 2]| {
            (inside[0][0]..=inside[0][1]).contains(&i) && (inside[1][0]..=inside[1][1]).contains(&j)
        };
        // Pairs of cells that cross two contours belong to the one across x.
        let corner = |p: [usize; 2], q: [usize; 2]| {
            let before = p[0].min(q[0]);
            axis == 1
                && p[0] != q[0]
                && (edges.low_x && before + 1 == inside[0][0] || edges.high_x && before == inside[0][1])
        };
        let count = last - first + 1;
        let factors = [(outer, inner), (inner, outer)].map(|(own, opposite)| {
            let factor = |k: usize, to: isize| {
                let Some(other) = k.checked_add_signed(to).filter(|other| *other < count) else { return 0.0 };
                let (p, q) = (cell(own, k), cell(opposite, other));
                if holds_total(p) == holds_total(q) || corner(p, q) { 0.0 } else { taper(other) * self.coupling(p, q) }
            };
            (0..count).map(|k| [factor(k, -1), factor(k, 0), factor(k, 1)]).collect()
        });
        let h = self.desc.cell_size.map(f64::from);
        let world = |axis: usize, cell: usize| (window.corner[axis] as f64 + cell as f64 + 0.5) * h[axis];
        let at = |across: usize| cell(across, 0)[1] * self.nx + cell(across, 0)[0];
        let step = if axis == 0 { self.nx } else { 1 };
        Line {
            public: FeedLine {
                side,
                across: [world(axis, outer), world(axis, inner)],
                first: world(along, first),
                step: h[along],
                count,
                speed: self.mean_speed((0..count).map(|k| at(inner) + k * step)),
            },
            rows: [at(outer), at(inner)],
            step,
            factors,
            heights: [vec![0.0; count], vec![0.0; count]],
        }
    }

    fn mean_speed(&self, cells: impl Iterator<Item = usize>) -> f64 {
        let deep = f64::from(self.desc.wave_speed);
        let Some(medium) = self.cells else { return deep };
        let (mut sum, mut count) = (0.0, 0.0);
        for at in cells.filter(|at| medium.is_open(*at)) {
            sum += deep * (f64::from(medium.a[at]) / self.stepping.a[0]).sqrt();
            count += 1.0;
        }
        if count > 0.0 { sum / count } else { deep }
    }

    /// By how much the height of cell `q`, one of the eight neighbours of `p`, changes that of `p` in a sub-step.
    fn coupling(&self, p: [usize; 2], q: [usize; 2]) -> f32 {
        let nx = self.nx;
        let (straight, beside) = self.desc.scheme.weights();
        let (across_x, across_z) = (p[0] != q[0], p[1] != q[1]);
        let Some(cells) = self.cells else {
            let [ax, az] = self.stepping.a.map(|a| a / (1.0 + 0.5 * f64::from(self.desc.damping) * self.stepping.dt));
            return match (across_x, across_z) {
                (true, true) => (ax + az) * beside,
                (true, false) => ax * straight - az * 2.0 * beside,
                _ => az * straight - ax * 2.0 * beside,
            } as f32;
        };
        let [x, z] = &cells.faces;
        let [at, other] = [p, q].map(|[i, j]| j * nx + i);
        let lesser = |faces: &[f32], a: usize, b: usize| f64::from(faces[a].min(faces[b]));
        // The faces of p and of q's row or column that lie between the two.
        let face_x = at + usize::from(q[0] > p[0]);
        let face_z = at + if q[1] > p[1] { nx } else { 0 };
        let weight = match (across_x, across_z) {
            (true, true) => {
                beside
                    * (lesser(x, face_x, if q[1] > p[1] { face_x + nx } else { face_x - nx })
                        + lesser(z, face_z, if q[0] > p[0] { face_z + 1 } else { face_z - 1 }))
            }
            (true, false) => {
                f64::from(cells.own[0][face_x]) - beside * (lesser(z, at, other) + lesser(z, at + nx, other + nx))
            }
            _ => f64::from(cells.own[1][face_z]) - beside * (lesser(x, at, other) + lesser(x, at + 1, other + 1)),
        };
        cells.r[at] * weight as f32
    }
}
