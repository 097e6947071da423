//! The clock: turns the host's frame times into fixed ticks.
//!
//! A tick is always the same length, so the water does not depend on the frame rate. Time that a frame is too slow
//! for is dropped and reported, never caught up later. It does not run anything: the host does, tick by tick.

/// One fixed step of the whole water, to be handed to [`OpenWater::tick`](crate::OpenWater::tick).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tick {
    /// Number of this tick since the start; the first is 1.
    pub index: u64,
    /// Length, seconds.
    pub dt: f32,
}

impl Tick {
    /// Time at the end of the tick, seconds since the start.
    pub fn time(&self) -> f64 {
        self.index as f64 * f64::from(self.dt)
    }
}

/// The ticks that are due in a frame: an iterator of [`Tick`].
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    next: u64,
    end: u64,
    dt: f32,
    /// How far the drawn moment lies between the last two ticks, 0 to 1.
    pub alpha: f32,
    /// Time that was dropped because the frame was too long, seconds.
    pub dropped_secs: f64,
}

impl Iterator for Ticks {
    type Item = Tick;

    fn next(&mut self) -> Option<Tick> {
        (self.next < self.end).then(|| {
            self.next += 1;
            Tick { index: self.next, dt: self.dt }
        })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.end - self.next) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for Ticks {}

#[derive(Debug, Clone)]
pub(crate) struct Clock {
    dt: f32,
    max_ticks: u32,
    /// Ticks handed out so far.
    due: u64,
    /// Time not yet turned into ticks, seconds.
    rest: f64,
    alpha: f32,
}

impl Clock {
    pub(crate) fn new(dt: f32, max_ticks: u32) -> Self {
        Self { dt, max_ticks, due: 0, rest: 0.0, alpha: 1.0 }
    }

    /// The clock of a water of these ticks that has run `tick` of them. Time not yet turned into ticks stays.
    pub(crate) fn resume(&mut self, dt: f32, max_ticks: u32, tick: u64) {
        (self.dt, self.max_ticks, self.due) = (dt, max_ticks, tick);
        self.rest = self.rest.min(f64::from(dt));
    }

    /// The ticks after number `run` up to number `tick`, whatever the time.
    pub(crate) fn until(&mut self, run: u64, tick: u64) -> Ticks {
        self.due = tick.max(run);
        Ticks { next: run, end: self.due, dt: self.dt, alpha: self.alpha, dropped_secs: 0.0 }
    }

    pub(crate) fn dt(&self) -> f32 {
        self.dt
    }

    pub(crate) fn alpha(&self) -> f32 {
        self.alpha
    }

    /// A frame time that is not a positive number counts as zero.
    pub(crate) fn advance(&mut self, frame_dt: f32) -> Ticks {
        let dt = f64::from(self.dt);
        if frame_dt.is_finite() && frame_dt > 0.0 {
            self.rest += f64::from(frame_dt);
        }
        // A frame of exactly k ticks must give k of them in spite of rounding.
        let whole = (self.rest / dt + 1e-6).floor();
        let count = whole.min(f64::from(self.max_ticks));
        let dropped_secs = (whole - count) * dt;
        self.rest = (self.rest - whole * dt).max(0.0);
        self.alpha = ((self.rest / dt) as f32).clamp(0.0, 1.0);
        let first = self.due;
        self.due += count as u64;
        Ticks { next: first, end: self.due, dt: self.dt, alpha: self.alpha, dropped_secs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    #[test]
    fn every_frame_rate_gives_the_same_number_of_ticks() {
        for fps in [15.0_f32, 30.0, 60.0, 144.0, 240.0] {
            let mut clock = Clock::new(DT, 8);
            let frames = (10.0 * fps) as usize;
            let ticks: usize = (0..frames).map(|_| clock.advance(1.0 / fps).count()).sum();
            assert!((599..=600).contains(&ticks), "{fps} fps: {ticks} ticks");
        }
        // A frame of whole ticks has all of them, whichever way its length was rounded.
        for count in 1..=8u16 {
            assert_eq!(Clock::new(DT, 8).advance(f32::from(count) / 60.0).len(), usize::from(count));
        }
    }

    #[test]
    fn a_hitch_drops_time_and_says_so() {
        let mut clock = Clock::new(DT, 8);
        let ticks = clock.advance(5.0);
        assert_eq!(ticks.len(), 8);
        // 5 s are 300 ticks, or 299 and a rest.
        assert!((ticks.dropped_secs - (300.0 - 8.0) / 60.0).abs() < 0.0168, "{}", ticks.dropped_secs);
        assert_eq!(clock.advance(DT).next().map(|t| t.index), Some(9));
    }

    #[test]
    fn bad_frame_times_count_as_zero() {
        let mut clock = Clock::new(DT, 8);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0] {
            assert_eq!(clock.advance(bad).len(), 0);
        }
        assert!(clock.alpha().is_finite());
    }

    #[test]
    fn alpha_is_the_part_of_a_tick_that_is_left() {
        let mut clock = Clock::new(DT, 8);
        let ticks = clock.advance(2.25 * DT);
        assert_eq!(ticks.len(), 2);
        assert!((ticks.alpha - 0.25).abs() < 1e-4);
    }
}
