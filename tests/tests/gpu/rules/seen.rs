//! Rules with an error: what is below a pixel of every view.

use super::*;

/// What is drawn by all rules and without one, at one moment: `surface_at`, and looks of a pixel of that width.
type Drawn = (FramePlan, Vec<[f32; 4]>, Vec<[f32; 8]>);

fn drawn(context: &Context, scene: &mut Scene, rules: Rules, views: &[View], reach: f32, pixel: f32) -> Drawn {
    // Another moment in between: else all would stand.
    let near = high(Vec3::Y * 5.0);
    scene.water.set_rules(Rules::empty());
    let mut plan = scene.water.plan(&near, ALL);
    plan.time += 7.0;
    context.submit(|encoder| scene.water.encode(&plan, encoder));
    let plan = draw(context, &mut scene.water, rules, views, ALL);
    let points = points(reach);
    (plan, probe(context, &scene.water, &points), looks(context, &scene.water, &points, pixel))
}

fn largest(a: &[[f32; 8]], b: &[[f32; 8]], of: std::ops::Range<usize>) -> f32 {
    a.iter().zip(b).flat_map(|(a, b)| of.clone().map(|k| (a[k] - b[k]).abs())).fold(0.0, f32::max)
}

#[test]
fn cascades_below_a_pixel_miss_by_less_than_one() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    tick(&mut scene, 60);
    let all = scene.water.ocean().unwrap().modes().len();
    let mut counts = Vec::new();
    for height in [20.0f32, 1_100.0, 8_000.0, 60_000.0] {
        let views = high(Vec3::Y * height);
        let pixel = 1e-3 * (height - scene.water.ocean().unwrap().significant_height());
        let (plan, with, with_looks) = drawn(&context, &mut scene, Rules::all(), &views, 300.0, pixel);
        let (_, without, without_looks) = drawn(&context, &mut scene, Rules::empty(), &views, 300.0, pixel);
        let skipped = plan.skipped.iter().find_map(|s| match s.work {
            SkippedWork::Cascades { count } => Some(count as usize),
            _ => None,
        });
        counts.push(skipped.unwrap_or(0));
        let (worst, rms) = apart(&with, &without);
        let looks = largest(&with_looks, &without_looks, 0..8);
        println!("{height} m: {:?} of {all} left out, {worst} m worst, {rms} m rms, looks {looks}", counts.last());
        assert!(worst < pixel && rms < 0.25 * pixel, "{worst} and {rms} m of {pixel}");
        assert!((worst > 0.0) == (skipped > Some(0)), "{worst}");
        // Vertices keep an eighth and less of what shading has let go, of a cascade that is a small part of a pixel high.
        assert!(largest(&with_looks, &without_looks, 0..3) < 0.5 * pixel);
        assert!(largest(&with_looks, &without_looks, 3..8) < 1e-3, "{looks}");
    }
    assert_eq!(counts, [0, 1, 2, 2], "of {all}");
    assert!(context.take_errors().is_empty());
}

#[test]
fn the_view_that_sees_best_counts() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    tick(&mut scene, 10);
    let far = View { eye: Vec3::Y * 5e4, pixel_angle: 1e-3 };
    let made = |views: &[View]| {
        let plan = scene.water.plan(views, ALL);
        plan.work.iter().find_map(|work| match work {
            open_water::Work::Ocean { cascades } => Some(*cascades),
            _ => None,
        })
    };
    assert!(made(&[far]) < Some(3));
    // From below, near the surface, without an idea of it.
    let wild = [f32::NAN, f32::INFINITY, -f32::INFINITY];
    let eyes = wild.map(|y| View { eye: Vec3::Y * y, ..far });
    let angles = [f32::NAN, f32::INFINITY, 0.0, -1.0].map(|pixel_angle| View { pixel_angle, ..far });
    for view in eyes.into_iter().chain(angles).chain([View { eye: Vec3::Y * -3.0, ..far }]) {
        assert_eq!(made(&[far, view]), Some(3), "{view:?}");
    }
    assert_eq!(made(&[]), Some(3), "a consumer without a view reads all");
}

