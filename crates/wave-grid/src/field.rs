//! An array of cells that a shift moves by moving its start: only what enters is written, and now and then all of it moves
//! back to the middle of its slack.

use std::ops::{Deref, DerefMut};

/// Rows of slack on either side.
const SLACK: usize = 32;
/// Floats of a cache line.
const LINE: usize = 16;
/// Floats between the starts of arrays of different `stagger`, modulo a page: what one row stores must not look like what
/// the next one loads.
const STAGGER: usize = 256;

/// `nx * nz` cells, row-major, x fastest, followed by slack.
#[derive(Debug, Default)]
pub(crate) struct Field {
    all: Vec<f32>,
    start: usize,
    /// Where `start` is with as much slack before as after, on a cache line.
    middle: usize,
    nx: usize,
    len: usize,
}

impl Field {
    /// All `value`. Arrays that are read together should differ in `stagger`, 0 to 3.
    pub(crate) fn new(nx: usize, nz: usize, value: f32, stagger: usize) -> Self {
        let (len, slack) = (nx * nz, SLACK * nx);
        let room = 2 * LINE + stagger * STAGGER;
        // Pages of zeros cost nothing until they are written.
        let mut all = vec![0.0; len + 2 * slack + room];
        let middle = slack + stagger * STAGGER;
        let middle = middle + all[middle..].as_ptr().align_offset(4 * LINE).min(LINE);
        if value != 0.0 {
            all[middle..middle + len].fill(value);
        }
        Self { all, start: middle, middle, nx, len }
    }

    /// Cells along x.
    pub(crate) fn width(&self) -> usize {
        self.nx
    }

    /// Cell i takes what cell i + shift held; what enters is zero.
    pub(crate) fn shift(&mut self, shift: [i64; 2]) {
        if self.len == 0 {
            return;
        }
        let (nx, nz) = (self.nx, self.len / self.nx);
        let offset = shift[1] * nx as i64 + shift[0];
        if shift[0].unsigned_abs() as usize >= nx || offset.unsigned_abs() as usize >= self.len {
            self.fill(0.0);
            return;
        }
        match self.start.checked_add_signed(offset as isize) {
            Some(start) if start + self.len <= self.all.len() => self.start = start,
            _ => self.recentre(offset),
        }
        let (sx, sz) = (shift[0].unsigned_abs() as usize, shift[1].unsigned_abs() as usize);
        let cells = &mut **self;
        if shift[1] > 0 {
            cells[(nz - sz) * nx..].fill(0.0);
        } else {
            cells[..sz * nx].fill(0.0);
        }
        let entering = if shift[0] > 0 { nx - sx..nx } else { 0..sx };
        for row in cells.chunks_exact_mut(nx) {
            row[entering.clone()].fill(0.0);
        }
    }

    /// Moves what the shift leaves to the middle.
    fn recentre(&mut self, offset: i64) {
        let distance = offset.unsigned_abs() as usize;
        let kept = self.len - distance;
        let (from, to) = if offset > 0 { (self.start + distance, 0) } else { (self.start, distance) };
        self.all.copy_within(from..from + kept, self.middle + to);
        self.start = self.middle;
    }
}

impl Clone for Field {
    fn clone(&self) -> Self {
        if self.all.is_empty() {
            return Self::default();
        }
        let mut new = Self { all: vec![0.0; self.all.len()], ..*self };
        // The copy has its own place on the cache lines.
        let middle = self.middle - self.middle % LINE;
        new.middle = middle + new.all[middle..].as_ptr().align_offset(4 * LINE).min(LINE);
        new.start = new.middle;
        new.copy_from_slice(self);
        new
    }
}

impl PartialEq for Field {
    fn eq(&self, other: &Self) -> bool {
        self.nx == other.nx && **self == **other
    }
}

impl Deref for Field {
    type Target = [f32];

    #[inline]
    fn deref(&self) -> &[f32] {
        &self.all[self.start..self.start + self.len]
    }
}

impl DerefMut for Field {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f32] {
        &mut self.all[self.start..self.start + self.len]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_empty_one_can_be_cloned() {
        assert_eq!(Field::default().clone().len(), 0);
    }

    proptest! {
        #[test]
        fn any_walk_moves_what_stays_and_clears_what_enters(
            (nx, nz) in (3usize..20, 3usize..20),
            walk in prop::collection::vec(([-25i64..25, -25i64..25], 0usize..3), 1..60),
        ) {
            let mut field = Field::new(nx, nz, 0.0, 1);
            let mut plain = vec![0.0f32; nx * nz];
            for (step, ([x, z], fresh)) in walk.into_iter().enumerate() {
                for k in 0..fresh {
                    let at = (step * 31 + k * 7) % (nx * nz);
                    (field[at], plain[at]) = (step as f32 + 1.0, step as f32 + 1.0);
                }
                if step % 7 == 3 {
                    field = field.clone();
                }
                field.shift([x, z]);
                plain = (0..nx * nz)
                    .map(|at| {
                        let (i, j) = ((at % nx) as i64 + x, (at / nx) as i64 + z);
                        let inside = (0..nx as i64).contains(&i) && (0..nz as i64).contains(&j);
                        if inside { plain[(j * nx as i64 + i) as usize] } else { 0.0 }
                    })
                    .collect();
                prop_assert_eq!(&*field, &plain[..]);
            }
        }
    }
}
