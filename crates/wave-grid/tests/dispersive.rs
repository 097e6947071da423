//! Water waves: their speeds, walls, energy and bounds.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{Border, CellKind, GridDesc, GridError, Medium, MediumCell, Scheme, Source, WaveGrid};

/// G = g dt^2 / h = .00545.
fn desc(cells: [u32; 2], border: Border) -> GridDesc {
    GridDesc { cells, border, scheme: Scheme::Dispersive, substeps: Some(1), ..GridDesc::default() }
}

struct Water(fn(DVec2) -> MediumCell);

impl Medium for Water {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        (self.0)(place)
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn wall() -> MediumCell {
    MediumCell { kind: CellKind::Wall, ..MediumCell::default() }
}

fn stone(x: f32, z: f32, volume: f32) -> Source {
    Source::Displacement { center: Vec2::new(x, z), radius: 1.5, volume }
}

/// Share by which standing waves of `length` cells along x are slower or faster than linear theory, `depth` in cells.
fn phase_error(length: usize, depth: f64) -> f64 {
    let period = length * 46usize.div_ceil(length);
    let nx = period + 2;
    let depth_m = (0.5 * depth) as f32;
    let mut grid = WaveGrid::new(GridDesc { depth: depth_m, ..desc([nx as u32, 48], Border::Periodic) }).unwrap();
    let k = TAU / length as f64;
    let exact = (grid.stepping().a[0] * k * (k * depth).tanh()).sqrt();
    let wave: Vec<f32> = (0..nx * 48).map(|at| (0.01 * (k * (at % nx) as f64).cos()) as f32).collect();
    let before: Vec<f32> = wave.iter().map(|z| z * exact.cos() as f32).collect();
    grid.impose(&wave, &before).unwrap();
    let steps = (25.0 * TAU / exact) as usize;
    let mut series = Vec::new();
    for _ in 0..steps {
        grid.tick();
        series.push((0..period).map(|i| f64::from(grid.heights()[24 * nx + i + 1] * wave[i + 1])).sum::<f64>());
    }
    // The frequency whose share of the series is largest, under Hann's window.
    let share = |frequency: f64| {
        let terms = series.iter().enumerate().map(|(n, z)| {
            let windowed = z * (1.0 - (TAU * (n as f64 + 0.5) / steps as f64).cos());
            let (sin, cos) = (frequency * n as f64).sin_cos();
            [windowed * cos, windowed * sin]
        });
        let [re, im] = terms.fold([0.0; 2], |sum, term| [sum[0] + term[0], sum[1] + term[1]]);
        re * re + im * im
    };
    let tried = (-300..=300).map(|i| 1.0 + 1e-4 * f64::from(i));
    let best = tried.max_by(|a, b| share(a * exact).total_cmp(&share(b * exact))).unwrap();
    best - 1.0
}

#[test]
fn long_waves_outrun_short_ones_as_in_water() {
    for (length, depth, bound) in [
        (6, f64::INFINITY, 0.0072),
        (16, f64::INFINITY, 0.0072),
        (64, f64::INFINITY, 0.0072),
        (12, 4.83, 0.0112),
        (48, 4.83, 0.0112),
        (8, 1.5, 0.0112),
        (32, 1.5, 0.0112),
    ] {
        let error = phase_error(length, depth);
        assert!(error.abs() < bound, "{length} cells a wave, {depth} deep: {error}");
    }
}

#[test]
fn a_wall_mirrors_water_waves_also_through_the_border() {
    for border in [Border::Reflecting, Border::default()] {
        let desc = desc([160, 96], border);
        let [mut half, mut whole] = [(); 2].map(|()| WaveGrid::new(desc).unwrap());
        half.set_medium(Some(Arc::new(Water(|place| if place.x > 0.0 { wall() } else { MediumCell::default() }))));
        half.set_tile_skipping(false);
        whole.set_tile_skipping(false);
        let (mut worst, mut most) = (0.0f32, 0.0f32);
        for tick in 0..500 {
            if tick < 120 {
                let volume = (0.05 * tick as f32).sin();
                for [x, z] in [[-9.0, 0.3], [-6.25, -8.0]] {
                    assert!(half.add(stone(x, z, volume)));
                    assert!(whole.add(stone(x, z, volume)) && whole.add(stone(-x, z, volume)));
                }
            }
            half.tick();
            whole.tick();
            for at in (0..96).flat_map(|row| row * 160..row * 160 + 80) {
                worst = worst.max((half.heights()[at] - whole.heights()[at]).abs());
                most = most.max(whole.heights()[at].abs());
            }
        }
        assert!(worst < 1e-5 * most, "{border:?}: {worst} of {most}");
    }
}

/// A bed from a third of a cell to 160 cells deep with walls in it, each cell by its own chance.
fn rubble(place: DVec2) -> MediumCell {
    let [i, j] = [place.x, place.y].map(|x| (2.0 * x).floor() as i64 as u64);
    let mixed = (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ j.wrapping_mul(0xc2b2_ae3d_27d4_eb4f)).rotate_left(31);
    let chance = (mixed.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 40) as f32 / (1 << 24) as f32;
    if chance < 0.1 { wall() } else { MediumCell { depth: 0.15 * 500f32.powf(chance), ..MediumCell::default() } }
}

#[test]
fn energy_stays_whatever_bed_and_walls() {
    for bed in [None, Some(Arc::new(Water(rubble)) as Arc<dyn Medium>)] {
        let rough = bed.is_some();
        let mut grid = WaveGrid::new(desc([64, 80], Border::Reflecting)).unwrap();
        grid.set_medium(bed);
        grid.set_tile_skipping(false);
        // Around the level: of a basin whose level is off the potential falls without end, and its digits with it.
        let noise = |i: u32| (i.wrapping_mul(2_654_435_761) >> 8) as f32 * 1e-8 - 0.084;
        let noise: Vec<f32> = (0..64 * 80).map(noise).collect();
        grid.impose(&noise, &noise).unwrap();
        let first = grid.energy();
        for _ in 0..3000 {
            grid.tick();
        }
        let change = grid.energy() / first - 1.0;
        assert!(first > 0.1 && change.abs() < 1e-4, "rough: {rough}, {first} m^4/s^2, changed by {change}");
    }
}

#[test]
fn too_long_a_step_and_oblong_cells_are_refused() {
    let refused = |desc: GridDesc| match desc.stepping() {
        Err(GridError::InvalidValue { field, value, .. }) => (field, value),
        other => panic!("{other:?}"),
    };
    let fine = GridDesc { cell_size: [0.25; 2], ..desc([64; 2], Border::default()) };
    let (field, value) = refused(fine);
    assert!(field.contains("g (tick / substeps)^2 / cell_size") && (value - 0.0109).abs() < 1e-4, "{field} {value}");
    assert_eq!(GridDesc { substeps: None, ..fine }.stepping().unwrap().substeps, 2);
    assert_eq!(refused(GridDesc { cell_size: [0.5, 0.4], ..fine }).0, "cell_size[1]");
}
