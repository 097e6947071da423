//! The bodies at a moment, and back to it.

use std::sync::Arc;

use floating_body::{Arena, Body, BodyDesc, BodySnapshot, Controls, Wrench};

use super::Bodies;
use super::entry::{Entry, Pose, pattern};
use crate::OpenWaterError;
use crate::handover::Homes;
use crate::store::{BodyId, Wants};

/// A body's description, shared with snapshots.
#[derive(Debug)]
pub(crate) struct Kind {
    pub(crate) desc: BodyDesc,
    /// Its digest, once asked for.
    #[cfg(feature = "serde")]
    pub(crate) digest: std::sync::OnceLock<u64>,
}

impl Kind {
    pub(crate) fn new(desc: BodyDesc) -> Self {
        Self {
            desc,
            #[cfg(feature = "serde")]
            digest: std::sync::OnceLock::new(),
        }
    }
}

/// What of a body changes from tick to tick.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct BodyMoment {
    id: BodyId,
    body: BodySnapshot,
    controls: Controls,
    homes: Homes,
    active: bool,
    wants: Wants,
    wrench: Wrench,
    previous: Option<Pose>,
}

/// All bodies at a moment.
#[derive(Debug, Clone)]
pub(crate) struct BodiesMoment {
    pub(crate) index: Arena<BodyId, usize>,
    /// Of each body, as the next.
    pub(crate) kinds: Vec<Arc<Kind>>,
    pub(crate) bodies: Vec<BodyMoment>,
}

impl Entry {
    fn moment(&self) -> BodyMoment {
        BodyMoment {
            id: self.id,
            body: self.body.snapshot(),
            controls: self.controls,
            homes: self.homes.clone(),
            active: self.active,
            wants: self.wants,
            wrench: self.wrench,
            previous: self.previous,
        }
    }

    fn restore(&mut self, moment: &BodyMoment) -> Result<(), OpenWaterError> {
        let BodyMoment { id, body, controls, homes, active, wants, wrench, previous } = moment;
        let fitted = self.body.fitted_cell();
        self.body.restore(body)?;
        if self.body.fitted_cell() != fitted {
            self.pattern = self.body.textures().and_then(pattern);
        }
        (self.id, self.controls, self.homes) = (*id, *controls, homes.clone());
        (self.active, self.wants, self.wrench, self.previous) = (*active, *wants, *wrench, *previous);
        self.displaced.clear();
        Ok(())
    }
}

impl Bodies {
    pub(crate) fn moment(&self) -> BodiesMoment {
        BodiesMoment {
            index: self.index.clone(),
            kinds: self.list.iter().map(|entry| Arc::clone(&entry.kind)).collect(),
            bodies: self.list.iter().map(Entry::moment).collect(),
        }
    }

    /// Calls `f` with each body's description and what changes of it.
    #[cfg(feature = "serde")]
    pub(crate) fn each_moment(&self, mut f: impl FnMut(&Kind, BodyMoment)) {
        self.list.iter().for_each(|entry| f(&entry.kind, entry.moment()));
    }

    #[cfg(feature = "serde")]
    pub(crate) fn index(&self) -> &Arena<BodyId, usize> {
        &self.index
    }

    /// All bodies as they were. Those that are still there are taken from `self`, and go back; the others are made anew.
    pub(crate) fn restored(&mut self, moment: &BodiesMoment) -> Result<Self, OpenWaterError> {
        let BodiesMoment { index, kinds, bodies } = moment;
        let fits = index.len() == bodies.len()
            && kinds.len() == bodies.len()
            && bodies.iter().enumerate().all(|(at, body)| index.get(body.id) == Some(&at));
        if !fits {
            let value = bodies.len() as f64;
            return Err(OpenWaterError::InvalidValue { field: "snapshot: bodies", value, bound: "one of each handle" });
        }
        // Nothing is taken before all that is new could be made.
        let known = |kind: &Arc<Kind>, id: BodyId| self.get(id).is_some_and(|entry| Arc::ptr_eq(&entry.kind, kind));
        let mut list = Vec::with_capacity(bodies.len());
        for (kind, moment) in kinds.iter().zip(bodies) {
            let mut entry = match known(kind, moment.id) {
                true => None,
                false => Some(Entry::new(moment.id, Body::new(kind.desc.clone())?, Arc::clone(kind))),
            };
            if let Some(entry) = &mut entry {
                entry.restore(moment)?;
            }
            list.push(entry);
        }
        let mut own: Vec<_> = std::mem::take(&mut self.list).into_iter().map(Some).collect();
        let mut restored = Self { index: index.clone(), list: Vec::with_capacity(bodies.len()) };
        for (entry, moment) in list.into_iter().zip(bodies) {
            if let Some(entry) = entry {
                restored.list.push(entry);
            } else if let Some(mut entry) = self.index.get(moment.id).and_then(|at| own[*at].take()) {
                entry.restore(moment)?;
                restored.list.push(entry);
            }
        }
        Ok(restored)
    }
}
