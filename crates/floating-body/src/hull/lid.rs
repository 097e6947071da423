//! Closes the wells of a height field: what would hold rain gets a lid stretched over its edge.

use glam::DVec2;

use super::dry::{NODES, index};

/// What is deeper than this share of the hull's height is a well and no camber.
const DEEP: f64 = 0.01;
/// Over-relaxation and sweeps: enough for a thousandth of the edge's ups and downs at the raster's size.
const RELAX: f64 = 1.9;
const SWEEPS: usize = 200;

/// The neighbours along x, then along z, of a node that is not on the outermost ring.
fn beside(node: usize) -> [usize; 4] {
    [node - 1, node + 1, node - NODES[0], node + NODES[0]]
}

fn inner() -> impl DoubleEndedIterator<Item = usize> {
    (1..NODES[1] - 1).flat_map(|j| (1..NODES[0] - 1).map(move |i| index([i, j])))
}

/// How high water would stand at each node, poured on until it runs off over the outermost ring.
fn fill(high: &[f64]) -> Vec<f64> {
    let mut level = high.to_vec();
    inner().for_each(|n| level[n] = f64::INFINITY);
    loop {
        let mut changed = false;
        let mut sink = |n: usize| {
            let spill = beside(n).into_iter().map(|b| level[b]).fold(f64::INFINITY, f64::min);
            let to = high[n].max(spill);
            changed |= to < level[n];
            level[n] = level[n].min(to);
        };
        inner().for_each(&mut sink);
        inner().rev().for_each(&mut sink);
        if !changed {
            return level;
        }
    }
}

/// Raises `high` over its wells to a membrane between their edges; `cell` is the raster's, `height` the hull's, m.
pub(super) fn close(high: &mut [f64], cell: DVec2, height: f64) {
    let level = fill(high);
    let wells: Vec<usize> = inner().filter(|n| level[*n] - high[*n] > DEEP * height).collect();
    wells.iter().for_each(|n| high[*n] = level[*n]);
    let weight = DVec2::ONE / (cell * cell);
    for _ in 0..SWEEPS {
        for n in &wells {
            let [a, b, c, d] = beside(*n).map(|b| high[b]);
            let mean = (weight.x * (a + b) + weight.y * (c + d)) / (2.0 * (weight.x + weight.y));
            high[*n] += RELAX * (mean - high[*n]);
        }
    }
}
