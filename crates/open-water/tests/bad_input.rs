//! What is no number never gets into the water: every call refuses or ignores it, and says which.

use glam::{DVec2, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, CascadeDesc, Consumers, Controls, Damping, DepthMap, FleetDesc,
    FleetId, Follow, GridDesc, GridId, Hull, Land, Look, Mooring, MooringLine, OpenWater, OpenWaterDesc, PieceId,
    Preset, Quality, Rain, Scheme, SeaState, Tick, View, WakesDesc, WaterSample,
};

const DT: f32 = 1.0 / 60.0;

struct Scene {
    water: OpenWater,
    store: BodyStates,
    boat: BodyId,
    grid: GridId,
    view: GridId,
    fleet: FleetId,
    piece: PieceId,
}

type Answer = Result<(), Box<dyn std::error::Error>>;

impl Scene {
    fn new() -> Self {
        let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
        // What is clipped near the eye, and a grid that follows the view, tell what became of a look.
        let desc = BodyDesc { quality: Quality::Near(50.0), ..BodyDesc::boat(&hull, 4_000.0, 10.0) };
        let boat = water.add_body(desc).unwrap();
        let mut store = BodyStates::default();
        store.insert(boat, water.body(boat).unwrap().state());
        water.set_dry(boat, Some(hull.dry(0.1, 0.3).unwrap())).unwrap();
        let grid = water.add_grid(GridDesc { follow: Follow::Body(boat), ..small() }).unwrap();
        let view = water.add_grid(GridDesc { follow: Follow::View, ..small() }).unwrap();
        let fleet = water.add_fleet(FleetDesc::new(crate_desc())).unwrap();
        let piece = water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(Vec3::new(9.0, 0.0, 3.0))).unwrap();
        water.look(Look { eye: Vec3::new(-8.0, 4.0, 3.0), direction: Vec3::X, fov_y: 0.8, aspect: 1.5 });
        let mut scene = Self { water, store, boat, grid, view, fleet, piece };
        scene.run(30);
        scene
    }

    fn run(&mut self, ticks: usize) {
        for _ in 0..ticks {
            for tick in self.water.advance(DT) {
                self.water.tick(tick, &mut self.store).unwrap();
            }
        }
    }

    fn state(&mut self) -> &mut BodyState {
        self.store.get_mut(self.boat).unwrap()
    }

    /// Everything that can be asked is a number.
    fn check(&self, what: &str) {
        let points: Vec<Vec2> = (0..64).map(|i| Vec2::new(i as f32 - 32.0, 0.3 * i as f32 - 9.0)).collect();
        let mut out = vec![WaterSample::default(); 64];
        self.water.sample(&points, &mut out);
        for sample in &out {
            assert!(sample.height.abs() < 20.0 && sample.normal.is_normalized(), "{what}: {sample:?}");
            assert!(sample.velocity.length() < 50.0, "{what}: {sample:?}");
        }
        let body = self.water.body(self.boat).unwrap().state();
        let drawn = self.water.drawn_pose(self.boat).unwrap();
        let piece = self.water.drawn_piece(self.fleet, self.piece).unwrap();
        for position in [body.position, drawn.position, piece.position] {
            assert!(position.abs().max_element() < 1e3, "{what}: {position}");
        }
        assert!(body.velocity.is_finite() && body.angular_velocity.is_finite(), "{what}: {body:?}");
        assert!(drawn.orientation.is_normalized() && piece.orientation.is_normalized(), "{what}");
        let explained = self.water.explain(self.boat).unwrap();
        assert!(explained.loads.iter().all(|load| load.force.is_finite()), "{what}");
        assert!(self.water.time().is_finite() && self.water.drawn_time().is_finite(), "{what}");
        assert!(self.water.reports().dropped_secs.is_finite() && self.water.origin().is_finite(), "{what}");
    }
}

fn crate_desc() -> BodyDesc {
    BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.8)).unwrap(), 200.0)
}

