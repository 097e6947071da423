//! A boat under power on an open sea with its wake, and 200 pieces of flotsam that bob and are moved by the wake.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::process::ExitCode;

use glam::{Affine3A, DVec2, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Controls, Follow, GridDesc, GridId, Hull, OpenWater, OpenWaterError, Tick,
};
use open_water_examples::{
    Dice, Helm, Mark, Options, Scene, SceneError, Setup, Subject, barrel, boat_mesh, crate_box, run,
};
use water_view::{DryHull, Instance, MeshId, MeshView};

/// Pieces of flotsam.
const FLOTSAM: u32 = 200;
/// Radius of the course, metres, and of the ring around it that holds the flotsam.
const COURSE: f32 = 60.0;
const RING: [f32; 2] = [22.0, 98.0];
/// Nothing floats closer to the course, metres.
const CLEAR: f32 = 7.0;
/// Full speed, m/s, and the autopilot's throttle.
const SPEED: f32 = 12.0;
const CRUISE: f32 = 0.75;
/// Seconds run before the first picture: flotsam settles, the wake grows.
const LEAD: f32 = 6.0;

/// Kinds of flotsam: side or radius and length, metres, mass, kg.
const CRATES: [(Vec3, f32); 2] = [(Vec3::new(0.9, 0.7, 0.7), 190.0), (Vec3::new(1.4, 0.9, 1.0), 520.0)];
const BARREL: (f32, f32, f32) = (0.3, 0.9, 95.0);
const TINTS: [Vec3; 4] =
    [Vec3::new(1.0, 0.35, 0.12), Vec3::new(0.2, 0.45, 0.85), Vec3::new(0.95, 0.8, 0.2), Vec3::new(0.85, 0.85, 0.85)];

struct Piece {
    body: BodyId,
    kind: usize,
    tint: Vec3,
    start: Vec3,
}

struct Boat {
    water: OpenWater,
    states: BodyStates,
    boat: BodyId,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    wake: GridId,
    flotsam: Vec<Piece>,
    meshes: Vec<MeshId>,
    instances: Vec<Instance>,
    /// Drawn (height, foam) of the wake's grid, for the view from above.
    wake_cells: Vec<[f32; 2]>,
    /// Way made by the boat, metres, and where it was.
    way: f32,
    last: Vec3,
}

fn main() -> ExitCode {
    run::<Boat>()
}

/// The autopilot: around the origin at the radius of the course, back onto it when off.
fn steer(position: Vec3, forward: Vec3) -> f32 {
    let out = Vec2::new(position.x, position.z);
    let off = (out.length() - COURSE) / 25.0;
    let along = out.normalize_or(Vec2::X).perp();
    let wanted = along - out.normalize_or(Vec2::X) * off.clamp(-1.0, 1.0);
    let ahead = Vec2::new(forward.x, forward.z).normalize_or(Vec2::X);
    (1.6 * ahead.angle_to(wanted)).clamp(-0.8, 0.8)
}

impl Boat {
    fn add_boat(&mut self, options: &Options) -> Result<(), SceneError> {
        let start = BodyState {
            orientation: Quat::from_rotation_y(-FRAC_PI_2),
            velocity: Vec3::new(0.0, 0.0, 6.0),
            ..BodyState::at_rest(Vec3::new(COURSE, 0.4, 0.0))
        };
        self.states.insert(self.boat, start);
        self.last = start.position;
        let grid = GridDesc { follow: Follow::Body(self.boat), ..options.preset().grid() };
        self.wake = self.water.add_grid(grid)?;
        Ok(())
    }

