//! A medium under a moving window, while it changes, and with nonsense in it.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use proptest::prelude::*;
use wave_grid::{CellKind, GridDesc, Medium, MediumCell, QUIET_HEIGHT, Scheme, Source, WaveGrid};

fn desc(cells: u32) -> GridDesc {
    GridDesc { cells: [cells; 2], wave_speed: 25.0, ..Default::default() }
}

fn stone(x: f32, z: f32, radius: f32, volume: f32) -> Source {
    Source::Displacement { center: Vec2::new(x, z), radius, volume }
}

/// A medium given by a function of the world cell.
struct Cells<F>(F);

impl<F: Fn([i64; 2]) -> MediumCell + Send + Sync> Medium for Cells<F> {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        (self.0)([(place.x / 0.5).floor() as i64, (place.y / 0.5).floor() as i64])
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn scramble(x: i64, z: i64, seed: u64) -> f32 {
    let mut h = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (z as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F) ^ seed;
    for _ in 0..2 {
        h = (h ^ (h >> 31)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
    }
    (h >> 40) as f32 / (1u64 << 24) as f32
}

/// Pillars, blocks, held water, rough speeds and damping, and plain stretches between.
struct Rough;

impl Rough {
    fn cell(x: i64, z: i64) -> MediumCell {
        let (block_x, block_z) = (x.div_euclid(9), z.div_euclid(9));
        let what = scramble(block_x, block_z, 1);
        let pillar = scramble(x, z, 2);
        let kind = match what {
            w if w < 0.1 => CellKind::Wall,
            w if w < 0.14 => CellKind::Fixed,
            w if w < 0.3 && pillar < 0.3 => CellKind::Wall,
            w if w < 0.4 && pillar < 0.05 => CellKind::Fixed,
            _ => CellKind::Open,
        };
        let speed = if what < 0.6 { 25.0 * scramble(x, z, 3).max(0.01) } else { 25.0 };
        MediumCell {
            speed,
            damping: if what < 0.2 { 3.0 * scramble(x, z, 4) } else { 0.0 },
            kind,
            ..MediumCell::default()
        }
    }
}

impl Medium for Rough {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        let cell = |x: f64| (x / 0.5).floor() as i64;
        // Every third stretch of 128 cells is deep sea.
        if cell(place.x).rem_euclid(384) < 128 {
            return MediumCell { speed: 25.0, damping: 0.0, kind: CellKind::Open, ..MediumCell::default() };
        }
        Self::cell(cell(place.x), cell(place.y))
    }

    fn is_plain(&self, low: DVec2, high: DVec2, _: f32) -> bool {
        let (first, last) = (low.x / 0.5, high.x / 0.5);
        first.rem_euclid(384.0) < 128.0 && last - first <= 128.0 - first.rem_euclid(384.0)
    }
}

/// Heights by world cell.
fn at(grid: &WaveGrid, cell: [i64; 2]) -> f32 {
    let w = grid.window();
    let [i, j] = [0, 1].map(|k| (cell[k] - w.corner[k]) as usize);
    grid.heights()[j * w.cells[0] as usize + i]
}

#[test]
fn a_window_moves_over_the_medium_without_changing_a_bit() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        let mut still = WaveGrid::new(GridDesc { cells: [320; 2], scheme, substeps: Some(2), ..desc(320) }).unwrap();
        let mut moving = still.clone();
        let start = DVec2::new(30.0, 0.0);
        let path = [[0.0, 0.0], [3.0, 2.0], [7.3, -4.0], [-6.0, 1.0], [11.0, 9.0], [0.0, 0.0]];
        for grid in [&mut still, &mut moving] {
            grid.center_on(start);
            grid.set_medium(Some(Arc::new(Rough)));
        }
        for (t, by) in path.iter().cycle().take(30).enumerate() {
            moving.center_on(start + DVec2::from(*by));
            for grid in [&mut still, &mut moving] {
                if t < 20 {
                    grid.add(stone(30.0 + (t % 5) as f32, -3.0, 1.5, 0.4));
                }
                grid.tick();
            }
        }
        // Within 60 steps the border is felt 60 cells in: 160 - 22 (shift) - 14 (layer) - 60.
        let mut most = 0.0f32;
        for z in -60..60 {
            for x in 0..120 {
                let (a, b) = (at(&still, [x, z]), at(&moving, [x, z]));
                assert_eq!(a.to_bits(), b.to_bits(), "{scheme:?} cell {x}, {z}: {a} {b}");
                most = most.max(a.abs());
            }
        }
        assert!(most > 0.01);
    }
}

