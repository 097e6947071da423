//! Case `frame_allocations`: how often ticks ask the heap for memory once everything has its size.

use floating_body::{BodyDesc, BodyState, Controls, FleetDesc, Hull, MooringLine, Radiation};
use glam::Vec3;
use open_water::{BodyId, BodyStates, Follow, GridDesc, Look, Mooring, OpenWater, OpenWaterDesc, Preset, WakesDesc};

use crate::evidence::{Case, CaseError, Context, Row, allocations};
use crate::fixtures::{CRATE_MASS, FRAME, crate_hull};

/// See the module.
pub(super) const ALLOCATIONS: Case = Case {
    name: "frame_allocations",
    about: "allocations of 300 ticks once everything has its size, from a thread of rayon's pool and from another",
    plots: &[],
    run,
};

struct Scene {
    water: OpenWater,
    store: BodyStates,
}

impl Scene {
    fn new(calm: bool) -> Result<Self, CaseError> {
        let mut desc: OpenWaterDesc = Preset::Low.water();
        if calm {
            desc.sea.partitions.clear();
        }
        Ok(Self { water: OpenWater::headless(desc)?, store: BodyStates::default() })
    }

    /// A boat that goes round in circles.
    fn boat(&mut self, x: f32, radiation: Radiation) -> Result<BodyId, CaseError> {
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?;
        let id = self.water.add_body(BodyDesc { radiation, ..BodyDesc::boat(&hull, 4_000.0, 10.0) })?;
        self.water.set_controls(id, Controls { throttle: 0.7, steering: 0.6, ..Controls::default() })?;
        let state = self.water.body(id)?.state();
        self.store.insert(id, BodyState { position: state.position + Vec3::X * x, ..state });
        Ok(id)
    }

    fn run(&mut self, ticks: usize) {
        for _ in 0..ticks {
            for tick in self.water.advance(FRAME) {
                let _ = self.water.tick(tick, &mut self.store);
            }
        }
    }
}

fn bodies() -> Result<Scene, CaseError> {
    let mut scene = Scene::new(false)?;
    for i in 0..200 {
        let id = scene.water.add_body(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS))?;
        scene.store.insert(id, BodyState::at_rest(Vec3::new((i % 20) as f32 * 2.0, 0.0, 4.0 + (i / 20) as f32 * 2.0)));
    }
    let boat = scene.boat(0.0, Radiation::default())?;
    scene.water.add_grid(GridDesc { follow: Follow::Body(boat), ..Preset::Low.grid() })?;
    Ok(scene)
}

fn fleet() -> Result<Scene, CaseError> {
    let mut scene = Scene::new(false)?;
    let fleet = scene.water.add_fleet(FleetDesc::new(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS)))?;
    for i in 0..1000 {
        let at = Vec3::new((i % 40) as f32 * 2.0, 0.0, (i / 40) as f32 * 2.0);
        scene.water.fleet_mut(fleet)?.add(BodyState::at_rest(at))?;
    }
    Ok(scene)
}

fn moored() -> Result<Scene, CaseError> {
    let mut scene = Scene::new(false)?;
    for i in 0..8 {
        let x = 20.0 * i as f32;
        let body = scene.boat(x, Radiation::default())?;
        let line = MooringLine::anchored(Vec3::X * 2.8, Vec3::new(x + 9.0, -3.0, 1.0), 6.0, 4_000.0, 900.0);
        scene.water.add_mooring(Mooring { body, line })?;
    }
    Ok(scene)
}

fn textures() -> Result<Scene, CaseError> {
    let mut scene = Scene::new(true)?;
    scene.boat(-12.0, Radiation::Grid)?;
    scene.boat(12.0, Radiation::Grid)?;
    scene.water.add_grid(Preset::Low.grid())?;
    Ok(scene)
}

fn wakes() -> Result<Scene, CaseError> {
    let mut scene = Scene::new(false)?;
    for i in 0..6 {
        scene.boat(30.0 * i as f32, Radiation::default())?;
    }
    let grid = GridDesc { cells: [128; 2], ..Preset::Low.grid() };
    scene.water.set_wakes(Some(WakesDesc { cells: 4 << 14, grid, ..WakesDesc::default() }))?;
    scene.water.look(Look { eye: Vec3::new(-30.0, 9.0, 0.0), direction: Vec3::X, fov_y: 0.8, aspect: 1.5 });
    Ok(scene)
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    let settle = context.pick(400, 1200);
    type Make = fn() -> Result<Scene, CaseError>;
    let scenes: [(&str, Make); 5] = [
        ("200 crates, a boat in its grid, the default sea", bodies),
        ("a fleet of 1,000 on the default sea", fleet),
        ("eight moored boats, anchors that drag", moored),
        ("two boats that make waves by textures", textures),
        ("six boats, wakes by themselves", wakes),
    ];
    let mut rows = Vec::new();
    for (name, make) in scenes {
        let mut scene = make()?;
        let asked = pool.install(|| {
            scene.run(settle);
            allocations(|| scene.run(300))
        });
        scene.run(10);
        let outside = allocations(|| scene.run(300));
        rows.push(
            Row::new("frame_allocations", name)
                .param("from_another_thread", outside)
                .error(asked as f64, "allocations in 300 ticks", "none")
                .bound(0.0),
        );
    }
    Ok(rows)
}
