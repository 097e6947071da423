//! A change of the sea while it runs.

use std::sync::Arc;

use open_water_shaders::surface::MAX_CASCADES;
use open_water_shaders::turns;

use crate::error::check;
use crate::modes::bands;
use crate::modes::join::{Joined, TOGETHER, alike, common};
use crate::modes::moment::Parts;
use crate::modes::set::ModeSet;
use crate::query::patch::Band;
use crate::sea::shoal::Frequencies;
use crate::{CascadeModes, Ocean, OceanDesc, OceanError};

/// One change: the sea is that of `before` until `start`, then on its way, then that of `after`.
pub(crate) struct Segment {
    pub(crate) before: Arc<ModeSet>,
    pub(crate) after: Arc<ModeSet>,
    /// The same two, on the same cascades: they are mixed on the way.
    pub(crate) from: Arc<ModeSet>,
    pub(crate) to: Arc<ModeSet>,
    /// Which cascade each was before and is after, where cascades change.
    places: Option<Vec<[Option<usize>; 2]>>,
    pub(crate) start: f64,
    pub(crate) seconds: f64,
    /// What the two sets have in common, where their modes move together; then amplitudes are mixed, else two seas
    /// that do not know each other are faded into each other.
    pub(crate) cross: Option<Cross>,
    /// The mixed term of the variance, half way.
    covariance: f64,
}

/// The mixed terms of squares of two sets' amplitudes.
pub(crate) struct Cross {
    pub(crate) bands: Vec<Band>,
    pub(crate) frequencies: Vec<Frequencies>,
}

impl Cross {
    /// `None` unless all modes of both have the same frequency and phase.
    fn of(a: &ModeSet, b: &ModeSet) -> Option<Self> {
        let pairs = || a.modes.iter().zip(&b.modes);
        let loop_time = a.desc.loop_time;
        if b.desc.loop_time != loop_time || !pairs().all(|(a, b)| in_step(a, b)) {
            return None;
        }
        Some(Self {
            bands: pairs().map(|(a, b)| Band::of(a, b)).collect(),
            frequencies: pairs().map(|(a, b)| Frequencies::of(a, b, loop_time)).collect(),
        })
    }
}

/// Whether the modes that both hold have equal frequencies, and phases equal to rounding.
fn in_step(a: &CascadeModes, b: &CascadeModes) -> bool {
    let cells = a.amp.iter().zip(&a.n).zip(b.amp.iter().zip(&b.n));
    cells.into_iter().all(|((p, n), (q, m))| {
        let (dot, cross) = (p[0] * q[0] + p[1] * q[1], p[0] * q[1] - p[1] * q[0]);
        (n == m && cross.abs() <= 1e-4 * dot) || dot == 0.0 && cross == 0.0
    })
}

/// The mixed term of the variance at phases of the two loops.
fn covariance(a: &CascadeModes, b: &CascadeModes, phase: [u32; 2]) -> f64 {
    let mut sum = 0.0;
    for ((p, n), (q, m)) in a.amp.iter().zip(&a.n).zip(b.amp.iter().zip(&b.n)) {
        let [cos, sin] = turns::cos_sin(n.wrapping_mul(phase[0]).wrapping_sub(m.wrapping_mul(phase[1])));
        sum += f64::from((p[0] * q[0] + p[1] * q[1]) * cos - (p[0] * q[1] - p[1] * q[0]) * sin);
    }
    2.0 * sum
}

impl Segment {
    pub(crate) fn end(&self) -> f64 {
        self.start + self.seconds
    }

    /// How far the change has come, 0 to 1: it begins and ends gently.
    pub(crate) fn share(&self, t: f64) -> f64 {
        let u = ((t - self.start) / self.seconds).clamp(0.0, 1.0);
        u * u * (3.0 - 2.0 * u)
    }

    /// Weights of the two sets' amplitudes: (1, 0) to (0, 1). Half of each sea is less than either where their waves
    /// are not the same (the wind turns, phases differ), so both are raised to what makes the significant height go
    /// straight from one to the other.
    pub(crate) fn weights(&self, share: f64) -> [f64; 2] {
        let (a, b) = (1.0 - share, share);
        let (first, second) = (self.from.variance, self.to.variance);
        let variance = a * a * first + b * b * second + 2.0 * a * b * self.covariance;
        let wanted = a * first.sqrt() + b * second.sqrt();
        // By chance, two small seas may cancel out.
        let raised = if variance > 0.25 * wanted * wanted { wanted / variance.sqrt() } else { 2.0 };
        [a * raised, b * raised]
    }

    pub(crate) fn new(before: Arc<ModeSet>, after: Arc<ModeSet>, start: f64, seconds: f64) -> Result<Self, OceanError> {
        let (from, to, places) = match alike(&before, &after) {
            true => (Arc::clone(&before), Arc::clone(&after), None),
            false => {
                let Joined { from, to, places } = Joined::new(&before, &after)?;
                (Arc::new(from), Arc::new(to), Some(places))
            }
        };
        let phase = [&from, &to].map(|set| set.phase_at(start + 0.5 * seconds));
        let covariance = common(&before, &after).iter().map(|[a, b]| covariance(a, b, phase)).sum();
        let cross = Cross::of(&from, &to);
        Ok(Self { before, after, from, to, places, start, seconds, cross, covariance })
    }

