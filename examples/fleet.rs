//! Ten boats on the open sea. Nobody gives them grids: the water does, to those that matter most to the camera, within a
//! budget, with larger cells far away. The overlay tells who has one, and why others have none.

use std::f32::consts::TAU;
use std::fmt::Write as _;
use std::process::ExitCode;

use glam::{Affine3A, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Border, Controls, Follow, GridDesc, Hull, Look, OpenWater, Pose, Rain, Scheme,
    Tick, Wake, WakesDesc,
};
use open_water_examples::{
    Course, Helm, Launch, Mark, Options, Scene, SceneError, Setup, Stroke, Subject, Viewpoint, boat_mesh, dry_room,
    run, run_up,
};
use water_view::{Camera, Instance, MeshId, MeshView};

/// Full speed, m/s.
const SPEED: f32 = 12.0;
/// Seconds run before the first picture: the wakes grow.
const LEAD: f32 = 8.0;
/// Each boat's course is an oval: its middle, half its length and width (metres), where on it the boat begins (turns), throttle.
const COURSES: [([f32; 2], [f32; 2], f32, f32); 10] = [
    ([0.0, 0.0], [110.0, 60.0], 0.00, 0.72),
    ([0.0, 22.0], [110.0, 60.0], 0.97, 0.72),
    ([0.0, -22.0], [110.0, 60.0], 0.98, 0.70),
    ([40.0, 40.0], [70.0, 45.0], 0.30, 0.60),
    ([130.0, 90.0], [60.0, 40.0], 0.10, 0.65),
    ([-120.0, 70.0], [70.0, 50.0], 0.55, 0.62),
    ([60.0, 210.0], [90.0, 40.0], 0.70, 0.75),
    ([-60.0, 260.0], [80.0, 50.0], 0.20, 0.68),
    ([220.0, 200.0], [80.0, 60.0], 0.45, 0.70),
    ([20.0, 420.0], [120.0, 60.0], 0.80, 0.74),
];

/// Options of this scene.
#[derive(Debug, Clone, clap::Args)]
struct More {
    /// Rain, mm/h, 0 to 200
    #[arg(long, value_name = "R", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=200))]
    rain: u32,
}

