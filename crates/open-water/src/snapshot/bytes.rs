//! A snapshot as bytes, for who has nothing but land: joins late, or goes on from a file.
//!
//! A header tells the format, its version and a digest of what follows, so whatever is cut off or damaged is refused before it is
//! read. What can be read is checked again when it is restored.

use std::collections::HashMap;
use std::sync::Arc;

use floating_body::{Arena, BodyDesc, Fleet};
use ocean_spectrum::OceanSnapshot;
use serde::{Deserialize, Serialize};

use super::grids::GridsMoment;
use super::shore::ShoreMoment;
use super::{Digest, WaterSnapshot};
use crate::bodies::{BodiesMoment, BodyMoment, Kind};
use crate::moorings::Moorings;
use crate::sea::Order;
use crate::wakes::Wakes;
use crate::{BodyId, FleetId, Look, OpenWaterDesc, Reports};

/// What bytes begin with.
const MAGIC: [u8; 4] = *b"owsn";
/// Of the format. It changes whenever what is held does; no version reads another's bytes.
const VERSION: u32 = 1;
/// Magic, version, digest.
pub(super) const HEADER: usize = 16;

/// Why bytes are no snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotError {
    /// They do not begin as a snapshot does.
    #[error("these bytes are no snapshot: they do not begin as one does")]
    NoSnapshot,
    /// They were made by another version of this crate.
    #[error("the snapshot is of format {found}, but this build reads {expected}: let both sides run the same version")]
    Version {
        /// Format of the bytes.
        found: u32,
        /// Format that is read.
        expected: u32,
    },
    /// Something is missing or was changed on the way.
    #[error("the snapshot is cut off or damaged: send it again")]
    Damaged,
}

/// All that is not shared.
#[derive(Serialize, Deserialize)]
struct Rest {
    tick: u64,
    desc: OpenWaterDesc,
    ocean: Option<OceanSnapshot>,
    order: Option<Order>,
    fleets: Arena<FleetId, Fleet>,
    moorings: Moorings,
    wakes: Wakes,
    looking: Option<Look>,
    reports: Reports,
}

/// Descriptions, each once, in bytes; which of them each body has; the bodies.
type Bodies<'a> = (Vec<&'a [u8]>, Vec<u32>);

impl WaterSnapshot {
    /// The snapshot as bytes. Bodies of one description hold it once. Dry hulls are left out.
    pub fn to_bytes(&self) -> Vec<u8> {
        let Self { tick, desc, ocean, order, shore, grids, bodies, fleets, moorings, wakes, looking, reports, here: _ } =
            self;
        let mut known: HashMap<Vec<u8>, u32> = HashMap::new();
        let mut kinds = Vec::new();
        let of: Vec<u32> = bodies
            .kinds
            .iter()
            .map(|kind| {
                let bytes = encode(&kind.desc);
                *known.entry(bytes).or_insert_with_key(|bytes| {
                    kinds.push(bytes.clone());
                    kinds.len() as u32 - 1
                })
            })
            .collect();
        let kinds: Bodies = (kinds.iter().map(Vec::as_slice).collect(), of);
        let first = (tick, desc, ocean, order, fleets, moorings, wakes, looking, reports);
        let body = encode(&(first, shore, grids, kinds, &bodies.index, &bodies.bodies));
        let mut bytes = Vec::with_capacity(HEADER + body.len());
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&digest(&body).to_le_bytes());
        bytes.extend_from_slice(&body);
        bytes
    }

    /// The snapshot that [`Self::to_bytes`] made.
    ///
    /// # Errors
    /// The bytes are of something else, of another version, cut off or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let rest = bytes.strip_prefix(&MAGIC).ok_or(SnapshotError::NoSnapshot)?;
        let (version, rest) = rest.split_first_chunk().ok_or(SnapshotError::Damaged)?;
        let found = u32::from_le_bytes(*version);
        if found != VERSION {
            return Err(SnapshotError::Version { found, expected: VERSION });
        }
        let (told, body) = rest.split_first_chunk().ok_or(SnapshotError::Damaged)?;
        if digest(body) != u64::from_le_bytes(*told) {
            return Err(SnapshotError::Damaged);
        }
        Self::decode(body).ok_or(SnapshotError::Damaged)
    }

    fn decode(body: &[u8]) -> Option<Self> {
        type Whole<'a> = (Rest, ShoreMoment, GridsMoment, Bodies<'a>, Arena<BodyId, usize>, Vec<BodyMoment>);
        let (first, shore, grids, (kinds, of), index, bodies): Whole = postcard::from_bytes(body).ok()?;
        let kind = |bytes: &&[u8]| Some(Arc::new(Kind::new(postcard::from_bytes::<BodyDesc>(bytes).ok()?)));
        let kinds: Vec<_> = kinds.iter().map(kind).collect::<Option<_>>()?;
        let kinds = of.iter().map(|of| kinds.get(*of as usize).map(Arc::clone)).collect::<Option<_>>()?;
        let Rest { tick, desc, ocean, order, fleets, moorings, wakes, looking, reports } = first;
        let bodies = BodiesMoment { index, kinds, bodies };
        let here = None;
        Some(Self { tick, desc, ocean, order, shore, grids, bodies, fleets, moorings, wakes, looking, reports, here })
    }
}

pub(super) fn digest(bytes: &[u8]) -> u64 {
    let mut digest = Digest::new();
    digest.bytes(bytes);
    digest.finish()
}

fn encode(value: &impl Serialize) -> Vec<u8> {
    // Only a value without a length could fail, and there is none.
    postcard::to_stdvec(value).unwrap_or_default()
}
