//! Case `sinkage`: a hull towed over calm water sinks and trims in its own waves.

use floating_body::{BodyDesc, Closure, Hull, Radiation, TriMesh};
use glam::{Quat, Vec3};
use open_water::{BodyState, BodyStates, Follow, GridDesc, OpenWater, OpenWaterDesc, Preset, Scheme};
use wave_grid::Border;

use crate::{
    evidence::{Case, CaseError, Context, Row},
    fixtures::FRAME,
};

/// See the module.
pub(super) const SINKAGE: Case = Case {
    name: "sinkage",
    about: "sinkage and trim of a towed hull in its own waves: local scheme against exact dispersion",
    plots: &[],
    run: sinkage,
};

/// Length, beam and draft of the hull, m.
const SIZE: Vec3 = Vec3::new(20.0, 1.5, 6.0);
const MASS: f32 = 60e3;
/// Ticks of speeding up, of waiting for a steady wake, and of the mean.
const TICKS: [u32; 3] = [240, 960, 360];

/// A hull with parabolic waterlines and sections, walls above the water.
fn hull() -> Result<Hull, CaseError> {
    let (along, across) = (12u32, 6u32);
    let mut vertices = Vec::new();
    for i in 0..=along {
        let x = 2.0 * i as f32 / along as f32 - 1.0;
        let half = (1.0 - x * x).max(0.02);
        for j in 0..=across {
            let z = 2.0 * j as f32 / across as f32 - 1.0;
            let depth = SIZE.y * (1.0 - z * z) * half.sqrt();
            vertices.push(Vec3::new(0.5 * SIZE.x * x, -depth, 0.5 * SIZE.z * z * half));
        }
        for z in [-1.0, 1.0] {
            vertices.push(Vec3::new(0.5 * SIZE.x * x, SIZE.y, 0.5 * SIZE.z * z * half));
        }
    }
    let indices = (0..vertices.len() as u32 - 2).flat_map(|i| [i, i + 1, i + 2]).collect();
    Ok(Hull::from_mesh(&TriMesh { vertices, indices }, Closure::ConvexHull)?)
}

/// Mean sinkage in m (down) and trim in degrees (bow up) at a speed.
fn towed(scheme: Scheme, speed: f32) -> Result<[f64; 2], CaseError> {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc)?;
    let hull = hull()?;
    let mut body = BodyDesc::from_hull(&hull, MASS);
    body.center_of_mass.y = 0.0;
    body.estimate();
    body.radiation = Radiation::Grid;
    let body = water.add_body(body)?;
    water.add_grid(GridDesc {
        follow: Follow::Body(body),
        cells: [256, 192],
        cell_size: [0.5; 2],
        scheme,
        border: Border::Absorbing { width: 20 },
        ..GridDesc::default()
    })?;
    let rest = water.body(body)?.rest_height();
    let mut store = BodyStates::default();
    store.insert(body, BodyState::at_rest(Vec3::Y * rest));
    let [ramp, wait, mean] = TICKS;
    let mut sums = [0.0; 2];
    for i in 0..ramp + wait + mean {
        if let Some(state) = store.get_mut(body) {
            // On a rail: free in heave and pitch.
            state.velocity = Vec3::new(speed * (i as f32 / ramp as f32).min(1.0), state.velocity.y, 0.0);
            state.position.z = 0.0;
            let pitch = state.orientation.to_axis_angle();
            state.orientation = Quat::from_rotation_z(pitch.0.z * pitch.1);
            state.angular_velocity = Vec3::Z * state.angular_velocity.z;
        }
        for tick in water.advance(FRAME) {
            water.tick(tick, &mut store)?;
        }
        if let Some(state) = store.get(body).filter(|_| i >= ramp + wait) {
            sums[0] += f64::from(rest - state.position.y) / f64::from(mean);
            sums[1] += f64::from((state.orientation * Vec3::X).y.asin().to_degrees()) / f64::from(mean);
        }
    }
    Ok(sums)
}

fn sinkage(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let speeds: &[f32] = context.pick(&[5.0], &[2.5, 5.0, 7.0]);
    for &speed in speeds {
        let [found, exact] = [towed(Scheme::Dispersive, speed)?, towed(Scheme::Spectral, speed)?];
        let row = Row::new("sinkage", "towed hull")
            .param("speed", f64::from(speed))
            .param("sinkage_mm", (1e3 * found[0]).round())
            .param("exact_mm", (1e3 * exact[0]).round())
            .param("bow_up_deg", (100.0 * found[1]).round() / 100.0)
            .param("exact_deg", (100.0 * exact[1]).round() / 100.0)
            .error(
                100.0 * (found[0] / exact[0] - 1.0).abs(),
                "% of the sinkage",
                "the same hull with exact dispersion",
            );
        rows.push(if speed == 5.0 { row.bound(10.0) } else { row });
    }
    Ok(rows)
}
