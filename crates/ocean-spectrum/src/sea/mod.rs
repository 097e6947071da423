//! The sea in an oceanographer's words: partitions (wind sea, swells) and the depth.

pub(crate) mod partition;
pub(crate) mod plane;
pub(crate) mod shape;
pub(crate) mod shoal;
pub(crate) mod spectrum;
pub(crate) mod spreading;
pub(crate) mod tail;

use std::path::Path;

use crate::error::check;
use crate::sea::partition::{Partition, Spectrum, Spreading, WIND_SEA_S};
use crate::{OceanError, files as file, files::ndbc};

/// A sea state: the sum of its partitions over water of one depth.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SeaState {
    /// Wind sea and swells, summed.
    pub partitions: Vec<Partition>,
    /// Water depth for the dispersion, metres, .5 to 20,000; `None` is deep water. The density over frequency is taken
    /// as given, so the wavelengths get shorter but the heights do not change, unless a partition is `depth_limited`.
    pub depth: Option<f32>,
}

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
        Self::jonswap(significant_height, peak_period, 3.3, direction)
    }

    /// TMA: the wind sea of [`SeaState::wind`] over water of a finite depth, metres, which lessens its long waves.
    pub fn tma(wind_speed: f32, fetch: f32, direction: f32, depth: f32) -> Self {
        let mut sea = Self { depth: Some(depth), ..Self::wind(wind_speed, fetch, direction) };
        sea.partitions[0].depth_limited = true;
        sea
    }

    /// JONSWAP by significant height in metres, peak period in seconds and peak enhancement (1 to 20), direction in
    /// radians.
    pub fn jonswap(significant_height: f32, peak_period: f32, gamma: f32, direction: f32) -> Self {
        let spectrum = Spectrum::Jonswap { significant_height, peak_period, gamma };
        Self::single(spectrum, direction, Spreading::Cos2s { s: WIND_SEA_S })
    }

    /// Phillips as in Tessendorf 2001, with the height of the fully grown sea of that wind (.21 U^2/g).
    pub fn phillips(wind_speed: f32, direction: f32) -> Self {
        let significant_height = 0.21 * wind_speed * wind_speed / crate::GRAVITY as f32;
        Self::single(Spectrum::Phillips { wind_speed, significant_height }, direction, Spreading::BothWays)
    }

    /// A sea of one partition over deep water.
    pub fn single(spectrum: Spectrum, direction: f32, spreading: Spreading) -> Self {
        Self { partitions: vec![Partition::new(spectrum, direction, spreading)], depth: None }
    }

    /// The same sea with [swell](Partition::swell) on top.
    pub fn with_swell(self, significant_height: f32, peak_period: f32, direction: f32) -> Self {
        self.with(Partition::swell(significant_height, peak_period, direction))
    }

    /// The same sea with one more partition.
    pub fn with(mut self, partition: Partition) -> Self {
        self.partitions.push(partition);
        self
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
    /// `#` starts a comment. A file is `key = value` lines, then, optionally, tables.
    ///
    /// Keys of a partition: `spectrum` (`phillips`, `pierson-moskowitz`, `jonswap`, `tma`), `wind` m/s, `fetch` m, `hs` m,
    /// `tp` s, `gamma`, `direction` (degrees clockwise from north that the waves come from: 270 travels towards +x),
    /// `spreading` (`cos2s`, `both-ways`, `hasselmann`, `donelan-banner`), `s` (exponent of cos2s), `elongation`,
    /// `tail` (`of-spectrum`, `donelan`, `elfouhaily`), `depth-limited` (`yes`, `no`; `tma` is `jonswap` with `yes`).
    /// JONSWAP takes `wind` and `fetch`, or `hs` and `tp` (and `wind` too where `hasselmann` or `elfouhaily` need it). A
    /// line `[any name]` starts another partition. `depth` (m) holds for the whole sea.
    ///
    /// A table starts with a line of column names in any order: `frequency` (Hz), `density` (m^2/Hz), `direction`
    /// (as above), and `spread` (circular standard deviation, degrees) or `r1` (first Fourier coefficient, as NDBC
    /// publishes it); then a row a line, frequencies ascending.
    ///
    /// A table over frequency and direction starts with a line `directions` and 4 to 720 compass degrees that the waves
    /// come from, ascending within one turn, evenly or not; then a row a line: a frequency (Hz) and, for each direction, a
    /// density, m^2/Hz/degree. See [`DirectionalTable`](crate::DirectionalTable).
    ///
    /// # Errors
    /// [`OceanError::File`] with line, what was found and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Self, OceanError> {
        file::parse(name, text)
    }

    /// Reads the newest spectrum that three files of a buoy of the National Data Buoy Center have in common, in their
    /// layout in real time: `.data_spec` (densities), `.swdir` (directions) and `.swr1` (widths).
    ///
    /// A frequency whose density is missing (999.0) is left out; one whose direction or width is missing, as where there
    /// is nothing to measure, takes that of the nearest frequency that has it.
    ///
    /// # Errors
    /// [`OceanError::File`] with file, line, what was found and what is allowed.
    pub fn from_ndbc(data_spec: &str, swdir: &str, swr1: &str) -> Result<Self, OceanError> {
        ndbc::parse(data_spec, swdir, swr1)
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
