//! Many bodies of one description: flotsam, debris, buoys.
//!
//! Physics are [`Body`]'s with [`Sampling::Patch`]: the same force points, drag, added mass and sub-steps on a plane of
//! water. Pieces lie eight by eight side by side and are moved so; the water is asked for many at once, and not in every
//! tick. Without engines, moorings, textures and controls.

mod awake;
mod crew;
mod desc;
mod kernel;
mod lanes;
mod pack;
mod tell;
mod template;
mod wet;

use std::fmt;

use fearless_simd::Level;
use glam::{Quat, Vec2, Vec3};
use slotmap::SlotMap;

use self::awake::Tick;
use self::crew::Crew;
pub use self::desc::{Activity, FleetDesc, PieceId};
use self::pack::Piece;
use self::template::Template;
use crate::body::{LONGEST_TICK, TELEPORT};
use crate::rotation::{matrix, normalized};
use crate::{Body, BodyError, BodyState, Coefficients, Displacement, Home, Radiation, Sampling, WaterSurface};

/// Many bodies of one description. Made from a [`FleetDesc`], moved by [`Fleet::step`].
pub struct Fleet {
    desc: FleetDesc,
    body: Body,
    template: Template,
    /// Where each is in `awake`.
    index: SlotMap<PieceId, usize>,
    awake: Crew,
    eye: Option<Vec3>,
    ticks: usize,
    resets: u32,
    level: Level,
}

impl Fleet {
    /// A fleet without pieces.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] naming the field of the description that is out of its bounds.
    pub fn new(desc: FleetDesc) -> Result<Self, BodyError> {
        desc.check()?;
        let mut one = desc.body.clone();
        one.sampling = Sampling::Patch;
        let body = Body::new(one)?;
        Ok(Self {
            template: Template::new(&body),
            body,
            desc,
            index: SlotMap::with_key(),
            awake: Crew::default(),
            eye: None,
            ticks: 0,
            resets: 0,
            level: Level::new(),
        })
    }

    /// Puts a piece into the water or over it.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] if the state is not finite or farther than 1000 km away.
    pub fn add(&mut self, state: BodyState) -> Result<PieceId, BodyError> {
        let Some(state) = proper(state) else {
            let value = f64::from(state.position.length());
            return Err(BodyError::InvalidValue { field: "state", value, bound: "finite and within 1000 km" });
        };
        let at = self.awake.len();
        let id = self.index.insert(at);
        self.awake.push(id, &Piece::new(state));
        Ok(id)
    }

    /// Takes a piece out. Returns its last state, `None` if there is no such piece. What it had displaced is not taken back.
    pub fn remove(&mut self, id: PieceId) -> Option<BodyState> {
        let at = self.index.remove(id)?;
        let piece = self.awake.swap_remove(at);
        if let Some(moved) = self.awake.ids.get(at) {
            self.index[*moved] = at;
        }
        Some(piece.state)
    }

    /// How many pieces there are.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// Where a piece is and how it moves.
    pub fn state(&self, id: PieceId) -> Option<BodyState> {
        self.index.get(id).map(|&at| self.awake.get(at).state)
    }

    /// Moves a piece, which wakes it. Returns whether it was done: the piece exists, the state is finite and within 1000 km.
    pub fn set_state(&mut self, id: PieceId, state: BodyState) -> bool {
        let (Some(&at), Some(state)) = (self.index.get(id), proper(state)) else { return false };
        let old = self.awake.get(at);
        self.awake.set(at, &old.moved(state, TELEPORT * self.template.reach));
        self.awake.refresh(at);
        true
    }

