//! Timing: warm-up, repeats, median and interquartile range.

use std::time::{Duration, Instant};

/// How long a measurement may take.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Time spent running before anything is kept.
    pub warm_up: Duration,
    /// Time spent on kept samples, split over what is measured together.
    pub budget: Duration,
    /// Fewest samples kept of each, whatever the budget.
    pub least: u32,
}

impl Effort {
    /// A few tenths of a second.
    pub const QUICK: Self = Self { warm_up: Duration::from_millis(50), budget: Duration::from_millis(250), least: 5 };
    /// A few seconds.
    pub const FULL: Self = Self { warm_up: Duration::from_millis(300), budget: Duration::from_secs(2), least: 15 };
}

/// What a measurement found, per call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Median, nanoseconds.
    pub median_ns: f64,
    /// Third quartile less the first, nanoseconds.
    pub spread_ns: f64,
    /// Samples kept; a sample of a short function holds many calls.
    pub repeats: u32,
}

impl Timing {
    /// The same, per one of `count` things that a call does.
    pub fn per(self, count: f64) -> Self {
        Self { median_ns: self.median_ns / count, spread_ns: self.spread_ns / count, ..self }
    }

    fn of(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        let at = |q: f64| {
            let place = q * (samples.len() - 1) as f64;
            let (low, high) = (samples[place.floor() as usize], samples[place.ceil() as usize]);
            low + (high - low) * place.fract()
        };
        Self { median_ns: at(0.5), spread_ns: at(0.75) - at(0.25), repeats: samples.len() as u32 }
    }
}

/// Times `f`. Wrap its inputs and outputs in [`std::hint::black_box`].
pub fn measure(effort: Effort, mut f: impl FnMut()) -> Timing {
    measure_together(effort, [&mut f])[0]
}

/// The least time of each, in turns, in four times the effort: for functions that use other threads and memory and suffer
/// differently from others' work on the machine.
pub fn fastest<const N: usize>(effort: Effort, mut functions: [&mut dyn FnMut(); N]) -> [Timing; N] {
    let mut least = [f64::INFINITY; N];
    // The first calls compile and upload.
    functions.iter_mut().for_each(|f| f());
    let (start, mut repeats) = (Instant::now(), 0);
    while repeats < 4 * effort.least || start.elapsed() < 4 * effort.budget {
        for (f, least) in functions.iter_mut().zip(&mut least) {
            let start = Instant::now();
            f();
            *least = least.min(start.elapsed().as_nanos() as f64);
        }
        repeats += 1;
    }
    least.map(|median_ns| Timing { median_ns, spread_ns: 0.0, repeats })
}

/// Times several functions in turns, so that a slow moment of the machine meets all of them: for ratios.
pub fn measure_together<const N: usize>(effort: Effort, mut functions: [&mut dyn FnMut(); N]) -> [Timing; N] {
    let batches = functions.each_mut().map(|f| warm_up(effort, *f));
    let mut samples = [const { Vec::new() }; N];
    let start = Instant::now();
    while samples[0].len() < effort.least as usize || start.elapsed() < effort.budget {
        for ((f, batch), samples) in functions.iter_mut().zip(batches).zip(&mut samples) {
            samples.push(time(*f, batch));
        }
    }
    samples.map(Timing::of)
}

/// Runs `f` for the warm-up time and says how many calls make a sample long enough for the clock.
fn warm_up(effort: Effort, f: &mut dyn FnMut()) -> u32 {
    const SHORTEST_SAMPLE_NS: f64 = 20_000.0;
    let start = Instant::now();
    let mut batch = 1;
    loop {
        let ns = time(f, batch);
        if ns * f64::from(batch) < SHORTEST_SAMPLE_NS && batch < 1 << 20 {
            batch *= 2;
        } else if start.elapsed() >= effort.warm_up {
            return batch;
        }
    }
}

fn time(f: &mut dyn FnMut(), batch: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..batch {
        f();
    }
    start.elapsed().as_nanos() as f64 / f64::from(batch)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_quartiles_of_a_known_list() {
        let timing = Timing::of(vec![5.0, 1.0, 3.0, 2.0, 4.0]);
        assert_eq!(timing, Timing { median_ns: 3.0, spread_ns: 2.0, repeats: 5 });
    }

    #[test]
    fn a_sleep_takes_its_time() {
        let effort = Effort { warm_up: Duration::ZERO, budget: Duration::ZERO, least: 3 };
        let timing = measure(effort, || std::thread::sleep(Duration::from_millis(2)));
        assert!(timing.median_ns >= 2e6);
        assert_eq!(timing.repeats, 3);
    }
}
