//! Case `grid_gpu_error`: the GPU's grids against the CPU's after a thousand ticks, by queries.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::gpu::GpuGrids;
use wave_grid::{CellKind, GridDesc, GridSample, Medium, MediumCell, Scheme, Source, WaveGrid};

use crate::evidence::{Case, CaseError, Context, Row};

/// See the module.
pub(super) const ERROR: Case = Case {
    name: "grid_gpu_error",
    about: "a grid on the GPU against one on the CPU after a thousand ticks with sources, shifts and walls",
    plots: &[],
    run,
};

/// Pillars of wall, and water that is slower and damped, east of x = 20 m.
struct Pillars;

impl Medium for Pillars {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let cell = (place / 5.0).floor();
        let pillar = place.x > 20.0 && (cell.x + 2.0 * cell.y).rem_euclid(5.0) == 0.0;
        let slow = place.x > 20.0 && place.y > 0.0;
        MediumCell {
            speed: if slow { 0.6 * deep_speed } else { deep_speed },
            damping: if slow { 0.2 } else { 0.0 },
            kind: if pillar { CellKind::Wall } else { CellKind::Open },
            ..MediumCell::default()
        }
    }

    fn is_plain(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 20.0
    }
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    const TICKS: usize = 1000;
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for (variant, scheme, walls) in [
        ("9-point, plain water", Scheme::NinePoint, false),
        ("9-point, walls and slow water", Scheme::NinePoint, true),
        ("5-point, plain water", Scheme::FivePoint, false),
    ] {
        let desc = GridDesc { cells: [128, 112], wave_speed: 20.0, scheme, ..GridDesc::default() };
        let medium = walls.then(|| Arc::new(Pillars) as Arc<dyn Medium>);
        let mut cpu = WaveGrid::new(desc)?;
        cpu.set_medium(medium.clone());
        // Shaders make the gentler layer.
        cpu.set_matched_motion(false);
        let mut grids = GpuGrids::new(&gpu.device);
        grids.set_medium(medium);
        let id = grids.insert(desc)?;
        let points: Vec<Vec2> = (0..4096).map(|k| Vec2::new((k % 64) as f32 * 1.9, (k / 64) as f32) - 32.0).collect();
        let mut samples = vec![GridSample::default(); points.len()];
        let [mut worst, mut most] = [0.0f32; 2];
        for t in 0..TICKS {
            let time = t as f64 / 60.0;
            let middle = DVec2::new(20.0 + 25.0 * (0.5 * time).sin(), 6.0 * (0.3 * time).sin());
            cpu.center_on(middle);
            grids.center_on(id, middle);
            let center = middle.as_vec2() + Vec2::from_angle(3.0 * time as f32) * 4.0;
            let volume = 0.4 * (14.0 * time as f32).sin();
            let source = Source::Displacement { center, radius: 1.2, volume };
            cpu.add(source);
            grids.add(id, source);
            cpu.tick();
            grids.tick();
            let asked = t % 50 == 49;
            gpu.frame(|frame| {
                grids.encode(frame);
                if asked {
                    grids.encode_query(frame, &points);
                }
            })?;
            if asked {
                let answer = grids.poll_query(&gpu.device).ok_or("the query did not come back")?;
                cpu.sample(&points, &mut samples);
                for (ours, theirs) in answer.samples.iter().zip(&samples) {
                    // NaN counts as worst.
                    let difference = (ours.height - theirs.height).abs();
                    worst = if difference <= worst { worst } else { difference };
                    most = most.max(theirs.height.abs());
                }
            }
        }
        rows.push(
            Row::new("grid_gpu_error", variant)
                .param("ticks", TICKS)
                .param("highest_m", f64::from(most))
                .error(f64::from(worst / most), "of the highest wave", "the CPU's grid, 4096 points every 50 ticks")
                .bound(1e-5),
        );
    }
    Ok(rows)
}
