//! Cases `hs` (the made sea is as high as asked for, and how unit modulus makes it so) and `lost_variance` (what the arrays
//! leave out).

use std::hint::black_box;

use ocean_spectrum::{Amplitudes, CascadeDesc, Ocean, OceanDesc, Outputs, SeaState};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure},
    fixtures,
    truth::Jonswap,
};

/// See the module.
pub(super) const HS: Case = Case {
    name: "hs",
    about: "significant height of the made sea against the spectrum's, over 24 seeds; Gaussian against unit modulus",
    plots: &[Plot {
        file: "hs",
        title: "Error of the significant height over 24 seeds by the size of the tile",
        x: Axis::Param("tile_over_peak_wavelength"),
        y: Axis::Error,
        label: None,
    }],
    run: hs,
};

/// See the module.
pub(super) const VARIANCE: Case = Case {
    name: "lost_variance",
    about: "share of the sea's variance that the cascades do not hold, by FFT size and number of cascades",
    plots: &[Plot {
        file: "lost_variance",
        title: "Variance left out against the time of a synthesis (beside the points: FFT size)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("size"),
    }],
    run: variance,
};

const SEEDS: u64 = 24;
/// Moments whose heights are averaged; at one moment waves that meet add to the error.
const MOMENTS: usize = 3;

fn hs(context: &Context) -> Result<Vec<Row>, CaseError> {
    let sea = Jonswap::new(f64::from(fixtures::WIND), f64::from(fixtures::FETCH));
    let target = 4.0 * sea.variance().sqrt();
    let mut rows = Vec::new();
    let ratios =
        context.pick(&[(1.5, 128), (3.0, 128), (6.0, 128)][..], &[(1.5, 256), (3.0, 256), (6.0, 512), (12.0, 1024)]);
    for (name, amplitudes) in [("unit modulus", Amplitudes::Unit), ("Gaussian", Amplitudes::Gaussian)] {
        for (ratio, size) in ratios {
            let cascades = vec![CascadeDesc::new(*size, (ratio * sea.peak_wavelength()) as f32)];
            let desc = OceanDesc { cascades, amplitudes, ..fixtures::ocean(256) };
            let row = over_seeds(name, &desc, target)?.param("tile_over_peak_wavelength", *ratio);
            rows.push(if amplitudes == Amplitudes::Unit { row.bound(1.0) } else { row });
        }
    }
    let seas = [
        ("lake: 5 m/s over 10 km", SeaState::wind(5.0, 10e3, 0.7)),
        ("swell of 14 s under a wind sea", SeaState::wind(9.0, 80e3, 0.0).with_swell(1.5, 14.0, 2.0)),
        ("storm over 12 m of water", SeaState::tma(20.0, 300e3, 0.0, 12.0)),
    ];
    for (name, sea) in seas {
        let described = ocean_spectrum::WaveSpectrum::new(&sea)?.significant_height();
        let desc = OceanDesc::for_sea(sea, context.pick(64, 128));
        rows.push(over_seeds(&format!("tiles chosen, {name}"), &desc, described)?.bound(1.0));
    }
    Ok(rows)
}

/// RMS error over seeds of the height averaged over some moments.
fn over_seeds(name: &str, desc: &OceanDesc, target: f64) -> Result<Row, CaseError> {
    let (mut worst, mut squares) = (0.0f64, 0.0);
    for seed in 0..SEEDS {
        let mut ocean = Ocean::new(OceanDesc { seed, ..desc.clone() })?;
        let mut variance = 0.0;
        for moment in 0..MOMENTS {
            ocean.set_time(moment as f64 * 2.3);
            variance += made_variance(&ocean) / MOMENTS as f64;
        }
        let error = 100.0 * (4.0 * variance.sqrt() / target - 1.0);
        worst = worst.max(error.abs());
        squares += error * error;
    }
    Ok(Row::new("hs", name)
        .param("size", desc.cascades[0].size)
        .param("cascades", desc.cascades.len())
        .param("seeds", SEEDS)
        .param("worst_seed_percent", (worst * 1e3).round() / 1e3)
        .error(
            (squares / SEEDS as f64).sqrt(),
            "%",
            "integral of the spectrum; RMS over seeds of the mean of 3 moments",
        ))
}

fn variance(context: &Context) -> Result<Vec<Row>, CaseError> {
    let truth = Jonswap::new(f64::from(fixtures::WIND), f64::from(fixtures::FETCH)).variance();
    let mut rows = Vec::new();
    for &size in context.pick(&[32, 64, 128, 256][..], &[32, 64, 128, 256, 512, 1024]) {
        let fixed = fixtures::ocean(size);
        let mut sets: Vec<_> =
            (1..=3).map(|n| (format!("{n} cascades from 485 m"), fixed.cascades[..n].to_vec())).collect();
        sets.push(("tiles chosen for the sea".to_owned(), OceanDesc::for_sea(fixed.sea.clone(), size).cascades));
        for (name, cascades) in sets {
            let count = cascades.len();
            let mut ocean = Ocean::new(OceanDesc { cascades, ..fixed.clone() })?;
            let lost = 1.0 - ocean.modes().iter().map(|modes| modes.variance()).sum::<f64>() / truth;
            let mut time = 0.0;
            let timing = measure(context.effort, || {
                time += 1.0 / 60.0;
                ocean.set_time(black_box(time));
                ocean.prepare(Outputs::ALL);
            });
            rows.push(
                Row::new("lost_variance", name)
                    .param("size", size)
                    .param("cascades", count)
                    .error(100.0 * lost.abs(), "%", "integral of the JONSWAP spectrum")
                    .time("all fields of every cascade at a new time", &timing),
            );
        }
    }
    Ok(rows)
}

/// Variance of the heights at the time held, m^2.
fn made_variance(ocean: &Ocean) -> f64 {
    (0..ocean.modes().len())
        .map(|c| {
            let heights = ocean.displacement(c);
            heights.iter().map(|texel| f64::from(texel[1]).powi(2)).sum::<f64>() / heights.len() as f64
        })
        .sum()
}
