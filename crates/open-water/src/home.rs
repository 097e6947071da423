//! Moves a grid from the CPU to the GPU or back while the water runs.
//!
//! Waves add up. So a new grid takes the place of the old one and gets all waves that are made from then on, while the old
//! one is stepped where it is until its own have left the window: nothing is copied, and nothing steps. Both count as the
//! same grid to bodies whose home it is.

use glam::{DVec2, Vec2};

use crate::OpenWaterError;
use crate::desc::{GridDesc, GridHome};
use crate::grids::{Grid, Sim};
use crate::store::GridId;
use crate::water::OpenWater;

/// Seconds that waves have to leave; what is still there fades then.
const EBB: f32 = 30.0;

impl OpenWater {
    /// Homes a grid on the CPU or the GPU from the next tick on, without a step in what is drawn and felt. Its handle stays.
    /// Until the waves that it has now have left its window, or have faded after 30 s, these stay where they are: meanwhile both
    /// are stepped, and count as two of [`crate::MAX_GRIDS`]. The first grid on a device takes the time in which its
    /// pipelines are compiled, unless [`Self::prepare_gpu_grids`] had them compiled before.
    ///
    /// # Errors
    /// As [`Self::add_grid`] for a grid of that home; there is no such grid, it is one of [`Self::set_wakes`], fed, in another or
    /// another is in it. Then nothing was changed.
    pub fn set_grid_home(&mut self, id: GridId, home: GridHome) -> Result<(), OpenWaterError> {
        let old = self.grids.present(id)?;
        if old.desc.home == home {
            return Ok(());
        }
        let desc = GridDesc { home, ..old.desc.clone() };
        desc.check_home()?;
        let nested = old.desc.within.is_some() || self.grids.iter().any(|grid| grid.desc.within == Some(id));
        if old.desc.feed.any() || nested || self.wakes.owns(id) {
            let bound = "of a grid that is not fed, not one of the wakes', not in another and without others in it";
            return Err(OpenWaterError::InvalidValue { field: "home", value: f64::from(home == GridHome::Gpu), bound });
        }
        let (gain, trail, point, middle) = (old.gain, old.trail, old.point, old.middle);
        let window = old.window();
        let extent = DVec2::from(window.cells.map(f64::from)) * Vec2::from(window.cell_size).as_dvec2();
        let place = window.world_corner() + 0.5 * extent;
        let ebbing = self.new_grid(desc.clone())?;
        let (look, level) = (self.looking, self.shore.level);
        let place =
            self.grids.get(id)?.target(look.as_ref(), level, |body| self.bodies.place_of(body)).unwrap_or(place);
        let [Some(kept), Some(new)] = self.grids.two(id, ebbing) else { return Ok(()) };
        match &mut new.sim {
            Sim::Cpu(grid) => grid.center_on(place),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => {
                if let Some(gpu) = &mut self.gpu {
                    gpu.remote.stand(grid, place);
                }
            }
        }
        // The new waves get the old handle.
        std::mem::swap(&mut kept.sim, &mut new.sim);
        new.desc = std::mem::replace(&mut kept.desc, desc);
        (kept.gain, new.gain) = (1.0, gain);
        (new.trail, new.point, new.middle) = (trail, point, middle);
        (new.leaving, new.into, new.ebb) = (true, Some(id), Some(EBB));
        note!(self, Input::Home(id, home));
        Ok(())
    }
}

impl Grid {
    /// Whether its waves stay where they are until they have left: it takes no others.
    pub(crate) fn ebbs(&self) -> bool {
        self.ebb.is_some()
    }

    /// Lets its waves leave for another `dt` seconds. False once they have, or have had their time.
    pub(crate) fn ebb_on(&mut self, dt: f32) -> bool {
        let awake = self.is_awake();
        match &mut self.ebb {
            Some(left) if awake && *left > 0.0 => {
                *left -= dt;
                true
            }
            _ => false,
        }
    }
}