fn small() -> GridDesc {
    GridDesc { cells: [96; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() }
}

fn shower(rain: Rain) -> GridDesc {
    let (scheme, border) = (Scheme::NinePoint, Border::Periodic);
    GridDesc { cells: [98; 2], cell_size: [0.03; 2], wave_speed: 0.6, scheme, border, rain: Some(rain), ..small() }
}

fn line(bad: f32, field: usize) -> MooringLine {
    let mut line = MooringLine::rope(Vec3::X, Vec3::new(9.0, 0.0, 0.0), 4.0, 4_000.0);
    match field {
        0 => line.point.y = bad,
        1 => line.anchor.z = bad,
        2 => line.length = bad,
        3 => line.stiffness = bad,
        4 => line.damping = bad,
        _ => line.holds = if bad.is_nan() { bad } else { -bad.abs() },
    }
    line
}

fn flat(elevation: f32, corner: f64, texel: f32) -> Result<DepthMap, open_water::OpenWaterError> {
    DepthMap::new(DVec2::new(corner, 0.0), texel, [64; 2], vec![elevation; 64 * 64])
}

/// A call with something that is no number.
type Call = fn(&mut Scene, f32) -> Answer;
type Say = fn(&mut Scene, f32);

/// What answers with an error.
const REFUSED: &[(&str, Call)] = &[
    ("wind", |s, bad| Ok(s.water.set_wind(Vec2::new(bad, 1.0))?)),
    ("level", |s, bad| Ok(s.water.set_level(bad)?)),
    ("rebase", |s, bad| Ok(s.water.rebase(DVec2::new(0.0, bad.into()))?)),
    ("teleport: position", |s, bad| {
        let state = BodyState { position: Vec3::Y * bad, ..*s.state() };
        Ok(s.water.teleport(s.boat, state)?)
    }),
    ("teleport: orientation", |s, bad| {
        let state = BodyState { orientation: Quat::from_xyzw(bad, 0.0, 0.0, 1.0), ..*s.state() };
        Ok(s.water.teleport(s.boat, state)?)
    }),
    ("tick", |s, bad| {
        let tick = s.water.advance(DT).next().unwrap();
        let refused = s.water.tick(Tick { dt: bad, ..tick }, &mut s.store);
        s.water.tick(tick, &mut s.store)?;
        Ok(refused?)
    }),
    ("water: tick", |_, bad| Ok(OpenWater::headless(OpenWaterDesc { tick: bad, ..Preset::Low.water() }).map(drop)?)),
    ("water: choppiness", |_, bad| {
        Ok(OpenWater::headless(OpenWaterDesc { choppiness: bad, ..Preset::Low.water() }).map(drop)?)
    }),
    ("water: cascade", |_, bad| {
        let cascades = vec![CascadeDesc::new(64, bad)];
        Ok(OpenWater::headless(OpenWaterDesc { cascades, ..Preset::Low.water() }).map(drop)?)
    }),
    ("water: sea", |_, bad| {
        let sea = SeaState { depth: Some(-bad.abs()), ..Preset::Low.water().sea };
        Ok(OpenWater::headless(OpenWaterDesc { sea, ..Preset::Low.water() }).map(drop)?)
    }),
    ("water: wind", |_, bad| {
        Ok(OpenWater::headless(OpenWaterDesc { wind: Vec2::Y * bad, ..Preset::Low.water() }).map(drop)?)
    }),
    ("change_sea: height", |s, bad| Ok(s.water.change_sea(SeaState::height_period(bad, 5.0, 0.0), 2.0)?)),
    ("change_sea: period", |s, bad| Ok(s.water.change_sea(SeaState::height_period(1.0, bad, 0.0), 2.0)?)),
    ("change_sea: direction", |s, bad| Ok(s.water.change_sea(SeaState::height_period(1.0, 5.0, bad), 2.0)?)),
    ("change_sea: seconds", |s, bad| Ok(s.water.change_sea(SeaState::height_period(1.0, 5.0, 0.0), bad)?)),
    ("set_choppiness", |s, bad| Ok(s.water.set_choppiness(bad, 2.0)?)),
    ("set_choppiness: seconds", |s, bad| Ok(s.water.set_choppiness(0.5, bad)?)),
    ("set_cascades", |s, bad| Ok(s.water.set_cascades(vec![CascadeDesc::new(64, bad)], 2.0)?)),
    ("add_body: mass", |s, bad| Ok(s.water.add_body(BodyDesc { mass: bad, ..crate_desc() }).map(drop)?)),
    ("add_body: centre", |s, bad| {
        Ok(s.water.add_body(BodyDesc { center_of_mass: Vec3::X * bad, ..crate_desc() }).map(drop)?)
    }),
    ("add_body: density", |s, bad| Ok(s.water.add_body(BodyDesc { water_density: bad, ..crate_desc() }).map(drop)?)),
    ("add_fleet", |s, bad| {
        Ok(s.water.add_fleet(FleetDesc { ride_below: bad, ..FleetDesc::new(crate_desc()) }).map(drop)?)
    }),
    ("fleet: add", |s, bad| {
        Ok(s.water.fleet_mut(s.fleet)?.add(BodyState::at_rest(Vec3::new(bad, 0.0, 0.0))).map(drop)?)
    }),
    ("add_grid: cell_size", |s, bad| Ok(s.water.add_grid(GridDesc { cell_size: [bad; 2], ..small() }).map(drop)?)),
    ("add_grid: depth", |s, bad| Ok(s.water.add_grid(GridDesc { depth: -bad.abs(), ..small() }).map(drop)?)),
    ("add_grid: damping", |s, bad| Ok(s.water.add_grid(GridDesc { damping: bad, ..small() }).map(drop)?)),
    ("add_grid: wave_speed", |s, bad| {
        let desc = GridDesc { wave_speed: bad, scheme: Scheme::NinePoint, ..small() };
        Ok(s.water.add_grid(desc).map(drop)?)
    }),
    ("rain: rate", |s, bad| Ok(s.water.add_grid(shower(Rain { rate: bad, drop_radius: 0.002, seed: 3 })).map(drop)?)),
    ("rain: drop_radius", |s, bad| {
        Ok(s.water.add_grid(shower(Rain { rate: 9.0, drop_radius: bad, seed: 3 })).map(drop)?)
    }),
    ("set_grid_cells", |s, bad| Ok(s.water.set_grid_cells(s.grid, [96; 2], [bad; 2]).map(drop)?)),
    ("set_wakes: fine", |s, bad| Ok(s.water.set_wakes(Some(WakesDesc { fine: bad, ..WakesDesc::default() }))?)),
    ("set_wakes: length", |s, bad| {
        Ok(s.water.set_wakes(Some(WakesDesc { least_length: bad, ..WakesDesc::default() }))?)
    }),
    ("mooring: point", |s, bad| Ok(s.water.add_mooring(Mooring { body: s.boat, line: line(bad, 0) }).map(drop)?)),
    ("mooring: anchor", |s, bad| Ok(s.water.add_mooring(Mooring { body: s.boat, line: line(bad, 1) }).map(drop)?)),
    ("mooring: length", |s, bad| Ok(s.water.add_mooring(Mooring { body: s.boat, line: line(bad, 2) }).map(drop)?)),
    ("mooring: stiffness", |s, bad| Ok(s.water.add_mooring(Mooring { body: s.boat, line: line(bad, 3) }).map(drop)?)),
    ("mooring: damping", |s, bad| Ok(s.water.add_mooring(Mooring { body: s.boat, line: line(bad, 4) }).map(drop)?)),
    ("mooring: holds", |s, bad| Ok(s.water.add_mooring(Mooring { body: s.boat, line: line(bad, 5) }).map(drop)?)),
    ("land: elevation", |_, bad| Ok(flat(bad, 0.0, 4.0).map(drop)?)),
    ("land: corner", |_, bad| Ok(flat(-9.0, bad.into(), 4.0).map(drop)?)),
    ("land: texel", |_, bad| Ok(flat(-9.0, 0.0, bad).map(drop)?)),
    ("land: beach", |s, bad| {
        let damping = Damping::Beach { surf_depth: bad, rate: 1.0 };
        Ok(s.water.set_land(Some(Land { damping, ..Land::new(flat(-9.0, 0.0, 4.0)?) }))?)
    }),
    ("land: no water", |s, bad| {
        let outline = vec![DVec2::ZERO, DVec2::new(9.0, bad.into()), DVec2::new(9.0, 0.0)];
        Ok(s.water.set_land(Some(Land { no_water: vec![outline], ..Land::new(flat(-9.0, 0.0, 4.0)?) }))?)
    }),
    ("hull", |_, bad| Ok(Hull::cuboid(Vec3::new(bad, 1.0, 1.0)).map(drop)?)),
    ("dry hull", |_, bad| Ok(Hull::sphere(1.0)?.dry(bad, 0.0).map(drop)?)),
];

/// What has no error to give: it is as if it had not been said.
const IGNORED: &[(&str, Say)] = &[
    ("state: position", |s, bad| s.state().position.x = bad),
    ("state: orientation", |s, bad| s.state().orientation.w = bad),
    ("state: velocity", |s, bad| s.state().velocity.y = bad),
    ("state: angular velocity", |s, bad| s.state().angular_velocity.z = bad),
    ("all of a state", |s, bad| {
        let (position, velocity) = (Vec3::splat(bad), Vec3::splat(bad));
        let orientation = Quat::from_xyzw(bad, bad, bad, bad);
        *s.state() = BodyState { position, orientation, velocity, angular_velocity: velocity };
    }),
    ("controls", |s, bad| {
        let controls = Controls { throttle: bad, steering: bad, force: Vec3::splat(bad), torque: Vec3::splat(bad) };
        s.water.set_controls(s.boat, controls).unwrap();
    }),
    ("frame time", |s, bad| assert_eq!(s.water.advance(bad).count(), 0)),
    ("look: eye", |s, bad| s.water.look(Look { eye: Vec3::X * bad, direction: Vec3::X, fov_y: 0.8, aspect: 1.5 })),
    ("look: direction", |s, bad| {
        s.water.look(Look { eye: Vec3::Y, direction: Vec3::new(bad, 0.0, 1.0), fov_y: 0.8, aspect: 1.5 });
    }),
    ("look: lens", |s, bad| s.water.look(Look { eye: Vec3::Y, direction: Vec3::X, fov_y: bad, aspect: bad })),
    ("view", |s, bad| {
        let view = View { eye: Vec3::new(0.0, bad, 0.0), pixel_angle: bad };
        let plan = s.water.plan(&[view], Consumers::NORMALS);
        assert!(plan.time.is_finite() && (0.0..=1.0).contains(&plan.alpha));
    }),
    ("follow point", |s, bad| {
        let grid = s.water.add_grid(GridDesc { follow: Follow::Point, ..small() }).unwrap();
        s.water.set_follow_point(grid, DVec2::new(bad.into(), 3.0)).unwrap();
        s.run(1);
        assert_eq!(s.water.grid(grid).unwrap().unwrap().window().corner, [-48; 2]);
    }),
    ("follow a place", |s, bad| {
        let follow = Follow::Fixed(DVec2::new(bad.into(), 3.0));
        let grid = s.water.add_grid(GridDesc { follow, ..small() }).unwrap();
        s.run(1);
        assert_eq!(s.water.grid(grid).unwrap().unwrap().window().corner, [-48; 2]);
    }),
    ("piece: state", |s, bad| {
        let state = BodyState { velocity: Vec3::X * bad, ..BodyState::at_rest(Vec3::ZERO) };
        assert!(!s.water.fleet_mut(s.fleet).unwrap().set_state(s.piece, state));
    }),
    ("fleet: look", |s, bad| s.water.fleet_mut(s.fleet).unwrap().look(Some(Vec3::splat(bad)))),
    ("sample", |s, bad| {
        let mut out = [WaterSample::default(); 2];
        s.water.sample(&[Vec2::new(bad, 0.0), Vec2::new(1.0, bad)], &mut out);
        for sample in out {
            assert!(sample.height == s.water.level() && sample.normal == Vec3::Y && sample.velocity == Vec3::ZERO);
        }
    }),
    ("is_underwater", |s, bad| assert!(!s.water.is_underwater(Vec3::new(0.0, -9.0, bad)))),
    ("is_dry", |s, bad| assert!(!s.water.is_dry(Vec3::new(bad, 0.0, 0.0)))),
];

const BAD: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

#[test]
fn what_is_no_number_is_refused_and_changes_nothing() {
    let mut scene = Scene::new();
    let mut twin = Scene::new();
    for (name, call) in REFUSED {
        for bad in BAD {
            let before = scene.water.reports().ticks;
            let answer = call(&mut scene, bad);
            assert!(answer.is_err(), "{name}: {bad} was taken");
            scene.check(name);
            twin.run((scene.water.reports().ticks - before) as usize);
        }
    }
    scene.run(30);
    twin.run(30);
    scene.check("all of it");
    assert_eq!(scene.store.get(scene.boat), twin.store.get(twin.boat));
}

#[test]
fn what_is_no_number_is_ignored_where_there_is_no_answer() {
    for (name, call) in IGNORED {
        for bad in BAD {
            let (mut scene, mut twin) = (Scene::new(), Scene::new());
            // Somewhere else, which the next tick is to follow.
            let look = Look { eye: Vec3::new(30.0, 4.0, 3.0), direction: Vec3::Z, fov_y: 0.8, aspect: 1.5 };
            [&mut scene, &mut twin].into_iter().for_each(|scene| scene.water.look(look));
            call(&mut scene, bad);
            scene.run(5);
            scene.check(name);
            twin.run((scene.water.reports().ticks - twin.water.reports().ticks) as usize);
            assert_eq!(scene.store.get(scene.boat), twin.store.get(twin.boat), "{name}: {bad}");
            let seen = |of: &Scene| {
                let share = of.water.body(of.boat).unwrap().clipped_share();
                (share, of.water.grid(of.view).unwrap().unwrap().window().corner)
            };
            assert_eq!(seen(&scene), seen(&twin), "{name}: {bad}");
        }
    }
}
