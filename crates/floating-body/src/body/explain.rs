//! What acts on a body now, to be drawn or printed: the cut of its hull and each force with its point.

use glam::{Vec2, Vec3};

use super::clipped::LONGEST;
use super::{Body, DEEPEST};
use crate::forces::{LocalWater, gravity, immerse, resistance_axes};
use crate::hull::clip::cut;
use crate::{Clip, Controls};

/// What makes a [`Load`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LoadKind {
    /// At the centre of mass.
    Weight,
    /// Pressure at rest, at the centre of buoyancy.
    Buoyancy,
    /// What the water's own acceleration pushes through the added mass.
    AddedMass,
    /// Friction and form drag along the hull and up and down.
    Drag,
    /// Drag of the hull going sideways, at its lateral centre.
    Keel,
    /// Waves that the body makes, or that it has made and meets.
    Radiation,
    /// On what is dry.
    Wind,
    /// Propeller and rudder.
    Engine,
    /// A mooring line, at its point of the hull; mean over the last step.
    Mooring,
    /// [`Controls::force`].
    Given,
}

/// A force on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Where it comes from.
    pub kind: LoadKind,
    /// N, world axes.
    pub force: Vec3,
    /// Where it acts, local world, m.
    pub at: Vec3,
}

/// A body as the water of its last step has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The hull cut by the water: waterline, displaced volume, centre of buoyancy (local world).
    pub clip: Clip,
    /// Centre of mass, local world, m.
    pub center_of_mass: Vec3,
    /// Metacentric heights (roll, pitch) of the body upright at rest, m.
    pub metacentric_heights: Vec2,
    /// The forces; those that are zero are left out.
    pub loads: Vec<Load>,
}

/// Height of the surface at a place, blended from the planes that the last step read.
fn surface(waters: &[LocalWater], own: bool, at: Vec2) -> f32 {
    let (mut sum, mut height) = (0.0, 0.0);
    for water in waters {
        let weight = 1.0 / (water.at.distance_squared(at) + 1.0e-6);
        sum += weight;
        height += weight * (water.ambient(at) + if own { water.own } else { 0.0 });
    }
    if sum > 0.0 { height / sum } else { 0.0 }
}

impl Body {
    /// What acts on the body where it is now, under the water of its last step and `controls`. Forces are those at this
    /// instant; a step integrates the stiff ones implicitly. Turning drag is a moment without a force, slamming and contact
    /// are blows: they are left out. Allocates; not for every body in every tick.
    pub fn explain(&self, controls: &Controls) -> Explanation {
        let (controls, pose, desc) = (controls.sane(), self.pose(), &self.desc);
        let (origin, orientation) = self.hull_pose();
        let waters = if self.restart { &[] } else { self.waters.as_slice() };
        let (low, high) = desc.hull.bounds();
        let skin = desc.hull.skin((high - low).max_element() * LONGEST);
        let clip = cut(&skin, origin, orientation, |at| surface(waters, self.feels_own, at));
        let mut loads = Vec::new();
        let mut add = |kind, force: Vec3, at| {
            if force != Vec3::ZERO {
                loads.push(Load { kind, force, at });
            }
        };
        add(LoadKind::Weight, gravity(desc.mass), pose.position);
        let mut wet = immerse(&self.points, &self.waters, &pose, self.feels_own, desc.water_density);
        if let Some(mut clipping) = self.clipping.clone() {
            clipping.mix(&mut wet, &self.waters, self.feels_own, &pose, desc);
        }
        // The point on the force's line that is nearest to the centre of buoyancy.
        let arm = clip.center - pose.position;
        let line = wet.force.cross(wet.torque) / wet.force.length_squared().max(1.0e-12);
        let along = wet.force * (arm - line).dot(wet.force) / wet.force.length_squared().max(1.0e-12);
        add(LoadKind::Buoyancy, wet.force, pose.position + line + along);

        let share = (wet.volume / self.waterline.volume).min(DEEPEST);
        let radiating = ((self.volume - wet.volume) * self.sheds).clamp(0.0, 1.0);
        let (coefficients, push) = self.radiation(1.0e-6, share.min(1.0) * radiating);
        let axes = resistance_axes(pose.rotation, wet.slope, desc.hull.is_blunt());
        let through = axes.transpose() * (self.state.velocity - wet.velocity);
        let added = coefficients.added_mass * share * (axes.transpose() * (Vec3::Y * wet.acceleration));
        add(LoadKind::AddedMass, axes * added, pose.position);
        let sides = Vec3::new(share, share.min(1.0), share);
        let mut rates = desc.drag.linear * share + desc.drag.quadratic_rates(through) * sides;
        if let Some(skin) = &desc.skin {
            rates.x += skin.quadratic(through.x, desc.water_density) * through.x.abs() * sides.x;
        }
        let drag = -rates * through;
        add(LoadKind::Drag, axes * drag.with_z(0.0), pose.position);
        let lateral = pose.position + pose.rotation * (desc.drag.lateral_center - desc.center_of_mass);
        add(LoadKind::Keel, axes * Vec3::Z * drag.z, lateral);
        let waves = axes * (-coefficients.damping * share * radiating * through) + Vec3::Y * push.x;
        add(LoadKind::Radiation, waves, pose.position);
        if self.wind != Vec3::ZERO {
            let velocity = axes.transpose() * self.state.velocity;
            let (wind, rates) = self.windage(axes.transpose(), velocity, wet.volume);
            let at = pose.position + pose.rotation * (desc.windage.center - desc.center_of_mass);
            add(LoadKind::Wind, axes * (rates * (wind - velocity)), at);
        }
        if let Some(engine) = &desc.engine {
            let (force, _) = self.engine(&pose, through, &controls, 1.0e-6);
            let at = pose.position + pose.rotation * (engine.position - desc.center_of_mass);
            add(LoadKind::Engine, pose.rotation * force, at);
        }
        for (line, tension) in self.moorings.iter().zip(&self.tensions) {
            let at = pose.position + pose.rotation * (line.point - desc.center_of_mass);
            add(LoadKind::Mooring, (line.anchor - at).normalize_or_zero() * *tension, at);
        }
        add(LoadKind::Given, controls.force, pose.position);
        let metacentric_heights = self.metacentric_heights();
        Explanation { clip, center_of_mass: pose.position, metacentric_heights, loads }
    }
}
