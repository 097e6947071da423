//! Once things have found their sizes, ticks ask the heap for nothing. A binary of its own: it counts all that its process
//! asks for, and runs one test.

use std::alloc::System;

use glam::{DVec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodySlices, BodyState, BodyStates, BodyStore, Border, Controls, DepthMap, Edges, FleetDesc,
    Follow, GridDesc, Hull, Land, Look, Mooring, MooringLine, OpenWater, OpenWaterDesc, Preset, Quality, Radiation,
    Rain, Scheme, Stores, WakesDesc,
};
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const DT: f32 = 1.0 / 60.0;
/// Ticks until everything has its size, and ticks that are counted.
const TICKS: [usize; 2] = [400, 300];

struct Scene {
    water: OpenWater,
    store: BodyStates,
}

impl Scene {
    fn new(desc: OpenWaterDesc) -> Self {
        Self { water: OpenWater::headless(desc).unwrap(), store: BodyStates::default() }
    }

    fn sea() -> Self {
        Self::new(Preset::Low.water())
    }

    fn calm() -> Self {
        let mut desc = Preset::Low.water();
        desc.sea.partitions.clear();
        Self::new(desc)
    }

    /// A boat that goes round in circles.
    fn boat(&mut self, place: Vec3, change: impl Fn(BodyDesc) -> BodyDesc) -> BodyId {
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
        let id = self.water.add_body(change(BodyDesc::boat(&hull, 4_000.0, 10.0))).unwrap();
        self.water.set_controls(id, Controls { throttle: 0.7, steering: 0.6, ..Controls::default() }).unwrap();
        let state = self.water.body(id).unwrap().state();
        self.store.insert(id, BodyState { position: state.position + place, ..state });
        id
    }

    fn crates(mut self, count: usize) -> Self {
        for i in 0..count {
            let id = self.water.add_body(crate_desc()).unwrap();
            let at = Vec3::new(i as f32 % 20.0 * 2.0, 0.0, 3.0 + (i / 20) as f32 * 2.0);
            self.store.insert(id, BodyState::at_rest(at));
        }
        self
    }

    fn grid(&mut self, desc: GridDesc) -> open_water::GridId {
        self.water.add_grid(desc).unwrap()
    }

    fn run(&mut self, ticks: usize) {
        for _ in 0..ticks {
            for tick in self.water.advance(DT) {
                self.water.tick(tick, &mut self.store).unwrap();
            }
        }
    }
}

fn crate_desc() -> BodyDesc {
    BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.8)).unwrap(), 200.0)
}

fn small() -> GridDesc {
    GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() }
}

fn bodies_in_a_grid() -> Scene {
    let mut scene = Scene::sea().crates(100);
    let boat = scene.boat(Vec3::ZERO, |boat| BodyDesc { memory: true, quality: Quality::Clipped, ..boat });
    scene.grid(GridDesc { follow: Follow::Body(boat), ..small() });
    scene
}

fn other_schemes() -> Scene {
    let mut scene = Scene::sea();
    // Not `Scheme::Spectral`, which is for reference and takes scratch for its transforms.
    for (x, scheme) in [(0.0, Scheme::NinePoint), (90.0, Scheme::FivePoint)] {
        let boat = scene.boat(Vec3::X * x, |boat| boat);
        scene.grid(GridDesc { follow: Follow::Body(boat), scheme, wave_speed: 5.0, ..small() });
    }
    scene
}

fn fleets() -> Scene {
    let mut scene = Scene::sea();
    for radiation in [Radiation::Coefficients, Radiation::Grid] {
        let body = BodyDesc { radiation, ..crate_desc() };
        let fleet = scene.water.add_fleet(FleetDesc::new(body)).unwrap();
        for i in 0..500 {
            let at = Vec3::new(i as f32 % 25.0 * 1.5 - 18.0, 0.2, (i / 25) as f32 * 1.5 - 15.0);
            scene.water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(at)).unwrap();
        }
    }
    scene.grid(small());
    scene.water.look(Look { eye: Vec3::new(-60.0, 9.0, 0.0), direction: Vec3::X, fov_y: 0.8, aspect: 1.5 });
    scene
}

fn moorings() -> Scene {
    let mut scene = Scene::sea();
    for i in 0..8 {
        let at = Vec3::new(20.0 * i as f32, 0.0, 0.0);
        let body = scene.boat(at, |boat| boat);
        let line = MooringLine::anchored(Vec3::X * 2.8, at + Vec3::new(9.0, -3.0, 1.0), 6.0, 4_000.0, 900.0);
        scene.water.add_mooring(Mooring { body, line }).unwrap();
    }
    scene
}