    /// Whether its amplitudes move on the same cascades, so that it may be left half way.
    fn moves(&self) -> bool {
        self.cross.is_some() && self.places.is_none()
    }

    /// The sea at a time on the way.
    ///
    /// # Errors
    /// The two seas fade into each other.
    pub(crate) fn mixed(&self, t: f64) -> Result<ModeSet, OceanError> {
        check("change left half way", t, self.moves(), "of amplitudes alone")?;
        let parts = Parts::Mixed(self);
        let recipe = self.before.recipe.mixed(self, t);
        Ok(ModeSet::mixed([&self.from, &self.to], recipe, parts.shares(t).1, parts.moment(t).choppiness))
    }
}

impl Ocean {
    /// From time `start` on the sea becomes that of `desc` over `seconds` (0 to 86,400): slowly at first and at last,
    /// at every time on the way continuous, forwards and backwards.
    ///
    /// Queries are answered in the same way as before. Where all waves keep frequency and phase (wind, spreading, choppiness change), their amplitudes move. Else (depth,
    /// loop time, seed change) the two seas are faded into each other, with variance between the two. What the
    /// changing amplitudes add to velocity and acceleration is left out of [`Self::fields`]: it is smaller than they
    /// are by about the wave's period over `seconds`.
    ///
    /// Cascades may change as well. Those of the same tile, whose neighbours stay too, keep their waves whatever their size,
    /// and only what one size alone holds comes or goes. All others fade, old into new. On the way the sea has the cascades of both
    /// ([`Self::cascade_places`]), and costs as much.
    ///
    /// Asked for while the amplitudes of an earlier change move, the new one starts from the sea of that moment; while
    /// an earlier one fades, `start` is put off to its end. Earlier changes that would start later are dropped, and
    /// those that are over at the time set may be forgotten. This makes the modes of the new sea, and takes as long as
    /// [`Self::new`]; to spare a frame that, change a clone on another thread and [`Self::adopt`] it.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] as [`OceanDesc::validate`], for cascades that are more than 8 together with those of the
    /// sea before that are others, and for a start that is not finite; the sea is as it was then.
    pub fn change_to(&mut self, mut desc: OceanDesc, start: f64, seconds: f64) -> Result<(), OceanError> {
        self.check_change(&desc, start, seconds)?;
        desc.queries = self.base.desc.queries;
        let after = Arc::new(ModeSet::new(desc, self.base.level)?);

        let asked = start;
        let earlier = self.segments.iter().rfind(|segment| segment.start < start);
        let (before, start) = match earlier {
            None => (Arc::clone(&self.base), start),
            Some(last) if last.end() <= start => (Arc::clone(&last.after), start),
            Some(last) if last.moves() => (Arc::new(last.mixed(start)?), start),
            Some(last) => (Arc::clone(&last.after), last.end()),
        };
        let segment = Segment::new(before, after, start, seconds)?;
        self.segments.retain(|segment| segment.start < asked);
        self.segments.push(Arc::new(segment));
        while self.segments.len() > 1 && self.segments[1].start <= self.time_set {
            self.base = Arc::clone(&self.segments[1].before);
            self.segments.remove(0);
        }
        self.refresh();
        Ok(())
    }

    /// Whether [`Self::change_to`] would do it, in no time.
    ///
    /// # Errors
    /// As [`Self::change_to`].
    pub fn check_change(&self, desc: &OceanDesc, start: f64, seconds: f64) -> Result<(), OceanError> {
        check("start", start, true, "a finite time")?;
        check("seconds", seconds, (0.0..=86_400.0).contains(&seconds), "0 to 86400 s")?;
        desc.validate()?;
        let before = self.segments.last().map_or(&self.base, |last| &last.after);
        let bands = bands(&desc.cascades);
        let stays = |own: &CascadeModes| {
            desc.cascades.iter().zip(&bands).any(|(cascade, band)| (cascade.tile, *band) == (own.tile, own.band))
        };
        let both = desc.cascades.len() + before.modes.iter().filter(|own| !stays(own)).count();
        check("cascades", both as f64, both <= MAX_CASCADES, TOGETHER)
    }

    /// Takes over the changes of a clone that was changed, on another thread say.
    pub fn adopt(&mut self, changed: &Self) {
        (self.base, self.segments) = (Arc::clone(&changed.base), changed.segments.clone());
        self.refresh();
    }

    /// While cascades change: which one each was in the sea before and is in the sea after. `None` at all other times.
    pub fn cascade_places(&self) -> Option<&[[Option<usize>; 2]]> {
        match self.parts() {
            Parts::Mixed(segment) => segment.places.as_deref(),
            Parts::Alone(_) => None,
        }
    }

    /// The sea as it will be when no change is left.
    pub fn settled(&self) -> Self {
        let mut settled = self.clone();
        if let Some(last) = self.segments.last() {
            settled.set_time(last.end());
        }
        settled
    }
}
