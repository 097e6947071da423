//! A harbour in waves: breakwaters, a quay, a beach and a jetty; two boats under way, one moored; crates and flotsam that
//! Rapier moves and the water carries.

use std::path::PathBuf;
use std::process::ExitCode;

use glam::{Affine3A, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, Controls, DepthMap, Follow, GridDesc, GridId, Hull, Mooring, MooringId, MooringLine,
    OpenWater, Pose, Tick,
};
use open_water_examples::harbour::{self, World};
use open_water_examples::{
    Course, Dice, Flotsam, Helm, Launch, Mark, Options, Scene, SceneError, Setup, Subject, Viewpoint, boat_mesh,
    dry_room, run, run_up,
};
use water_view::{Instance, MeshData, MeshId, MeshView, WaterLook};

/// Full speed, m/s.
const SPEED: f32 = 12.0;
/// Seconds run before the first picture: waves enter the basin, flotsam settles.
const LEAD: f32 = 10.0;

/// Options of the harbour.
#[derive(Debug, Clone, clap::Args)]
struct More {
    /// Depth map: a 16-bit greyscale PNG, 1 cm per level, the sea at level 32768, 2 m per pixel, the harbour's middle in
    /// its middle, the sea to the left [default: the harbour's own]
    #[arg(long, value_name = "FILE")]
    depth: Option<PathBuf>,
}

struct Harbour {
    water: OpenWater,
    world: World,
    bed: DepthMap,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    /// Two under way, then the moored one.
    boats: [Launch; 3],
    courses: [Course; 2],
    moorings: Vec<(MooringId, MooringLine)>,
    basin: GridId,
    flotsam: Flotsam,
    /// Land and works; boat; line; fender.
    meshes: Vec<MeshId>,
    way: f32,
    /// Where the moored boat lay first, and how far it strayed, metres.
    home: Option<Vec3>,
    strayed: f32,
}

fn main() -> ExitCode {
    run::<Harbour>()
}

impl Harbour {
    fn start(place: Vec2, towards: Vec2, speed: f32) -> BodyState {
        let ahead = (towards - place).normalize_or(Vec2::X);
        BodyState {
            orientation: Quat::from_rotation_y(-ahead.to_angle()),
            velocity: speed * Vec3::new(ahead.x, 0.0, ahead.y),
            ..BodyState::at_rest(Vec3::new(place.x, 0.4, place.y))
        }
    }

    /// Makes the third boat fast to the quay: bow and stern lines and two springs.
    fn moor(&mut self, mass: f32) -> Result<(), SceneError> {
        let (low, high) = self.boats[2].bounds;
        let deck = self.waterline + 0.6 * (high.y - self.waterline);
        for (point, anchor) in harbour::lines((low, high), deck) {
            let start = Vec3::new(harbour::BERTH.x, -self.waterline, self.berth().y);
            let length = 0.995 * (start + point).distance(anchor);
            let line = MooringLine::rope(point, anchor, length, mass);
            let id = self.water.add_mooring(Mooring { body: self.boats[2].body, line })?;
            self.moorings.push((id, line));
        }
        Ok(())
    }

    /// Where the moored boat lies: a hand off its fenders.
    fn berth(&self) -> Vec2 {
        Vec2::new(harbour::BERTH.x, harbour::QUAY_HIGH.y + harbour::FENDER_FACE + 0.15 - self.boats[2].bounds.0.z)
    }

    fn scatter(&mut self, seed: u64) -> Result<(), SceneError> {
        let mut dice = Dice(seed);
        for place in harbour::afloat(&mut dice, self.berth(), |p| self.bed.elevation(p.as_dvec2())) {
            let (piece, state) = self.flotsam.throw(&mut self.water, &mut dice, place)?;
            self.world.spawn(&self.water, piece.body, state).map_err(harbour::refused)?;
        }
        for (kind, start) in harbour::stack() {
            let orientation = Quat::from_rotation_y(0.5 * (dice.roll() - 0.5));
            let piece = self.flotsam.add(&mut self.water, kind, Vec3::splat(0.8 + 0.4 * dice.roll()), start)?;
            let state = BodyState { orientation, ..BodyState::at_rest(start) };
            self.world.spawn(&self.water, piece.body, state).map_err(harbour::refused)?;
        }
        Ok(())
    }

    fn pose(&self, body: BodyId) -> Option<Pose> {
        self.world.pose(&self.water, body)
    }

    /// Where a mooring is made fast on board, at the drawn moment.
    fn fast(&self, line: &MooringLine) -> Option<Vec3> {
        let pose = self.pose(self.boats[2].body)?;
        Some(pose.position + pose.orientation * line.point)
    }
}

impl Scene for Harbour {
    const NAME: &'static str = "harbour";
    const ABOUT: &'static str =
        "A harbour in waves: two boats under way, one moored, a beach, breakwaters, and flotsam that bumps into them.";
    const SEA: &'static str = include_str!("assets/seas/harbour.txt");
    const VIEWPOINTS: usize = 3;
    type More = More;
    type Assets = DepthMap;

