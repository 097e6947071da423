//! The description of a body: everything a user may set, with defaults from the hull and the mass.

use glam::{Mat3, Vec3};

use crate::coefficients::{Afloat, Coefficients};
use crate::drag::Drag;
use crate::error::check_range;
use crate::skin::Skin;
use crate::slam::Slamming;
use crate::wind::Windage;
use crate::{BodyError, Contact, Engine, ForcePoint, GRAVITY, Hull, RadiationTables, WATER_DENSITY};

/// Bodies shorter than this, in m, read one patch of water by default.
pub(crate) const PATCH_LENGTH: f32 = 2.5;

/// How rotation is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Inertia {
    /// The paper's pre-rigid body: one scalar (the mean principal moment) and no `omega x I omega`. Exact for an
    /// isotropic tensor only; [`Body::inertia_mismatch`](crate::Body::inertia_mismatch) tells how far off a shape is.
    PreRigid,
    /// The whole tensor with the gyroscopic term, by the implicit midpoint rule: energy and angular momentum of free
    /// tumbling are kept.
    #[default]
    Full,
}

/// Who accounts for the waves that a body makes. Both at once would count them twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Radiation {
    /// Added mass and linear damping act; a grid of the body's own is left out of the forces, so that its wake does not
    /// lift it. In a grid that others disturb it feels all waves and, to count none twice, makes none.
    #[default]
    Coefficients,
    /// The home grid's waves act, the body's with all others', and take its energy away. On a grid that carries
    /// [`Textures`](crate::Textures) (a dispersive one, where waves of each length have their own speed) heave, roll and
    /// pitch exchange energy with it by the radiation that [`BodyDesc::tables`] tell or that is estimated; the added mass
    /// that the grid does not bring stays. On others the points read its height (`SurfaceSample::own`), and added mass
    /// and damping are off. Where no grid carries the body's waves, as `Coefficients`.
    Grid,
}

/// How a body reads the water.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sampling {
    /// One sample per force point (and one for the propeller).
    Points,
    /// One patch per tick, whose plane all points read: for bodies smaller than the waves they feel.
    Patch,
}

/// Where buoyancy acts.
#[derive(Clone, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ForcePoints {
    /// As many as the shape needs: 32 columns for a mesh, 1 for a sphere, 4 for a log, 8 or 32 for a box.
    #[default]
    Auto,
    /// About this many, 1 to 4096.
    Count(u32),
    /// These, hull frame, at least one.
    Given(Vec<ForcePoint>),
}

/// How exactly buoyancy follows the hull's shape.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Quality {
    /// Summed over [`BodyDesc::points`].
    #[default]
    Points,
    /// The hull is clipped at the water surface, triangle by triangle (a ball or cylinder that reads one patch: in closed
    /// form), some nanoseconds a triangle and sub-step. The points still say where the water is read and what is
    /// displaced.
    Clipped,
    /// Clipped within so many m from the eye ([`Body::set_distance`](crate::Body::set_distance)), points farther away; a
    /// change takes half a second.
    Near(f32),
}

/// A body to be made. [`BodyDesc::from_hull`] fills everything in; change what you know better.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyDesc {
    /// The shape.
    pub hull: Hull,
    /// Mass in kg, 1e-6 to 1e9.
    pub mass: f32,
    /// Centre of mass, hull frame, m. Default: the hull's centroid.
    pub center_of_mass: Vec3,
    /// Inertia tensor about the centre of mass per kg, hull axes, m^2; symmetric, positive. Default: the hull filled
    /// with one density.
    pub unit_inertia: Mat3,
    /// How rotation is integrated.
    pub inertia: Inertia,
    /// Who accounts for radiated waves.
    pub radiation: Radiation,
    /// How the water is read. Default: a patch for hulls shorter than 2.5 m.
    pub sampling: Sampling,
    /// Where buoyancy acts.
    pub points: ForcePoints,
    /// How exactly buoyancy follows the hull.
    pub quality: Quality,
    /// Added mass and radiation damping; used with [`Radiation::Coefficients`].
    pub coefficients: Coefficients,
    /// Remember the waves made in heave, roll and pitch (Cummins 1962) where `coefficients` would act: they then follow
    /// `tables` at every frequency. Costs about a microsecond a sub-step and mode. Default: false.
    pub memory: bool,
    /// Radiation against frequency, for `memory` and for [`Radiation::Grid`] on a dispersive grid. What is `None` (default) is Hulme's for
    /// a sphere and otherwise estimated from the waterplane, the mean draft and the coefficients.
    pub tables: RadiationTables,
    /// Water friction and form drag.
    pub drag: Drag,
    /// Skin friction along the hull. Default: by the waterline's dimensions for meshes of 2.5 m and more; none for what is
    /// smaller and for closed shapes, whose form drag hides it.
    pub skin: Option<Skin>,
    /// What the wind finds. Default: the hull's box over the water.
    pub windage: Windage,
    /// Blows on the bottom as it enters the water. Default: none; boats slam.
    pub slamming: Option<Slamming>,
    /// Default: none.
    pub engine: Option<Engine>,
    /// How it meets the bed and quays; `None` passes through. Default: [`Contact::default`].
    pub contact: Option<Contact>,
    /// Density of the water in kg/m^3, 1 to 20000.
    pub water_density: f32,
}

