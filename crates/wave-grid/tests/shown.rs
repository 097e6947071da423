//! What a grid says of where it draws something, against what it draws.

mod scenario;

use glam::{DVec2, Vec2};
use wave_grid::{Border, GridDesc, Hole, Scheme, Source, TILE, WaveGrid};

/// Checks a moment of a grid; returns which share of the bands' cells is shown.
fn check(grid: &WaveGrid, bands: &mut Vec<[u32; 2]>, when: u32) -> f64 {
    let [nx, nz] = grid.desc().cells.map(|n| n as usize);
    let mut whole = vec![[f32::NAN; 2]; nx * nz];
    grid.shown(bands);
    assert_eq!(bands.len(), nz.div_ceil(TILE));
    for alpha in [0.0, 0.4, 1.0] {
        grid.draw(alpha, &mut whole);
        for (at, cell) in whole.iter().enumerate() {
            let [from, to] = bands[at / nx / TILE].map(|x| x as usize);
            assert!((from..to).contains(&(at % nx)) || *cell == [0.0; 2], "{when}: {} {}: {cell:?}", at % nx, at / nx);
        }
        // From somewhere within a row to somewhere within another, or past the end.
        let first = (when as usize * 97) % (nx * nz);
        let mut part = vec![[0.0; 2]; 3 * nx + when as usize % 50];
        grid.draw_from(first, alpha, &mut part);
        let end = (first + part.len()).min(nx * nz);
        assert_eq!(part[..end - first], whole[first..end]);
    }
    bands.iter().map(|[from, to]| f64::from(to - from)).sum::<f64>() / (bands.len() * nx) as f64
}

#[test]
fn outside_of_what_is_shown_all_is_zero() {
    let mut bands = Vec::new();
    let reflecting = GridDesc { border: Border::Reflecting, cells: [100, 90], wave_speed: 25.0, ..Default::default() };
    let periodic = GridDesc { border: Border::Periodic, ..reflecting };
    let spectral = GridDesc { scheme: Scheme::Spectral, cells: [64; 2], ..Default::default() };
    let others = [reflecting, periodic, spectral].map(|desc| WaveGrid::new(desc).unwrap());
    for mut grid in scenario::grids().into_iter().chain(others) {
        let name = format!("{:?} {:?}", grid.desc().scheme, grid.desc().border);
        assert_eq!(check(&grid, &mut bands, 0), 0.0, "{name}");
        let mut least = 1.0f64;
        for t in 0..400 {
            scenario::disturb(&mut grid, t, 60);
            let touched = check(&grid, &mut bands, t);
            assert!(touched > 0.0 || t > 60, "{name}: nothing is shown");
            grid.tick();
            least = least.min(check(&grid, &mut bands, t));
            if t == 200 {
                let snapshot = grid.snapshot();
                grid.clear();
                assert_eq!(check(&grid, &mut bands, t), 0.0, "{name}");
                grid.restore(&snapshot).unwrap();
                check(&grid, &mut bands, t);
            }
        }
        scenario::run(&mut grid, 400..405);
        check(&grid, &mut bands, 405);
        let whole = grid.desc().border == Border::Periodic || grid.desc().scheme == Scheme::Spectral;
        assert!(least < 0.6 || whole, "{name}: all is shown, always");
    }
}

#[test]
fn holes_are_cut_out_of_parts_as_out_of_the_whole() {
    let mut fine = WaveGrid::new(GridDesc { cells: [64; 2], cell_size: [0.2; 2], ..Default::default() }).unwrap();
    fine.center_on(DVec2::new(3.0, -2.0));
    let mut coarse = WaveGrid::new(GridDesc { cells: [96, 80], ..Default::default() }).unwrap();
    coarse.add(Source::Displacement { center: Vec2::new(2.0, 0.0), radius: 1.0, volume: 0.5 });
    (0..20).for_each(|_| coarse.tick());
    let holes: Vec<Hole> = [0.5, 0.3].map(|gain| fine.hole(gain)).into();
    let (mut before, mut after) = (vec![[0.0; 2]; 96 * 80], vec![[0.0; 2]; 96 * 80]);
    coarse.draw(0.7, &mut before);
    coarse.set_holes(&holes);
    coarse.draw(0.7, &mut after);
    assert_ne!(before, after);
    (0..50).for_each(|when| {
        check(&coarse, &mut Vec::new(), when);
    });
}
