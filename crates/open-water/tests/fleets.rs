//! Fleets through the façade: their water, their waves, their handles.

use glam::{DVec2, Quat, Vec2, Vec3};
use open_water::{
    Activity, BodyDesc, BodyState, BodyStates, Border, FleetDesc, FleetId, Follow, GridDesc, GridId, Hull, OpenWater,
    OpenWaterDesc, OpenWaterError, PieceId, Preset, Radiation,
};

const DT: f32 = 1.0 / 60.0;

fn calm() -> OpenWaterDesc {
    let mut desc = Preset::Low.water();
    desc.sea.partitions.clear();
    desc
}

fn crate_desc() -> BodyDesc {
    BodyDesc::from_hull(&Hull::cuboid(Vec3::new(0.9, 0.7, 0.8)).unwrap(), 260.0)
}

fn fleet(body: BodyDesc) -> FleetDesc {
    FleetDesc { refresh: 1, ride_below: 0.0, ..FleetDesc::new(body) }
}

fn run(water: &mut OpenWater, store: &mut BodyStates, ticks: usize) {
    for _ in 0..ticks {
        for tick in water.advance(DT) {
            water.tick(tick, store).unwrap();
        }
    }
}

fn start(i: usize) -> BodyState {
    let orientation = Quat::from_rotation_y(i as f32) * Quat::from_rotation_x(0.2);
    let position = Vec3::new(i as f32 * 13.0 - 60.0, 0.3, i as f32 * 7.0 - 20.0);
    BodyState { orientation, ..BodyState::at_rest(position) }
}

fn volume(water: &OpenWater, grid: GridId) -> f32 {
    let grid = water.grid(grid).unwrap().unwrap();
    let [x, z] = grid.desc().cell_size;
    grid.heights().iter().map(|h| f64::from(*h)).sum::<f64>() as f32 * x * z
}

fn pool(water: &mut OpenWater) -> GridId {
    let desc = GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..Preset::Medium.grid() };
    water.add_grid(GridDesc { follow: Follow::Fixed(DVec2::ZERO), ..desc }).unwrap()
}

/// A fleet of `count` pieces where `start` says.
fn add(water: &mut OpenWater, desc: FleetDesc, count: usize) -> (FleetId, Vec<PieceId>) {
    let id = water.add_fleet(desc).unwrap();
    let pieces = (0..count).map(|i| water.fleet_mut(id).unwrap().add(start(i)).unwrap()).collect();
    (id, pieces)
}

#[test]
fn pieces_float_as_bodies_do_on_the_sea() {
    let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
    let mut store = BodyStates::default();
    let bodies: Vec<_> = (0..10).map(|_| water.add_body(crate_desc()).unwrap()).collect();
    bodies.iter().enumerate().for_each(|(i, &id)| store.insert(id, start(i)));
    let (id, pieces) = add(&mut water, fleet(crate_desc()), 10);
    let mut waved = 0.0f32;
    for _ in 0..300 {
        run(&mut water, &mut store, 1);
        for (&piece, &body) in pieces.iter().zip(&bodies) {
            let (piece, body) = (water.fleet(id).unwrap().state(piece).unwrap(), store.get(body).unwrap());
            let apart = piece.position.distance(body.position);
            assert!(apart < 0.01, "{apart}");
            waved = waved.max(body.position.y.abs());
        }
    }
    assert!(waved > 0.3, "{waved}");
    // They are drawn between their last two states.
    let _ = water.advance(0.0);
    let drawn = water.drawn_piece(id, pieces[3]).unwrap();
    let state = water.fleet(id).unwrap().state(pieces[3]).unwrap();
    assert!(drawn.position.distance(state.position) < 0.1);
}

#[test]
fn only_pieces_that_radiate_into_grids_make_waves_there() {
    for (radiation, makes) in [(Radiation::Grid, true), (Radiation::Coefficients, false)] {
        let mut water = OpenWater::headless(calm()).unwrap();
        let grid = pool(&mut water);
        let (id, pieces) = add(&mut water, fleet(BodyDesc { radiation, ..crate_desc() }), 1);
        let mut store = BodyStates::default();
        let rest = BodyState::at_rest(Vec3::new(1.0, 0.3, 2.0));
        assert!(water.fleet_mut(id).unwrap().set_state(pieces[0], rest));
        run(&mut water, &mut store, 15);
        let height = |water: &OpenWater| {
            let heights = water.grid(grid).unwrap().unwrap().heights().iter();
            heights.fold(0.0f32, |most, h| most.max(h.abs()))
        };
        assert_eq!(height(&water) > 1e-3, makes, "{}", height(&water));
        // What it displaces, the water has more: it fell in, and its waves have not got to the border.
        if makes {
            let state = water.fleet(id).unwrap().state(pieces[0]).unwrap();
            let draft = 0.35 - state.position.y;
            let expected = 0.9 * 0.8 * (draft - 0.05);
            let found = volume(&water, grid);
            assert!((found - expected).abs() < 0.15 * expected, "{found} {expected}");
        }
    }
}

