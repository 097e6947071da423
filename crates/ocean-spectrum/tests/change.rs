//! The sea changes while it runs.

use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, SeaState};

const TICK: f64 = 1.0 / 60.0;

fn desc(wind: f32) -> OceanDesc {
    OceanDesc {
        sea: SeaState::wind(wind, 80e3, 0.4),
        cascades: vec![CascadeDesc::new(32, 300.0), CascadeDesc::new(32, 60.0)],
        seed: 9,
        ..Default::default()
    }
}

fn sea(desc: OceanDesc) -> Ocean {
    Ocean::new(desc).unwrap()
}

/// Every value of every array.
fn arrays(ocean: &mut Ocean, t: f64) -> Vec<f32> {
    ocean.set_time(t);
    let fields = (0..ocean.modes().len()).map(|c| ocean.fields(c));
    fields.flat_map(|f| [f.displacement, f.derivative, f.velocity].concat()).flatten().collect()
}

fn heights(ocean: &mut Ocean, t: f64) -> Vec<f32> {
    ocean.set_time(t);
    (0..ocean.modes().len()).flat_map(|c| ocean.fields(c).displacement.iter().map(|texel| texel[1])).collect()
}

fn variance(ocean: &mut Ocean, t: f64) -> f64 {
    ocean.set_time(t);
    let mean = |c| {
        let texels = ocean.fields(c).displacement;
        texels.iter().map(|texel| f64::from(texel[1]).powi(2)).sum::<f64>() / texels.len() as f64
    };
    (0..ocean.modes().len()).map(mean).sum()
}

/// Largest change of a height from tick to tick over the ticks around `t`.
fn step(ocean: &mut Ocean, t: f64) -> f32 {
    let mut last = heights(ocean, t - 4.0 * TICK);
    let mut worst = 0.0f32;
    for i in -3..=4 {
        let now = heights(ocean, t + f64::from(i) * TICK);
        for (a, b) in last.iter().zip(&now) {
            worst = worst.max((a - b).abs());
        }
        last = now;
    }
    worst
}

/// The seas that the one of 8 m/s changes into, and whether amplitudes move.
fn changes() -> [(OceanDesc, bool); 6] {
    let before = desc(8.0);
    let deep = SeaState { depth: Some(12.0), ..before.sea.clone() };
    [
        (desc(14.0), true),
        (OceanDesc { choppiness: 0.3, ..desc(14.0) }, true),
        (OceanDesc { sea: SeaState::wind(9.0, 80e3, 2.0), ..before.clone() }, true),
        (OceanDesc { sea: deep, ..before.clone() }, false),
        (OceanDesc { loop_time: 700.0, ..before.clone() }, false),
        (OceanDesc { seed: 10, ..before }, false),
    ]
}

#[test]
fn heights_do_not_pop() {
    for (i, (after, plain)) in changes().into_iter().enumerate() {
        let start = 1e6 + 7.0;
        let mut changing = sea(desc(8.0));
        changing.change_to(after.clone(), start, 60.0).unwrap();
        let (mut before, mut after) = (sea(desc(8.0)), sea(after));
        for t in [0.0, 1.0, 15.0, 30.0, 45.0, 59.0, 60.0].map(|t| start + t) {
            // Each sea's own movement, and what the weights add: 1.5 (smoothstep), times a quarter turn in a fade.
            let own = step(&mut before, t).max(step(&mut after, t));
            let highest =
                heights(&mut before, t).into_iter().chain(heights(&mut after, t)).fold(0.0f32, |a, b| a.max(b.abs()));
            let weights = if plain { 1.5 } else { 1.5 * 1.6 } * highest * 2.0 * TICK as f32 / 60.0;
            let both = if plain { 1.0 } else { std::f32::consts::SQRT_2 };
            let found = step(&mut changing, t);
            assert!(found <= 1.05 * (both * own + weights), "change {i} at {}: {found} {own} {weights}", t - start);
        }
    }
}

