//! Many bodies of one description: flotsam, debris, buoys.
//!
//! Physics are [`Body`]'s with [`Sampling::Patch`]: the same force points, drag, added mass and sub-steps on a plane of
//! water. Pieces lie eight by eight side by side and are moved so; the water is asked for many at once, and not in every
//! tick. Those that lie still on calm water sleep, those that are seen too small for forces ride. Without engines, moorings,
//! textures and controls.

mod awake;
mod contact;
mod crew;
mod desc;
mod kernel;
mod lanes;
mod pack;
mod ride;
mod sleep;
mod tell;
mod template;
mod tick;
#[cfg(feature = "serde")]
mod values;
mod wet;

use std::fmt;
use std::sync::Arc;

use fearless_simd::Level;
use glam::{Quat, Vec2, Vec3};

use self::contact::Crowd;
pub use self::contact::SoftContact;
use self::crew::Crew;
pub use self::desc::{Activity, FleetDesc, PieceId};
use self::pack::Piece;
use self::ride::Rider;
use self::sleep::Sleepers;
use self::template::Template;
use crate::body::{LIMITS, TELEPORT};
use crate::rotation::{matrix, normalized};
use crate::{Arena, Body, BodyError, BodyState, Displacement, Radiation, Sampling};

/// Where a piece is kept.
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Place {
    Awake(usize),
    Riding(usize),
    Asleep { block: usize, at: usize },
}

