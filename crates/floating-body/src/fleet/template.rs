//! What all pieces of a fleet have in common, as the kernel reads it.

use glam::{Mat3, Vec3};

use crate::body::{FINEST, MOST_SUBSTEPS};
use crate::desc::Inertia;
use crate::{Body, Coefficients, Drag, GRAVITY, PointShape};

/// A force point, relative to the centre of mass.
pub(super) struct Spot {
    pub(super) at: Vec3,
    pub(super) volume: f32,
}

/// Force points of one size and shape.
pub(super) struct Group {
    pub(super) half: Vec3,
    pub(super) shape: PointShape,
    pub(super) spots: Vec<Spot>,
}

/// How a piece turns.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Turning {
    /// As if the tensor were a number.
    PreRigid,
    /// The hull's axes are the principal ones.
    Diagonal,
    /// With products of inertia.
    Full,
}

/// See the module.
pub(super) struct Template {
    pub(super) groups: Vec<Group>,
    /// kg.
    pub(super) mass: f32,
    /// kg m^2.
    pub(super) inertia: Mat3,
    pub(super) turning: Turning,
    pub(super) coefficients: Coefficients,
    pub(super) drag: Drag,
    /// From the centre of mass to where sideways resistance attacks, m.
    pub(super) lateral: Vec3,
    pub(super) blunt: bool,
    /// Weight of water, N/m^3.
    pub(super) weight: f32,
    /// Volume displaced at rest, m^3.
    pub(super) volume: f32,
    /// Volume of the hull, m^3.
    pub(super) whole: f32,
    /// Of all points, m^3, and how fast radiation fades as they go under, 1/m^3.
    pub(super) points: f32,
    pub(super) sheds: f32,
    /// Of the disc over which the water is averaged, m.
    pub(super) footprint: f32,
    /// Of the disc over which its displacement is spread, m: that with the area of the waterline's rectangle.
    pub(super) radius: f32,
    /// Half the bounding box's diagonal, m.
    pub(super) reach: f32,
    /// Squares of the highest frequencies in heave and in rotation, rad^2/s^2.
    stiffness: [f32; 2],
}

/// A tick cut into sub-steps.
#[derive(Clone, Copy)]
pub(super) struct Pace {
    /// Length of the tick, s.
    pub(super) tick: f32,
    /// Length of a sub-step, s.
    pub(super) dt: f32,
    pub(super) count: u32,
    /// What the sub-steps cannot resolve is held back as an implicit step would: divisors of drive and torque.
    pub(super) held: [f32; 2],
}

impl Template {
    pub(super) fn new(body: &Body) -> Self {
        let desc = body.desc();
        let mut groups: Vec<Group> = Vec::new();
        for point in body.force_points() {
            let (at, volume) = (point.position, point.volume);
            let spot = Spot { at, volume };
            match groups.iter_mut().find(|g| g.half == point.half && g.shape == point.shape) {
                Some(group) => group.spots.push(spot),
                None => groups.push(Group { half: point.half, shape: point.shape, spots: vec![spot] }),
            }
        }
        let inertia = body.inertia();
        let diagonal = Mat3::from_diagonal(Vec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z));
        let straight = (inertia - diagonal).abs_diff_eq(Mat3::ZERO, 1.0e-6 * diagonal.y_axis.y);
        let turning = match desc.inertia {
            Inertia::PreRigid => Turning::PreRigid,
            Inertia::Full if straight => Turning::Diagonal,
            Inertia::Full => Turning::Full,
        };
        Self {
            groups,
            mass: desc.mass,
            inertia,
            turning,
            coefficients: desc.coefficients,
            drag: desc.drag,
            lateral: desc.drag.lateral_center - desc.center_of_mass,
            blunt: desc.hull.is_blunt(),
            weight: desc.water_density * GRAVITY,
            volume: body.waterline().volume,
            whole: desc.hull.volume(),
            points: body.volume,
            sheds: body.sheds,
            footprint: body.footprint,
            radius: (body.waterline().extent.element_product().max(1.0e-6) * std::f32::consts::FRAC_1_PI).sqrt(),
            reach: body.bounding_radius(),
            stiffness: body.stiffness().to_array(),
        }
    }

    /// As [`Body::step`] cuts a tick.
    pub(super) fn pace(&self, tick: f32) -> Pace {
        let [heave, turn] = self.stiffness;
        let count = (tick * heave.max(turn).sqrt() / FINEST).ceil().clamp(1.0, MOST_SUBSTEPS);
        let dt = tick / count;
        let held = self.stiffness.map(|s| 1.0 + (s * dt * dt - FINEST * FINEST).max(0.0));
        Pace { tick, dt, count: count as u32, held }
    }
}