    fn assets(more: &More) -> Result<DepthMap, SceneError> {
        harbour::depth_map(more.depth.as_deref())
    }

    fn new(options: &Options, setup: &Setup<DepthMap>, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
        let mass = 0.24 * hull.volume() * 1025.0;
        let mut desc = options.preset().body(BodyDesc::boat(&hull, mass, SPEED));
        // A harbour is narrow: a larger rudder than on the open sea.
        if let Some(engine) = &mut desc.engine {
            engine.max_angle = 0.9;
            engine.rudder_area *= 2.5;
        }
        let waterline = hull.waterline(desc.displaced_volume()).level;
        let bed = setup.assets.clone();
        water.set_land(Some(harbour::land(bed.clone())))?;
        let world = World::new(water.desc().tick, harbour::extent(&bed), |p| bed.elevation(p.as_dvec2()));
        let period = water.ocean().map_or(6.0, |ocean| ocean.peak_period());
        let basin = water.add_grid(harbour::basin(options.preset(), period))?;
        let places = [Vec2::new(-150.0, 42.0), Vec2::new(16.0, -10.0)];
        let courses = [Course::new(harbour::ferry(), places[0]), Course::new(harbour::round(), places[1])];
        let room = dry_room(&hull)?;
        let mut boats = Vec::new();
        for wake in [true, true, false] {
            let body = water.add_body(desc.clone())?;
            water.set_dry(body, Some(room.clone()))?;
            // Smaller cells than the preset's, as there is little room; of the paper's one speed of all waves less, as the boats go at it.
            let preset = options.preset().grid();
            let grid = GridDesc {
                follow: Follow::Body(body),
                cell_size: preset.cell_size.map(|h| 0.8 * h),
                wave_speed: 0.8 * preset.wave_speed,
                ..preset
            };
            let grid = wake.then(|| water.add_grid(grid)).transpose()?;
            boats.push(Launch::new(body, grid, hull.bounds()));
        }
        let Ok(boats) = boats.try_into() else { return Err(SceneError::Usage("three boats".into())) };
        let mut scene = Self {
            water,
            world,
            bed,
            hull,
            waterline,
            fittings: setup.own_hull,
            boats,
            courses,
            moorings: Vec::new(),
            basin,
            flotsam: Flotsam::default(),
            meshes: Vec::new(),
            way: 0.0,
            home: None,
            strayed: 0.0,
        };
        // The berth is the hull's, the state the centre of mass's.
        let center = scene.water.body(scene.boats[2].body)?.desc().center_of_mass;
        let moored = scene.berth() + Vec2::new(center.x, center.z);
        let starts = [
            Self::start(places[0], Vec2::new(-97.0, 30.0), 7.0),
            Self::start(places[1], Vec2::new(18.0, -60.0), 7.0),
            Self::start(moored, moored + Vec2::X, 0.0),
        ];
        for (boat, state) in scene.boats.iter().zip(starts) {
            scene.world.spawn(&scene.water, boat.body, state).map_err(harbour::refused)?;
        }
        scene.moor(mass)?;
        scene.scatter(options.seed)?;
        run_up(&mut scene, options, LEAD)?;
        scene.way = 0.0;
        Ok(scene)
    }

    fn water(&self) -> &OpenWater {
        &self.water
    }

    fn water_mut(&mut self) -> &mut OpenWater {
        &mut self.water
    }

