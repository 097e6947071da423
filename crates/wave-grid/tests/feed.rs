//! Waves fed in through the sides, against the plane waves that solve the discrete scheme.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, Edges, FeedLine, GridDesc, GridSample, Medium, MediumCell, Scheme, Side, WaveGrid};

const CELLS: usize = 128;
/// First cell inside the contour, on a fed side.
const INSIDE: usize = 15;

fn desc(scheme: Scheme) -> GridDesc {
    GridDesc { cells: [CELLS as u32; 2], wave_speed: 33.0, scheme, ..Default::default() }
}

/// A plane wave with k in radians per cell, and its radians per sub-step by the scheme's dispersion relation.
struct Plane {
    k: DVec2,
    turn: f64,
    ramp: f64,
}

impl Plane {
    fn new(grid: &WaveGrid, cells_per_wave: f64, direction: f64) -> Self {
        let k = DVec2::from_angle(direction) * TAU / cells_per_wave;
        let (cx, cz) = (k.x.cos(), k.y.cos());
        let lambda = match grid.desc().scheme {
            Scheme::FivePoint => 4.0 - 2.0 * cx - 2.0 * cz,
            Scheme::NinePoint => (2.0 / 3.0) * (4.0 - 2.0 * cx - 2.0 * cz) + (1.0 / 6.0) * (4.0 - 4.0 * cx * cz),
            other => panic!("no closed form of {other:?}"),
        };
        let turn = 2.0 * (grid.stepping().a[0] * lambda / 4.0).sqrt().asin();
        Self { k, turn, ramp: 12.0 * TAU }
    }

    /// At world cells (in units of the cell size) and a time in sub-steps. It grows slowly as it comes.
    fn at(&self, cell: DVec2, time: f64) -> f64 {
        let phase = self.k.dot(cell + 64.0) - self.turn * time;
        let grown = (-phase / self.ramp).clamp(0.0, 1.0);
        phase.cos() * (0.5 - 0.5 * (PI * grown).cos())
    }
}

fn points(line: &FeedLine, row: usize, h: f64) -> impl Iterator<Item = DVec2> {
    let (across, first, step, side) = (line.across[row], line.first, line.step, line.side);
    (0..line.count).map(move |k| {
        let along = first + k as f64 * step;
        let place = match side {
            Side::LowX | Side::HighX => DVec2::new(across, along),
            Side::LowZ | Side::HighZ => DVec2::new(along, across),
        };
        place / h
    })
}

fn tick(grid: &mut WaveGrid, lines: &[FeedLine], wave: &Plane, tick: u32) {
    let substeps = grid.stepping().substeps;
    let h = f64::from(grid.desc().cell_size[0]);
    grid.tick_fed(&mut |line, substep, rows| {
        let time = f64::from(tick * substeps + substep);
        for (row, heights) in rows.into_iter().enumerate() {
            assert_eq!(heights.len(), lines[line].count);
            for (z, at) in heights.iter_mut().zip(points(&lines[line], row, h)) {
                *z = wave.at(at, time) as f32;
            }
        }
    });
}

fn decibels(x: f64) -> f64 {
    20.0 * x.max(1e-30).log10()
}

const ALL: Edges = Edges { low_x: true, high_x: true, low_z: true, high_z: true };

#[test]
fn a_closed_contour_keeps_a_plane_wave_to_itself() {
    for (scheme, direction) in [(Scheme::NinePoint, 0.4), (Scheme::FivePoint, 2.2), (Scheme::NinePoint, -1.9)] {
        let mut grid = WaveGrid::new(desc(scheme)).unwrap();
        grid.set_feed(ALL);
        let lines = grid.feed_lines();
        assert_eq!(lines.len(), 4);
        let wave = Plane::new(&grid, 12.0, direction);
        let n = CELLS;
        let start = |time: f64| -> Vec<f32> {
            (0..n * n)
                .map(|at| {
                    let (i, j) = (at % n, at / n);
                    let total = (INSIDE..n - INSIDE).contains(&i) && (INSIDE..n - INSIDE).contains(&j);
                    let cell = DVec2::new(i as f64 - 63.5, j as f64 - 63.5);
                    if total { (wave.k.dot(cell) - wave.turn * time).cos() as f32 } else { 0.0 }
                })
                .collect()
        };
        grid.impose(&start(0.0), &start(-1.0)).unwrap();
        let substeps = grid.stepping().substeps;
        for t in 0..200 {
            grid.tick_fed(&mut |line, substep, rows| {
                let time = f64::from(t * substeps + substep);
                for (row, heights) in rows.into_iter().enumerate() {
                    for (z, at) in heights.iter_mut().zip(points(&lines[line], row, 0.5)) {
                        *z = (wave.k.dot(at) - wave.turn * time).cos() as f32;
                    }
                }
            });
        }
        let expected = start(f64::from(200 * substeps));
        let (mut outside, mut inside) = (0.0f64, 0.0f64);
        for (at, (z, e)) in grid.heights().iter().zip(&expected).enumerate() {
            let (i, j) = (at % n, at / n);
            let total = (INSIDE..n - INSIDE).contains(&i) && (INSIDE..n - INSIDE).contains(&j);
            let error = f64::from((z - e).abs());
            if total { inside = inside.max(error) } else { outside = outside.max(error) }
        }
        println!(
            "{scheme:?} {direction}: outside {:.0} dB, error inside {:.0} dB",
            decibels(outside),
            decibels(inside)
        );
        assert!(decibels(outside) < -75.0 && decibels(inside) < -75.0);
    }
}

