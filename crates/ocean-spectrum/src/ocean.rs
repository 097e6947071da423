//! The sea: description, modes, and the surface at one time.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, Vec2};
use rayon::prelude::*;

use crate::amplitude::{AmplitudeMap, Placed};
use crate::error::check;
use crate::layers::{Layer, Layers};
use crate::modes::{self, CascadeModes};
use crate::shoal::Frequencies;
use crate::spectrum::WaveSpectrum;
use crate::synthesis::Synthesis;
use crate::{Notice, OceanError, SeaState, dispersion};

/// One cascade: a periodic square of sea that carries one band of wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CascadeDesc {
    /// Cells per side: a power of two from 16 to 1,024.
    pub size: u32,
    /// Side, metres, .5 to 100,000.
    pub tile: f32,
}

/// Description of a sea.
#[derive(Debug, Clone, PartialEq)]
pub struct OceanDesc {
    /// The sea state.
    pub sea: SeaState,
    /// Chooses the phases; the same seed gives the same sea everywhere.
    pub seed: u64,
    /// 1 to 8 cascades, longest tile first. The first should hold 1.5 peak wavelengths or more.
    pub cascades: Vec<CascadeDesc>,
    /// Factor on the horizontal displacement, 0 to 2: 0 gives sines, 1 the sharp crests of real waves.
    pub choppiness: f32,
    /// Seconds after which everything repeats, 10 to 10,000. Frequencies are rounded to whole turns of it.
    pub loop_time: f64,
}

impl Default for OceanDesc {
    /// The default sea state on three cascades, chop 1, a loop of 17 minutes.
    fn default() -> Self {
        let cascade = |tile| CascadeDesc { size: 256, tile };
        Self {
            sea: SeaState::default(),
            seed: 0,
            cascades: vec![cascade(485.0), cascade(72.4), cascade(10.8)],
            choppiness: 1.0,
            loop_time: 1024.0,
        }
    }
}

impl OceanDesc {
    /// Checks every value of the description.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] for the first value out of its bound.
    pub fn validate(&self) -> Result<(), OceanError> {
        self.sea.validate()?;
        let count = self.cascades.len();
        check("cascades", count as f64, (1..=8).contains(&count), "1 to 8")?;
        let mut last = f32::INFINITY;
        for c in &self.cascades {
            let ok = c.size.is_power_of_two() && (16..=1024).contains(&c.size);
            check("cascade size", c.size.into(), ok, "a power of two from 16 to 1024")?;
            check("cascade tile", c.tile.into(), (0.5..=100e3).contains(&c.tile), "0.5 to 100000 m")?;
            check("cascade tile", c.tile.into(), c.tile <= 0.8 * last, "at most 0.8 of the tile before it")?;
            last = c.tile;
        }
        check("choppiness", self.choppiness.into(), (0.0..=2.0).contains(&self.choppiness), "0 to 2")?;
        check("loop_time", self.loop_time, (10.0..=10e3).contains(&self.loop_time), "10 to 10000 s")
    }
}

/// The arrays of one cascade at the time set, row-major, x fastest; texel `(i, j)` lies at `(i, j) * tile/size`.
#[derive(Debug, Clone, Copy)]
pub struct CascadeFields<'a> {
    /// Texels per side.
    pub size: u32,
    /// Side, metres.
    pub tile: f32,
    /// `(Dx, h, Dz, dDx/dz)`: displacement in metres, choppiness included, and its cross derivative.
    pub displacement: &'a [[f32; 4]],
    /// `(dh/dx, dh/dz, dDx/dx, dDz/dz)`.
    pub derivative: &'a [[f32; 4]],
    /// `(dDx/dt, dh/dt, dDz/dt, d^2h/dt^2)`, m/s and m/s^2.
    pub velocity: &'a [[f32; 4]],
}

/// A sea whose surface is known at one time, the last that [`Ocean::set_time`] was given (at first 0).
pub struct Ocean {
    pub(crate) desc: OceanDesc,
    pub(crate) spectrum: WaveSpectrum,
    pub(crate) modes: Vec<CascadeModes>,
    pub(crate) layers: Vec<Layer>,
    pub(crate) frequencies: Vec<Frequencies>,
    map: Option<Placed>,
    origin: DVec2,
    notices: Vec<Notice>,
    phase: u32,
    variance: f64,
}

impl Ocean {
    /// Makes the modes and the surface at time 0.
    ///
    /// # Errors
    /// As [`OceanDesc::validate`].
    pub fn new(desc: OceanDesc) -> Result<Self, OceanError> {
        desc.validate()?;
        let spectrum = WaveSpectrum::new(&desc.sea)?;
        let modes: Vec<_> = modes::bands(&desc.cascades)
            .into_iter()
            .enumerate()
            .map(|(c, band)| modes::build(&spectrum, desc.cascades[c], band, c, desc.seed, desc.loop_time))
            .collect();
        let variance = modes.iter().map(CascadeModes::variance).sum::<f64>();
        let mut notices = spectrum.notices().to_vec();
        let share = 1.0 - variance / spectrum.variance();
        if share > 0.01 {
            notices.push(Notice::VarianceLost { share });
        }
        let layers = modes.iter().map(|modes| Layer::new(modes, Synthesis::new(modes, &desc))).collect();
        let frequencies = modes.iter().map(|modes| Frequencies::of(modes, desc.loop_time)).collect();
        let mut ocean = Self {
            desc,
            spectrum,
            modes,
            layers,
            frequencies,
            map: None,
            origin: DVec2::ZERO,
            notices,
            phase: 0,
            variance,
        };
        ocean.synthesise();
        Ok(ocean)
    }