#[test]
fn random_motion_past_walls_and_depths_stays_bounded() {
    for (scheme, a) in [(Scheme::NinePoint, 0.74f64), (Scheme::NinePoint, 0.55), (Scheme::FivePoint, 0.49)] {
        let wave_speed = (a.sqrt() * 30.0 * 0.9999) as f32;
        let mut grid = WaveGrid::new(GridDesc { wave_speed, scheme, substeps: Some(1), ..desc(96) }).unwrap();
        grid.set_medium(Some(Arc::new(Rough)));
        let mut random = 7u64;
        let mut uniform = || {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (random >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        let (mut position, mut velocity) = (DVec2::ZERO, DVec2::ZERO);
        let mut peak = [0.0f32; 4];
        let ticks = 8_000;
        for t in 0..ticks {
            if t % 200 == 0 {
                velocity = DVec2::new(uniform(), uniform()) * 1.5 * f64::from(wave_speed);
            }
            position += velocity / 60.0;
            grid.center_on(position);
            grid.set_origin(position);
            grid.add(stone(0.0, 0.0, 1.5, 0.3 * (t as f32 / 4.0).sin()));
            grid.tick();
            if t % 50 == 0 {
                let most = grid.heights().iter().fold(0.0f32, |m, z| m.max(z.abs()));
                peak[t * 4 / ticks] = peak[t * 4 / ticks].max(most);
            }
        }
        println!("{scheme:?} {a}: {peak:?}");
        assert!(grid.is_finite());
        assert!(peak[3] < 2.0 * peak[0] && peak[3] < 2.0, "{scheme:?} {a}: {peak:?}");
    }
}

#[test]
fn energy_is_kept_between_walls_and_depths() {
    let mut grid = WaveGrid::new(desc(192)).unwrap();
    let kinds = |[x, z]: [i64; 2]| MediumCell { damping: 0.0, ..Rough::cell(x, z) };
    grid.set_medium(Some(Arc::new(Cells(kinds))));
    grid.set_tile_skipping(false);
    let mut added = false;
    for i in 0..40 {
        added |= grid.add(stone(-10.0 + i as f32 * 0.5, 0.0, 2.0, 5.0));
    }
    assert!(added);
    let start = grid.energy();
    for t in 0..60 {
        grid.tick();
        let ratio = grid.energy() / start;
        assert!((ratio - 1.0).abs() < 2e-4, "tick {t}: {ratio}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn no_medium_makes_it_infinite(bits in proptest::array::uniform4(any::<u32>()), kinds in 0u8..27) {
        let values = bits.map(f32::from_bits);
        let nonsense = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, -0.0, 1e-40, 1e38];
        let medium = move |[x, z]: [i64; 2]| {
            let which = (x.rem_euclid(5) * 7 + z.rem_euclid(6)) as usize;
            let kind = match (u32::from(kinds) / 3u32.pow((which % 3) as u32)) % 3 {
                0 => CellKind::Open,
                1 => CellKind::Wall,
                _ => CellKind::Fixed,
            };
            let pick = |k: usize| if (which + k).is_multiple_of(3) { nonsense[which % 8] } else { values[(which + k) % 4] };
            MediumCell { speed: pick(0), damping: pick(1), kind, ..MediumCell::default() }
        };
        let mut grid = WaveGrid::new(desc(64)).unwrap();
        grid.set_medium(Some(Arc::new(Cells(medium))));
        for t in 0..40 {
            grid.add(stone((t % 7) as f32, -2.0, 2.0, 1.0));
            grid.center_on(DVec2::new(f64::from(t) * 0.3, f64::from(t) * -0.2));
            grid.tick();
        }
        prop_assert!(grid.is_finite());
        prop_assert!(grid.heights().iter().all(|z| z.abs() < 100.0));
    }

    #[test]
    fn the_volume_written_beside_walls_is_the_volume_given(
        x in -10.0f32..10.0, z in -10.0f32..10.0, radius in 0.0f32..6.0, volume in -20.0f32..20.0,
    ) {
        let mut grid = WaveGrid::new(desc(160)).unwrap();
        let quay = |[x, _]: [i64; 2]| {
            let kind = match x {
                ..-12 => CellKind::Wall,
                12.. => CellKind::Fixed,
                _ => CellKind::Open,
            };
            MediumCell { speed: 25.0, damping: 0.0, kind, ..MediumCell::default() }
        };
        grid.set_medium(Some(Arc::new(Cells(quay))));
        let written = grid.add(stone(x, z, radius, volume));
        let expected = if written { f64::from(volume) } else { 0.0 };
        prop_assert!(written || x.abs() > 5.0);
        prop_assert!((grid.volume() - expected).abs() <= 4e-6 * expected.abs(), "{} {expected}", grid.volume());
        let open = |at: usize| (68..92).contains(&(at % 160));
        prop_assert!(grid.heights().iter().enumerate().all(|(at, z)| open(at) || *z == 0.0));
    }
}

fn basin(open: std::ops::Range<i64>) -> Arc<dyn Medium> {
    Arc::new(Cells(move |[x, z]: [i64; 2]| {
        let kind = if open.contains(&x) && open.contains(&z) { CellKind::Open } else { CellKind::Wall };
        MediumCell { speed: 25.0, damping: 0.0, kind, ..MediumCell::default() }
    }))
}

#[test]
fn a_closed_basin_keeps_its_water_and_its_energy() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    grid.set_medium(Some(basin(-20..21)));
    grid.add(stone(3.0, -4.0, 3.0, 2.0));
    let (volume, energy) = (grid.volume(), grid.energy());
    for _ in 0..2000 {
        grid.tick();
    }
    assert!((grid.volume() / volume - 1.0).abs() < 1e-4, "{}", grid.volume() / volume);
    assert!((grid.energy() / energy - 1.0).abs() < 1e-3, "{}", grid.energy() / energy);
    assert!(grid.active_tiles() <= 16, "walls are not stepped: {}", grid.active_tiles());
}

#[test]
fn a_medium_may_change_while_waves_run() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    let run = |grid: &mut WaveGrid, ticks: usize| {
        for t in 0..ticks {
            grid.add(stone(0.0, 0.0, 2.0, 0.5 * (t as f32 * 0.3).sin()));
            grid.tick();
        }
    };
    run(&mut grid, 30);
    grid.set_medium(Some(basin(-12..12)));
    let outside = |grid: &WaveGrid, reach: i64| {
        let far = |c: i64| c < 64 - reach || c >= 64 + reach;
        let cells =
            grid.heights().iter().enumerate().filter(|(at, _)| far((at % 128) as i64) || far((at / 128) as i64));
        cells.fold(0.0f32, |m, (_, z)| m.max(z.abs()))
    };
    // Two rows of wall show the water beside them.
    assert_eq!(outside(&grid, 14), 0.0);
    assert!(outside(&grid, 12) > 0.0);
    run(&mut grid, 50);
    assert_eq!(outside(&grid, 14), 0.0);
    // What was wall is calm, also what showed water.
    grid.set_medium(Some(basin(-30..30)));
    assert_eq!(outside(&grid, 12), 0.0);
    run(&mut grid, 50);
    assert!(outside(&grid, 14) > 0.0);
    let volume = grid.volume();
    grid.set_medium(Some(basin(-30..30)));
    assert_eq!(grid.volume(), volume, "the same medium again changes nothing");
    grid.set_medium(None);
    assert!((grid.volume() - volume).abs() < 1e-9);
    let free = grid.clone();
    run(&mut grid, 20);
    assert!(grid.is_finite() && outside(&grid, 32) > 0.0);
    let mut again = free;
    run(&mut again, 20);
    assert_eq!(again.hash(), grid.hash(), "a clone is a snapshot");
}

#[test]
fn quiet_tiles_and_threads_change_nothing() {
    let run = |threads: usize, skipping: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut grid = WaveGrid::new(desc(448)).unwrap();
            grid.set_medium(Some(Arc::new(Rough)));
            grid.set_tile_skipping(skipping);
            for t in 0..60 {
                grid.center_on(DVec2::new(f64::from(t) * 0.3, f64::from(t) * -0.2));
                grid.add(stone(0.0, 0.0, 2.0, 1.0));
                grid.tick();
            }
            grid
        })
    };
    let (one, three) = (run(1, false), run(3, false));
    assert_eq!(one.hash(), three.hash());
    let lazy = run(1, true);
    let worst = lazy.heights().iter().zip(one.heights()).fold(0.0f32, |m, (a, b)| m.max((a - b).abs()));
    assert!(worst <= 2.0 * QUIET_HEIGHT, "{worst:e}");
}
