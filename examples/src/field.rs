//! A field of flotsam: thousands of crates and barrels, a fleet for each kind.

use glam::{Affine3A, Quat, Vec2, Vec3};
use open_water::{Activity, BodyState, FleetDesc, FleetId, OpenWater, PieceId, Pose, SoftContact};
use water_view::{Instance, MeshId, MeshView};

use crate::{Dice, Kind, Mark, SceneError};

/// Pieces nearer to the eye than this are drawn with their battens and hoops, metres.
const DETAILED: f32 = 90.0;
/// Pieces that look smaller than this ride on the water, radians: some pixels.
const RIDE_BELOW: f32 = 0.006;
/// As fast as a hull pushes pieces aside, m/s.
const FASTEST: f32 = 6.0;

struct Piece {
    id: PieceId,
    tint: Vec3,
}

/// The pieces of one kind.
struct Sort {
    kind: Kind,
    fleet: FleetId,
    pieces: Vec<Piece>,
    /// With detail and without.
    meshes: Option<[MeshId; 2]>,
}

/// All pieces.
pub struct Field {
    sorts: Vec<Sort>,
    instances: [Vec<Instance>; 2],
    drawn: Vec<(PieceId, BodyState)>,
}

/// A hull from above, as far as pieces are concerned.
#[derive(Debug, Clone, Copy)]
pub struct Plough {
    /// Where it is.
    pub pose: Pose,
    /// How it moves, m/s.
    pub velocity: Vec3,
    /// Corners of its bounding box, hull frame, metres.
    pub bounds: (Vec3, Vec3),
}

impl Plough {
    /// Half its width at a place along it, 0 before and behind, and how that grows backwards.
    fn half_width(&self, x: f32) -> (f32, f32) {
        let (low, high) = self.bounds;
        let (length, half) = (high.x - low.x, 0.5 * (high.z - low.z));
        let t = (x - low.x) / length;
        if !(0.0..=1.0).contains(&t) {
            return (0.0, 0.0);
        }
        // Straight sides, and a bow that is a parabola.
        let bow = ((t - 0.5) / 0.5).max(0.0);
        (half * (1.0 - bow * bow), 4.0 * half * bow / length)
    }

    /// A piece that it meets, pushed aside.
    fn shove(&self, piece: &BodyState, radius: f32) -> Option<BodyState> {
        let away = piece.position - self.pose.position;
        let at = self.pose.orientation.inverse() * away;
        let (half, slant) = self.half_width(at.x);
        let inside = half + 0.7 * radius - at.z.abs();
        if half == 0.0 || inside <= 0.0 || at.y > self.bounds.1.y + radius {
            return None;
        }
        let side = self.pose.orientation * (Vec3::Z * at.z.signum());
        let ahead = self.pose.orientation * Vec3::X;
        // The sides run past; the bow parts what it meets.
        let wanted = (self.velocity.dot(ahead) * slant).clamp(0.3, FASTEST);
        let outwards = piece.velocity.dot(side);
        let velocity = piece.velocity + side * (wanted - outwards).max(0.0);
        let position = piece.position + side * inside.min(0.1);
        // Off centre, a push turns it.
        let spin = Vec3::Y * (0.4 * (wanted - outwards).max(0.0) * at.z.signum() / (1.0 + radius));
        let angular_velocity = piece.angular_velocity * 0.95 + spin * 0.1;
        Some(BodyState { position, velocity, angular_velocity, ..*piece })
    }
}

impl Field {
    /// An empty field.
    ///
    /// # Errors
    /// The water refuses a fleet.
    pub fn new(water: &mut OpenWater) -> Result<Self, SceneError> {
        let sort = |kind: Kind| {
            let body = kind.body()?;
            let contact = Some(SoftContact::of(&body.hull));
            let fleet = water.add_fleet(FleetDesc { ride_below: RIDE_BELOW, contact, ..FleetDesc::new(body) })?;
            Ok::<_, SceneError>(Sort { kind, fleet, pieces: Vec::new(), meshes: None })
        };
        let sorts = Kind::ALL.into_iter().map(sort).collect::<Result<_, _>>()?;
        Ok(Self { sorts, instances: Default::default(), drawn: Vec::new() })
    }

