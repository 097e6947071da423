//! What of a body changes from tick to tick, to go back to and to hand on.

use glam::Vec3;

use super::{Body, BodyState};
use crate::radiation::{Motion, Past};
use crate::source::{Column, Displacement};
use crate::{BodyError, MooringLine};

/// A moment of a [`Body`]: all that its next ticks depend on beside its description.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodySnapshot {
    state: BodyState,
    good: BodyState,
    resets: u32,
    columns: Vec<Column>,
    restart: bool,
    wash: Displacement,
    moorings: Vec<MooringLine>,
    tensions: Vec<f32>,
    immersed: f32,
    /// Share of each bottom that is wet.
    wet: Vec<f32>,
    wind: Vec3,
    /// Of heave, roll and pitch, if it remembers its waves.
    memory: Option<[Option<Past>; 3]>,
    /// Share of the clipped forces, and the distance from the eye.
    clipped: Option<(f32, f32)>,
    fitted_for: f32,
    radiator: Option<Motion>,
    feels_own: bool,
    radiates: bool,
}

impl BodySnapshot {
    /// Where the body was and how it moved.
    pub fn state(&self) -> BodyState {
        self.state
    }
}

impl Body {
    /// This moment.
    pub fn snapshot(&self) -> BodySnapshot {
        BodySnapshot {
            state: self.state,
            good: self.good,
            resets: self.resets,
            columns: self.columns.clone(),
            restart: self.restart,
            wash: self.wash,
            moorings: self.moorings.clone(),
            tensions: self.tensions.clone(),
            immersed: self.immersed,
            wet: self.slam.iter().flat_map(|slam| slam.wet()).collect(),
            wind: self.wind,
            memory: self.memory.as_ref().map(|memory| memory.past()),
            clipped: self.clipping.as_ref().map(|clipping| clipping.seen()),
            fitted_for: self.fitted_for,
            radiator: self.radiator.as_ref().map(|radiator| radiator.motion),
            feels_own: self.feels_own,
            radiates: self.radiates,
        }
    }

    /// Goes back to a moment of this body, or of another of the same description. Ticks from there give the same bits as they
    /// did.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] when the snapshot is of a body of another description, or does not hold together; then nothing
    /// is changed but that textures may have been fitted.
    pub fn restore(&mut self, snapshot: &BodySnapshot) -> Result<(), BodyError> {
        let s = snapshot;
        let refuse = |value: f64| {
            let bound = "of a body of the same description";
            Err(BodyError::InvalidValue { field: "snapshot", value, bound })
        };
        let counts = [
            (s.columns.len(), self.columns.len()),
            (s.wet.len(), self.slam.as_ref().map_or(0, |slam| slam.wet().count())),
            (s.tensions.len(), s.moorings.len()),
            (s.memory.iter().count(), self.memory.iter().count()),
            (s.clipped.iter().count(), self.clipping.iter().count()),
        ];
        if let Some((found, _)) = counts.iter().find(|(found, own)| found != own) {
            return refuse(*found as f64);
        }
        if !(s.state.is_sane() && s.good.is_sane()) {
            return refuse(s.state.position.length().into());
        }
        s.moorings.iter().try_for_each(MooringLine::check)?;
        if let (Some(memory), Some(past)) = (&self.memory, &s.memory)
            && !memory.fits(past)
        {
            return refuse(0.0);
        }
        if s.fitted_for != self.fitted_for {
            (self.fitted_for, self.radiator) = (0.0, None);
            if s.fitted_for != 0.0 {
                self.fit_textures(s.fitted_for);
            }
        }
        if s.radiator.is_some() != self.radiator.is_some() {
            return refuse(s.fitted_for.into());
        }
        (self.state, self.good, self.resets) = (s.state, s.good, s.resets);
        self.columns.clone_from(&s.columns);
        (self.restart, self.wash) = (s.restart, s.wash);
        self.moorings.clone_from(&s.moorings);
        self.tensions.clone_from(&s.tensions);
        (self.immersed, self.wind) = (s.immersed, s.wind);
        self.slam.iter_mut().for_each(|slam| slam.set_wet(&s.wet));
        if let (Some(memory), Some(past)) = (&mut self.memory, &s.memory) {
            memory.restore(past);
        }
        if let (Some(clipping), Some(seen)) = (&mut self.clipping, s.clipped) {
            clipping.see(seen);
        }
        if let (Some(radiator), Some(motion)) = (&mut self.radiator, s.radiator) {
            radiator.motion = motion;
        }
        (self.feels_own, self.radiates) = (s.feels_own, s.radiates);
        Ok(())
    }
}