/// Many bodies of one description. Made from a [`FleetDesc`], moved by [`Fleet::step`]. A clone is this moment, to go back to; it
/// shares what does not change.
///
/// ```
/// use floating_body::{Activity, BodyDesc, BodyError, BodyState, FlatWater, Fleet, FleetDesc, Hull};
/// use glam::Vec3;
///
/// # fn main() -> Result<(), BodyError> {
/// let hull = Hull::cuboid(Vec3::new(1.2, 0.6, 1.0))?; // crates that float upright
/// let mut fleet = Fleet::new(FleetDesc::new(BodyDesc::from_hull(&hull, 300.0)))?;
/// let mut crates = Vec::new();
/// for i in 0..100 {
///     crates.push(fleet.add(BodyState::at_rest(Vec3::new(2.0 * i as f32, 0.5, 0.0)))?);
/// }
/// for _ in 0..60 * 60 {
///     fleet.step(1.0 / 60.0, &FlatWater::default());
/// }
/// assert_eq!(fleet.activity(crates[0]), Some(Activity::Asleep)); // the water is calm
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct Fleet {
    desc: Arc<FleetDesc>,
    body: Arc<Body>,
    template: Arc<Template>,
    index: Arena<PieceId, Place>,
    awake: Crew,
    riders: Vec<Rider>,
    sleepers: Sleepers,
    eye: Option<Vec3>,
    /// Counted since the fleet was made.
    ticks: usize,
    /// Time in s since then.
    now: f64,
    /// The last tick's length, s.
    dt: f32,
    /// The home grid's waves acted in the last tick.
    felt: bool,
    resets: u32,
    level: Level,
    /// Of the ball that a piece is to bed and quays, m.
    radius: f32,
    crowd: Crowd,
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
        let radius = SoftContact::of(&body.desc().hull).radius;
        Ok(Self {
            template: Arc::new(Template::new(&body)),
            body: Arc::new(body),
            desc: Arc::new(desc),
            index: Arena::default(),
            awake: Crew::default(),
            riders: Vec::new(),
            sleepers: Sleepers::default(),
            eye: None,
            ticks: 0,
            now: 0.0,
            dt: 0.0,
            felt: false,
            resets: 0,
            level: Level::new(),
            radius,
            crowd: Crowd::default(),
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
        let id = self.index.insert(Place::Awake(self.awake.len()));
        self.awake.push(id, &Piece::new(state));
        Ok(id)
    }

    /// Takes a piece out. Returns its last state, `None` if there is no such piece. What it had displaced is not taken back.
    pub fn remove(&mut self, id: PieceId) -> Option<BodyState> {
        let place = self.index.remove(id)?;
        Some(self.take(place).state)
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
        self.index.get(id).map(|&place| self.state_at(place))
    }

    /// Moves a piece, which wakes it. Returns whether it was done: the piece exists, the state is finite and within 1000 km.
    pub fn set_state(&mut self, id: PieceId, state: BodyState) -> bool {
        let (Some(&place), Some(state)) = (self.index.get(id), proper(state)) else { return false };
        let far = TELEPORT * self.template.reach;
        if let Place::Awake(at) = place {
            let piece = self.awake.get(at).moved(state, far);
            self.awake.set(at, &piece);
            self.awake.refresh(at);
        } else {
            let piece = self.take(place).moved(state, far);
            self.index[id] = Place::Awake(self.awake.len());
            self.awake.push(id, &piece);
        }
        true
    }

    /// All pieces.
    pub fn iter(&self) -> impl Iterator<Item = (PieceId, BodyState)> + '_ {
        self.index.iter().map(|(id, &place)| (id, self.state_at(place)))
    }

    /// Pose of the hull's frame of a piece, to draw its mesh: origin in m and orientation, a share `alpha` (0 to 1) of the
    /// way from the tick before to the last.
    pub fn hull_pose(&self, id: PieceId, alpha: f32) -> Option<(Vec3, Quat)> {
        let alpha = if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 1.0 };
        let (position, orientation) = match *self.index.get(id)? {
            Place::Awake(at) => {
                let [before, now] = self.awake.poses(at);
                (before.0 + (now.0 - before.0) * alpha, between(before.1, now.1, alpha))
            }
            Place::Riding(at) => {
                let state =
                    self.riders[at].state(self.now - f64::from((1.0 - alpha) * self.dt), self.every(), self.felt);
                (state.position, state.orientation)
            }
            Place::Asleep { block, at } => {
                let state = self.sleepers.blocks[block].pieces[at].state;
                (state.position, state.orientation)
            }
        };
        Some((position - matrix(orientation) * self.body.desc().center_of_mass, orientation))
    }

    /// What a piece is doing.
    pub fn activity(&self, id: PieceId) -> Option<Activity> {
        self.index.get(id).map(|place| match place {
            Place::Awake(_) => Activity::Awake,
            Place::Riding(_) => Activity::Riding,
            Place::Asleep { .. } => Activity::Asleep,
        })
    }

    /// Where the fleet is seen from, local world; `None` (default) if nobody looks, and no piece rides.
    pub fn look(&mut self, eye: Option<Vec3>) {
        self.eye = eye.filter(|e| e.is_finite());
    }

    /// Appends what the last step changed in the water, with [`Radiation::Grid`]: for each piece the volume that it displaces
    /// now (+) and displaced before (-). Pieces that ride or sleep change nothing.
    pub fn displacements(&self, out: &mut Vec<Displacement>) {
        if self.desc.body.radiation == Radiation::Grid {
            tell::tell(&self.awake.packs, self.awake.len(), self.template.radius, out);
        }
    }

    /// Shifts the local origin by `offset` m (x, z) without disturbing anything: what was at `offset` is at 0.
    pub fn rebase(&mut self, offset: Vec2) {
        self.awake.packs.iter_mut().for_each(|pack| pack.rebase(offset));
        self.riders.iter_mut().for_each(|rider| rider.rebase(offset));
        self.sleepers.rebase(offset);
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

    /// Time in s between two readings of a rider's plane.
    fn every(&self) -> f32 {
        ride::refresh(self.desc.refresh as usize) as f32 * self.dt
    }

    fn state_at(&self, place: Place) -> BodyState {
        match place {
            Place::Awake(at) => self.awake.state(at),
            Place::Riding(at) => self.riders[at].state(self.now, self.every(), self.felt),
            Place::Asleep { block, at } => self.sleepers.blocks[block].pieces[at].state,
        }
    }

    /// Takes a piece from its place and closes the gap.
    fn take(&mut self, place: Place) -> Piece {
        let (piece, moved) = match place {
            Place::Awake(at) => (self.awake.swap_remove(at), self.awake.ids.get(at)),
            Place::Riding(at) => {
                let far = TELEPORT * self.template.reach;
                let piece = self.riders.swap_remove(at).piece(self.now, self.dt, self.every(), self.felt, far);
                (piece, self.riders.get(at).map(|r| &r.id))
            }
            Place::Asleep { block, at } => {
                let piece = self.sleepers.take(block, at);
                (piece, self.sleepers.blocks[block].ids.get(at))
            }
        };
        if let Some(moved) = moved {
            self.index[*moved] = place;
        }
        piece
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
    let velocity = state.velocity.clamp_length_max(LIMITS.0);
    let angular_velocity = state.angular_velocity.clamp_length_max(LIMITS.1);
    state.is_sane().then_some(BodyState { orientation, velocity, angular_velocity, ..state })
}

/// Straight from one orientation to another near by.
fn between(a: Quat, b: Quat, share: f32) -> Quat {
    let (a, b) = (a.to_array(), b.to_array());
    let along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    let sign = if along < 0.0 { -1.0 } else { 1.0 };
    normalized(std::array::from_fn(|i| a[i] + (sign * b[i] - a[i]) * share))
}
