//! The spectral scheme behind the interface of all schemes.

use glam::{DVec2, Vec2};
use wave_grid::{Border, CellKind, GridDesc, GridError, GridSample, Medium, MediumCell, Scheme, Source, WaveGrid};

fn desc() -> GridDesc {
    GridDesc {
        cells: [128; 2],
        scheme: Scheme::Spectral,
        border: Border::Absorbing { width: 24 },
        ..GridDesc::default()
    }
}

fn stone(grid: &mut WaveGrid, center: Vec2) {
    assert!(grid.add(Source::Displacement { center, radius: 1.5, volume: 0.3 }));
}

#[test]
fn a_window_that_moves_leaves_the_water_where_it_is() {
    let mut still = WaveGrid::new(desc()).unwrap();
    let mut moves = still.clone();
    for grid in [&mut still, &mut moves] {
        stone(grid, Vec2::ZERO);
        (0..30).for_each(|_| grid.tick());
    }
    moves.center_on(DVec2::new(4.0, -2.5));
    for grid in [&mut still, &mut moves] {
        (0..30).for_each(|_| grid.tick());
    }
    let points: Vec<Vec2> = (0..40).map(|i| Vec2::new(0.21 * i as f32 - 4.0, 0.13 * i as f32 - 3.0)).collect();
    let [mut a, mut b] = [vec![GridSample::default(); points.len()], vec![GridSample::default(); points.len()]];
    still.sample(&points, &mut a);
    moves.sample(&points, &mut b);
    let most = a.iter().map(|s| s.height.abs()).fold(0.0, f32::max);
    assert!(most > 1e-3);
    for (a, b) in a.iter().zip(&b) {
        assert!((a.height - b.height).abs() < 0.02 * most, "{a:?} {b:?}");
    }
}

#[test]
fn a_snapshot_brings_the_same_bits() {
    let mut grid = WaveGrid::new(desc()).unwrap();
    stone(&mut grid, Vec2::new(3.0, 1.0));
    (0..20).for_each(|_| grid.tick());
    let then = grid.snapshot();
    let run = |grid: &mut WaveGrid| {
        grid.center_on(DVec2::new(2.0, 0.0));
        (0..20).for_each(|_| grid.tick());
        grid.hash()
    };
    let first = run(&mut grid);
    grid.restore(&then).unwrap();
    assert_eq!(run(&mut grid), first);
    let mut other = WaveGrid::new(desc()).unwrap();
    other.restore(&then).unwrap();
    assert_eq!(run(&mut other), first);
}

#[test]
fn what_leaves_is_gone_and_the_grid_sleeps() {
    let mut grid = WaveGrid::new(GridDesc { tick: 0.1, ..desc() }).unwrap();
    stone(&mut grid, Vec2::ZERO);
    // The longest waves, longer than the border is wide, take minutes.
    for _ in 0..10 * 300 {
        grid.tick();
        if grid.is_asleep() {
            break;
        }
    }
    assert!(grid.is_asleep() && grid.is_finite());
    grid.tick();
    assert_eq!(grid.active_tiles(), 0);
    assert_eq!(grid.energy(), 0.0);
}

#[test]
fn sources_take_places_between_cells_and_volumes_are_kept() {
    let mut grid = WaveGrid::new(GridDesc { border: Border::Periodic, cells: [130; 2], ..desc() }).unwrap();
    stone(&mut grid, Vec2::new(31.9, 0.123));
    (0..200).for_each(|_| grid.tick());
    assert!((grid.volume() - 0.3).abs() < 1e-4, "{}", grid.volume());
}

struct Wall;

impl Medium for Wall {
    fn at(&self, _: DVec2, _: f32) -> MediumCell {
        MediumCell { kind: CellKind::Wall, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

#[test]
fn walls_are_not_felt_and_reflecting_borders_refused() {
    let mut grid = WaveGrid::new(desc()).unwrap();
    grid.set_medium(Some(std::sync::Arc::new(Wall)));
    stone(&mut grid, Vec2::ZERO);
    grid.tick();
    assert!(grid.heights().iter().any(|z| *z > 1e-3));
    let error = WaveGrid::new(GridDesc { border: Border::Reflecting, ..desc() }).unwrap_err();
    assert!(matches!(error, GridError::InvalidValue { field: "border", .. }), "{error}");
}
