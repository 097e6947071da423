//! What the scenes share: options, the device, a headless loop that writes PNGs, a window with an overlay, cameras.
//!
//! A scene implements [`Scene`] and calls [`run`]; it simulates and says what to draw, nothing else.

mod camera;
mod capture;
mod device;
mod dice;
mod draw;
mod error;
mod font;
pub mod harbour;
mod headless;
mod options;
mod overlay;
mod props;
mod scene;
mod timing;
mod topview;
mod window;

pub use device::{Gpu, Pick};
pub use dice::Dice;
pub use error::SceneError;
pub use options::{Backend, Options, Quality, Setup};
pub use props::{barrel, boat_mesh, crate_box, hull_mesh};
pub use scene::{Helm, Mark, Scene, Subject};

use std::process::ExitCode;

use clap::Parser;

/// Runs a scene as the command line says: exit code 0, 2 for bad arguments or files, 1 for what went wrong later.
pub fn run<S: Scene>() -> ExitCode {
    let options = Options::parse();
    match start::<S>(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            error.exit_code()
        }
    }
}

fn start<S: Scene>(options: &Options) -> Result<(), SceneError> {
    // Bad files are found before a window opens.
    let setup = options.setup()?;
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
