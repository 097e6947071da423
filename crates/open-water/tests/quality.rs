//! Quality changes while the water runs: no pop, and the end is what it would have been from the start.

use glam::{DVec2, Vec2};
use open_water::{
    BodyStates, CascadeDesc, DepthMap, Follow, GridDesc, GridId, Land, OpenWater, OpenWaterDesc, OpenWaterError,
    Preset, Scheme, SeaState, WaterSample,
};

const DT: f32 = 1.0 / 60.0;

fn desc(cascades: &[(u32, f32)]) -> OpenWaterDesc {
    OpenWaterDesc {
        cascades: cascades.iter().map(|&(size, tile)| CascadeDesc::new(size, tile)).collect(),
        ..Preset::Low.water()
    }
}

fn points(around: Vec2) -> Vec<Vec2> {
    (0..144).map(|i| around + 3.3 * Vec2::new((i % 12) as f32, (i / 12) as f32)).collect()
}

fn heights(water: &OpenWater, points: &[Vec2]) -> Vec<f32> {
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(points, &mut out);
    out.iter().map(|s| s.height).collect()
}

/// Runs for some ticks; the largest change of a height from one to the next.
fn run(water: &mut OpenWater, ticks: u32, points: &[Vec2]) -> f32 {
    let mut store = BodyStates::default();
    let (mut last, mut step) = (heights(water, points), 0.0f32);
    for _ in 0..ticks {
        for tick in water.advance(DT) {
            water.tick(tick, &mut store).unwrap();
        }
        let now = heights(water, points);
        step = now.iter().zip(&last).fold(step, |step, (a, b)| step.max((a - b).abs()));
        last = now;
    }
    step
}

const FEW: &[(u32, f32)] = &[(64, 400.0), (128, 75.0), (64, 11.0)];

#[test]
fn cascades_change_without_a_pop_and_end_as_if_they_had_always_been() {
    let at = points(Vec2::ZERO);
    for others in [&[(128, 400.0), (256, 75.0), (128, 11.0)][..], &[(128, 300.0), (128, 48.0)]] {
        let (mut changing, mut after) =
            (OpenWater::headless(desc(FEW)).unwrap(), OpenWater::headless(desc(others)).unwrap());
        let mut before = OpenWater::headless(desc(FEW)).unwrap();
        for water in [&mut before, &mut changing, &mut after] {
            run(water, 60, &[]);
        }
        changing.set_cascades(desc(others).cascades, 2.0).unwrap();
        // It begins half a second after the call.
        let early = [&mut before, &mut changing].map(|water| run(water, 30, &at));
        assert_eq!(heights(&before, &at), heights(&changing, &at), "{others:?}");
        let step = early[1].max(run(&mut changing, 130, &at));
        // What the seas do by themselves in the same time; a fade of 2 s adds up to .0125 of their difference a tick.
        let usual = early[0].max(run(&mut before, 130, &at)).max(run(&mut after, 160, &at));
        assert!(step < 1.6 * usual, "{others:?}: {step} against {usual}");
        assert_eq!(heights(&changing, &at), heights(&after, &at), "{others:?}");
        assert_eq!(changing.desc().cascades, desc(others).cascades);
    }
}

#[test]
fn presets_follow_on_each_other() {
    let at = points(Vec2::new(700.0, -300.0));
    let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
    let mut before = Preset::Low;
    for preset in [Preset::Medium, Preset::Low] {
        run(&mut water, 10, &[]);
        let mut twins = [before, preset].map(|preset| OpenWater::headless(preset.water()).unwrap());
        water.set_quality(preset).unwrap();
        let behind = water.reports().ticks as u32;
        let step = run(&mut water, 155, &at);
        let usual = twins.each_mut().map(|twin| {
            run(twin, behind, &[]);
            run(twin, 155, &at)
        });
        let usual = usual[0].max(usual[1]);
        before = preset;
        assert!(step < 1.6 * usual, "{preset:?}: {step} against {usual}");
        assert_eq!(water.desc().cascades, preset.water().cascades);
        assert_eq!(water.ocean().unwrap().desc().cascades, preset.water().cascades);
    }
}

#[test]
fn a_sea_on_tiles_of_its_own_changes_size_alone() {
    let mut water = OpenWater::headless(desc(FEW)).unwrap();
    water.set_quality(Preset::Medium).unwrap();
    let size = Preset::Medium.water().cascades[0].size;
    assert!(water.desc().cascades.iter().zip(FEW).all(|(now, own)| (now.size, now.tile) == (size, own.1)));
}

#[test]
fn two_runs_are_equal_however_fast_the_new_sea_is_made() {
    let at = points(Vec2::ZERO);
    let run_all = |wait: bool| {
        let mut water = OpenWater::headless(desc(FEW)).unwrap();
        let mut heard = Vec::new();
        for i in 0..90 {
            if i == 10 {
                water.set_choppiness(0.4, 0.5).unwrap();
            }
            if i == 20 {
                water.change_sea(SeaState::height_period(0.7, 5.0, 1.0), 0.3).unwrap();
            }
            if wait && i == 30 {
                std::thread::sleep(std::time::Duration::from_millis(300));
            }
            run(&mut water, 1, &[]);
            heard.extend(heights(&water, &at[..16]).into_iter().map(f32::to_bits));
        }
        heard
    };
    assert_eq!(run_all(true), run_all(false));
}

