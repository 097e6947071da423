//! Five seas to look at and to ride: a light breeze, a wind sea, a gale, a swell, shallow water. One may turn into
//! another while it runs.

use std::f32::consts::TAU;
use std::process::ExitCode;

use clap::ValueEnum;
use glam::{Affine3A, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Hull, OceanDesc, OpenWater, OpenWaterDesc, SeaState, Tick, WaterSample,
};
use open_water_examples::{
    Dice, Flotsam, Helm, Launch, Mark, Options, Scene, SceneError, Setup, Subject, Viewpoint, boat_mesh, dry_room, run,
    run_up,
};
use water_view::{Instance, MeshId, MeshView};

/// Crates and barrels around the boat, for scale, and how far from it they lie, metres.
const FLOTSAM: u32 = 24;
const RING: [f32; 2] = [10.0, 60.0];
/// Seconds run before the first picture.
const LEAD: f32 = 4.0;

/// The seas that are shipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum State {
    /// A light breeze over a bay.
    Breeze,
    /// A wind sea of 10 m/s over 100 km.
    WindSea,
    /// A gale on the open sea.
    Gale,
    /// The swell of a distant storm under a light wind.
    Swell,
    /// A wind sea over 6 m of water.
    Shallows,
}

impl State {
    const ALL: [Self; 5] = [Self::Breeze, Self::WindSea, Self::Gale, Self::Swell, Self::Shallows];

    fn read(self) -> Result<SeaState, SceneError> {
        let (name, text) = match self {
            Self::Breeze => ("breeze.txt", include_str!("assets/seas/breeze.txt")),
            Self::WindSea => ("fresh-breeze.txt", include_str!("assets/seas/fresh-breeze.txt")),
            Self::Gale => ("gale.txt", include_str!("assets/seas/gale.txt")),
            Self::Swell => ("swell.txt", include_str!("assets/seas/swell.txt")),
            Self::Shallows => ("shallows.txt", include_str!("assets/seas/shallows.txt")),
        };
        SeaState::parse(name, text).map_err(SceneError::usage)
    }
}

/// Options of this scene. Keys 1 to 5 change to the sea of that number.
#[derive(Debug, Clone, clap::Args)]
struct More {
    /// The sea at first, unless --sea names a file
    #[arg(long, value_enum, default_value = "wind-sea")]
    state: State,
    /// The sea into which it changes from the first picture on
    #[arg(long, value_enum, value_name = "STATE")]
    then: Option<State>,
    /// Seconds that a change takes, 1 to 600
    #[arg(long, value_name = "S", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=600))]
    over: u32,
}

struct Seas {
    water: OpenWater,
    states: BodyStates,
    boat: Launch,
    hull: Hull,
    waterline: f32,
    fittings: bool,
    flotsam: Flotsam,
    mesh: Option<MeshId>,
    over: f32,
    /// Highest and lowest that the boat has been, metres.
    heave: [f32; 2],
}

fn main() -> ExitCode {
    run::<Seas>()
}

impl Seas {
    fn state(&self) -> BodyState {
        self.states.get(self.boat.body).copied().unwrap_or(BodyState::at_rest(Vec3::ZERO))
    }
}

impl Scene for Seas {
    const NAME: &'static str = "seas";
    const ABOUT: &'static str = "Five seas, from a breeze to a gale, with a boat adrift; keys 1 to 5 change the sea.";
    const VIEWPOINTS: usize = 2;
    type More = More;
    type Assets = More;

    fn assets(more: &More) -> Result<More, SceneError> {
        Ok(more.clone())
    }

    fn describe(options: &Options, more: &More, water: &mut OpenWaterDesc) -> Result<(), SceneError> {
        if options.sea.is_none() {
            water.sea = more.state.read()?;
        }
        // Tiles stay as they are when the sea changes: they have to hold the longest waves of all.
        let longest =
            if more.then.is_some() || options.wants_window() { State::Swell.read()? } else { water.sea.clone() };
        let size = water.cascades.iter().map(|cascade| cascade.size).max().unwrap_or(256);
        water.cascades = OceanDesc::for_sea(longest, size).cascades;
        Ok(())
    }

