//! The description of a sea.

use crate::error::check;
use crate::modes::Amplitudes;
use crate::query::largest::Queries;
use crate::{OceanError, SeaState};

/// One cascade: a periodic square of sea that carries one band of wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CascadeDesc {
    /// Cells per side: a power of two from 16 to 1,024.
    pub size: u32,
    /// Side, metres, .5 to 100,000.
    pub tile: f32,
    /// Seconds between states of the arrays that are mixed to any time between, 0 to 1; 0, the default, makes every
    /// time exactly. For a cascade of long waves on a busy CPU: .1 s takes a third less time on the longest of the
    /// default cascades and misses by .05 % of the significant height, for two more copies of its arrays. A query at
    /// some other time makes two states. The GPU's fields and a sea while it changes are exact all the same.
    pub interval: f32,
}

impl CascadeDesc {
    /// A cascade of so many cells per side on a tile of that side, metres, exact at every time.
    pub fn new(size: u32, tile: f32) -> Self {
        Self { size, tile, interval: 0.0 }
    }
}

/// Description of a sea.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// Whether waves of one kind are equally high or random.
    pub amplitudes: Amplitudes,
    /// How queries are answered.
    pub queries: Queries,
}

impl Default for OceanDesc {
    /// The default sea state on three cascades, chop 1, a loop of 17 minutes.
    fn default() -> Self {
        let cascade = |tile| CascadeDesc::new(256, tile);
        Self {
            sea: SeaState::default(),
            seed: 0,
            cascades: vec![cascade(485.0), cascade(72.4), cascade(10.8)],
            choppiness: 1.0,
            loop_time: 1024.0,
            amplitudes: Amplitudes::Unit,
            queries: Queries::Arrays,
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
            check("cascade interval", c.interval.into(), (0.0..=1.0).contains(&c.interval), "0 to 1 s")?;
            last = c.tile;
        }
        if let Queries::Largest(count) = self.queries {
            check("queries", count.into(), (1..=4096).contains(&count), "1 to 4096 waves")?;
        }
        check("choppiness", self.choppiness.into(), (0.0..=2.0).contains(&self.choppiness), "0 to 2")?;
        check("loop_time", self.loop_time, (10.0..=10e3).contains(&self.loop_time), "10 to 10000 s")
    }
}
