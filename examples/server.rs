//! A server and its clients in one process, without a device: who predicts rolls back when an input comes late, who joins late gets
//! the water as bytes, and a recording replays; all end with the server's hash, or the scene with an error.

use std::collections::VecDeque;
use std::process::ExitCode;

use clap::Parser;
use glam::Vec3;
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Controls, FleetDesc, Follow, GridDesc, Hull, OpenWater, Preset, Replay,
    WaterSnapshot,
};

/// Two boats among crates: client 0 steers the first and predicts, client 1 steers the second and is far away.
#[derive(Debug, Parser)]
struct Options {
    /// Frames of one tick each, 30 to 100000.
    #[arg(long, default_value_t = 600, value_parser = clap::value_parser!(u64).range(30..=100_000))]
    frames: u64,
}

type Failure = Box<dyn std::error::Error>;

/// Ticks that an input is on its way to a client.
const LATE: u64 = 6;

/// One peer's water, with the states of its bodies.
#[derive(Default)]
struct Boats {
    states: BodyStates,
    ids: Vec<BodyId>,
}

struct Peer {
    water: OpenWater,
    boats: Boats,
}

/// What a client asks of its boat in a tick: a new course now and then.
fn asked(client: usize, tick: u64) -> Controls {
    let turn = ((tick / 17 + 3 * client as u64) * 0x9E37_79B9) >> 7;
    let share = |bits: u64| (bits % 256) as f32 / 255.0;
    Controls { throttle: 0.4 + 0.6 * share(turn), steering: 2.0 * share(turn >> 8) - 1.0, ..Controls::default() }
}

impl Peer {
    fn new() -> Result<Self, Failure> {
        let mut water = OpenWater::headless(Preset::Low.water())?;
        let mut boats = Boats::default();
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?;
        for z in [0.0, 14.0] {
            let id = water.add_body(BodyDesc::boat(&hull, 4000.0, 10.0))?;
            let afloat = water.body(id)?.state();
            boats.states.insert(id, BodyState { position: afloat.position + Vec3::Z * z, ..afloat });
            boats.ids.push(id);
            water.add_grid(GridDesc { follow: Follow::Body(id), cells: [96; 2], ..Preset::Low.grid() })?;
        }
        let crates = water.add_fleet(FleetDesc::new(BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.8))?, 250.0)))?;
        for i in 0..40 {
            let place = Vec3::new(5.0 + 2.5 * (i % 8) as f32, 0.3, 4.0 * (i / 8) as f32);
            water.fleet_mut(crates)?.add(BodyState::at_rest(place))?;
        }
        Ok(Self { water, boats })
    }

    /// Runs the next tick with these controls.
    fn tick(&mut self, controls: [Controls; 2]) -> Result<(), Failure> {
        for (id, controls) in self.boats.ids.iter().zip(controls) {
            self.water.set_controls(*id, controls)?;
        }
        let next = self.water.last_tick() + 1;
        for tick in self.water.ticks_until(next) {
            self.water.tick(tick, &mut self.boats.states)?;
        }
        Ok(())
    }
}

/// What the predicting client keeps of a tick: the water before it, and what it took the other to have asked.
struct Kept {
    tick: u64,
    before: (WaterSnapshot, BodyStates),
    guess: Controls,
    hash: u64,
}

/// Client 0: ahead of what it knows, and back when it was wrong.
struct Predictor {
    peer: Peer,
    kept: VecDeque<Kept>,
    /// The other's last input that has arrived.
    known: Controls,
    rollbacks: u64,
}

impl Predictor {
    /// Runs a tick with the other's input as far as it is known.
    fn predict(&mut self, tick: u64, theirs: Controls) -> Result<(), Failure> {
        let before = (self.peer.water.snapshot(), self.peer.boats.states.clone());
        self.peer.tick([asked(0, tick), theirs])?;
        self.kept.push_back(Kept { tick, before, guess: theirs, hash: self.peer.water.hash() });
        Ok(())
    }

    /// The other's input for a tick has come. Returns the hash of the water after that tick, which is certain now.
    fn hear(&mut self, tick: u64, theirs: Controls) -> Result<u64, Failure> {
        self.known = theirs;
        let now = self.peer.water.last_tick();
        if self.kept.front().is_some_and(|kept| kept.guess != theirs) {
            let wrong = self.kept.pop_front().ok_or("nothing was kept")?;
            self.kept.clear();
            self.peer.water.restore(&wrong.before.0)?;
            self.peer.boats.states = wrong.before.1;
            self.rollbacks += 1;
            for again in tick..=now {
                self.predict(again, theirs)?;
            }
        }
        let certain = self.kept.pop_front().filter(|kept| kept.tick == tick);
        Ok(certain.ok_or("a tick was not kept")?.hash)
    }
}

fn check(who: &str, tick: u64, own: u64, server: u64) -> Result<(), Failure> {
    if own == server {
        return Ok(());
    }
    Err(format!("{who} has {own:016x} after tick {tick}, the server {server:016x}").into())
}

fn run(frames: u64) -> Result<(), Failure> {
    let mut server = Peer::new()?;
    let mut client = Predictor { peer: Peer::new()?, kept: VecDeque::new(), known: Controls::default(), rollbacks: 0 };
    let mut late: Option<Peer> = None;
    let mut hashes = VecDeque::new();
    let mut file = Vec::new();
    server.water.start_recording();
    for tick in 1..=frames {
        // The server has both inputs: it runs as far behind as they need.
        let controls = [asked(0, tick), asked(1, tick)];
        server.tick(controls)?;
        let hash = server.water.hash();
        hashes.push_back(hash);
        client.predict(tick, client.known)?;
        if tick > LATE {
            let certain = tick - LATE;
            let own = client.hear(certain, asked(1, certain))?;
            check("the client that predicts", certain, own, hashes.pop_front().ok_or("no hash was kept")?)?;
        }
        if let Some(peer) = &mut late {
            peer.tick(controls)?;
            check("the late joiner", tick, peer.water.hash(), hash)?;
        }
        if tick == frames / 2 {
            // All that a joiner has is what the server sends: bytes, and the handles and states of the game's bodies.
            let bytes = server.water.snapshot().to_bytes();
            let mut water = OpenWater::headless(Preset::Low.water())?;
            water.restore(&WaterSnapshot::from_bytes(&bytes)?)?;
            let boats = Boats { states: server.boats.states.clone(), ids: server.boats.ids.clone() };
            println!("tick {tick}: a client joins with {} KiB", bytes.len() / 1024);
            late = Some(Peer { water, boats });
        }
        if tick % 60 == 0 || tick == frames {
            server.water.write_recording(&mut file)?;
            println!("tick {tick}: hash {hash:016x}, {} rollbacks so far", client.rollbacks);
        }
    }
    server.water.stop_recording(&mut file)?;
    let mut replay = Replay::new(&file[..])?;
    while replay.tick()? {}
    check("the replay", frames, replay.water().hash(), server.water.hash())?;
    println!("all agree; the recording of {frames} ticks has {} KiB", file.len() / 1024);
    Ok(())
}

fn main() -> ExitCode {
    match run(Options::parse().frames) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
