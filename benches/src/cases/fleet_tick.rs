//! Case `fleet_tick`: ten thousand pieces through the façade, on one thread.

use floating_body::{BodyDesc, BodyState};
use glam::Vec3;
use open_water::{BodyStates, FleetDesc, OpenWater, OpenWaterDesc};

use super::ocean_fft::Plain;
use crate::{
    evidence::{Case, CaseError, Context, Row, fastest},
    fixtures::{CRATE_MASS, FRAME, Random, Scene, SceneDesc, crate_hull},
};

/// See the module.
pub(super) const TICK: Case = Case {
    name: "fleet_tick",
    about: "whole ticks of the default sea, a boat with its grid and 10,000 pieces of flotsam, on one thread",
    plots: &[],
    run: tick,
};

const PIECES: usize = 10_000;
/// Complex transforms of 256^2 as the ruler: so many, in the cache, and what one took by rustfft on the machine for which the bound was
/// set (a Zen 5 server core), ms.
const TRANSFORMS: usize = 1;
const TRANSFORM_MS: f64 = 0.098;
/// Where the pieces are, metres around the origin.
const REACH: f64 = 500.0;

fn starts() -> impl Iterator<Item = BodyState> {
    let mut random = Random::new(8);
    (0..PIECES).map(move |_| {
        let mut within = || random.within(-REACH, REACH) as f32;
        BodyState::at_rest(Vec3::new(within(), 0.0, within()))
    })
}

fn add_pieces(water: &mut OpenWater) -> Result<(), CaseError> {
    let body = BodyDesc::from_hull(&crate_hull()?, CRATE_MASS);
    // All of them awake.
    let desc = FleetDesc { sleeps: false, ride_below: 0.0, ..FleetDesc::new(body) };
    let fleet = water.add_fleet(desc)?;
    for state in starts() {
        water.fleet_mut(fleet)?.add(state)?;
    }
    Ok(())
}

/// A water with nothing but what is added to it.
struct Plainly {
    water: OpenWater,
    bodies: BodyStates,
}

impl Plainly {
    fn new() -> Result<Self, CaseError> {
        Ok(Self { water: OpenWater::headless(OpenWaterDesc::default())?, bodies: BodyStates::default() })
    }

    fn tick(&mut self) {
        for tick in self.water.advance(FRAME) {
            let _ = self.water.tick(tick, &mut self.bodies);
        }
    }
}

fn tick(context: &Context) -> Result<Vec<Row>, CaseError> {
    let desc = SceneDesc { flotsam: 0, ..SceneDesc::default() };
    let (mut boat, mut both) = (Scene::new(None, &desc)?, Scene::new(None, &desc)?);
    add_pieces(&mut both.water)?;
    let (mut alone, mut bodies) = (Plainly::new()?, Plainly::new()?);
    add_pieces(&mut alone.water)?;
    for state in starts() {
        let id = bodies.water.add_body(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS))?;
        bodies.bodies.insert(id, state);
    }
    let mut ruler = Plain::new(256, TRANSFORMS);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let (effort, ticks) = (context.effort, context.pick(120, 600));
    let [without, with, pieces, plain, ruled] = one_thread.install(|| {
        let mut boat = || drop(boat.tick());
        let mut both = || drop(both.tick());
        for _ in 0..ticks {
            boat();
            both();
            alone.tick();
        }
        fastest(effort, [&mut boat, &mut both, &mut || alone.tick(), &mut || bodies.tick(), &mut || ruler.run()])
    });
    let slower = ruled.median_ns * 1e-6 / (TRANSFORMS as f64 * TRANSFORM_MS);
    let row = |variant: &str, ns: f64| {
        Row::new("fleet_tick", variant)
            .param("pieces", PIECES)
            .param("threads", 1)
            .param("here_ms", (ns * 1e-3).round() / 1e3)
            .param("this_machine_is_slower_by", (slower * 1e2).round() / 1e2)
            .error(
                ns * 1e-6 / slower,
                "ms there",
                "nothing; least of all repeats, brought to the machine of the bound by what rustfft takes here and there",
            )
    };
    let part = (with.median_ns - without.median_ns).max(0.0);
    Ok(vec![
        row("what the pieces add to a tick of sea, boat and grid", part)
            .time("a tick with them", &with)
            .baseline("a tick without them", &without)
            .note("a difference of two ticks: without a bound, as it means nothing on a busy machine"),
        row("sea and pieces: synthesis, patches, forces", pieces.median_ns)
            .param("target_ms", 2)
            .time("a tick", &pieces)
            .baseline("the same pieces as bodies, each by itself", &plain),
        row("sea, boat, grid and pieces", with.median_ns)
            .time("a tick", &with)
            .baseline("a complex transform of 256^2 by rustfft", &ruled)
            .note("the boat has the whole sea synthesised, slopes included, and its grid of 384^2 is awake"),
    ])
}
