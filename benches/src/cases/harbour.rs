//! Cases of land: `seam`, `basin`, `gpu_vs_cpu_land`.

use glam::{DVec2, Vec2};
use ocean_spectrum::SeaState;
use open_water::{
    BodyStates, CascadeDesc, DepthMap, Edges, Follow, GridDesc, Land, Obstacle, ObstacleKind, OpenWater, OpenWaterDesc,
    Scheme, WaterSample,
};

use super::facade::{draw, probe};
use crate::{
    evidence::{Case, CaseError, Context, Row, measure},
    fixtures::{FRAME, Random},
};

/// See the module.
pub(super) const SEAM: Case = Case {
    name: "seam",
    about: "step of the height where a fed grid takes the sea over, over Hs; with growing distance from the edge",
    plots: &[],
    run: seam,
};

/// See the module.
pub(super) const BASIN: Case = Case {
    name: "basin",
    about: "wave heights before a breakwater, in its gap, round its head and in its lee; a tick of such a basin",
    plots: &[],
    run: basin,
};

/// See the module.
pub(super) const GPU_VS_CPU: Case = Case {
    name: "gpu_vs_cpu_land",
    about: "the drawn surface over land at high water, with a fed grid, on the GPU against the CPU's answer",
    plots: &[],
    run: gpu_vs_cpu,
};

/// Depth, metres, side of the map, metres, and significant height, metres, and peak period, seconds, of the sea.
const DEPTH: f32 = 10.0;
const SIDE: f32 = 400.0;
const HS: f32 = 1.2;
const PERIOD: f32 = 6.0;
/// Cell size, metres, cells along a side, and speed in deep water of waves of that period, m/s.
const CELL: f32 = 2.0;
const CELLS: u32 = 190;
const SPEED: f32 = 9.37;

fn sea() -> OpenWaterDesc {
    OpenWaterDesc {
        sea: SeaState { depth: Some(DEPTH), ..SeaState::height_period(HS, PERIOD, 0.0) },
        cascades: vec![CascadeDesc::new(128, 400.0), CascadeDesc::new(128, 75.0)],
        ..OpenWaterDesc::default()
    }
}

/// Water of one depth up to a beach of 1 in 8 that begins `beach` metres from the far side.
fn bed(beach: f32) -> Result<DepthMap, CaseError> {
    const TEXEL: f32 = 4.0;
    let side = (SIDE / TEXEL) as u32 + 1;
    let elevation = |i: u32| (-DEPTH + ((i % side) as f32 * TEXEL - SIDE + beach).max(0.0) / 8.0).min(3.0);
    Ok(DepthMap::new(DVec2::ZERO, TEXEL, [side; 2], (0..side * side).map(elevation).collect())?)
}

fn grid(feed: Edges) -> GridDesc {
    GridDesc {
        follow: Follow::Fixed(DVec2::splat(f64::from(SIDE) / 2.0)),
        cells: [CELLS; 2],
        cell_size: [CELL; 2],
        scheme: Scheme::NinePoint,
        wave_speed: SPEED,
        feed,
        ..GridDesc::default()
    }
}

fn tick(water: &mut OpenWater) -> Result<(), CaseError> {
    for tick in water.advance(FRAME) {
        water.tick(tick, &mut BodyStates::default())?;
    }
    Ok(())
}

fn heights(water: &OpenWater, points: &[Vec2]) -> Vec<f32> {
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(points, &mut out);
    out.iter().map(|sample| sample.height).collect()
}

fn seam(context: &Context) -> Result<Vec<Row>, CaseError> {
    let (mut open, mut fed) = (OpenWater::headless(sea())?, OpenWater::headless(sea())?);
    fed.set_land(Some(Land::new(bed(100.0)?)))?;
    let sides = Edges { low_x: true, low_z: true, high_z: true, high_x: false };
    let id = fed.add_grid(grid(sides))?;
    let corner = fed.grid(id)?.map_or(0.0, |grid| grid.window().world_corner().x as f32);
    let fade = |x: f32| {
        let place = DVec2::new(x.into(), f64::from(SIDE) / 2.0);
        fed.grid(id).ok().flatten().map_or(0.0, |grid| grid.fade_at(place))
    };
    // Where the fade begins, is half done and done, and further in.
    let reaches = |level: f32| (0..400).map(|i| corner + i as f32 * 0.25).find(|x| fade(*x) >= level).unwrap_or(corner);
    let half = reaches(0.5);
    let full = reaches(0.999);
    let lines = [("fade half done", half), ("fade done", full), ("50 m further in", full + 50.0)];
    let points = |x: f32| (0..60).map(|i| Vec2::new(x, 100.0 + i as f32 * (SIDE - 200.0) / 60.0)).collect::<Vec<_>>();
    let ticks = context.pick(60 * 80, 60 * 240);
    let mut squares = [0.0f64; 3];
    let mut count = 0usize;
    for now in 0..ticks {
        tick(&mut open)?;
        tick(&mut fed)?;
        // The grid fills within a minute.
        if now >= 60 * 60 && now % 20 == 0 {
            for (sum, (_, x)) in squares.iter_mut().zip(lines) {
                let points = points(x);
                let apart = heights(&fed, &points).into_iter().zip(heights(&open, &points));
                *sum += apart.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>() / points.len() as f64;
            }
            count += 1;
        }
    }
    let hs = open.ocean().map_or(f64::NAN, |ocean| f64::from(ocean.significant_height()));
    let row = |(sum, (name, x)): (f64, (&str, f32))| {
        let row = Row::new("seam", name)
            .param("metres_from_the_window", f64::from(((x - corner) * 4.0).round() / 4.0))
            .param("hs_m", (hs * 1e3).round() / 1e3)
            .error(100.0 * (sum / count as f64).sqrt() / hs, "%", "the same sea without land or grid; rms over Hs");
        if name.starts_with("fade") { row.bound(10.0) } else { row }
    };
    Ok(squares.into_iter().zip(lines).map(row).collect())
}

