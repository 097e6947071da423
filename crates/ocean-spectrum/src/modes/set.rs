//! A mode set: all modes of one sea, and what follows from them once. Shared by the copies of an [`crate::Ocean`].

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use fearless_simd::Level;

use crate::modes::recipe::Recipe;
use crate::modes::{self, CascadeModes};
use crate::query::largest::{Largest, Queries};
use crate::query::patch::Band;
use crate::sea::shoal::Frequencies;
use crate::synthesis::fft::Fft;
use crate::synthesis::held::Held;
use crate::synthesis::levels::lanes;
use crate::synthesis::pack::Pack;
use crate::{Notice, OceanDesc, OceanError, WaveSpectrum};

/// Spectra that are kept of a mix.
const SPECTRA: usize = 4;

pub(crate) struct ModeSet {
    /// No other mode set has it; from 1.
    pub(crate) id: u64,
    pub(crate) desc: OceanDesc,
    pub(crate) recipe: Recipe,
    /// The spectra of which the modes are a mix, with their shares in the amplitudes, largest first.
    pub(crate) spectra: Vec<(f64, Arc<WaveSpectrum>)>,
    pub(crate) modes: Vec<CascadeModes>,
    /// The vector units that synthesis uses.
    pub(crate) level: Level,
    pub(crate) held: Vec<Held>,
    pub(crate) ffts: Vec<Fft>,
    pub(crate) packs: Vec<[Pack; 3]>,
    pub(crate) bands: Vec<Band>,
    pub(crate) frequencies: Vec<Frequencies>,
    pub(crate) notices: Vec<Notice>,
    pub(crate) variance: f64,
    /// What queries sum, if they do.
    pub(crate) largest: Option<Largest>,
}

impl ModeSet {
    pub(crate) fn new(desc: OceanDesc, level: Level) -> Result<Self, OceanError> {
        desc.validate()?;
        let spectrum = WaveSpectrum::new(&desc.sea)?;
        let modes: Vec<_> = modes::bands(&desc.cascades)
            .into_iter()
            .enumerate()
            .map(|(c, band)| {
                modes::build(&spectrum, desc.cascades[c], band, c, desc.seed, desc.loop_time, desc.amplitudes)
            })
            .collect();
        let mut notices = spectrum.notices().to_vec();
        let share = 1.0 - modes.iter().map(CascadeModes::variance).sum::<f64>() / spectrum.variance();
        if share > 0.01 {
            notices.push(Notice::VarianceLost { share });
        }
        let recipe = Recipe::new(desc.clone());
        Ok(Self::of(level, desc, recipe, vec![(1.0, Arc::new(spectrum))], modes, notices))
    }

    pub(crate) fn of(
        level: Level,
        desc: OceanDesc,
        recipe: Recipe,
        spectra: Vec<(f64, Arc<WaveSpectrum>)>,
        modes: Vec<CascadeModes>,
        notices: Vec<Notice>,
    ) -> Self {
        static LAST: AtomicU64 = AtomicU64::new(0);
        Self {
            id: LAST.fetch_add(1, Ordering::Relaxed) + 1,
            held: modes.iter().map(|modes| Held::new(modes, desc.loop_time, lanes(level))).collect(),
            ffts: modes.iter().map(|modes| Fft::new(modes.size as usize)).collect(),
            level,
            packs: modes.iter().map(|modes| Pack::all(modes, &desc)).collect(),
            bands: modes.iter().map(|modes| Band::of(modes, modes)).collect(),
            frequencies: modes.iter().map(|modes| Frequencies::of(modes, modes, desc.loop_time)).collect(),
            variance: modes.iter().map(CascadeModes::variance).sum(),
            largest: match desc.queries {
                Queries::Arrays => None,
                Queries::Largest(count) => Some(Largest::new(&modes, desc.loop_time, count)),
            },
            desc,
            recipe,
            spectra,
            modes,
            notices,
        }
    }

    /// The sea that two are on the way between, as a set of its own: amplitudes `weight[0] a + weight[1] b`, for sets
    /// of equal frequencies.
    pub(crate) fn mixed([a, b]: [&Self; 2], recipe: Recipe, weight: [f64; 2], choppiness: f32) -> Self {
        let mut modes = b.modes.clone();
        for (modes, from) in modes.iter_mut().zip(&a.modes) {
            for (to, from) in modes.amp.iter_mut().zip(&from.amp) {
                for (to, from) in to.iter_mut().zip(from) {
                    *to = (weight[0] * f64::from(*from) + weight[1] * f64::from(*to)) as f32;
                }
            }
            for (to, from) in modes.n.iter_mut().zip(&from.n) {
                *to = (*to).max(*from);
            }
        }
        let scaled = |set: &Self, weight: f64| {
            set.spectra.iter().map(|(share, spectrum)| (share * weight, Arc::clone(spectrum))).collect::<Vec<_>>()
        };
        let mut spectra = [scaled(a, weight[0]), scaled(b, weight[1])].concat();
        spectra.sort_by(|a, b| b.0.total_cmp(&a.0));
        spectra.truncate(SPECTRA);
        let sum: f64 = spectra.iter().map(|(share, _)| share).sum();
        for (share, _) in &mut spectra {
            *share /= sum;
        }
        let desc = OceanDesc { choppiness, ..b.desc.clone() };
        Self::of(b.level, desc, recipe, spectra, modes, b.notices.clone())
    }

    /// See [`crate::Ocean::phase_at`].
    pub(crate) fn phase_at(&self, t: f64) -> u32 {
        // The remainder is exact, however large the time.
        let turns = t.rem_euclid(self.desc.loop_time) / self.desc.loop_time;
        // 2^32 itself, from rounding up, wraps to 0; a NaN casts to 0.
        libm::round(turns * 4_294_967_296.0) as u64 as u32
    }

    /// A figure of the spectrum; of a mix, the geometric mean.
    pub(crate) fn figure(&self, figure: impl Fn(&WaveSpectrum) -> f64) -> f64 {
        match &self.spectra[..] {
            [(_, spectrum)] => figure(spectrum),
            spectra => libm::exp(spectra.iter().map(|(share, spectrum)| share * libm::log(figure(spectrum))).sum()),
        }
    }

    /// See [`WaveSpectrum::hidden_slope`]; of a mix, with the amplitudes added.
    pub(crate) fn hidden_slope(&self, footprint: f64) -> f64 {
        match &self.spectra[..] {
            [(_, spectrum)] => spectrum.hidden_slope(footprint),
            spectra => {
                let root =
                    |(share, spectrum): &(f64, Arc<WaveSpectrum>)| share * spectrum.hidden_slope(footprint).sqrt();
                spectra.iter().map(root).sum::<f64>().powi(2)
            }
        }
    }
}
