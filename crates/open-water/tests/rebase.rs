//! The local origin moves and bodies are put elsewhere between ticks: nothing in the world notices.

use glam::{DVec2, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, CascadeDesc, Contact, Controls, DepthMap, FleetDesc, FleetId,
    Follow, GridDesc, GridId, Hull, Land, Look, Mooring, MooringId, MooringLine, OpenWater, OpenWaterDesc,
    OpenWaterError, PieceId, Pose, Preset, Radiation, Rain, Scheme, WakesDesc, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
const OFFSET: DVec2 = DVec2::new(40.0, -24.0);

fn lifted(offset: DVec2) -> Vec3 {
    Vec3::new(offset.x as f32, 0.0, offset.y as f32)
}

/// A game with one of everything that stands somewhere.
struct Scene {
    water: OpenWater,
    store: BodyStates,
    boat: BodyId,
    moored: BodyId,
    stranded: BodyId,
    line: MooringId,
    grids: [GridId; 3],
    fleet: FleetId,
    piece: PieceId,
}

fn land() -> Land {
    // 20 m of water, and a shore far to the north.
    let elevation = |i: usize| -20.0 + ((i / 128) as f32 - 90.0).max(0.0);
    Land::new(DepthMap::new(DVec2::splat(-256.0), 4.0, [128; 2], (0..128 * 128).map(elevation).collect()).unwrap())
}

impl Scene {
    fn new() -> Self {
        let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
        water.set_land(Some(land())).unwrap();
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
        let mut store = BodyStates::default();
        let [boat, moored] = [0.0, 60.0].map(|x| {
            // The moored one radiates into the grid that it lies in.
            let radiation = if x > 0.0 { Radiation::Grid } else { Radiation::Coefficients };
            let desc = BodyDesc { memory: x > 0.0, radiation, ..BodyDesc::boat(&hull, 4_000.0, 10.0) };
            let id = water.add_body(desc).unwrap();
            let state = water.body(id).unwrap().state();
            store.insert(id, BodyState { position: state.position + Vec3::X * x, ..state });
            id
        });
        water.set_controls(boat, Controls { throttle: 0.9, steering: 0.3, ..Controls::default() }).unwrap();
        water.set_dry(boat, Some(hull.dry(0.1, 0.3).unwrap())).unwrap();
        let line = MooringLine::anchored(Vec3::X * 2.8, Vec3::new(68.0, -2.0, 1.0), 4.0, 4_000.0, 2_500.0);
        let line = water.add_mooring(Mooring { body: moored, line }).unwrap();
        let cells = GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() };
        let grid = |water: &mut OpenWater, follow| water.add_grid(GridDesc { follow, ..cells.clone() }).unwrap();
        let rain = GridDesc {
            cells: [98; 2],
            cell_size: [0.03; 2],
            scheme: Scheme::NinePoint,
            wave_speed: 0.6,
            border: Border::Periodic,
            damping: 1.0,
            rain: Some(Rain { rate: 40.0, drop_radius: 0.002, seed: 3 }),
            ..GridDesc::default()
        };
        let grids = [
            grid(&mut water, Follow::Body(boat)),
            grid(&mut water, Follow::Fixed(DVec2::new(62.0, 3.0))),
            water.add_grid(rain).unwrap(),
        ];
        let crate_desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::new(0.9, 0.7, 0.8)).unwrap(), 260.0);
        let fleet = water.add_fleet(FleetDesc { ride_below: 0.02, ..FleetDesc::new(crate_desc) }).unwrap();
        let pieces: Vec<_> = (0..40)
            .map(|i| {
                let at = Vec3::new(i as f32 * 3.0 - 30.0, 0.3, i as f32 * 2.0 - 20.0);
                water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(at)).unwrap()
            })
            .collect();
        let stranded = BodyDesc { contact: Some(Contact::default()), ..BodyDesc::from_hull(&hull, 4_000.0) };
        let stranded = water.add_body(stranded).unwrap();
        store.insert(stranded, BodyState::at_rest(Vec3::new(0.0, 11.0, 220.0)));
        water.look(Look { eye: Vec3::new(-8.0, 4.0, 3.0), direction: Vec3::X, fov_y: 0.8, aspect: 1.5 });
        Self { water, store, boat, moored, stranded, line, grids, fleet, piece: pieces[13] }
    }

    fn frame(&mut self, dt: f32) {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut self.store).unwrap();
        }
    }

    fn run(&mut self, ticks: usize) {
        (0..ticks).for_each(|_| self.frame(DT));
    }

    /// As a game does it.
    fn rebase(&mut self, offset: DVec2) {
        self.water.rebase(offset).unwrap();
        for id in [self.boat, self.moored, self.stranded] {
            self.store.get_mut(id).unwrap().position -= lifted(offset);
        }
    }

    /// Heights at world places.
    fn heights(&self) -> Vec<f32> {
        let local =
            |i: usize| (DVec2::new(2.0 * i as f64 - 50.0, 0.7 * i as f64 - 20.0) - self.water.origin()).as_vec2();
        let points: Vec<Vec2> = (0..120).map(local).collect();
        let mut out = vec![WaterSample::default(); points.len()];
        self.water.sample(&points, &mut out);
        out.iter().map(|sample| sample.height).collect()
    }

    /// Drawn poses of the boat, the moored one, the stranded one and a piece, in the world.
    fn poses(&self) -> [Pose; 4] {
        let [a, b, c] = [self.boat, self.moored, self.stranded].map(|id| self.water.drawn_pose(id).unwrap());
        [a, b, c, self.water.drawn_piece(self.fleet, self.piece).unwrap()]
            .map(|pose| Pose { position: pose.position + lifted(self.water.origin()), ..pose })
    }
}

