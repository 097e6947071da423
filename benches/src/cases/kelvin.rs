//! Cases `kelvin` (half-angle of the wakes of the schemes of water waves, against Kelvin's) and `spectral_energy`.

use glam::{DVec2, Vec2};
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, picture},
    truth::wedge::{self, Room, Wedge},
};

/// See the module.
pub(super) const KELVIN: Case = Case {
    name: "kelvin",
    about: "half-angle of the wake of a moving pressure at 4, 5 and 6 m/s, median over its sizes, against 19.47 degrees",
    plots: &[
        Plot {
            file: "kelvin",
            title: "Half-angle of wakes (Kelvin: 19.47 degrees), median over the source's sizes",
            x: Axis::Param("speed"),
            y: Axis::Param("degrees"),
            label: Some("degrees"),
        },
        Plot {
            file: "kelvin_sizes",
            title: "Half-angle of wakes by the source's radius",
            x: Axis::Param("radius_m"),
            y: Axis::Param("size_degrees"),
            label: None,
        },
    ],
    run: angles,
};

/// See the module.
pub(super) const ENERGY: Case = Case {
    name: "spectral_energy",
    about: "energy of the spectral scheme over 5,000 steps, and the volume, in a basin that repeats",
    plots: &[],
    run: energy,
};

/// Cell size, metres.
const CELL: f64 = 0.5;
/// Cells of the border: as wide as most waves are long, which the damping of the spectral scheme needs.
const BORDER: u32 = 36;
/// Metres from the middle of the window forward to the source.
const AHEAD: f64 = 40.0;

/// By so much, degrees, the estimator may be off on the exact scheme where another is held against Kelvin's angle itself.
const ESTIMATOR: f64 = 0.2;

/// A wake in its window: the grid and where its source is now.
struct Wake {
    grid: WaveGrid,
    source: DVec2,
}

impl Wake {
    /// Lets a round pressure sail along x until its wake fills the window.
    fn sail(desc: GridDesc, speed: f64, radius: f64) -> Result<Self, CaseError> {
        let mut grid = WaveGrid::new(desc)?;
        let tick = f64::from(desc.tick);
        let length = f64::from(desc.cells[0]) * CELL;
        // The waves of the caustic fall behind by two thirds of the speed, the transverse ones by half.
        let time = 1.4 * length / speed + 4.0;
        let mut source = DVec2::ZERO;
        for step in 0..(time / tick) as u32 {
            source.x += speed * tick;
            grid.center_on(source - DVec2::new(AHEAD, 0.0));
            grid.set_origin(source);
            let rise = (f64::from(step) * tick / 2.0).min(1.0);
            let pressure = (500.0 * rise * rise * (3.0 - 2.0 * rise)) as f32;
            // The library adds a cell and a half to the radius.
            let radius = (radius - 1.5 * CELL) as f32;
            if !grid.add(Source::Pressure { center: Vec2::ZERO, radius, pressure }) {
                return Err("a source was dropped".into());
            }
            grid.tick();
        }
        Ok(Self { grid, source })
    }

    /// Height at a place behind and beside the source, metres, by Catmull and Rom's cubic along x.
    fn height(&self, behind: f64, aside: f64) -> f64 {
        let window = self.grid.window();
        let at = [self.source.x - behind, self.source.y + aside];
        let at = [0, 1].map(|k| at[k] / CELL - window.corner[k] as f64 - 0.5);
        let weights = |x: f64| {
            let t = x - x.floor();
            let (t2, t3) = (t * t, t * t * t);
            [2.0 * t2 - t - t3, 2.0 - 5.0 * t2 + 3.0 * t3, t + 4.0 * t2 - 3.0 * t3, t3 - t2].map(|w| 0.5 * w)
        };
        let (heights, nx) = (self.grid.heights(), window.cells[0] as usize);
        let mut sum = 0.0;
        for (j, wz) in weights(at[1]).into_iter().enumerate() {
            let row = (at[1].floor() as usize + j - 1) * nx;
            for (i, wx) in weights(at[0]).into_iter().enumerate() {
                sum += wz * wx * f64::from(heights[row + at[0].floor() as usize + i - 1]);
            }
        }
        sum
    }

    /// The part of the window that the border leaves alone.
    fn room(&self) -> Room {
        let [length, width] = self.grid.desc().cells.map(|n| f64::from(n) * CELL);
        let border = (f64::from(BORDER) + 4.0) * CELL;
        Room { step: CELL, behind: 0.5 * length + AHEAD - border, aside: 0.5 * width - border }
    }

    /// A grey picture of the heights, in parts of `most`, the source's course from left to right.
    fn shade(&self, most: f64, place: [usize; 2]) -> u8 {
        let nx = self.grid.desc().cells[0] as usize;
        let z = f64::from(self.grid.heights()[place[1] * nx + place[0]]);
        (127.5 + 127.0 * (z / most).clamp(-1.0, 1.0)) as u8
    }
}

