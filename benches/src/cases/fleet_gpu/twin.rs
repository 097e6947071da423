//! The kernel's tick in f64, as a plain loop over structs.

use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::fixtures::Random;

const GRAVITY: f64 = 9.81;
/// Cells of the field along a side, and their size in m.
const CELLS: u32 = 1024;
const CELL: f64 = 0.25;
const DT: f64 = 1.0 / 60.0;

/// What all boxes share.
#[derive(Clone, Copy)]
pub(super) struct Settings {
    pub(super) count: u32,
    /// Half its sides, m.
    half: DVec3,
    /// Principal moments, kg m^2.
    inertia: DVec3,
    mass: f64,
    /// Of the water that it can displace, N.
    weight: f64,
    /// Of the speed, 1/s and 1/m.
    drag: f64,
    /// Of the rotation, 1/s.
    spin_drag: f64,
}

impl Settings {
    pub(super) fn new(count: u32) -> Self {
        let (half, mass) = (DVec3::new(0.625, 0.4, 0.5), 400.0);
        let q = half * half / 3.0;
        Self {
            count,
            half,
            inertia: DVec3::new(q.y + q.z, q.x + q.z, q.x + q.y) * mass,
            mass,
            weight: 8.0 * half.x * half.y * half.z * 1025.0 * GRAVITY,
            drag: 0.8,
            spin_drag: 1.5,
        }
    }

    fn mean(&self) -> f64 {
        self.inertia.element_sum() / 3.0
    }

    /// As the kernel's uniform.
    pub(super) fn words(&self) -> Vec<u8> {
        let Self { count, half, inertia, mass, weight, drag, spin_drag } = *self;
        let floats =
            [half.x, half.y, half.z, 0.0, inertia.x, inertia.y, inertia.z, self.mean(), mass, weight, drag, spin_drag];
        let mut bytes = [count, CELLS, (DT as f32).to_bits(), (CELL as f32).to_bits()].map(u32::to_ne_bytes).concat();
        bytes.extend(floats.iter().flat_map(|v| (*v as f32).to_ne_bytes()));
        bytes
    }
}

#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub(super) position: DVec3,
    orientation: DQuat,
    velocity: DVec3,
    spin: DVec3,
}

impl Piece {
    /// As the kernel's struct.
    pub(super) fn words(&self) -> [f64; 16] {
        let (p, q, v, w) = (self.position, self.orientation, self.velocity, self.spin);
        [p.x, p.y, p.z, 0.0, q.x, q.y, q.z, q.w, v.x, v.y, v.z, 0.0, w.x, w.y, w.z, 0.0]
    }
}

pub(super) struct Twin {
    pub(super) settings: Settings,
    way: usize,
    pub(super) field: Vec<f64>,
    pub(super) pieces: Vec<Piece>,
}

fn skew(v: DVec3) -> DMat3 {
    DMat3::from_cols(DVec3::new(0.0, v.z, -v.y), DVec3::new(-v.z, 0.0, v.x), DVec3::new(v.y, -v.x, 0.0))
}

impl Twin {
    pub(super) fn new(settings: Settings, way: usize) -> Self {
        // Waves that repeat with the field.
        let wave = |i: u32, j: u32| {
            let turn = |a: u32, b: u32| f64::from((a * i + b * j) % CELLS) / f64::from(CELLS) * std::f64::consts::TAU;
            0.4 * turn(8, 5).sin() + 0.15 * turn(21, 30).cos() + 0.05 * turn(64, 16).sin()
        };
        let field = (0..CELLS * CELLS).map(|k| f64::from(wave(k % CELLS, k / CELLS) as f32)).collect();
        let mut random = Random::new(11);
        let side = f64::from(CELLS) * CELL;
        let pieces = (0..settings.count)
            .map(|_| {
                let single = |low: f64, high: f64, random: &mut Random| f64::from(random.within(low, high) as f32);
                let place = DVec3::new(single(0.0, side, &mut random), 0.3, single(0.0, side, &mut random));
                let turn = DQuat::from_rotation_y(single(-3.0, 3.0, &mut random));
                Piece { position: place, orientation: turn.normalize(), velocity: DVec3::ZERO, spin: DVec3::ZERO }
            })
            .collect();
        Self { settings, way, field, pieces }
    }

    fn water(&self, at: DVec2) -> (f64, DVec2) {
        let place = at / CELL;
        let (base, t) = (place.floor(), place - place.floor());
        let at = |x: i64, z: i64| {
            let wrap = |i: i64| i.rem_euclid(i64::from(CELLS)) as usize;
            self.field[wrap(z) * CELLS as usize + wrap(x)]
        };
        let (i, j) = (base.x as i64, base.y as i64);
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        let (near, far) = (a + (c - a) * t.y, b + (d - b) * t.y);
        let (low, high) = (a + (b - a) * t.x, c + (d - c) * t.x);
        (near + (far - near) * t.x, DVec2::new(far - near, high - low) / CELL)
    }

    pub(super) fn tick(&mut self) {
        for i in 0..self.pieces.len() {
            self.pieces[i] = self.moved(&self.pieces[i]);
        }
    }

    fn moved(&self, piece: &Piece) -> Piece {
        let s = &self.settings;
        let axes = DMat3::from_quat(piece.orientation);
        let (mut force, mut torque, mut wet) = (DVec3::new(0.0, -s.mass * GRAVITY, 0.0), DVec3::ZERO, 0.0);
        for k in 0..8 {
            let side = |bit: i32| f64::from(k >> bit & 1) - 0.5;
            let arm = axes * (DVec3::new(side(0), side(1), side(2)) * s.half);
            let at = piece.position + arm;
            let (height, slope) = self.water(DVec2::new(at.x, at.z));
            let gradient = DVec3::new(-slope.x, 1.0, -slope.y);
            let extent = (s.half * 0.5 * (axes.transpose() * gradient.normalize())).length();
            let share = (0.5 + 0.5 * (height - at.y) / extent).clamp(0.0, 1.0);
            let lift = gradient * (0.125 * s.weight * share);
            force += lift;
            torque += arm.cross(lift);
            wet += 0.125 * share;
        }
        let mut velocity = piece.velocity + force * (DT / s.mass);
        velocity /= 1.0 + DT * s.drag * wet * (1.0 + velocity.length());
        let tensor = DMat3::from_diagonal(s.inertia);
        let mut spin = piece.spin;
        match self.way {
            0 => spin += torque / s.mean() * DT,
            1 => {
                let mut w = axes.transpose() * spin + (axes.transpose() * torque) / s.inertia * DT;
                let momentum = s.inertia * w;
                let jacobian = tensor + (skew(w) * tensor - skew(momentum)) * DT;
                w -= jacobian.inverse() * w.cross(momentum) * DT;
                spin = axes * w;
            }
            _ => {
                let whole = axes * tensor * axes.transpose();
                spin += whole.inverse() * (torque - spin.cross(whole * spin)) * DT;
            }
        }
        spin /= 1.0 + DT * s.spin_drag * wet;
        let turn = spin * (0.5 * DT);
        let turned = piece.orientation + DQuat::from_xyzw(turn.x, turn.y, turn.z, 0.0) * piece.orientation;
        Piece { position: piece.position + velocity * DT, orientation: turned.normalize(), velocity, spin }
    }
}