#[test]
fn the_end_is_the_new_sea_bit_for_bit() {
    for (after, _) in changes() {
        let mut changing = sea(desc(8.0));
        changing.change_to(after.clone(), 40.0, 60.0).unwrap();
        let (mut before, mut new) = (sea(desc(8.0)), sea(after.clone()));
        // Forwards and backwards.
        for t in [0.0, 40.0, 70.0, 100.0, 5e6, 99.0, 39.9, -10.0] {
            let found = arrays(&mut changing, t);
            if t <= 40.0 {
                assert_eq!(found, arrays(&mut before, t));
            } else if t >= 100.0 {
                assert_eq!(found, arrays(&mut new, t));
                assert_eq!(changing.significant_height(), new.significant_height());
                assert_eq!(changing.peak_period(), new.peak_period());
                assert_eq!(*changing.desc(), after);
            } else {
                assert_ne!(found, arrays(&mut before, t));
                assert_ne!(found, arrays(&mut new, t));
            }
        }
    }
}

#[test]
fn half_way_fields_are_the_mix() {
    for (after, _) in changes() {
        let mut changing = sea(desc(8.0));
        changing.change_to(after.clone(), 10.0, 60.0).unwrap();
        let (mut a, mut b) = (sea(desc(8.0)), sea(after));
        // Smoothstep is 1/2 there.
        changing.set_time(40.0);
        let [weight, other] = changing.moment_at(40.0).weight;
        assert!((weight - other).abs() < 1e-6);
        assert!((0.499..0.75).contains(&weight), "{weight}");
        a.set_time(40.0);
        b.set_time(40.0);
        for c in 0..2 {
            let (found, a, b) = (changing.fields(c), a.fields(c), b.fields(c));
            let fields = [
                (found.displacement, a.displacement, b.displacement, 1),
                (found.velocity, a.velocity, b.velocity, 1),
                (found.velocity, a.velocity, b.velocity, 3),
                (found.derivative, a.derivative, b.derivative, 0),
            ];
            for (found, a, b, n) in fields {
                let rms = (found.iter().map(|x| x[n] * x[n]).sum::<f32>() / found.len() as f32).sqrt();
                for ((found, a), b) in found.iter().zip(a).zip(b) {
                    assert!((found[n] - weight * (a[n] + b[n])).abs() < 1e-5 * rms, "{} {}", found[n], a[n] + b[n]);
                }
            }
        }
    }
}

#[test]
fn variance_lies_between_the_two_seas() {
    for (after, plain) in changes() {
        let mut changing = sea(desc(8.0));
        changing.change_to(after.clone(), 0.0, 60.0).unwrap();
        let (mut before, mut after) = (sea(desc(8.0)), sea(after));
        for t in [6.0, 20.0, 30.0, 41.0, 55.0] {
            let (a, b) = (variance(&mut before, t), variance(&mut after, t));
            let found = variance(&mut changing, t);
            let stated = f64::from(changing.significant_height() / 4.0).powi(2);
            // At one moment, up to what opposite waves have in common, or waves of other phases by chance.
            assert!((found / stated - 1.0).abs() < if plain { 0.03 } else { 0.2 }, "{a} {found} {stated} {b}");
            let (low, high) = (before.significant_height(), after.significant_height());
            let found = changing.significant_height();
            assert!(found >= 0.9999 * low.min(high) && found <= 1.0001 * low.max(high), "{low} {found} {high}");
        }
    }
}

