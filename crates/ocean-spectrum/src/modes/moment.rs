//! The sea's modes at one time, and what is known of their sum without making it.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::modes::change::Segment;
use crate::modes::set::ModeSet;
use crate::query::patch::Band;
use crate::sea::shoal::Frequencies;
use crate::{CascadeModes, Ocean, OceanDesc, WaveSpectrum, dispersion};

/// What a sea's modes are at one time: `h(k) = sum of weight[s] h_s(k)` over one or two mode sets, each brought to its
/// own phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// The time within each set's loop, in 1/2^32 of it: a mode's phase is `n.wrapping_mul(phase)` turns of 2^32.
    pub phase: [u32; 2],
    /// Factor on each set's amplitudes: (1, 0) when the sea does not change.
    pub weight: [f32; 2],
    /// Factor on the horizontal displacement.
    pub choppiness: f32,
    /// Which mode sets: numbers that no other mode set has, 0 for none.
    pub sets: [u64; 2],
}

/// The mode sets in use at a time.
#[derive(Clone, Copy)]
pub(crate) enum Parts<'a> {
    Alone(&'a Arc<ModeSet>),
    Mixed(&'a Segment),
}

impl<'a> Parts<'a> {
    pub(crate) fn first(self) -> &'a Arc<ModeSet> {
        match self {
            Self::Alone(set) => set,
            Self::Mixed(segment) => &segment.from,
        }
    }

    pub(crate) fn second(self) -> Option<&'a Arc<ModeSet>> {
        match self {
            Self::Alone(_) => None,
            Self::Mixed(segment) => Some(&segment.to),
        }
    }

    pub(crate) fn moment(self, t: f64) -> Moment {
        match self {
            Self::Alone(set) => Moment {
                phase: [set.phase_at(t), 0],
                weight: [1.0, 0.0],
                choppiness: set.desc.choppiness,
                sets: [set.id, 0],
            },
            Self::Mixed(Segment { from, to, .. }) => {
                let (share, weight) = self.shares(t);
                let chop = [from.desc.choppiness, to.desc.choppiness].map(f64::from);
                Moment {
                    phase: [from.phase_at(t), to.phase_at(t)],
                    weight: weight.map(|weight| weight as f32),
                    choppiness: (chop[0] + share * (chop[1] - chop[0])) as f32,
                    sets: [from.id, to.id],
                }
            }
        }
    }

    /// How far a change has come, 0 to 1, and the weights of the sets.
    pub(crate) fn shares(self, t: f64) -> (f64, [f64; 2]) {
        match self {
            Self::Alone(_) => (0.0, [1.0, 0.0]),
            Self::Mixed(segment) => {
                let share = segment.share(t);
                (share, segment.weights(share))
            }
        }
    }
}

