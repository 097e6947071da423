//! Case `dispersive_step`: time of a tick of the dispersive scheme beside the wave equation's and the transforms that an exact
//! propagator takes.

use std::hint::black_box;
use std::sync::Arc;

use rustfft::{Fft, FftPlanner, num_complex::Complex};
use wave_grid::{GridDesc, Scheme, WaveGrid};

use crate::{
    evidence::{Case, CaseError, Context, Effort, Row, fastest},
    fixtures::Random,
};

/// See the module.
pub(super) const STEP: Case = Case {
    name: "dispersive_step",
    about: "a tick of the dispersive scheme beside those of the wave equation, and the transforms of a spectral step",
    plots: &[],
    run,
};

const SIDE: usize = 512;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let (mut rows, effort) = (Vec::new(), context.effort);
    for threads in [1u32, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads as usize).build()?;
        rows.extend(pool.install(|| ticks(effort, threads))?);
    }
    Ok(rows)
}

/// A window full of waves too low for foam, .5 m at 1/60 s: one sub-step a tick.
fn waves(scheme: Scheme) -> Result<WaveGrid, CaseError> {
    let mut grid =
        WaveGrid::new(GridDesc { cells: [SIDE as u32; 2], scheme, substeps: Some(1), ..GridDesc::default() })?;
    grid.set_tile_skipping(false);
    let mut random = Random::new(3);
    let rough: Vec<f32> = grid.heights().iter().map(|_| 1e-4 * random.within(-1.0, 1.0) as f32).collect();
    grid.impose(&rough, &rough)?;
    Ok(grid)
}

fn ticks(effort: Effort, threads: u32) -> Result<Vec<Row>, CaseError> {
    let mut own = waves(Scheme::Dispersive)?;
    let [mut five, mut nine] = [waves(Scheme::FivePoint)?, waves(Scheme::NinePoint)?];
    let mut transforms = Transforms::new();
    let [own, five, nine, exact] =
        fastest(effort, [&mut || own.tick(), &mut || five.tick(), &mut || nine.tick(), &mut || transforms.step()]);
    let row = |variant: &str| {
        Row::new("dispersive_step", format!("{variant}, {threads} threads"))
            .param("cells", SIDE)
            .param("threads", threads)
            // Height and potential, each old and new; three fields, each old and new.
            .param("bytes_a_cell", 4 * (2 + 2 + 6))
            .time("a tick of 512^2, one sub-step, border included", &own)
    };
    let over = |variant: &str, name: &str, other| row(variant).baseline(name, other);
    let [over_five, over_exact] = [&five, &exact].map(|other| own.median_ns / other.median_ns);
    let five = over("over 5-point", "5-point", &five).error(over_five, "ratio", "a tick of the 5-point wave equation");
    let nine = over("over 9-point", "9-point", &nine);
    if threads > 1 {
        return Ok(vec![five, nine]);
    }
    let exact = over("over transforms", "a transform of 512^2 complex f32 there and back", &exact).error(
        over_exact,
        "ratio",
        "the least that a spectral step takes: one packed transform there and back, rustfft",
    );
    // Against a step that becomes slow, with room for a busy machine.
    Ok(vec![five.bound(6.0), nine, exact.bound(0.6)])
}

/// Height and potential packed into one complex field, transformed there and back: rows, transposition, rows.
struct Transforms {
    there: Arc<dyn Fft<f32>>,
    back: Arc<dyn Fft<f32>>,
    data: Vec<Complex<f32>>,
    other: Vec<Complex<f32>>,
    scratch: Vec<Complex<f32>>,
}

impl Transforms {
    fn new() -> Self {
        let mut planner = FftPlanner::new();
        let [there, back] = [planner.plan_fft_forward(SIDE), planner.plan_fft_inverse(SIDE)];
        let zero = |count| vec![Complex::default(); count];
        let scratch = zero(there.get_inplace_scratch_len().max(back.get_inplace_scratch_len()));
        Self { there, back, data: zero(SIDE * SIDE), other: zero(SIDE * SIDE), scratch }
    }

    fn step(&mut self) {
        const BLOCK: usize = 16;
        for plan in [&self.there, &self.back] {
            for _ in 0..2 {
                plan.process_with_scratch(&mut self.data, &mut self.scratch);
                for j in (0..SIDE).step_by(BLOCK) {
                    for i in (0..SIDE).step_by(BLOCK) {
                        for at in (j..j + BLOCK).flat_map(|j| (i..i + BLOCK).map(move |i| [i, j])) {
                            self.other[at[0] * SIDE + at[1]] = self.data[at[1] * SIDE + at[0]];
                        }
                    }
                }
                std::mem::swap(&mut self.data, &mut self.other);
            }
        }
        black_box(&self.data);
    }
}