impl BodyDesc {
    /// A body of `mass` kg with everything estimated from the hull.
    pub fn from_hull(hull: &Hull, mass: f32) -> Self {
        let (low, high) = hull.bounds();
        let small = (high - low).max_element() < PATCH_LENGTH;
        let mut desc = Self {
            hull: hull.clone(),
            mass,
            center_of_mass: hull.centroid(),
            unit_inertia: hull.unit_inertia(),
            inertia: Inertia::default(),
            radiation: Radiation::default(),
            sampling: if small { Sampling::Patch } else { Sampling::Points },
            points: ForcePoints::default(),
            quality: Quality::default(),
            coefficients: Coefficients::default(),
            memory: false,
            tables: RadiationTables::default(),
            drag: Drag::default(),
            skin: None,
            windage: Windage::default(),
            slamming: None,
            engine: None,
            contact: Some(Contact::default()),
            water_density: WATER_DENSITY,
        };
        desc.estimate();
        desc
    }

    /// A planing launch of `mass` kg that reaches `max_speed` m/s at full throttle: centre of mass over the centre of
    /// buoyancy just above the water, outboard at the stern, a skeg that keeps the course.
    ///
    /// The hull's x must point forward. Resistance at top speed is a sixth of the weight, as of planing hulls; there is
    /// no planing lift, so the boat keeps its draft at all speeds.
    pub fn boat(hull: &Hull, mass: f32, max_speed: f32) -> Self {
        let mut desc = Self::from_hull(hull, mass);
        let waterline = hull.waterline(desc.displaced_volume());
        let (length, beam, draft) = (waterline.extent.x, waterline.extent.y, waterline.draft);
        let buoyancy = waterline.center_of_buoyancy;
        let center = Vec3::new(buoyancy.x, waterline.level + 0.03 * beam, buoyancy.z);
        let away = center - desc.center_of_mass;
        desc.center_of_mass = center;
        desc.unit_inertia += Mat3::from_diagonal(Vec3::splat(away.length_squared()))
            - Mat3::from_cols(away * away.x, away * away.y, away * away.z);
        desc.estimate();
        let speed = if max_speed.is_finite() { max_speed.max(0.5) } else { 0.5 };
        let resistance = mass * GRAVITY / 6.0;
        let mut skin = Skin::new(length, draft, waterline.volume);
        // A planing hull has lifted out of the water: friction is half of its resistance (Savitsky 1964).
        let friction = skin.quadratic(speed, desc.water_density) * speed * speed;
        skin.area *= (0.5 * resistance / friction).min(1.0);
        let friction = skin.quadratic(speed, desc.water_density);
        desc.drag.quadratic.x = ((resistance / speed - desc.drag.linear.x) / speed - friction).max(0.0);
        desc.skin = Some(skin);
        // A box has no bottom to speak of: its blow would be one of a single tick.
        desc.slamming = (!hull.is_blunt()).then(|| Slamming::estimate(&waterline));
        desc.drag.cross_flow.x = 0.3;
        // A planing hull turns on its skeg: the forebody hardly resists.
        desc.drag.angular_forward.y *= 0.15;
        desc.drag.lateral_center = Vec3::new(center.x - 0.06 * length, center.y + 0.02 * beam, center.z);
        let bollard = 1.7;
        let stern = waterline.center.x - 0.5 * length;
        desc.engine = Some(Engine {
            bollard_thrust: bollard * resistance,
            pitch_speed: speed * bollard / (bollard - 1.0),
            astern: 0.4,
            position: Vec3::new(stern, waterline.level - draft.max(0.3), center.z),
            radius: (0.02 * length).max(0.05),
            max_angle: 0.45,
            rudder_area: 0.006 * length * draft.max(0.1),
        });
        desc
    }

