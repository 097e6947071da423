//! A fine grid that is seen instead of the coarse one around it.

use glam::{DVec2, Vec2};
use wave_grid::{GridDesc, GridSample, WaveGrid};

/// Both hold water raised by 1 m.
fn raised(cell: f32, at: DVec2) -> WaveGrid {
    let mut grid = WaveGrid::new(GridDesc { cells: [128; 2], cell_size: [cell; 2], ..GridDesc::default() }).unwrap();
    grid.center_on(at);
    let heights = vec![1.0; 128 * 128];
    grid.impose(&heights, &heights).unwrap();
    grid
}

fn heights(grids: [&WaveGrid; 2], points: &[Vec2]) -> Vec<f32> {
    let mut out = [vec![GridSample::default(); points.len()], vec![GridSample::default(); points.len()]];
    for (grid, out) in grids.iter().zip(&mut out) {
        grid.sample(points, out);
    }
    out[0].iter().zip(&out[1]).map(|(a, b)| a.height + b.height).collect()
}

/// Every .37 m of a line through the fine grid of cells of .25 m and its joints, off its middle.
fn line() -> Vec<Vec2> {
    (0..140).map(|i| Vec2::new(-25.9 + 0.37 * i as f32, 3.3)).collect()
}

#[test]
fn every_wave_is_seen_once() {
    let place = DVec2::new(3.3, -1.9);
    let (mut fine, mut coarse) = (raised(0.25, place), raised(0.75, DVec2::ZERO));
    fine.set_nested(true);
    coarse.set_holes(&[fine.hole(1.0)]);
    for (height, point) in heights([&fine, &coarse], &line()).iter().zip(line()) {
        assert!((height - 1.0).abs() < 0.02, "{height} at {point}");
    }
    // Of what is uploaded, the middle of the fine one is left out.
    let mut drawn = vec![[0.0f32; 2]; 128 * 128];
    coarse.draw(1.0, &mut drawn);
    assert_eq!([drawn[64 * 128 + 64][0], drawn[64 * 128 + 20][0]], [0.0, 1.0]);
    // The window has gone on: the hole stays in the world.
    coarse.center_on(DVec2::new(7.0, 0.0));
    let worst = heights([&fine, &coarse], &line()).iter().fold(0.0f32, |most, h| most.max((h - 1.0).abs()));
    assert!(worst < 0.02, "{worst}");
}

#[test]
fn a_grid_that_fades_into_another_is_cut_out_once() {
    let place = DVec2::new(3.3, -1.9);
    let (fine, mut coarse) = (raised(0.25, place), raised(0.75, DVec2::ZERO));
    coarse.set_holes(&[fine.hole(0.3), fine.hole(0.7)]);
    let mut drawn = vec![[0.0f32; 2]; 128 * 128];
    coarse.draw(1.0, &mut drawn);
    assert!(drawn[64 * 128 + 64][0].abs() < 1e-6, "{}", drawn[64 * 128 + 64][0]);
    coarse.set_holes(&[]);
    coarse.draw(1.0, &mut drawn);
    assert_eq!(drawn[64 * 128 + 64][0], 1.0);
}