    /// Throws a piece into the water at a place, its kind, colour and heading by chance.
    ///
    /// # Errors
    /// The water refuses it.
    pub fn throw(&mut self, water: &mut OpenWater, dice: &mut Dice, place: Vec2) -> Result<(), SceneError> {
        let (kind, tint) = Kind::by_chance(dice);
        let orientation = Quat::from_rotation_y(std::f32::consts::TAU * dice.roll());
        let state = BodyState { orientation, ..BodyState::at_rest(Vec3::new(place.x, 0.2, place.y)) };
        let sort = &mut self.sorts[kind as usize];
        let id = water.fleet_mut(sort.fleet)?.add(state).map_err(open_water::OpenWaterError::from)?;
        sort.pieces.push(Piece { id, tint });
        Ok(())
    }

    /// How many pieces there are.
    pub fn len(&self) -> usize {
        self.sorts.iter().map(|sort| sort.pieces.len()).sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Lets a hull push aside what it meets.
    ///
    /// # Errors
    /// Never while the water has the fleets.
    pub fn part(&mut self, water: &mut OpenWater, plough: &Plough) -> Result<(), SceneError> {
        let reach = (plough.bounds.1 - plough.bounds.0).length();
        for sort in &self.sorts {
            let fleet = water.fleet_mut(sort.fleet)?;
            let radius = sort.kind.half().max_element();
            self.drawn.clear();
            let near = |state: &BodyState| state.position.distance_squared(plough.pose.position) < reach * reach;
            self.drawn.extend(fleet.iter().filter(|(_, state)| near(state)));
            for (id, state) in &self.drawn {
                if let Some(state) = plough.shove(state, radius) {
                    fleet.set_state(*id, state);
                }
            }
        }
        Ok(())
    }

    /// How many pieces are awake, ride and sleep.
    pub fn activity(&self, water: &OpenWater) -> [usize; 3] {
        let mut count = [0; 3];
        for sort in &self.sorts {
            let Ok(fleet) = water.fleet(sort.fleet) else { continue };
            for piece in &sort.pieces {
                match fleet.activity(piece.id) {
                    Some(Activity::Awake) => count[0] += 1,
                    Some(Activity::Riding) => count[1] += 1,
                    Some(Activity::Asleep) => count[2] += 1,
                    None => {}
                }
            }
        }
        count
    }

    /// Largest distance of a piece from the origin, metres; NaN if one is lost.
    pub fn farthest(&self, water: &OpenWater) -> f32 {
        let far = |sort: &Sort| {
            let Ok(fleet) = water.fleet(sort.fleet) else { return f32::NAN };
            fleet.iter().fold(0.0, |far: f32, (_, state)| {
                let away = state.position.length();
                if away.is_nan() { away } else { far.max(away) }
            })
        };
        self.sorts.iter().map(far).fold(0.0, |a, b| if b.is_nan() || b > a { b } else { a })
    }

    /// Uploads the meshes, once.
    pub fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        for sort in &mut self.sorts {
            let room = sort.pieces.len().max(1);
            let kind = sort.kind;
            sort.meshes = Some([kind.mesh(), kind.plain_mesh()].map(|mesh| meshes.add(device, &mesh, room)));
        }
    }

    /// Draws the pieces as seen from `eye`.
    pub fn place(&mut self, water: &OpenWater, eye: Vec3, queue: &wgpu::Queue, meshes: &mut MeshView) {
        for sort in &self.sorts {
            self.instances.iter_mut().for_each(Vec::clear);
            for piece in &sort.pieces {
                let Some(Pose { position, orientation }) = water.drawn_piece(sort.fleet, piece.id) else { continue };
                let world_from_mesh = Affine3A::from_rotation_translation(orientation, position);
                let far = usize::from(position.distance_squared(eye) > DETAILED * DETAILED);
                self.instances[far].push(Instance { world_from_mesh, tint: piece.tint });
            }
            for (mesh, instances) in sort.meshes.into_iter().flatten().zip(&self.instances) {
                meshes.place(queue, mesh, instances);
            }
        }
    }

    /// The pieces as flat shapes.
    pub fn marks(&self, water: &OpenWater, marks: &mut Vec<Mark>) {
        for sort in &self.sorts {
            for piece in &sort.pieces {
                if let Some(pose) = water.drawn_piece(sort.fleet, piece.id) {
                    marks.push(sort.kind.mark(pose, piece.tint));
                }
            }
        }
    }
}
