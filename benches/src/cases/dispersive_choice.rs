//! Case `dispersive_choice`: what the number of screened fields and the Laplacian of the dispersive scheme cost and give.

use std::hint::black_box;

use crate::{
    evidence::{Axis, Case, CaseError, Context, Effort, Plot, Row, Timing, fastest},
    fit::{Coefficients, Laplacian, Task},
};

/// See the module.
pub(super) const CHOICE: Case = Case {
    name: "dispersive_choice",
    about: "phase error in deep water against the time of a step, by number of fields and Laplacian; plain loops",
    plots: &[Plot {
        file: "dispersive_choice",
        title: "Dispersive scheme: phase error against time of a step (beside the points: fields)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("fields"),
    }],
    run,
};

const SIDE: usize = 512;
/// Cells of 0.5 m at 1/60 s.
const G: f64 = 9.81 / 3600.0 / 0.5;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let times = times(context.effort);
    let mut rows = Vec::new();
    for band in [[6.0, 64.0], [6.0, 128.0], [4.0, 85.0]] {
        for (row, laplacian) in [Laplacian::FivePoint, Laplacian::NinePoint].into_iter().enumerate() {
            for (column, fields) in [2, 3, 4].into_iter().enumerate() {
                let task = Task { fields, laplacian, band, ..Task::SHIPPED };
                let found = task.fit(G, f64::INFINITY, &task.start(), false);
                let [phase, group, share] = task.errors(&found, G, f64::INFINITY);
                let points = if row == 0 { 5 } else { 9 };
                let rounded = |x: f64| (x * 1e4).round() / 1e4;
                rows.push(
                    Row::new("dispersive_choice", format!("{points}-point, {} to {} cells a wave", band[0], band[1]))
                        .param("fields", fields)
                        .param("group_percent", rounded(100.0 * group))
                        .param("least_share_of_energy", rounded(share))
                        .param("bytes_a_cell", 4 * (3 + 2 * fields))
                        .error(100.0 * phase, "%", "linear theory, deep water, G = .00545")
                        .time("a step of 512^2, plain f32 loops on one thread, uniform water", &times[row][column])
                        .baseline("5-point, 3 fields", &times[0][1]),
                );
            }
        }
    }
    Ok(rows)
}

/// By Laplacian and number of fields.
fn times(effort: Effort) -> [[Timing; 3]; 2] {
    let mut a = (Loops::<2>::new(), Loops::<3>::new(), Loops::<4>::new());
    let mut b = (Loops::<2>::new(), Loops::<3>::new(), Loops::<4>::new());
    let [p, q, r, s, t, u] = fastest(
        effort,
        [
            &mut || a.0.step::<false>(),
            &mut || a.1.step::<false>(),
            &mut || a.2.step::<false>(),
            &mut || b.0.step::<true>(),
            &mut || b.1.step::<true>(),
            &mut || b.2.step::<true>(),
        ],
    );
    [[p, q, r], [s, t, u]]
}

/// Height, potential and `N` fields on a square in uniform water; the rim stays still.
struct Loops<const N: usize> {
    z: Vec<f32>,
    potential: [Vec<f32>; 2],
    fields: [[Vec<f32>; 2]; N],
    c: f32,
    s: [f32; N],
    r: [f32; N],
    m: [f32; N],
    flow: Vec<f32>,
}

impl<const N: usize> Loops<N> {
    fn new() -> Self {
        let Coefficients { c, s, r } = Task { fields: N, ..Task::SHIPPED }.start();
        let all = || vec![0.0f32; SIDE * SIDE];
        let mut z = all();
        for (at, z) in z.iter_mut().enumerate() {
            *z = 0.01 * (at % 97) as f32 / 97.0;
        }
        Self {
            z,
            potential: [all(), all()],
            fields: std::array::from_fn(|_| [all(), all()]),
            c: c as f32,
            s: std::array::from_fn(|i| s[i] as f32),
            r: std::array::from_fn(|i| r[i] as f32),
            m: std::array::from_fn(|i| (3.6 / (8.0 * s[i] + 2.0 * r[i])) as f32),
            flow: vec![0.0; SIDE],
        }
    }

    fn step<const NINE: bool>(&mut self) {
        let g = G as f32;
        let [now, next] = &mut self.potential;
        for j in 1..SIDE - 1 {
            let own = j * SIDE..(j + 1) * SIDE;
            let flow = &mut self.flow[..];
            let p = &now[own.clone()];
            let l = laplacian::<NINE>(now, j);
            for (i, flow) in flow.iter_mut().enumerate().take(SIDE - 1).skip(1) {
                *flow = self.c * l(i);
            }
            for (q, [x, old]) in self.fields.iter_mut().enumerate() {
                let (s, r, m) = (self.s[q], self.r[q], self.m[q]);
                let l = laplacian::<NINE>(x, j);
                let (x, old) = (&x[own.clone()], &mut old[own.clone()]);
                for i in 1..SIDE - 1 {
                    let exchange = r * (p[i] - x[i]);
                    flow[i] -= exchange;
                    old[i] = 2.0 * x[i] - old[i] + m * (s * l(i) + exchange);
                }
            }
            let (z, next) = (&mut self.z[own.clone()], &mut next[own]);
            for i in 1..SIDE - 1 {
                z[i] -= flow[i];
                next[i] = p[i] - g * z[i];
            }
        }
        self.potential.swap(0, 1);
        self.fields.iter_mut().for_each(|levels| levels.swap(0, 1));
        black_box(&self.z);
    }
}

/// The Laplacian in row `j` by column.
#[inline(always)]
fn laplacian<const NINE: bool>(u: &[f32], j: usize) -> impl Fn(usize) -> f32 {
    let row = |j: usize| &u[j * SIDE..(j + 1) * SIDE];
    let (above, here, below) = (row(j - 1), row(j), row(j + 1));
    move |i| {
        let edges = here[i - 1] + here[i + 1] + above[i] + below[i];
        if NINE {
            let corners = above[i - 1] + above[i + 1] + below[i - 1] + below[i + 1];
            return 2.0 / 3.0 * edges + 1.0 / 6.0 * corners - 10.0 / 3.0 * here[i];
        }
        edges - 4.0 * here[i]
    }
}
