//! A floating body: its state, and one tick of its motion.

mod clipped;
mod explain;
mod moorings;
mod query;
mod radiate;
mod slams;
mod snapshot;
mod state;
mod stiffness;
mod substep;
mod tick;
mod touch;

use glam::{Mat3, Vec2, Vec3};

use self::clipped::Clipping;
pub use self::explain::{Explanation, Load, LoadKind};
pub use self::snapshot::BodySnapshot;
pub use self::state::{BodyState, Wrench};
use self::stiffness::stiffness;
use self::touch::Solids;
use crate::coefficients::pabst;
use crate::desc::Inertia;
use crate::forces::LocalWater;
use crate::hull::Waterline;
use crate::radiation::{Memory, Radiator};
use crate::rotation::{normalized, principal_moments};
use crate::slam::Slam;
use crate::source::{Column, Displacement};
use crate::{BodyDesc, BodyError, ForcePoint, MooringLine, SurfaceSample};

/// Longest tick in s; what is longer is cut.
pub(crate) const LONGEST_TICK: f32 = 1.0;
/// Most sub-steps of one tick; beyond, stiffness is damped implicitly instead.
pub(crate) const MOST_SUBSTEPS: f32 = 32.0;
/// Sub-steps keep the body's highest frequency times their length below this (semi-implicit Euler is stable below 2).
pub(crate) const FINEST: f32 = 0.5;
/// Fastest a body may move (m/s), turn (rad/s) and farthest it may be from the local origin (m).
pub(crate) const LIMITS: (f32, f32, f32) = (200.0, 60.0, 1.0e6);
/// Immersed volume counts for drag and added mass up to this multiple of the volume at rest.
pub(crate) const DEEPEST: f32 = 2.0;
/// A step farther than this many body lengths was a teleport: it tells the water nothing.
pub(crate) const TELEPORT: f32 = 4.0;

/// How a sub-step moves the pose.
#[derive(Clone, Copy, Debug)]
struct Scheme {
    /// Forces are taken at the pose this share of the sub-step ahead.
    ahead: f32,
    /// Share of the change of velocity that comes too late for the way of the sub-step.
    late: f32,
}

impl Scheme {
    /// Semi-implicit Euler: forces at the old pose change the velocities, the new ones move it.
    const OWN: Self = Self { ahead: 0.0, late: 0.0 };
    /// What an engine makes of a force that is constant over a tick, in `n = 4` semi-implicit steps: the way lags by
    /// `(n - 1)/(2 n)` of the change. A swing keeps its energy if `ahead = late`, a little more is stable for every
    /// stiffness and for other `n`.
    const ENGINE: Self = Self { ahead: 0.4, late: 0.375 };
}

/// A body afloat. Made from a [`BodyDesc`], moved by [`Body::step`] or, in a physics engine, by [`Body::step_wrench`].
#[derive(Clone, Debug)]
pub struct Body {
    desc: BodyDesc,
    /// Relative to the centre of mass.
    points: Vec<ForcePoint>,
    inertia: Mat3,
    mismatch: f32,
    waterline: Waterline,
    /// Half the bounding box's diagonal, m.
    reach: f32,
    /// Radius of the disc with the waterplane's area, m; `reach` without one.
    pub(crate) footprint: f32,
    /// Of all force points, m^3.
    pub(crate) volume: f32,
    /// By how much radiation fades per volume that goes under, 1/m^3: from half the reserve of buoyancy on.
    pub(crate) sheds: f32,
    /// Bounds of the square of the frequencies in heave and in rotation when dry, rad^2/s^2.
    stiffness: Vec2,
    state: BodyState,
    good: BodyState,
    resets: u32,
    /// Positions of the force points and, last, the propeller.
    at: Vec<Vec2>,
    samples: Vec<SurfaceSample>,
    waters: Vec<LocalWater>,
    columns: Vec<Column>,
    /// The state was set from outside: the columns start anew.
    restart: bool,
    wash: Displacement,
    moorings: Vec<MooringLine>,
    /// Of each line, mean over the last tick.
    tensions: Vec<f32>,
    /// Bed and quays.
    solids: Solids,
    immersed: f32,
    /// How its bottom meets the water.
    slam: Option<Box<Slam>>,
    /// The wind at its height, m/s.
    wind: Vec3,
    /// Over that 10 m above the water.
    lull: f32,
    /// Of the waves it made, where no grid carries them.
    memory: Option<Box<Memory>>,
    /// None for a body of force points.
    clipping: Option<Box<Clipping>>,
    /// What it exchanges with a grid that carries textures.
    radiator: Option<Box<Radiator>>,
    /// Cells for which that was asked last, m; 0 before.
    fitted_for: f32,
    /// The heights of its home grid act on its points.
    feels_own: bool,
    /// The waves it makes take its energy away; otherwise its coefficients do.
    radiates: bool,
}