/// Rain on a small tile that repeats over the sea around the eye.
fn shower(rate: u32, seed: u64) -> GridDesc {
    GridDesc {
        follow: Follow::Point,
        cells: [194; 2],
        cell_size: [0.03; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 0.6,
        border: Border::Periodic,
        damping: 1.0,
        rain: Some(Rain { rate: rate as f32, drop_radius: 0.002, seed }),
        ..GridDesc::default()
    }
}

struct Fleet {
    water: OpenWater,
    states: BodyStates,
    boats: Vec<Launch>,
    courses: Vec<Course>,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    mesh: Option<MeshId>,
    eye: Vec3,
    /// Most cells that all grids had, and how many boats at most.
    most: [usize; 2],
}

fn main() -> ExitCode {
    run::<Fleet>()
}

/// A course as marks in order.
fn oval(middle: [f32; 2], half: [f32; 2], throttle: f32) -> Vec<(Vec2, f32)> {
    let mark = |i: u8| Vec2::from(middle) + Vec2::from(half) * Vec2::from_angle(TAU * f32::from(i) / 24.0);
    (0..24).map(|i| (mark(i), throttle)).collect()
}

impl Fleet {
    fn pose(&self, boat: &Launch) -> Option<Pose> {
        self.water.drawn_pose(boat.body)
    }

    fn wake(&self, boat: &Launch) -> Wake {
        self.water.wake(boat.body).unwrap_or(Wake::NotAsked)
    }

    /// The boats, nearest to the eye first.
    fn by_distance(&self) -> Vec<(f32, usize)> {
        let away = |boat: &Launch| Some(self.pose(boat)?.position.distance(self.eye));
        let mut all: Vec<_> = self.boats.iter().enumerate().filter_map(|(i, boat)| Some((away(boat)?, i))).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }
}

impl Scene for Fleet {
    const NAME: &'static str = "fleet";
    const ABOUT: &'static str = "Ten boats; those that matter most to the camera have wakes, within a budget.";
    const SEA: &'static str = include_str!("assets/seas/breeze.txt");
    const VIEWPOINTS: usize = 2;
    type More = More;
    type Assets = More;

    fn assets(more: &More) -> Result<More, SceneError> {
        Ok(more.clone())
    }

    fn new(options: &Options, setup: &Setup<More>, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
        let desc = options.preset().body(BodyDesc::boat(&hull, 0.24 * hull.volume() * 1025.0, SPEED));
        let waterline = hull.waterline(desc.displaced_volume()).level;
        let preset = options.preset().grid();
        // Fewer and smaller cells than the preset's.
        let cells = preset.cells.map(|n| n * 3 / 4);
        let grid = GridDesc {
            cells,
            cell_size: preset.cell_size.map(|h| 0.8 * h),
            wave_speed: 0.8 * preset.wave_speed,
            ..preset
        };
        // Room for three near grids and a half.
        let room = u64::from(cells[0]) * u64::from(cells[1]) * 7 / 2;
        water.set_wakes(Some(WakesDesc { grid, cells: room, fine: 70.0, ..WakesDesc::default() }))?;
        if setup.assets.rain > 0 {
            water.add_grid(shower(setup.assets.rain, options.seed))?;
        }
        let mut states = BodyStates::default();
        let room = dry_room(&hull)?;
        let (mut boats, mut courses) = (Vec::new(), Vec::new());
        for (middle, half, from, throttle) in COURSES {
            let body = water.add_body(desc.clone())?;
            water.set_dry(body, Some(room.clone()))?;
            let turn = Vec2::from_angle(TAU * from);
            let place = Vec2::from(middle) + Vec2::from(half) * turn;
            let along = (Vec2::from(half) * turn.perp()).normalize_or(Vec2::X);
            let state = BodyState {
                orientation: Quat::from_rotation_y(-along.to_angle()),
                velocity: Vec3::new(along.x, 0.0, along.y) * 6.0,
                ..BodyState::at_rest(Vec3::new(place.x, 0.2, place.y))
            };
            states.insert(body, state);
            boats.push(Launch::new(body, None, hull.bounds()));
            courses.push(Course::new(oval(middle, half, throttle), place));
        }
        let mut scene = Self {
            water,
            states,
            boats,
            courses,
            hull,
            waterline,
            fittings: setup.own_hull,
            mesh: None,
            eye: Vec3::ZERO,
            most: [0; 2],
        };
        let start = scene.subject().position;
        let camera = Camera { position: start + Vec3::Y * 6.0, ..Camera::default() };
        scene.seen(&camera);
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
        for (i, (boat, course)) in self.boats.iter().zip(&mut self.courses).enumerate() {
            let Some(state) = self.states.get(boat.body) else { continue };
            let auto = course.steer(state.position, state.orientation * Vec3::X);
            let [throttle, steering] = if i == 0 { helm.manual.unwrap_or(auto) } else { auto };
            self.water.set_controls(boat.body, Controls { throttle, steering, ..Controls::default() })?;
        }
        self.water.tick(tick, &mut self.states)?;
        let with = self.boats.iter().filter(|boat| matches!(self.wake(boat), Wake::Grid { .. })).count();
        self.most = [self.most[0].max(with), self.most[1].max(self.water.grid_count())];
        Ok(())
    }

    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        let room = self.boats.len();
        self.mesh = Some(meshes.add(device, &boat_mesh(&self.hull, self.waterline, self.fittings), room));
    }

    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView) {
        let at = |pose: Pose| Instance {
            world_from_mesh: Affine3A::from_rotation_translation(pose.orientation, pose.position),
            tint: Vec3::ONE,
        };
        let boats: Vec<Instance> = self.boats.iter().filter_map(|boat| self.pose(boat)).map(at).collect();
        if let Some(mesh) = self.mesh {
            meshes.place(queue, mesh, &boats);
        }
    }

    fn viewpoint(&self, index: usize) -> Option<Viewpoint> {
        let views = [
            (Vec3::new(-60.0, 45.0, -150.0), Vec3::new(20.0, 0.0, 60.0)),
            (Vec3::new(118.0, 3.0, -30.0), Vec3::new(90.0, 0.0, 60.0)),
        ];
        views.get(index).map(|&(eye, target)| Viewpoint { eye, target })
    }

    fn map(&self) -> (Vec2, f32) {
        (Vec2::new(20.0, 120.0), 560.0)
    }

    fn subject(&self) -> Subject {
        let boat = &self.boats[0];
        let state = self.states.get(boat.body).copied().unwrap_or(BodyState::at_rest(Vec3::ZERO));
        let start = Pose { position: state.position, orientation: state.orientation };
        boat.subject(self.pose(boat).unwrap_or(start))
    }

    fn look_down(&mut self) {
        for i in 0..self.boats.len() {
            self.boats[i].wake = match self.wake(&self.boats[i]) {
                Wake::Grid { grid, .. } => Some(grid),
                _ => None,
            };
            self.boats[i].look_down(&self.water);
        }
    }

    fn foam(&self, at: Vec2) -> f32 {
        self.boats.iter().map(|boat| boat.foam(&self.water, at)).fold(0.0, f32::max)
    }

    fn marks(&self) -> Vec<Mark> {
        self.boats.iter().filter_map(|boat| Some(boat.mark(self.pose(boat)?))).collect()
    }

    fn strokes(&self) -> Vec<Stroke> {
        self.boats.iter().flat_map(|boat| boat.strokes(&self.water)).collect()
    }

    fn status(&self) -> String {
        let mut text = format!("t {:.1} s, {} grids", self.water.time(), self.water.grid_count());
        for (away, i) in self.by_distance() {
            let _ = write!(text, "\nboat {} at {away:.0} m: {}", i + 1, self.wake(&self.boats[i]));
        }
        text
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        let [boats, grids] = self.most;
        vec![
            ("wakes", format!("{boats} of {} boats at most, {grids} grids", self.boats.len())),
            ("boats", self.status()),
        ]
    }
}