    /// The description.
    pub fn desc(&self) -> &OceanDesc {
        &self.desc
    }

    /// The spectrum that the modes were made from.
    pub fn spectrum(&self) -> &WaveSpectrum {
        &self.spectrum
    }

    /// The modes of each cascade.
    pub fn modes(&self) -> &[CascadeModes] {
        &self.modes
    }

    /// What was changed in the description or left out.
    pub fn notices(&self) -> &[Notice] {
        &self.notices
    }

    /// A time in seconds as a fraction of the loop, in 1/2^32; a mode's phase is `n.wrapping_mul(phase)` turns of
    /// 2^32. As exact at 10^7 s as at 0; 0 for a time that is not finite.
    pub fn phase_at(&self, t: f64) -> u32 {
        // The remainder is exact, however large the time.
        let turns = t.rem_euclid(self.desc.loop_time) / self.desc.loop_time;
        // 2^32 itself, from rounding up, wraps to 0; a NaN casts to 0.
        libm::round(turns * 4_294_967_296.0) as u64 as u32
    }

    /// Computes the surface at time `t`, seconds, on rayon's threads. Does nothing if it is there already. Allocates
    /// nothing.
    pub fn set_time(&mut self, t: f64) {
        let phase = self.phase_at(t);
        if phase != self.phase {
            self.phase = phase;
            self.synthesise();
        }
    }

    /// The phase of the surface held.
    pub fn phase(&self) -> u32 {
        self.phase
    }

    /// Time of the surface held, seconds within the loop: the time set, rounded to 2^-32 of the loop (.24 microseconds
    /// at the default loop).
    pub fn time(&self) -> f64 {
        f64::from(self.phase) / 4_294_967_296.0 * self.desc.loop_time
    }

    fn synthesise(&mut self) {
        let phase = self.phase;
        self.layers.par_iter_mut().for_each(|layer| layer.fields.run(phase));
    }

    /// World position (x, z) of the local origin, metres. The sea stays where it is in the world. Ignored if not finite.
    pub fn set_origin(&mut self, origin: DVec2) {
        if !origin.is_finite() {
            return;
        }
        for (layer, modes) in self.layers.iter_mut().zip(&self.modes) {
            let tile = f64::from(modes.tile);
            layer.offset = DVec2::new(origin.x.rem_euclid(tile), origin.y.rem_euclid(tile)).as_vec2();
        }
        self.origin = origin;
        self.set_amplitudes(self.amplitudes().cloned());
    }

    /// Scales the waves over the world from now on, in every query; `None` leaves them as they are everywhere. The
    /// arrays ([`Self::fields`]) stay whole.
    pub fn set_amplitudes(&mut self, map: Option<Arc<AmplitudeMap>>) {
        self.map = map.map(|map| Placed::new(map, self.origin));
    }

    /// The map that scales the waves.
    pub fn amplitudes(&self) -> Option<&Arc<AmplitudeMap>> {
        self.map.as_ref().map(|placed| &placed.map)
    }

    pub(crate) fn layers(&self) -> Layers<'_> {
        Layers { layers: &self.layers, map: self.map.as_ref() }
    }

    /// The local origin within the tile of cascade `c`, metres: add it to a local position to get one in the arrays.
    ///
    /// # Panics
    /// If there is no such cascade.
    pub fn offset(&self, c: usize) -> Vec2 {
        self.layers[c].offset
    }

    /// The arrays of cascade `c`.
    ///
    /// # Panics
    /// If there is no such cascade.
    pub fn fields(&self, c: usize) -> CascadeFields<'_> {
        let fields = &self.layers[c].fields;
        CascadeFields {
            size: self.modes[c].size,
            tile: self.modes[c].tile,
            displacement: fields.displacement(),
            derivative: fields.derivative(),
            velocity: fields.velocity(),
        }
    }

    /// Significant wave height of the modes, metres: `4 sqrt(variance)`.
    pub fn significant_height(&self) -> f32 {
        (4.0 * self.variance.sqrt()) as f32
    }

    /// Period of the spectrum's peak, seconds.
    pub fn peak_period(&self) -> f32 {
        self.spectrum.peak_period() as f32
    }

    /// Wavenumber of the spectrum's peak, rad/m.
    pub fn peak_wavenumber(&self) -> f32 {
        self.spectrum.peak_wavenumber() as f32
    }

    /// Wavelength of the spectrum's peak, metres.
    pub fn peak_wavelength(&self) -> f32 {
        (TAU / self.spectrum.peak_wavenumber()) as f32
    }

    /// Speed of the crests of the peak, m/s.
    pub fn peak_phase_speed(&self) -> f32 {
        let k = self.spectrum.peak_wavenumber();
        (dispersion::frequency(k, self.spectrum.depth()) / k) as f32
    }

    /// Mean square slope of the waves shorter than twice the footprint (metres), those beyond the finest texel
    /// included; see [`WaveSpectrum::hidden_slope`].
    pub fn hidden_slope(&self, footprint: f32) -> f32 {
        self.spectrum.hidden_slope(footprint.into()) as f32
    }
}