    fn tick(&mut self, tick: Tick, helm: Helm) -> Result<(), SceneError> {
        for (i, (boat, course)) in self.boats.iter().zip(&mut self.courses).enumerate() {
            let Some((pose, velocity)) = self.world.motion(boat.body) else { continue };
            let auto = course.steer(pose.position, pose.orientation * Vec3::X);
            let [throttle, steering] = if i == 0 { helm.manual.unwrap_or(auto) } else { auto };
            self.water.set_controls(boat.body, Controls { throttle, steering, ..Controls::default() })?;
            if i == 0 {
                self.way += velocity.with_y(0.0).length() * tick.dt;
            }
        }
        self.world.tick(&mut self.water, tick)?;
        if let Some((pose, _)) = self.world.motion(self.boats[2].body) {
            let home = *self.home.get_or_insert(pose.position);
            self.strayed = self.strayed.max((pose.position - home).with_y(0.0).length());
        }
        Ok(())
    }

    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        let bed = self.bed.clone();
        let (extent, height) = (harbour::extent(&bed), |p: Vec2| bed.elevation(p.as_dvec2()));
        let mut line = MeshData::default();
        line.cylinder(Vec3::ZERO, Vec3::X, 1.0, 6, [206, 196, 160, 10]);
        let half = self.world.fenders().1;
        let mut fender = MeshData::default();
        fender.cylinder(Vec3::X * -half.x, Vec3::X * half.x, half.z, 14, [40, 40, 44, 60]);
        self.meshes = [
            (harbour::ground(extent, 0.0, height), 1),
            (harbour::green(extent, 0.0, height), 1),
            (harbour::breakwaters(), 1),
            (harbour::quay(), 1),
            (harbour::jetty(), 1),
            (boat_mesh(&self.hull, self.waterline, self.fittings), 3),
            (line, self.moorings.len()),
            (fender, 8),
        ]
        .map(|(data, room)| meshes.add(device, &data, room))
        .to_vec();
        self.flotsam.build(device, meshes);
    }

    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView) {
        let at = |world_from_mesh| Instance { world_from_mesh, tint: Vec3::ONE };
        let (world, water) = (&self.world, &self.water);
        let boats: Vec<Instance> = self
            .boats
            .iter()
            .filter_map(|boat| world.pose(water, boat.body))
            .map(|pose| at(Affine3A::from_rotation_translation(pose.orientation, pose.position)))
            .collect();
        let lines: Vec<Instance> = self
            .moorings
            .iter()
            .filter_map(|(_, line)| Some((self.fast(line)?, line.anchor)))
            .map(|(a, b)| {
                let turn = Quat::from_rotation_arc(Vec3::X, (b - a).normalize_or(Vec3::X));
                let thick = Vec3::new(a.distance(b), 0.022, 0.022);
                at(Affine3A::from_scale_rotation_translation(thick, turn, a))
            })
            .collect();
        let fenders: Vec<Instance> = world.fenders().0.into_iter().map(|p| at(Affine3A::from_translation(p))).collect();
        for (index, mesh) in self.meshes.iter().enumerate() {
            let instances: &[Instance] = match index {
                5 => &boats,
                6 => &lines,
                7 => &fenders,
                _ => &[at(Affine3A::IDENTITY)],
            };
            meshes.place(queue, *mesh, instances);
        }
        self.flotsam.place(|body| world.pose(water, body), queue, meshes);
    }

    fn look(&self) -> WaterLook {
        // Coastal water, greener and less clear than the open sea.
        WaterLook {
            scatter: Vec3::new(0.0085, 0.0340, 0.0345),
            absorption: Vec3::new(0.58, 0.26, 0.30),
            bed: Vec3::new(0.36, 0.31, 0.22),
            ..WaterLook::default()
        }
    }

    fn viewpoint(&self, index: usize) -> Option<Viewpoint> {
        let views = [
            (Vec3::new(182.0, 62.0, 96.0), Vec3::new(-30.0, 0.0, -14.0)),
            (Vec3::new(150.0, 4.6, -66.0), Vec3::new(112.0, 0.0, 20.0)),
            (Vec3::new(54.0, 5.2, -95.0), Vec3::new(32.0, 0.3, -112.0)),
        ];
        views.get(index).map(|&(eye, target)| Viewpoint { eye, target })
    }

    fn map(&self) -> (Vec2, f32) {
        (Vec2::new(-24.0, 4.0), 520.0)
    }

    fn ground(&self, at: Vec2) -> Option<f32> {
        Some(self.bed.elevation(at.as_dvec2()))
    }

    fn subject(&self) -> Subject {
        let rest = Pose { position: Vec3::ZERO, orientation: Quat::IDENTITY };
        self.boats[0].subject(self.pose(self.boats[0].body).unwrap_or(rest))
    }

    fn look_down(&mut self) {
        for boat in &mut self.boats {
            boat.look_down(&self.water);
        }
    }

    fn foam(&self, at: Vec2) -> f32 {
        self.boats.iter().map(|boat| boat.foam(&self.water, at)).fold(0.0, f32::max)
    }

    fn marks(&self) -> Vec<Mark> {
        let mut marks = harbour::marks();
        self.flotsam.marks(|body| self.pose(body), &mut marks);
        marks.extend(self.boats.iter().filter_map(|boat| Some(boat.mark(self.pose(boat.body)?))));
        marks
    }

    fn status(&self) -> String {
        let speed = self.world.motion(self.boats[0].body).map_or(0.0, |(_, v)| v.with_y(0.0).length());
        format!("boat {speed:.1} m/s, {} bodies, t {:.1} s", self.water.body_count(), self.water.time())
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        let tension =
            self.moorings.iter().filter_map(|(id, _)| self.water.mooring_tension(*id).ok()).fold(0.0, f32::max);
        let asleep = self.water.grid(self.basin).ok().flatten().is_none_or(|grid| grid.is_asleep());
        vec![
            ("boat", format!("{:.1} m of way made", self.way)),
            ("moored boat", format!("{:.2} m from its berth at most, tightest line {tension:.0} N", self.strayed)),
            ("basin", if asleep { "asleep".into() } else { "moving".to_string() }),
            ("flotsam", self.flotsam.summary(|body| Some(self.world.motion(body)?.0.position))),
        ]
    }
}
