//! Case `hs`: the made sea is as high as asked for.

use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc};

use super::ocean_fft::made_variance;
use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    fixtures,
    truth::Jonswap,
};

/// See the module.
pub(super) const HS: Case = Case {
    name: "hs",
    about: "significant height of the made sea against the spectrum's, over 24 seeds",
    plots: &[Plot {
        file: "hs",
        title: "Error of the significant height by the size of the tile",
        x: Axis::Param("tile_over_peak_wavelength"),
        y: Axis::Error,
        label: None,
    }],
    run: hs,
};

const SEEDS: u64 = 24;

fn hs(context: &Context) -> Result<Vec<Row>, CaseError> {
    let sea = Jonswap::new(f64::from(fixtures::WIND), f64::from(fixtures::FETCH));
    let target = 4.0 * sea.variance().sqrt();
    let mut rows = Vec::new();
    for (ratio, size) in
        context.pick(&[(1.5, 128), (3.0, 128), (6.0, 256)][..], &[(1.5, 256), (3.0, 256), (6.0, 512), (12.0, 1024)])
    {
        let cascade = CascadeDesc::new(*size, (ratio * sea.peak_wavelength()) as f32);
        let mut worst = 0.0f64;
        let mut squares = 0.0;
        for seed in 0..SEEDS {
            let ocean = Ocean::new(OceanDesc { seed, cascades: vec![cascade], ..fixtures::ocean(256) })?;
            let error = 100.0 * (4.0 * made_variance(&ocean).sqrt() / target - 1.0);
            worst = worst.max(error.abs());
            squares += error * error;
        }
        rows.push(
            Row::new("hs", "one cascade, one moment")
                .param("tile_over_peak_wavelength", *ratio)
                .param("size", *size)
                .param("seeds", SEEDS)
                .param("worst_seed_percent", (worst * 1e3).round() / 1e3)
                .error((squares / SEEDS as f64).sqrt(), "%", "integral of the JONSWAP spectrum; RMS over seeds")
                .bound(1.0),
        );
    }
    Ok(rows)
}
