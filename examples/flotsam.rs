//! Ten thousand crates and barrels adrift on the sea, and a boat that ploughs through them. Near pieces are moved by forces;
//! those that the eye sees as small as a pixel or two ride on the water.

use std::collections::HashSet;
use std::f32::consts::{FRAC_PI_2, TAU};
use std::process::ExitCode;

use glam::{Affine3A, Quat, Vec2, Vec3};
use open_water::{BodyDesc, BodyState, BodyStates, Controls, Follow, GridDesc, Hull, Look, OpenWater, Pose, Tick};
use open_water_examples::{
    Dice, Field, Helm, Launch, Mark, Options, Plough, Scene, SceneError, Setup, Subject, Viewpoint, boat_mesh,
    dry_room, run, run_up,
};
use water_view::{Camera, Instance, MeshId, MeshView};

/// Radius of the field of 10,000 pieces, metres, and of the boat's course through it.
const FIELD: f32 = 240.0;
const COURSE: f32 = 70.0;
/// The pieces lie in bands across the wind, so far apart, metres.
const BANDS: f32 = 34.0;
/// Nothing floats where the boat begins, metres.
const CLEAR: f32 = 8.0;
/// Full speed, m/s, and the autopilot's throttle.
const SPEED: f32 = 11.0;
const CRUISE: f32 = 0.7;
/// Seconds run before the first picture.
const LEAD: f32 = 8.0;

/// Options of this scene.
#[derive(Debug, Clone, clap::Args)]
struct More {
    /// Pieces of flotsam, 1 to 100,000
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pieces: u32,
}

struct Flotsam {
    water: OpenWater,
    states: BodyStates,
    boat: Launch,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    field: Field,
    mesh: Option<MeshId>,
    eye: Vec3,
}

