//! `cargo run --release --bin evidence -- --quick --out DIR`: run time against error, as a table, `evidence.json` and
//! plots. Exits with 1 when a row is bad.

use std::{fs, io, path::PathBuf, process::ExitCode, time::Instant};

use clap::{Parser, builder::PossibleValuesParser};
use indicatif::{ProgressBar, ProgressStyle};
use open_water_benches::{
    cases::CASES,
    evidence::{Case, Context, Machine, Report, Row, SCHEMA, draw, table},
};

/// Counts what rows about allocations and leaks tell.
#[global_allocator]
static HEAP: &stats_alloc::StatsAlloc<std::alloc::System> = &stats_alloc::INSTRUMENTED_SYSTEM;

/// Measures how right and how fast Open Water is on this machine.
///
/// Every row compares a result of the library with something that shares no code with it, and gives the time it took.
/// benches/EVIDENCE.md explains the columns and evidence.json.
#[derive(Parser)]
#[command(name = "evidence")]
struct Cli {
    /// Run the short form of every case: a minute or two in all.
    #[arg(long)]
    quick: bool,
    /// Folder for evidence.json and the plots; made when missing.
    #[arg(long, value_name = "DIR", default_value = "target/evidence")]
    out: PathBuf,
    /// Run these cases only, separated by commas.
    #[arg(long, value_name = "CASE", value_delimiter = ',',
          value_parser = PossibleValuesParser::new(CASES.iter().map(|case| case.name)), hide_possible_values = true)]
    only: Vec<String>,
    /// List the cases and leave.
    #[arg(long)]
    list: bool,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    if cli.list {
        for case in CASES {
            println!("{:<16} {}", case.name, case.about);
        }
        return ExitCode::SUCCESS;
    }
    match run(&cli) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {}: {error}", cli.out.display());
            ExitCode::FAILURE
        }
    }
}

fn run(cli: &Cli) -> io::Result<bool> {
    if cfg!(debug_assertions) {
        eprintln!("note: built without --release, so the times mean little");
    }
    fs::create_dir_all(&cli.out)?;
    let context = Context::new(cli.quick, cli.out.clone());
    let chosen: Vec<&Case> =
        CASES.iter().filter(|case| cli.only.is_empty() || cli.only.iter().any(|name| name == case.name)).collect();
    let bar = ProgressBar::new(chosen.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    let mut rows = Vec::new();
    for case in &chosen {
        bar.set_message(case.name);
        let start = Instant::now();
        let made = (case.run)(&context).unwrap_or_else(|error| vec![Row::failed(case.name, error)]);
        let bad = made.iter().filter(|row| !row.ok).count();
        bar.suspend(|| {
            eprintln!("{:<16} {:>3} rows, {bad} bad, {:.1} s", case.name, made.len(), start.elapsed().as_secs_f64());
        });
        rows.extend(made);
        bar.inc(1);
    }
    bar.finish_and_clear();
    print!("{}", table(&rows));
    for case in chosen {
        let of_case: Vec<&Row> = rows.iter().filter(|row| row.case == case.name).collect();
        for plot in case.plots {
            let path = cli.out.join(format!("{}.png", plot.file));
            if draw(plot, &of_case, &path).map_err(io::Error::other)? {
                println!("plot {}", path.display());
            }
        }
    }
    let ok = rows.iter().all(|row| row.ok);
    let adapter = context.gpu().ok().map(|gpu| gpu.adapter.clone());
    let report = Report { schema: SCHEMA, quick: cli.quick, machine: Machine::here(adapter), ok, rows };
    let path = cli.out.join("evidence.json");
    fs::write(&path, serde_json::to_string_pretty(&report)? + "\n")?;
    let bad = report.rows.iter().filter(|row| !row.ok).count();
    println!("{}: {} rows, {bad} bad", path.display(), report.rows.len());
    Ok(ok)
}