fn apart(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[test]
fn a_rebase_moves_nothing_in_the_world() {
    let mut scene = Scene::new();
    scene.run(150);
    scene.frame(0.4 * DT);
    let windows = scene.grids.map(|grid| scene.water.grid(grid).unwrap().unwrap().window());
    let before = (scene.heights(), scene.poses(), scene.water.home(scene.boat).unwrap());
    let bottom = Vec3::new(30.0, -19.0, 10.0);
    let explained = scene.water.explain(scene.boat).unwrap();
    assert!(before.0.iter().any(|height| height.abs() > 0.1) && scene.water.is_underwater(bottom));
    scene.rebase(OFFSET);
    assert_eq!(scene.water.origin(), OFFSET);
    assert!(apart(&before.0, &scene.heights()) < 1e-4, "{} m", apart(&before.0, &scene.heights()));
    for (was, is) in before.1.iter().zip(scene.poses()) {
        assert!(was.position.distance(is.position) < 3e-5 && was.orientation == is.orientation, "{was:?} {is:?}");
    }
    assert_eq!(windows, scene.grids.map(|grid| scene.water.grid(grid).unwrap().unwrap().window()));
    assert_eq!(before.2, scene.water.home(scene.boat).unwrap());
    assert!(scene.water.is_underwater(bottom - lifted(OFFSET)));
    // The bed rises towards the shore: at this place it is 11 m deep.
    let under = |y: f32| scene.water.is_underwater(Vec3::new(0.0, y, 140.0) - lifted(OFFSET));
    assert!(under(-10.5) && !under(-11.5));
    let pose = scene.water.drawn_pose(scene.boat).unwrap();
    assert!(scene.water.is_dry(pose.position) && !scene.water.is_dry(pose.position + lifted(OFFSET)));
    let now = scene.water.explain(scene.boat).unwrap();
    let shift = explained.clip.center - now.clip.center - lifted(OFFSET);
    assert!(shift.length() < 1e-3 && (explained.clip.volume - now.clip.volume).abs() < 1e-3, "{shift}");
}

#[test]
fn after_a_rebase_all_goes_on_as_it_would_have() {
    let (mut moved, mut stayed) = (Scene::new(), Scene::new());
    for scene in [&mut moved, &mut stayed] {
        scene.run(120);
    }
    let way = |of: &Scene| of.poses()[0].position;
    let start = way(&stayed);
    for _ in 0..4 {
        moved.rebase(OFFSET);
        for scene in [&mut moved, &mut stayed] {
            scene.run(60);
        }
    }
    assert_eq!(moved.water.reports().teleports, 0);
    for (a, b) in moved.poses().iter().zip(stayed.poses()) {
        let off = a.position.distance(b.position);
        assert!(off < 2e-3 && a.orientation.angle_between(b.orientation) < 1e-3, "{off} m");
    }
    assert!(way(&stayed).distance(start) > 8.0);
    let off = apart(&moved.heights(), &stayed.heights());
    assert!(off < 2e-3, "{off} m");
    let [a, b] = [&moved, &stayed].map(|scene| scene.water.mooring_tension(scene.line).unwrap());
    assert!((a - b).abs() < 0.02 * (a + b).max(100.0), "{a} N, {b} N");
    // The line is made fast anew where its anchor is now.
    let line = MooringLine::rope(-Vec3::X * 2.8, Vec3::new(50.0, 0.0, 0.0) - lifted(4.0 * OFFSET), 20.0, 4_000.0);
    moved.water.add_mooring(Mooring { body: moved.moored, line }).unwrap();
    let anchors: Vec<Vec3> = moved.water.body(moved.moored).unwrap().moorings().iter().map(|l| l.anchor).collect();
    let there = stayed.water.body(stayed.moored).unwrap().moorings()[0].anchor;
    assert!((anchors[0] + lifted(4.0 * OFFSET)).distance(there) < 2e-3, "{anchors:?} {there}");
}

/// Tiles that all go whole times into 1 km.
fn tiled() -> OpenWaterDesc {
    let cascades = vec![CascadeDesc::new(64, 250.0), CascadeDesc::new(64, 50.0)];
    OpenWaterDesc { cascades, ..Preset::Low.water() }
}

/// Where a boat in its grid and a crate are after ten seconds, `far` metres from the world's origin, local.
fn float(far: f64, rebased: bool) -> [Vec3; 2] {
    let mut water = OpenWater::headless(tiled()).unwrap();
    let mut store = BodyStates::default();
    let local = if rebased { 0.0 } else { far as f32 };
    if rebased {
        let times = (far.abs() / 1e6).ceil().max(1.0);
        (0..times as u32).for_each(|_| water.rebase(DVec2::new(far / times, 0.0)).unwrap());
    }
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let boat = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
    water.set_controls(boat, Controls { throttle: 0.7, steering: 0.2, ..Controls::default() }).unwrap();
    let hull = Hull::cuboid(Vec3::new(1.2, 0.6, 1.0)).unwrap();
    let ids = [boat, water.add_body(BodyDesc::from_hull(&hull, 370.0)).unwrap()];
    for (id, x) in ids.into_iter().zip([0.0, -90.0]) {
        let state = water.body(id).unwrap().state();
        store.insert(id, BodyState { position: state.position + Vec3::X * (x + local), ..state });
    }
    let grid = GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() };
    water.add_grid(GridDesc { follow: Follow::Body(boat), ..grid }).unwrap();
    for _ in 0..600 {
        for tick in water.advance(DT) {
            water.tick(tick, &mut store).unwrap();
        }
    }
    ids.map(|id| store.get(id).unwrap().position - Vec3::X * local)
}

