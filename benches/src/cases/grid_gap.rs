//! Case `diffraction`: waves behind a gap in a straight wall, and behind a wall's end, against exact solutions.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec2;
use rustfft::num_complex::Complex;
use wave_grid::{CellKind, Edges, GridDesc, Medium, MediumCell, Side, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, Timing},
    fixtures,
    truth::diffraction::{Slit, half_plane},
};

/// See the module.
pub(super) const DIFFRACTION: Case = Case {
    name: "diffraction",
    about: "height of steady waves behind a gap in a wall and behind a wall's end, against exact solutions",
    plots: &[Plot {
        file: "diffraction",
        title: "Height behind a wall with a gap: error against cells per wavelength",
        x: Axis::Param("cells_per_wavelength"),
        y: Axis::Error,
        label: None,
    }],
    run,
};

/// Cells from the window's edge to the wall: the layer, the feed's contour and some water.
const BEFORE: usize = 26;
/// Cells from what is looked at to the window's edge.
const RIM: usize = 20;
/// What is looked at: from one to so many wavelengths behind the wall, and to so many on either side of the gap's middle or
/// of the wall's end.
const REACH: f64 = 5.0;
/// Of the incoming waves, m.
const HEIGHT: f64 = 0.1;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for &steps in context.pick(&[15u32, 24][..], &[15, 16, 20, 24, 32, 48]) {
        for opening in [Opening::Gap(1.0), Opening::Gap(2.0), Opening::End] {
            rows.push(diffraction(steps, opening)?);
        }
    }
    Ok(rows)
}

/// What the wall leaves open: a gap of about so many wavelengths, or everything beside its end.
#[derive(Clone, Copy)]
enum Opening {
    Gap(f64),
    End,
}

/// A wall of one row of cells across x, of all z but those in `open`; in world cells.
struct Wall {
    x: i64,
    open: std::ops::Range<i64>,
    cell: f64,
}

impl Medium for Wall {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        let [x, z] = [place.x, place.y].map(|p| (p / self.cell).floor() as i64);
        let kind = if x == self.x && !self.open.contains(&z) { CellKind::Wall } else { CellKind::Open };
        MediumCell { kind, ..MediumCell::default() }
    }

    fn is_plain(&self, low: DVec2, high: DVec2, _: f32) -> bool {
        let x = (self.x as f64 + 0.5) * self.cell;
        high.x < x - self.cell || low.x > x + self.cell
    }
}

