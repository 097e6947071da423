//! Writes the depth map of the scene `harbour` again: 16-bit grey, a centimetre per level, two metres per pixel.

use std::process::ExitCode;

fn main() -> ExitCode {
    let path = std::env::args().nth(1).unwrap_or_else(|| "examples/assets/harbour/depth.png".into());
    match open_water_examples::harbour::picture().save(&path) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {path}: {error}");
            ExitCode::from(2)
        }
    }
}
