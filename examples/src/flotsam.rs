//! Flotsam: crates and barrels that float about.

use glam::{Affine3A, Quat, Vec2, Vec3};
use open_water::{BodyDesc, BodyId, BodyState, Hull, OpenWater, OpenWaterError, Pose};
use water_view::{Instance, MeshData, MeshId, MeshView};

use crate::{Dice, Mark, SceneError, barrel, crate_box};

/// Size, metres, and mass, kg, of the crates.
const CRATES: [(Vec3, f32); 2] = [(Vec3::new(0.9, 0.7, 0.7), 190.0), (Vec3::new(1.4, 0.9, 1.0), 520.0)];
/// Radius and length, metres, and mass, kg, of a barrel.
const BARREL: (f32, f32, f32) = (0.3, 0.9, 95.0);
const TINTS: [Vec3; 4] =
    [Vec3::new(1.0, 0.35, 0.12), Vec3::new(0.2, 0.45, 0.85), Vec3::new(0.95, 0.8, 0.2), Vec3::new(0.85, 0.85, 0.85)];

/// What a piece is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A small crate.
    Small,
    /// A large crate.
    Large,
    /// A barrel along its x axis.
    Barrel,
}

impl Kind {
    /// All kinds, in the order of their meshes.
    pub const ALL: [Self; 3] = [Self::Small, Self::Large, Self::Barrel];

    /// Its body.
    ///
    /// # Errors
    /// Never for the kinds there are; a hull's own error.
    pub fn body(self) -> Result<BodyDesc, SceneError> {
        let (hull, mass) = match self {
            Self::Small | Self::Large => {
                let (size, mass) = CRATES[self as usize];
                (Hull::cuboid(size), mass)
            }
            Self::Barrel => (Hull::cylinder(BARREL.0, BARREL.1), BARREL.2),
        };
        Ok(BodyDesc::from_hull(&hull.map_err(OpenWaterError::from)?, mass))
    }

    /// A kind and its colour.
    pub fn by_chance(dice: &mut Dice) -> (Self, Vec3) {
        let kind = Self::ALL[(dice.roll() * 3.0) as usize % 3];
        let tint = match kind {
            Self::Barrel => TINTS[(dice.roll() * TINTS.len() as f32) as usize % TINTS.len()],
            Self::Small | Self::Large => Vec3::splat(0.75 + 0.5 * dice.roll()),
        };
        (kind, tint)
    }

    /// Its mesh.
    pub fn mesh(self) -> MeshData {
        match self {
            Self::Small | Self::Large => crate_box(CRATES[self as usize].0),
            Self::Barrel => barrel(BARREL.0, BARREL.1),
        }
    }

    /// Its mesh for far away.
    pub fn plain_mesh(self) -> MeshData {
        let mut mesh = MeshData::default();
        match self {
            Self::Small | Self::Large => mesh.cuboid(Vec3::ZERO, 0.49 * CRATES[self as usize].0, [136, 110, 78, 10]),
            Self::Barrel => mesh.cylinder(
                Vec3::X * (-0.5 * BARREL.1),
                Vec3::X * (0.5 * BARREL.1),
                BARREL.0,
                8,
                [190, 190, 190, 130],
            ),
        }
        mesh
    }

    /// It as a flat shape.
    pub fn mark(self, pose: Pose, tint: Vec3) -> Mark {
        let (x, z) = (self.half().x, self.half().z);
        let wood = Vec3::new(150.0, 105.0, 60.0);
        let paint = if self == Self::Barrel { 255.0 * tint } else { wood * tint };
        let color = paint.to_array().map(|c| c.min(255.0) as u8);
        Mark::of(pose, &[(-x, -z), (x, -z), (x, z), (-x, z)], color)
    }

