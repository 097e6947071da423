//! The command line of every scene.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use open_water::{Closure, Hull, OpenWaterDesc, Preset, SeaState};

use crate::SceneError;

/// What computes and draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Backend {
    /// A GPU if there is one, else a software adapter, else the CPU.
    Auto,
    /// An adapter, hardware or software; an error without one.
    Gpu,
    /// No adapter: everything on the CPU, drawn from above.
    Cpu,
}

/// Quality in one word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Quality {
    /// Integrated graphics.
    Low,
    /// The default.
    Medium,
    /// A strong GPU.
    High,
    /// The strongest, and pictures.
    Ultra,
    /// The set-up of Yang et al. 2017: Phillips, FFT 1024^2, 5-point grid 512^2, projected grid 128^2, 1440x900.
    Paper,
}

/// What the help of every scene says after what the scene shows.
pub(crate) const KEYS: &str = "With a display it opens a window; without one, or with --frames or --out, it writes \
     numbered PNGs and a summary.\nKeys: W/S or up/down throttle, A/D or left/right steer, P autopilot, C next camera \
     (drag and wheel: circle the boat), space pause, O overlay, E forces on the boat, Esc quit.";

/// The options that all scenes share.
#[derive(Debug, Clone, Parser)]
pub struct Options {
    /// Draw N frames of 1/30 s into PNGs instead of opening a window [default without a display: 300]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub frames: Option<u32>,
    /// Folder of the PNGs and of summary.txt [default: out]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Size of the picture, 16x16 to 8192x8192 [default: 1280x720; paper 1440x900]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// What computes and draws
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: Backend,
    /// Quality
    #[arg(long, value_enum, default_value = "medium")]
    pub preset: Quality,
    /// Sea state: wind and fetch, Hs and Tp, or a buoy's spectrum [default: Hs 1.8 m, Tp 7 s; paper Phillips, 10 m/s]
    #[arg(long, value_name = "FILE")]
    pub sea: Option<PathBuf>,
    /// Hull mesh, STL, OBJ or glTF, metres, y up, x forward; open tops are capped [default: an 8 m launch]
    #[arg(long, value_name = "FILE")]
    pub hull: Option<PathBuf>,
    /// Which camera: 1 follows the boat, 2 circles it, 3 and up stand where the scene puts them [default: the scene's choice]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=9))]
    pub view: Option<u32>,
    /// Seconds of the scene run before the first picture, 0 to 600 [default: as the scene needs]
    #[arg(long, value_name = "S", value_parser = parse_lead)]
    pub lead: Option<f32>,
    /// Draw the boat's waterline and the forces on it
    #[arg(long)]
    pub explain: bool,
    /// Chooses the phases of the waves and where the flotsam lies
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
}

/// What the files of the command line hold.
#[derive(Debug, Clone)]
pub struct Setup<A = ()> {
    /// The water.
    pub water: OpenWaterDesc,
    /// The boat's hull, closed.
    pub hull: Hull,
    /// Whether the hull is the one shipped.
    pub own_hull: bool,
    /// What the scene's own files hold.
    pub assets: A,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parts {
        Some(size) if size.iter().all(|n| (16..=8192).contains(n)) => Ok(size),
        Some([w, h]) => Err(format!("{w}x{h} is out of 16x16 to 8192x8192")),
        None => Err("not of the form WxH, as 1280x720".into()),
    }
}

fn parse_lead(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(lead) if (0.0..=600.0).contains(&lead) => Ok(lead),
        Ok(lead) => Err(format!("{lead} is out of 0 to 600 s")),
        Err(error) => Err(error.to_string()),
    }
}

impl Options {
    /// The preset of the water.
    pub fn preset(&self) -> Preset {
        match self.preset {
            Quality::Low => Preset::Low,
            Quality::Medium => Preset::Medium,
            Quality::High => Preset::High,
            Quality::Ultra => Preset::Ultra,
            Quality::Paper => Preset::Paper,
        }
    }

    /// Width and height of the picture.
    pub fn size(&self) -> [u32; 2] {
        self.size.unwrap_or(if self.preset == Quality::Paper { [1440, 900] } else { [1280, 720] })
    }

    /// Columns and rows of the projected grid.
    pub fn view_grid(&self) -> [u32; 2] {
        match self.preset {
            Quality::Low => [128, 192],
            Quality::Medium => [192, 320],
            Quality::High => [512, 768],
            Quality::Ultra => [768, 1152],
            Quality::Paper => [128, 128],
        }
    }

    /// Samples per pixel; a software adapter draws several only for the highest quality.
    pub fn samples(&self, software: bool) -> u32 {
        match self.preset {
            Quality::Low => 1,
            Quality::High | Quality::Ultra => 4,
            Quality::Medium | Quality::Paper => {
                if software {
                    1
                } else {
                    4
                }
            }
        }
    }

    /// Whether to try for a window.
    pub fn wants_window(&self) -> bool {
        self.frames.is_none() && self.out.is_none() && self.backend != Backend::Cpu
    }

    /// Reads the files; `sea` is the scene's own sea.
    pub(crate) fn setup<A>(&self, sea: &str, assets: A) -> Result<Setup<A>, SceneError> {
        let mut water = self.preset().water();
        water.seed = self.seed;
        water.sea = match (&self.sea, self.preset) {
            (Some(path), _) => SeaState::from_file(path).map_err(SceneError::usage)?,
            (None, Quality::Paper) => SeaState::phillips(10.0, 0.5),
            (None, _) => SeaState::parse("the scene's sea", sea).map_err(SceneError::usage)?,
        };
        let hull = match &self.hull {
            Some(path) => Hull::from_file(path, Closure::Cap),
            None => {
                let bytes = include_bytes!("../assets/hulls/launch.glb");
                open_water::TriMesh::from_bytes("launch.glb", bytes).and_then(|m| Hull::from_mesh(&m, Closure::Cap))
            }
        };
        Ok(Setup { water, hull: hull.map_err(SceneError::usage)?, own_hull: self.hull.is_none(), assets })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEA: &str = include_str!("../assets/seas/moderate.txt");

    #[test]
    fn sizes() {
        assert_eq!(parse_size("1280x720"), Ok([1280, 720]));
        assert!(parse_size("1280").is_err());
        assert!(parse_size("0x720").unwrap_err().contains("0x720"));
        assert!(parse_size("-1x720").is_err());
    }

    #[test]
    fn leads() {
        assert_eq!(parse_lead("12.5"), Ok(12.5));
        for bad in ["-1", "601", "NaN", "inf", "soon"] {
            assert!(parse_lead(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn shipped_files_are_good() {
        let options = Options::try_parse_from(["boat"]).unwrap();
        let setup = options.setup(SEA, ()).unwrap();
        assert!(setup.own_hull && setup.hull.volume() > 5.0);
        assert!(options.wants_window());
    }

    #[test]
    fn bad_files_are_named() {
        let options = Options::try_parse_from(["boat", "--sea", "nowhere.txt"]).unwrap();
        assert!(options.setup(SEA, ()).unwrap_err().to_string().contains("nowhere.txt"));
        let options = Options::try_parse_from(["boat", "--hull", "nowhere.stl"]).unwrap();
        let error = options.setup(SEA, ()).unwrap_err();
        assert!(error.to_string().contains("nowhere.stl"), "{error}");
    }

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Options::command().debug_assert();
    }
}
