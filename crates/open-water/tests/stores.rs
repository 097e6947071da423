//! Where a game keeps its bodies: every store gives the same motion, and no handle ever reaches another body.

use std::collections::HashMap;

use glam::Vec3;
use open_water::{
    BodyDesc, BodyId, BodyMotion, BodySlices, BodyState, BodyStates, BodyStore, Hull, OpenWater, Preset, Stores, Wants,
    Wrench,
};

const DT: f32 = 1.0 / 60.0;

/// Components in a sparse set: entity to row, rows packed.
#[derive(Default)]
struct Ecs {
    entity_of: HashMap<BodyId, usize>,
    rows: Vec<Option<usize>>,
    entities: Vec<usize>,
    states: Vec<BodyState>,
}

impl Ecs {
    fn spawn(&mut self, id: BodyId, state: BodyState) -> usize {
        let entity = self.rows.len();
        self.rows.push(Some(self.states.len()));
        self.entities.push(entity);
        self.states.push(state);
        self.entity_of.insert(id, entity);
        entity
    }

    fn despawn(&mut self, entity: usize) {
        let Some(row) = self.rows[entity].take() else { return };
        self.states.swap_remove(row);
        self.entities.swap_remove(row);
        if let Some(moved) = self.entities.get(row) {
            self.rows[*moved] = Some(row);
        }
    }

    fn row(&self, id: BodyId) -> Option<usize> {
        self.rows[*self.entity_of.get(&id)?]
    }
}

impl BodyStore for Ecs {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        Some(self.states[self.row(id)?])
    }

    fn write(&mut self, id: BodyId, motion: BodyMotion) {
        if let (Some(row), BodyMotion::State(state)) = (self.row(id), motion) {
            self.states[row] = state;
        }
    }
}

fn crate_desc() -> BodyDesc {
    BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0)).unwrap(), 400.0)
}

fn at(x: f32) -> BodyState {
    BodyState::at_rest(Vec3::new(x, 0.5, 2.0))
}

fn tick(water: &mut OpenWater, store: &mut dyn BodyStore) {
    for tick in water.advance(DT) {
        water.tick(tick, store).unwrap();
    }
}

/// Crates in a row, and their ids.
fn crates(count: usize) -> (OpenWater, Vec<BodyId>) {
    let mut water = OpenWater::headless(Preset::Low.water()).unwrap();
    let ids = (0..count).map(|_| water.add_body(crate_desc()).unwrap()).collect();
    (water, ids)
}

fn bits(state: &BodyState) -> [u32; 3] {
    state.position.to_array().map(f32::to_bits)
}

/// Positions of crates after two seconds, in the ready-made store.
fn reference(count: usize) -> Vec<[u32; 3]> {
    let (mut water, ids) = crates(count);
    let mut store = BodyStates::default();
    ids.iter().enumerate().for_each(|(i, id)| store.insert(*id, at(3.0 * i as f32)));
    (0..120).for_each(|_| tick(&mut water, &mut store));
    ids.iter().map(|id| bits(store.get(*id).unwrap())).collect()
}

#[test]
fn slices_give_the_same_motion_whatever_order_they_are_in() {
    let (mut water, ids) = crates(5);
    let mut slices = BodySlices::default();
    let mut keys: Vec<_> = ids.iter().copied().map(Some).collect();
    let mut states: Vec<_> = (0..5).map(|i| at(3.0 * i as f32)).collect();
    // What does not float lies between, and what has no state behind.
    keys.insert(2, None);
    states.insert(2, at(-50.0));
    let gone = water.add_body(crate_desc()).unwrap();
    water.remove_body(gone).unwrap();
    keys.push(Some(gone));
    for step in 0..120 {
        if step % 7 == 3 {
            keys[..6].rotate_left(1);
            states.rotate_left(1);
        }
        tick(&mut water, &mut slices.store(&keys, &mut states));
    }
    let found: HashMap<_, _> = keys.iter().zip(&states).map(|(id, state)| (*id, *state)).collect();
    let positions: Vec<_> = ids.iter().map(|id| bits(&found[&Some(*id)])).collect();
    assert_eq!(positions, reference(5));
    assert_eq!(found[&None], at(-50.0));
    // What is in the slices no more is not found by where it was.
    let (here, states) = ([ids[1], ids[0], ids[1]].map(Some), &mut states[..2]);
    let store = slices.store(&here, states);
    assert!(ids[2..].iter().all(|id| store.read(*id).is_none()));
    // The longer one's rest counts for nothing.
    assert_eq!(store.read(ids[1]), Some(states[0]));
}