/// Feeds waves of `steps` sub-steps a period head on to the wall and compares their height behind it, once steady.
///
/// In front of the wall stand the waves that come and those mirrored, and nothing behind: that is what the feed tells, so
/// that only what comes out of the gap crosses the window's edge. Beside a wall's end the fed waves differ from place to
/// place and disturb each other at the window's corners; these are so far away that the disturbance arrives too late.
fn diffraction(steps: u32, opening: Opening) -> Result<Row, CaseError> {
    let scene = fixtures::grid();
    let a = scene.stepping()?.a[0];
    let omega = TAU / f64::from(steps);
    // The scheme's own wavenumber along an axis, radians per cell; it differs by a part in a few hundred.
    let k = 2.0 * ((0.5 * omega).sin() / a.sqrt()).asin();
    let wavelength = TAU / k;
    let reach = (REACH * wavelength) as usize;
    let half = reach + RIM + if matches!(opening, Opening::End) { (8.0 * wavelength) as usize } else { 0 };
    let cells = [BEFORE + 1 + reach + RIM, 2 * half];
    let desc = GridDesc { cells: cells.map(|n| n as u32), ..scene };
    let mut grid = WaveGrid::new(desc)?;
    let [corner_x, corner_z] = grid.window().corner;
    let middle = corner_z + half as i64;
    let (half_gap, open) = match opening {
        Opening::Gap(widths) => {
            let half_gap = (0.5 * widths * wavelength).round() as i64;
            (half_gap, middle - half_gap..middle + half_gap)
        }
        Opening::End => (0, middle..i64::MAX),
    };
    let cell = f64::from(desc.cell_size[0]);
    let wall = Wall { x: corner_x + BEFORE as i64, open, cell };
    // Its face is the mirror.
    let face = wall.x as f64;
    grid.set_medium(Some(Arc::new(wall)));
    grid.set_feed(Edges { low_x: true, low_z: true, high_z: true, high_x: false });
    let lines = grid.feed_lines();
    let ramp = |step: f64| {
        let t = (step / f64::from(4 * steps)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    // Waves along x in cells from the wall's face, and those it mirrors, growing as they arrive.
    let height = |x: f64, step: f64, mirrored: f64| {
        let delays = [x, -x].map(|x| (x + BEFORE as f64) / a.sqrt());
        let own = ramp(step - delays[0]) * (k * x - omega * step).cos();
        HEIGHT * (own + mirrored * ramp(step - delays[1]) * (k * x + omega * step).cos())
    };
    let ticks = ((BEFORE as f64 + 2.0 * reach as f64) / a.sqrt()) as u32 + 8 * steps;
    let mut sums = vec![Complex::<f64>::default(); grid.heights().len()];
    let start = Instant::now();
    for tick in 0..ticks {
        grid.tick_fed(&mut |index, _, out| {
            let line = &lines[index];
            // The feed beside an end knows of mirrored waves on the wall's side only.
            let walled = matches!(opening, Opening::Gap(_)) || line.side == Side::LowZ;
            for (row, out) in out.into_iter().enumerate() {
                for (i, out) in out.iter_mut().enumerate() {
                    let along = line.first + line.step * i as f64;
                    let x = if line.side == Side::LowX { line.across[row] } else { along } / cell - face;
                    let shadow = walled && x > 0.0;
                    *out = if shadow { 0.0 } else { height(x, tick.into(), f64::from(u8::from(walled))) as f32 };
                }
            }
        });
        // The amplitude over the last period, which is a whole number of sub-steps.
        if tick + steps >= ticks {
            let turn = Complex::from_polar(2.0 / (HEIGHT * f64::from(steps)), omega * f64::from(tick + 1));
            for (sum, z) in sums.iter_mut().zip(grid.heights()) {
                *sum += turn * f64::from(*z);
            }
        }
    }
    let took = Timing { median_ns: start.elapsed().as_nanos() as f64, spread_ns: 0.0, repeats: 1 };
    // The solutions are those of screens without thickness: in the middle of the wall.
    let slit = Slit::new(k, half_gap.max(1) as f64);
    let (mut worst, mut place, mut squares) = (0.0f64, [0.0; 2], [0.0; 2]);
    for x in (wavelength as usize..reach).step_by(2) {
        for z in (half - reach..half + reach).step_by(2) {
            let from_gap = [x as f64 + 1.0, z as f64 + 0.5 - half as f64];
            let truth = match opening {
                Opening::Gap(_) => slit.at(from_gap[0], from_gap[1]).norm(),
                Opening::End => half_plane(k, from_gap[0], from_gap[1]).norm(),
            };
            let error = sums[z * cells[0] + BEFORE + 1 + x].norm() - truth;
            squares[0] += error * error;
            squares[1] += truth * truth;
            if error.abs() > worst {
                (worst, place) = (error.abs(), from_gap.map(|x| (x / wavelength * 10.0).round() / 10.0));
            }
        }
    }
    let variant = match opening {
        Opening::Gap(widths) => format!("gap of about {widths} wavelengths"),
        Opening::End => "end of a wall".to_owned(),
    };
    let rounded = |x: f64| (x * 100.0).round() / 100.0;
    Ok(Row::new("diffraction", variant)
        .param("cells_per_wavelength", rounded(wavelength))
        .param("gap_cells", 2 * half_gap)
        .param("rms_percent", rounded(100.0 * (squares[0] / squares[1]).sqrt()))
        .param("worst_at_wavelengths", format!("{place:?}"))
        .error(100.0 * worst, "%", "of the incoming height: slit by its integral equation, half-plane by Sommerfeld")
        .bound(5.0)
        .time("the whole run", &took))
}