    fn scatter(&mut self, seed: u64) -> Result<(), SceneError> {
        let mut kinds = Vec::new();
        for (size, mass) in CRATES {
            kinds.push(BodyDesc::from_hull(&Hull::cuboid(size).map_err(OpenWaterError::from)?, mass));
        }
        let (radius, length, mass) = BARREL;
        kinds.push(BodyDesc::from_hull(&Hull::cylinder(radius, length).map_err(OpenWaterError::from)?, mass));
        let mut dice = Dice(seed);
        for _ in 0..FLOTSAM {
            // Even over the ring's area, but for the lane of the course.
            let radius = loop {
                let share = dice.roll();
                let radius = (RING[0] * RING[0] * (1.0 - share) + RING[1] * RING[1] * share).sqrt();
                if (radius - COURSE).abs() > CLEAR {
                    break radius;
                }
            };
            let (sin, cos) = (TAU * dice.roll()).sin_cos();
            let start = Vec3::new(radius * cos, 0.2, radius * sin);
            let kind = (dice.roll() * kinds.len() as f32) as usize % kinds.len();
            let tint = if kind < CRATES.len() {
                Vec3::splat(0.75 + 0.5 * dice.roll())
            } else {
                TINTS[(dice.roll() * TINTS.len() as f32) as usize % TINTS.len()]
            };
            let orientation = Quat::from_rotation_y(TAU * dice.roll());
            let body = self.water.add_body(kinds[kind].clone())?;
            self.states.insert(body, BodyState { orientation, ..BodyState::at_rest(start) });
            self.flotsam.push(Piece { body, kind, tint, start });
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.states.get(self.boat).copied().unwrap_or(BodyState::at_rest(Vec3::ZERO))
    }

    /// Mean and largest distance of the flotsam from where it was put, metres.
    fn drift(&self) -> (f32, f32) {
        let away = self.flotsam.iter().filter_map(|piece| {
            let now = self.states.get(piece.body)?.position;
            Some(Vec2::new(now.x - piece.start.x, now.z - piece.start.z).length())
        });
        let (sum, max) = away.fold((0.0, 0.0f32), |(sum, max), d| (sum + d, max.max(d)));
        (sum / self.flotsam.len().max(1) as f32, max)
    }
}

impl Scene for Boat {
    const NAME: &'static str = "boat";

    fn new(options: &Options, setup: &Setup, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
        // A quarter of the volume under water: about what an open launch carries.
        let desc = BodyDesc::boat(&hull, 0.24 * hull.volume() * 1025.0, SPEED);
        let waterline = hull.waterline(desc.displaced_volume()).level;
        let boat = water.add_body(options.preset().body(desc))?;
        let mut scene = Self {
            water,
            states: BodyStates::default(),
            boat,
            hull,
            waterline,
            fittings: setup.own_hull,
            wake: GridId::default(),
            flotsam: Vec::new(),
            meshes: Vec::new(),
            instances: Vec::new(),
            wake_cells: Vec::new(),
            way: 0.0,
            last: Vec3::ZERO,
        };
        scene.add_boat(options)?;
        scene.scatter(options.seed)?;
        let dt = scene.water.desc().tick;
        for _ in 0..(LEAD / dt) as u32 {
            for tick in scene.water.advance(dt) {
                scene.tick(tick, Helm::default())?;
            }
        }
        Ok(scene)
    }

    fn water(&self) -> &OpenWater {
        &self.water
    }

    fn water_mut(&mut self) -> &mut OpenWater {
        &mut self.water
    }