#[test]
fn a_sea_that_stands_for_some_frames_misses_by_less_than_a_tenth_of_a_pixel() {
    let context = Context::new();
    let (mut stands, mut moves) = (0, 0);
    for height in [400.0f32, 4_000.0] {
        let mut scene = scene(Some(&context), Preset::Low.water());
        let (views, pixel) = (high(Vec3::Y * height), 1e-3 * height);
        let rules = Rules::all() - Rules::SHORT;
        for _ in 0..10 {
            tick(&mut scene, 1);
            let plan = draw(&context, &mut scene.water, rules, &views, ALL);
            let still = skips(&plan, SkippedWork::Ocean, Reason::Still);
            (stands, moves) = (stands + u32::from(still), moves + u32::from(!still));
            let points = points(300.0);
            let with = probe(&context, &scene.water, &points);
            // On another water, as this one would be made anew by the same rule.
            if still {
                let shown = scene.water.plan(&views, ALL);
                let mut other = OpenWater::new(&context.device, &context.queue, Preset::Low.water()).unwrap();
                draw_at(&context, &mut other, shown.time);
                let (_, rms) = apart(&with, &probe(&context, &other, &points));
                assert!(rms > 0.0 && rms < 0.1 * pixel, "{rms} m of {pixel}");
            }
        }
    }
    println!("stood in {stands} frames, made in {moves}");
    assert!(stands >= 6 && moves >= 6, "{stands} and {moves}");
}

fn draw_at(context: &Context, water: &mut OpenWater, time: f64) {
    let mut plan = water.plan(&high(Vec3::Y * 5.0), ALL);
    plan.time = time;
    context.submit(|encoder| water.encode(&plan, encoder));
}

#[test]
fn a_wake_too_far_to_be_seen_is_not_sent() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    tick(&mut scene, 120);
    for (away, seen) in [(500.0f32, true), (12_000.0, false)] {
        let views = high(Vec3::new(away, 30.0, 0.0));
        let pixel = 1e-3 * (away - 40.0);
        let plan = draw(&context, &mut scene.water, Rules::FAR | Rules::SHORT, &views, ALL);
        assert_eq!(plan.upload_bytes() > 0, seen, "{plan}");
        assert_eq!(plan.skipped.iter().any(|s| s.reason == Reason::BelowAPixel), !seen, "{plan}");
        let points = points(30.0);
        let (with, with_looks) =
            (probe(&context, &scene.water, &points), looks(&context, &scene.water, &points, pixel));
        draw(&context, &mut scene.water, Rules::SHORT, &views, ALL);
        let (without, without_looks) =
            (probe(&context, &scene.water, &points), looks(&context, &scene.water, &points, pixel));
        let (worst, _) = apart(&with, &without);
        println!("{away} m: {worst} m worst");
        assert!(worst < pixel && (worst > 0.0) != seen, "{worst} m of {pixel}");
        assert_eq!(with_looks, without_looks);
    }
    assert!(context.take_errors().is_empty());
}

#[test]
fn dry_hulls_below_a_pixel_are_not_drawn() {
    let context = Context::new();
    let mut scene = scene(Some(&context), crate::surface::calm());
    let hull = open_water::Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    scene.water.set_dry(scene.boat, Some(hull.dry(0.1, 0.1).unwrap())).unwrap();
    tick(&mut scene, 2);
    for (away, drawn) in [(1_000.0f32, true), (20_000.0, false)] {
        let plan = draw(&context, &mut scene.water, Rules::all(), &high(Vec3::X * away), ALL);
        assert_eq!(skips(&plan, SkippedWork::DryHulls { count: 1 }, Reason::BelowAPixel), !drawn, "{plan}");
        assert_eq!(plan.to_string().contains("+ dry hulls"), drawn, "{plan}");
    }
}
