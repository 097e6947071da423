//! Recordings: all that the game tells the water, from a snapshot on, so that the same run can be had again.
//!
//! Every call that changes what is simulated notes itself once it has succeeded; a tick notes the states of the store that are not
//! those that the water wrote. Nothing is written where the water runs: [`OpenWater::write_recording`] takes what was noted. Not
//! recorded: what only changes looks, and waves of grids homed on the GPU.

mod replay;

use std::io::{self, Write};

use floating_body::{BodyDesc, BodyState, Controls, Fleet};
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

use crate::store::BodyStore;
use crate::water::OpenWater;
use crate::{
    BodyId, FleetId, GridDesc, GridHome, GridId, Land, Look, Mooring, MooringId, OpenWaterDesc, WakesDesc, Wants,
};
pub use replay::{Replay, ReplayError};

/// What a recording begins with.
const MAGIC: [u8; 4] = *b"owrc";
/// Of the format. It changes whenever what is noted does.
const VERSION: u32 = 1;

/// What a store says of a body: its state and what it wants, or that it takes no part.
pub(crate) type Given = Option<(BodyState, Wants)>;

/// What a game tells the water.
#[derive(Serialize, Deserialize)]
pub(crate) enum Input {
    /// The water as it was, and its land: the first of a recording, and after a restore.
    Start(Vec<u8>, Option<Land>),
    Body(Box<BodyDesc>),
    RemoveBody(BodyId),
    Teleport(BodyId, BodyState),
    Controls(BodyId, Controls),
    Mooring(Mooring),
    RemoveMooring(MooringId),
    /// A new one.
    Fleet(Box<Fleet>),
    RemoveFleet(FleetId),
    /// Its pieces were changed.
    Pieces(FleetId, Box<Fleet>),
    Grid(Box<GridDesc>),
    RemoveGrid(GridId),
    Cells(GridId, [u32; 2], [f32; 2]),
    Home(GridId, GridHome),
    Point(GridId, DVec2),
    Look(Look),
    Wakes(Box<Option<WakesDesc>>),
    Wind(Vec2),
    Level(f32),
    Land(Box<Option<Land>>),
    /// The sea becomes that of a description over seconds.
    Sea(Box<OpenWaterDesc>, f32),
    Rebase(DVec2),
    /// The next tick, with what the store says that is news.
    Tick(Vec<(BodyId, Given)>),
    /// The water is to have this hash now.
    Hash(u64),
}

impl Input {
    /// The water as it is.
    pub(crate) fn start(water: &OpenWater) -> Self {
        Self::Start(water.snapshot().to_bytes(), water.land().cloned())
    }
}

/// What was noted and not yet taken.
#[derive(Default)]
pub(crate) struct Recorder {
    bytes: Vec<u8>,
    /// Fleets that the game may have changed since the last tick.
    touched: Vec<FleetId>,
}

impl Recorder {
    /// Each input stands behind its length.
    pub(crate) fn push(&mut self, input: &Input) {
        // Only a value without a length could fail, and there is none.
        let bytes = postcard::to_stdvec(input).unwrap_or_default();
        self.bytes.extend_from_slice(&(bytes.len() as u32).to_le_bytes());
        self.bytes.extend_from_slice(&bytes);
    }

    pub(crate) fn touch(&mut self, fleet: FleetId) {
        if !self.touched.contains(&fleet) {
            self.touched.push(fleet);
        }
    }
}

impl OpenWater {
    /// Records from now on all that the game tells the water; a recording under way is dropped. Take what was noted with
    /// [`Self::write_recording`] now and then: it is kept in memory, some ten bytes a tick and a hundred for each body that the
    /// game moves. A [`Self::restore`] notes a whole snapshot, [`Self::fleet_mut`] the fleet.
    ///
    /// ```
    /// # use open_water::{BodyStates, OpenWater, OpenWaterDesc, Replay};
    /// let mut water = OpenWater::headless(OpenWaterDesc::default())?;
    /// water.start_recording();
    /// for tick in water.ticks_until(5) {
    ///     water.tick(tick, &mut BodyStates::default())?;
    /// }
    /// let mut file = Vec::new(); // or a file
    /// water.stop_recording(&mut file)?;
    ///
    /// let mut replay = Replay::new(&file[..])?;
    /// while replay.tick()? {}
    /// assert_eq!(replay.water().hash(), water.hash());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn start_recording(&mut self) {
        let mut recorder = Recorder::default();
        recorder.bytes.extend_from_slice(&MAGIC);
        recorder.bytes.extend_from_slice(&VERSION.to_le_bytes());
        recorder.push(&Input::start(self));
        self.recorder = Some(recorder);
    }

    /// Whether what the game tells is recorded.
    pub fn is_recording(&self) -> bool {
        self.recorder.is_some()
    }

    /// Writes what was noted since the last call, and the water's hash, against which a replay is checked there. Nothing without a
    /// recording.
    ///
    /// # Errors
    /// Those of the writer; then all of it is kept for the next call.
    pub fn write_recording(&mut self, to: &mut impl Write) -> io::Result<()> {
        self.note_fleets();
        note!(self, Input::Hash(self.hash()));
        let Some(recorder) = &mut self.recorder else { return Ok(()) };
        to.write_all(&recorder.bytes)?;
        recorder.bytes.clear();
        Ok(())
    }

    /// As [`Self::write_recording`], and ends the recording.
    ///
    /// # Errors
    /// As there; then it goes on.
    pub fn stop_recording(&mut self, to: &mut impl Write) -> io::Result<()> {
        self.write_recording(to)?;
        self.recorder = None;
        Ok(())
    }

    /// Notes the fleets that the game may have changed.
    fn note_fleets(&mut self) {
        let Some(recorder) = &mut self.recorder else { return };
        for id in std::mem::take(&mut recorder.touched) {
            if let Some(fleet) = self.fleets.list.get(id) {
                recorder.push(&Input::Pieces(id, Box::new(fleet.clone())));
            }
        }
    }

    /// Notes the tick to come.
    pub(crate) fn note_tick(&mut self, store: &dyn BodyStore) {
        self.note_fleets();
        note!(self, Input::Tick(self.bodies.news(store)));
    }
}
