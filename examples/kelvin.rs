//! A boat runs straight ahead over calm water, seen from above, with Kelvin's 19.47 degrees drawn over its wake. 1, 2 and 3 choose how
//! its waves are carried: all at one speed, dispersive by local fields, or exact by Fourier transforms. The overlay tells the
//! wake's measured half-angle and what a tick costs.

use std::process::ExitCode;
use std::time::Instant;

use glam::{Affine3A, DVec2, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Border, Controls, Follow, GridDesc, Hull, OpenWater, Pose, Scheme, Tick,
};
use open_water_examples::wedge::{self, Room};
use open_water_examples::{
    Course, Helm, Launch, Mark, Options, Scene, SceneError, Setup, Subject, Viewpoint, boat_mesh, crate_box, dry_room,
    run, run_up,
};
use water_view::{Instance, MeshId, MeshView};

/// The boat's speed that the autopilot keeps, and its full speed, m/s.
const SPEED: f32 = 5.0;
const FULL: f32 = 9.0;
/// Speed of all waves where they have one, m/s: the boat outruns them.
const ONE_SPEED: f32 = 3.0;
/// Half-angle of the lines, degrees: the arcsine of a third.
const KELVIN: f32 = 19.471_22;
/// Cells of the wake's grid and their size, metres.
const CELLS: [u32; 2] = [640, 320];
const CELL: f32 = 0.25;
/// Length and width of the lines, metres.
const LINE: [f32; 2] = [76.0, 0.16];
/// Seconds run before the first picture: the wake grows to the end of its grid.
const LEAD: f32 = 30.0;
/// Ticks between measurements of the angle.
const MEASURED: u64 = 60;

/// How waves are carried, by the number that chooses it, and the cells of the border.
const CHOICES: [(&str, Scheme, u32); 3] = [
    ("wave equation", Scheme::NinePoint, 16),
    ("dispersive", Scheme::Dispersive, 16),
    ("spectral", Scheme::Spectral, 48),
];

/// Options of this scene.
#[derive(Debug, Clone, clap::Args)]
struct More {
    /// How waves are carried: 1 wave equation, 2 dispersive, 3 spectral
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=3))]
    scheme: u32,
}

struct Kelvin {
    water: OpenWater,
    states: BodyStates,
    boat: Launch,
    course: Course,
    throttle: f32,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    meshes: Option<[MeshId; 2]>,
    chosen: usize,
    ticks: u64,
    /// When the grid was made, of `ticks`.
    since: u64,
    /// Milliseconds of a tick, smoothed.
    cost: f32,
    /// Measured half-angle, degrees.
    angle: Option<f32>,
}

fn main() -> ExitCode {
    run::<Kelvin>()
}

impl Kelvin {
    fn state(&self) -> BodyState {
        self.states.get(self.boat.body).copied().unwrap_or(BodyState::at_rest(Vec3::ZERO))
    }

    fn pose(&self) -> Pose {
        let state = self.state();
        let start = Pose { position: state.position, orientation: state.orientation };
        self.water.drawn_pose(self.boat.body).unwrap_or(start)
    }

    /// Gives the boat a grid of the chosen scheme; the waves of the one before fade.
    fn new_grid(&mut self) -> Result<(), SceneError> {
        let (_, scheme, width) = CHOICES[self.chosen];
        if let Some(before) = self.boat.wake.take() {
            self.water.remove_grid(before)?;
        }
        let grid = self.water.add_grid(GridDesc {
            follow: Follow::Body(self.boat.body),
            cells: CELLS,
            cell_size: [CELL; 2],
            wave_speed: ONE_SPEED,
            scheme,
            border: Border::Absorbing { width },
            ..GridDesc::default()
        })?;
        self.boat.wake = Some(grid);
        self.angle = None;
        self.since = self.ticks;
        Ok(())
    }

