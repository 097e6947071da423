//! Tiles of 16 x 16 cells on world multiples of 16, and which of them are stepped.
//!
//! A tile is stepped when it or one of its eight neighbours is busy: holds a height above [`QUIET_HEIGHT`] or foam
//! above [`QUIET_FOAM`]. A tile that stops being stepped is set to zero. Standing on world cells, tiles decide the
//! same wherever the window stands.

use crate::desc::TILE;

pub use open_water_shaders::grid::{QUIET_FOAM, QUIET_HEIGHT};

/// See [`Tile::faint`], metres.
const FAINT: f32 = 1e-10;

/// What a tile does in this tick.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Mode {
    /// All zero, not stepped.
    #[default]
    Quiet,
    /// Stepped.
    Active,
    /// Was stepped in the last tick, to be zeroed now.
    Ending,
}

/// What the medium makes of a tile.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Class {
    /// Open deep water, with the ring of cells around it.
    #[default]
    Plain,
    /// Anything else.
    Mixed,
    /// Wall that no water is near: never stepped.
    Solid,
}

/// One tile.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Tile {
    /// Bound of |z| and |z_old|, metres.
    pub(crate) height: f32,
    /// Bound of |z|, metres.
    pub(crate) top: f32,
    /// Bound of the foam.
    pub(crate) foam: f32,
    pub(crate) mode: Mode,
    pub(crate) class: Class,
    /// It has walls beside water.
    pub(crate) walls: bool,
    /// It has a current.
    pub(crate) carried: bool,
    /// `previous` holds its heights as drawn for the tick before; otherwise they are where [`crate::WaveGrid::draw`] says.
    pub(crate) kept: bool,
    /// A cell of it or within two cells of it is no open water.
    pub(crate) shut: bool,
}

impl Tile {
    /// Whether its values may be small enough to become denormals: waves fall off by less than a factor of 30 a cell.
    #[inline(always)]
    pub(crate) fn faint(&self) -> bool {
        self.top < FAINT
    }

    fn busy(&self) -> bool {
        // What a source or a feed noted of a wall is never measured again.
        self.class != Class::Solid && (self.height > QUIET_HEIGHT || self.foam > QUIET_FOAM)
    }
}

/// The tiles that cover a window.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Tiles {
    /// Cells of the window.
    pub(crate) cells: [usize; 2],
    /// Cells of the first tile that lie before the window.
    pub(crate) offset: [usize; 2],
    /// Tiles per axis, for any offset.
    pub(crate) count: [usize; 2],
    pub(crate) tiles: Vec<Tile>,
    #[cfg_attr(feature = "serde", serde(skip))]
    scratch: Vec<Tile>,
    /// How many are active.
    pub(crate) active: usize,
}

impl Tiles {
    pub(crate) fn new(cells: [usize; 2], offset: [usize; 2]) -> Self {
        let count = cells.map(|n| n.div_ceil(TILE) + 1);
        let tiles = vec![Tile::default(); count[0] * count[1]];
        Self { cells, offset, count, scratch: tiles.clone(), tiles, active: 0 }
    }

    /// Whether they are tiles of the same window as others, which begins so many cells into the first.
    pub(crate) fn is_one_of(&self, other: &Self, offset: [usize; 2]) -> bool {
        let Self { cells, offset: own, count, tiles, scratch: _, active: _ } = self;
        (cells, count, tiles.len()) == (&other.cells, &other.count, other.tiles.len()) && *own == offset
    }

    /// Goes back to those of another moment.
    pub(crate) fn restore(&mut self, to: &Self) {
        let Self { cells: _, offset, count: _, tiles, scratch: _, active } = to;
        (self.offset, self.active) = (*offset, *active);
        self.tiles.clone_from(tiles);
    }

    /// Cells of the window that tile `t` covers along an axis.
    pub(crate) fn span(&self, axis: usize, t: usize) -> std::ops::Range<usize> {
        let first = (t * TILE).saturating_sub(self.offset[axis]);
        let end = ((t + 1) * TILE - self.offset[axis]).min(self.cells[axis]);
        first.min(end)..end
    }

    /// Tile of a cell along an axis.
    pub(crate) fn of(&self, axis: usize, cell: usize) -> usize {
        (cell + self.offset[axis]) / TILE
    }

    /// Tiles of one row of tiles.
    pub(crate) fn row(&self, tz: usize) -> &[Tile] {
        &self.tiles[tz * self.count[0]..(tz + 1) * self.count[0]]
    }