fn desc(scheme: Scheme, cells: [u32; 2]) -> GridDesc {
    let (tick, border) = match scheme {
        // Any tick is exact: long ones save time.
        Scheme::Spectral => (1.0 / 15.0, BORDER),
        Scheme::Dispersive => (1.0 / 60.0, 16),
        _ => (1.0 / 60.0, 16),
    };
    GridDesc {
        cells,
        scheme,
        tick,
        border: Border::Absorbing { width: border },
        wave_speed: 3.0,
        ..GridDesc::default()
    }
}

/// The middle of an even or odd number of values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2])
}

fn angles(context: &Context) -> Result<Vec<Row>, CaseError> {
    let truth = (1.0f64 / 3.0).asin().to_degrees();
    let cells = context.pick([256, 256], [512, 384]);
    let radii = context.pick(&[1.5, 2.0, 3.0, 4.0][..], &[1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
    let mut rows = Vec::new();
    for speed in [4.0, 5.0, 6.0] {
        let mut exact = f64::NAN;
        for (scheme, name) in [(Scheme::Spectral, "spectral"), (Scheme::Dispersive, "dispersive")] {
            let mut found = Vec::new();
            for &radius in radii {
                let wake = Wake::sail(desc(scheme, cells), speed, radius)?;
                let wedge = wedge::kelvin(speed, wake.room(), |behind, aside| wake.height(behind, aside));
                let Wedge { degrees, scatter, .. } = wedge.ok_or("no wedge is found")?;
                found.push(degrees);
                let row = Row::new("kelvin", format!("{name}, {speed} m/s")).param("radius_m", radius);
                let row = row.param("size_degrees", rounded(degrees)).param("scatter_m", rounded(scatter));
                rows.push(row.error((degrees - truth).abs(), "degrees", "19.47 degrees, one size"));
                if speed == 5.0 && radius == 2.0 {
                    show(context, name, &wake)?;
                }
            }
            let degrees = median(found);
            let mut row = Row::new("kelvin", format!("{name}, median")).param("speed", speed);
            row = row.param("degrees", rounded(degrees)).param("off_exact", rounded(degrees - exact));
            row = if scheme == Scheme::Spectral {
                exact = degrees;
                row.error((degrees - truth).abs(), "degrees", "19.47 degrees: the estimator on the exact scheme")
            } else if (exact - truth).abs() <= ESTIMATOR {
                row.error((degrees - truth).abs(), "degrees", "19.47 degrees")
            } else {
                row.error((degrees - exact).abs(), "degrees", "the exact scheme, where the estimator itself is off")
            };
            rows.push(row.bound(0.5));
        }
        // All its waves have one speed, 3 m/s here.
        let wake = Wake::sail(desc(Scheme::NinePoint, cells), speed, 2.0)?;
        let wedge = wedge::mach(Room { behind: 40.0, ..wake.room() }, |behind, aside| wake.height(behind, aside));
        let degrees = wedge.ok_or("no wedge is found")?.degrees;
        let row = Row::new("kelvin", "wave equation").param("speed", speed).param("degrees", rounded(degrees));
        let row = row.param("asin_c_over_u", rounded((3.0 / speed).asin().to_degrees())).param("source_m", 2.0);
        rows.push(row.error((degrees - truth).abs(), "degrees", "19.47 degrees, which it does not have"));
        if speed == 5.0 {
            show(context, "wave_equation", &wake)?;
        }
    }
    Ok(rows)
}

fn rounded(value: f64) -> Option<f64> {
    value.is_finite().then(|| (value * 100.0).round() / 100.0)
}

fn show(context: &Context, name: &str, wake: &Wake) -> Result<(), CaseError> {
    let most = (wake.height(20.0, 0.0).abs()).max(wake.height(24.0, 3.0).abs()).max(wake.height(28.0, 8.0).abs()) * 1.5;
    let size = wake.grid.desc().cells.map(|n| n as usize);
    picture(&context.out.join(format!("kelvin_{name}.png")), size, |x, y| [wake.shade(most, [x, y]); 3])?;
    Ok(())
}

fn energy(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let sizes: &[u32] = context.pick(&[128], &[128, 256, 300]);
    for (&cells, tick) in sizes.iter().flat_map(|cells| [(cells, 1.0 / 60.0), (cells, 0.5)]) {
        let ring = 2;
        let mut grid = WaveGrid::new(GridDesc {
            cells: [cells + ring; 2],
            scheme: Scheme::Spectral,
            border: Border::Periodic,
            tick,
            ..GridDesc::default()
        })?;
        grid.add(Source::Displacement { center: Vec2::new(0.3, -1.1), radius: 6.0, volume: 20.0 });
        let (before, volume) = (grid.energy(), grid.volume());
        (0..5000).for_each(|_| grid.tick());
        let row = Row::new("spectral_energy", "spectral").param("cells", cells).param("tick_s", f64::from(tick));
        let row = row.param("volume_change", grid.volume() / volume - 1.0);
        rows.push(
            row.error((grid.energy() / before - 1.0).abs(), "of the energy", "itself, 5,000 steps before").bound(1e-3),
        );
    }
    Ok(rows)
}
