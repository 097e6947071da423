//! Added mass and radiation damping against frequency, as boundary-element programs tell them.

use crate::BodyError;

/// One mode of a hull afloat: its added mass and its radiation damping at some frequencies.
#[derive(Clone, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RadiationTable {
    /// Angular frequencies in rad/s, positive, rising; at least 4, and the body's own frequency among them.
    pub omega: Vec<f32>,
    /// Added mass in kg (heave) or added inertia in kg m^2 (roll, pitch) at each.
    pub added: Vec<f32>,
    /// Radiation damping in N s/m (heave) or N m s (roll, pitch) at each. What is a little negative, as programs have it
    /// where there is next to none, counts as zero.
    pub damping: Vec<f32>,
}

/// What is known of a hull's modes; `None` is estimated.
#[derive(Clone, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RadiationTables {
    /// Up and down, at the centre of the waterplane.
    pub heave: Option<RadiationTable>,
    /// About the hull's x axis.
    pub roll: Option<RadiationTable>,
    /// About the hull's z axis.
    pub pitch: Option<RadiationTable>,
}

impl RadiationTables {
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        let named = [("heave", &self.heave), ("roll", &self.roll), ("pitch", &self.pitch)];
        named.iter().try_for_each(|(mode, table)| table.as_ref().map_or(Ok(()), |table| table.check(mode)))
    }
}

/// Fewest rows of a table.
const FEWEST: usize = 4;
/// Share of the largest damping below zero that is taken for rounding.
const NEGATIVE: f32 = 0.02;

impl RadiationTable {
    fn check(&self, mode: &'static str) -> Result<(), BodyError> {
        let [omega, added, damping] = [self.omega.len(), self.added.len(), self.damping.len()];
        if omega < FEWEST || added != omega || damping != omega {
            return Err(BodyError::TableRows { mode, omega, added, damping });
        }
        let bad = |column, row: usize, value: f32, bound| {
            Err(BodyError::TableValue { mode, column, row, value: f64::from(value), bound })
        };
        let most = self.damping.iter().fold(0.0_f32, |most, b| if b.is_finite() { most.max(*b) } else { most });
        let mut last = 0.0;
        for (row, ((w, a), b)) in self.omega.iter().zip(&self.added).zip(&self.damping).enumerate() {
            let [w, a, b] = [*w, *a, *b];
            if !(w.is_finite() && w > last) {
                return bad("omega", row, w, "finite, positive and above the row before");
            }
            if !a.is_finite() {
                return bad("added", row, a, "finite");
            }
            if !(b.is_finite() && b >= -NEGATIVE * most) {
                return bad("damping", row, b, "finite and >= 0, to 2 % of the largest");
            }
            last = w;
        }
        if most > 0.0 { Ok(()) } else { bad("damping", 0, most, "positive at some frequency") }
    }

    /// Whether it tells of a body that swings at `natural` rad/s.
    pub(crate) fn covers(&self, mode: &'static str, natural: f64) -> Result<(), BodyError> {
        let (from, to) = (f64::from(self.omega[0]), f64::from(self.omega[self.omega.len() - 1]));
        if (from..=to).contains(&natural) { Ok(()) } else { Err(BodyError::TableRange { mode, from, to, natural }) }
    }

    pub(crate) fn added_at(&self, omega: f64) -> f64 {
        interpolated(&self.omega, &self.added, omega)
    }

    /// None below the table's range but what goes linearly to zero, none above.
    pub(crate) fn damping_at(&self, omega: f64) -> f64 {
        let (first, last) = (f64::from(self.omega[0]), f64::from(self.omega[self.omega.len() - 1]));
        let at = interpolated(&self.omega, &self.damping, omega).max(0.0);
        if omega < first {
            at * omega / first
        } else if omega > last {
            0.0
        } else {
            at
        }
    }
}

/// Linear between the rows, constant beyond.
fn interpolated(xs: &[f32], ys: &[f32], x: f64) -> f64 {
    let next = xs.partition_point(|v| f64::from(*v) <= x).min(xs.len() - 1);
    let at = next.saturating_sub(1);
    let (low, high) = (f64::from(xs[at]), f64::from(xs[next]));
    let share = if high > low { ((x - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
    f64::from(ys[at]) + share * (f64::from(ys[next]) - f64::from(ys[at]))
}

/// Hulme (1982), "The wave forces acting on a floating hemisphere undergoing forced periodic oscillations", J. Fluid
/// Mech. 121: ka, and added mass and damping over omega in units of the displaced mass.
const HULME: [[f32; 3]; 13] = [
    [0.05, 0.8764, 0.1036],
    [0.1, 0.8627, 0.1816],
    [0.2, 0.7938, 0.2793],
    [0.3, 0.7157, 0.3254],
    [0.4, 0.6452, 0.3410],
    [0.6, 0.5381, 0.3271],
    [0.8, 0.4698, 0.2899],
    [1.0, 0.4284, 0.2484],
    [1.2, 0.4047, 0.2096],
    [2.0, 0.3884, 0.1031],
    [3.0, 0.4111, 0.0452],
    [4.0, 0.4322, 0.0219],
    // From memory of its high-frequency limit: added mass tends to 1/2, damping falls off.
    [8.0, 0.47, 0.002],
];

impl RadiationTable {
    /// Heave of a hemisphere of `radius` m that floats to its middle in water of `density` kg/m^3, by Hulme's table.
    pub fn hemisphere(radius: f32, density: f32) -> Self {
        let mass = 2.0 / 3.0 * std::f32::consts::PI * radius * radius * radius * density;
        let omega = HULME.map(|[ka, ..]| (crate::GRAVITY * ka / radius).sqrt());
        Self {
            omega: omega.to_vec(),
            added: HULME.iter().map(|row| row[1] * mass).collect(),
            damping: HULME.iter().zip(omega).map(|(row, w)| row[2] * mass * w).collect(),
        }
    }
}