/// The bay behind a breakwater with a gap of 40 m.
fn harbour() -> Result<Land, CaseError> {
    let mut land = Land::new(bed(100.0)?);
    let wall = |low: f64, high: f64| Obstacle {
        outline: [[180.0, low], [190.0, low], [190.0, high], [180.0, high]].map(DVec2::from_array).to_vec(),
        kind: ObstacleKind::Reflecting,
    };
    land.obstacles = vec![wall(-10.0, 180.0), wall(220.0, 410.0)];
    Ok(land)
}

fn basin(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut water = OpenWater::headless(sea())?;
    water.set_land(Some(harbour()?))?;
    water.add_grid(grid(Edges { low_x: true, ..Edges::default() }))?;
    for _ in 0..60 * 60 {
        tick(&mut water)?;
    }
    let line = |from: [f32; 2], to: [f32; 2]| {
        (0..40).map(|i| Vec2::from(from).lerp(Vec2::from(to), i as f32 / 39.0)).collect::<Vec<_>>()
    };
    let places = [
        ("outside, with what the wall reflects", line([60.0, 60.0], [60.0, 340.0])),
        ("in the gap", line([185.0, 185.0], [185.0, 215.0])),
        ("round the head", line([230.0, 130.0], [260.0, 130.0])),
        ("in the lee", line([200.0, 40.0], [260.0, 40.0])),
    ];
    let mut squares = [0.0f64; 4];
    let mut count = 0usize;
    for now in 0..context.pick(60 * 30, 60 * 180) {
        tick(&mut water)?;
        if now % 15 == 0 {
            for (sum, (_, points)) in squares.iter_mut().zip(&places) {
                let heights = heights(&water, points);
                *sum += heights.iter().map(|h| f64::from(*h).powi(2)).sum::<f64>() / points.len() as f64;
            }
            count += 1;
        }
    }
    let hs = f64::from(HS);
    let rows = squares.into_iter().zip(&places).map(|(sum, (name, _))| {
        let share = 100.0 * 4.0 * (sum / count as f64).sqrt() / hs;
        let row = Row::new("basin", *name).error(share, "%", "significant height over the open sea's");
        if *name == "in the lee" { row.bound(30.0) } else { row }
    });
    let mut rows: Vec<Row> = rows.collect();
    let timing = measure(context.effort, || {
        let _ = tick(&mut water);
    });
    rows.push(
        Row::new("basin", "tick").param("cells", u64::from(CELLS * CELLS)).time("a tick of sea and basin", &timing),
    );
    Ok(rows)
}

fn gpu_vs_cpu(context: &Context) -> Result<Vec<Row>, CaseError> {
    const POINTS: usize = 10_000;
    let gpu = context.gpu()?;
    let mut water = OpenWater::new(&gpu.device, &gpu.queue, sea())?;
    water.set_land(Some(harbour()?))?;
    water.add_grid(grid(Edges { low_x: true, ..Edges::default() }))?;
    water.set_level(0.75)?;
    for _ in 0..context.pick(1200, 3600) {
        tick(&mut water)?;
    }
    let mut random = Random::new(3);
    let mut place = || random.within(-40.0, f64::from(SIDE) + 40.0) as f32;
    let points: Vec<Vec2> = (0..POINTS).map(|_| Vec2::new(place(), place())).collect();
    let mut truth = vec![WaterSample::default(); POINTS];
    water.sample(&points, &mut truth);
    // With nothing left over, a frame draws the tick before its last one: that of the answers.
    tick(&mut water)?;
    draw(gpu, &mut water)?;
    let made = probe(gpu, &water, &points)?;
    let (mut worst, mut worst_normal) = (0.0f64, 0.0f64);
    for (made, truth) in made.iter().zip(&truth).filter(|(_, truth)| !truth.folded) {
        let difference = f64::from(made[0] - truth.height).abs();
        worst = if difference.is_nan() { f64::NAN } else { worst.max(difference) };
        worst_normal = worst_normal.max(f64::from(glam::Vec3::from_slice(&made[1..]).distance(truth.normal)));
    }
    Ok(vec![
        Row::new("gpu_vs_cpu_land", gpu.adapter.kind.clone())
            .param("points", POINTS)
            .param("worst_normal", (worst_normal * 1e5).round() / 1e5)
            .error(worst * 1e3, "mm", "the CPU's answers from the same modes, maps and grid; worst point")
            .bound(1.0),
    ])
}
