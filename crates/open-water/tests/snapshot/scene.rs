//! A water with a bit of everything, whose game makes the same random inputs from the same seed.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, Controls, Engine, FleetDesc, FleetId, Follow, GridDesc, GridId,
    Hull, Look, Mooring, MooringId, MooringLine, OpenWater, OpenWaterDesc, Preset, Quality, Radiation, SeaState,
    Slamming, WakesDesc,
};

/// A game: what the host keeps itself.
#[derive(Clone)]
pub(crate) struct Game {
    pub(crate) bodies: BodyStates,
    pub(crate) ids: Vec<BodyId>,
    /// Follows a point, alone.
    pub(crate) lone: GridId,
    pub(crate) fleet: FleetId,
    /// What comes and goes.
    line: Option<MooringId>,
    crates: Option<FleetId>,
    dice: u64,
}

pub(crate) fn small(desc: OpenWaterDesc) -> OpenWaterDesc {
    let mut desc = OpenWaterDesc { seed: 7, ..desc };
    desc.cascades.iter_mut().for_each(|cascade| cascade.size = 32);
    desc
}

pub(crate) fn boat() -> BodyDesc {
    let hull = Hull::cuboid(Vec3::new(4.0, 1.2, 1.6)).unwrap();
    let engine = Engine {
        bollard_thrust: 4000.0,
        pitch_speed: 12.0,
        astern: 0.4,
        position: Vec3::new(-1.9, -0.4, 0.0),
        radius: 0.15,
        max_angle: 0.4,
        rudder_area: 0.1,
    };
    let slamming = Some(Slamming { deadrise: 0.3 });
    let (engine, quality) = (Some(engine), Quality::Near(40.0));
    BodyDesc { engine, slamming, memory: true, quality, ..BodyDesc::from_hull(&hull, 2500.0) }
}

pub(crate) fn water() -> (OpenWater, Game) {
    let mut water = OpenWater::headless(small(Preset::Low.water())).unwrap();
    let ids: Vec<_> = (0..4)
        .map(|i| match i {
            0 | 1 => water.add_body(boat()).unwrap(),
            2 => {
                water.add_body(BodyDesc { radiation: Radiation::Grid, ..BodyDesc::boat(&ball(), 500.0, 4.0) }).unwrap()
            }
            _ => water.add_body(BodyDesc::from_hull(&ball(), 400.0)).unwrap(),
        })
        .collect();
    let mut bodies = BodyStates::default();
    for (i, id) in ids.iter().enumerate() {
        bodies.insert(*id, BodyState::at_rest(Vec3::new(6.0 * i as f32, 0.2, 3.0)));
    }
    let grid = GridDesc { cells: [96; 2], follow: Follow::Body(ids[0]), ..Preset::Low.grid() };
    let grid = water.add_grid(grid).unwrap();
    let around = GridDesc {
        cells: [64; 2],
        cell_size: [0.25; 2],
        within: Some(grid),
        follow: Follow::Body(ids[2]),
        ..Preset::Low.grid()
    };
    water.add_grid(around).unwrap();
    let rain = open_water::Rain { rate: 50.0, drop_radius: 0.02, seed: 1 };
    let tile = GridDesc {
        cells: [64; 2],
        cell_size: [0.05; 2],
        border: Border::Periodic,
        damping: 1.0,
        rain: Some(rain),
        ..Preset::Low.grid()
    };
    let _ = water.add_grid(tile).unwrap();
    let lone = water.add_grid(GridDesc { cells: [64; 2], follow: Follow::Point, ..Preset::Low.grid() }).unwrap();
    water.add_mooring(anchored(ids[3])).unwrap();
    let fleet = water.add_fleet(crates(Radiation::Coefficients)).unwrap();
    for i in 0..20 {
        let place = Vec3::new(3.0 * i as f32 - 30.0, 0.1, -8.0);
        water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(place)).unwrap();
    }
    (water, Game { bodies, ids, lone, fleet, line: None, crates: None, dice: 3 })
}

fn anchored(body: BodyId) -> Mooring {
    Mooring { body, line: MooringLine::anchored(Vec3::ZERO, Vec3::new(20.0, -3.0, 3.0), 4.0, 400.0, 50.0) }
}

fn crates(radiation: Radiation) -> FleetDesc {
    FleetDesc::new(BodyDesc { radiation, ..BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.4)).unwrap(), 20.0) })
}