impl Ocean {
    /// The mode sets in use at a time.
    pub(crate) fn parts_at(&self, t: f64) -> Parts<'_> {
        match self.segments.iter().rfind(|segment| segment.start <= t) {
            None => Parts::Alone(&self.base),
            Some(segment) if t < segment.end() => Parts::Mixed(segment),
            Some(segment) => Parts::Alone(&segment.after),
        }
    }

    /// The mode sets in use at the time set.
    pub(crate) fn parts(&self) -> Parts<'_> {
        self.parts_at(self.time_set)
    }

    /// Phases and weights of the mode sets at time `t`, seconds (0 if not finite). Those sets are
    /// [`Self::mode_sets_at`] the same time.
    pub fn moment_at(&self, t: f64) -> Moment {
        let t = finite(t);
        self.parts_at(t).moment(t)
    }

    /// The modes of each cascade at the time set: those of the sea, or, during a change, those of the sea it comes from
    /// and those of the sea it goes to.
    pub fn mode_sets(&self) -> (&[CascadeModes], Option<&[CascadeModes]>) {
        self.mode_sets_at(self.time_set)
    }

    /// As [`Self::mode_sets`], at time `t`, seconds (0 if not finite).
    pub fn mode_sets_at(&self, t: f64) -> (&[CascadeModes], Option<&[CascadeModes]>) {
        let parts = self.parts_at(finite(t));
        (&parts.first().modes, parts.second().map(|set| &set.modes[..]))
    }

    /// Grows whenever [`Self::mode_sets`] are replaced; what holds copies of the modes watches it, or, for other times
    /// than the one set, [`Moment::sets`].
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The description; during a change, that of the sea it comes from.
    pub fn desc(&self) -> &OceanDesc {
        &self.parts().first().desc
    }

    /// The spectrum that [`Self::modes`] were made from.
    pub fn spectrum(&self) -> &WaveSpectrum {
        &self.parts().first().spectra[0].1
    }

    /// The modes of each cascade; during a change, those of the sea it comes from.
    pub fn modes(&self) -> &[CascadeModes] {
        &self.parts().first().modes
    }

    /// A time in seconds as a fraction of the loop of [`Self::desc`], in 1/2^32; a mode's phase is
    /// `n.wrapping_mul(phase)` turns of 2^32. As exact at 10^7 s as at 0; 0 for a time that is not finite.
    pub fn phase_at(&self, t: f64) -> u32 {
        self.parts().first().phase_at(t)
    }

    /// The phase of the surface held.
    pub fn phase(&self) -> u32 {
        self.moment.phase[0]
    }

    /// Time of the surface held, seconds within the loop: the time set, rounded to 2^-32 of the loop (.24 microseconds
    /// at the default loop).
    pub fn time(&self) -> f64 {
        f64::from(self.phase()) / 4_294_967_296.0 * self.desc().loop_time
    }

    /// Significant wave height of the modes, metres: `4 sqrt(variance)`. During a change, of their mix.
    pub fn significant_height(&self) -> f32 {
        let parts = self.parts();
        let (share, _) = parts.shares(self.time_set);
        let first = parts.first().variance.sqrt();
        let deviation = parts.second().map_or(first, |set| first + share * (set.variance.sqrt() - first));
        (4.0 * deviation) as f32
    }

    /// As [`Self::significant_height`], of some cascades alone.
    pub fn significant_height_of(&self, cascades: std::ops::Range<usize>) -> f32 {
        let layers = self.layers.get(cascades).unwrap_or_default();
        4.0 * layers.iter().map(|layer| layer.band.variance).sum::<f32>().sqrt()
    }

    /// Period of the spectrum's peak, seconds. During a change, between the two seas'.
    pub fn peak_period(&self) -> f32 {
        self.between(WaveSpectrum::peak_period) as f32
    }

    /// Wavenumber of the spectrum's peak, rad/m. During a change, between the two seas'.
    pub fn peak_wavenumber(&self) -> f32 {
        self.between(WaveSpectrum::peak_wavenumber) as f32
    }

    /// Wavelength of the spectrum's peak, metres. During a change, between the two seas'.
    pub fn peak_wavelength(&self) -> f32 {
        (TAU / self.between(WaveSpectrum::peak_wavenumber)) as f32
    }

    /// Speed of the crests of the peak, m/s. During a change, between the two seas'.
    pub fn peak_phase_speed(&self) -> f32 {
        self.between(|spectrum| {
            let k = spectrum.peak_wavenumber();
            dispersion::frequency(k, spectrum.depth()) / k
        }) as f32
    }

    /// Mean square slope of the waves shorter than twice the footprint (metres), those beyond the finest texel
    /// included; see [`WaveSpectrum::hidden_slope`]. During a change, of the mix.
    pub fn hidden_slope(&self, footprint: f32) -> f32 {
        let parts = self.parts();
        let (_, [a, b]) = parts.shares(self.time_set);
        let first = parts.first().hidden_slope(footprint.into());
        let slope = match parts {
            Parts::Alone(_) => first,
            Parts::Mixed(Segment { to, cross, .. }) => {
                let second = to.hidden_slope(footprint.into());
                let both = if cross.is_some() { (first * second).sqrt() } else { 0.0 };
                a * a * first + b * b * second + 2.0 * a * b * both
            }
        };
        slope as f32
    }

    /// Variance of a cascade by frequency in weighted terms, each with the depth of its sea.
    pub(crate) fn frequencies(&self, c: usize) -> impl Iterator<Item = (f64, &Frequencies, Option<f64>)> {
        let parts = self.parts();
        let (_, [a, b]) = parts.shares(self.time_set);
        let first = parts.first();
        let cross = match parts {
            Parts::Mixed(Segment { cross: Some(cross), .. }) => Some(&cross.frequencies[c]),
            _ => None,
        };
        let depth = first.spectra[0].1.depth();
        let second = parts.second().map(|set| (b * b, &set.frequencies[c], set.spectra[0].1.depth()));
        [(a * a, &first.frequencies[c], depth)]
            .into_iter()
            .chain(second)
            .chain(cross.map(|cross| (2.0 * a * b, cross, depth)))
    }

    /// Means over the energy of a cascade.
    pub(crate) fn band(&self, c: usize) -> Band {
        match self.parts() {
            Parts::Alone(set) => set.bands[c],
            Parts::Mixed(Segment { from, to, cross, .. }) => {
                let [a, b] = self.moment.weight;
                let cross = cross.as_ref().map(|cross| (2.0 * a * b, cross.bands[c]));
                Band::sum([(a * a, from.bands[c]), (b * b, to.bands[c])].into_iter().chain(cross))
            }
        }
    }

    /// Density of the variance over wavevectors, m^4, up to what two seas on the way between have in common.
    pub(crate) fn wavenumber_density(&self, kx: f64, kz: f64) -> f64 {
        let parts = self.parts();
        let (_, [a, b]) = parts.shares(self.time_set);
        let density = |set: &ModeSet| {
            set.spectra.iter().map(|(share, spectrum)| share * spectrum.wavenumber_density(kx, kz)).sum::<f64>()
        };
        a * a * density(parts.first()) + parts.second().map_or(0.0, |set| b * b * density(set))
    }

    /// A figure of the spectrum, during a change the geometric mean on its way from one sea's to the other's.
    fn between(&self, figure: impl Fn(&WaveSpectrum) -> f64) -> f64 {
        let parts = self.parts();
        let first = parts.first().figure(&figure);
        match parts.second() {
            None => first,
            Some(to) => {
                let share = parts.shares(self.time_set).0;
                first * libm::pow(to.figure(&figure) / first, share)
            }
        }
    }
}

/// A time that can be computed with.
pub(crate) fn finite(t: f64) -> f64 {
    if t.is_finite() { t } else { 0.0 }
}
