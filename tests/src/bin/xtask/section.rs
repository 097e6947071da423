//! Named sections: a heading, commands shown before they run, a time each, stop at the first failure.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

/// Why a check stopped, in words for the person at the terminal.
pub(crate) type Failure = String;

/// The sections run so far, with their times.
pub(crate) struct Sections {
    root: PathBuf,
    env: Vec<(String, String)>,
    done: Vec<(String, Duration, bool)>,
}

impl Sections {
    pub(crate) fn new() -> Self {
        let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
        let root = tests.parent().unwrap_or(tests).to_path_buf();
        Self { root, env: Vec::new(), done: Vec::new() }
    }

    /// Gives every later command an environment variable.
    pub(crate) fn set_env(&mut self, name: &str, value: &str) {
        self.env.push((name.to_owned(), value.to_owned()));
    }

    /// Runs one section under its heading and keeps its time.
    pub(crate) fn run(
        &mut self,
        name: &str,
        body: impl FnOnce(&mut Self) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        println!("\n=== {name} ===");
        let start = Instant::now();
        let outcome = body(self);
        let took = start.elapsed();
        println!("--- {name}: {:.1} s", took.as_secs_f64());
        self.done.push((name.to_owned(), took, outcome.is_ok()));
        outcome.map_err(|failure| format!("{name}: {failure}"))
    }

    /// Runs `cargo` with words split at blanks, at the root of the workspace.
    pub(crate) fn cargo(&self, words: &str) -> Result<(), Failure> {
        self.cargo_with_env(words, &[])
    }

    /// As [`Self::cargo`], with more environment variables for this command only.
    pub(crate) fn cargo_with_env(&self, words: &str, env: &[(&str, &str)]) -> Result<(), Failure> {
        let shown: String = env.iter().map(|(name, value)| format!("{name}='{value}' ")).collect();
        println!("$ {shown}cargo {words}");
        let mut command = self.cargo_command(words);
        command.envs(env.iter().copied());
        let status = command.status().map_err(|error| format!("cannot start cargo: {error}"))?;
        if status.success() { Ok(()) } else { Err(format!("`{shown}cargo {words}` ended with {status}")) }
    }

    /// The standard output of a `cargo` command and whether it succeeded; its errors go to the terminal.
    pub(crate) fn cargo_output(&self, words: &str) -> Result<(String, bool), Failure> {
        println!("$ cargo {words}");
        let output = self
            .cargo_command(words)
            .stderr(Stdio::inherit())
            .output()
            .map_err(|error| format!("cannot start cargo: {error}"))?;
        Ok((String::from_utf8_lossy(&output.stdout).into_owned(), output.status.success()))
    }

    fn cargo_command(&self, words: &str) -> Command {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut command = Command::new(cargo);
        command.args(words.split_whitespace()).current_dir(&self.root);
        command.envs(self.env.iter().map(|(name, value)| (name, value)));
        command
    }

    /// Prints the time of every section.
    pub(crate) fn summary(&self) {
        println!("\n=== summary ===");
        for (name, took, passed) in &self.done {
            println!("{:>8.1} s  {}  {name}", took.as_secs_f64(), if *passed { "ok    " } else { "FAILED" });
        }
        let total: f64 = self.done.iter().map(|(_, took, _)| took.as_secs_f64()).sum();
        println!("{total:>8.1} s  in all");
    }
}
