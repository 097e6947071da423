//! Rain: drops that a seed and the number of the tick decide, block by block of the world.

use std::f64::consts::PI;

use glam::{DVec2, Vec2};

use super::Source;
use crate::Window;

/// Mean number of drops of a block and tick that blocks are sized for.
const PER_BLOCK: f64 = 2.0;
/// Water that a drop throws out of its crater, in volumes of the drop: a hemisphere whose potential energy is a quarter of
/// the drop's kinetic energy at terminal speed. That gives 150 to 200 for radii of 0.5 to 2 mm.
const CRATER: f32 = 180.0;
/// Most that are drawn for one.
const MOST: u32 = 4096;

/// Rain that falls on the whole world: drops as a Poisson process in space and time.
///
/// A drop of a tick falls at the same world place wherever a window stands and however large it is.
///
/// ```
/// use wave_grid::{GridDesc, Rain, WaveGrid};
///
/// let mut grid = WaveGrid::new(GridDesc { cell_size: [0.02; 2], wave_speed: 0.5, ..Default::default() })?;
/// let rain = Rain { rate: 20.0, drop_radius: 0.0015, seed: 7 };
/// let fallen: usize = (0..60).map(|tick| { let fallen = grid.add_rain(&rain, tick); grid.tick(); fallen }).sum();
/// // 20 mm/h of drops of 14 cubic millimetres: 393 a second on each square metre.
/// assert!((6000..10000).contains(&fallen));
/// # Ok::<(), wave_grid::GridError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rain {
    /// Water that falls, mm/h. Drizzle brings 1, heavy rain 20, a cloudburst 100.
    pub rate: f32,
    /// Radius of a drop, metres. Most rain falls in drops of 0.5 to 2.5 mm.
    pub drop_radius: f32,
    /// Which rain of all that are alike.
    pub seed: u64,
}

impl Rain {
    /// Volume of a drop, cubic metres.
    pub fn drop_volume(&self) -> f32 {
        let radius = f64::from(self.drop_radius);
        (4.0 / 3.0 * PI * radius * radius * radius) as f32
    }

    /// Mean number of drops per square metre and second; zero when a number is not positive and finite.
    pub fn density(&self) -> f64 {
        let density = f64::from(self.rate) / 3.6e6 / f64::from(self.drop_volume());
        if density.is_finite() && self.rate > 0.0 { density.max(0.0) } else { 0.0 }
    }

    /// The drops of a tick of `seconds` that fall into a window, as [`Source::Drop`]s in local coordinates about `origin`:
    /// a crater moves 180 times the drop's own water, which itself is left out.
    pub fn drops(&self, window: &Window, origin: DVec2, tick: u64, seconds: f32) -> impl Iterator<Item = Source> {
        let low = window.world_corner();
        let extent = DVec2::new(f64::from(window.cells[0]), f64::from(window.cells[1])) * window.h();
        let high = low + extent;
        let (radius, volume) = (self.drop_radius, CRATER * self.drop_volume());
        let falls = Falls::new(self, tick, seconds);
        let blocks = |low: f64, high: f64| match falls {
            Some(falls) => (low / falls.side).floor() as i64..(high / falls.side).ceil() as i64,
            None => 0..0,
        };
        let (across, along) = (blocks(low.x, high.x), blocks(low.y, high.y));
        let all = along.flat_map(move |z| across.clone().map(move |x| [x, z]));
        all.flat_map(move |block| falls.into_iter().flat_map(move |falls| falls.of(block)))
            .filter(move |place| place.cmpge(low).all() && place.cmplt(high).all())
            .map(move |place| {
                let local = place - origin;
                Source::Drop { center: Vec2::new(local.x as f32, local.y as f32), radius, volume }
            })
    }
}

/// The drops of one tick.
#[derive(Debug, Clone, Copy)]
struct Falls {
    /// Side of a block, a power of two, metres.
    side: f64,
    /// Mean number of a block's drops.
    mean: f64,
    /// exp(-mean).
    none: f64,
    key: u64,
}

impl Falls {
    fn new(rain: &Rain, tick: u64, seconds: f32) -> Option<Self> {
        let per_area = rain.density() * f64::from(seconds);
        if !(per_area > 0.0 && per_area.is_finite()) {
            return None;
        }
        // The same for every window: it follows from the rain and the tick alone.
        let mut side = 1024.0;
        while side * side * per_area > PER_BLOCK && side > 1.0 / 1024.0 {
            side *= 0.5;
        }
        let mean = (side * side * per_area).min(0.25 * f64::from(MOST));
        Some(Self { side, mean, none: libm::exp(-mean), key: mix(mix(rain.seed) ^ tick) })
    }

    /// World places of a block's drops.
    fn of(self, block: [i64; 2]) -> impl Iterator<Item = DVec2> {
        let mut state = mix(mix(self.key ^ block[0] as u64) ^ block[1] as u64);
        let mut uniform = move || {
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            (mix(state) >> 11) as f64 / (1u64 << 53) as f64
        };
        // Poisson's distribution inverted.
        let (mut left, mut share, mut count) = (uniform(), self.none, 0);
        while left >= share && count < MOST {
            left -= share;
            count += 1;
            share *= self.mean / f64::from(count);
        }
        let corner = DVec2::new(block[0] as f64, block[1] as f64);
        (0..count).map(move |_| (corner + DVec2::new(uniform(), uniform())) * self.side)
    }
}

/// The finalizer of SplitMix64.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}
