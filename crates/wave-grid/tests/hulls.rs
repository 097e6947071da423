//! Hulls that stand and move in the water.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, HullOutline, Medium, MediumCell, Source, WaveGrid};

fn desc(cells: u32) -> GridDesc {
    GridDesc { cells: [cells; 2], wave_speed: 20.0, ..GridDesc::default() }
}

fn boat(center: Vec2, heading: f32) -> HullOutline {
    let turn = Vec2::from_angle(heading);
    let corners = [[6.0, 0.0], [3.0, 2.0], [-5.0, 1.7], [-5.0, -1.7], [3.0, -2.0]];
    HullOutline { points: corners.map(|c| center + turn.rotate(Vec2::from(c))).to_vec() }
}

/// Whether a place lies in a boat, by the sides of its edges.
fn within(hull: &HullOutline, place: Vec2) -> bool {
    let n = hull.points.len();
    (0..n).all(|k| (hull.points[(k + 1) % n] - hull.points[k]).perp_dot(place - hull.points[k]) >= 0.0)
}

/// A wall where the boat lies.
struct Moored(HullOutline);

impl Medium for Moored {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = if within(&self.0, place.as_vec2()) { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, low: DVec2, high: DVec2, _: f32) -> bool {
        low.max_element() > 20.0 || high.min_element() < -20.0
    }
}

#[test]
fn a_hull_that_lies_still_is_a_wall_of_the_medium() {
    let hull = boat(Vec2::new(1.3, -2.2), 0.7);
    let mut told = WaveGrid::new(desc(160)).unwrap();
    let mut built = WaveGrid::new(desc(160)).unwrap();
    built.set_medium(Some(Arc::new(Moored(hull.clone()))));
    for tick in 0..200 {
        let place = DVec2::new(0.04 * f64::from(tick), 0.0);
        for grid in [&mut told, &mut built] {
            grid.center_on(place);
            if tick % 40 == 0 {
                assert!(grid.add(Source::Displacement { center: Vec2::new(-12.0, 4.0), radius: 1.0, volume: 1.0 }));
            }
        }
        told.set_hulls(std::slice::from_ref(&hull));
        told.tick();
        built.tick();
    }
    for (at, (a, b)) in told.heights().iter().zip(built.heights()).enumerate() {
        assert!((a - b).abs() < 1e-6, "{a} {b} at {at}");
    }
    assert!(told.heights().iter().any(|z| z.abs() > 1e-3));
    // And gone: open water as ever.
    told.set_hulls(&[]);
    told.clear();
    let mut open = WaveGrid::new(desc(160)).unwrap();
    open.center_on(DVec2::new(0.04 * 199.0, 0.0));
    for grid in [&mut told, &mut open] {
        grid.add(Source::Displacement { center: Vec2::new(1.0, -2.0), radius: 1.0, volume: 1.0 });
        for _ in 0..60 {
            grid.tick();
        }
    }
    assert_eq!(told.window(), open.window());
    assert_eq!(told.heights(), open.heights());
}

#[test]
fn a_hull_shelters_what_lies_behind_it() {
    let mut grid = WaveGrid::new(desc(256)).unwrap();
    let side = |x: f32, z: f32| Vec2::new(x, z);
    let hull = HullOutline { points: vec![side(-1.0, -15.0), side(1.0, -15.0), side(1.0, 15.0), side(-1.0, 15.0)] };
    let (mut before, mut behind) = (0.0f32, 0.0f32);
    for tick in 0..140 {
        grid.set_hulls(std::slice::from_ref(&hull));
        let turn = f64::from(tick) / 60.0 * 12.0;
        // A line of stones, waves of ten metres.
        for k in -6..=6 {
            let center = Vec2::new(-25.0, 3.0 * k as f32);
            assert!(grid.add(Source::Displacement { center, radius: 1.5, volume: 0.1 * turn.sin() as f32 }));
        }
        grid.tick();
        if tick > 100 {
            let z = |x: usize, z: usize| grid.heights()[z * 256 + x].abs();
            for k in 0..20 {
                before = before.max(z(104 + k, 128));
                behind = behind.max(z(134 + k, 128));
            }
        }
    }
    println!("before {before}, behind {behind}");
    assert!(behind < 0.35 * before, "{before} {behind}");
}

#[test]
fn a_hull_that_moves_leaves_nothing_that_grows() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    let mut peaks = [0.0f32; 2];
    let ticks = 12_000;
    for tick in 0..ticks {
        let t = tick as f32 / 60.0;
        // In circles at 8 m/s, turning, beside another that spins on the spot at a source.
        let at = 10.0 * Vec2::from_angle(0.8 * t);
        grid.set_hulls(&[boat(at, 0.8 * t + 1.57), boat(Vec2::ZERO, -2.0 * t)]);
        grid.center_on(DVec2::new(3.0 * f64::from(0.3 * t).sin(), 0.0));
        let volume = if tick % 20 < 10 { 0.05 } else { -0.05 };
        grid.add(Source::Displacement { center: 4.0 * Vec2::from_angle(3.0 * t), radius: 1.0, volume });
        grid.tick();
        let peak = &mut peaks[usize::from(tick >= ticks / 2)];
        *peak = grid.heights().iter().fold(*peak, |most, z| most.max(z.abs()));
    }
    println!("peaks {peaks:?}");
    assert!(grid.is_finite() && peaks[1] < 1.5 * peaks[0] && peaks[1] < 1.0, "{peaks:?}");
}

#[test]
fn bad_outlines_are_no_hulls() {
    let mut grid = WaveGrid::new(desc(64)).unwrap();
    grid.add(Source::Displacement { center: Vec2::ZERO, radius: 1.0, volume: 1.0 });
    let mut plain = grid.clone();
    let nan = Vec2::new(f32::NAN, 0.0);
    let bad =
        [vec![], vec![Vec2::ZERO; 2], vec![nan, Vec2::X, Vec2::Y], vec![Vec2::splat(1e30); 5], vec![Vec2::ONE; 4]];
    for points in bad {
        grid.set_hulls(&[HullOutline { points }]);
        grid.tick();
        plain.tick();
        assert_eq!(grid.hash(), plain.hash());
    }
    // The whole window and more.
    let all = [[-1e9, -1e9], [1e9, -1e9], [1e9, 1e9], [-1e9, 1e9]].map(Vec2::from).to_vec();
    grid.set_hulls(&[HullOutline { points: all }]);
    for _ in 0..10 {
        grid.tick();
    }
    assert!(grid.is_finite());
    grid.set_hulls(&[]);
    grid.tick();
    assert!(grid.is_finite());
}
