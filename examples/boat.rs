//! A boat under power on an open sea with its wake, and 200 pieces of flotsam that bob and are moved by the wake.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::process::ExitCode;

use glam::{Affine3A, Quat, Vec2, Vec3};
use open_water::{BodyDesc, BodyState, BodyStates, Controls, Follow, GridDesc, Hull, OpenWater, Pose, Scheme, Tick};
use open_water_examples::{
    Dice, Flotsam, Helm, Launch, Mark, NoMore, Options, Scene, SceneError, Setup, Stroke, Subject, boat_mesh, dry_room,
    run, run_up,
};
use water_view::{Instance, MeshId, MeshView};

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

struct Boat {
    water: OpenWater,
    states: BodyStates,
    boat: Launch,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    flotsam: Flotsam,
    mesh: Option<MeshId>,
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
    fn scatter(&mut self, seed: u64) -> Result<(), SceneError> {
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
            let place = Vec2::new(radius * cos, radius * sin);
            let (piece, state) = self.flotsam.throw(&mut self.water, &mut dice, place)?;
            self.states.insert(piece.body, state);
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.states.get(self.boat.body).copied().unwrap_or(BodyState::at_rest(Vec3::ZERO))
    }
}

impl Scene for Boat {
    const NAME: &'static str = "boat";
    const ABOUT: &'static str = "A boat on an open sea with its wake, among flotsam.";
    type More = NoMore;
    type Assets = ();

    fn assets(_: &NoMore) -> Result<(), SceneError> {
        Ok(())
    }

    fn new(options: &Options, setup: &Setup, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
        // A quarter of the volume under water: about what an open launch carries.
        let desc = BodyDesc::boat(&hull, 0.24 * hull.volume() * 1025.0, SPEED);
        let waterline = hull.waterline(desc.displaced_volume()).level;
        let boat = water.add_body(options.preset().body(desc))?;
        water.set_dry(boat, Some(dry_room(&hull)?))?;
        let start = BodyState {
            orientation: Quat::from_rotation_y(-FRAC_PI_2),
            velocity: Vec3::new(0.0, 0.0, 6.0),
            ..BodyState::at_rest(Vec3::new(COURSE, 0.4, 0.0))
        };
        let mut states = BodyStates::default();
        states.insert(boat, start);
        let grid = GridDesc { follow: Follow::Body(boat), ..options.preset().grid() };
        let (mut cells, mut within) = (grid.cells, None);
        if grid.scheme == Scheme::Dispersive {
            // Fine cells around the boat, and twice as large ones for three times as far.
            let far = GridDesc { cell_size: grid.cell_size.map(|h| 2.0 * h), ..grid.clone() };
            (cells, within) = (cells.map(|n| n * 2 / 3), Some(water.add_grid(far)?));
        }
        let wake = water.add_grid(GridDesc { cells, within, ..grid })?;
        let mut launch = Launch::new(boat, Some(wake), hull.bounds());
        launch.far = within;
        let mut scene = Self {
            water,
            states,
            boat: launch,
            hull,
            waterline,
            fittings: setup.own_hull,
            flotsam: Flotsam::default(),
            mesh: None,
            way: 0.0,
            last: start.position,
        };
        scene.scatter(options.seed)?;
        run_up(&mut scene, options, LEAD)?;
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
        self.water.set_controls(self.boat.body, Controls { throttle, steering, ..Controls::default() })?;
        self.water.tick(tick, &mut self.states)?;
        let position = self.state().position;
        self.way += (position - self.last).with_y(0.0).length();
        self.last = position;
        Ok(())
    }

    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        self.mesh = Some(meshes.add(device, &boat_mesh(&self.hull, self.waterline, self.fittings), 1));
        self.flotsam.build(device, meshes);
    }

    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView) {
        if let (Some(mesh), Some(pose)) = (self.mesh, self.water.drawn_pose(self.boat.body)) {
            let world_from_mesh = Affine3A::from_rotation_translation(pose.orientation, pose.position);
            meshes.place(queue, mesh, &[Instance { world_from_mesh, tint: Vec3::ONE }]);
        }
        let water = &self.water;
        self.flotsam.place(|body| water.drawn_pose(body), queue, meshes);
    }

    fn subject(&self) -> Subject {
        let state = self.state();
        let start = Pose { position: state.position, orientation: state.orientation };
        self.boat.subject(self.water.drawn_pose(self.boat.body).unwrap_or(start))
    }

    fn look_down(&mut self) {
        self.boat.look_down(&self.water);
    }

    fn foam(&self, at: Vec2) -> f32 {
        self.boat.foam(&self.water, at)
    }

    fn marks(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        self.flotsam.marks(|body| self.water.drawn_pose(body), &mut marks);
        marks.extend(self.water.drawn_pose(self.boat.body).map(|pose| self.boat.mark(pose)));
        marks
    }

    fn strokes(&self) -> Vec<Stroke> {
        self.boat.strokes(&self.water)
    }

    fn status(&self) -> String {
        let speed = self.state().velocity.with_y(0.0).length();
        format!("boat {speed:.1} m/s, {} bodies, t {:.1} s", self.water.body_count(), self.water.time())
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        let speed = self.state().velocity.with_y(0.0).length();
        vec![
            ("boat", format!("{:.1} m of way made, {speed:.2} m/s at the end", self.way)),
            ("flotsam", self.flotsam.summary(|body| Some(self.states.get(body)?.position))),
        ]
    }
}