/// Land on both sides of a channel along x.
struct Channel;

impl Medium for Channel {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = if place.y.abs() > 10.0 { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, damping: 0.0, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

#[test]
fn one_side_feeds_a_channel_and_the_other_end_absorbs_it() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        let mut grid = WaveGrid::new(desc(scheme)).unwrap();
        grid.set_medium(Some(Arc::new(Channel)));
        grid.set_feed(Edges { low_x: true, ..Edges::default() });
        let lines = grid.feed_lines();
        let wave = Plane::new(&grid, 16.0, 0.0);
        let (mut scattered, mut most) = (0.0f64, 0.0f64);
        for t in 0..700 {
            tick(&mut grid, &lines, &wave, t);
            let row = &grid.heights()[64 * CELLS..65 * CELLS];
            scattered = row[..INSIDE].iter().fold(scattered, |m, z| m.max(f64::from(z.abs())));
            if t > 400 {
                most = row[INSIDE..CELLS - 14].iter().fold(most, |m, z| m.max(f64::from(z.abs())));
            }
        }
        println!("{scheme:?}: scattered {:.1} dB, highest {most}", decibels(scattered));
        assert!(decibels(scattered) < -60.0, "{scheme:?}: {:.1} dB", decibels(scattered));
        assert!((most - 1.0).abs() < 2e-3, "{scheme:?}: {most}");
    }
}

#[test]
fn an_oblique_wave_enters_over_two_sides() {
    let mut grid = WaveGrid::new(desc(Scheme::NinePoint)).unwrap();
    grid.set_feed(Edges { low_x: true, low_z: true, ..Edges::default() });
    let lines = grid.feed_lines();
    let wave = Plane::new(&grid, 16.0, 0.7);
    let (mut scattered, mut error) = (0.0f64, 0.0f64);
    for t in 0..500 {
        tick(&mut grid, &lines, &wave, t);
        if t < 350 {
            continue;
        }
        let time = f64::from((t + 1) * grid.stepping().substeps);
        for j in 0..100 {
            for i in 0..100 {
                let z = f64::from(grid.heights()[j * CELLS + i]);
                if i < INSIDE || j < INSIDE {
                    scattered = scattered.max(z.abs());
                } else {
                    let cell = DVec2::new(i as f64 - 63.5, j as f64 - 63.5);
                    error = error.max((z - wave.at(cell, time)).abs());
                }
            }
        }
    }
    println!("scattered {:.1} dB, error inside {:.1} dB", decibels(scattered), decibels(error));
    assert!(decibels(scattered) < -30.0, "{:.1}", decibels(scattered));
    assert!(decibels(error) < -20.0, "{:.1}", decibels(error));
}

#[test]
fn the_fade_ends_at_the_contour_of_fed_sides() {
    let mut grid = WaveGrid::new(desc(Scheme::NinePoint)).unwrap();
    grid.center_on(DVec2::new(0.3, 0.1));
    let before = grid.fade_at(DVec2::new(-32.0 + 7.0, 0.0));
    assert!(before > 0.0);
    grid.set_feed(Edges { low_x: true, ..Edges::default() });
    let contour = -32.0 + 0.5 * INSIDE as f64;
    assert_eq!(grid.fade_at(DVec2::new(contour - 0.01, 0.0)), 0.0);
    assert!(grid.fade_at(DVec2::new(contour + 0.1, 0.0)) > 0.0);
    assert_eq!(grid.fade_at(DVec2::new(contour + 6.0, 0.0)), 1.0);
    assert_eq!(grid.fade_at(DVec2::new(f64::NAN, 0.0)), 0.0);
    let ones = vec![1.0; CELLS * CELLS];
    grid.impose(&ones, &ones).unwrap();
    let mut drawn = vec![[0.0; 2]; CELLS * CELLS];
    grid.draw(1.0, &mut drawn);
    for i in 0..CELLS {
        let place = DVec2::new((i as f64 + 0.5) * 0.5 - 32.0, 0.25);
        assert!((drawn[64 * CELLS + i][0] - grid.fade_at(place)).abs() < 1e-6, "{i}");
    }
}

#[test]
fn a_fed_grid_wakes_and_falls_asleep_with_what_comes() {
    let mut grid = WaveGrid::new(desc(Scheme::NinePoint)).unwrap();
    grid.set_feed(Edges { high_z: true, ..Edges::default() });
    grid.tick_fed(&mut |_, _, [a, b]| {
        a.fill(0.0);
        b.fill(0.0);
    });
    assert!(grid.is_asleep() && grid.active_tiles() == 0);
    let feed = |grid: &mut WaveGrid, high: f32| {
        grid.tick_fed(&mut |_, _, rows| rows.into_iter().for_each(|row| row.fill(high)));
    };
    for t in 0..60 {
        feed(&mut grid, 2e-4 * (t as f32 * PI as f32 / 60.0).sin().powi(2));
        assert!(t < 20 || grid.active_tiles() > 0);
    }
    let mut ticks = 0;
    while !grid.is_asleep() {
        feed(&mut grid, 0.0);
        ticks += 1;
        assert!(ticks < 5000);
    }
    let mut out = [GridSample::default()];
    grid.sample(&[Vec2::ZERO], &mut out);
    assert_eq!(out[0].height, 0.0);
    feed(&mut grid, f32::NAN);
    assert!(grid.is_asleep());
    feed(&mut grid, f32::INFINITY);
    feed(&mut grid, 1e30);
    assert!(grid.is_finite());
}
