//! What is fed over an edge, against direct sums and against the waves a grid carries.

use std::f64::consts::TAU;

use glam::DVec2;
use ocean_spectrum::{CascadeDesc, CascadeModes, EdgeDesc, EdgeFeed, Moment, Ocean, OceanDesc, SeaState, reference};

fn edge() -> EdgeDesc {
    EdgeDesc {
        along_x: false,
        across: [-250.25, -249.75],
        inward: 1.0,
        first: -137.3,
        step: 0.5,
        count: 300,
        wave_speed: 7.0,
        cascades: 2,
    }
}

/// The modes that travel across the edge inwards, and no others.
fn inward(modes: &CascadeModes, edge: &EdgeDesc) -> CascadeModes {
    let mut modes = modes.clone();
    for cell in 0..modes.amp.len() {
        let axis = if edge.along_x { cell / modes.size as usize } else { cell % modes.size as usize };
        if f64::from(modes.signed(axis as u32)) * edge.inward <= 0.0 {
            modes.amp[cell] = [0.0; 4];
        }
    }
    modes
}

#[test]
fn halfway_it_is_the_inward_part_of_the_sea() {
    let mut ocean = Ocean::new(OceanDesc { sea: SeaState::wind(10.0, 100e3, 0.4), ..Default::default() }).unwrap();
    for (along_x, side) in [(false, 1.0), (true, 1.0), (true, -1.0)] {
        // Far from the world's origin too; both rows on the line itself, and steps that resolve all waves.
        for place in [-250.0, 4_321_000.25] {
            let edge = EdgeDesc { along_x, inward: side, across: [place; 2], step: 0.4, ..edge() };
            let mut feed = EdgeFeed::new(&ocean, edge).unwrap();
            let t = 1234.56 + place;
            ocean.set_time(t);
            let mut rows = [vec![0.0; 300], vec![0.0; 300]];
            let [a, b] = &mut rows;
            feed.rows(ocean.moment_at(t), [a, b]);
            let (mut off, mut all) = (0.0, 0.0);
            for i in (0..300).step_by(23) {
                let along = edge.first + edge.step * i as f64;
                let world = if along_x { DVec2::new(along, place) } else { DVec2::new(place, along) };
                let sum = |modes: &CascadeModes| {
                    let tile = DVec2::splat(modes.tile.into());
                    let x = world.rem_euclid(tile);
                    reference::direct_sum(&inward(modes, &edge), 0.0, 1024.0, x, ocean.time()).displacement[1]
                };
                let truth: f64 = ocean.modes()[..2].iter().map(sum).sum();
                off += (f64::from(rows[0][i]) - truth).powi(2);
                all += truth * truth;
            }
            assert_eq!(rows[0], rows[1]);
            assert!(all > 0.05 && (off / all).sqrt() < 3e-6, "{along_x} {side} {place}: {}", (off / all).sqrt());
        }
    }
}

#[test]
fn across_the_edge_waves_have_the_wavenumber_of_the_grid() {
    // A small sea, all of whose waves one tile and one loop of it tell apart.
    let (tile, loop_time) = (60.0, 64.0);
    let cascades = vec![CascadeDesc::new(32, 60.0)];
    let sea = SeaState::height_period(1.0, 4.0, 0.6);
    let ocean = Ocean::new(OceanDesc { sea, cascades, loop_time, ..Default::default() }).unwrap();
    let (count, times, speed, apart) = (120, 256u32, 4.5, 0.4);
    let edge = EdgeDesc {
        across: [20.0 + 0.5 * apart, 20.0 - 0.5 * apart],
        inward: -1.0,
        first: 0.0,
        step: tile / count as f64,
        count,
        wave_speed: speed,
        cascades: 1,
        along_x: true,
    };
    let mut feed = EdgeFeed::new(&ocean, edge).unwrap();
    let mut heights = [vec![0.0f32; count * times as usize], vec![0.0f32; count * times as usize]];
    let [outside, inside] = &mut heights;
    for ((i, a), b) in (0..).zip(outside.chunks_mut(count)).zip(inside.chunks_mut(count)) {
        feed.rows(Moment { phase: [i << 24, 0], ..ocean.moment_at(0.0) }, [a, b]);
    }
    // Amplitude of e^(i (2 pi m x/tile - 2 pi n t/loop)).
    let wave = |row: &[f32], m: i32, n: u32| {
        let (mut re, mut im) = (0.0, 0.0);
        for (at, &height) in row.iter().enumerate() {
            let (x, t) = ((at % count) as f64 / count as f64, (at / count) as f64 / f64::from(times));
            let (sin, cos) = (TAU * (f64::from(m) * x - f64::from(n) * t)).sin_cos();
            re += 2.0 * f64::from(height) * cos / row.len() as f64;
            im -= 2.0 * f64::from(height) * sin / row.len() as f64;
        }
        (re, im)
    };
    let (mut carried, mut dying) = (0, 0);
    for m in [-9, -6, -3, -1, 0, 2, 5, 8] {
        for n in (9..40).step_by(2) {
            let ((a, b), (c, d)) = (wave(&heights[0], m, n), wave(&heights[1], m, n));
            if a.hypot(b) < 1e-4 {
                continue;
            }
            let (along, whole) = (TAU * f64::from(m) / tile, TAU * f64::from(n) / loop_time / speed);
            let normal = whole * whole - along * along;
            let ratio = c.hypot(d) / a.hypot(b);
            let turned = (d * a - c * b).atan2(c * a + d * b);
            if normal > 0.0 {
                carried += 1;
                assert!(
                    (turned - normal.sqrt() * apart).abs() < 2e-3 && (ratio - 1.0).abs() < 2e-3,
                    "{m} {n}: {turned}"
                );
            } else {
                dying += 1;
                assert!(
                    (ratio - (-(-normal).sqrt() * apart).exp()).abs() < 2e-3 && turned.abs() < 2e-3,
                    "{m} {n}: {ratio}"
                );
            }
        }
    }
    assert!(carried > 20 && dying > 5, "{carried} {dying}");
}

