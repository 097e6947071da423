//! What the scenes share: options, the device, a headless loop that writes PNGs, a window with an overlay, cameras.
//!
//! A scene implements [`Scene`] and calls [`run`]; it simulates and says what to draw, nothing else.

mod boat;
mod camera;
mod capture;
mod device;
mod dice;
mod draw;
mod error;
mod field;
mod flotsam;
mod font;
pub mod harbour;
mod headless;
mod launch;
mod options;
mod overlay;
mod props;
mod scene;
mod strokes;
mod timing;
mod topview;
mod window;

pub use boat::{boat_mesh, dry_room};
pub use capture::Capture;
pub use device::{Gpu, Pick};
pub use dice::Dice;
pub use error::SceneError;
pub use field::{Field, Plough};
pub use flotsam::{Flotsam, Kind};
pub use launch::{Course, Launch};
pub use options::{Backend, Options, Quality, Setup};
/// The wake's half-angle, as the evidence measures it.
#[path = "../../benches/src/truth/wedge.rs"]
pub mod wedge;

pub use props::{barrel, crate_box, hull_mesh};
pub use scene::{Helm, Mark, NoMore, Scene, Subject, Viewpoint, run_up};
pub use strokes::Stroke;

use std::process::ExitCode;

use options::KEYS;

use clap::{Args, CommandFactory, FromArgMatches, Parser};

/// The command line of a scene: what all share, and its own.
#[derive(Debug, Parser)]
struct Line<M: Args> {
    #[command(flatten)]
    options: Options,
    #[command(flatten)]
    more: M,
}

/// The command line of scene `S`.
fn command<S: Scene>() -> clap::Command {
    let about = S::ABOUT;
    Line::<S::More>::command().name(S::NAME).about(about).long_about(format!("{about}\n\n{KEYS}"))
}

/// The command line read; clap ends the process with its message when it is bad.
fn read<S: Scene>(matches: &clap::ArgMatches) -> Result<Line<S::More>, SceneError> {
    let line = Line::<S::More>::from_arg_matches(matches).map_err(SceneError::usage)?;
    let cameras = 2 + S::VIEWPOINTS;
    match line.options.view {
        Some(view) if view as usize > cameras => {
            Err(SceneError::Usage(format!("--view is {view}, this scene has cameras 1 to {cameras}")))
        }
        _ => Ok(line),
    }
}

/// Runs a scene as the command line says: exit code 0, 2 for bad arguments or files, 1 for what went wrong later.
pub fn run<S: Scene>() -> ExitCode {
    let matches = command::<S>().get_matches();
    match read::<S>(&matches).and_then(|line| start::<S>(&line.options, &line.more)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            error.exit_code()
        }
    }
}

fn start<S: Scene>(options: &Options, more: &S::More) -> Result<(), SceneError> {
    // Bad files are found before a window opens.
    let mut setup = options.setup(S::SEA, S::assets(more)?)?;
    S::describe(options, &setup.assets, &mut setup.water)?;
    if options.wants_window() {
        match window::run::<S>(options, &setup)? {
            window::Outcome::Done => return Ok(()),
            window::Outcome::NoDisplay(why) => {
                eprintln!("no window ({why}): writing pictures instead");
            }
        }
    }
    headless::run::<S>(options, &setup)
}