    fn tick(&mut self, tick: Tick, helm: Helm) -> Result<(), SceneError> {
        let now = self.state();
        let [throttle, steering] =
            helm.manual.unwrap_or_else(|| [CRUISE, steer(now.position, now.orientation * Vec3::X)]);
        self.water.set_controls(self.boat, Controls { throttle, steering, ..Controls::default() })?;
        self.water.tick(tick, &mut self.states)?;
        let position = self.state().position;
        self.way += (position - self.last).with_y(0.0).length();
        self.last = position;
        Ok(())
    }

    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        self.meshes = vec![meshes.add(device, &boat_mesh(&self.hull, self.waterline, self.fittings), 1)];
        let room = FLOTSAM as usize;
        self.meshes.extend(CRATES.map(|(size, _)| meshes.add(device, &crate_box(size), room)));
        self.meshes.push(meshes.add(device, &barrel(BARREL.0, BARREL.1), room));
    }

    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView) {
        let stand = |body, tint| {
            let pose = self.water.drawn_pose(body)?;
            Some(Instance {
                world_from_mesh: Affine3A::from_rotation_translation(pose.orientation, pose.position),
                tint,
            })
        };
        for (kind, mesh) in self.meshes.iter().enumerate() {
            self.instances.clear();
            if kind == 0 {
                self.instances.extend(stand(self.boat, Vec3::ONE));
            } else {
                let pieces = self.flotsam.iter().filter(|piece| piece.kind + 1 == kind);
                self.instances.extend(pieces.filter_map(|piece| stand(piece.body, piece.tint)));
            }
            meshes.place(queue, *mesh, &self.instances);
        }
    }

    fn dry(&self) -> Option<DryHull> {
        let pose = self.water.drawn_pose(self.boat)?;
        let (low, high) = self.hull.bounds();
        Some(DryHull {
            world_from_hull: Affine3A::from_rotation_translation(pose.orientation, pose.position),
            low,
            high,
        })
    }

    fn subject(&self) -> Subject {
        let (low, high) = self.hull.bounds();
        let length = high.x - low.x;
        match self.water.drawn_pose(self.boat) {
            Some(pose) => Subject { position: pose.position, orientation: pose.orientation, length },
            None => Subject { position: self.state().position, orientation: self.state().orientation, length },
        }
    }

    fn look_down(&mut self) {
        if let Ok(Some(grid)) = self.water.grid(self.wake) {
            let [nx, nz] = grid.desc().cells;
            self.wake_cells.resize((nx * nz) as usize, [0.0; 2]);
            grid.draw(1.0, &mut self.wake_cells);
        }
    }

    fn foam(&self, at: Vec2) -> f32 {
        let Ok(Some(grid)) = self.water.grid(self.wake) else { return 0.0 };
        let desc = grid.desc();
        let cell = (at - grid.window().local_corner(DVec2::ZERO)) / desc.cell_size;
        let inside = cell.cmpge(Vec2::ZERO).all() && cell.x < desc.cells[0] as f32 && cell.y < desc.cells[1] as f32;
        let index = cell.y as usize * desc.cells[0] as usize + cell.x as usize;
        if inside { self.wake_cells.get(index).map_or(0.0, |cell| cell[1]) } else { 0.0 }
    }

    fn marks(&self) -> Vec<Mark> {
        let outline = |body, corners: &[(f32, f32)], color| {
            let pose = self.water.drawn_pose(body)?;
            let world = |&(x, z): &(f32, f32)| {
                let p = pose.position + pose.orientation * Vec3::new(x, 0.0, z);
                Vec2::new(p.x, p.z)
            };
            Some(Mark { outline: corners.iter().map(world).collect(), color })
        };
        let mut marks: Vec<Mark> = self
            .flotsam
            .iter()
            .filter_map(|piece| {
                let half = CRATES.get(piece.kind).map_or(Vec2::new(0.45, 0.3), |(s, _)| 0.5 * Vec2::new(s.x, s.z));
                let (x, z) = (half.x, half.y);
                let wood = Vec3::new(150.0, 105.0, 60.0);
                let paint = if piece.kind < CRATES.len() { wood * piece.tint } else { 255.0 * piece.tint };
                let color = paint.to_array().map(|c| c.min(255.0) as u8);
                outline(piece.body, &[(-x, -z), (x, -z), (x, z), (-x, z)], color)
            })
            .collect();
        let (low, high) = self.hull.bounds();
        let side = |x: f32, z: f32| (low.x + x * (high.x - low.x), low.z + z * (high.z - low.z));
        let shape = [
            side(0.0, 0.0),
            side(0.6, 0.0),
            side(0.85, 0.2),
            side(1.0, 0.5),
            side(0.85, 0.8),
            side(0.6, 1.0),
            side(0.0, 1.0),
        ];
        marks.extend(outline(self.boat, &shape, [235, 235, 230]));
        marks
    }

    fn status(&self) -> String {
        let speed = self.state().velocity.with_y(0.0).length();
        format!("boat {speed:.1} m/s, {} bodies, t {:.1} s", self.water.body_count(), self.water.time())
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        let (mean, max) = self.drift();
        let speed = self.state().velocity.with_y(0.0).length();
        vec![
            ("boat", format!("{:.1} m of way made, {speed:.2} m/s at the end", self.way)),
            ("flotsam", format!("{} pieces, moved {mean:.2} m on average, {max:.2} m at most", self.flotsam.len())),
        ]
    }
}
