//! How numbers are written by `serde`: many as bytes, and infinite ones so that every format has them.

/// Numbers as bytes, lowest first: written and read at once.
pub(crate) mod floats {
    use std::fmt;

    use serde::de::{Error, SeqAccess, Visitor};
    use serde::{Deserializer, Serializer};

    pub(crate) fn serialize<S: Serializer>(values: &[f32], to: S) -> Result<S::Ok, S::Error> {
        if cfg!(target_endian = "little") {
            return to.serialize_bytes(bytemuck::cast_slice(values));
        }
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        to.serialize_bytes(&bytes)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f32>, D::Error> {
        from.deserialize_bytes(Floats)
    }

    /// Largest number that is read.
    const MOST: f32 = 1e6;

    struct Floats;

    impl<'de> Visitor<'de> for Floats {
        type Value = Vec<f32>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("the bytes of 32-bit numbers")
        }

        fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Self::Value, E> {
            if !bytes.len().is_multiple_of(4) {
                return Err(E::invalid_length(bytes.len(), &self));
            }
            let number = |bytes: &[u8; 4]| {
                let number = f32::from_le_bytes(*bytes);
                // Steps bound what grids hold far below; NaN is not below either.
                (number.abs() <= MOST)
                    .then_some(number)
                    .ok_or_else(|| E::custom("numbers of a grid are to be within 1e6"))
            };
            bytes.as_chunks().0.iter().map(number).collect()
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
            let mut bytes = Vec::new();
            while let Some(byte) = seq.next_element()? {
                bytes.push(byte);
            }
            self.visit_bytes(&bytes)
        }
    }
}

/// A number that may be infinite: then it is none, as JSON knows no infinity.
pub(crate) mod endless {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer>(value: &f32, to: S) -> Result<S::Ok, S::Error> {
        Some(*value).filter(|value| *value != f32::INFINITY).serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
        Ok(Option::deserialize(from)?.unwrap_or(f32::INFINITY))
    }
}
