//! Walls and held water against a mirrored domain, which knows of neither.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, GridSample, Medium, MediumCell, Scheme, Source, WaveGrid};

/// Everything beyond a line along z is of one kind.
struct Quay {
    /// World x of the first cell face of the wall.
    x: f64,
    kind: CellKind,
}

impl Medium for Quay {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = if place.x > self.x { self.kind } else { CellKind::Open };
        MediumCell { speed: deep_speed, damping: 0.0, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _low: DVec2, high: DVec2, _deep_speed: f32) -> bool {
        high.x <= self.x
    }
}

fn desc(scheme: Scheme) -> GridDesc {
    GridDesc { cells: [160, 96], cell_size: [0.5; 2], wave_speed: 24.0, scheme, ..Default::default() }
}

fn stone(x: f32, z: f32, radius: f32, volume: f32) -> Source {
    Source::Displacement { center: Vec2::new(x, z), radius, volume }
}

/// Largest difference between a grid with a medium beyond x = `wall` (cells from the middle) and one with a second
/// source mirrored at x = `mirror`, times `sign`; and the largest height.
fn mirrored(scheme: Scheme, kind: CellKind, wall: f64, mirror: f32, sign: f32) -> (f32, f32) {
    let mut half = WaveGrid::new(desc(scheme)).unwrap();
    half.set_medium(Some(Arc::new(Quay { x: 0.5 * wall, kind })));
    let mut whole = WaveGrid::new(desc(scheme)).unwrap();
    let (mut worst, mut most) = (0.0f32, 0.0f32);
    for t in 0..400 {
        let volume = 2.0 * (t as f32 * 0.3).sin();
        if t < 60 {
            for (x, z) in [(-9.0, 0.3), (-6.25, -8.0)] {
                assert!(half.add(stone(x, z, 1.5, volume)));
                assert!(whole.add(stone(x, z, 1.5, volume)));
                assert!(whole.add(stone(2.0 * mirror - x, z, 1.5, sign * volume)));
            }
        }
        half.tick();
        whole.tick();
        let open = (80.0 + wall) as usize;
        for j in 0..96 {
            for at in j * 160..j * 160 + open {
                worst = worst.max((half.heights()[at] - whole.heights()[at]).abs());
                most = most.max(whole.heights()[at].abs());
            }
        }
    }
    (worst, most)
}

#[test]
fn a_wall_is_a_mirror_also_through_the_border() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        let (worst, most) = mirrored(scheme, CellKind::Wall, 0.0, 0.0, 1.0);
        println!("{scheme:?}: {worst:e} of {most}");
        assert!(worst < 3e-5 * most, "{scheme:?}: {worst} of {most}");
    }
}

#[test]
fn held_water_is_a_mirror_with_the_opposite_sign() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        // The first held cell's centre is where the height is zero.
        let (worst, most) = mirrored(scheme, CellKind::Fixed, 0.0, 0.25, -1.0);
        println!("{scheme:?}: {worst:e} of {most}");
        assert!(worst < 3e-5 * most, "{scheme:?}: {worst} of {most}");
    }
}

#[test]
fn water_is_drawn_evenly_up_to_a_wall() {
    let mut half = WaveGrid::new(desc(Scheme::NinePoint)).unwrap();
    half.set_medium(Some(Arc::new(Quay { x: 0.0, kind: CellKind::Wall })));
    for t in 0..60 {
        half.add(stone(-9.0, 0.0, 3.0, 2.0 * (t as f32 * 0.1).sin()));
        half.tick();
    }
    let mut at = [GridSample::default(); 2];
    half.sample(&[Vec2::new(-1e-3, 1.0), Vec2::new(-0.5, 1.0)], &mut at);
    assert!(at[0].height.abs() > 0.02, "{at:?}");
    assert!(at[0].slope.x.abs() < 0.2 * at[1].slope.x.abs().max(0.01), "no slope across the wall: {at:?}");
    let mut drawn = vec![[0.0; 2]; 160 * 96];
    half.draw(1.0, &mut drawn);
    let row = &drawn[50 * 160..51 * 160];
    assert!((row[80][0] - row[79][0]).abs() < 1e-3 * row[79][0].abs(), "{:?}", &row[78..82]);
    assert!(row[82..].iter().all(|d| *d == [0.0; 2]));
}

/// A beach: the speed falls with x, to where gentle waves are high for the depth but not steep.
struct Beach;

impl Medium for Beach {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let share = (1.0 - (place.x as f32 + 10.0) / 20.0).clamp(0.3, 1.0);
        MediumCell { speed: deep_speed * share, damping: 0.0, kind: CellKind::Open, ..MediumCell::default() }
    }

    fn is_plain(&self, _low: DVec2, high: DVec2, _deep_speed: f32) -> bool {
        high.x <= -10.0
    }
}

#[test]
fn foam_grows_in_shallow_water_and_where_waves_hit_a_wall() {
    let run = |medium: Option<Arc<dyn Medium>>| {
        let mut grid = WaveGrid::new(GridDesc { wave_speed: 6.0, ..desc(Scheme::NinePoint) }).unwrap();
        grid.set_medium(medium);
        for t in 0..480 {
            let volume = if t < 40 { 0.8 * (t as f32 * 0.16).sin() } else { 0.0 };
            grid.add(stone(-6.0, 0.0, 3.0, volume));
            grid.tick();
        }
        let mut drawn = vec![[0.0; 2]; 160 * 96];
        grid.draw(1.0, &mut drawn);
        let foam = |cells: std::ops::Range<usize>| {
            drawn.iter().enumerate().filter(|(at, _)| cells.contains(&(at % 160))).map(|(_, d)| d[1]).sum::<f32>()
        };
        // Deep water, and the last metre before x = 0 or the shallows.
        [foam(0..50), foam(78..80), foam(80..110)]
    };
    let [open, beach] = [None, Some(Arc::new(Beach) as Arc<dyn Medium>)].map(run);
    println!("open {open:?}, beach {beach:?}");
    assert_eq!(open, [0.0; 3], "gentle waves do not break in deep water");
    assert!(beach[2] > 1.0 && beach[0] == 0.0, "{beach:?}");
    let wall = run(Some(Arc::new(Quay { x: 0.0, kind: CellKind::Wall })));
    println!("wall {wall:?}");
    assert!(wall[1] > 0.1 && wall[0] == 0.0 && wall[2] == 0.0, "{wall:?}");
}

#[test]
fn a_source_that_reaches_deep_into_a_wall_keeps_nothing_awake() {
    let mut grid = WaveGrid::new(desc(Scheme::NinePoint)).unwrap();
    grid.set_medium(Some(Arc::new(Quay { x: 0.0, kind: CellKind::Wall })));
    grid.set_feed(wave_grid::Edges { high_z: true, ..Default::default() });
    assert!(grid.add(stone(-0.5, 0.0, 8.0, 0.02)));
    let mut ticks = 0;
    while !grid.is_asleep() {
        // Fed along the wall too, where nothing can enter.
        let high = if ticks < 5 { 1e-4 } else { 0.0 };
        grid.tick_fed(&mut |_, _, rows| rows.into_iter().for_each(|row| row.fill(high)));
        ticks += 1;
        assert!(ticks < 8000, "never sleeps");
    }
    grid.tick();
    grid.tick();
    assert!(grid.active_tiles() == 0 && grid.heights().iter().all(|z| *z == 0.0));
}
