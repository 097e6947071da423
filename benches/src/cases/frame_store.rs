//! Case `frame_store`: what it costs to fetch and to store the states of 10,000 bodies, by where a game keeps them.

use std::collections::HashMap;
use std::hint::black_box;

use floating_body::{BodyDesc, BodyState, Sampling};
use glam::Vec3;
use open_water::{
    BodyId, BodyMotion, BodySlices, BodyStates, BodyStore, OpenWater, OpenWaterDesc, OpenWaterError, Preset, Stores,
};

use crate::evidence::{Case, CaseError, Context, Row, Timing, measure, measure_together};
use crate::fixtures::{CRATE_MASS, FRAME, crate_hull};

/// See the module.
pub(super) const STORE: Case = Case {
    name: "frame_store",
    about: "fetching and storing the states of 10,000 bodies, by store, against a tick of these bodies",
    plots: &[],
    run,
};

const BODIES: usize = 10_000;

/// Components by entity, as a game without a packed set would have them.
#[derive(Default)]
struct Entities {
    of: HashMap<BodyId, u64>,
    transforms: HashMap<u64, BodyState>,
}

impl BodyStore for Entities {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        self.transforms.get(self.of.get(&id)?).copied()
    }

    fn write(&mut self, id: BodyId, motion: BodyMotion) {
        if let (Some(entity), BodyMotion::State(state)) = (self.of.get(&id), motion) {
            self.transforms.insert(*entity, state);
        }
    }
}

/// What a tick asks of a store, in the same order.
fn pass<S: BodyStore + ?Sized>(store: &mut S, ids: &[BodyId], read: &mut [Option<BodyState>]) {
    for (id, state) in ids.iter().zip(read.iter_mut()) {
        *state = store.read(*id);
        black_box(store.wants(*id));
    }
    for (id, state) in ids.iter().zip(read.iter()) {
        if let Some(state) = state {
            store.write(*id, BodyMotion::State(*state));
        }
    }
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut water = OpenWater::headless(OpenWaterDesc { ..Preset::Medium.water() })?;
    let desc = BodyDesc { sampling: Sampling::Patch, ..BodyDesc::from_hull(&crate_hull()?, CRATE_MASS) };
    let ids: Vec<BodyId> = (0..BODIES).map(|_| water.add_body(desc.clone())).collect::<Result<_, OpenWaterError>>()?;
    let state = |i: usize| BodyState::at_rest(Vec3::new((i % 100) as f32 * 3.0, 0.0, (i / 100) as f32 * 3.0));
    let mut ready = BodyStates::default();
    let mut thirds = [BodyStates::default(), BodyStates::default(), BodyStates::default()];
    let mut entities = Entities::default();
    for (i, id) in ids.iter().enumerate() {
        ready.insert(*id, state(i));
        thirds[i % 3].insert(*id, state(i));
        entities.of.insert(*id, i as u64);
        entities.transforms.insert(i as u64, state(i));
    }
    let keys: Vec<_> = ids.iter().copied().map(Some).collect();
    let mut states: Vec<_> = (0..BODIES).map(state).collect();
    let mut slices = BodySlices::default();
    let tick = measure(context.effort, || {
        for tick in water.advance(FRAME) {
            let _ = water.tick(tick, &mut ready);
        }
    });
    let mut read = [vec![None; BODIES], vec![None; BODIES], vec![None; BODIES], vec![None; BODIES], vec![None; BODIES]];
    let [of_static, of_ready, of_slices, of_entities, of_thirds] = &mut read;
    let mut plain = ready.clone();
    let [direct, ready, sliced, entity, several] = measure_together(
        context.effort,
        [
            &mut || pass(&mut plain, &ids, of_static),
            &mut || pass(black_box(&mut ready as &mut dyn BodyStore), &ids, of_ready),
            &mut || pass(black_box(&mut slices.store(&keys, &mut states) as &mut dyn BodyStore), &ids, of_slices),
            &mut || pass(black_box(&mut entities as &mut dyn BodyStore), &ids, of_entities),
            &mut || {
                let [a, b, c] = &mut thirds;
                pass(black_box(&mut Stores(&mut [a, b, c]) as &mut dyn BodyStore), &ids, of_thirds);
            },
        ],
    );
    let round = |x: f64| (x * 100.0).round() / 100.0;
    let row = |variant: &str, timing: Timing| {
        Row::new("frame_store", variant)
            .param("ns_a_body", round(timing.median_ns / BODIES as f64))
            .param("share_of_tick_percent", round(100.0 * timing.median_ns / tick.median_ns))
            .param("target_share_percent", 5.0)
            .time("read, wants and write of 10,000 bodies", &timing)
            .baseline("BodyStates without virtual calls", &direct)
    };
    Ok(vec![
        row("BodyStates", ready),
        row("BodySlices, places noted anew", sliced),
        row("components in hash maps", entity),
        row("Stores of three", several),
        Row::new("frame_store", "a tick of these bodies on the default sea")
            .param("ns_a_body", round(tick.median_ns / BODIES as f64))
            .param("virtual_calls_ns_a_body", round((ready.median_ns - direct.median_ns) / BODIES as f64))
            .time("tick", &tick),
    ])
}
