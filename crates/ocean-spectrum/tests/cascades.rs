//! Cascades change while the sea runs.

use glam::Vec2;
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, SeaState};

const TICK: f64 = 1.0 / 60.0;
const START: f64 = 40.0;
const SECONDS: f64 = 4.0;

fn desc(cascades: &[(u32, f32)]) -> OceanDesc {
    OceanDesc {
        sea: SeaState::wind(9.0, 80e3, 0.4),
        cascades: cascades.iter().map(|&(size, tile)| CascadeDesc::new(size, tile)).collect(),
        seed: 9,
        ..OceanDesc::default()
    }
}

fn heights(ocean: &mut Ocean, t: f64) -> Vec<f32> {
    let points: Vec<Vec2> = (0..400).map(|i| Vec2::new(3.7 * (i % 20) as f32, 4.1 * (i / 20) as f32)).collect();
    let mut out = vec![0.0; points.len()];
    ocean.heights(&points, t, &mut out);
    out
}

/// Largest change of a height in a tick, from `a` to `b` seconds.
fn step(ocean: &mut Ocean, a: f64, b: f64) -> f32 {
    let mut last = heights(ocean, a);
    let mut worst = 0.0f32;
    for i in 1..=((b - a) / TICK) as u32 {
        let now = heights(ocean, a + f64::from(i) * TICK);
        worst = last.iter().zip(&now).fold(worst, |worst, (a, b)| worst.max((a - b).abs()));
        last = now;
    }
    worst
}

fn rms(a: &[f32], b: &[f32]) -> f32 {
    (a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f32>() / a.len() as f32).sqrt()
}

const SMALL: &[(u32, f32)] = &[(128, 300.0), (128, 60.0), (64, 9.0)];

/// Seas whose cascades differ from `SMALL`, and the number of cascades on the way.
const OTHERS: [(&[(u32, f32)], usize); 4] = [
    (&[(256, 300.0), (256, 60.0), (128, 9.0)], 6),
    (&[(128, 300.0), (256, 60.0)], 4),
    (&[(128, 250.0), (128, 45.0), (64, 8.0)], 6),
    (&[(512, 120.0)], 4),
];

#[test]
fn heights_do_not_pop_and_end_as_the_new_sea() {
    for (others, between) in OTHERS {
        for (from, to) in [(SMALL, others), (others, SMALL)] {
            let mut changing = Ocean::new(desc(from)).unwrap();
            let (mut before, mut after) = (changing.clone(), Ocean::new(desc(to)).unwrap());
            changing.change_to(desc(to), START, SECONDS).unwrap();
            assert_eq!(heights(&mut changing, START - TICK), heights(&mut before, START - TICK));
            let pop = |found: &[f32], own: &[f32]| found.iter().zip(own).fold(0.0f32, |m, (a, b)| m.max((a - b).abs()));
            let usual = step(&mut before, START, START + 1.0);
            let begin = pop(&heights(&mut changing, START), &heights(&mut before, START));
            assert!(begin < 1e-4, "{from:?} to {to:?}: {begin} against {usual}");
            changing.set_time(START);
            assert_eq!(changing.modes().len(), between, "{from:?} to {to:?}");
            assert_eq!(changing.cascade_places().unwrap().len(), between);
            before.set_time(START);
            assert!((changing.significant_height() - before.significant_height()).abs() < 1e-4);
            let end = START + SECONDS;
            let last = pop(&heights(&mut changing, end - 1e-6), &heights(&mut after, end - 1e-6));
            assert!(last < 1e-4, "{from:?} to {to:?}: {last} against {usual}");
            assert_eq!(heights(&mut changing, end + TICK), heights(&mut after, end + TICK));
            assert_eq!((changing.desc(), changing.cascade_places()), (&desc(to), None));
            // Each sea's own steps, half of both at worst, and what the weights add in 4 s.
            let usual = step(&mut before, START, end).max(step(&mut after, START, end));
            let found = step(&mut changing, START - 0.2, end + 0.2);
            assert!(found < 1.3 * usual, "{from:?} to {to:?}: {found} against {usual}");
        }
    }
}

#[test]
fn a_cascade_that_stays_keeps_its_waves() {
    let mut small = Ocean::new(desc(SMALL)).unwrap();
    let mut changing = small.clone();
    changing.change_to(desc(OTHERS[0].0), START, SECONDS).unwrap();
    let height = small.significant_height();
    for t in [START + 1.0, START + 2.0, START + 3.0, START + 9.0] {
        // What comes is what the smaller arrays do not hold: short waves.
        let off = rms(&heights(&mut small, t), &heights(&mut changing, t));
        assert!(off < 0.03 * height, "{off} of {height}");
    }
    // Where eight are too few for both, they are one.
    let many = |size: u32| (0..5).map(|i| (size, 300.0 * 0.4f32.powi(i))).collect::<Vec<_>>();
    let mut changing = Ocean::new(desc(&many(32))).unwrap();
    changing.change_to(desc(&many(64)), START, SECONDS).unwrap();
    changing.set_time(START + 2.0);
    assert_eq!(changing.cascade_places(), Some([0, 1, 2, 3, 4].map(|c| [Some(c); 2]).as_slice()));
}

#[test]
fn changes_of_cascades_wait_for_each_other_and_run_backwards() {
    let mut changing = Ocean::new(desc(SMALL)).unwrap();
    let (mut first, mut last) = (changing.clone(), Ocean::new(desc(OTHERS[3].0)).unwrap());
    changing.change_to(desc(OTHERS[2].0), START, SECONDS).unwrap();
    changing.set_time(START + 1.0);
    changing.change_to(desc(OTHERS[3].0), START + 1.0, SECONDS).unwrap();
    let usual = step(&mut first, START, START + 4.0).max(step(&mut last, START, START + 4.0));
    let found = step(&mut changing, START - 0.2, START + 2.0 * SECONDS + 0.2);
    assert!(found < 1.4 * usual, "{found} against {usual}");
    let end = START + 2.0 * SECONDS;
    assert_eq!(heights(&mut changing, end), heights(&mut last, end));
    assert_eq!(heights(&mut changing, 1.0), heights(&mut first, 1.0));
}