#[test]
fn components_of_entities_give_the_same_motion() {
    // The first of them goes on the way: others take its place in the lists.
    let (mut water, mut ids) = crates(6);
    let mut world = Ecs::default();
    let gone = ids.remove(0);
    let odd = world.spawn(gone, at(-20.0));
    for (i, id) in ids.iter().enumerate() {
        world.spawn(*id, at(3.0 * i as f32));
    }
    for step in 0..120 {
        tick(&mut water, &mut world);
        if step == 40 {
            world.despawn(odd);
            water.remove_body(gone).unwrap();
        }
    }
    for id in &ids {
        assert_eq!(water.body(*id).unwrap().state(), world.states[world.row(*id).unwrap()]);
    }
    let positions: Vec<_> = ids.iter().map(|id| bits(&world.states[world.row(*id).unwrap()])).collect();
    assert_eq!(positions, reference(5));
}

/// Tells what it was given; moves its bodies itself.
struct Engine {
    id: BodyId,
    state: Option<BodyState>,
    given: Option<Wrench>,
}

impl BodyStore for Engine {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        self.state.filter(|_| id == self.id)
    }

    fn wants(&self, _id: BodyId) -> Wants {
        Wants::Wrench
    }

    fn write(&mut self, _id: BodyId, motion: BodyMotion) {
        if let BodyMotion::Wrench(wrench) = motion {
            self.given = Some(wrench);
        }
    }
}

#[test]
fn a_body_belongs_to_the_first_store_that_has_a_state_for_it() {
    let (mut water, ids) = crates(4);
    let mut engine = Engine { id: ids[0], state: Some(at(0.0)), given: None };
    let (mut first, mut second) = (BodyStates::default(), BodyStates::default());
    first.insert(ids[1], at(3.0));
    second.insert(ids[1], at(90.0));
    second.insert(ids[2], at(6.0));
    for _ in 0..120 {
        // Bodies in the water are no reason to add states to stores.
        tick(&mut water, &mut Stores(&mut [&mut engine, &mut first, &mut second]));
    }
    let wrench = engine.given.unwrap();
    assert!(wrench.force.y > 0.0 && engine.state == Some(at(0.0)));
    let expected = reference(3);
    assert_eq!(bits(first.get(ids[1]).unwrap()), expected[1]);
    assert_eq!(bits(second.get(ids[2]).unwrap()), expected[2]);
    assert_eq!(second.get(ids[1]), Some(&at(90.0)));
    assert!(first.get(ids[0]).is_none() && second.get(ids[0]).is_none() && water.drawn_pose(ids[3]).is_none());
    // Taken out of the first, it is the second's.
    first.remove(ids[1]);
    engine.state = None;
    tick(&mut water, &mut Stores(&mut [&mut engine, &mut first, &mut second]));
    assert!(second.get(ids[1]).unwrap().position.x > 80.0 && water.drawn_pose(ids[0]).is_none());
    assert_eq!(water.reports().teleports, 1);
}

#[test]
fn the_handle_of_a_body_that_is_gone_never_reaches_a_new_one() {
    let (mut water, ids) = crates(1);
    let old = ids[0];
    let (mut states, mut slices, mut world) = (BodyStates::default(), BodySlices::default(), Ecs::default());
    states.insert(old, at(1.0));
    world.spawn(old, at(1.0));
    let mut array = [at(1.0)];
    water.remove_body(old).unwrap();
    for _ in 0..10 {
        let new = water.add_body(crate_desc()).unwrap();
        assert_ne!(new, old);
        assert!(water.body(old).is_err() && water.set_controls(old, Default::default()).is_err());
        assert!(states.read(new).is_none() && world.read(new).is_none());
        assert!(slices.store(&[Some(old)], &mut array).read(new).is_none());
        // Both in one slice: each is itself, in either order.
        let mut two = [at(1.0), at(2.0)];
        assert_eq!(slices.store(&[Some(old), Some(new)], &mut two).read(new), Some(at(2.0)));
        assert_eq!(slices.store(&[Some(new), Some(old)], &mut two).read(new), Some(at(1.0)));
        // What the water writes to the new one does not arrive in the old one's place.
        states.insert(new, at(7.0));
        tick(&mut water, &mut states);
        assert_ne!(states.get(new), Some(&at(7.0)));
        assert_eq!(world.states[0], at(1.0));
        water.remove_body(new).unwrap();
        states.remove(new);
        // As if the game had kept the old handle.
        states.insert(old, at(1.0));
        tick(&mut water, &mut states);
        assert_eq!(states.get(old), Some(&at(1.0)));
    }
}
