//! Rules without an error, and that no view and no rule changes what is simulated.

use open_water::{BodyState, BodyStates};

use super::*;

#[test]
fn a_grid_that_sleeps_is_drawn_as_zeros_or_not_at_all() {
    let context = Context::new();
    let mut water = OpenWater::new(&context.device, &context.queue, Preset::Low.water()).unwrap();
    for home in [GridHome::Cpu, GridHome::Gpu] {
        water.add_grid(small_grid(home, DVec2::ZERO)).unwrap();
    }
    for tick in water.advance(DT) {
        water.tick(tick, &mut BodyStates::default()).unwrap();
    }
    let found = [Rules::all(), Rules::all() - Rules::ASLEEP].map(|rules| {
        let plan = draw(&context, &mut water, rules, &high(Vec3::Y * 5.0), ALL);
        (plan.upload_bytes(), plan.dispatches(), probe(&context, &water, &points(20.0)))
    });
    assert_eq!(found[0].2, found[1].2);
    assert!(found[0].0 == 0 && found[1].0 > 0, "{} and {} bytes", found[0].0, found[1].0);
}

#[test]
fn what_stands_unchanged_is_what_would_be_made() {
    let context = Context::new();
    let mut scene = both_homes(&context);
    tick(&mut scene, 60);
    let views = high(Vec3::Y * 5.0);
    let found = [Rules::empty(), Rules::UNCHANGED, Rules::empty()].map(|rules| {
        let plan = draw(&context, &mut scene.water, rules, &views, ALL);
        (plan.work.len(), probe(&context, &scene.water, &points(20.0)))
    });
    assert_eq!(found[0].1, found[1].1);
    assert_eq!(found[1].1, found[2].1);
    assert!(found[1].0 == 0 && found[0].0 >= 5, "{} of {}", found[1].0, found[0].0);
}

#[test]
fn looks_that_nobody_reads_change_no_height() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    tick(&mut scene, 30);
    let views = high(Vec3::Y * 5.0);
    let found = [Rules::UNASKED, Rules::empty()].map(|rules| {
        let plan = draw(&context, &mut scene.water, rules, &views, Consumers::empty());
        (plan.work.contains(&Work::OceanLooks), probe(&context, &scene.water, &points(20.0)))
    });
    assert!(!found[0].0 && found[1].0);
    assert_eq!(found[0].1, found[1].1);
    let unseen = [Rules::UNSEEN, Rules::empty()].map(|rules| {
        let plan = draw(&context, &mut scene.water, rules, &[], Consumers::empty());
        (plan.dispatches(), probe(&context, &scene.water, &points(20.0)))
    });
    assert!(unseen[0].0 == 0 && unseen[1].0 > 0);
    assert_eq!(unseen[0].1, unseen[1].1);
}

/// States of all bodies after 300 ticks that are looked at in this way.
fn run(context: Option<&Context>, rules: Rules, views: &[View], consumers: Consumers) -> Vec<BodyState> {
    let mut scene = scene(context, Preset::Low.water());
    scene.water.set_rules(rules);
    for frame in 0..300 {
        tick(&mut scene, 1);
        let plan = scene.water.plan(views, consumers);
        if let Some(context) = context.filter(|_| frame % 15 == 0) {
            context.submit(|encoder| scene.water.encode(&plan, encoder));
        }
    }
    let points = points(20.0);
    let mut water = vec![open_water::WaterSample::default(); points.len()];
    scene.water.sample(&points, &mut water);
    let heights = water.iter().map(|w| BodyState::at_rest(Vec3::splat(w.height)));
    scene.states().into_iter().chain(heights).collect()
}

#[test]
fn views_and_rules_change_nothing_that_is_simulated() {
    let context = Context::new();
    let server = run(None, Rules::all(), &[], Consumers::empty());
    let split = [high(Vec3::Y * 5.0), high(Vec3::Y * 3e4), high(Vec3::Y * -9.0), high(Vec3::splat(f32::NAN))].concat();
    for (rules, views) in
        [(Rules::all(), &split[..1]), (Rules::all(), &split), (Rules::empty(), &split[1..2]), (Rules::empty(), &[])]
    {
        assert!(run(Some(&context), rules, views, ALL) == server, "{rules:?} {views:?}");
    }
    assert!(run(None, Rules::empty(), &split, ALL) == server);
}
