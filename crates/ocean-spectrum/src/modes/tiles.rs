//! Tiles that suit a sea.

use std::f64::consts::TAU;

use crate::modes::BAND_START;
use crate::{CascadeDesc, OceanDesc, SeaState, WaveSpectrum, dispersion};

/// Share of the variance in the waves of the first tile. The surface correlates with itself, one of the smaller tiles
/// further on, by about the rest; beyond 2 km, where the first tile ends if its cells allow, by this.
const FIRST: f64 = 0.66;
/// Share of the variance in waves so long that the first tile need not be 2.5 times as long.
const LONG: f64 = 0.01;
/// Side of the first tile beyond which its repetition is no concern, metres.
const FAR: f64 = 2200.0;
/// Cells for each of its own band's shortest waves that a longer tile has where a shorter one follows, about: the first
/// tile, and the others (the cubic kernel loses 3 and 2 % of those waves).
const CELLS: [f64; 2] = [5.3, 6.3];
/// Shortest wave that is worth holding, metres: what is shorter shows as roughness.
const SHORTEST: f64 = 0.1;
/// Most cascades.
const MOST: usize = 8;

impl OceanDesc {
    /// A description whose tiles suit the sea, all of `size` texels a side (a power of two from 32 to 1,024): the height
    /// and period of the sea are right whatever its waves' length, waves down to 10 cm are held (to a fiftieth of the main
    /// waves' length if that is less; with 64 texels or fewer not that far in a long sea), and it repeats little: the
    /// first tile takes two thirds of the variance and is 2 km long or, where the size does not allow that, as long as it
    /// does (34 peak wavelengths for 256 texels); the second takes nearly all of the rest, and the ratio of the two is far
    /// from whole. Waves of 250 m and more stand on one tile of 2 km or more.
    ///
    /// For 256 texels it takes three to five cascades, mostly four. The tiles depend on the size: for a
    /// server of the same sea with smaller transforms, lessen the sizes of the cascades made for the client.
    ///
    /// Everything else is as [`OceanDesc::default`] has it. A sea that cannot be used gets the default tiles, and
    /// [`Ocean::new`](crate::Ocean::new) refuses it.
    pub fn for_sea(sea: SeaState, size: u32) -> Self {
        let default = Self::default();
        let cascades = match WaveSpectrum::new(&sea) {
            Ok(spectrum) => tiles(&spectrum, size.clamp(16, 1024).into()),
            Err(_) => default.cascades.iter().map(|cascade| f64::from(cascade.tile)).collect(),
        };
        let cascades = cascades.into_iter().map(|tile| CascadeDesc::new(size, tile as f32)).collect();
        Self { sea, cascades, ..default }
    }
}

/// Sides of the tiles, longest first.
fn tiles(spectrum: &WaveSpectrum, size: f64) -> Vec<f64> {
    let [longest, main] = wavelengths(spectrum);
    let second = BAND_START * main;
    let mut tiles = if second < 0.5 * FAR {
        // Ratios of .6 behind a whole number: the two lattices meet far off only.
        let by_cells = libm::round(size / BAND_START / CELLS[0]);
        let by_length = libm::ceil((FAR / second).max(1.5 * BAND_START));
        let ratio = by_cells.min(by_length).max(2.0) - 0.382;
        let first = (ratio * second).max(2.5 * longest).max(0.7);
        vec![first, second.max(first / (ratio + 1.0)).min(0.8 * first)]
    } else {
        // Waves so long that a tile of all of them reaches far enough.
        vec![(1.5 * second).max(FAR).max(2.5 * longest).min(100e3)]
    };
    tiles.retain(|tile| *tile >= 0.5);
    let start = tiles[tiles.len() - 1];
    let shortest = SHORTEST.min(main / 50.0);
    let last = (0.5 * size * shortest).max(0.5);
    let most = (size / BAND_START / CELLS[1]).max(2.2);
    let span = libm::log(start / last);
    let steps = libm::ceil(span / libm::log(most) - 0.2).clamp(0.0, (MOST - tiles.len()) as f64);
    let step = libm::exp(span / steps.max(1.0)).min(most);
    // Too near the one before, the last is not worth its cost.
    let steps = if step < 1.3 { 0 } else { steps as i32 };
    let shorter = (1..=steps).map(|i| start / libm::pow(step, f64::from(i)));
    tiles.extend(shorter.filter(|tile| *tile >= 0.5));
    tiles
}

/// Wavelengths below which the shares [`LONG`] and [`FIRST`] of the variance lie, counted from the longest.
fn wavelengths(spectrum: &WaveSpectrum) -> [f64; 2] {
    let (low, high, steps) = (libm::log(0.05), libm::log(80.0), 4000);
    let step = (high - low) / f64::from(steps);
    let mut sum = 0.0;
    let mut found = [0.0; 2];
    for i in 0..steps {
        let omega = libm::exp(low + step * (f64::from(i) + 0.5));
        sum += spectrum.frequency_density(omega) * omega * step;
        for (found, share) in found.iter_mut().zip([LONG, FIRST]) {
            if *found == 0.0 && sum >= share * spectrum.variance() {
                *found = TAU / dispersion::wavenumber(omega, spectrum.depth());
            }
        }
    }
    // A sea of ripples alone, or of a swell at the end of the table, still has tiles.
    found.map(|length| length.clamp(0.05, 50e3))
}
