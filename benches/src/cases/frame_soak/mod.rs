//! Case `soak_water`: a whole game's life at random: bodies, grids, seas and views come and go, frames jitter, encoders are
//! dropped, the device is lost, the water goes back to a snapshot. Nothing may leak, nothing may be invalid or other than finite,
//! and the same life lived by another player, who looks elsewhere, must end in the same water.

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

/// Frames between two moments at which everything is taken away and what is left is counted, in the full form.
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

fn length(context: &Context) -> usize {
    context.pick(CHAPTER / 8, CHAPTER)
}

fn live(context: &Context, chapters: usize, looks: u64) -> Result<Lived, CaseError> {
    let mut device = Device::open()?;
    let mut life = Life::new(&device, 11)?;
    life.compile();
    let mut looks = Looks::new(looks);
    let mut lived = Lived { hashes: Vec::new(), left: Vec::new(), complaints: 0, broken: 0, events: 0, secs: 0.0 };
    let start = Instant::now();
    for chapter in 0..chapters {
        for frame in 0..length(context) {
            if chapter % 10 == 1 && frame == 100 {
                lived.complaints += device.complaints();
                device = Device::open()?;
                looks.forget();
                life.lose_device(&device)?;
                life.compile();
            }
            life.frame()?;
            looks.frame(&device, &mut life)?;
            lived.broken += life.broken();
        }
        lived.hashes.push(life.water.hash());
        life.leave()?;
        looks.rest(&device, &mut life)?;
        lived.left.push([device.resources(), heap_bytes()]);
    }
    device.wait()?;
    lived.complaints += device.complaints();
    lived.events = life.events;
    lived.secs = start.elapsed().as_secs_f64();
    Ok(lived)
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let chapters = context.pick(6, 90);
    let (one, other) = (live(context, chapters, 1)?, live(context, chapters, 2)?);
    let differ = one.hashes.iter().zip(&other.hashes).filter(|(a, b)| a != b).count();
    let frames = chapters * length(context);
    let row = |variant: &str| Row::new("soak_water", variant).param("frames", frames).param("events", one.events);
    // The first chapters fill caches and pools. What is left of a few buffers differs by what came last.
    let grown = |k: usize| {
        let (early, late) = one.left.split_at(one.left.len() / 2);
        let most = |of: &[[usize; 2]]| of.iter().map(|left| left[k]).max().unwrap_or(0);
        most(late).saturating_sub(most(early)) as f64
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
        row("resources of the device")
            .param("resources", one.left.last().map_or(0, |left| left[0]))
            .error(grown(0), "more in the second half", "the most of the first, with nothing in the water")
            // A slow device has some buffers more under way; a leak would leave one for each of thousands of events.
            .bound(16.0),
        row("bytes of the heap")
            .param("MiB", one.left.last().map_or(0, |left| left[1] >> 20))
            .error(grown(1) / 1024.0, "KiB more in the second half", "the most of the first, with nothing in the water")
            .bound(1024.0),
    ])
}
