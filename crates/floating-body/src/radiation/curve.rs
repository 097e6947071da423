//! What is known or estimated of a mode: its own frequency, its added mass there, how waves excite it.

use std::borrow::Cow;

use super::kernel::{Element, spread};
use super::table::RadiationTable;
use super::texture::Afloat;
use crate::{BodyError, GRAVITY};

/// A mode that swings.
pub(crate) struct Mode<'a> {
    /// Its frequency with the water's added mass, rad/s.
    pub(crate) natural: f64,
    /// Added mass or inertia there.
    pub(crate) added: f64,
    pub(crate) table: Option<Cow<'a, RadiationTable>>,
}

impl<'a> Mode<'a> {
    /// Heave, roll and pitch; `None` for what the water does not bring back.
    pub(crate) fn of(a: &'a Afloat) -> Result<[Option<Self>; 3], BodyError> {
        let weight = f64::from(a.density * GRAVITY);
        let volume = weight * f64::from(a.waterline.volume);
        let c = a.coefficients;
        let stiffness =
            [weight * f64::from(a.waterline.area), volume * f64::from(a.heights.x), volume * f64::from(a.heights.y)];
        let rigid = [a.mass, a.inertia.x, a.inertia.y].map(f64::from);
        let estimated = [c.added_mass.y, c.added_inertia.x, c.added_inertia.z].map(f64::from);
        let given = [&a.tables.heave, &a.tables.roll, &a.tables.pitch];
        let names = ["heave", "roll", "pitch"];
        let mut modes = [None, None, None];
        for i in 0..3 {
            // A ball's roll and pitch move no water.
            if stiffness[i] <= 0.0 || (a.sphere && i > 0) {
                continue;
            }
            let table = match given[i] {
                Some(table) => Some(Cow::Borrowed(table)),
                None if a.sphere => {
                    let radius = (a.waterline.area / std::f32::consts::PI).sqrt();
                    Some(Cow::Owned(RadiationTable::hemisphere(radius, a.density)))
                }
                None => None,
            };
            let at = |added: f64| (stiffness[i] / (rigid[i] + added)).sqrt();
            let (mut natural, mut added) = (at(estimated[i]), estimated[i]);
            if let Some(table) = &table {
                for _ in 0..20 {
                    added = table.added_at(natural);
                    natural = at(added.max(0.0));
                }
                if given[i].is_some() {
                    table.covers(names[i], natural)?;
                }
            }
            modes[i] = Some(Self { natural, added, table });
        }
        Ok(modes)
    }
}

/// How waves excite a mode against their frequency.
pub(crate) struct Curve<'a> {
    afloat: &'a Afloat<'a>,
    elements: &'a [Element],
    table: Option<&'a RadiationTable>,
    /// Of the estimate.
    scale: f64,
}

impl<'a> Curve<'a> {
    /// Of mode 0 heave, 1 roll or 2 pitch. `None` when there is no damping to radiate.
    pub(crate) fn new(afloat: &'a Afloat<'a>, mode: &'a Mode, elements: &'a [Element], index: usize) -> Option<Self> {
        let table = mode.table.as_deref();
        let mut curve = Self { afloat, elements, table, scale: 1.0 };
        if table.is_none() {
            let c = afloat.coefficients;
            let damping = f64::from([c.damping.y, c.angular_damping.x, c.angular_damping.z][index]);
            curve.scale = haskind(damping, mode.natural, f64::from(afloat.density)) / curve.estimate(mode.natural);
        }
        if curve.scale > 0.0 && curve.scale.is_finite() { Some(curve) } else { None }
    }

    /// `sqrt(2 B / (rho omega k))`, root mean square over directions: m^2 in heave, m^3 in roll and pitch. Without a table
    /// an estimate, scaled so that the damping at the body's own frequency is that of its coefficients.
    pub(crate) fn excitation(&self, omega: f64) -> f64 {
        match self.table {
            Some(table) => haskind(table.damping_at(omega), omega, f64::from(self.afloat.density)),
            None => self.scale * self.estimate(omega),
        }
    }

    /// The pressure of the undisturbed wave over the texture's places, `exp(-k T)` at the mean draft T, less what the water
    /// that gives way takes: `1 + k A0 / (rho Aw)`, A0 being the added mass of slow heave, about twice the estimate.
    fn estimate(&self, omega: f64) -> f64 {
        let a = self.afloat;
        let (density, k) = (f64::from(a.density), omega * omega / f64::from(GRAVITY));
        let area = f64::from(a.waterline.area);
        let draft = f64::from(a.waterline.volume) / area;
        let giving_way = 1.0 + 2.0 * k * f64::from(a.coefficients.added_mass.y) / (density * area);
        spread(self.elements, k).sqrt() * libm::exp(-k * draft) / giving_way
    }
}

/// Haskind's relation.
fn haskind(damping: f64, omega: f64, density: f64) -> f64 {
    let k = omega * omega / f64::from(GRAVITY);
    (2.0 * damping / (density * omega * k)).sqrt()
}
