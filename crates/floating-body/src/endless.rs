//! How a number that may be infinite is written by `serde`: then it is none, as JSON knows no infinity.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// For `#[serde(with)]`.
///
/// # Errors
/// Those of the format.
pub fn serialize<S: Serializer>(value: &f32, to: S) -> Result<S::Ok, S::Error> {
    Some(*value).filter(|value| *value != f32::INFINITY).serialize(to)
}

/// For `#[serde(with)]`.
///
/// # Errors
/// Those of the format.
pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f32::INFINITY))
}
