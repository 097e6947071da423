//! Where the evidence was made.

use std::{fs, path::Path, process::Command};

use serde::{Deserialize, Serialize};

/// The machine and the program.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Machine {
    /// Operating system and instruction set.
    pub system: String,
    /// Name of the processor.
    pub cpu: String,
    /// Threads that the thread pool uses.
    pub threads: usize,
    /// The graphics adapter of the GPU cases, if there is one.
    pub adapter: Option<Adapter>,
    /// Version of the compiler on the path.
    pub rustc: String,
    /// `release`, or `debug` when debug assertions are on.
    pub profile: String,
    /// Version of the package.
    pub version: String,
    /// Commit of the source, with `+` when files differ from it; `null` outside a repository.
    pub commit: Option<String>,
}

/// A graphics adapter.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Adapter {
    /// Its name.
    pub name: String,
    /// `DiscreteGpu`, `IntegratedGpu`, `VirtualGpu`, `Cpu` or `Other`.
    pub kind: String,
    /// The API it is driven through.
    pub backend: String,
    /// Driver and its version.
    pub driver: String,
}

impl Machine {
    /// Looks at this machine.
    pub fn here(adapter: Option<Adapter>) -> Self {
        Self {
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            cpu: cpu_name().unwrap_or_else(|| "unknown".to_owned()),
            threads: rayon::current_num_threads(),
            adapter,
            rustc: output("rustc", &["--version"]).unwrap_or_else(|| "unknown".to_owned()),
            profile: if cfg!(debug_assertions) { "debug" } else { "release" }.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: commit(),
        }
    }
}

fn cpu_name() -> Option<String> {
    if let Ok(info) = fs::read_to_string("/proc/cpuinfo") {
        let line = info.lines().find(|line| line.starts_with("model name"))?;
        return Some(line.split_once(':')?.1.trim().to_owned());
    }
    output("sysctl", &["-n", "machdep.cpu.brand_string"]).or_else(|| std::env::var("PROCESSOR_IDENTIFIER").ok())
}

fn commit() -> Option<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).to_str()?;
    let commit = output("git", &["-C", root, "rev-parse", "--short=12", "HEAD"])?;
    let changed = output("git", &["-C", root, "status", "--porcelain", "--untracked-files=no"])?;
    Some(if changed.is_empty() { commit } else { format!("{commit}+") })
}

fn output(program: &str, words: &[&str]) -> Option<String> {
    let output = Command::new(program).args(words).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
