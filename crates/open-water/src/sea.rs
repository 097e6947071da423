//! Changes of the ambient sea while the water runs: the sea itself, and what of the land's maps depends on it.

use ocean_spectrum::SeaState;

use crate::OpenWaterError;
use crate::desc::OpenWaterDesc;
use crate::land::Turning;
use crate::water::OpenWater;

impl OpenWater {
    /// Lets the sea become another one over `seconds` (see [`Ocean::change_to`](ocean_spectrum::Ocean::change_to)): the wind rises or turns, a swell comes in.
    /// Heights stay continuous. The tiles stay: choose them for the highest sea that is to come.
    ///
    /// Near land, the factors of depth and shelter follow in 32 steps.
    ///
    /// # Errors
    /// A value of the sea state or `seconds` is out of its range, or the water was made calm; then nothing was changed.
    pub fn change_sea(&mut self, sea: SeaState, seconds: f32) -> Result<(), OpenWaterError> {
        let desc = OpenWaterDesc { sea, ..self.desc.clone() };
        let start = self.time();
        let Some(ocean) = &mut self.ocean else { return Err(OpenWaterError::CalmSea) };
        ocean.change_to(desc.ocean(), start, seconds.into())?;
        self.desc = desc;
        if self.shore.terrain.is_some() {
            self.feed_again()?;
            let (from, to) = (self.shore.baked.clone(), self.bake_shore());
            self.shore.turning = Some(Turning { from, to, start, seconds: seconds.into(), shown: 0.0 });
        }
        Ok(())
    }

    /// Brings to the end of the last tick what depends on the sea.
    pub(crate) fn follow_sea(&mut self) -> Result<(), OpenWaterError> {
        let time = self.time();
        if let Some(turning) = &mut self.shore.turning
            && let Some(share) = turning.next(time)
        {
            turning.shown = share;
            let baked = turning.from.towards(&turning.to, share);
            if share == 1.0 {
                self.shore.turning = None;
            }
            if let Some(terrain) = &self.shore.terrain {
                let feedings = self.grids.iter_mut().filter_map(|grid| grid.feeding.as_mut());
                feedings.for_each(|feeding| feeding.weigh(terrain, &baked));
            }
            self.show_shore(baked)?;
        }
        if self.ocean.as_ref().is_some_and(|ocean| ocean.revision() != self.shore.fed_revision) {
            self.feed_again()?;
        }
        Ok(())
    }

    /// Prepares the edges of fed grids for the sea's modes as they are now.
    fn feed_again(&mut self) -> Result<(), OpenWaterError> {
        let baked = std::mem::take(&mut self.shore.baked);
        let fed = self.feed_grids(&baked);
        self.shore.baked = baked;
        fed
    }
}