#[test]
fn a_change_during_a_change_does_not_pop() {
    for (first, plain) in changes() {
        let mut ocean = sea(desc(8.0));
        ocean.change_to(first, 10.0, 60.0).unwrap();
        ocean.set_time(30.0 - TICK);
        let before = heights(&mut ocean, 30.0);
        let quiet = step(&mut ocean, 29.8);
        ocean.change_to(desc(11.0), 30.0, 20.0).unwrap();
        for (a, b) in before.iter().zip(heights(&mut ocean, 30.0)) {
            assert!((a - b).abs() < 1e-5, "{a} {b}");
        }
        assert!(step(&mut ocean, 30.0) < 1.1 * quiet);
        assert!(step(&mut ocean, 70.0) < 2.0 * quiet, "a fade is waited for");
        // A fade ends at 70 s first.
        let end = if plain { 50.0 } else { 90.0 };
        let mut new = sea(desc(11.0));
        assert_ne!(arrays(&mut ocean, end - 0.5), arrays(&mut new, end - 0.5));
        assert_eq!(arrays(&mut ocean, end), arrays(&mut new, end));
        // Back to before it all.
        assert_eq!(arrays(&mut ocean, 5.0), arrays(&mut sea(desc(8.0)), 5.0));
    }
}

#[test]
fn changes_asked_for_all_the_time_do_not_pile_up() {
    let mut ocean = sea(desc(8.0));
    let mut last = heights(&mut ocean, 0.0);
    let own = step(&mut sea(desc(14.0)), 0.0);
    for i in 1..60 {
        let t = f64::from(i) * TICK;
        ocean.change_to(desc(8.0 + 0.1 * i as f32), t - TICK, 5.0).unwrap();
        let now = heights(&mut ocean, t);
        for (a, b) in last.iter().zip(&now) {
            assert!((a - b).abs() < 1.5 * own);
        }
        last = now;
    }
    assert!(ocean.significant_height() > sea(desc(8.0)).significant_height());
    assert!(ocean.peak_period() > sea(desc(8.0)).peak_period());
}

#[test]
fn mode_sets_and_moment_say_what_is_mixed() {
    let mut ocean = sea(desc(8.0));
    let (alone, revision) = (ocean.moment_at(3.0), ocean.revision());
    assert_eq!((alone.weight, alone.sets[1]), ([1.0, 0.0], 0));
    assert!(ocean.mode_sets().1.is_none());
    ocean.change_to(desc(14.0), 10.0, 60.0).unwrap();
    assert_eq!(ocean.moment_at(3.0), alone);
    assert_eq!(ocean.revision(), revision);
    let mixed = ocean.moment_at(40.0);
    assert_eq!(mixed.phase[0], mixed.phase[1]);
    assert_ne!(mixed.sets[0], mixed.sets[1]);
    assert!(ocean.mode_sets_at(40.0).1.is_some());
    ocean.set_time(40.0);
    assert_ne!(ocean.revision(), revision);
    let over = ocean.moment_at(80.0);
    assert_eq!((over.weight, over.sets), ([1.0, 0.0], [mixed.sets[1], 0]));
}

#[test]
fn a_clone_is_another_time_of_the_same_sea() {
    let mut ocean = sea(desc(8.0));
    let mut other = ocean.clone();
    let now = arrays(&mut ocean, 2.0);
    assert_ne!(arrays(&mut other, 9.0), now);
    assert_eq!(arrays(&mut other, 2.0), now);
    assert_eq!(other.moment_at(2.0), ocean.moment_at(2.0));
}

#[test]
fn a_change_that_cannot_be_leaves_the_sea() {
    let mut ocean = sea(desc(8.0));
    let now = arrays(&mut ocean, 2.0);
    let mut other = desc(9.0);
    other.cascades = (0..7).map(|i| CascadeDesc::new(16, 250.0 * 0.7f32.powi(i))).collect();
    assert!(ocean.change_to(other, 0.0, 5.0).is_err());
    assert!(ocean.change_to(desc(9.0), f64::NAN, 5.0).is_err());
    assert!(ocean.change_to(desc(9.0), 0.0, -1.0).is_err());
    assert!(ocean.change_to(OceanDesc { choppiness: 9.0, ..desc(9.0) }, 0.0, 5.0).is_err());
    assert_eq!(arrays(&mut ocean, 2.0), now);
    // At once.
    ocean.change_to(desc(9.0), 1.0, 0.0).unwrap();
    assert_eq!(arrays(&mut ocean, 2.0), arrays(&mut sea(desc(9.0)), 2.0));
}