#[test]
fn far_out_a_rebased_world_floats_as_at_the_origin_to_the_last_bit() {
    let here = float(0.0, true);
    assert_eq!(here, float(1e5, true));
    assert_eq!(here, float(-9e8, true));
    // Without, f32 has 8 mm left at 100 km.
    let off = float(1e5, false)[1].distance(here[1]);
    assert!(off > 1e-3, "{off} m");
}

#[test]
fn wakes_by_themselves_come_where_the_boat_is() {
    let mut water = OpenWater::headless(tiled()).unwrap();
    water.rebase(DVec2::new(5000.0, 3000.0)).unwrap();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let boat = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
    water.set_controls(boat, Controls { throttle: 1.0, ..Controls::default() }).unwrap();
    let mut store = BodyStates::default();
    store.insert(boat, water.body(boat).unwrap().state());
    let grid = GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() };
    water.set_wakes(Some(WakesDesc { cells: 1 << 16, grid, ..WakesDesc::default() })).unwrap();
    for _ in 0..300 {
        for tick in water.advance(DT) {
            water.tick(tick, &mut store).unwrap();
        }
    }
    let home = water.home(boat).unwrap().expect("a grid of its own");
    assert!(!water.grid(home).unwrap().unwrap().is_asleep());
}

#[test]
fn origins_that_are_no_places_are_refused() {
    let mut scene = Scene::new();
    scene.run(2);
    let before = scene.heights();
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 0.5, 2e6, -1e300] {
        for offset in [DVec2::new(bad, 0.0), DVec2::new(8.0, bad)] {
            let error = scene.water.rebase(offset).unwrap_err();
            assert!(matches!(error, OpenWaterError::InvalidValue { field: "rebase: offset", .. }), "{error}");
        }
    }
    assert_eq!((scene.water.origin(), scene.heights()), (DVec2::ZERO, before));
    for _ in 0..1000 {
        scene.water.rebase(DVec2::new(1e6, 0.0)).unwrap();
    }
    assert!(matches!(scene.water.rebase(DVec2::X), Err(OpenWaterError::InvalidValue { field: "rebase: origin", .. })));
}

/// A boat at rest on calm water in its own grid, after a second.
fn resting() -> (OpenWater, BodyStates, BodyId, GridId) {
    let mut desc = Preset::Low.water();
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc).unwrap();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let boat = water.add_body(BodyDesc { memory: true, ..BodyDesc::boat(&hull, 4_000.0, 10.0) }).unwrap();
    let grid = GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() };
    let grid = water.add_grid(GridDesc { follow: Follow::Body(boat), ..grid }).unwrap();
    let mut store = BodyStates::default();
    store.insert(boat, water.body(boat).unwrap().state());
    run(&mut water, &mut store, 60);
    (water, store, boat, grid)
}

fn run(water: &mut OpenWater, store: &mut BodyStates, ticks: usize) {
    for _ in 0..ticks {
        for tick in water.advance(DT) {
            water.tick(tick, store).unwrap();
        }
    }
}

