//! One system of waves: how its variance lies over frequency and direction.

use crate::error::check;
use crate::{DirectionalTable, OceanError};

/// One system of waves.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Partition {
    /// Variance over frequency.
    pub spectrum: Spectrum,
    /// Direction the waves travel towards: (cos, sin) in (x, z), radians. Unused by measured spectra.
    pub direction: f32,
    /// Variance over direction. Unused by measured spectra.
    pub spreading: Spreading,
    /// How far the waves have sorted themselves into long crests, `xi` of Horvath 2015: 0 (wind sea) to 1 (old swell). The
    /// spreading is multiplied by `cos^2s(theta/2)` with `s = 16 tanh(peak/omega) xi^2`. Unused by measured spectra.
    pub elongation: f32,
    /// Whether the sea's depth takes its share (Kitaigorodskii et al. 1975, see [`depth_share`](crate::depth_share)) of
    /// the density, which is then that over deep water: JONSWAP becomes TMA (Bouws et al. 1985).
    pub depth_limited: bool,
    /// What the short waves follow.
    pub tail: Tail,
}

/// Distribution of variance over frequency.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Spectrum {
    /// Phillips as Tessendorf uses it, `exp(-1/(kL)^2)/k^4` with `L = U^2/g`. His free constant has no measurable
    /// meaning and depends on the tile; here it follows from the wave height: `A = Hs^2/(8 pi L^2)` as a density over
    /// the wavenumber plane (with [`Spreading::BothWays`], his directional factor).
    Phillips {
        /// Wind speed, m/s, .5 to 80.
        wind_speed: f32,
        /// Significant wave height, metres, above 0 to 40.
        significant_height: f32,
    },
    /// Pierson-Moskowitz (1964): the fully grown sea.
    PiersonMoskowitz {
        /// Wind speed at 19.5 m, m/s, .5 to 80.
        wind_speed: f32,
    },
    /// JONSWAP by wind and fetch (Hasselmann et al. 1973), gamma 3.3.
    JonswapFetch {
        /// Wind speed at 10 m, m/s, .5 to 80.
        wind_speed: f32,
        /// Distance over which the wind has blown, metres, from 100; used up to about 17,000 U^2/g
        /// (see [`Notice::FetchClamped`](crate::Notice)).
        fetch: f32,
    },
    /// JONSWAP shape by height and period.
    Jonswap {
        /// Significant wave height, metres, above 0 to 40.
        significant_height: f32,
        /// Peak period, seconds, .5 to 40.
        peak_period: f32,
        /// Peak enhancement, 1 to 20; 1 is the shape of Pierson-Moskowitz.
        gamma: f32,
    },
    /// A measured spectrum, frequencies ascending, at least 3 rows. Linear between rows, zero below the first,
    /// continued above the last by a frequency^-5 tail.
    Table(Vec<TableRow>),
    /// A measured spectrum over frequency and direction.
    Directional(DirectionalTable),
}

/// A row of a measured spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TableRow {
    /// Frequency, Hz, above 0 to 5.
    pub frequency: f32,
    /// Variance density, m^2/Hz, from 0.
    pub density: f32,
    /// Direction the waves travel towards: (cos, sin) in (x, z), radians.
    pub direction: f32,
    /// Exponent of the cos^2s spreading at this frequency, 0 to 1,000.
    pub s: f32,
}

/// Distribution of variance over direction; each integrates to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Spreading {
    /// `cos^2s(theta/2)` (Longuet-Higgins et al. 1963), alike at all frequencies.
    Cos2s {
        /// Exponent, 0 (all directions alike) to 1,000 (almost one direction); wind seas 2 to 10, swell 20 to 100.
        s: f32,
    },
    /// `cos^2(theta)/pi`: as much against the direction as along it (Tessendorf 2001).
    BothWays,
    /// `cos^2s(theta/2)`, narrowest near the peak (Hasselmann, Dunckel, Ewing 1980): `s = 6.97 r^4.06` up to `r = 1.05`
    /// peak frequencies, `9.77 r^(-2.33 - 1.45 (U/c - 1.17))` above, c the speed of the peak's waves.
    Hasselmann {
        /// Wind speed at 10 m, m/s, .5 to 80.
        wind_speed: f32,
    },
    /// `beta sech^2(beta theta) / (2 tanh(beta pi))` (Donelan, Hamilton, Hui 1985; beyond 1.6 peak frequencies Banner
    /// 1990): beta 2.44 just below the peak, less on both sides.
    DonelanBanner,
}