#[test]
fn pieces_feel_the_waves_of_grids() {
    let mut water = OpenWater::headless(calm()).unwrap();
    pool(&mut water);
    let (id, pieces) = add(&mut water, fleet(crate_desc()), 1);
    let mut store = BodyStates::default();
    let boat = water.add_body(BodyDesc { radiation: Radiation::Grid, ..crate_desc() }).unwrap();
    store.insert(boat, BodyState::at_rest(Vec3::new(3.0, 1.5, 0.0)));
    water.fleet_mut(id).unwrap().set_state(pieces[0], BodyState::at_rest(Vec3::new(0.0, 0.0, 0.0)));
    let settled = 0.35 - 260.0 / (1025.0 * 0.9 * 0.8);
    let mut moved = 0.0f32;
    for tick in 0..240 {
        run(&mut water, &mut store, 1);
        let y = water.fleet(id).unwrap().state(pieces[0]).unwrap().position.y;
        if tick < 10 {
            water.fleet_mut(id).unwrap().set_state(pieces[0], BodyState::at_rest(Vec3::new(0.0, settled, 0.0)));
        } else {
            moved = moved.max((y - settled).abs());
        }
    }
    assert!((0.005..0.5).contains(&moved), "{moved}");
}

#[test]
fn fleets_sleep_on_calm_water_until_a_wave_comes() {
    let asleep = |water: &OpenWater, id: FleetId, pieces: &[PieceId]| {
        let fleet = water.fleet(id).unwrap();
        pieces.iter().filter(|piece| fleet.activity(**piece) == Some(Activity::Asleep)).count()
    };
    let settled = 0.35 - 260.0 / (1025.0 * 0.9 * 0.8);
    for (desc, sleeps) in [(Preset::Low.water(), false), (calm(), true)] {
        let mut water = OpenWater::headless(desc).unwrap();
        pool(&mut water);
        let (id, pieces) = add(&mut water, fleet(crate_desc()), 20);
        let fleet = water.fleet_mut(id).unwrap();
        for (i, piece) in pieces.iter().enumerate() {
            let place = Vec3::new(i as f32 * 1.5 - 14.0, settled, -4.0);
            assert!(fleet.set_state(*piece, BodyState::at_rest(place)));
        }
        let mut store = BodyStates::default();
        run(&mut water, &mut store, 600);
        assert_eq!(asleep(&water, id, &pieces), if sleeps { 20 } else { 0 });
        let body = water.add_body(BodyDesc { radiation: Radiation::Grid, ..crate_desc() }).unwrap();
        store.insert(body, BodyState::at_rest(Vec3::new(0.0, 2.0, 2.0)));
        run(&mut water, &mut store, 150);
        assert!(asleep(&water, id, &pieces) < 15, "{}", asleep(&water, id, &pieces));
    }
}

#[test]
fn handles_and_descriptions_are_checked() {
    let mut water = OpenWater::headless(calm()).unwrap();
    let bad = water.add_fleet(FleetDesc { refresh: 0, ..fleet(crate_desc()) });
    assert!(bad.unwrap_err().to_string().contains("refresh is 0"));
    let (id, pieces) = add(&mut water, fleet(crate_desc()), 2);
    assert!(water.fleet_mut(id).unwrap().remove(pieces[0]).is_some());
    assert!(water.drawn_piece(id, pieces[0]).is_none() && water.drawn_piece(id, pieces[1]).is_some());
    water.remove_fleet(id).unwrap();
    assert!(matches!(water.remove_fleet(id), Err(OpenWaterError::UnknownFleet(gone)) if gone == id));
    assert!(water.fleet(id).is_err() && water.fleet_mut(id).is_err() && water.drawn_piece(id, pieces[1]).is_none());
    for wind in [Vec2::new(f32::NAN, 0.0), Vec2::new(80.0, 80.0)] {
        assert!(water.set_wind(wind).is_err());
    }
    water.set_wind(Vec2::new(3.0, 4.0)).unwrap();
    assert_eq!(water.desc().wind, Vec2::new(3.0, 4.0));
    let desc = OpenWaterDesc { wind: Vec2::splat(f32::INFINITY), ..calm() };
    assert!(OpenWater::headless(desc).is_err());
}