fn main() -> ExitCode {
    run::<Flotsam>()
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

/// Chooses places in a field of that radius, metres: denser in bands and towards the middle, one piece to a cell so that
/// none begin in one another.
struct Places {
    dice: Dice,
    radius: f32,
    taken: HashSet<[i32; 2]>,
}

impl Places {
    fn next(&mut self) -> Vec2 {
        const CELL: f32 = 2.0;
        // Rarely as many tries; then anywhere.
        for _ in 0..1000 {
            let dice = &mut self.dice;
            let place = Vec2::from_angle(TAU * dice.roll()) * (self.radius * dice.roll().powf(0.6));
            let across = place.x + 6.0 * (place.y / 21.0).sin() + 3.0 * (place.y / 7.3).cos();
            let band = 0.5 + 0.5 * (TAU * across / BANDS).cos();
            let starts = place.distance(Vec2::new(COURSE, 0.0)) < CLEAR;
            let cell = (place / CELL).round();
            if !starts && dice.roll() < 0.12 + 0.88 * band * band && self.taken.insert([cell.x as i32, cell.y as i32]) {
                return CELL * (cell + 0.2 * Vec2::from_angle(TAU * dice.roll()));
            }
        }
        Vec2::from_angle(TAU * self.dice.roll()) * self.radius
    }
}

impl Flotsam {
    fn state(&self) -> BodyState {
        self.states.get(self.boat.body).copied().unwrap_or(BodyState::at_rest(Vec3::ZERO))
    }

    /// Awake, riding, asleep.
    fn counts(&self) -> String {
        let [awake, riding, asleep] = self.field.activity(&self.water);
        format!("{} pieces: {awake} awake, {riding} riding, {asleep} asleep", self.field.len())
    }
}

impl Scene for Flotsam {
    const NAME: &'static str = "flotsam";
    const ABOUT: &'static str = "Ten thousand crates and barrels adrift, and a boat that ploughs through them.";
    const SEA: &'static str = include_str!("assets/seas/breeze.txt");
    const VIEWPOINTS: usize = 2;
    type More = More;
    type Assets = More;

    fn assets(more: &More) -> Result<More, SceneError> {
        Ok(more.clone())
    }

    fn new(options: &Options, setup: &Setup<More>, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
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
        let wake = water.add_grid(GridDesc { follow: Follow::Body(boat), ..options.preset().grid() })?;
        let mut field = Field::new(&mut water)?;
        let radius = FIELD * (setup.assets.pieces as f32 / 10_000.0).sqrt().max(0.3);
        let mut places = Places { dice: Dice(options.seed), radius, taken: HashSet::new() };
        for _ in 0..setup.assets.pieces {
            let at = places.next();
            field.throw(&mut water, &mut places.dice, at)?;
        }
        let launch = Launch::new(boat, Some(wake), hull.bounds());
        let mut scene = Self {
            water,
            states,
            boat: launch,
            hull,
            waterline,
            fittings: setup.own_hull,
            field,
            mesh: None,
            eye: start.position + Vec3::Y * 6.0,
        };
        run_up(&mut scene, options, LEAD)?;
        Ok(scene)
    }

    fn water(&self) -> &OpenWater {
        &self.water
    }

    fn water_mut(&mut self) -> &mut OpenWater {
        &mut self.water
    }

    fn seen(&mut self, camera: &Camera) {
        let Camera { position, orientation, fov_y, aspect, .. } = *camera;
        self.eye = position;
        self.water.look(Look { eye: position, direction: orientation * Vec3::NEG_Z, fov_y, aspect });
    }

    fn tick(&mut self, tick: Tick, helm: Helm) -> Result<(), SceneError> {
        let now = self.state();
        let [throttle, steering] =
            helm.manual.unwrap_or_else(|| [CRUISE, steer(now.position, now.orientation * Vec3::X)]);
        self.water.set_controls(self.boat.body, Controls { throttle, steering, ..Controls::default() })?;
        self.water.tick(tick, &mut self.states)?;
        let BodyState { position, orientation, velocity, .. } = self.state();
        let plough = Plough { pose: Pose { position, orientation }, velocity, bounds: self.boat.bounds };
        self.field.part(&mut self.water, &plough)?;
        if tick.index.is_multiple_of(60) && !self.field.farthest(&self.water).is_finite() {
            return Err(SceneError::NotFinite("a piece of flotsam", self.water.time()));
        }
        Ok(())
    }

    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        self.mesh = Some(meshes.add(device, &boat_mesh(&self.hull, self.waterline, self.fittings), 1));
        self.field.build(device, meshes);
    }

    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView) {
        if let (Some(mesh), Some(pose)) = (self.mesh, self.water.drawn_pose(self.boat.body)) {
            let world_from_mesh = Affine3A::from_rotation_translation(pose.orientation, pose.position);
            meshes.place(queue, mesh, &[Instance { world_from_mesh, tint: Vec3::ONE }]);
        }
        self.field.place(&self.water, self.eye, queue, meshes);
    }

    fn viewpoint(&self, index: usize) -> Option<Viewpoint> {
        let views = [
            (Vec3::new(0.0, 38.0, -150.0), Vec3::new(10.0, 0.0, 0.0)),
            (Vec3::new(COURSE + 4.0, 2.2, 62.0), Vec3::new(20.0, 0.0, 70.0)),
        ];
        views.get(index).map(|&(eye, target)| Viewpoint { eye, target })
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
        self.field.marks(&self.water, &mut marks);
        marks.extend(self.water.drawn_pose(self.boat.body).map(|pose| self.boat.mark(pose)));
        marks
    }

    fn status(&self) -> String {
        let speed = self.state().velocity.with_y(0.0).length();
        format!("boat {speed:.1} m/s, t {:.1} s\n{}", self.water.time(), self.counts())
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        let far = self.field.farthest(&self.water);
        vec![("flotsam", format!("{}, the farthest {far:.1} m from the middle", self.counts()))]
    }
}
