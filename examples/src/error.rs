//! What ends a scene early.

use std::path::PathBuf;
use std::process::ExitCode;

/// Why a scene ended.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// An argument or a file named by one is bad.
    #[error("{0}")]
    Usage(String),
    /// A file could not be written.
    #[error("{path}: {source}")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The GPU could not be used, or said that something is wrong.
    #[error("{0}")]
    Gpu(String),
    /// The water refused something.
    #[error(transparent)]
    Water(#[from] open_water::OpenWaterError),
    /// The renderer refused something.
    #[error(transparent)]
    View(#[from] water_view::ViewError),
    /// The simulation gave a number that is not finite.
    #[error("{0} is not finite after {1:.2} s")]
    NotFinite(&'static str, f64),
}

impl SceneError {
    /// Bad arguments and files by the error that their reader gave.
    pub fn usage(error: impl std::fmt::Display) -> Self {
        Self::Usage(error.to_string())
    }

    /// 2 when the command line is to blame, else 1.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Usage(_) | Self::Write { .. } => ExitCode::from(2),
            _ => ExitCode::from(1),
        }
    }
}
