//! What can be wrong with a rigid body that shall float.

use rapier3d::dynamics::RigidBodyHandle;

use crate::{BodyId, OpenWaterError};

/// Why a rigid body could not be given to the water. Nothing has changed then.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RapierError {
    /// The water does not know the body.
    #[error(transparent)]
    Water(#[from] OpenWaterError),
    /// The rigid body was removed, or is another set's.
    #[error("rigid body {0:?} is not in the set")]
    UnknownRigidBody(RigidBodyHandle),
    /// The rigid body floats already, as another body of the water.
    #[error("rigid body {handle:?} is already body {body:?} of the water")]
    Taken {
        /// The rigid body.
        handle: RigidBodyHandle,
        /// The body that it is.
        body: BodyId,
    },
    /// The rigid body is not the body that the water reckons with.
    #[error(
        "{what} of the rigid body is {found}, but the body's is {expected}: make it with `rapier::rigid_body` and give \
         its colliders density 0"
    )]
    Differs {
        /// The property and its unit.
        what: &'static str,
        /// Rapier's, colliders included.
        found: f32,
        /// The water's.
        expected: f32,
    },
}
