//! Case `repeat`: how much of the sea comes back some way off, because its tiles are finite.

use ocean_spectrum::{CascadeDesc, CascadeModes, Ocean, OceanDesc, SeaState};
use rayon::prelude::*;
use rustfft::{FftPlanner, num_complex::Complex64};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    fixtures,
};

/// See the module.
pub(super) const REPEAT: Case = Case {
    name: "repeat",
    about: "largest autocorrelation of the surface beyond 4 peak wavelengths, up to 2 km, by choice of tiles",
    plots: &[Plot {
        file: "repeat",
        title: "Largest autocorrelation from 4 peak wavelengths to 2 km (beside the points: cascades)",
        x: Axis::Param("first_tile_m"),
        y: Axis::Error,
        label: Some("cascades"),
    }],
    run: repeat,
};

/// Farthest lag, m.
const FAR: f64 = 2000.0;
/// Shortest lag, peak wavelengths.
const NEAR: f64 = 4.0;

fn repeat(context: &Context) -> Result<Vec<Row>, CaseError> {
    let sea = || fixtures::ocean(256).sea;
    let tiles = |tiles: &[f32]| OceanDesc {
        cascades: tiles.iter().map(|tile| CascadeDesc::new(256, *tile)).collect(),
        ..fixtures::ocean(256)
    };
    let chosen = |sea, size| OceanDesc::for_sea(sea, size);
    let mut sets = vec![
        ("one tile", tiles(&[485.0]), None),
        ("ratio 6.7 (the first is the default)", tiles(&[485.0, 72.4, 10.8]), None),
        ("ratio 6.7 (the first is the default)", tiles(&[970.0, 145.0, 21.6]), None),
        ("ratio 6.7 (the first is the default)", tiles(&[1940.0, 290.0, 43.0]), None),
        ("a whole ratio of 7", tiles(&[1911.0, 273.0, 59.0, 12.8]), None),
        ("chosen for the sea", chosen(sea(), 128), None),
        ("chosen for the sea", chosen(sea(), 256), Some(0.35)),
        ("chosen for a swell of 14 s", chosen(SeaState::height_period(2.0, 14.0, 0.0), 256), Some(0.35)),
        ("chosen for a lake, waves of 8 m", chosen(SeaState::wind(5.0, 10e3, 0.0), 256), None),
    ];
    if !context.quick {
        sets.push(("chosen for the sea", chosen(sea(), 64), None));
        sets.push(("chosen for the sea", chosen(sea(), 512), Some(0.35)));
    }
    let mut rows = Vec::new();
    for (name, desc, bound) in sets {
        let ocean = Ocean::new(desc)?;
        let (peak, x, z) = peak(&ocean);
        let tiles: Vec<_> = ocean.modes().iter().map(|modes| modes.tile.round().to_string()).collect();
        let row = Row::new("repeat", name)
            .param("cascades", tiles.len())
            .param("size", ocean.modes()[0].size)
            .param("tiles_m", tiles.join(" "))
            .param("first_tile_m", f64::from(ocean.modes()[0].tile).round())
            .param("lag_m", x.hypot(z).round())
            .error(100.0 * peak, "% of the variance", "0, a sea that never repeats");
        rows.push(bound.map_or(row.clone(), |bound| row.bound(100.0 * bound)));
    }
    Ok(rows)
}

/// Largest autocorrelation by magnitude in the range of lags, and the lag.
fn peak(ocean: &Ocean) -> (f64, f64, f64) {
    let tables: Vec<_> = ocean.modes().iter().map(Table::new).collect();
    let whole: f64 = ocean.modes().iter().map(CascadeModes::variance).sum();
    let at = |x: f64, z: f64| tables.iter().map(|table| table.at(x, z)).sum::<f64>() / whole;
    let length = f64::from(ocean.peak_wavelength());
    let within = |x: f64, z: f64| (NEAR * length..=FAR).contains(&x.hypot(z));
    let step = length / 12.0;
    let steps = (FAR / step) as i32;
    // The autocorrelation is even: half of the plane.
    let best = (0..=steps)
        .into_par_iter()
        .map(|j| {
            let z = f64::from(j) * step;
            let lags = (-steps..=steps).map(|i| f64::from(i) * step).filter(|x| within(*x, z));
            lags.map(|x| (at(x, z).abs(), x, z)).fold((0.0, 0.0, 0.0), larger)
        })
        .reduce(|| (0.0, 0.0, 0.0), larger);
    // Climb from the best node.
    let (mut best, mut step) = (best, step);
    while step > 0.01 * length {
        let around = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)];
        let next = around
            .map(|(dx, dz)| (best.1 + dx, best.2 + dz))
            .into_iter()
            .filter(|(x, z)| within(*x, *z))
            .map(|(x, z)| (at(x, z).abs(), x, z))
            .fold(best, larger);
        if next == best {
            step *= 0.5;
        }
        best = next;
    }
    best
}

fn larger(a: (f64, f64, f64), b: (f64, f64, f64)) -> (f64, f64, f64) {
    if b.0 > a.0 { b } else { a }
}

/// Autocorrelation of one cascade over its tile, on twice as many nodes as it has cells.
struct Table {
    size: usize,
    tile: f64,
    values: Vec<f64>,
}

impl Table {
    fn new(modes: &CascadeModes) -> Self {
        let (n, size) = (modes.size as usize, 2 * modes.size as usize);
        let mut data = vec![Complex64::default(); size * size];
        for (cell, amp) in modes.amp.iter().enumerate() {
            let place = |index: usize| modes.signed(index as u32).rem_euclid(size as i32) as usize;
            let power = 2.0 * (f64::from(amp[0]).powi(2) + f64::from(amp[1]).powi(2));
            data[place(cell / n) * size + place(cell % n)] = Complex64::new(power, 0.0);
        }
        let fft = FftPlanner::new().plan_fft_inverse(size);
        for _ in 0..2 {
            data.par_chunks_mut(size).for_each(|row| fft.process(row));
            data = (0..size * size).map(|at| data[at % size * size + at / size]).collect();
        }
        Self { size, tile: f64::from(modes.tile), values: data.iter().map(|value| value.re).collect() }
    }

    /// Bilinear between the nodes.
    fn at(&self, x: f64, z: f64) -> f64 {
        let scale = self.size as f64 / self.tile;
        let (x, z) = (x * scale, z * scale);
        let (tx, tz) = (x - x.floor(), z - z.floor());
        let wrap = |value: f64| (value as i64).rem_euclid(self.size as i64) as usize;
        let (i, j) = (wrap(x.floor()), wrap(z.floor()));
        let (i1, j1) = ((i + 1) % self.size, (j + 1) % self.size);
        let value = |i: usize, j: usize| self.values[j * self.size + i];
        let near = value(i, j) + tx * (value(i1, j) - value(i, j));
        let far = value(i, j1) + tx * (value(i1, j1) - value(i, j1));
        near + tz * (far - near)
    }
}
