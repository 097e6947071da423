//! Case `grid_step`: time of a tick against a plain loop and the machine's memory bandwidth.

use std::hint::black_box;

use rayon::prelude::*;
use wave_grid::{Border, GridDesc, Scheme, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Effort, Plot, Row, Timing, measure_together},
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

/// Heights at which no foam is made, metres.
const LOW: f32 = 1e-4;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let effort = context.effort;
    for (variant, scene) in [("9-point", fixtures::grid()), ("5-point", fixtures::paper_grid())] {
        for &cells in context.pick(&[512u32][..], &[128, 256, 512, 1024]) {
            let desc = GridDesc { cells: [cells; 2], ..scene };
            let error = against_f64(&mut WaveGrid::new(desc)?, desc.scheme)?;
            for threads in [1, 2] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
                rows.extend(pool.install(|| ticks(effort, variant, desc, threads, error))?);
            }
        }
    }
    Ok(rows)
}

/// Ticks of one sub-step beside the triad of the same moment, on the threads of the pool.
fn ticks(effort: Effort, variant: &str, desc: GridDesc, threads: usize, error: f64) -> Result<Vec<Row>, CaseError> {
    let cells = desc.cells[0];
    let count = (cells * cells) as usize;
    let widths = [desc.border.width(), 4];
    let [mut grid, mut thin] = [waves(desc, widths[0])?, waves(desc, widths[1])?];
    let mut plain = Plain::new(&grid, desc.scheme, |v| v);
    let (b, c) = (vec![1.0f32; count], vec![2.0f32; count]);
    let mut a = vec![0.0f32; count];
    let chunk = count.div_ceil(threads);
    let mut triad = || {
        let rows = black_box(&mut a).par_chunks_mut(chunk).zip(b.par_chunks(chunk)).zip(c.par_chunks(chunk));
        rows.for_each(|((a, b), c)| a.iter_mut().zip(b).zip(c).for_each(|((a, b), c)| *a = b + 0.3 * c));
    };
    let [whole, less, loops, limit] =
        measure_together(effort, [&mut || grid.tick(), &mut || thin.tick(), &mut || plain.step(), &mut triad]);
    // Both have the same interior but for the cells that only one layer takes.
    let [wide, narrow] = widths.map(|width| layer_cells(cells, width));
    let layer = (whole.median_ns - less.median_ns) / (wide - narrow);
    let interior = Timing { median_ns: whole.median_ns - layer * wide, ..whole };
    let row = |part: &str, timing: &Timing, timed: &str| {
        Row::new("grid_step", format!("{variant}, {part}, {threads} threads"))
            .param("cells", cells)
            .param("threads", threads as u64)
            .param("triad_share", limit.median_ns / timing.median_ns)
            .time(timed, timing)
            .limit("triad over 12 bytes a cell, on the same threads in turns with it", limit.median_ns)
    };
    let percent = 100.0 * (whole.median_ns / interior.median_ns - 1.0);
    Ok(vec![
        row("whole", &whole, "a tick of the whole window, one sub-step, border included, no foam")
            .error(error, "relative RMS", "the same scheme in f64, after 32 ticks")
            .bound(1e-5)
            .baseline("a plain f32 loop over the interior on one thread", &loops)
            .note(format!("of this the border is {percent:.0} % over the interior")),
        row(
            "interior",
            &interior,
            "the same without a border: from layers of 4 cells and of all, extrapolated to none",
        ),
    ])
}

/// Cells that are stepped as layer: its strips along x are rounded up to eight.
fn layer_cells(cells: u32, width: u32) -> f64 {
    let rows = 2 * (width + 1);
    f64::from(rows * cells + 2 * (width + 1).next_multiple_of(8) * (cells - rows))
}

fn waves(desc: GridDesc, width: u32) -> Result<WaveGrid, CaseError> {
    let mut grid = WaveGrid::new(GridDesc { border: Border::Absorbing { width }, ..desc })?;
    grid.set_tile_skipping(false);
    let mut random = fixtures::Random::new(3);
    let rough: Vec<f32> = grid.heights().iter().map(|_| LOW * random.within(-1.0, 1.0) as f32).collect();
    grid.impose(&rough, &rough)?;
    Ok(grid)
}

/// Relative RMS of the heights that the border cannot have reached.
fn against_f64(grid: &mut WaveGrid, scheme: Scheme) -> Result<f64, CaseError> {
    let [nx, nz] = grid.desc().cells.map(|n| n as usize);
    let mut random = fixtures::Random::new(3);
    let rough: Vec<f32> = (0..nx * nz).map(|_| random.within(-1.0, 1.0) as f32).collect();
    grid.set_tile_skipping(false);
    grid.impose(&rough, &rough)?;
    let mut truth = Plain::new(grid, scheme, f64::from);
    for _ in 0..TICKS {
        grid.tick();
        truth.step();
    }
    let margin = TICKS + grid.desc().border.width() as usize + 2;
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
