//! Values by handle, whose order of reuse can be written and read.
//!
//! As `slotmap::SlotMap`, but the places that are free are a list of its own: a copy made from bytes hands out the same handles
//! as the original. That is what peers need who run the same calls.

use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

use slotmap::{Key, KeyData};

/// A place: even versions are free.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Slot<V> {
    version: u32,
    value: Option<V>,
}

/// Values by handle. A handle stays invalid for ever once its value was removed.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Arena<K, V> {
    slots: Vec<Slot<V>>,
    /// Free places; the last is taken next.
    free: Vec<u32>,
    #[cfg_attr(feature = "serde", serde(skip))]
    key: PhantomData<fn() -> K>,
}

impl<K, V> Default for Arena<K, V> {
    fn default() -> Self {
        Self { slots: Vec::new(), free: Vec::new(), key: PhantomData }
    }
}

/// Place and version of a handle.
fn parts<K: Key>(key: K) -> (usize, u32) {
    let bits = key.data().as_ffi();
    // Places count from 1, as those of a slot map: handles look alike.
    ((bits as u32).wrapping_sub(1) as usize, (bits >> 32) as u32)
}

fn key<K: Key>(at: usize, version: u32) -> K {
    K::from(KeyData::from_ffi(u64::from(version) << 32 | (at as u64 + 1)))
}

impl<K: Key, V> Arena<K, V> {
    /// Puts a value in and returns its handle.
    pub fn insert(&mut self, value: V) -> K {
        let at = match self.free.pop() {
            Some(at) => at as usize,
            None => {
                self.slots.push(Slot { version: 0, value: None });
                self.slots.len() - 1
            }
        };
        let slot = &mut self.slots[at];
        slot.version = slot.version.wrapping_add(1);
        slot.value = Some(value);
        key(at, slot.version)
    }

    /// Takes a value out.
    pub fn remove(&mut self, key: K) -> Option<V> {
        let (at, version) = parts(key);
        let slot = self.slots.get_mut(at).filter(|slot| slot.version == version)?;
        let value = slot.value.take()?;
        slot.version = slot.version.wrapping_add(1);
        self.free.push(at as u32);
        Some(value)
    }

    /// The value of a handle.
    pub fn get(&self, key: K) -> Option<&V> {
        let (at, version) = parts(key);
        self.slots.get(at).filter(|slot| slot.version == version)?.value.as_ref()
    }

    /// The value of a handle, for changing it.
    pub fn get_mut(&mut self, key: K) -> Option<&mut V> {
        let (at, version) = parts(key);
        self.slots.get_mut(at).filter(|slot| slot.version == version)?.value.as_mut()
    }

    /// How many values there are.
    pub fn len(&self) -> usize {
        self.slots.len() - self.free.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them, by place.
    pub fn iter(&self) -> impl Iterator<Item = (K, &V)> + '_ {
        let slots = self.slots.iter().enumerate();
        slots.filter_map(|(at, slot)| Some((key(at, slot.version), slot.value.as_ref()?)))
    }

    /// All of them, by place, for changing them.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (K, &mut V)> + '_ {
        let slots = self.slots.iter_mut().enumerate();
        slots.filter_map(|(at, slot)| Some((key(at, slot.version), slot.value.as_mut()?)))
    }

    /// Removes all for which `keep` is false.
    pub fn retain(&mut self, mut keep: impl FnMut(K, &V) -> bool) {
        for at in 0..self.slots.len() {
            let slot = &self.slots[at];
            let key = key(at, slot.version);
            if slot.value.as_ref().is_some_and(|value| !keep(key, value)) {
                self.remove(key);
            }
        }
    }
}

impl<K: Key, V> Index<K> for Arena<K, V> {
    type Output = V;

    /// # Panics
    /// If there is no such value.
    fn index(&self, key: K) -> &V {
        self.get(key).expect("a handle of a value that is there")
    }
}

impl<K: Key, V> IndexMut<K> for Arena<K, V> {
    fn index_mut(&mut self, key: K) -> &mut V {
        self.get_mut(key).expect("a handle of a value that is there")
    }
}

#[cfg(feature = "serde")]
impl<'de, K: Key, V: serde::Deserialize<'de>> serde::Deserialize<'de> for Arena<K, V> {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        #[serde(rename = "Arena", bound(deserialize = "V: serde::Deserialize<'de>"))]
        struct Raw<V> {
            slots: Vec<Slot<V>>,
            free: Vec<u32>,
        }
        let Raw { slots, free } = Raw::deserialize(from)?;
        let mut listed = vec![false; slots.len()];
        let once =
            free.iter().all(|at| listed.get_mut(*at as usize).is_some_and(|seen| !std::mem::replace(seen, true)));
        let fits = |(slot, listed): (&Slot<V>, &bool)| {
            slot.value.is_none() == *listed && slot.version.is_multiple_of(2) == *listed
        };
        if !once || !slots.iter().zip(&listed).all(fits) {
            return Err(serde::de::Error::custom("free places that are none"));
        }
        Ok(Self { slots, free, key: PhantomData })
    }
}

#[cfg(test)]
mod tests {
    use slotmap::{DefaultKey, SlotMap};

    use super::*;

    #[test]
    fn handles_are_those_of_a_slot_map() {
        let (mut own, mut other) = (Arena::<DefaultKey, u32>::default(), SlotMap::new());
        let (mut keys, mut state) = (Vec::new(), 7_u32);
        for i in 0..2000 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            if state >> 30 == 0 && !keys.is_empty() {
                let key = keys.swap_remove(state as usize % keys.len());
                assert_eq!(own.remove(key), other.remove(key));
                assert_eq!((own.remove(key), own.get(key)), (None, None));
            } else {
                let key = own.insert(i);
                assert_eq!(key, other.insert(i));
                keys.push(key);
            }
            assert_eq!(own.len(), other.len());
        }
        assert!(own.iter().eq(other.iter()));
        own.retain(|_, value| value % 3 == 0);
        assert!(own.iter().map(|(_, value)| *value).eq(other.values().copied().filter(|value| value % 3 == 0)));
    }
}
