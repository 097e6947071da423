//! The description of a fleet, and the handles of its pieces.

use super::SoftContact;
use crate::error::check_range;
use crate::{BodyDesc, BodyError, Quality};

slotmap::new_key_type! {
    /// A piece of a [`Fleet`](crate::Fleet). It stays the same until the piece is removed and names no other after that.
    pub struct PieceId;
}

/// What a fleet is to be made of.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FleetDesc {
    /// Every piece. It must have no engine, memory, skin or slamming, and quality by points; [`BodyDesc::sampling`] is always a patch.
    pub body: BodyDesc,
    /// Ticks from one reading of the water under a piece to the next, 1 to 16: meanwhile its plane is carried on with its
    /// velocity and acceleration. Default 4.
    pub refresh: u32,
    /// Pieces fall asleep on calm water and wake when it moves. Default true.
    pub sleeps: bool,
    /// A piece that the eye ([`Fleet::look`](crate::Fleet::look)) sees smaller than this angle in radians, 0 to 1, rides:
    /// it follows the water without forces. 0 never. Default 0.002, two pixels of a screen 1080 high.
    pub ride_below: f32,
    /// Pieces that are awake push each other apart, and wake those asleep. Default none: they go through each other. Bed
    /// and quays they meet as [`BodyDesc::contact`] says, as balls.
    pub contact: Option<SoftContact>,
}

impl FleetDesc {
    /// Pieces of this body, with the defaults.
    pub fn new(body: BodyDesc) -> Self {
        Self { body, refresh: 4, sleeps: true, ride_below: 0.002, contact: None }
    }

    /// Refuses what a step could not digest.
    pub(super) fn check(&self) -> Result<(), BodyError> {
        if self.body.engine.is_some() {
            let bound = "none: pieces of a fleet have no engine, a body of its own has";
            return Err(BodyError::InvalidValue { field: "body.engine", value: 1.0, bound });
        }
        if self.body.memory {
            let bound = "false: pieces of a fleet do not remember their waves, a body of its own does";
            return Err(BodyError::InvalidValue { field: "body.memory", value: 1.0, bound });
        }
        if self.body.slamming.is_some() {
            let bound = "none: pieces of a fleet do not slam, a body of its own does";
            return Err(BodyError::InvalidValue { field: "body.slamming", value: 1.0, bound });
        }
        if self.body.skin.is_some() {
            let bound = "none: pieces of a fleet have form drag only, a body of its own has friction too";
            return Err(BodyError::InvalidValue { field: "body.skin", value: 1.0, bound });
        }
        if self.body.quality != Quality::Points {
            let bound = "Points: pieces of a fleet are not clipped, a body of its own is";
            return Err(BodyError::InvalidValue { field: "body.quality", value: 1.0, bound });
        }
        self.contact.as_ref().map_or(Ok(()), SoftContact::check)?;
        check_range("refresh", self.refresh as f32, 1.0, 16.0, "in [1, 16] ticks")?;
        check_range("ride_below", self.ride_below, 0.0, 1.0, "in [0, 1] rad").map(drop)
    }
}

/// What a piece is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// Moved by forces.
    Awake,
    /// Seen too small for forces: it follows the water.
    Riding,
    /// At rest on calm water.
    Asleep,
}
