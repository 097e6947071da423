//! The sea's textures and pipelines follow its changes: made on another thread before they are needed.

use std::sync::mpsc::{Receiver, channel};

use ocean_spectrum::Ocean;
use ocean_spectrum::gpu::GpuOcean;

use super::{Gpu, fault};
use crate::OpenWaterError;
use crate::sea::beside;

/// Seconds before a change from when on its textures are made: less than a change is told ahead.
const AHEAD: f64 = 0.45;

/// What is being made, and what is there but not needed yet.
#[derive(Default)]
pub(super) struct Next {
    making: Option<Receiver<Result<GpuOcean, OpenWaterError>>>,
    made: Option<GpuOcean>,
}

impl Next {
    /// Takes what has come. False if it could not be made.
    fn poll(&mut self) -> bool {
        match self.making.as_ref().map(Receiver::try_recv) {
            Some(Ok(Ok(made))) => (self.making, self.made) = (None, Some(made)),
            Some(Ok(Err(_))) => return false,
            Some(Err(_)) | None => {}
        }
        true
    }
}

impl Gpu {
    /// Takes over what the sea needs at time `t` if it is there, and has made what it will need soon. Returns whether the
    /// sea can be drawn; if not, it stays as it was drawn last.
    pub(super) fn follow_sea(&mut self, ocean: &Ocean, t: f64) -> bool {
        let Some(own) = &self.ocean else { return false };
        if !self.next.poll() {
            self.lost = true;
            return false;
        }
        let can = |sea: &GpuOcean, t: f64| sea.is_ready_at(ocean, t);
        let ready = can(own, t);
        if !ready && self.next.made.as_ref().is_some_and(|made| can(made, t)) {
            self.ocean = self.next.made.take();
            self.surface.bind(&self.device, self.ocean.as_ref());
            (self.shown.ocean, self.shown.grids) = (None, None);
            return true;
        }
        let lacks = |t: &f64| !can(own, *t) && !self.next.made.as_ref().is_some_and(|made| can(made, *t));
        if self.next.making.is_none()
            && let Some(soon) = [t, t + AHEAD].into_iter().find(lacks)
        {
            let (sender, making) = channel();
            let (device, own, sea) = (self.device.clone(), own.clone(), ocean.clone());
            beside(move || {
                let made = fault::guard(&device, "the changed sea", || Ok(own.ready_at(&device, &sea, soon)?));
                // Nobody waits for it when the water is gone.
                let _ = sender.send(made);
            });
            self.next.making = Some(making);
        }
        ready
    }
}