    /// Half its size along its axes, metres.
    pub fn half(self) -> Vec3 {
        match self {
            Self::Small | Self::Large => 0.5 * CRATES[self as usize].0,
            Self::Barrel => Vec3::new(0.5 * BARREL.1, BARREL.0, BARREL.0),
        }
    }
}

/// A piece of flotsam.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    /// Its body.
    pub body: BodyId,
    /// What it is.
    pub kind: Kind,
    tint: Vec3,
    start: Vec3,
}

/// All pieces of a scene.
#[derive(Debug, Default)]
pub struct Flotsam {
    /// The pieces.
    pub pieces: Vec<Piece>,
    meshes: Vec<MeshId>,
    instances: Vec<Instance>,
}

impl Flotsam {
    /// Throws a piece into the water at `place` (x, z), its kind, colour and heading by chance. Returns where it starts.
    ///
    /// # Errors
    /// The water refuses it.
    pub fn throw(
        &mut self,
        water: &mut OpenWater,
        dice: &mut Dice,
        place: Vec2,
    ) -> Result<(Piece, BodyState), SceneError> {
        let (kind, tint) = Kind::by_chance(dice);
        let orientation = Quat::from_rotation_y(std::f32::consts::TAU * dice.roll());
        let start = Vec3::new(place.x, 0.2, place.y);
        let state = BodyState { orientation, ..BodyState::at_rest(start) };
        Ok((self.add(water, kind, tint, start)?, state))
    }

    /// Adds a piece that starts at `start`.
    ///
    /// # Errors
    /// The water refuses it.
    pub fn add(&mut self, water: &mut OpenWater, kind: Kind, tint: Vec3, start: Vec3) -> Result<Piece, SceneError> {
        let piece = Piece { body: water.add_body(kind.body()?)?, kind, tint, start };
        self.pieces.push(piece);
        Ok(piece)
    }

    /// Uploads the meshes, once.
    pub fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        let room = self.pieces.len();
        self.meshes = Kind::ALL.iter().map(|kind| meshes.add(device, &kind.mesh(), room)).collect();
    }

    /// Draws the pieces where `pose` says that they stand.
    pub fn place(&mut self, pose: impl Fn(BodyId) -> Option<Pose>, queue: &wgpu::Queue, meshes: &mut MeshView) {
        for (kind, mesh) in Kind::ALL.into_iter().zip(&self.meshes) {
            self.instances.clear();
            self.instances.extend(self.pieces.iter().filter(|piece| piece.kind == kind).filter_map(|piece| {
                let pose = pose(piece.body)?;
                let world_from_mesh = Affine3A::from_rotation_translation(pose.orientation, pose.position);
                Some(Instance { world_from_mesh, tint: piece.tint })
            }));
            meshes.place(queue, *mesh, &self.instances);
        }
    }

    /// The pieces as flat shapes.
    pub fn marks(&self, pose: impl Fn(BodyId) -> Option<Pose>, marks: &mut Vec<Mark>) {
        let marked = |piece: &Piece| Some(piece.kind.mark(pose(piece.body)?, piece.tint));
        marks.extend(self.pieces.iter().filter_map(marked));
    }

    /// Mean and largest distance of the pieces from where they were put, metres; `now` tells where one is.
    pub fn drift(&self, now: impl Fn(BodyId) -> Option<Vec3>) -> (f32, f32) {
        let away = self.pieces.iter().filter_map(|piece| {
            let now = now(piece.body)?;
            Some(Vec2::new(now.x - piece.start.x, now.z - piece.start.z).length())
        });
        let (sum, max) = away.fold((0.0, 0.0f32), |(sum, max), d| (sum + d, max.max(d)));
        (sum / self.pieces.len().max(1) as f32, max)
    }

    /// A line of the summary.
    pub fn summary(&self, now: impl Fn(BodyId) -> Option<Vec3>) -> String {
        let (mean, max) = self.drift(now);
        format!("{} pieces, moved {mean:.2} m on average, {max:.2} m at most", self.pieces.len())
    }
}