    fn new(options: &Options, setup: &Setup<More>, mut water: OpenWater) -> Result<Self, SceneError> {
        let hull = setup.hull.clone();
        let desc = BodyDesc::boat(&hull, 0.24 * hull.volume() * 1025.0, 10.0);
        let waterline = hull.waterline(desc.displaced_volume()).level;
        let boat = water.add_body(options.preset().body(desc))?;
        water.set_dry(boat, Some(dry_room(&hull)?))?;
        let mut states = BodyStates::default();
        states.insert(boat, BodyState::at_rest(Vec3::new(0.0, 0.3, 0.0)));
        let mut flotsam = Flotsam::default();
        let mut dice = Dice(options.seed);
        for _ in 0..FLOTSAM {
            let radius = RING[0] + (RING[1] - RING[0]) * dice.roll();
            let (sin, cos) = (TAU * dice.roll()).sin_cos();
            let (piece, state) = flotsam.throw(&mut water, &mut dice, radius * Vec2::new(cos, sin))?;
            states.insert(piece.body, state);
        }
        let mut scene = Self {
            water,
            states,
            boat: Launch::new(boat, None, hull.bounds()),
            hull,
            waterline,
            fittings: setup.own_hull,
            flotsam,
            mesh: None,
            over: setup.assets.over as f32,
            heave: [f32::INFINITY, f32::NEG_INFINITY],
        };
        run_up(&mut scene, options, LEAD)?;
        if let Some(then) = setup.assets.then {
            scene.water.change_sea(then.read()?, scene.over)?;
        }
        Ok(scene)
    }

    fn water(&self) -> &OpenWater {
        &self.water
    }

    fn water_mut(&mut self) -> &mut OpenWater {
        &mut self.water
    }

    fn choose(&mut self, number: u32) -> Result<(), SceneError> {
        match State::ALL.get(number.wrapping_sub(1) as usize) {
            Some(sea) => Ok(self.water.change_sea(sea.read()?, self.over)?),
            None => Ok(()),
        }
    }

    fn tick(&mut self, tick: Tick, _: Helm) -> Result<(), SceneError> {
        self.water.tick(tick, &mut self.states)?;
        let height = self.state().position.y;
        self.heave = [self.heave[0].min(height), self.heave[1].max(height)];
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

    /// From another boat's deck, which rides the waves, and from a mast.
    fn viewpoint(&self, index: usize) -> Option<Viewpoint> {
        let boat = self.subject().position.with_y(0.0);
        let away = [Vec3::new(-26.0, 2.6, 12.0), Vec3::new(-120.0, 45.0, 60.0)].get(index).copied()?;
        let mut eye = boat + away;
        let mut below = [WaterSample::default()];
        self.water.sample(&[Vec2::new(eye.x, eye.z)], &mut below);
        eye.y += below[0].height;
        Some(Viewpoint { eye, target: boat + Vec3::Y * (0.5 * below[0].height) })
    }

    fn subject(&self) -> Subject {
        let state = self.state();
        let start = open_water::Pose { position: state.position, orientation: state.orientation };
        self.boat.subject(self.water.drawn_pose(self.boat.body).unwrap_or(start))
    }

    fn look_down(&mut self) {}

    fn foam(&self, _: Vec2) -> f32 {
        0.0
    }

    fn marks(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        self.flotsam.marks(|body| self.water.drawn_pose(body), &mut marks);
        marks.extend(self.water.drawn_pose(self.boat.body).map(|pose| self.boat.mark(pose)));
        marks
    }

    fn status(&self) -> String {
        let sea = self.water.ocean().map_or(0.0, |ocean| ocean.significant_height());
        format!("Hs {sea:.2} m, t {:.1} s; keys 1 to 5: another sea", self.water.time())
    }

    fn summary(&self) -> Vec<(&'static str, String)> {
        let [low, high] = self.heave;
        vec![
            ("boat", format!("{low:.2} to {high:.2} m above still water")),
            ("flotsam", self.flotsam.summary(|body| Some(self.states.get(body)?.position))),
        ]
    }
}
