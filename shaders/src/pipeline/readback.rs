//! Bytes from the GPU without ever waiting for it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use super::guard::poll;

const FREE: u8 = 0;
const IN_FLIGHT: u8 = 1;
const READY: u8 = 2;

/// The latest bytes that came back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading<'a, S> {
    /// What the caller stamped the copy with when it was encoded (a tick, a frame).
    pub stamp: S,
    /// The bytes copied.
    pub bytes: &'a [u8],
}

#[derive(Debug)]
struct Slot<S> {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    sequence: u64,
    bytes: u64,
    stamp: S,
}

/// Frees the slot again if its encoder is dropped without a submit, or if mapping fails.
struct Flight(Arc<AtomicU8>);

impl Flight {
    fn land(self, mapped: bool) {
        if mapped {
            self.0.store(READY, Ordering::Release);
        }
    }
}

impl Drop for Flight {
    fn drop(&mut self) {
        // Only a flight that did not land as READY is still IN_FLIGHT here.
        let _ = self.0.compare_exchange(IN_FLIGHT, FREE, Ordering::AcqRel, Ordering::Acquire);
    }
}

/// A ring of mappable buffers. A copy is encoded into a free one and mapped when its submission ends; when none is
/// free, the copy is dropped. The result is as old as the GPU is behind: look at its stamp.
#[derive(Debug)]
pub struct Readback<S> {
    slots: Vec<Slot<S>>,
    next_sequence: u64,
    latest: Vec<u8>,
    latest_stamp: Option<(u64, S)>,
    dropped: u64,
}

impl<S: Copy + Default> Readback<S> {
    /// A ring of `slots` buffers (3 is usual) of `bytes` bytes each, rounded up to a multiple of 4.
    pub fn new(device: &wgpu::Device, label: &str, bytes: u64, slots: usize) -> Self {
        let size = bytes.max(4).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
        let slots = (0..slots.max(1))
            .map(|_| Slot {
                buffer: device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size,
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                }),
                state: Arc::new(AtomicU8::new(FREE)),
                sequence: 0,
                bytes: 0,
                stamp: S::default(),
            })
            .collect();
        Self { slots, next_sequence: 1, latest: Vec::with_capacity(size as usize), latest_stamp: None, dropped: 0 }
    }

    /// Encodes a copy of `bytes` bytes of `source` from `offset` on (both multiples of 4; cut to the ring's size).
    /// False when every slot is still in flight: then nothing is encoded.
    pub fn encode(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        source: &wgpu::Buffer,
        offset: u64,
        bytes: u64,
        stamp: S,
    ) -> bool {
        self.encode_parts(encoder, &[(source, offset, bytes)], stamp)
    }

    /// As [`Self::encode`], of several parts (buffer, offset, bytes), which come back one after the other.
    pub fn encode_parts(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        parts: &[(&wgpu::Buffer, u64, u64)],
        stamp: S,
    ) -> bool {
        let free = self.slots.iter_mut().find(|slot| slot.state.load(Ordering::Acquire) == FREE);
        let Some(slot) = free else {
            self.dropped += 1;
            return false;
        };
        slot.bytes = 0;
        slot.stamp = stamp;
        slot.sequence = self.next_sequence;
        self.next_sequence += 1;
        slot.state.store(IN_FLIGHT, Ordering::Release);
        for (source, offset, bytes) in parts {
            let bytes = (*bytes).min(slot.buffer.size() - slot.bytes);
            encoder.copy_buffer_to_buffer(source, *offset, &slot.buffer, slot.bytes, bytes);
            slot.bytes += bytes;
        }
        let flight = Flight(slot.state.clone());
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, 0..slot.bytes, move |result| {
            flight.land(result.is_ok());
        });
        true
    }

    /// Takes what has come since the last call, without waiting, and returns the newest bytes there are. None until
    /// the first copy has come.
    pub fn poll(&mut self, device: &wgpu::Device) -> Option<Reading<'_, S>> {
        // A lost device delivers nothing: the latest result stays, with its stamp.
        poll(device);
        for slot in &self.slots {
            if slot.state.load(Ordering::Acquire) != READY {
                continue;
            }
            if self.latest_stamp.is_none_or(|(sequence, _)| sequence < slot.sequence)
                && let Ok(view) = slot.buffer.get_mapped_range(0..slot.bytes)
            {
                self.latest.clear();
                self.latest.extend_from_slice(&view);
                self.latest_stamp = Some((slot.sequence, slot.stamp));
            }
            slot.buffer.unmap();
            slot.state.store(FREE, Ordering::Release);
        }
        self.latest()
    }

    /// The newest bytes taken by [`Self::poll`] so far.
    pub fn latest(&self) -> Option<Reading<'_, S>> {
        self.latest_stamp.map(|(_, stamp)| Reading { stamp, bytes: &self.latest })
    }

    /// How many copies were dropped because every slot was in flight.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
}