fn textures() -> Scene {
    let mut scene = Scene::calm();
    for x in [-12.0, 12.0] {
        scene.boat(Vec3::X * x, |boat| BodyDesc { radiation: Radiation::Grid, ..boat });
    }
    scene.grid(Preset::Low.grid());
    scene
}

fn wakes() -> Scene {
    let mut scene = Scene::sea();
    for i in 0..6 {
        scene.boat(Vec3::new(30.0 * i as f32, 0.0, 0.0), |boat| boat);
    }
    scene.water.set_wakes(Some(WakesDesc { cells: 4 << 14, grid: small(), ..WakesDesc::default() })).unwrap();
    scene.water.look(Look { eye: Vec3::new(-30.0, 9.0, 0.0), direction: Vec3::X, fov_y: 0.8, aspect: 1.5 });
    scene
}

fn nested_and_rain() -> Scene {
    let mut scene = Scene::calm();
    let boat = scene.boat(Vec3::ZERO, |boat| boat);
    let follow = Follow::Body(boat);
    let around = scene.grid(GridDesc { follow, cell_size: [1.0; 2], ..Preset::Low.grid() });
    scene.grid(GridDesc { follow, within: Some(around), ..small() });
    scene.grid(GridDesc {
        cells: [98; 2],
        cell_size: [0.03; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 0.6,
        border: Border::Periodic,
        damping: 1.0,
        rain: Some(Rain { rate: 40.0, drop_radius: 0.002, seed: 3 }),
        ..GridDesc::default()
    });
    scene
}

fn land_and_a_fed_grid() -> Scene {
    let mut scene = Scene::sea().crates(20);
    let elevation = |i: usize| -12.0 + ((i % 96) as f32 - 75.0).max(0.0);
    let bed = DepthMap::new(DVec2::ZERO, 4.0, [96; 2], (0..96 * 96).map(elevation).collect()).unwrap();
    scene.water.set_land(Some(Land::new(bed))).unwrap();
    scene.grid(GridDesc {
        follow: Follow::Fixed(DVec2::splat(192.0)),
        cells: [176; 2],
        cell_size: [2.0; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 9.37,
        feed: Edges { low_x: true, ..Edges::default() },
        ..GridDesc::default()
    });
    scene
}

fn count(f: impl FnOnce()) -> usize {
    let before = INSTRUMENTED_SYSTEM.stats();
    f();
    let change = INSTRUMENTED_SYSTEM.stats() - before;
    change.allocations + change.reallocations
}

#[test]
fn steady_ticks_ask_the_heap_for_nothing() {
    // From a thread of the pool, as a game runs its ticks: rayon's queue for others allocates a block for 63 jobs.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    type Make = fn() -> Scene;
    let scenes: [(&str, Make); 8] = [
        ("bodies in a grid", bodies_in_a_grid),
        ("other schemes", other_schemes),
        ("fleets", fleets),
        ("moorings", moorings),
        ("textures", textures),
        ("wakes", wakes),
        ("nested grids and rain", nested_and_rain),
        ("land and a fed grid", land_and_a_fed_grid),
    ];
    let counted = pool.install(|| {
        scenes.map(|(name, make)| {
            let mut scene = make();
            scene.run(TICKS[0]);
            (name, count(|| scene.run(TICKS[1])))
        })
    });
    assert!(counted.iter().all(|(_, asked)| *asked == 0), "{counted:?}");
    pool.install(stores);
}

/// The ready-made stores ask for nothing either.
fn stores() {
    let mut scene = Scene::sea().crates(40);
    let ids: Vec<_> = (0..40).map(|_| scene.water.add_body(crate_desc()).unwrap()).map(Some).collect();
    let mut states: Vec<_> = (0..40).map(|i| BodyState::at_rest(Vec3::new(-2.0 * i as f32, 0.0, -9.0))).collect();
    let mut slices = BodySlices::default();
    let mut run = |ticks: usize| {
        for _ in 0..ticks {
            for tick in scene.water.advance(DT) {
                let mut of_slices = slices.store(&ids, &mut states);
                let mut both: [&mut dyn BodyStore; 2] = [&mut of_slices, &mut scene.store];
                scene.water.tick(tick, &mut Stores(&mut both)).unwrap();
            }
        }
    };
    run(TICKS[0]);
    assert_eq!(count(|| run(TICKS[1])), 0);
}