    /// The wake's half-angle from the heights of its grid, once the wake is as long as what is measured.
    fn measure(&self) -> Option<f32> {
        let grid = self.water.grid(self.boat.wake?).ok()??;
        let (window, state) = (grid.window(), self.state());
        let boat = state.position.as_dvec3();
        // Without what the border takes.
        let rim = f64::from(CHOICES[self.chosen].2 + 4) * f64::from(CELL);
        let scheme = CHOICES[self.chosen].1;
        let behind = boat.x - window.world_corner().x - rim;
        let room = Room {
            step: 2.0 * f64::from(CELL),
            behind: if scheme.is_wave_equation() { behind.min(40.0) } else { behind },
            aside: 0.5 * f64::from(CELLS[1]) * f64::from(CELL) - rim - 1.0,
        };
        let run = (self.ticks - self.since) as f32 * self.water.desc().tick * SPEED;
        if f64::from(run) < room.behind {
            return None;
        }
        let height = |behind: f64, aside: f64| {
            let at = (DVec2::new(boat.x - behind, boat.z + aside) - window.world_corner()) / f64::from(CELL);
            let (i, j) = (at.x.max(0.0) as usize, at.y.max(0.0) as usize);
            grid.heights().get(j * CELLS[0] as usize + i).map_or(0.0, |z| f64::from(*z))
        };
        let wedge = match scheme {
            Scheme::Dispersive | Scheme::Spectral => wedge::kelvin(state.velocity.x.max(1.0).into(), room, height),
            _ => wedge::mach(room, height),
        };
        wedge.map(|wedge| wedge.degrees as f32)
    }

    /// Where the lines run: each from the boat's middle, its heading about y.
    fn lines(&self) -> [(Vec3, f32); 2] {
        let at = self.pose().position.with_y(0.3);
        [1.0, -1.0].map(|side| {
            let angle = side * KELVIN.to_radians();
            (at + 0.5 * LINE[0] * Vec3::new(-angle.cos(), 0.0, angle.sin()), angle)
        })
    }

    fn told(&self) -> String {
        let (name, scheme, _) = CHOICES[self.chosen];
        let wanted = match scheme {
            Scheme::Dispersive | Scheme::Spectral => KELVIN,
            _ => (ONE_SPEED / SPEED).asin().to_degrees(),
        };
        let angle = self.angle.map_or("-".to_owned(), |angle| format!("{angle:.1}"));
        format!("{name}: wake {angle} deg (theory {wanted:.1}), {:.2} ms a tick", self.cost)
    }
}

impl Scene for Kelvin {
    const NAME: &'static str = "kelvin";
    const ABOUT: &'static str = "A boat runs straight ahead, seen from above, with Kelvin's 19.47 degrees over its wake; \
         1 wave equation, 2 dispersive, 3 spectral.";
    const SEA: &'static str = include_str!("assets/seas/calm.txt");
    const VIEWPOINTS: usize = 1;
    const VIEW: u32 = 3;
    const LABELLED: bool = true;
    type More = More;
    type Assets = usize;

    fn assets(more: &More) -> Result<usize, SceneError> {
        Ok(more.scheme as usize - 1)
    }

    fn new(options: &Options, setup: &Setup<usize>, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
        let desc = options.preset().body(BodyDesc::boat(&hull, 0.24 * hull.volume() * 1025.0, FULL));
        let waterline = hull.waterline(desc.displaced_volume()).level;
        let body = water.add_body(desc)?;
        water.set_dry(body, Some(dry_room(&hull)?))?;
        let mut states = BodyStates::default();
        let start = BodyState { velocity: Vec3::X * SPEED, ..BodyState::at_rest(Vec3::new(0.0, 0.2, 0.0)) };
        states.insert(body, start);
        let mut scene = Self {
            water,
            states,
            boat: Launch::new(body, None, hull.bounds()),
            course: Course::new(vec![(Vec2::new(-50.0, 0.0), 0.5), (Vec2::new(1e6, 0.0), 0.5)], Vec2::ZERO),
            throttle: 0.5,
            hull,
            waterline,
            fittings: setup.own_hull,
            meshes: None,
            chosen: setup.assets,
            ticks: 0,
            since: 0,
            cost: 0.0,
            angle: None,
        };
        scene.new_grid()?;
        run_up(&mut scene, options, LEAD)?;
        Ok(scene)
    }