    /// Sets coefficients, drag, skin and windage again from hull, mass, centre of mass and inertia, after these were changed.
    pub fn estimate(&mut self) {
        if !(self.mass > 0.0 && self.mass.is_finite() && self.water_density > 0.0) {
            return;
        }
        let waterline = self.hull.waterline(self.displaced_volume());
        let tensor = self.unit_inertia * self.mass;
        self.coefficients = Coefficients::estimate(&Afloat {
            waterline: &waterline,
            strips: &self.hull.strips(self.displaced_volume()),
            center: self.center_of_mass.x,
            heights: waterline.metacentric_heights(self.center_of_mass.y),
            mass: self.mass,
            inertia: Vec3::new(tensor.x_axis.x, tensor.y_axis.y, tensor.z_axis.z),
            density: self.water_density,
            blunt: self.hull.is_blunt(),
            sunk: self.mass >= self.hull.volume() * self.water_density,
        });
        let (round, blunt) = (self.hull.is_sphere(), self.hull.is_blunt());
        self.drag = Drag::estimate(&waterline, self.mass, self.water_density, round, blunt);
        let (low, high) = self.hull.bounds();
        self.windage = Windage::estimate(&waterline, low, high, round, blunt);
        self.skin = (!blunt && (high - low).max_element() >= PATCH_LENGTH)
            .then(|| Skin::new(waterline.extent.x, waterline.draft, waterline.volume));
    }

    /// Volume in m^3 displaced at rest: mass over density, at most the hull's.
    pub fn displaced_volume(&self) -> f32 {
        (self.mass / self.water_density).min(self.hull.volume())
    }

    /// The force points this description stands for.
    pub(crate) fn force_points(&self) -> Result<Vec<ForcePoint>, BodyError> {
        let points = match &self.points {
            ForcePoints::Auto => self.hull.force_points(self.hull.default_count(), self.displaced_volume()),
            ForcePoints::Count(n) => {
                check_range("points", *n as f32, 1.0, 4096.0, "in [1, 4096]")?;
                self.hull.force_points(*n, self.displaced_volume())
            }
            ForcePoints::Given(points) => points.clone(),
        };
        check_range("points", points.len() as f32, 1.0, 1.0e5, "at least one force point")?;
        points.iter().try_for_each(ForcePoint::check)?;
        Ok(points)
    }

    /// Refuses what a step could not digest.
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        check_range("mass", self.mass, 1.0e-6, 1.0e9, "in [1e-6, 1e9] kg")?;
        check_range("water_density", self.water_density, 1.0, 2.0e4, "in [1, 20000] kg/m^3")?;
        check_all("center_of_mass", self.center_of_mass, -1.0e4, 1.0e4, "within +-10000 m")?;
        if let Quality::Near(near) = self.quality {
            check_range("quality", near, 0.01, 1.0e6, "Near of [0.01, 1e6] m")?;
        }
        let c = &self.coefficients;
        let at_least_zero = "finite and >= 0";
        for (field, v) in [
            ("coefficients.added_mass", c.added_mass),
            ("coefficients.added_inertia", c.added_inertia),
            ("coefficients.damping", c.damping),
            ("coefficients.angular_damping", c.angular_damping),
            ("drag.linear", self.drag.linear),
            ("drag.quadratic", self.drag.quadratic),
            ("drag.angular_linear", self.drag.angular_linear),
            ("drag.angular_quadratic", self.drag.angular_quadratic),
            ("drag.angular_forward", self.drag.angular_forward),
        ] {
            check_all(field, v, 0.0, f32::MAX, at_least_zero)?;
        }
        check_all("drag.cross_flow", self.drag.cross_flow, 0.0, 1.0, "in [0, 1]")?;
        check_all("drag.lateral_center", self.drag.lateral_center, -1.0e4, 1.0e4, "within +-10000 m")?;
        self.contact.as_ref().map_or(Ok(()), Contact::check)?;
        self.skin.as_ref().map_or(Ok(()), Skin::check)?;
        self.windage.check()?;
        self.slamming.as_ref().map_or(Ok(()), Slamming::check)?;
        self.tables.check()?;
        self.engine.as_ref().map_or(Ok(()), Engine::check)
    }
}

fn check_all(field: &'static str, v: Vec3, min: f32, max: f32, bound: &'static str) -> Result<(), BodyError> {
    v.to_array().into_iter().try_for_each(|c| check_range(field, c, min, max, bound).map(drop))
}
