//! Currents: waves are carried, none are made.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, Medium, MediumCell, Source, WaveGrid};

/// An even current.
struct Even(Vec2);

impl Medium for Even {
    fn at(&self, _: DVec2, _: f32) -> MediumCell {
        MediumCell { current: self.0, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

/// Water without anything, told cell by cell.
struct Still;

impl Medium for Still {
    fn at(&self, _: DVec2, deep_speed: f32) -> MediumCell {
        MediumCell { speed: deep_speed, damping: 0.0, kind: CellKind::Open, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn scramble(x: i64, z: i64, salt: u64) -> f64 {
    let mut h = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (z as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F) ^ salt;
    h = (h ^ (h >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    h = (h ^ (h >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((h ^ (h >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Eddies a few cells wide: the curl of a stream function that is random on a lattice.
struct Eddies {
    speed: f64,
    walls: Walls,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Walls {
    None,
    /// Pillars that the current flows round.
    Pillars,
    /// Cells at random, this share of all, that the current knows nothing of.
    Random(f64),
}

impl Walls {
    /// Distance from the nearest pillar, metres.
    fn off(at: DVec2) -> f64 {
        (at - (at / 7.0).round() * 7.0).length() - 1.2
    }
}

impl Eddies {
    fn stream(&self, at: DVec2) -> f64 {
        let (cell, t) = ((at / 3.0).floor(), at / 3.0 - (at / 3.0).floor());
        let value = |dx: f64, dz: f64| 2.0 * scramble((cell.x + dx) as i64, (cell.y + dz) as i64, 7) - 1.0;
        let s = t * t * (3.0 - 2.0 * t);
        let low = value(0.0, 0.0) + s.x * (value(1.0, 0.0) - value(0.0, 0.0));
        let high = value(0.0, 1.0) + s.x * (value(1.0, 1.0) - value(0.0, 1.0));
        let stream = low + s.y * (high - low);
        let t = (Walls::off(at) / 1.5).clamp(0.0, 1.0);
        if self.walls == Walls::Pillars { stream * t * t * (3.0 - 2.0 * t) } else { stream }
    }
}

impl Medium for Eddies {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let slope = |d: DVec2| (self.stream(place + d) - self.stream(place - d)) / 0.2;
        let current = DVec2::new(slope(DVec2::Y * 0.1), -slope(DVec2::X * 0.1)) * self.speed;
        let cell = (place / 0.5).floor();
        let wall = match self.walls {
            Walls::None => false,
            Walls::Pillars => Walls::off((cell + 0.5) * 0.5) < 0.0,
            Walls::Random(share) => scramble(cell.x as i64, cell.y as i64, 3) < share,
        };
        let kind = if wall { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, damping: 0.0, kind, current: current.as_vec2(), ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn desc(cells: u32) -> GridDesc {
    GridDesc { cells: [cells; 2], wave_speed: 20.0, ..GridDesc::default() }
}

#[test]
fn a_ring_in_a_current_is_the_still_ring_moved() {
    for (current, substeps) in
        [(Vec2::new(5.0, 0.0), None), (Vec2::new(-6.0, 4.0), None), (Vec2::new(2.0, 9.0), Some(2))]
    {
        let desc = GridDesc { substeps, ..desc(320) };
        let (mut moved, mut still) = (WaveGrid::new(desc).unwrap(), WaveGrid::new(desc).unwrap());
        moved.set_medium(Some(Arc::new(Even(current))));
        let ticks = 90;
        let by = current.as_dvec2() * f64::from(ticks) / 60.0;
        // The still grid's stone falls where the moved ring's middle will be.
        for (grid, center) in [(&mut moved, Vec2::ZERO), (&mut still, by.as_vec2())] {
            grid.add(Source::Displacement { center, radius: 3.75, volume: 1.0 });
            for _ in 0..ticks {
                grid.tick();
            }
        }
        let (mut worst, mut peak) = (0.0f32, 0.0f32);
        for (a, b) in moved.heights().iter().zip(still.heights()) {
            worst = worst.max((a - b).abs());
            peak = peak.max(b.abs());
        }
        println!("{current}: off by {:.2} % of the crest", 100.0 * worst / peak);
        assert!(worst < 0.05 * peak, "{current}: {worst} of {peak}");
        assert!((moved.volume() - 1.0).abs() < 1e-4, "{}", moved.volume());
    }
}

#[test]
fn no_current_changes_no_bit() {
    let run = |medium: Arc<dyn Medium>| {
        let mut grid = WaveGrid::new(desc(128)).unwrap();
        grid.set_medium(Some(medium));
        grid.add(Source::Displacement { center: Vec2::new(1.0, 2.0), radius: 1.0, volume: 1.0 });
        for tick in 0..60 {
            grid.center_on(DVec2::new(0.1 * f64::from(tick), 0.0));
            grid.tick();
        }
        grid.hash()
    };
    assert_eq!(run(Arc::new(Even(Vec2::ZERO))), run(Arc::new(Still)));
    assert_eq!(run(Arc::new(Even(Vec2::NAN))), run(Arc::new(Still)));
    assert_ne!(run(Arc::new(Even(Vec2::X))), run(Arc::new(Still)));
}

#[test]
fn eddies_among_walls_make_no_water_and_nothing_grows() {
    for (speed, walls) in [(9.0, Walls::None), (6.0, Walls::Pillars), (2.0, Walls::Random(0.1))] {
        let mut grid = WaveGrid::new(desc(96)).unwrap();
        grid.set_medium(Some(Arc::new(Eddies { speed, walls })));
        assert!(grid.add(Source::Displacement { center: Vec2::splat(3.5), radius: 2.0, volume: 3.0 }));
        let given = grid.volume();
        for _ in 0..20 {
            grid.tick();
            assert!((grid.volume() - given).abs() < 2e-4, "{}", grid.volume());
        }
        let mut peaks = [0.0f32; 2];
        let ticks = 3_000;
        for tick in 0..ticks {
            let volume = if tick % 20 < 10 { 0.05 } else { -0.05 };
            grid.add(Source::Displacement { center: Vec2::ZERO, radius: 1.0, volume });
            grid.tick();
            let peak = &mut peaks[usize::from(tick >= ticks / 2)];
            *peak = grid.heights().iter().fold(*peak, |most, z| most.max(z.abs()));
        }
        println!("{speed} {walls:?} peaks {peaks:?}");
        assert!(grid.is_finite() && peaks[1] < 1.5 * peaks[0] && peaks[1] < 1.0, "{peaks:?}");
    }
}

#[test]
fn a_window_that_moves_sees_the_same_current() {
    let run = |there_and_back: bool| {
        let mut grid = WaveGrid::new(desc(192)).unwrap();
        grid.set_medium(Some(Arc::new(Eddies { speed: 5.0, walls: Walls::None })));
        if there_and_back {
            for x in [3.0, 11.0, 14.5, 5.0, -2.0, 0.0] {
                grid.center_on(DVec2::new(x, 0.5 * x));
                grid.add(Source::Displacement { center: Vec2::new(x as f32, 0.0), radius: 1.0, volume: 1e-4 });
            }
            grid.clear();
            grid.center_on(DVec2::splat(1.0));
            grid.center_on(DVec2::splat(0.0));
        }
        grid.add(Source::Displacement { center: Vec2::ZERO, radius: 1.0, volume: 1.0 });
        for _ in 0..40 {
            grid.tick();
        }
        (grid.window().corner, grid.heights().to_vec())
    };
    let ((corner, straight), (other, back)) = (run(false), run(true));
    let shift = [other[0] - corner[0], other[1] - corner[1]];
    for j in 40..150i64 {
        for i in 40..150i64 {
            let there = straight[(j * 192 + i) as usize];
            let here = back[((j - shift[1]) * 192 + i - shift[0]) as usize];
            assert!((there - here).abs() < 1e-5, "{there} {here} at {i}, {j}");
        }
    }
}
