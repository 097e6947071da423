//! Case `frame_world`: a world that moves its local origin, against the same one that stays at its own.

use floating_body::{BodyDesc, BodyState, Controls, FleetDesc, Hull};
use glam::{DVec2, Vec2, Vec3};
use open_water::{BodyId, BodyStates, CascadeDesc, Follow, GridDesc, OpenWater, OpenWaterDesc, Preset, WaterSample};

use crate::evidence::{Case, CaseError, Context, Row, measure};
use crate::fixtures::{CRATE_MASS, FRAME, Random, crate_hull};

/// See the module.
pub(super) const WORLD: Case = Case {
    name: "frame_world",
    about: "ways of a boat in its grid and of a crate, and heights, far out with and without a rebase, against the origin",
    plots: &[],
    run,
};

/// Tiles that all go whole times into 1 km, so that the sea there is that at the origin.
fn desc() -> OpenWaterDesc {
    let cascades = [250.0, 50.0, 10.0].map(|tile| CascadeDesc::new(128, tile)).to_vec();
    OpenWaterDesc { cascades, ..Preset::Low.water() }
}

struct World {
    water: OpenWater,
    store: BodyStates,
    bodies: [BodyId; 2],
    /// Local place of what is at the middle of the scene.
    middle: Vec3,
}

impl World {
    /// `far` metres out along x, of which the local origin lies at `origin`.
    fn new(far: f64, origin: f64) -> Result<Self, CaseError> {
        let mut water = OpenWater::headless(desc())?;
        water.rebase(DVec2::new(origin, 0.0))?;
        // A whole tile off, where no window stands yet in any of the worlds.
        let middle = Vec3::X * (far - origin + 250.0) as f32;
        let boat = water.add_body(BodyDesc::boat(&Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?, 4_000.0, 10.0))?;
        water.set_controls(boat, Controls { throttle: 0.7, steering: 0.4, ..Controls::default() })?;
        let bodies = [boat, water.add_body(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS))?];
        let mut store = BodyStates::default();
        for (id, x) in bodies.into_iter().zip([0.0, -120.0]) {
            let state = water.body(id)?.state();
            store.insert(id, BodyState { position: state.position + middle + Vec3::X * x, ..state });
        }
        water.add_grid(GridDesc { follow: Follow::Body(boat), ..Preset::Low.grid() })?;
        Ok(Self { water, store, bodies, middle })
    }

    fn tick(&mut self) -> Result<(), CaseError> {
        for tick in self.water.advance(FRAME) {
            self.water.tick(tick, &mut self.store)?;
        }
        Ok(())
    }

    fn rebase(&mut self, by: DVec2) -> Result<(), CaseError> {
        self.water.rebase(by)?;
        let shift = Vec3::new(by.x as f32, 0.0, by.y as f32);
        for id in self.bodies {
            if let Some(state) = self.store.get_mut(id) {
                state.position -= shift;
            }
        }
        self.middle -= shift;
        Ok(())
    }

    /// Where the bodies are, from the middle.
    fn ways(&self) -> Vec<Vec3> {
        self.bodies.iter().filter_map(|id| self.store.get(*id)).map(|state| state.position - self.middle).collect()
    }

    /// Heights around the middle.
    fn heights(&self) -> Vec<f32> {
        let points: Vec<Vec2> = (0..400)
            .map(|i| {
                Vec2::new(self.middle.x, self.middle.z) + Vec2::new(i as f32 % 20.0, (i / 20) as f32) * 1.37 - 14.0
            })
            .collect();
        let mut out = vec![WaterSample::default(); points.len()];
        self.water.sample(&points, &mut out);
        out.iter().map(|sample| sample.height).collect()
    }
}

/// Largest distance of bodies, and of heights, metres.
fn apart(a: &World, b: &World) -> [f64; 2] {
    let ways = a.ways().iter().zip(b.ways()).fold(0.0_f32, |most, (a, b)| most.max(a.distance(b)));
    let heights = a.heights().iter().zip(b.heights()).fold(0.0_f32, |most, (a, b)| most.max((a - b).abs()));
    [f64::from(ways), f64::from(heights)]
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(300, 1800);
    let mut here = World::new(0.0, 0.0)?;
    (0..ticks).try_for_each(|_| here.tick())?;
    let mut rows = Vec::new();
    for km in [1.0, 10.0, 100.0] {
        let far = km * 1e3;
        let [mut moved, mut stayed] = [World::new(far, far)?, World::new(far, 0.0)?];
        for _ in 0..ticks {
            moved.tick()?;
            stayed.tick()?;
        }
        let ([way, height], [way_without, height_without]) = (apart(&moved, &here), apart(&stayed, &here));
        rows.push(
            Row::new("frame_world", format!("{km} km out"))
                .param("ticks", ticks)
                .param("heights_m", height)
                .param("without_rebase_way_m", way_without)
                .param("without_rebase_heights_m", height_without)
                .error(way.max(height), "m, largest of ways and heights", "the same world at the origin")
                .bound(1e-6),
        );
    }
    let mut moved = World::new(0.0, 0.0)?;
    for tick in 0..ticks {
        if tick % 60 == 30 {
            moved.rebase(DVec2::new(if tick % 120 == 30 { 64.0 } else { -50.0 }, 8.0))?;
        }
        moved.tick()?;
    }
    let [way, height] = apart(&moved, &here);
    rows.push(
        Row::new("frame_world", "a rebase every second")
            .param("ticks", ticks)
            .param("teleports", moved.water.reports().teleports)
            .param("heights_m", height)
            .error(way.max(height), "m, largest of ways and heights", "the same world that stays")
            .bound(5e-3),
    );
    rows.push(cost(context)?);
    Ok(rows)
}

/// A rebase of much.
fn cost(context: &Context) -> Result<Row, CaseError> {
    let mut water = OpenWater::headless(desc())?;
    for i in 0..16 {
        let follow = Follow::Fixed(DVec2::new(30.0 * f64::from(i), 0.0));
        water.add_grid(GridDesc { follow, ..Preset::Low.grid() })?;
    }
    for _ in 0..1000 {
        water.add_body(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS))?;
    }
    let fleet = water.add_fleet(FleetDesc::new(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS)))?;
    let mut random = Random::new(5);
    for _ in 0..10_000 {
        let at = Vec3::new(random.within(-99.0, 99.0) as f32, 0.0, random.within(-99.0, 99.0) as f32);
        water.fleet_mut(fleet)?.add(BodyState::at_rest(at))?;
    }
    let mut by = DVec2::new(128.0, 64.0);
    let timing = measure(context.effort, || {
        let _ = water.rebase(by);
        by = -by;
    });
    Ok(Row::new("frame_world", "cost of a rebase")
        .param("grids", 16)
        .param("bodies", 1000)
        .param("pieces", 10_000)
        .time("rebase", &timing))
}
