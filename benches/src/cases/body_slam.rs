//! Case `slam`: a wedge that falls into water.

use std::f64::consts::{FRAC_PI_2, PI};

use floating_body::{
    Body, BodyDesc, BodyState, Closure, Coefficients, Controls, Drag, FlatWater, ForcePoints, Hull, Slamming, TriMesh,
    WATER_DENSITY,
};
use glam::Vec3;

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    truth::G,
};

/// See the module.
pub(super) const SLAM: Case = Case {
    name: "slam",
    about: "force on a wedge that enters water, against Wagner, von Karman and the similarity solution",
    plots: &[Plot {
        file: "slam",
        title: "A wedge enters the water: force over rho v^3 t a metre",
        x: Axis::Param("deadrise_deg"),
        y: Axis::Param("force"),
        label: None,
    }],
    run: slam,
};

/// A wedge of `length` m with its keel at 0 and its chines 1 m out.
fn wedge(deadrise: f32, length: f32) -> Result<Hull, CaseError> {
    let rise = deadrise.tan();
    let section = [(0.0, 0.0), (1.0, rise), (1.0, rise + 1.0), (-1.0, rise + 1.0), (-1.0, rise)];
    let mut mesh = TriMesh::default();
    for x in [-0.5 * length, 0.5 * length] {
        mesh.vertices.extend(section.iter().map(|(z, y)| Vec3::new(x, *y, *z)));
    }
    for i in 0..5_u32 {
        let j = (i + 1) % 5;
        mesh.indices.extend([i, j, 5 + i, j, 5 + j, 5 + i]);
    }
    for i in 1..4 {
        mesh.indices.extend([0, i + 1, i, 5, 5 + i, 6 + i]);
    }
    Ok(Hull::from_mesh(&mesh, Closure::Require)?)
}

/// `F/(rho v^3 t)` a metre of a wedge that keeps its speed: Zhao and Faltinsen (1993), similarity solution (from memory).
const SIMILARITY: [(f64, f64); 6] =
    [(7.5, 399.8), (10.0, 213.98), (15.0, 85.52), (20.0, 42.49), (25.0, 23.66), (30.0, 14.14)];

fn slam(context: &Context) -> Result<Vec<Row>, CaseError> {
    const LENGTH: f64 = 20.0;
    const SPEED: f64 = 10.0;
    const MASS: f64 = 400e3;
    let mut rows = Vec::new();
    for (degrees, similarity) in SIMILARITY {
        let deadrise = degrees.to_radians();
        let tan = deadrise.tan();
        for (variant, force) in [
            ("similarity solution", similarity),
            ("Wagner", PI.powi(3) / (4.0 * tan * tan)),
            ("von Karman", PI / (tan * tan)),
        ] {
            rows.push(Row::new("slam", variant).param("deadrise_deg", degrees).param("force", force));
        }
        let counts: &[u32] = context.pick(&[32, 256], &[16, 32, 64, 128, 256]);
        for &count in counts {
            let mut desc = BodyDesc::from_hull(&wedge(deadrise as f32, LENGTH as f32)?, MASS as f32);
            (desc.drag, desc.coefficients, desc.skin) = (Drag::default(), Coefficients::default(), None);
            desc.points = ForcePoints::Count(count);
            desc.slamming = Some(Slamming { deadrise: deadrise as f32 });
            desc.center_of_mass = Vec3::new(0.0, 0.5, 0.0);
            let mut body = Body::new(desc)?;
            let mut state = BodyState::at_rest(Vec3::Y * 0.8);
            body.set_state(state);
            body.step(1e-4, &FlatWater::default(), &Controls::default());
            (state.position.y, state.velocity.y) = (0.5, -SPEED as f32);
            body.set_state(state);
            // Until the water, piled up, reaches the chines.
            let pile_up = FRAC_PI_2 - deadrise * (1.0 - 2.0 / PI);
            let steps = 400;
            let dt = tan / pile_up / SPEED / f64::from(steps);
            let (mut impulse, mut lifted) = (0.0, 0.0);
            for _ in 0..steps {
                let before = f64::from(body.state().velocity.y);
                body.step(dt as f32, &FlatWater::default(), &Controls::default());
                let after = f64::from(body.state().velocity.y);
                // What is no blow: weight and buoyancy.
                let lift = f64::from(body.immersed_volume() * WATER_DENSITY) * G - MASS * G;
                lifted += lift * dt;
                impulse += MASS * (after - before);
            }
            let time = f64::from(steps) * dt;
            // Pabst's correction is taken out: the theories are for sections.
            let r = LENGTH / 2.0;
            let finite = r / (1.0 + r * r).sqrt() * (1.0 - 0.425 * r / (1.0 + r * r));
            let mean = (impulse - lifted) / time / (LENGTH * finite);
            // A force that grows with time: its mean is half of the last.
            let force = 2.0 * mean / (f64::from(WATER_DENSITY) * SPEED.powi(3) * time);
            let row = Row::new("slam", format!("{count} force points"))
                .param("deadrise_deg", degrees)
                .param("force", force)
                .error(100.0 * (force / similarity - 1.0).abs(), "%", "similarity solution (Zhao and Faltinsen 1993)");
            rows.push(if count >= 32 { row.bound(10.0) } else { row });
        }
    }
    Ok(rows)
}
