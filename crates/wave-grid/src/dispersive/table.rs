//! Coefficients of the dispersive scheme: shipped at nodes of G and of depth, between them by interpolation.
//!
//! The numbers are a fit (`benches/src/fit`) of the lowest eigenvalue of the coupled discrete system to linear theory over
//! 6 to 128 cells a wave. In deep water the phase errs by at most .63 % and the group speed by 3.7 %, at any G up to
//! [`MOST_G`]; over a bed .63 cells deep and more the phase errs by at most 1.1 %. In shallower water all is in proportion to
//! the depth: long waves are right, and waves of 6 cells along an axis are 4.7 % slow, as on any five-point grid.
//!
//! No eigenvalue exceeds the larger of 3.6 and G (8 c + 2 sum r), at any depths, walls and G: stable.

use super::fitted::{NODES, R, SHARES};

/// Screened fields beside the potential.
pub const FIELDS: usize = 3;
/// Largest G = g dt^2 / D that is fitted for. Any smaller one is.
pub const MOST_G: f64 = 0.006;
/// Cells: here and below the water is deep for every wave that the grid carries.
pub const DEEP: f32 = 80.0;
/// Cells: above this the coefficients are in proportion to the depth.
const SHALLOW: f32 = 0.625;
/// Nodes of depth: 8 an octave, evenly spaced within it, so that they are the leading bits of a depth.
const DEPTHS: usize = SHARES.len();
/// Bits of a depth below those that tell its node.
const BELOW: u32 = 20;

/// Coefficients of the Laplacians at one depth: of the potential, and of the fields. Lengths in cells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shares {
    /// Of the potential.
    pub c: f32,
    /// Of the fields.
    pub s: [f32; FIELDS],
}

impl Shares {
    fn map2(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self { c: f(self.c, other.c), s: std::array::from_fn(|i| f(self.s[i], other.s[i])) }
    }
}

/// Coefficients at one G.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    r: [f32; FIELDS],
    nodes: [Shares; DEPTHS],
}

impl Table {
    /// For `g` = g dt^2 / D, 0 to [`MOST_G`]: cubic in G.
    pub fn new(g: f64) -> Self {
        let weights: [f64; 4] = std::array::from_fn(|i| {
            let others = (0..4).filter(|&j| j != i);
            others.map(|j| (g - NODES[j]) / (NODES[i] - NODES[j])).product()
        });
        let between = |at: &dyn Fn(usize) -> f64| (0..4).map(|i| weights[i] * at(i)).sum::<f64>() as f32;
        let share = |depth: usize, which: usize| between(&|i| SHARES[depth][i][which]);
        Self {
            r: std::array::from_fn(|field| between(&|i| R[i][field])),
            nodes: std::array::from_fn(|depth| Shares {
                c: share(depth, 0),
                s: std::array::from_fn(|field| share(depth, 1 + field)),
            }),
        }
    }

    /// The exchange between the potential and each field, at every depth.
    pub fn r(&self) -> [f32; FIELDS] {
        self.r
    }

    /// In deep water.
    pub fn deep(&self) -> Shares {
        self.nodes[DEPTHS - 1]
    }

    /// In water `depth` cells deep: continuous, linear between nodes. Zero where there is none.
    pub fn at(&self, depth: f32) -> Shares {
        if depth >= DEEP {
            return self.deep();
        }
        if depth > SHALLOW {
            let bits = depth.to_bits();
            let node = ((bits >> BELOW) - (SHALLOW.to_bits() >> BELOW)) as usize;
            let part = (bits & ((1 << BELOW) - 1)) as f32 / (1 << BELOW) as f32;
            return self.nodes[node].map2(self.nodes[node + 1], |low, high| low + part * (high - low));
        }
        // NaN is no water either.
        let part = depth.max(0.0) / SHALLOW;
        self.nodes[0].map2(Shares::default(), |low, _| part * low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of one table, c first, as one list.
    fn list(shares: Shares) -> [f32; 4] {
        [shares.c, shares.s[0], shares.s[1], shares.s[2]]
    }

    #[test]
    fn the_table_goes_through_the_nodes() {
        for (i, g) in NODES.into_iter().enumerate() {
            let table = Table::new(g);
            assert_eq!(table.r(), R[i].map(|x| x as f32));
            for (row, depth) in [(0, SHALLOW), (3, 0.8125), (10, 1.5), (56, DEEP), (56, f32::INFINITY)] {
                let shipped = SHARES[row][i].map(|x| x as f32);
                assert!(list(table.at(depth)).iter().zip(shipped).all(|(a, b)| (a - b).abs() <= 1e-6 * b), "{depth}");
            }
        }
    }

    #[test]
    fn coefficients_are_continuous_and_positive() {
        for g in [1e-6, 3e-4, 2e-3, 0.00545, MOST_G] {
            let table = Table::new(g);
            assert!(table.r().iter().all(|r| *r > 0.0));
            let mut before = list(table.at(0.01));
            let mut depth = 0.01f32;
            while depth < 100.0 {
                depth *= 1.001;
                let now = list(table.at(depth));
                for (now, before) in now.into_iter().zip(before) {
                    // s_3 falls by a factor of 4.5 between 10 and 8 cells: 1 % in .1 % is its steepest.
                    assert!(
                        now > 0.0 && (now - before).abs() < 0.02 * before,
                        "G {g}, depth {depth}: {before} to {now}"
                    );
                }
                before = now;
            }
        }
    }

    #[test]
    fn no_water_carries_nothing() {
        let table = Table::new(0.005);
        for depth in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(table.at(depth), Shares::default());
        }
        let [half, whole] = [0.2f32, 0.4].map(|depth| table.at(depth));
        assert!(list(half).iter().zip(list(whole)).all(|(half, whole)| (2.0 * half - whole).abs() <= 1e-6 * whole));
    }
}
