//! Cases `pml_medium` (walls and beds that cross the border layer), `bound_medium` (nothing grows over them) and
//! `grid_medium` (what a medium costs).

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{Border, CellKind, GridDesc, Medium, MediumCell, Scheme, Source, WaveGrid};

use super::grid_border::reflection;
use crate::{
    evidence::{Case, CaseError, Context, Row, measure_together},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const PML: Case = Case {
    name: "pml_medium",
    about: "what the border sends back where walls and beds cross it, against a larger domain",
    plots: &[],
    run: pulse,
};

/// See the module.
pub(super) const BOUND: Case = Case {
    name: "bound_medium",
    about: "height of waves late in a window's long way past walls and depths, against early in it",
    plots: &[],
    run: wandering,
};

/// See the module.
pub(super) const COST: Case = Case {
    name: "grid_medium",
    about: "a tick of a grid whose medium varies everywhere, beside one in plain water",
    plots: &[],
    run: cost,
};

/// Half the cells of the interior that both domains share.
const HALF: f64 = 64.0;

/// Speed over that in deep water, and kind, by the place in cells from the middle.
type MediumOf = fn(DVec2) -> (f32, CellKind);

/// A medium by a function of the place in cells from the middle. Beyond the interior it goes on along the normal, so that
/// nothing but the layer sends waves back.
struct By {
    cell: f64,
    medium: MediumOf,
}

impl Medium for By {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let within = (place / self.cell).clamp(DVec2::splat(0.5 - HALF), DVec2::splat(HALF - 0.5));
        let (share, kind) = (self.medium)(within);
        MediumCell { speed: deep_speed * share, damping: 0.0, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn wall(is: bool) -> (f32, CellKind) {
    (1.0, if is { CellKind::Wall } else { CellKind::Open })
}

fn pulse(_: &Context) -> Result<Vec<Row>, CaseError> {
    let media: [(&str, f64, MediumOf); 5] = [
        ("plain water", -75.0, |_| wall(false)),
        ("a channel", -50.0, |p| wall(p.y.abs() > 24.0)),
        ("a wall that meets the border at an angle", -55.0, |p| wall(0.3 * p.x + p.y < -30.0)),
        ("a bed that varies along the border", -50.0, |p| (0.75 + 0.25 * (p.y * 0.05).sin() as f32, CellKind::Open)),
        ("a bed that rises towards the border", -50.0, |p| {
            (1.0 - 0.4 * ((p.x - 20.0) / 80.0).clamp(0.0, 1.0) as f32, CellKind::Open)
        }),
    ];
    let mut rows = Vec::new();
    for (variant, bound, medium) in media {
        let grid = |cells: u32| -> Result<WaveGrid, CaseError> {
            let desc = GridDesc { cells: [cells; 2], border: Border::Absorbing { width: 12 }, ..fixtures::grid() };
            let mut grid = WaveGrid::new(desc)?;
            grid.set_medium(Some(Arc::new(By { cell: f64::from(desc.cell_size[0]), medium })));
            Ok(grid)
        };
        let decibels = reflection(&mut grid(128 + 26)?, &mut grid(512)?);
        rows.push(
            Row::new("pml_medium", variant)
                .param("width", 12)
                .error(decibels, "dB", "512^2 domain; over the peak at the border")
                .bound(bound),
        );
    }
    Ok(rows)
}

/// Pillars, blocks, held water and rough speeds, cell by cell of half a metre.
struct Rough;

impl Medium for Rough {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let [x, z] = [place.x, place.y].map(|x| (x / 0.5).floor() as i64);
        let random = |x: i64, z: i64, salt: u64| {
            Random::new((x as u64).wrapping_mul(0x9E37_79B9) ^ (z as u64).wrapping_mul(0xC2B2_AE3D_0001) ^ salt)
                .within(0.0, 1.0)
        };
        let block = random(x.div_euclid(9), z.div_euclid(9), 1);
        let pillar = random(x, z, 2);
        let kind = match block {
            b if b < 0.1 => CellKind::Wall,
            b if b < 0.14 => CellKind::Fixed,
            b if b < 0.3 && pillar < 0.3 => CellKind::Wall,
            _ => CellKind::Open,
        };
        let share = if block < 0.6 { random(x, z, 3).max(0.01) } else { 1.0 };
        MediumCell { speed: deep_speed * share as f32, damping: 0.0, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

/// A window that runs to and fro over a rough medium, at the bounds of both schemes.
fn wandering(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(3_600, 60_000);
    let mut rows = Vec::new();
    for (variant, scheme, a) in [("9-point", Scheme::NinePoint, 0.74), ("5-point", Scheme::FivePoint, 0.49)] {
        let wave_speed = (30.0 * f64::sqrt(a) * 0.9999) as f32;
        let desc = GridDesc { cells: [96; 2], wave_speed, scheme, substeps: Some(1), ..GridDesc::default() };
        let mut grid = WaveGrid::new(desc)?;
        grid.set_medium(Some(Arc::new(Rough)));
        let mut random = Random::new(8);
        let mut peaks = [0.0f64; 2];
        let (mut place, mut velocity) = (DVec2::ZERO, DVec2::ZERO);
        for tick in 0..ticks {
            if tick % 60 == 0 {
                let speed = random.within(0.0, 1.5) * f64::from(wave_speed);
                velocity = DVec2::from_angle(random.within(0.0, std::f64::consts::TAU)) * speed;
            }
            place += velocity * f64::from(desc.tick);
            grid.center_on(place);
            grid.set_origin(place);
            let volume = if tick % 20 < 10 { 0.05 } else { -0.05 };
            grid.add(Source::Displacement { center: Vec2::ZERO, radius: 1.0, volume });
            grid.tick();
            let most = grid.heights().iter().fold(0.0f32, |most, z| most.max(z.abs()));
            let peak = &mut peaks[usize::from(tick >= ticks / 2)];
            *peak = if grid.is_finite() { peak.max(f64::from(most)) } else { f64::NAN };
        }
        rows.push(
            Row::new("bound_medium", variant)
                .param("ticks", ticks)
                .param("a", a)
                .param("peak_m", (peaks[0] * 1e3).round() / 1e3)
                .error(peaks[1] / peaks[0], "ratio", "highest wave of the run's second half over that of its first")
                .bound(4.0),
        );
    }
    Ok(rows)
}

fn cost(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, scene) in [("9-point", fixtures::grid()), ("5-point", fixtures::paper_grid())] {
        for &cells in context.pick(&[256u32][..], &[128, 256, 512]) {
            let desc = GridDesc { cells: [cells; 2], ..scene };
            let rough = |medium: bool| -> Result<WaveGrid, CaseError> {
                let mut grid = WaveGrid::new(desc)?;
                if medium {
                    let bed = |p: DVec2| (0.75 + 0.25 * (p.y * 0.05).sin() as f32, CellKind::Open);
                    grid.set_medium(Some(Arc::new(By { cell: f64::from(desc.cell_size[0]), medium: bed })));
                }
                let mut random = Random::new(3);
                let heights: Vec<f32> = grid.heights().iter().map(|_| random.within(-0.01, 0.01) as f32).collect();
                grid.impose(&heights, &heights)?;
                grid.set_tile_skipping(false);
                Ok(grid)
            };
            let (mut mixed, mut plain) = (rough(true)?, rough(false)?);
            let [ours, theirs] = measure_together(context.effort, [&mut || mixed.tick(), &mut || plain.tick()]);
            rows.push(
                Row::new("grid_medium", variant)
                    .param("cells", cells)
                    .time("a tick with a bed under the whole window", &ours)
                    .baseline("the same window in plain water", &theirs),
            );
        }
    }
    Ok(rows)
}
