//! The public API on wgpu's `noop` backend: it validates everything that is made and encoded, and needs no adapter.
//!
//! It runs no shader: what is drawn is tested in the binary `gpu`.

mod device;
mod spans;

use device::Device;
use floating_body::FleetDesc;
use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, CascadeDesc, Consumers, Controls, DepthMap, Follow, GridDesc,
    GridHome, GridId, Hull, Land, Look, Mooring, MooringLine, OpenWater, OpenWaterDesc, OpenWaterError, Preset, Reason,
    Scheme, SeaState, View, WakesDesc, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
const ALL: Consumers = Consumers::all();

fn desc() -> OpenWaterDesc {
    let cascades = vec![CascadeDesc::new(32, 120.0), CascadeDesc::new(32, 18.0)];
    OpenWaterDesc { cascades, ..Preset::Low.water() }
}

fn grid(home: GridHome, follow: Follow) -> GridDesc {
    let (border, scheme) = (Border::Absorbing { width: 8 }, Scheme::NinePoint);
    GridDesc { follow, home, cells: [64; 2], border, scheme, ..GridDesc::default() }
}

fn views(count: usize) -> Vec<View> {
    (0..count).map(|i| View { eye: Vec3::new(7.0 * i as f32, 4.0, 0.0), pixel_angle: 1e-3 }).collect()
}

/// A boat, a float and three grids on both homes.
struct Game {
    water: OpenWater,
    store: BodyStates,
    boat: BodyId,
    remote: GridId,
}

impl Game {
    fn new(device: &Device) -> Self {
        let mut water = OpenWater::new(&device.device, &device.queue, desc()).unwrap();
        let mut store = BodyStates::default();
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
        let boat = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
        store.insert(boat, water.body(boat).unwrap().state());
        water.set_controls(boat, Controls { throttle: 0.8, ..Controls::default() }).unwrap();
        water.set_dry(boat, Some(hull.dry(0.1, 0.1).unwrap())).unwrap();
        let around = water.add_grid(GridDesc { cells: [96; 2], ..grid(GridHome::Cpu, Follow::Body(boat)) }).unwrap();
        let fine = GridDesc { cell_size: [0.1; 2], within: Some(around), ..grid(GridHome::Cpu, Follow::Body(boat)) };
        water.add_grid(fine).unwrap();
        let remote = water.add_grid(grid(GridHome::Gpu, Follow::Body(boat))).unwrap();
        Self { water, store, boat, remote }
    }

    fn tick(&mut self, dt: f32) {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut self.store).unwrap();
        }
    }

    /// Ticks, plans, encodes; returns the encoder.
    fn encode(&mut self, device: &Device, views: &[View], consumers: Consumers) -> wgpu::CommandEncoder {
        let plan = self.water.plan(views, consumers);
        assert!(!plan.to_string().is_empty());
        let mut encoder = device.encoder();
        self.water.encode(&plan, &mut encoder);
        encoder
    }

    fn frame(&mut self, device: &Device) {
        self.tick(DT);
        let encoder = self.encode(device, &views(1), ALL);
        device.submit([encoder]);
        let state = self.store.get(self.boat).unwrap();
        assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
        let mut sample = [WaterSample::default()];
        self.water.sample(&[Vec2::new(state.position.x, state.position.z)], &mut sample);
        assert!(sample[0].height.is_finite() && sample[0].normal.is_finite());
    }
}

#[test]
fn frames_of_all_views_and_readers_are_valid() {
    let device = Device::new();
    let mut game = Game::new(&device);
    let looks = [Consumers::empty(), Consumers::NORMALS, Consumers::FOAM, ALL];
    for (i, dt) in [DT, 0.0, 0.3 * DT, 5.0, f32::NAN, -1.0, 2.5 * DT, DT].into_iter().cycle().take(40).enumerate() {
        game.tick(dt);
        let encoder = game.encode(&device, &views(i % 4), looks[i / 3 % 4]);
        assert!(game.water.surface_bind_group().is_some() && game.water.surface_layout().is_some());
        match i % 5 {
            // One that is dropped takes its uploads along.
            3 => drop(encoder),
            // Two in one submission.
            4 => {
                game.tick(0.5 * DT);
                let second = game.encode(&device, &views(1), ALL);
                device.submit([encoder, second]);
            }
            _ => device.submit([encoder]),
        }
    }
    assert!(game.water.reports().ticks > 40 && game.water.reports().behind == 0, "{:?}", game.water.reports());
}

#[test]
fn nothing_waits_for_a_device_that_is_behind() {
    let device = Device::new();
    let mut game = Game::new(&device);
    let mut encoders = Vec::new();
    for _ in 0..30 {
        game.tick(DT);
        encoders.push(game.encode(&device, &views(1), ALL));
    }
    assert!(game.water.reports().behind >= 20, "{:?}", game.water.reports());
    device.submit(encoders);
    game.frame(&device);
    let behind = game.water.reports().behind;
    (0..5).for_each(|_| game.frame(&device));
    assert_eq!(game.water.reports().behind, behind);
}

