//! Case `grid_step`: time of a tick against a plain loop and the machine's memory bandwidth.

use std::hint::black_box;

use wave_grid::{GridDesc, Scheme, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, limits, measure_together},
    fixtures,
};

/// See the module.
pub(super) const STEP: Case = Case {
    name: "grid_step",
    about: "a tick of the CPU grid: a plain loop and the memory bandwidth beside it, heights against f64",
    plots: &[Plot {
        file: "grid_step",
        title: "A tick of the whole window",
        x: Axis::Param("cells"),
        y: Axis::Time,
        label: None,
    }],
    run,
};

/// Ticks before heights are compared; the border reaches this many cells inwards.
const TICKS: usize = 32;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, scene) in [("9-point", fixtures::grid()), ("5-point", fixtures::paper_grid())] {
        for &cells in context.pick(&[256u32, 512][..], &[128, 256, 512, 1024]) {
            let desc = GridDesc { cells: [cells; 2], ..scene };
            let mut grid = WaveGrid::new(desc)?;
            grid.set_tile_skipping(false);
            let error = against_f64(&mut grid, desc.scheme)?;
            let mut plain = Plain::new(&grid, desc.scheme, |v| v);
            let [ours, theirs] = measure_together(context.effort, [&mut || grid.tick(), &mut || plain.step()]);
            // Reads the heights of now and before, writes those of the next step.
            let bytes = 12 * (cells * cells) as usize;
            let limit = limits::triad_ns_per_byte(context.effort, bytes, true) * bytes as f64;
            rows.push(
                Row::new("grid_step", variant)
                    .param("cells", cells)
                    .error(error, "relative RMS", "the same scheme in f64, after 32 ticks")
                    .bound(1e-5)
                    .time("a tick of the whole window, one sub-step, border and foam included", &ours)
                    .baseline("a plain f32 loop over the interior on one thread", &theirs)
                    .limit("triad over the same bytes, all threads", limit),
            );
        }
    }
    Ok(rows)
}

/// Relative RMS of the heights that the border cannot have reached.
fn against_f64(grid: &mut WaveGrid, scheme: Scheme) -> Result<f64, CaseError> {
    let [nx, nz] = grid.desc().cells.map(|n| n as usize);
    let mut random = fixtures::Random::new(3);
    let rough: Vec<f32> = (0..nx * nz).map(|_| random.within(-1.0, 1.0) as f32).collect();
    grid.impose(&rough, &rough)?;
    let mut truth = Plain::new(grid, scheme, f64::from);
    for _ in 0..TICKS {
        grid.tick();
        truth.step();
    }
    let margin = TICKS + grid.desc().pml_width as usize + 2;
    let (mut difference, mut square) = (0.0, 0.0);
    for j in margin..nz - margin {
        for at in j * nx + margin..(j + 1) * nx - margin {
            difference += (f64::from(grid.heights()[at]) - truth.now[at]).powi(2);
            square += truth.now[at].powi(2);
        }
    }
    Ok((difference / square).sqrt())
}

/// The scheme as a textbook writes it: uniform c, fixed rim.
struct Plain<T> {
    nx: usize,
    now: Vec<T>,
    before: Vec<T>,
    edge: T,
    corner: T,
    middle: T,
}

impl<T> Plain<T>
where
    T: Copy + Default + std::ops::Add<Output = T> + std::ops::Sub<Output = T> + std::ops::Mul<Output = T>,
{
    fn new(grid: &WaveGrid, scheme: Scheme, number: impl Fn(f32) -> T + Copy) -> Self
    where
        T: FromF64,
    {
        let a = grid.stepping().a[0];
        // The isotropic nine-point Laplacian is (8/12, 2/12), the five-point one (1, 0).
        let (edge, corner) = if scheme == Scheme::NinePoint { (8.0 / 12.0, 2.0 / 12.0) } else { (1.0, 0.0) };
        let now: Vec<T> = grid.heights().iter().map(|z| number(*z)).collect();
        Self {
            nx: grid.desc().cells[0] as usize,
            before: now.clone(),
            now,
            edge: T::from_f64(a * edge),
            corner: T::from_f64(a * corner),
            middle: T::from_f64(2.0 - 4.0 * a * (edge + corner)),
        }
    }

    fn step(&mut self) {
        let nx = self.nx;
        let rows = self.now.len() / nx;
        for j in 1..rows - 1 {
            let row = |j: usize| &self.now[j * nx..(j + 1) * nx];
            let (above, here, below) = (row(j - 1), row(j), row(j + 1));
            let before = &mut self.before[j * nx..(j + 1) * nx];
            for i in 1..nx - 1 {
                let edges = here[i - 1] + here[i + 1] + above[i] + below[i];
                let corners = above[i - 1] + above[i + 1] + below[i - 1] + below[i + 1];
                before[i] = self.middle * here[i] + self.edge * edges + self.corner * corners - before[i];
            }
        }
        std::mem::swap(&mut self.now, &mut self.before);
        black_box(&self.now);
    }
}

trait FromF64 {
    fn from_f64(value: f64) -> Self;
}
impl FromF64 for f32 {
    fn from_f64(value: f64) -> Self {
        value as f32
    }
}
impl FromF64 for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }
}
