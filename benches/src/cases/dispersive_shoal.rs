//! Case `shoaling_dispersive`: water waves that run from deep water up a slope, against linear theory.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec2;
use rustfft::num_complex::Complex;
use wave_grid::{Border, MediumCell, WaveGrid};

use super::dispersive_walls::{SIDE, WALLED, Water, beach, desc, paddle};
use crate::evidence::{Axis, Case, CaseError, Context, Plot, Row};

/// See the module.
pub(super) const SHOALING: Case = Case {
    name: "shoaling_dispersive",
    about: "height and length of water waves from 60 to 2 cells of depth, against linear theory",
    plots: &[Plot {
        file: "shoaling_dispersive",
        title: "Height of water waves up a slope, over that of linear theory less one",
        x: Axis::Param("depth_cells"),
        y: Axis::Error,
        label: None,
    }],
    run,
};

/// Depths before and after the slope, cells; even in the logarithm between, as long waves over it are to be.
const DEPTHS: [f64; 2] = [60.0, 2.0];

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    // Ticks a period: 16, 32, 64 and 96 cells a wave in deep water.
    for &period in context.pick(&[136usize][..], &[136, 193, 272, 333]) {
        rows.extend(shoal(period)?);
    }
    Ok(rows)
}

fn shoal(period: usize) -> Result<Vec<Row>, CaseError> {
    let omega = TAU / period as f64;
    let g = desc([48; 2], Border::Reflecting).stepping()?.a[0];
    let deep_length = TAU * g / (omega * omega);
    let ticks_per_s = 60.0;
    // Beach, wave maker, deep water, slope, shallow water, beach.
    let width = (3.0 * deep_length).max(80.0);
    let maker = width.round() as usize;
    let foot = maker + (2.5 * deep_length) as usize + 16;
    let top = foot + (8.0 * deep_length).max(240.0) as usize;
    let end = top + (1.5 * deep_length) as usize + 32;
    let nx = (end + width as usize).next_multiple_of(2);
    let depth_at = move |i: f64| {
        let part = ((i - foot as f64) / (top - foot) as f64).clamp(0.0, 1.0);
        DEPTHS[0] * (DEPTHS[1] / DEPTHS[0]).powf(part)
    };
    let mut grid = WaveGrid::new(desc([nx as u32, 48], Border::Reflecting))?;
    let low_x = grid.window().corner[0];
    let cell = f64::from(grid.desc().cell_size[0]);
    let most = 0.5 * omega * ticks_per_s;
    let at = move |place: DVec2| {
        let [i, j] = [place.x.floor() - low_x as f64, place.y.floor() + 24.0];
        if j < SIDE as f64 || j >= (48 - SIDE) as f64 {
            return WALLED;
        }
        let damping = beach(maker as f64 - i, width, most).max(beach(i - end as f64, width, most));
        MediumCell { depth: (depth_at(i) * cell) as f32, damping, ..MediumCell::default() }
    };
    grid.set_medium(Some(Arc::new(Water { cell, at })));
    grid.set_tile_skipping(false);
    // Group speed, cells a tick, and wavenumber, by depth.
    let theory = |depth: f64| {
        let own = omega * omega / g;
        let (mut low, mut high) = (own, own * (1.0 + 2.0 / (own * depth)));
        for _ in 0..60 {
            let k = 0.5 * (low + high);
            if k * (k * depth).tanh() < own { low = k } else { high = k }
        }
        let kh = low * depth;
        (0.5 * omega / low * (1.0 + 2.0 * kh / (2.0 * kh).sinh()), low)
    };
    let travel: f64 = (maker..end).map(|i| 1.0 / theory(depth_at(i as f64)).0).sum();
    let ticks = (1.15 * travel) as usize + 14 * period;
    let mut sums = vec![Complex::<f64>::default(); nx];
    for tick in 0..ticks {
        let phase = omega * tick as f64;
        let grown = (phase / (6.0 * TAU)).min(1.0);
        paddle(&mut grid, maker, 1e-3 * phase.sin() * grown * grown * (3.0 - 2.0 * grown))?;
        grid.tick();
        if tick + period >= ticks {
            let turn = Complex::from_polar(2.0 / period as f64, phase);
            for (sum, z) in sums.iter_mut().zip(&grid.heights()[24 * nx..25 * nx]) {
                *sum += turn * f64::from(*z);
            }
        }
    }
    // Of what goes up the slope: over a wave's length the squares of it and of what comes back add.
    let height = |i: usize, length: f64| {
        let half = (0.5 * length).round() as usize;
        let own = &sums[i - half..i + half];
        (own.iter().map(|a| a.norm_sqr()).sum::<f64>() / own.len() as f64).sqrt()
    };
    let before = foot - (0.6 * deep_length) as usize - 2;
    let incoming = height(before, deep_length);
    let near = &sums[before - (deep_length as usize) / 2..before + (deep_length as usize) / 2];
    let (least, greatest) =
        near.iter().map(|a| a.norm()).fold((f64::MAX, 0.0f64), |(low, high), a| (low.min(a), high.max(a)));
    let reference = theory(DEPTHS[0]).0;
    let rounded = |x: f64| (x * 1e3).round() / 1e3;
    let mut rows = Vec::new();
    let mut worst = 0.0f64;
    let name = format!("{:.0} cells a wave in deep water", deep_length);
    for depth in [40.0f64, 24.0, 16.0, 12.0, 8.0, 6.0, 4.0, 3.0, 2.0] {
        let part = (depth / DEPTHS[0]).ln() / (DEPTHS[1] / DEPTHS[0]).ln();
        let (group, k) = theory(depth);
        let length = TAU / k;
        let i = if depth > DEPTHS[1] {
            foot + (part * (top - foot) as f64).round() as usize
        } else {
            top + (0.5 * length) as usize + 8
        };
        let truth = (reference / group).sqrt();
        let found = height(i, length) / incoming;
        let error = 100.0 * (found / truth - 1.0);
        worst = worst.max(error.abs());
        rows.push(
            Row::new("shoaling_dispersive", name.clone())
                .param("depth_cells", depth)
                .param("height", rounded(found))
                .param("theory", rounded(truth))
                .param("kh", rounded(k * depth))
                .error(error.abs(), "%", "linear theory, sqrt of the group speeds' ratio"),
        );
    }
    rows.push(
        Row::new("shoaling_dispersive", format!("{name}, worst"))
            .param("sent_back_percent", rounded(100.0 * (greatest - least) / (greatest + least)))
            .error(worst, "%", "linear theory, sqrt of the group speeds' ratio")
            .bound(5.0),
    );
    Ok(rows)
}