impl Body {
    /// A body floating upright at rest at (0, 0) on still water of height 0.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] naming the field of the description that is out of its bounds.
    pub fn new(desc: BodyDesc) -> Result<Self, BodyError> {
        desc.check()?;
        let mut points = desc.force_points()?;
        points.iter_mut().for_each(|p| p.position -= desc.center_of_mass);
        let waterline = desc.hull.waterline(desc.displaced_volume());
        let full = desc.unit_inertia * desc.mass;
        let moments = principal_moments(full);
        let (least, most) =
            (moments.iter().fold(f32::MAX, |a, b| a.min(*b)), moments.iter().fold(0.0_f32, |a, b| a.max(*b)));
        let symmetric = (full - full.transpose()).abs_diff_eq(Mat3::ZERO, 1.0e-3 * most);
        if !(least > 0.0 && most.is_finite() && symmetric) {
            let bound = "symmetric with positive finite principal moments";
            return Err(BodyError::InvalidValue { field: "unit_inertia", value: f64::from(least), bound });
        }
        let mean = (moments[0] + moments[1] + moments[2]) / 3.0;
        let inertia = match desc.inertia {
            Inertia::Full => full,
            Inertia::PreRigid => Mat3::from_diagonal(Vec3::splat(mean)),
        };
        let stiffness = stiffness(&points, &desc, full);
        let (low, high) = desc.hull.bounds();
        let count = points.len() + usize::from(desc.engine.is_some());
        let reach = 0.5 * (high - low).length();
        let volume: f32 = points.iter().map(|p| p.volume).sum();
        let footprint = if waterline.area > 0.0 { (waterline.area / std::f32::consts::PI).sqrt() } else { reach };
        let state = BodyState::at_rest(Vec3::new(0.0, desc.center_of_mass.y - waterline.level, 0.0));
        let mut body = Self {
            inertia,
            mismatch: (most - least) / mean,
            reach,
            footprint,
            volume,
            sheds: 2.0 / (volume - waterline.volume).max(1.0e-3 * volume),
            waterline,
            stiffness,
            state,
            good: state,
            resets: 0,
            at: vec![Vec2::ZERO; count],
            samples: vec![SurfaceSample::CALM; count],
            waters: vec![LocalWater::default(); count],
            columns: vec![Column::default(); points.len()],
            restart: true,
            wash: Displacement::default(),
            moorings: Vec::new(),
            tensions: Vec::new(),
            solids: Solids::new(&desc),
            immersed: 0.0,
            slam: None,
            wind: Vec3::ZERO,
            lull: 0.0,
            memory: None,
            clipping: Clipping::new(&desc, &points),
            radiator: None,
            fitted_for: 0.0,
            feels_own: false,
            radiates: false,
            points,
            desc,
        };
        body.check_tables()?;
        let (desc, w) = (&body.desc, &body.waterline);
        body.lull = desc.windage.at_height(desc.windage.center.y - w.level);
        let finite = pabst(w.extent.max_element() / w.extent.min_element().max(1.0e-3));
        body.slam = desc.slamming.as_ref().map(|s| Box::new(Slam::new(s, &body.points, w, finite, desc.water_density)));
        body.memory = if body.desc.memory { Memory::new(&body.afloat()).map(Box::new) } else { None };
        Ok(body)
    }

    /// Replaces a broken state by the last good one and clamps speeds.
    fn keep_sane(&mut self) {
        if !self.state.is_sane() {
            self.state = BodyState::at_rest(self.good.position);
            self.state.orientation = self.good.orientation;
            self.resets = self.resets.saturating_add(1);
            self.restart = true;
        }
        self.state.velocity = self.state.velocity.clamp_length_max(LIMITS.0);
        self.state.angular_velocity = self.state.angular_velocity.clamp_length_max(LIMITS.1);
        self.state.orientation = normalized(self.state.orientation.to_array());
    }

    /// Appends what the last step changed in the water: for each column the volume now displaced (+) and the one that
    /// was (-), unless [`Body::imprints`] tell it. The first step after [`Body::set_state`] or a teleport starts from the new place without a splash.
    pub fn displacements(&self, out: &mut Vec<Displacement>) {
        if self.imprints().is_none() {
            for (column, point) in self.columns.iter().zip(&self.points) {
                column.tell(point, out);
            }
        }
        if self.wash.foam > 0.0 {
            out.push(self.wash);
        }
    }

    /// Where it is and how it moves.
    pub fn state(&self) -> BodyState {
        self.state
    }

    /// Places the body, for a spawn, a teleport or a host's own physics. A state that is not finite, or farther than
    /// 1000 km away, is ignored and counted.
    pub fn set_state(&mut self, state: BodyState) {
        if !state.is_sane() {
            self.resets = self.resets.saturating_add(1);
            return;
        }
        let moved = state.position.distance(self.state.position);
        self.restart |= moved > TELEPORT * self.reach;
        self.state = state;
        self.keep_sane();
        self.good = self.state;
    }

    /// As [`Body::set_state`], however near: the next step starts there without a splash, and as after no motion.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`]: the state is not finite, or farther than 1000 km away; then nothing has changed.
    pub fn teleport(&mut self, state: BodyState) -> Result<(), BodyError> {
        if !state.is_sane() {
            let (field, value) = ("state.position", f64::from(state.position.abs().max_element()));
            return Err(BodyError::InvalidValue {
                field,
                value,
                bound: "finite, like all of the state, and within 1000 km",
            });
        }
        self.set_state(state);
        self.restart = true;
        Ok(())
    }

    /// Shifts the local origin by `offset` m (x, z) without disturbing anything: what was at `offset` is at 0.
    pub fn rebase(&mut self, offset: Vec2) {
        let shift = Vec3::new(offset.x, 0.0, offset.y);
        self.state.position -= shift;
        self.good.position -= shift;
        self.columns.iter_mut().for_each(|c| c.rebase(offset));
        self.waters.iter_mut().for_each(|water| water.at -= offset);
        self.solids.rebase(shift);
        self.radiator.iter_mut().for_each(|r| r.rebase(offset));
        self.wash.center -= offset;
        self.moorings.iter_mut().for_each(|line| line.anchor -= shift);
    }
}
