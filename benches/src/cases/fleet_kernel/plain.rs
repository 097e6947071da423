//! The plain loop that the fleet is measured against: a struct a body, one body after the other, as one would write it
//! first. The same forces and integration as `floating-body`'s for boxes on water without decay.

use floating_body::{Body, BodyState, Coefficients, Drag, GRAVITY, SurfacePatch, WaterSurface};
use glam::{Mat3, Quat, Vec2, Vec3};

/// How the tensor is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cases) enum Way {
    /// One number, no gyroscopic term.
    PreRigid,
    /// Principal moments, the midpoint rule.
    Full,
    /// What the paper compares with: the tensor turned into the world and inverted in every step, an explicit cross
    /// product.
    Inverted,
}

/// What a body reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cases) enum Reads {
    /// A plane.
    Plane,
    /// The height at each point.
    Points,
}

struct Point {
    at: Vec3,
    half: Vec3,
    volume: f32,
}

/// Many bodies.
pub(in crate::cases) struct Plain {
    pub(in crate::cases) pieces: Vec<BodyState>,
    points: Vec<Point>,
    way: Way,
    reads: Reads,
    mass: f32,
    moments: Vec3,
    coefficients: Coefficients,
    drag: Drag,
    lateral: Vec3,
    /// Of the hull, and displaced at rest.
    volumes: [f32; 2],
    footprint: f32,
    weight: f32,
}

impl Plain {
    pub(in crate::cases) fn new(body: &Body, pieces: Vec<BodyState>, way: Way, reads: Reads) -> Self {
        let desc = body.desc();
        let points = body.force_points();
        let tensor = desc.unit_inertia * desc.mass;
        let mut moments = Vec3::new(tensor.x_axis.x, tensor.y_axis.y, tensor.z_axis.z);
        if way == Way::PreRigid {
            moments = Vec3::splat(moments.element_sum() / 3.0);
        }
        Self {
            pieces,
            points: points.iter().map(|p| Point { at: p.position, half: p.half, volume: p.volume }).collect(),
            way,
            reads,
            mass: desc.mass,
            moments,
            coefficients: desc.coefficients,
            drag: desc.drag,
            lateral: desc.drag.lateral_center - desc.center_of_mass,
            volumes: [points.iter().map(|p| p.volume).sum(), body.waterline().volume],
            footprint: (body.waterline().area / std::f32::consts::PI).sqrt(),
            weight: desc.water_density * GRAVITY,
        }
    }

    pub(in crate::cases) fn tick(&mut self, dt: f32, water: &impl WaterSurface) {
        let mut pieces = std::mem::take(&mut self.pieces);
        for piece in &mut pieces {
            self.step(piece, dt, water);
        }
        self.pieces = pieces;
    }

    fn step(&self, s: &mut BodyState, dt: f32, water: &impl WaterSurface) {
        let center = Vec2::new(s.position.x, s.position.z);
        let patch = water.patch(center, self.footprint);
        let slope = patch.gradient.clamp_length_max(1.0);
        let gradient = Vec3::new(-slope.x, 1.0, -slope.y);
        let rotation = Mat3::from_quat(s.orientation);
        let back = rotation.transpose();
        let normal = back * gradient.normalize();
        let (mut force, mut torque, mut volume) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for p in &self.points {
            let r = rotation * p.at;
            let at = s.position + r;
            let place = Vec2::new(at.x, at.z);
            let surface = match self.reads {
                Reads::Plane => patch.height + slope.dot(place - center),
                Reads::Points => water.patch(place, 0.0).height,
            };
            let scaled = p.half * normal;
            let extent = scaled.length();
            let u = ((surface - at.y) / extent).min(1.0);
            if u <= -1.0 {
                continue;
            }
            let share = 0.5 + 0.5 * u;
            let shift = rotation * (p.half * scaled / extent) * (0.25 * (1.0 - u * u) / share);
            let push = gradient * (self.weight * p.volume * share);
            force += push;
            torque += (r - shift).cross(push);
            volume += p.volume * share;
        }
        force.y -= self.mass * GRAVITY;
        self.move_on(s, dt, &patch, (rotation, back), (force, torque), volume);
    }