/// What the density of waves well above the peak follows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Tail {
    /// The spectrum's own formula: `omega^-5`, or for measured ones that from the last row.
    #[default]
    OfSpectrum,
    /// `omega^-4` from 1.5 to 3.5 peak frequencies (Donelan, Hamilton, Hui 1985), then `omega^-5`: up to 1.8 times the
    /// short waves of JONSWAP. A height given is kept. Measured spectra take it after their last row.
    Donelan,
    /// The short waves of Elfouhaily et al. (1997), by wind alone: ripples that a rising wind roughens. They take over
    /// between 10 peak wavenumbers and 90 rad/m (waves of 7 cm); measured spectra keep theirs up to the last row.
    Elfouhaily {
        /// Wind speed at 10 m, m/s, .5 to 80.
        wind_speed: f32,
    },
}

/// Spreading of a wind sea when nothing else is said: a circular deviation of 31 degrees.
pub(crate) const WIND_SEA_S: f32 = 6.0;

impl Partition {
    /// Waves with a spectrum, towards a direction (radians, (cos, sin) in (x, z)), with a spreading; the rest as plain as
    /// can be.
    pub fn new(spectrum: Spectrum, direction: f32, spreading: Spreading) -> Self {
        Self { spectrum, direction, spreading, elongation: 0.0, depth_limited: false, tail: Tail::OfSpectrum }
    }

    /// Swell from afar: a narrow JONSWAP (gamma 7) by significant height in metres and peak period in seconds, with
    /// long crests (s = 30, a circular deviation of 15 degrees), towards a direction in radians.
    pub fn swell(significant_height: f32, peak_period: f32, direction: f32) -> Self {
        let spectrum = Spectrum::Jonswap { significant_height, peak_period, gamma: 7.0 };
        Self::new(spectrum, direction, Spreading::Cos2s { s: 30.0 })
    }

    pub(crate) fn validate(&self) -> Result<(), OceanError> {
        check("direction", self.direction.into(), self.direction.abs() <= 1e3, "a finite angle in radians")?;
        check("elongation", self.elongation.into(), (0.0..=1.0).contains(&self.elongation), "0 to 1")?;
        match self.spreading {
            Spreading::Cos2s { s } => check_s(s)?,
            Spreading::Hasselmann { wind_speed } => check_wind(wind_speed)?,
            Spreading::BothWays | Spreading::DonelanBanner => {}
        }
        if let Tail::Elfouhaily { wind_speed } = self.tail {
            check_wind(wind_speed)?;
        }
        match &self.spectrum {
            &Spectrum::Phillips { wind_speed, significant_height } => {
                check_wind(wind_speed)?;
                check_height(significant_height)
            }
            &Spectrum::PiersonMoskowitz { wind_speed } => check_wind(wind_speed),
            &Spectrum::JonswapFetch { wind_speed, fetch } => {
                check_wind(wind_speed)?;
                check("fetch", fetch.into(), fetch >= 100.0, "from 100 m")
            }
            &Spectrum::Jonswap { significant_height, peak_period, gamma } => {
                check_height(significant_height)?;
                check("peak_period", peak_period.into(), (0.5..=40.0).contains(&peak_period), "0.5 to 40 s")?;
                check("gamma", gamma.into(), (1.0..=20.0).contains(&gamma), "1 to 20")
            }
            Spectrum::Table(rows) => validate_table(rows),
            // Checked when it was made.
            Spectrum::Directional(_) => Ok(()),
        }
    }
}

fn check_s(s: f32) -> Result<(), OceanError> {
    check("s", s.into(), (0.0..=1000.0).contains(&s), "0 to 1000")
}

fn check_wind(wind: f32) -> Result<(), OceanError> {
    check("wind_speed", wind.into(), (0.5..=80.0).contains(&wind), "0.5 to 80 m/s")
}

fn check_height(height: f32) -> Result<(), OceanError> {
    check("significant_height", height.into(), height > 0.0 && height <= 40.0, "above 0 to 40 m")
}

fn validate_table(rows: &[TableRow]) -> Result<(), OceanError> {
    check("table rows", rows.len() as f64, (3..=4096).contains(&rows.len()), "3 to 4096")?;
    let mut last = 0.0;
    for row in rows {
        let f = row.frequency;
        check("frequency", f.into(), f > last && f <= 5.0, "above the row before (and 0), up to 5 Hz")?;
        check("density", row.density.into(), (0.0..=1e6).contains(&row.density), "0 to 1e6 m^2/Hz")?;
        check("direction", row.direction.into(), row.direction.abs() <= 1e3, "a finite angle in radians")?;
        check_s(row.s)?;
        last = f;
    }
    let peak = rows.iter().map(|row| row.density).fold(0.0, f32::max);
    check("largest density", peak.into(), peak > 0.0, "above 0")
}