    /// All pieces.
    pub fn iter(&self) -> impl Iterator<Item = (PieceId, BodyState)> + '_ {
        self.index.iter().map(|(id, &at)| (id, self.awake.get(at).state))
    }

    /// Pose of the hull's frame of a piece, to draw its mesh: origin in m and orientation, a share `alpha` (0 to 1) of the
    /// way from the tick before to the last.
    pub fn hull_pose(&self, id: PieceId, alpha: f32) -> Option<(Vec3, Quat)> {
        let piece = self.index.get(id).map(|&at| self.awake.get(at))?;
        let (position, orientation) = piece.before;
        let alpha = if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 1.0 };
        let orientation = between(orientation, piece.state.orientation, alpha);
        let position = position + (piece.state.position - position) * alpha;
        Some((position - matrix(orientation) * self.body.desc().center_of_mass, orientation))
    }

    /// What a piece is doing.
    pub fn activity(&self, id: PieceId) -> Option<Activity> {
        self.index.contains_key(id).then_some(Activity::Awake)
    }

    /// Where the fleet is seen from, local world; `None` (default) if nobody looks, and all pieces keep their forces.
    pub fn look(&mut self, eye: Option<Vec3>) {
        self.eye = eye.filter(|e| e.is_finite());
    }

    /// One tick of `dt` s on `water`. Allocates nothing while the number of pieces stays.
    ///
    /// A `dt` that is not positive does nothing; one above 1 s is cut.
    pub fn step(&mut self, dt: f32, water: &dyn WaterSurface) {
        if !(dt > 0.0 && dt.is_finite()) || self.is_empty() {
            return;
        }
        let (home, by_grid) = (water.home(), self.desc.body.radiation == Radiation::Grid);
        let none = Coefficients::default();
        let tick = Tick {
            template: &self.template,
            coefficients: if home != Home::None && by_grid { &none } else { &self.template.coefficients },
            pace: self.template.pace(dt.min(LONGEST_TICK)),
            water,
            felt: home == Home::Shared || (home == Home::Own && by_grid),
            tells: by_grid,
            number: self.ticks,
            refresh: self.desc.refresh as usize,
            level: self.level,
        };
        let count = self.awake.len();
        let reset = awake::run(&tick, &mut self.awake.packs, count);
        self.resets = self.resets.saturating_add(reset);
        self.ticks = self.ticks.wrapping_add(1);
    }

    /// Appends what the last step changed in the water, with [`Radiation::Grid`]: for each piece the volume that it displaces
    /// now (+) and displaced before (-).
    pub fn displacements(&self, out: &mut Vec<Displacement>) {
        if self.desc.body.radiation == Radiation::Grid {
            tell::tell(&self.awake.packs, self.awake.len(), self.template.radius, out);
        }
    }

    /// Shifts the local origin by `offset` m (x, z) without disturbing anything: what was at `offset` is at 0.
    pub fn rebase(&mut self, offset: Vec2) {
        self.awake.packs.iter_mut().for_each(|pack| pack.rebase(offset));
        let shift = Vec3::new(offset.x, 0.0, offset.y);
        self.eye = self.eye.map(|eye| eye - shift);
    }

    /// A piece as a body of its own, to draw and to ask.
    pub fn template(&self) -> &Body {
        &self.body
    }

    /// How often a state that was not finite had to be replaced.
    pub fn resets(&self) -> u32 {
        self.resets
    }
}

impl fmt::Debug for Fleet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Fleet").field("len", &self.len()).field("desc", &self.desc).finish_non_exhaustive()
    }
}

/// The state with a unit orientation and speeds within bounds; `None` if it is none.
fn proper(state: BodyState) -> Option<BodyState> {
    let orientation = normalized(state.orientation.to_array());
    let velocity = state.velocity.clamp_length_max(crate::body::LIMITS.0);
    let angular_velocity = state.angular_velocity.clamp_length_max(crate::body::LIMITS.1);
    state.is_sane().then_some(BodyState { orientation, velocity, angular_velocity, ..state })
}

/// Straight from one orientation to another near by.
fn between(a: Quat, b: Quat, share: f32) -> Quat {
    let (a, b) = (glam::Vec4::from(a), glam::Vec4::from(b));
    let b = if a.dot(b) < 0.0 { -b } else { b };
    normalized((a + (b - a) * share).to_array())
}
