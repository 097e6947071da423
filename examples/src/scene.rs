//! What a scene tells the framework.

use glam::{Quat, Vec2, Vec3};
use open_water::{OpenWater, OpenWaterDesc, Pose, Tick};
use water_view::{Camera, MeshView, WaterLook};

use crate::SceneError;
use crate::options::{Options, Setup};
use crate::strokes::Stroke;

/// What the player asks for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Helm {
    /// `None`: the scene steers by itself.
    pub manual: Option<[f32; 2]>,
}

/// What cameras look at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Subject {
    /// Drawn position, local metres.
    pub position: Vec3,
    /// Drawn attitude; x is forward.
    pub orientation: Quat,
    /// Length, metres.
    pub length: f32,
}

/// A flat shape on the top view: a convex outline (x, z) and its colour.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Corners in order, local metres.
    pub outline: Vec<Vec2>,
    /// sRGB.
    pub color: [u8; 3],
}

impl Mark {
    /// A shape given by `corners` (x, z) in the frame of a body that stands at `pose`.
    pub fn of(pose: Pose, corners: &[(f32, f32)], color: [u8; 3]) -> Self {
        let world = |&(x, z): &(f32, f32)| {
            let p = pose.position + pose.orientation * Vec3::new(x, 0.0, z);
            Vec2::new(p.x, p.z)
        };
        Self { outline: corners.iter().map(world).collect(), color }
    }
}

/// A camera that stands somewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// Where it stands, local metres.
    pub eye: Vec3,
    /// What it looks at.
    pub target: Vec3,
}

/// No options beside those of every scene.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct NoMore {}

/// A runnable scene.
pub trait Scene: Sized + 'static {
    /// Its name, for the window and the summary.
    const NAME: &'static str;

    /// What it shows, one sentence for the help.
    const ABOUT: &'static str;

    /// Its sea when the command line names none: a text as `SeaState::parse` reads it.
    const SEA: &'static str = include_str!("../assets/seas/moderate.txt");

    /// How many cameras stand at viewpoints of its own.
    const VIEWPOINTS: usize = 0;

    /// Its camera when the command line names none.
    const VIEW: u32 = 1;

    /// Whether pictures written without a window carry its lines of the overlay.
    const LABELLED: bool = false;

    /// Options of its own.
    type More: clap::Args + 'static;

    /// What the files named by them hold.
    type Assets: 'static;

    /// Reads its files.
    ///
    /// # Errors
    /// A file is bad.
    fn assets(more: &Self::More) -> Result<Self::Assets, SceneError>;

    /// Changes the description of the water before it is made; its sea is that of the command line, else [`Self::SEA`].
    ///
    /// # Errors
    /// Something of the description is bad.
    fn describe(_options: &Options, _assets: &Self::Assets, _water: &mut OpenWaterDesc) -> Result<(), SceneError> {
        Ok(())
    }

    /// Builds the scene around a water that has no bodies yet.
    ///
    /// # Errors
    /// Something in `setup` does not fit.
    fn new(options: &Options, setup: &Setup<Self::Assets>, water: OpenWater) -> Result<Self, SceneError>;

    /// The water.
    fn water(&self) -> &OpenWater;

    /// The water.
    fn water_mut(&mut self) -> &mut OpenWater;

    /// A digit was typed.
    ///
    /// # Errors
    /// What it asks for cannot be done.
    fn choose(&mut self, _number: u32) -> Result<(), SceneError> {
        Ok(())
    }

    /// A picture is about to be drawn through this camera: the place to tell the water where the game looks.
    fn seen(&mut self, _camera: &Camera) {}

    /// Runs one tick.
    ///
    /// # Errors
    /// The simulation went wrong.
    fn tick(&mut self, tick: Tick, helm: Helm) -> Result<(), SceneError>;

    /// Uploads the meshes, once.
    fn build(&mut self, device: &wgpu::Device, meshes: &mut MeshView);

    /// Says where they stand at the drawn moment.
    fn place(&mut self, queue: &wgpu::Queue, meshes: &mut MeshView);

    /// Colour of the water.
    fn look(&self) -> WaterLook {
        WaterLook::default()
    }

    /// One of the scene's own cameras, fewer than `VIEWPOINTS`.
    fn viewpoint(&self, _index: usize) -> Option<Viewpoint> {
        None
    }

    /// Elevation of the ground at a place, metres, where there is land; for the view from above.
    fn ground(&self, _at: Vec2) -> Option<f32> {
        None
    }

    /// Centre and width of the view from above, metres: the subject's surroundings.
    fn map(&self) -> (Vec2, f32) {
        let at = self.subject().position;
        (Vec2::new(at.x, at.z), 120.0)
    }

    /// What the camera follows.
    fn subject(&self) -> Subject;

    /// Gets ready for a view from above of the drawn moment.
    fn look_down(&mut self);

    /// The bodies as flat shapes, for the view from above.
    fn marks(&self) -> Vec<Mark>;

    /// Foam of the wake at a place, 0 to 1, for the view from above.
    fn foam(&self, at: Vec2) -> f32;

    /// The forces on its boat, for when they are asked for.
    fn strokes(&self) -> Vec<Stroke> {
        Vec::new()
    }

    /// Lines for the overlay.
    fn status(&self) -> String;

    /// Lines for the summary: name and value.
    fn summary(&self) -> Vec<(&'static str, String)>;
}

/// Runs the scene for the seconds before its first picture: as asked, else `lead`.
///
/// # Errors
/// The simulation went wrong.
pub fn run_up<S: Scene>(scene: &mut S, options: &Options, lead: f32) -> Result<(), SceneError> {
    let dt = scene.water().desc().tick;
    for _ in 0..(options.lead.unwrap_or(lead) / dt) as u32 {
        advance(scene, dt, Helm::default())?;
    }
    Ok(())
}

/// Runs the ticks that are due after `dt` seconds and returns how many.
pub(crate) fn advance<S: Scene>(scene: &mut S, dt: f32, helm: Helm) -> Result<u32, SceneError> {
    let mut count = 0;
    for tick in scene.water_mut().advance(dt) {
        scene.tick(tick, helm)?;
        count += 1;
    }
    Ok(count)
}
