//! The sea in an oceanographer's words: partitions (wind sea, swells) and the depth.

use std::path::Path;

use crate::error::check;
use crate::{OceanError, file};

/// A sea state: the sum of its partitions over water of one depth.
#[derive(Debug, Clone, PartialEq)]
pub struct SeaState {
    /// Wind sea and swells, summed.
    pub partitions: Vec<Partition>,
    /// Water depth for the dispersion, metres, .5 to 20,000; `None` is deep water. The density over frequency is taken
    /// as given, so the wavelengths get shorter but the heights do not change.
    pub depth: Option<f32>,
}

/// One system of waves.
#[derive(Debug, Clone, PartialEq)]
pub struct Partition {
    /// Variance over frequency.
    pub spectrum: Spectrum,
    /// Direction the waves travel towards: (cos, sin) in (x, z), radians. Unused by [`Spectrum::Table`].
    pub direction: f32,
    /// Variance over direction. Unused by [`Spectrum::Table`].
    pub spreading: Spreading,
}

/// Distribution of variance over frequency.
#[derive(Debug, Clone, PartialEq)]
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
}

/// A row of a measured spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
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
#[non_exhaustive]
pub enum Spreading {
    /// `cos^2s(theta/2)` (Longuet-Higgins et al. 1963).
    Cos2s {
        /// Exponent, 0 (all directions alike) to 1,000 (almost one direction); wind seas 2 to 10, swell 20 to 100.
        s: f32,
    },
    /// `cos^2(theta)/pi`: as much against the direction as along it (Tessendorf 2001).
    BothWays,
}

/// Spreading of a wind sea when nothing else is said: a circular deviation of 31 degrees.
pub(crate) const WIND_SEA_S: f32 = 6.0;

impl Default for SeaState {
    /// Wind of 10 m/s over 100 km: Hs 2.1 m, Tp 6.2 s.
    fn default() -> Self {
        Self::wind(10.0, 100e3, 0.0)
    }
}

impl SeaState {
    /// JONSWAP wind sea: wind speed at 10 m in m/s, fetch in metres, direction towards which it blows in radians.
    pub fn wind(wind_speed: f32, fetch: f32, direction: f32) -> Self {
        Self::single(Spectrum::JonswapFetch { wind_speed, fetch }, direction, Spreading::Cos2s { s: WIND_SEA_S })
    }

    /// JONSWAP (gamma 3.3) by significant height in metres and peak period in seconds.
    pub fn height_period(significant_height: f32, peak_period: f32, direction: f32) -> Self {
        let spectrum = Spectrum::Jonswap { significant_height, peak_period, gamma: 3.3 };
        Self::single(spectrum, direction, Spreading::Cos2s { s: WIND_SEA_S })
    }

    /// Phillips as in Tessendorf 2001, with the height of the fully grown sea of that wind (.21 U^2/g).
    pub fn phillips(wind_speed: f32, direction: f32) -> Self {
        let significant_height = 0.21 * wind_speed * wind_speed / crate::GRAVITY as f32;
        Self::single(Spectrum::Phillips { wind_speed, significant_height }, direction, Spreading::BothWays)
    }

    /// A sea of one partition over deep water.
    pub fn single(spectrum: Spectrum, direction: f32, spreading: Spreading) -> Self {
        Self { partitions: vec![Partition { spectrum, direction, spreading }], depth: None }
    }

    /// Reads a sea file; the format is described at [`SeaState::parse`].
    ///
    /// # Errors
    /// The file cannot be read, is not UTF-8 or exceeds 1 MiB; otherwise as [`SeaState::parse`].
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, OceanError> {
        file::read(path.as_ref())
    }

    /// Reads a sea from text; `name` is what errors call the file.
    ///
    /// `#` starts a comment. A file is `key = value` lines, then, optionally, a table.
    ///
    /// Keys of a partition: `spectrum` (`phillips`, `pierson-moskowitz`, `jonswap`), `wind` m/s, `fetch` m, `hs` m,
    /// `tp` s, `gamma`, `direction` (degrees clockwise from north that the waves come from: 270 travels towards +x),
    /// `s` (exponent of the cos^2s spreading). JONSWAP takes `wind` and `fetch`, or `hs` and `tp`. A line
    /// `[any name]` starts another partition. `depth` (m) holds for the whole sea.
    ///
    /// A table starts with a line of column names in any order: `frequency` (Hz), `density` (m^2/Hz), `direction`
    /// (as above), and `spread` (circular standard deviation, degrees) or `r1` (first Fourier coefficient, as NDBC
    /// publishes it); then a row a line, frequencies ascending.
    ///
    /// # Errors
    /// [`OceanError::File`] with line, what was found and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Self, OceanError> {
        file::parse(name, text)
    }

    /// Checks every value of the description.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] for the first value out of its bound.
    pub fn validate(&self) -> Result<(), OceanError> {
        let n = self.partitions.len();
        check("partitions", n as f64, (1..=16).contains(&n), "1 to 16")?;
        if let Some(depth) = self.depth {
            check("depth", depth.into(), (0.5..=20e3).contains(&depth), "0.5 to 20000 m")?;
        }
        self.partitions.iter().try_for_each(Partition::validate)
    }
}

impl Partition {
    fn validate(&self) -> Result<(), OceanError> {
        check("direction", self.direction.into(), self.direction.abs() <= 1e3, "a finite angle in radians")?;
        if let Spreading::Cos2s { s } = self.spreading {
            check_s(s)?;
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
