//! Case `soak_water`: a whole game's life at random: bodies, grids, seas, land and views come and go, frames jitter, encoders
//! are dropped. Nothing may leak, nothing may be invalid or other than finite, and the same life lived by another player, who
//! looks elsewhere, must end in the same water.

mod device;
mod life;
mod looks;

use std::time::Instant;

use self::device::Device;
use self::life::Life;
use self::looks::Looks;
use crate::evidence::{Case, CaseError, Context, Row, heap_bytes};

/// See the module.
pub(super) const SOAK: Case = Case {
    name: "soak_water",
    about: "everything comes and goes at random: leaks, errors of the device, NaN, and hashes against a second run's",
    plots: &[],
    run,
};

/// Frames between two moments at which everything is taken away and what is left is counted.
const CHAPTER: usize = 1_200;

/// What one life left behind.
struct Lived {
    /// Of the water at the end of each chapter.
    hashes: Vec<u64>,
    /// Resources of the device, and bytes of the heap, at the end of each chapter.
    left: Vec<[usize; 2]>,
    /// What the device complained of.
    complaints: usize,
    /// Answers that were not finite.
    broken: usize,
    /// What happened, for the row.
    events: usize,
    secs: f64,
}

fn live(context: &Context, chapters: usize, looks: u64) -> Result<Lived, CaseError> {
    let device = Device::open()?;
    let mut life = Life::new(&device, 11)?;
    let mut looks = Looks::new(looks);
    let mut lived = Lived { hashes: Vec::new(), left: Vec::new(), complaints: 0, broken: 0, events: 0, secs: 0.0 };
    let start = Instant::now();
    for _ in 0..chapters {
        for _ in 0..context.pick(CHAPTER / 4, CHAPTER) {
            life.frame()?;
            looks.frame(&device, &mut life)?;
            lived.broken += life.broken();
        }
        lived.hashes.push(life.hash());
        life.leave()?;
        looks.rest(&device, &mut life)?;
        lived.left.push([device.resources(), heap_bytes()]);
    }
    device.wait()?;
    (lived.complaints, lived.events) = (device.complaints(), life.events);
    lived.secs = start.elapsed().as_secs_f64();
    Ok(lived)
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let chapters = context.pick(2, 90);
    let (one, other) = (live(context, chapters, 1)?, live(context, chapters, 2)?);
    let differ = one.hashes.iter().zip(&other.hashes).filter(|(a, b)| a != b).count();
    let frames = chapters * context.pick(CHAPTER / 4, CHAPTER);
    let row = |variant: &str| Row::new("soak_water", variant).param("frames", frames).param("events", one.events);
    // Two chapters fill caches and pools: only the full form can tell what leaks.
    let left = |row: Row, most: f64| if context.quick { row } else { row.bound(most) };
    let grown = |k: usize| {
        let early = one.left[..one.left.len().div_ceil(4)].iter().map(|left| left[k]).max().unwrap_or(0);
        one.left.last().map_or(0, |last| last[k].saturating_sub(early)) as f64
    };
    Ok(vec![
        row("hashes of the water")
            .param("seconds", one.secs.round())
            .error(differ as f64, "chapters that differ", "the same life, looked at from elsewhere")
            .bound(0.0),
        row("answers that are not finite").error((one.broken + other.broken) as f64, "answers", "none").bound(0.0),
        row("complaints of the device")
            .error((one.complaints + other.complaints) as f64, "validation errors", "none")
            .bound(0.0),
        left(
            row("resources of the device").error(
                grown(0),
                "more at the end",
                "the most after the first quarter, with nothing in the water",
            ),
            0.0,
        ),
        left(
            row("bytes of the heap").error(
                grown(1) / 1024.0,
                "KiB more at the end",
                "the most after the first quarter",
            ),
            256.0,
        ),
    ])
}
