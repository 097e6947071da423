//! A recording run again.

use std::collections::HashMap;
use std::io::{self, Read};

use super::{Given, Input, MAGIC, VERSION};
use crate::store::{BodyMotion, BodyStore};
use crate::water::OpenWater;
use crate::{BodyId, BodyState, OpenWaterDesc, OpenWaterError, SnapshotError, Wants, WaterSnapshot};

/// Why a recording cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// It cannot be read.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It does not begin as a recording does.
    #[error("this is no recording: it does not begin as one does")]
    NoRecording,
    /// It was made by another version of this crate.
    #[error(
        "the recording is of format {found}, but this build reads {expected}: replay it with the version that made it"
    )]
    Version {
        /// Format of the recording.
        found: u32,
        /// Format that is read.
        expected: u32,
    },
    /// Something is missing or was changed.
    #[error("the recording is damaged after tick {tick}")]
    Damaged {
        /// The last tick that was run.
        tick: u64,
    },
    /// The snapshot in it cannot be used.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
    /// The water refused what it had taken when it was recorded.
    #[error(transparent)]
    Water(#[from] OpenWaterError),
    /// The water is not what it was.
    #[error(
        "after tick {tick} the water is not what it was when it was recorded: it was changed past its public calls, or is of another build"
    )]
    Differs {
        /// The last tick that was run.
        tick: u64,
    },
}

/// Runs a recording, tick by tick, on a headless water.
pub struct Replay<R> {
    from: R,
    water: OpenWater,
    store: Told,
}

/// What the recorded store said.
#[derive(Default)]
struct Told(HashMap<BodyId, (BodyState, Wants)>);

impl BodyStore for Told {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        self.0.get(&id).map(|(state, _)| *state)
    }

    fn wants(&self, id: BodyId) -> Wants {
        self.0.get(&id).map_or(Wants::State, |(_, wants)| *wants)
    }

    // The water keeps what it writes itself.
    fn write(&mut self, _id: BodyId, _motion: BodyMotion) {}
}

impl<R: Read> Replay<R> {
    /// Begins: the water is what it was when the recording was started.
    ///
    /// # Errors
    /// What is read is no recording, is of another version, or damaged.
    pub fn new(mut from: R) -> Result<Self, ReplayError> {
        let mut head = [0; 8];
        from.read_exact(&mut head)?;
        let [magic, version] = [head[..4].as_ref(), head[4..].as_ref()];
        if magic != MAGIC {
            return Err(ReplayError::NoRecording);
        }
        let found = version.try_into().map_or(0, u32::from_le_bytes);
        if found != VERSION {
            return Err(ReplayError::Version { found, expected: VERSION });
        }
        let mut calm = OpenWaterDesc::default();
        calm.sea.partitions.clear();
        let mut replay = Self { from, water: OpenWater::headless(calm)?, store: Told::default() };
        match replay.next()? {
            Some(start @ Input::Start(..)) => replay.take(start)?,
            _ => return Err(replay.damaged()),
        }
        Ok(replay)
    }

    /// The water after the last tick.
    pub fn water(&self) -> &OpenWater {
        &self.water
    }

    /// The water, to go on with.
    pub fn into_water(self) -> OpenWater {
        self.water
    }

    /// Runs on until after the next tick; false at the end of the recording.
    ///
    /// # Errors
    /// It is damaged or cannot be read, the water refuses what it had taken, or its hash is not the one that was recorded.
    pub fn tick(&mut self) -> Result<bool, ReplayError> {
        while let Some(input) = self.next()? {
            let ticked = matches!(input, Input::Tick(_));
            self.take(input)?;
            if ticked {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn damaged(&self) -> ReplayError {
        ReplayError::Damaged { tick: self.water.last_tick() }
    }

    fn next(&mut self) -> Result<Option<Input>, ReplayError> {
        let (mut head, mut got) = ([0; 4], 0);
        while got < head.len() {
            match self.from.read(&mut head[got..]) {
                Ok(0) if got == 0 => return Ok(None),
                Ok(0) => return Err(self.damaged()),
                Ok(more) => got += more,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
        let len = u64::from(u32::from_le_bytes(head));
        // No more is asked for than there is to read.
        let mut bytes = Vec::new();
        self.from.by_ref().take(len).read_to_end(&mut bytes)?;
        if bytes.len() as u64 != len {
            return Err(self.damaged());
        }
        postcard::from_bytes(&bytes).map(Some).map_err(|_| self.damaged())
    }

    fn take(&mut self, input: Input) -> Result<(), ReplayError> {
        let water = &mut self.water;
        match input {
            Input::Start(bytes, land) => {
                // A grid that is fed cannot be without its land, nor on another.
                if water.land() != land.as_ref() {
                    let mut calm = OpenWaterDesc::default();
                    calm.sea.partitions.clear();
                    *water = OpenWater::headless(calm)?;
                    water.set_land(land)?;
                }
                water.restore(&WaterSnapshot::from_bytes(&bytes)?)?;
            }
            Input::Body(desc) => drop(water.add_body(*desc)?),
            Input::RemoveBody(id) => water.remove_body(id)?,
            Input::Teleport(id, state) => water.teleport(id, state)?,
            Input::Controls(id, controls) => water.set_controls(id, controls)?,
            Input::Mooring(mooring) => drop(water.add_mooring(mooring)?),
            Input::RemoveMooring(id) => water.remove_mooring(id)?,
            Input::Fleet(fleet) => drop(water.fleets.list.insert(*fleet)),
            Input::RemoveFleet(id) => water.remove_fleet(id)?,
            Input::Pieces(id, fleet) => *water.fleet_mut(id)? = *fleet,
            Input::Grid(desc) => drop(water.add_grid(*desc)?),
            Input::RemoveGrid(id) => water.remove_grid(id)?,
            Input::Cells(id, cells, cell_size) => drop(water.set_grid_cells(id, cells, cell_size)?),
            Input::Home(id, home) => water.set_grid_home(id, home)?,
            Input::Point(id, place) => water.set_follow_point(id, place)?,
            Input::Look(look) => water.look(look),
            Input::Wakes(desc) => water.set_wakes(*desc)?,
            Input::Wind(wind) => water.set_wind(wind)?,
            Input::Level(level) => water.set_level(level)?,
            Input::Land(land) => water.set_land(*land)?,
            Input::Sea(desc, seconds) => water.change(*desc, seconds)?,
            Input::Rebase(offset) => water.rebase(offset)?,
            Input::Tick(news) => self.step(news)?,
            Input::Hash(hash) if water.hash() != hash => {
                return Err(ReplayError::Differs { tick: water.last_tick() });
            }
            Input::Hash(_) => {}
        }
        Ok(())
    }

    fn step(&mut self, news: Vec<(BodyId, Given)>) -> Result<(), ReplayError> {
        let store = &mut self.store.0;
        store.clear();
        store.extend(self.water.bodies.given().filter_map(|(id, given)| Some((id, given?))));
        for (id, given) in news {
            match given {
                Some(given) => drop(store.insert(id, given)),
                None => drop(store.remove(&id)),
            }
        }
        let next = self.water.last_tick() + 1;
        for tick in self.water.ticks_until(next) {
            self.water.tick(tick, &mut self.store)?;
        }
        Ok(())
    }
}