    /// Notes what a source did to the cells of `range`.
    pub(crate) fn touch(&mut self, range: [[usize; 2]; 2], height: f32, foam: f32) {
        for tz in self.of(1, range[1][0])..=self.of(1, range[1][1] - 1) {
            for tx in self.of(0, range[0][0])..=self.of(0, range[0][1] - 1) {
                let tile = &mut self.tiles[tz * self.count[0] + tx];
                tile.height += height.abs();
                tile.top += height.abs();
                tile.foam += foam;
            }
        }
    }

    /// Notes the foam of every tile.
    pub(crate) fn note_foam(&mut self, foam: &[f32]) {
        for tz in 0..self.count[1] {
            for tx in 0..self.count[0] {
                let (columns, rows) = (self.span(0, tx), self.span(1, tz));
                let rows = rows.map(|j| &foam[j * self.cells[0]..][columns.clone()]);
                self.tiles[tz * self.count[0] + tx].foam = rows.flatten().fold(0.0, |most, foam| most.max(*foam));
            }
        }
    }

    /// Decides which tiles are stepped in this tick.
    pub(crate) fn schedule(&mut self) {
        let [nx, nz] = self.count;
        self.active = 0;
        for tz in 0..nz {
            for tx in 0..nx {
                let wanted = (tz.saturating_sub(1)..(tz + 2).min(nz)).any(|z| {
                    let row = &self.tiles[z * nx..(z + 1) * nx];
                    row[tx.saturating_sub(1)..(tx + 2).min(nx)].iter().any(Tile::busy)
                });
                let mut tile = self.tiles[tz * nx + tx];
                let wanted = wanted && tile.class != Class::Solid;
                tile.mode = match (wanted, tile.mode) {
                    (true, _) => Mode::Active,
                    (false, Mode::Active) => Mode::Ending,
                    (false, _) => Mode::Quiet,
                };
                self.active += usize::from(wanted);
                self.scratch[tz * nx + tx] = tile;
            }
        }
        std::mem::swap(&mut self.tiles, &mut self.scratch);
    }

    /// Has every tile stepped that holds water.
    pub(crate) fn activate_all(&mut self) {
        self.active = 0;
        for tile in &mut self.tiles {
            tile.mode = match tile.class {
                Class::Solid => Mode::Quiet,
                Class::Plain | Class::Mixed => Mode::Active,
            };
            self.active += usize::from(tile.mode == Mode::Active);
        }
    }

    /// The tiles' kept heights are those of another tick.
    pub(crate) fn forget_kept(&mut self) {
        for tile in &mut self.tiles {
            tile.kept = false;
        }
    }

    /// A sub-step has kept the heights of all active tiles or of those with a current.
    pub(crate) fn note_kept(&mut self, all: bool) {
        for tile in &mut self.tiles {
            tile.kept |= tile.mode == Mode::Active && (all || tile.carried);
        }
    }

    /// Notes the largest |z| of each active tile after a sub-step.
    pub(crate) fn note(&mut self, tops: &[f32]) {
        for (tile, top) in self.tiles.iter_mut().zip(tops).filter(|(tile, _)| tile.mode == Mode::Active) {
            tile.height = tile.top.max(*top);
            tile.top = *top;
        }
    }

    /// Whether the medium is nowhere felt.
    pub(crate) fn all_plain(&self) -> bool {
        self.tiles.iter().all(|tile| tile.class == Class::Plain)
    }

    /// Whether nothing needs stepping.
    pub(crate) fn asleep(&self) -> bool {
        !self.tiles.iter().any(Tile::busy)
    }

    /// Moves to where a shifted window stands. Tiles keep their world place. Returns by how many tiles.
    pub(crate) fn shift(&mut self, shift: [i64; 2]) -> [i64; 2] {
        let tile = TILE as i64;
        let mut moved = [0i64; 2];
        for k in 0..2 {
            let at = self.offset[k] as i64 + shift[k];
            moved[k] = at.div_euclid(tile);
            self.offset[k] = at.rem_euclid(tile) as usize;
        }
        if moved == [0; 2] {
            return moved;
        }
        let [nx, nz] = self.count.map(|n| n as i64);
        for tz in 0..nz {
            for tx in 0..nx {
                let (x, z) = (tx + moved[0], tz + moved[1]);
                let inside = (0..nx).contains(&x) && (0..nz).contains(&z);
                self.scratch[(tz * nx + tx) as usize] =
                    if inside { self.tiles[(z * nx + x) as usize] } else { Tile::default() };
            }
        }
        std::mem::swap(&mut self.tiles, &mut self.scratch);
        moved
    }

    /// Forgets all waves, and takes another place.
    pub(crate) fn clear(&mut self, offset: [usize; 2]) {
        self.offset = offset;
        self.active = 0;
        for tile in &mut self.tiles {
            *tile = Tile {
                class: tile.class,
                walls: tile.walls,
                carried: tile.carried,
                shut: tile.shut,
                ..Tile::default()
            };
        }
    }
}
