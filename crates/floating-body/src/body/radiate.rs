//! A body that radiates through textures: their fit, the grid's answer, what is told.

use glam::{Vec2, Vec3};

use super::Body;
use crate::forces::Pose;
use crate::radiation::{Afloat, Radiator};
use crate::{BodyError, Coefficients, Imprint, Radiation, Textures, WaterSurface};

impl Body {
    /// Refuses tables that leave out the body's own frequencies.
    pub(super) fn check_tables(&self) -> Result<(), BodyError> {
        let tables = &self.desc.tables;
        if tables.heave.is_none() && tables.roll.is_none() && tables.pitch.is_none() {
            return Ok(());
        }
        Textures::check(&self.afloat())
    }

    pub(super) fn afloat(&self) -> Afloat<'_> {
        let (d, w) = (&self.desc, &self.waterline);
        let c = d.center_of_mass;
        Afloat {
            waterline: w,
            points: &self.points,
            center: w.center - Vec2::new(c.x, c.z),
            level: w.level - c.y,
            heights: self.metacentric_heights(),
            mass: d.mass,
            inertia: Vec2::new(self.inertia.x_axis.x, self.inertia.z_axis.z),
            density: d.water_density,
            coefficients: &d.coefficients,
            tables: &d.tables,
            sphere: d.hull.is_sphere(),
        }
    }

    /// Fits the textures of a body with [`Radiation::Grid`] for a grid with cells of `cell` m, if they are not for such
    /// already: whoever owns the grid does so before a step. Returns whether they changed; where none fit there are none
    /// ([`Body::textures`]) until the cells change. Takes some milliseconds.
    pub fn fit_textures(&mut self, cell: f32) -> bool {
        let floats = self.desc.mass < self.desc.hull.volume() * self.desc.water_density;
        let asked = self.desc.radiation == Radiation::Grid && floats && cell > 0.0 && cell.is_finite();
        if !asked || self.fitted_for == cell {
            return false;
        }
        self.fitted_for = cell;
        let had = self.radiator.is_some();
        let afloat = self.afloat();
        let (center, level) = (afloat.center, afloat.level);
        self.radiator = Textures::fit(&afloat, cell).ok().flatten().map(|textures| {
            let w = &self.waterline;
            let mut radiator = Radiator::new(textures, center, w.area, w.volume);
            radiator.weigh(&self.points, level);
            Box::new(radiator)
        });
        had || self.radiator.is_some()
    }

    /// Cells for which textures were asked for last, m; 0 before.
    pub fn fitted_cell(&self) -> f32 {
        self.fitted_for
    }

    /// The textures of the last fit.
    pub fn textures(&self) -> Option<&Textures> {
        self.radiator.as_ref().map(|r| &r.textures)
    }

    /// What the last step changed in a grid that carries the body's textures, to be added there before it ticks. `None`
    /// when the step was not made on one: then it is in [`Body::displacements`].
    pub fn imprints(&self) -> Option<[Imprint; 2]> {
        self.radiator.as_ref().filter(|r| r.motion.on).map(|r| r.imprints())
    }

    /// Asks the home grid. Returns whether it carries the textures.
    pub(super) fn read_textures(&mut self, water: &dyn WaterSurface, wanted: bool, pose: &Pose) -> bool {
        let Some(radiator) = &mut self.radiator else { return false };
        let (at, heading) = Radiator::spot(pose);
        let heads = if wanted { water.radiated(at, heading) } else { None };
        // What was told elsewhere is not taken back here.
        self.restart |= heads.is_some() != radiator.motion.on;
        radiator.motion.on = heads.is_some();
        let heads = Vec3::from(heads.unwrap_or_default());
        radiator.motion.heads = if heads.is_finite() { heads } else { Vec3::ZERO };
        radiator.motion.on
    }

    /// Added mass and damping that act in a sub-step of `dt` s, and the push of the grid's waves through the textures, or of
    /// the waves that are remembered, which are felt `afloat`, 0 to 1: force up in N, torque about the hull's x and z in
    /// N m.
    pub(super) fn radiation(&self, dt: f32, afloat: f32) -> (Coefficients, Vec3) {
        let own = self.desc.coefficients;
        match &self.radiator {
            Some(radiator) if radiator.motion.on => {
                let (mut c, textures) = (own, &radiator.textures);
                let [heave, roll, pitch] = textures.left;
                (c.added_mass.y, c.damping.y) = (heave, 0.0);
                if !textures.roll.is_empty() {
                    (c.added_inertia.x, c.angular_damping.x) = (roll, 0.0);
                }
                if !textures.pitch.is_empty() {
                    (c.added_inertia.z, c.angular_damping.z) = (pitch, 0.0);
                }
                (c, radiator.push(self.desc.water_density))
            }
            _ if self.radiates => (Coefficients::default(), Vec3::ZERO),
            _ => self.memory.as_ref().map_or((own, Vec3::ZERO), |memory| {
                let (mut c, [heave, roll, pitch]) = (own, memory.recall(dt));
                let mut push = Vec3::ZERO;
                if let Some(heave) = heave {
                    (c.added_mass.y, c.damping.y, push.x) = (heave.left, heave.damping, heave.force);
                }
                if let Some(roll) = roll {
                    (c.added_inertia.x, c.angular_damping.x, push.y) = (roll.left, roll.damping, roll.force);
                }
                if let Some(pitch) = pitch {
                    (c.added_inertia.z, c.angular_damping.z, push.z) = (pitch.left, pitch.damping, pitch.force);
                }
                (c, push * afloat)
            }),
        }
    }

    /// Takes down the motion through the water in a sub-step: up in m/s, about the hull's x and z in rad/s.
    pub(super) fn remember(&mut self, motion: Vec3, dt: f32) {
        let on_a_grid = self.radiates || self.radiator.as_ref().is_some_and(|r| r.motion.on);
        if let Some(memory) = &mut self.memory {
            if on_a_grid { memory.forget() } else { memory.remember((motion * dt).to_array(), dt) }
        }
    }

    /// About the centre of mass, hull axes: heave pushes at the waterplane's centre.
    pub(super) fn texture_torque(&self, push: Vec3) -> Vec3 {
        let arm = self.waterline.center - Vec2::new(self.desc.center_of_mass.x, self.desc.center_of_mass.z);
        Vec3::new(push.y - arm.y * push.x, 0.0, push.z + arm.x * push.x)
    }

    pub(super) fn measure_textures(&mut self, pose: &Pose, age: f32, restart: bool) {
        let volume = self.told_volume();
        let Some(radiator) = self.radiator.as_mut().filter(|r| r.motion.on) else { return };
        let share = volume / self.waterline.volume;
        radiator.measure(&self.points, &self.waters, pose, age, share, restart);
    }
}
