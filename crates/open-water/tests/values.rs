//! Descriptions as `serde` values: what is read is what was written, and is checked where it enters.
#![cfg(feature = "serde")]

use glam::{DVec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Closure, Damping, DepthMap, DirectionalTable, FleetDesc, Follow,
    ForcePoints, GridDesc, Hull, Land, Mooring, MooringLine, Obstacle, ObstacleKind, OpenWater, OpenWaterDesc,
    OpenWaterError, Partition, Preset, Quality, Rain, SeaState, Shelter, Spectrum, Spreading, TableRow, Tail, TriMesh,
    WakesDesc,
};
use serde_json::{Value, from_str, from_value, to_string, to_value};

/// Written and read: the same to the last digit.
fn round<T: serde::Serialize + serde::de::DeserializeOwned + std::fmt::Debug>(value: &T) -> T {
    let read: T = from_str(&to_string(value).unwrap()).unwrap();
    assert_eq!(format!("{value:?}"), format!("{read:?}"));
    read
}

/// An open box of a boat: its deck is capped, its keel is no corner of anything.
fn open_hull() -> TriMesh {
    let ring = [[-2.1, 0.7], [1.3, 0.9], [2.3, 0.05], [1.1, -0.8], [-2.0, -0.75]];
    let mut vertices: Vec<_> = ring.iter().map(|[x, z]| Vec3::new(*x, 0.61, *z)).collect();
    vertices.push(Vec3::new(0.1, -0.5, 0.03));
    let indices = (0..5).flat_map(|i| [i, (i + 1) % 5, 5]).collect();
    TriMesh { vertices, indices }
}

#[test]
fn descriptions_are_read_as_they_were_written() {
    let rows = (0..6).map(|i| TableRow { frequency: 0.05 * (i + 1) as f32, density: 1.5, direction: 0.1, s: 8.0 });
    let table = DirectionalTable::new(vec![0.1, 0.2, 0.3], vec![-3.0, -1.0, 1.0, 2.5], vec![0.5; 12]).unwrap();
    let sea = SeaState::tma(11.0, 80e3, 0.4, 12.0)
        .with_swell(1.0, 11.0, 2.0)
        .with(Partition {
            tail: Tail::Donelan,
            ..Partition::new(Spectrum::Table(rows.collect()), 0.0, Spreading::BothWays)
        })
        .with(Partition::new(Spectrum::Directional(table), 0.0, Spreading::DonelanBanner));
    for preset in Preset::ALL {
        round(&OpenWaterDesc { sea: sea.clone(), ..preset.water() });
        round(&preset.grid());
        round(&preset);
    }
    let rain = Some(Rain { rate: 3.0, drop_radius: 0.001, seed: u64::MAX });
    round(&GridDesc { depth: 4.0, rain, follow: Follow::Fixed(DVec2::new(0.1, 1e7)), ..GridDesc::default() });
    assert_eq!(round(&GridDesc::default()).depth, f32::INFINITY);
    round(&WakesDesc::default());
    let hull = Hull::from_mesh(&open_hull(), Closure::Cap).unwrap();
    let boat = BodyDesc::boat(&hull, 900.0, 9.0);
    round(&FleetDesc::new(BodyDesc::from_hull(&Hull::cylinder(0.3, 1.1).unwrap(), 100.0)));
    let points = ForcePoints::Given(open_water::Body::new(boat.clone()).unwrap().force_points().to_vec());
    let read: BodyDesc =
        from_str(&to_string(&BodyDesc { points, quality: Quality::Near(30.0), ..boat }).unwrap()).unwrap();
    assert_eq!(read.quality, Quality::Near(30.0));
    let mooring = Mooring { body: BodyId::default(), line: MooringLine::rope(Vec3::X, Vec3::Y, 5.0, 100.0) };
    assert_eq!(round(&mooring), mooring);
    let bed = DepthMap::new(DVec2::new(-3.3, 8.0), 2.5, [3, 2], vec![-4.0, -2.2, 1.0, -7.7, 0.1, 2.0]).unwrap();
    let mut land = Land::new(bed);
    land.obstacles = vec![Obstacle { outline: vec![DVec2::X, DVec2::Y, DVec2::ZERO], kind: ObstacleKind::Fixed }];
    (land.damping, land.shelter) = (Damping::Given(vec![0.1; 6]), Shelter::Given(vec![0.5; 6]));
    assert_eq!(round(&land), land);
}

/// Hashes of a body of this description, dropped into the sea.
fn dropped(desc: BodyDesc) -> Vec<u64> {
    let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
    let id = water.add_body(desc).unwrap();
    let mut bodies = BodyStates::default();
    bodies.insert(id, BodyState::at_rest(Vec3::new(0.0, 1.0, 0.0)));
    let mut hashes = Vec::new();
    for tick in water.ticks_until(30) {
        water.tick(tick, &mut bodies).unwrap();
        hashes.push(water.hash());
    }
    hashes
}

#[test]
fn a_hull_that_was_read_floats_as_the_one_that_was_written() {
    let mesh = |closure| Hull::from_mesh(&open_hull(), closure).unwrap();
    let hulls = [
        mesh(Closure::Cap),
        mesh(Closure::ConvexHull),
        Hull::cuboid(Vec3::new(1.1, 0.7, 0.3)).unwrap(),
        Hull::sphere(0.37).unwrap(),
        Hull::cylinder(0.3, 1.7).unwrap(),
        Hull::hollow_cylinder(1.9, 0.41, 0.9).unwrap(),
    ];
    for hull in hulls {
        let desc = BodyDesc { quality: Quality::Clipped, ..BodyDesc::from_hull(&hull, 60.0) };
        let read: BodyDesc = from_str(&to_string(&desc).unwrap()).unwrap();
        assert_eq!(read.hull.kind(), hull.kind());
        let parts = |hull: &Hull| (hull.volume(), hull.centroid(), hull.unit_inertia(), hull.bounds());
        assert_eq!(parts(&read.hull), parts(&hull));
        assert_eq!(dropped(read), dropped(desc));
    }
}

#[test]
fn what_is_read_is_checked_where_it_enters() {
    let desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::ONE).unwrap(), 400.0);
    let with = |mut value: Value, pointer: &str, to: Value| {
        *value.pointer_mut(pointer).unwrap() = to;
        value
    };
    let mut water = OpenWater::headless(OpenWaterDesc::default()).unwrap();
    let heavy: BodyDesc = from_value(with(to_value(&desc).unwrap(), "/mass", (-4.0).into())).unwrap();
    assert!(matches!(water.add_body(heavy), Err(OpenWaterError::Body(_))));
    let flat = with(to_value(&desc).unwrap(), "/hull/Cuboid/size", vec![0.0, 1.0, 1.0].into());
    assert!(from_value::<BodyDesc>(flat).unwrap_err().to_string().contains("[0.001, 1000] m"));
    let grid: GridDesc = from_value(with(to_value(GridDesc::default()).unwrap(), "/cells/0", 7.into())).unwrap();
    assert!(matches!(water.add_grid(grid), Err(OpenWaterError::Grid(_))));
    let bed = DepthMap::new(DVec2::ZERO, 2.0, [2, 2], vec![-4.0; 4]).unwrap();
    let dry = with(to_value(bed).unwrap(), "/elevations", vec![1.0; 4].into());
    assert!(from_value::<DepthMap>(dry).unwrap_err().to_string().contains("upside down"));
}