#[test]
fn everything_comes_changes_and_goes() {
    let device = Device::new();
    let mut game = Game::new(&device);
    let float = Hull::cuboid(Vec3::splat(0.6)).unwrap();
    let body = game.water.add_body(BodyDesc::from_hull(&float, 100.0)).unwrap();
    game.store.insert(body, BodyState::at_rest(Vec3::new(4.0, 0.5, 3.0)));
    let line = MooringLine::rope(Vec3::ZERO, Vec3::new(9.0, 1.5, 0.0), 7.0, 4000.0);
    let mooring = game.water.add_mooring(Mooring { body, line }).unwrap();
    let fleet = game.water.add_fleet(FleetDesc::new(BodyDesc::from_hull(&float, 100.0))).unwrap();
    for i in 0..20 {
        game.water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(Vec3::new(i as f32, 0.0, -6.0))).unwrap();
    }
    (0..5).for_each(|_| game.frame(&device));

    // Settings.
    let bed = DepthMap::new(DVec2::splat(-64.0), 4.0, [32; 2], vec![-12.0; 32 * 32]).unwrap();
    game.water.set_land(Some(Land::new(bed))).unwrap();
    game.water.set_level(0.4).unwrap();
    game.water.set_wind(Vec2::new(8.0, -3.0)).unwrap();
    game.water.look(Look { eye: Vec3::new(0.0, 5.0, 9.0), direction: -Vec3::Z, fov_y: 1.0, aspect: 1.6 });
    game.water.change_sea(SeaState::wind(9.0, 50e3, 0.7), 0.3).unwrap();
    (0..60).for_each(|_| game.frame(&device));
    game.water.set_cascades(vec![CascadeDesc::new(64, 120.0), CascadeDesc::new(64, 30.0)], 0.2).unwrap();
    (0..60).for_each(|_| game.frame(&device));
    game.water.set_choppiness(0.5, 0.2).unwrap();
    game.water.set_wakes(Some(WakesDesc { grid: grid(GridHome::Cpu, Follow::Point), ..WakesDesc::default() })).unwrap();
    let lone = game.water.add_grid(grid(GridHome::Cpu, Follow::Point)).unwrap();
    game.water.set_follow_point(lone, DVec2::splat(30.0)).unwrap();
    let lone = game.water.set_grid_cells(lone, [80; 2], [0.2; 2]).unwrap();
    (0..60).for_each(|_| game.frame(&device));

    // Far away.
    let mut state = *game.store.get(game.boat).unwrap();
    state.position += Vec3::new(3_000.0, 0.0, -2_000.0);
    game.store.insert(game.boat, state);
    (0..5).for_each(|_| game.frame(&device));
    assert_eq!(game.water.reports().teleports, 1);

    // And gone.
    game.water.remove_mooring(mooring).unwrap();
    game.water.remove_body(body).unwrap();
    game.store.remove(body);
    game.water.remove_fleet(fleet).unwrap();
    game.water.remove_grid(lone).unwrap();
    game.water.remove_grid(game.remote).unwrap();
    assert!(matches!(game.water.grid_age(game.remote), Err(OpenWaterError::UnknownGrid(_))));
    game.water.set_wakes(None).unwrap();
    game.water.set_land(None).unwrap();
    game.water.set_dry(game.boat, None).unwrap();
    (0..90).for_each(|_| game.frame(&device));
}

#[test]
fn devices_come_and_go() {
    let device = Device::new();
    let mut game = Game::new(&device);
    (0..5).for_each(|_| game.frame(&device));
    game.water.lose_device();
    assert!(game.water.is_device_lost());
    game.tick(DT);
    let plan = game.water.plan(&views(1), ALL);
    assert!(plan.work.is_empty() && plan.skipped.iter().all(|s| s.reason == Reason::DeviceLost), "{plan}");
    let other = Device::new();
    let loss = game.water.replace_device(&other.device, &other.queue).unwrap();
    assert_eq!((loss.calmed.as_slice(), loss.foam), ([game.remote].as_slice(), true));
    (0..5).for_each(|_| game.frame(&other));
    // Without a word.
    other.device.destroy();
    let encoder = game.encode(&device, &[], Consumers::empty());
    drop(encoder);
    (0..12).for_each(|_| {
        game.tick(DT);
        game.encode(&device, &views(1), ALL);
    });
    assert!(game.water.is_device_lost());
    game.water.replace_device(&device.device, &device.queue).unwrap();
    (0..5).for_each(|_| game.frame(&device));
}

#[test]
fn least_limits_will_do_and_calm_water_needs_nothing() {
    let device = Device::with(wgpu::Features::empty(), OpenWater::least_limits());
    let mut game = Game::new(&device);
    (0..5).for_each(|_| game.frame(&device));
    let short = wgpu::Limits { max_storage_buffers_per_shader_stage: 4, ..OpenWater::least_limits() };
    let lesser = Device::with(wgpu::Features::empty(), short);
    let refused = OpenWater::new(&lesser.device, &lesser.queue, desc()).map(|_| ());
    assert!(matches!(refused, Err(OpenWaterError::DeviceLimit { found: 4, .. })), "{refused:?}");

    let calm = OpenWaterDesc { sea: SeaState { partitions: Vec::new(), depth: None }, ..desc() };
    let mut water = OpenWater::new(&device.device, &device.queue, calm).unwrap();
    let plan = water.plan(&views(2), ALL);
    assert!(plan.work.is_empty() && plan.upload_bytes() == 0, "{plan}");
    let mut encoder = device.encoder();
    water.encode(&plan, &mut encoder);
    device.submit([encoder]);
}