    fn move_on(
        &self,
        s: &mut BodyState,
        dt: f32,
        patch: &SurfacePatch,
        (rotation, back): (Mat3, Mat3),
        (force, torque): (Vec3, Vec3),
        volume: f32,
    ) {
        let (c, drag) = (&self.coefficients, &self.drag);
        let [hull, rest] = self.volumes;
        let share = (volume / rest).min(2.0);
        let radiating = share * ((hull - volume) * 2.0 / (hull - rest)).clamp(0.0, 1.0);
        let water = if volume > 0.0 { back * patch.velocity } else { Vec3::ZERO };
        let whole = Vec3::splat(self.mass) + c.added_mass * share;
        let drive = back * force + c.added_mass * share * (back * (Vec3::Y * patch.acceleration));
        let pushed = back * s.velocity + drive / whole * dt - water;
        let linear = drag.linear * share + c.damping * radiating;
        let across = pushed.length_squared();
        let speed = |own: f32, cross: f32| (own * own + cross * cross * (across - own * own).max(0.0)).sqrt();
        let cross = drag.cross_flow;
        let speeds = Vec3::new(speed(pushed.x, cross.x), speed(pushed.y, cross.y), speed(pushed.z, cross.z));
        let rates = drag.quadratic * speeds * Vec3::new(share, share.min(1.0), share);
        let slowed = implicit(pushed, linear / whole, rates / whole, dt);
        let sideways = whole.z * (slowed.z - pushed.z) / dt;
        s.velocity = rotation * (slowed + water);

        let torque = back * torque + self.lateral.cross(Vec3::Z * sideways);
        let inertia = self.moments + c.added_inertia * share;
        let spin = back * s.angular_velocity;
        let turning = match self.way {
            Way::Inverted => spin + back * self.inverted(s, rotation, inertia, rotation * torque) * dt,
            _ => spin + torque / inertia * dt,
        };
        let linear =
            (drag.angular_linear + drag.angular_forward * slowed.length()) * share + c.angular_damping * radiating;
        let rates = drag.angular_quadratic * turning.abs() * share;
        let driven = implicit(turning, linear / inertia, rates / inertia, dt).clamp_length_max(60.0);
        let (turned, mean) = if self.way == Way::Full { tumble(inertia, driven, dt) } else { (driven, driven) };
        let half = 0.5 * dt * mean;
        s.orientation = (s.orientation * Quat::from_xyzw(half.x, half.y, half.z, 1.0)).normalize();
        s.angular_velocity = s.orientation * turned;
        s.position += s.velocity * dt;
    }

    /// Angular acceleration, world axes (the paper's Eq. 4).
    fn inverted(&self, s: &BodyState, rotation: Mat3, inertia: Vec3, torque: Vec3) -> Vec3 {
        let tensor = rotation * Mat3::from_diagonal(inertia) * rotation.transpose();
        tensor.inverse() * (torque - s.angular_velocity.cross(tensor * s.angular_velocity))
    }
}

/// A step of drag, linear and quadratic, in closed form.
fn implicit(v: Vec3, linear: Vec3, rates: Vec3, dt: f32) -> Vec3 {
    let whole = Vec3::ONE + linear * dt;
    let root = whole * whole + rates * (4.0 * dt);
    v * 2.0 / (whole + Vec3::new(root.x.sqrt(), root.y.sqrt(), root.z.sqrt()))
}

/// Euler's equations by the implicit midpoint rule: the end and the middle.
fn tumble(inertia: Vec3, w0: Vec3, dt: f32) -> (Vec3, Vec3) {
    let b = Vec3::new(inertia.y - inertia.z, inertia.z - inertia.x, inertia.x - inertia.y) / inertia * (0.5 * dt);
    let others = |m: Vec3| Vec3::new(m.y * m.z, m.z * m.x, m.x * m.y);
    let mut m = w0 + b * others(w0);
    for _ in 0..2 {
        let jacobian = Mat3::from_cols(
            Vec3::new(1.0, -b.y * m.z, -b.z * m.y),
            Vec3::new(-b.x * m.z, 1.0, -b.z * m.x),
            Vec3::new(-b.x * m.y, -b.y * m.x, 1.0),
        );
        m -= jacobian.inverse() * (m - w0 - b * others(m));
    }
    (m * 2.0 - w0, m)
}
