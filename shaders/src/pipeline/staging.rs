//! Bytes to the GPU by the host's own encoder, without ever waiting.
//!
//! `Queue::write_buffer` acts before everything of the next submission: two encoders of one submission would both see what
//! the second one wrote, and bytes for an encoder that is dropped arrive all the same. Here bytes are written into mapped
//! buffers while encoding, copied where the encoder stands, and the buffers are mapped again when its submission ends.
//! `wgpu::util::StagingBelt` does as much, but grows without bound behind a slow GPU, does not tell of encoders that were
//! dropped, and panics when memory runs out or the device is lost.

mod frame;

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use super::guard::poll;
pub use frame::{Frame, Room};

/// Frames under way at most; a host has 1 to 4, each of one encoder or some.
pub const MAX_FRAMES: usize = 8;

const AWAY: u8 = 0;
const BACK: u8 = 1;
const LOST: u8 = 2;

/// Least size of a buffer, bytes.
const LEAST: u64 = 1 << 14;
/// Where a write begins: what copies to the largest texels ask for.
const ALIGNMENT: u64 = 16;
/// Frames remembered that were lost.
const REMEMBERED: usize = 64;
/// Buffers larger than so many times what a frame needs are given back.
const OVERSIZE: u64 = 8;

/// A mapped buffer, when it is not under way.
#[derive(Debug)]
struct Chunk {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
}

/// A chunk that is being written.
#[derive(Debug)]
struct Open {
    chunk: Chunk,
    view: wgpu::BufferViewMut,
    used: u64,
}

/// Goes with the encoder, and is dropped with it.
struct Passenger(Arc<AtomicU8>);

impl Drop for Passenger {
    fn drop(&mut self) {
        // Only what did not come back is still away here.
        let _ = self.0.compare_exchange(AWAY, LOST, Ordering::AcqRel, Ordering::Acquire);
    }
}

/// The buffers of one device, and what became of the frames that took them along.
#[derive(Debug)]
pub struct Staging {
    device: wgpu::Device,
    free: Vec<Chunk>,
    /// With the number of their frame, the oldest first.
    away: Vec<(u64, Chunk)>,
    open: Vec<Open>,
    /// Number of the next frame.
    next: u64,
    /// Frames whose encoder was dropped, the last ones.
    lost: VecDeque<u64>,
    losses: u64,
    /// What a frame needs, bytes: falls slowly.
    usual: u64,
    largest: u64,
    declined: u64,
    uploaded: u64,
}

impl Staging {
    /// No buffers yet.
    pub fn new(device: &wgpu::Device) -> Self {
        Self {
            device: device.clone(),
            free: Vec::new(),
            away: Vec::new(),
            open: Vec::new(),
            next: 1,
            lost: VecDeque::with_capacity(REMEMBERED),
            losses: 0,
            usual: LEAST,
            largest: device.limits().max_buffer_size,
            declined: 0,
            uploaded: 0,
        }
    }

    /// A frame of uploads into `encoder`. `None` while [`MAX_FRAMES`] are under way ([`Self::is_full`]): the GPU is behind,
    /// and this frame is best left out. `None` too on a device that is lost or has no memory left.
    pub fn frame<'a>(&'a mut self, encoder: &'a mut wgpu::CommandEncoder) -> Option<Frame<'a>> {
        if self.is_full() {
            self.declined += 1;
            return None;
        }
        self.sweep();
        if self.open(1).is_none() {
            self.losses += 1;
            return None;
        }
        let number = self.next;
        Some(Frame { staging: self, encoder, number, watched: false })
    }

    /// Whether a frame would be declined now. Never waits.
    pub fn is_full(&self) -> bool {
        if self.frames_away() < MAX_FRAMES {
            return false;
        }
        // A lost device brings nothing back: frames are then declined for good.
        poll(&self.device);
        self.frames_away() >= MAX_FRAMES
    }

    fn frames_away(&self) -> usize {
        let mut last = 0;
        let away = self.away.iter().filter(|(_, chunk)| chunk.state.load(Ordering::Acquire) == AWAY);
        away.filter(|(number, _)| std::mem::replace(&mut last, *number) != *number).count()
    }

    /// Takes back what has come back.
    fn sweep(&mut self) {
        let Self { away, free, lost, losses, usual, .. } = self;
        let kept = *usual..=OVERSIZE * usual.next_power_of_two();
        let mut at = 0;
        while let Some((number, chunk)) = away.get(at) {
            match chunk.state.load(Ordering::Acquire) {
                AWAY => {
                    at += 1;
                    continue;
                }
                BACK => {
                    let (_, chunk) = away.remove(at);
                    free.push(chunk);
                }
                // Mapping it again would take as long as making another.
                _ => {
                    if lost.back() != Some(number) {
                        *losses += 1;
                        if lost.len() == REMEMBERED {
                            lost.pop_front();
                        }
                        lost.push_back(*number);
                    }
                    away.remove(at);
                }
            }
        }
        free.retain(|chunk| kept.contains(&chunk.buffer.size()));
    }

    /// How often uploads were lost so far, by encoders that were dropped without a submit or by a lack of memory. When it
    /// has changed, what earlier frames uploaded may not be there.
    pub fn losses(&self) -> u64 {
        let mut last = 0;
        let dropped = self.away.iter().filter(|(_, chunk)| chunk.state.load(Ordering::Acquire) == LOST);
        let dropped = dropped.filter(|(number, _)| std::mem::replace(&mut last, *number) != *number).count();
        self.losses + dropped as u64
    }

    /// How many frames were declined so far.
    pub fn declined(&self) -> u64 {
        self.declined
    }

    /// Bytes uploaded so far, lost ones included.
    pub fn uploaded(&self) -> u64 {
        self.uploaded
    }

    /// Bytes of all its buffers, those under way included.
    pub fn memory(&self) -> u64 {
        let away = self.away.iter().map(|(_, chunk)| chunk);
        self.free.iter().chain(away).map(|chunk| chunk.buffer.size()).sum()
    }

    /// Opens a chunk with so much room.
    fn open(&mut self, bytes: u64) -> Option<&mut Open> {
        // One for all that a frame needs, as a rule.
        let place = self.free.iter().position(|chunk| chunk.buffer.size() >= bytes.max(self.usual));
        let chunk = match place {
            Some(at) => self.free.swap_remove(at),
            None => {
                let size = bytes.max(self.usual).checked_next_power_of_two()?.min(self.largest);
                if size < bytes {
                    return None;
                }
                // What comes of too little memory is told by mapping.
                let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
                let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("staging"),
                    size,
                    usage: wgpu::BufferUsages::MAP_WRITE | wgpu::BufferUsages::COPY_SRC,
                    mapped_at_creation: true,
                });
                drop(scope);
                Chunk { buffer, state: Arc::new(AtomicU8::new(BACK)) }
            }
        };
        let view = chunk.buffer.get_mapped_range_mut(..).ok()?;
        self.open.push(Open { chunk, view, used: 0 });
        self.open.last_mut()
    }
}