    fn water(&self) -> &OpenWater {
        &self.water
    }

    fn water_mut(&mut self) -> &mut OpenWater {
        &mut self.water
    }

    fn choose(&mut self, number: u32) -> Result<(), SceneError> {
        let wanted = number as usize - 1;
        if wanted < CHOICES.len() && wanted != self.chosen {
            self.chosen = wanted;
            self.new_grid()?;
        }
        Ok(())
    }

    fn tick(&mut self, tick: Tick, _: Helm) -> Result<(), SceneError> {
        let now = self.state();
        let [_, steering] = self.course.steer(now.position, now.orientation * Vec3::X);
        let short = SPEED - now.velocity.x;
        self.throttle = (self.throttle + 0.1 * short * self.water.desc().tick).clamp(0.0, 1.0);
        let throttle = (self.throttle + 0.3 * short).clamp(0.0, 1.0);
        self.water.set_controls(self.boat.body, Controls { throttle, steering, ..Controls::default() })?;
        let began = Instant::now();
        self.water.tick(tick, &mut self.states)?;
        let took = 1e3 * began.elapsed().as_secs_f32();
        self.cost += if self.ticks == 0 { took } else { 0.05 * (took - self.cost) };
        self.ticks += 1;
        if self.ticks.is_multiple_of(MEASURED) {
            self.angle = self.measure();
        }
        Ok(())
    }

    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView) {
        let boat = meshes.add(device, &boat_mesh(&self.hull, self.waterline, self.fittings), 1);
        let line = meshes.add(device, &crate_box(Vec3::new(LINE[0], 0.05, LINE[1])), 2);
        self.meshes = Some([boat, line]);
    }

    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView) {
        let Some([boat, line]) = self.meshes else { return };
        let at = |position: Vec3, orientation: Quat, tint: Vec3| Instance {
            world_from_mesh: Affine3A::from_rotation_translation(orientation, position),
            tint,
        };
        let pose = self.pose();
        meshes.place(queue, boat, &[at(pose.position, pose.orientation, Vec3::ONE)]);
        let lines =
            self.lines().map(|(middle, angle)| at(middle, Quat::from_rotation_y(angle), Vec3::new(1.0, 0.5, 0.1)));
        meshes.place(queue, line, &lines);
    }

    fn viewpoint(&self, index: usize) -> Option<Viewpoint> {
        let middle = self.pose().position.with_y(0.0) - Vec3::X * 30.0;
        (index == 0).then_some(Viewpoint { eye: middle + Vec3::new(-0.5, 80.0, 0.0), target: middle })
    }

    fn map(&self) -> (Vec2, f32) {
        let at = self.pose().position;
        (Vec2::new(at.x - 30.0, at.z), 92.0)
    }

    fn subject(&self) -> Subject {
        self.boat.subject(self.pose())
    }

    fn look_down(&mut self) {
        self.boat.look_down(&self.water);
    }

    fn foam(&self, at: Vec2) -> f32 {
        self.boat.foam(&self.water, at)
    }

    fn marks(&self) -> Vec<Mark> {
        let half = [0.5 * LINE[0], 0.5 * LINE[1]];
        let corners = [(-half[0], -half[1]), (half[0], -half[1]), (half[0], half[1]), (-half[0], half[1])];
        let mut marks: Vec<Mark> = self
            .lines()
            .map(|(position, angle)| {
                let pose = Pose { position, orientation: Quat::from_rotation_y(angle) };
                Mark::of(pose, &corners, [250, 150, 40])
            })
            .into();
        marks.push(self.boat.mark(self.pose()));
        marks
    }

    fn status(&self) -> String {
        format!("{}\nboat {:.2} m/s, t {:.1} s\n1 2 3: scheme", self.told(), self.state().velocity.x, self.water.time())
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        vec![("wake", self.told()), ("boat", format!("{:.2} m/s", self.state().velocity.x))]
    }
}