#[test]
fn waves_the_grid_does_not_resolve_are_left_out() {
    let ocean = Ocean::new(OceanDesc::default()).unwrap();
    let variance = |step: f64, cascades: usize| {
        let edge = EdgeDesc { step, cascades, across: [0.0, step], count: 4000, ..edge() };
        let mut feed = EdgeFeed::new(&ocean, edge).unwrap();
        let (mut a, mut b) = (vec![0.0; 4000], vec![0.0; 4000]);
        feed.rows(Moment { phase: [1 << 30, 0], ..ocean.moment_at(0.0) }, [&mut a, &mut b]);
        a.iter().map(|h| f64::from(h * h)).sum::<f64>() / 4000.0
    };
    // At steps of 40 m no wave of this sea is left, at 6 m the long ones, and the ripples add little to them.
    assert_eq!(variance(40.0, 3), 0.0);
    let (coarse, fine) = (variance(6.0, 3), variance(0.5, 3));
    assert!(coarse > 0.05 && coarse < fine, "{coarse} {fine}");
}

#[test]
fn rows_of_any_length_are_filled() {
    let ocean = Ocean::new(OceanDesc::default()).unwrap();
    let mut feed = EdgeFeed::new(&ocean, edge()).unwrap();
    let (mut short, mut long, mut whole) = (vec![9.0; 7], vec![9.0; 400], vec![9.0; 300]);
    feed.rows(ocean.moment_at(77.0), [&mut short, &mut long]);
    feed.rows(ocean.moment_at(77.0), [&mut whole, &mut []]);
    assert_eq!(short, whole[..7]);
    assert!(long[299] != 0.0 && long[300..].iter().all(|&h| h == 0.0));
}

#[test]
fn edges_out_of_bounds_are_refused() {
    let ocean = Ocean::new(OceanDesc::default()).unwrap();
    let bad = [
        EdgeDesc { across: [0.0, f64::NAN], ..edge() },
        EdgeDesc { across: [0.0, 1.1], ..edge() },
        EdgeDesc { inward: 0.5, ..edge() },
        EdgeDesc { first: f64::INFINITY, ..edge() },
        EdgeDesc { step: 0.0, ..edge() },
        EdgeDesc { count: 0, ..edge() },
        EdgeDesc { count: 9000, ..edge() },
        EdgeDesc { wave_speed: -1.0, ..edge() },
        EdgeDesc { wave_speed: f64::NAN, ..edge() },
        EdgeDesc { cascades: 0, ..edge() },
        EdgeDesc { cascades: 4, ..edge() },
    ];
    for desc in bad {
        let error = EdgeFeed::new(&ocean, desc).err().unwrap().to_string();
        assert!(error.starts_with("edge ") && error.contains("; allowed: "), "{error}");
    }
}

#[test]
fn during_a_change_both_seas_come_in() {
    let rows_of = |ocean: &Ocean, moment: Moment| {
        let mut feed = EdgeFeed::new(ocean, edge()).unwrap();
        let (mut a, mut b) = (vec![9.0; 300], vec![9.0; 300]);
        feed.rows(moment, [&mut a, &mut b]);
        [a, b].concat()
    };
    let (old, new) = (OceanDesc::default(), OceanDesc { seed: 3, loop_time: 900.0, ..OceanDesc::default() });
    let [mut ocean, to] = [old.clone(), new.clone()].map(|desc| Ocean::new(desc).unwrap());
    let from = ocean.clone();
    ocean.change_to(new, 10.0, 20.0).unwrap();
    ocean.set_time(19.0);
    let now = ocean.moment_at(19.0);
    assert!(now.weight[0] > 0.3 && now.weight[1] > 0.3);
    let parts = [&from, &to].map(|sea| rows_of(sea, sea.moment_at(19.0)));
    for (i, height) in rows_of(&ocean, now).into_iter().enumerate() {
        let wanted = now.weight[0] * parts[0][i] + now.weight[1] * parts[1][i];
        assert!((height - wanted).abs() < 1e-5, "{i}: {height} {wanted}");
    }
    // A feed made before the change is not fooled by one that it does not know.
    assert!(rows_of(&from, to.moment_at(19.0)).iter().all(|&height| height == 0.0));
}
