//! `cargo xtask`: sets up what the tests need and runs every check of this repository.

mod adapter;
mod checks;
mod section;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use section::Sections;

#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", about = "Sets up and runs the checks of Open Water")]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Find or install a graphics adapter, then run the whole test set.
    Test(TestArgs),
    /// Everything that continuous integration runs: format, lints, docs, tests, headless scenes, quick evidence.
    Ci(TestArgs),
}

#[derive(clap::Args)]
struct TestArgs {
    /// Never install anything: print the command to type instead.
    #[arg(long)]
    no_install: bool,
    /// Run on the software adapter even where there is a graphics card.
    #[arg(long)]
    software: bool,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let mut sections = Sections::new();
    let outcome = match &cli.task {
        Task::Test(args) => checks::test(&mut sections, args),
        Task::Ci(args) => checks::ci(&mut sections, args),
    };
    sections.summary();
    match outcome {
        Ok(()) => {
            println!("all passed");
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("\nerror: {failure}");
            ExitCode::FAILURE
        }
    }
}