#[test]
fn the_lands_maps_keep_up_with_the_cascades() {
    let land = |deepest: f32| {
        let elevation = |i: usize| (-deepest + (i % 64) as f32 * 0.16).min(3.0);
        let bed = DepthMap::new(DVec2::splat(-40.0), 4.0, [64; 2], (0..64 * 64).map(elevation).collect());
        Some(Land::new(bed.unwrap()))
    };
    let other = &[(128, 300.0), (128, 48.0)];
    let (mut changing, mut after) =
        (OpenWater::headless(desc(FEW)).unwrap(), OpenWater::headless(desc(other)).unwrap());
    changing.set_land(land(9.0)).unwrap();
    after.set_land(land(9.0)).unwrap();
    let shore = points(Vec2::new(120.0, 20.0));
    let usual = run(&mut changing, 60, &shore).max(run(&mut after, 60, &shore));
    changing.set_cascades(desc(other).cascades, 2.0).unwrap();
    let step = run(&mut changing, 160, &shore);
    run(&mut after, 160, &shore);
    assert!(step < 1.4 * usual, "{step} against {usual}");
    assert_eq!(heights(&changing, &shore), heights(&after, &shore));
    // New land on the way.
    changing.set_cascades(desc(FEW).cascades, 2.0).unwrap();
    run(&mut changing, 60, &shore);
    changing.set_land(land(6.0)).unwrap();
    run(&mut changing, 100, &shore);
    let mut back = OpenWater::headless(desc(FEW)).unwrap();
    back.set_land(land(6.0)).unwrap();
    run(&mut back, 380, &[]);
    assert_eq!(heights(&changing, &shore), heights(&back, &shore));
    // And before the change begins, for which maps were being made.
    changing.set_cascades(desc(other).cascades, 1.0).unwrap();
    run(&mut changing, 10, &[]);
    changing.set_land(land(9.0)).unwrap();
    run(&mut changing, 100, &[]);
    run(&mut after, 270, &[]);
    assert_eq!(heights(&changing, &shore), heights(&after, &shore));
}

#[test]
fn changes_that_cannot_be_change_nothing() {
    let mut water = OpenWater::headless(desc(FEW)).unwrap();
    let many = (0..7).map(|i| CascadeDesc::new(32, 300.0 * 0.7f32.powi(i))).collect();
    for result in [
        water.set_cascades(Vec::new(), 1.0),
        water.set_cascades(many, 1.0),
        water.set_cascades(vec![CascadeDesc::new(100, 300.0)], 1.0),
        water.set_cascades(desc(FEW).cascades, f32::NAN),
        water.set_choppiness(f32::NAN, 1.0),
        water.set_choppiness(3.0, 1.0),
    ] {
        assert!(matches!(result, Err(OpenWaterError::Ocean(_))), "{result:?}");
    }
    assert_eq!((&water.desc().cascades, water.desc().choppiness), (&desc(FEW).cascades, desc(FEW).choppiness));
    let mut calm = desc(FEW);
    calm.sea.partitions.clear();
    OpenWater::headless(calm).unwrap().set_quality(Preset::High).unwrap();
}

/// A cube dropped into a grid on calm water.
fn splash() -> (OpenWater, BodyStates, GridId) {
    let mut calm = desc(FEW);
    calm.sea.partitions.clear();
    let mut water = OpenWater::headless(calm).unwrap();
    let grid = GridDesc {
        follow: Follow::Fixed(DVec2::ZERO),
        cells: [128; 2],
        cell_size: [0.5; 2],
        scheme: Scheme::Dispersive,
        ..GridDesc::default()
    };
    let id = water.add_grid(grid).unwrap();
    let hull = open_water::Hull::cuboid(glam::Vec3::splat(3.0)).unwrap();
    let desc =
        open_water::BodyDesc { radiation: open_water::Radiation::Grid, ..open_water::BodyDesc::from_hull(&hull, 9e3) };
    let body = water.add_body(desc).unwrap();
    let mut store = BodyStates::default();
    store.insert(body, open_water::BodyState::at_rest(glam::Vec3::new(0.0, 1.5, 0.0)));
    (water, store, id)
}

#[test]
fn a_grid_changes_its_cells_without_a_pop() {
    let (mut water, mut store, id) = splash();
    let (mut same, mut other, _) = splash();
    let at: Vec<Vec2> = (0..64).map(|i| Vec2::from_angle(i as f32) * (4.0 + 0.2 * i as f32)).collect();
    let mut last = heights(&water, &at);
    let mut worst = [0.0f32; 2];
    let mut now_id = id;
    for i in 0..240 {
        if i == 90 {
            now_id = water.set_grid_cells(id, [256; 2], [0.25; 2]).unwrap();
        }
        for tick in water.advance(DT) {
            water.tick(tick, &mut store).unwrap();
        }
        let now = heights(&water, &at);
        let step = now.iter().zip(&last).fold(0.0f32, |step, (a, b)| step.max((a - b).abs()));
        if i >= 30 {
            worst[usize::from((90..160).contains(&i))] = worst[usize::from((90..160).contains(&i))].max(step);
        }
        last = now;
        for tick in same.advance(DT) {
            same.tick(tick, &mut other).unwrap();
        }
        // Half a second after the old one has faded, the new one holds its waves.
        if i == 180 {
            let square = |heights: &mut dyn Iterator<Item = f32>| heights.map(|height| height * height).sum::<f32>();
            let usual = heights(&same, &at);
            let off = square(&mut last.iter().zip(&usual).map(|(a, b)| a - b)) / square(&mut usual.iter().copied());
            assert!(off < 0.05, "{off} of the energy");
        }
    }
    let [usual, changing] = worst;
    assert!(usual > 1e-3 && changing < 1.2 * usual, "{changing} against {usual}");
    assert_eq!(water.grid_count(), 1);
    assert_eq!(water.grid(now_id).unwrap().unwrap().desc().cells, [256; 2]);
    assert!(matches!(water.grid(id), Err(OpenWaterError::UnknownGrid(_))));
    assert!(water.set_grid_cells(now_id, [3; 2], [0.25; 2]).is_err());
    assert_eq!(water.grid_count(), 1);
}