fn highest(water: &OpenWater, grid: GridId) -> f32 {
    water.grid(grid).unwrap().unwrap().heights().iter().fold(0.0, |most, z| most.max(z.abs()))
}

#[test]
fn a_teleport_of_any_distance_tells_the_water_of_no_way() {
    for (way, told) in [(3.0, true), (3.0, false), (4000.0, true)] {
        let (mut water, mut store, boat, grid) = resting();
        let state = *store.get(boat).unwrap();
        let to = BodyState { position: state.position + Vec3::X * way, ..state };
        if told {
            water.teleport(boat, to).unwrap();
            assert_eq!(water.body(boat).unwrap().state(), to);
        }
        store.insert(boat, to);
        for _ in water.advance(0.5 * DT) {}
        let drawn = water.drawn_pose(boat).unwrap().position;
        // Drawn there at once, with nothing between.
        assert_eq!(drawn.x > state.position.x + 0.9 * way, told, "{drawn}");
        run(&mut water, &mut store, 30);
        let wave = highest(&water, grid);
        assert_eq!(wave < 2e-3, told, "{way} m: {wave} m");
        assert_eq!((water.home(boat).unwrap(), water.reports().teleports), (Some(grid), 0));
        assert!(store.get(boat).unwrap().position.distance(to.position) < 0.1);
    }
}

#[test]
fn a_jump_without_a_word_is_reported_and_a_teleport_is_not_refused_for_nothing() {
    let (mut water, mut store, boat, grid) = resting();
    store.get_mut(boat).unwrap().position.x += 50.0;
    run(&mut water, &mut store, 1);
    assert_eq!(water.reports().teleports, 1);
    let state = *store.get(boat).unwrap();
    for bad in [
        BodyState { position: Vec3::NAN, ..state },
        BodyState { position: Vec3::X * 2e6, ..state },
        BodyState { velocity: Vec3::INFINITY, ..state },
        BodyState { angular_velocity: Vec3::NAN, ..state },
        BodyState { orientation: Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0), ..state },
    ] {
        assert!(matches!(water.teleport(boat, bad), Err(OpenWaterError::Body(_))));
        assert_eq!(water.body(boat).unwrap().state(), state);
    }
    // A body that takes no part yet, and one that is no more.
    let other = water.add_body(water.body(boat).unwrap().desc().clone()).unwrap();
    water.teleport(other, BodyState { position: Vec3::new(9.0, 0.0, 9.0), ..state }).unwrap();
    assert!(water.drawn_pose(other).is_none());
    water.remove_body(other).unwrap();
    assert!(matches!(water.teleport(other, state), Err(OpenWaterError::UnknownBody(_))));
    run(&mut water, &mut store, 60);
    assert!(highest(&water, grid) < 0.02);
}

#[test]
fn whatever_a_game_does_between_ticks_the_water_goes_on() {
    let mut scene = Scene::new();
    let mut state = 7u32;
    let mut random = |n: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) % n
    };
    let desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.8)).unwrap(), 200.0);
    let mut more: Vec<BodyId> = Vec::new();
    for _ in 0..600 {
        let at = Vec3::new(random(80) as f32 - 40.0, random(4) as f32 - 1.0, random(80) as f32 - 40.0);
        let which = random(more.len().max(1) as u32) as usize;
        match (random(12), more.get(which).copied()) {
            (0 | 5, _) => {
                more.push(scene.water.add_body(desc.clone()).unwrap());
                scene.store.insert(*more.last().unwrap(), BodyState::at_rest(at));
            }
            (1, Some(id)) => {
                scene.water.remove_body(id).unwrap();
                more.swap_remove(which);
            }
            (2, Some(id)) => drop(scene.store.remove(id)),
            (3, Some(id)) => {
                scene.water.teleport(id, BodyState::at_rest(at)).unwrap();
                scene.store.insert(id, BodyState::at_rest(at));
            }
            (4, _) => {
                let offset = DVec2::new(f64::from(random(200)) - 100.0, f64::from(random(200)) - 100.0);
                scene.rebase(offset);
                let rest: Vec<_> = more.iter().filter(|id| scene.store.get(**id).is_some()).copied().collect();
                rest.iter().for_each(|id| scene.store.get_mut(*id).unwrap().position -= lifted(offset));
            }
            _ => {}
        }
        scene.frame(DT);
        assert!(scene.heights().iter().all(|height| height.abs() < 5.0));
        let drawn = more.iter().filter_map(|id| scene.water.drawn_pose(*id));
        assert!(drawn.chain(scene.poses()).all(|pose| pose.position.is_finite() && pose.orientation.is_finite()));
    }
    assert!(more.len() > 10, "{}", more.len());
    assert_eq!(scene.water.reports().teleports, 0);
}
