//! The fit at all nodes of the shipped table.

use super::{Coefficients, Task};

/// Nodes of G, Chebyshev's for a cubic; at 0 the fields have no inertia.
const NODES: [f64; 4] = [0.0, 0.00155, 0.00465, 0.0062];
/// Least and largest depth, cells, and nodes an octave (evenly spaced within it).
const DEPTHS: [f64; 2] = [0.625, 80.0];
const AN_OCTAVE: f64 = 8.0;

/// Coefficients by depth and by G.
pub struct Fitted {
    /// G of the columns.
    pub nodes: [f64; 4],
    /// Depths of the rows, cells, the shallowest first.
    pub depths: Vec<f64>,
    /// The rows.
    pub rows: Vec<[Coefficients; 4]>,
}

impl Fitted {
    /// Fits all nodes: deep water first, then each depth from what is above it, with the deep water's r.
    pub fn new(task: &Task) -> Self {
        let nodes = NODES.map(|g| g.max(1e-6));
        let mut start = task.start();
        let mut deep = nodes.map(|_| start.clone());
        for i in (0..4).rev() {
            deep[i] = task.fit(nodes[i], f64::INFINITY, &start, false);
            start = deep[i].clone();
        }
        let mut depths = vec![DEPTHS[1]];
        let mut rows = vec![deep];
        let mut depth = DEPTHS[1];
        while depth > DEPTHS[0] {
            // The octave that ends at this depth or holds it.
            let octave = 2.0f64.powf(depth.log2().ceil() - 1.0);
            depth -= octave / AN_OCTAVE;
            let above = &rows[rows.len() - 1];
            let mut row = above.clone();
            // One column from the row above, the others also from the change that their neighbour took: the same branch.
            for (i, beside) in [(2, 2), (3, 2), (1, 2), (0, 1)] {
                let mut start = above[i].clone();
                if i != beside {
                    start.c *= row[beside].c / above[beside].c;
                    let change = row[beside].s.iter().zip(&above[beside].s).map(|(now, before)| now / before);
                    start.s.iter_mut().zip(change).for_each(|(s, change)| *s *= change);
                }
                row[i] = task.fit(nodes[i], depth, &start, true);
            }
            depths.push(depth);
            rows.push(row);
        }
        depths.reverse();
        rows.reverse();
        Self { nodes: NODES, depths, rows }
    }
}

/// The source text of the shipped table.
pub fn print(fitted: &Fitted) -> String {
    let list = |values: &[f64]| values.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(", ");
    let mut text = String::from(
        "//! Printed by `cargo run --release --bin fit`: do not edit.\n\n\
         /// G of the columns.\n",
    );
    text += &format!(
        "pub(super) const NODES: [f64; 4] = {:?};\n\n/// r_i by G.\n#[rustfmt::skip]\npub(super) const R: [[f64; 3]; 4] = [\n",
        fitted.nodes
    );
    if let Some(deep) = fitted.rows.last() {
        for at in deep {
            text += &format!("    [{}],\n", list(&at.r));
        }
    }
    text += "];\n\n/// c, s_1, s_2, s_3 by depth (the shallowest first) and by G.\n#[rustfmt::skip]\n";
    text += &format!("pub(super) const SHARES: [[[f64; 4]; 4]; {}] = [\n", fitted.rows.len());
    for (depth, row) in fitted.depths.iter().zip(&fitted.rows) {
        let cell = |at: &Coefficients| format!("[{}]", list(&[at.c, at.s[0], at.s[1], at.s[2]]));
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| cell(&row[i]));
        text += &format!("    [{a}, {b}, // {depth}\n     {c}, {d}],\n");
    }
    text + "];\n"
}