fn ball() -> Hull {
    Hull::sphere(0.6).unwrap()
}

impl Game {
    fn roll(&mut self, of: u64) -> u64 {
        self.dice = self.dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.dice >> 33) % of
    }

    /// The inputs before the next tick, and the tick.
    pub(crate) fn tick(&mut self, water: &mut OpenWater) {
        let controls = Controls {
            throttle: self.roll(100) as f32 / 100.0,
            steering: self.roll(100) as f32 / 50.0 - 1.0,
            ..Controls::default()
        };
        water.set_controls(self.ids[0], controls).unwrap();
        match self.roll(40) {
            0 => {
                let id = water.add_body(boat()).unwrap();
                let z = self.roll(20) as f32;
                self.bodies.insert(id, BodyState::at_rest(Vec3::new(-10.0, 0.5, z)));
                self.ids.push(id);
            }
            1 if self.ids.len() > 4 => {
                let id = self.ids.swap_remove(4);
                water.remove_body(id).unwrap();
                self.bodies.remove(id);
            }
            2 => water.set_level(self.roll(10) as f32 * 0.02).unwrap(),
            3 => {
                let sea = SeaState::wind(5.0 + self.roll(8) as f32, 50e3, 0.3);
                water.change_sea(sea, 0.3 + self.roll(3) as f32).unwrap();
            }
            4 => {
                let side = 48 + 16 * self.roll(3) as u32;
                self.lone = water.set_grid_cells(self.lone, [64, side], [0.5; 2]).unwrap();
            }
            5 => {
                let eye = Vec3::new(self.roll(50) as f32, 4.0, 0.0);
                water.look(Look { eye, direction: Vec3::X, fov_y: 0.8, aspect: 1.6 });
            }
            6 => {
                let grid = GridDesc { cells: [64; 2], ..Preset::Low.grid() };
                water.set_wakes(Some(WakesDesc { cells: 3 * 64 * 64, grid, ..WakesDesc::default() })).unwrap();
            }
            7 => {
                let place = Vec3::new(self.roll(30) as f32, 1.0, 5.0);
                let piece = water.fleet_mut(self.fleet).unwrap().add(BodyState::at_rest(place)).unwrap();
                if self.roll(2) == 0 {
                    water.fleet_mut(self.fleet).unwrap().remove(piece);
                }
            }
            8 => water.set_wind(Vec2::new(self.roll(9) as f32, 2.0)).unwrap(),
            9 => {
                let grid = GridDesc { cells: [64; 2], follow: Follow::Fixed(DVec2::ZERO), ..Preset::Low.grid() };
                if let Ok(id) = water.add_grid(grid) {
                    water.remove_grid(id).unwrap();
                }
            }
            10 => {
                let state = self.bodies.get_mut(self.ids[1]).unwrap();
                state.position.x += 0.5;
                state.velocity.y = 6.0;
            }
            11 => {
                let offset = DVec2::new(self.roll(9) as f64, 4.0);
                water.rebase(offset).unwrap();
                for id in &self.ids {
                    let state = self.bodies.get_mut(*id).unwrap();
                    state.position -= Vec3::new(offset.x as f32, 0.0, offset.y as f32);
                }
            }
            12 => {
                let state = BodyState::at_rest(Vec3::new(-20.0, 0.5, 1.0));
                water.teleport(self.ids[1], state).unwrap();
                self.bodies.insert(self.ids[1], state);
            }
            13 => match self.line.take() {
                Some(line) => water.remove_mooring(line).unwrap(),
                None => self.line = Some(water.add_mooring(anchored(self.ids[2])).unwrap()),
            },
            14 => match self.crates.take() {
                Some(fleet) => water.remove_fleet(fleet).unwrap(),
                None => {
                    // Its pieces make waves. Both fleets change in one tick.
                    let fleet = water.add_fleet(crates(Radiation::Grid)).unwrap();
                    for fleet in [fleet, self.fleet] {
                        let place = Vec3::new(self.roll(20) as f32, 0.7, 2.0);
                        water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(place)).unwrap();
                    }
                    self.crates = Some(fleet);
                }
            },
            15 => water.set_follow_point(self.lone, DVec2::new(self.roll(30) as f64, 3.0)).unwrap(),
            _ => {}
        }
        let next = water.last_tick() + 1;
        for tick in water.ticks_until(next) {
            water.tick(tick, &mut self.bodies).unwrap();
        }
    }
}
