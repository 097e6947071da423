//! Bytes to the GPU by the host's own encoder, without ever waiting.
//!
//! `Queue::write_buffer` acts before everything of the next submission: two encoders of one submission would both see what
//! the second one wrote, and bytes for an encoder that is dropped arrive all the same. Here bytes are written into mapped
//! buffers while encoding, copied where the encoder stands, and the buffers are mapped again when its submission ends.
//! `wgpu::util::StagingBelt` does as much, but grows without bound behind a slow GPU, does not tell of encoders that were
//! dropped, and panics when memory runs out or the device is lost.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use super::guard::poll;

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

/// Where bytes wait to be copied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Room {
    chunk: usize,
    offset: u64,
    bytes: u64,
}

/// Uploads into one encoder; the buffers go with it when this is dropped. Submit encoders in the order in which their
/// frames were made.
#[derive(Debug)]
pub struct Frame<'a> {
    staging: &'a mut Staging,
    /// The host's encoder.
    pub encoder: &'a mut wgpu::CommandEncoder,
    number: u64,
    watched: bool,
}

impl Frame<'_> {
    /// The device.
    pub fn device(&self) -> &wgpu::Device {
        &self.staging.device
    }

    /// Makes room for bytes to be written (rounded up to a multiple of 4). `None` without memory for it, or for no bytes:
    /// then nothing has changed.
    pub fn room(&mut self, bytes: u64) -> Option<Room> {
        let bytes = bytes.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
        if bytes == 0 {
            return None;
        }
        let staging = &mut *self.staging;
        let last = staging.open.last().is_some_and(|open| open.used + bytes <= open.chunk.buffer.size());
        let open = if last { staging.open.last_mut() } else { staging.open(bytes) };
        let Some(open) = open else {
            staging.losses += 1;
            return None;
        };
        let offset = open.used;
        open.used = (offset + bytes).next_multiple_of(ALIGNMENT);
        Some(Room { chunk: staging.open.len() - 1, offset, bytes })
    }

    /// Writes bytes at `at` bytes from the room's beginning; those that it has no place for are left out.
    pub fn fill(&mut self, room: Room, at: u64, bytes: &[u8]) {
        let Some(open) = self.staging.open.get_mut(room.chunk) else { return };
        let bytes = &bytes[..bytes.len().min(room.bytes.saturating_sub(at) as usize)];
        let first = (room.offset + at) as usize;
        open.view.slice(first..first + bytes.len()).copy_from_slice(bytes);
    }

    /// Encodes the copy of a room, from `at` bytes on and as many as `bytes`, to a buffer; all multiples of 4.
    pub fn copy(&mut self, room: Room, [at, bytes]: [u64; 2], target: &wgpu::Buffer, offset: u64) {
        let Some(open) = self.staging.open.get(room.chunk) else { return };
        let bytes = bytes.min(room.bytes.saturating_sub(at));
        self.encoder.copy_buffer_to_buffer(&open.chunk.buffer, room.offset + at, target, offset, bytes);
        self.staging.uploaded += bytes;
    }

    /// Writes bytes (a multiple of 4) to a buffer, seen by what is encoded from here on. False without memory for it; then
    /// [`Staging::losses`] has changed.
    pub fn write(&mut self, target: &wgpu::Buffer, offset: u64, bytes: &[u8]) -> bool {
        if bytes.is_empty() {
            return true;
        }
        let Some(room) = self.room(bytes.len() as u64) else { return false };
        self.fill(room, 0, bytes);
        self.copy(room, [0, bytes.len() as u64], target, offset);
        true
    }

    /// As [`Self::write`], to texels: `bytes` row after row, layer after layer, without padding.
    pub fn write_texels(&mut self, target: wgpu::TexelCopyTextureInfo<'_>, size: wgpu::Extent3d, bytes: &[u8]) -> bool {
        let rows = size.height * size.depth_or_array_layers;
        let row = bytes.len() / rows.max(1) as usize;
        if row == 0 {
            return true;
        }
        let pitch = (row as u32).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let Some(room) = self.room(u64::from(pitch) * u64::from(rows)) else { return false };
        for (texels, at) in bytes.chunks_exact(row).zip(0..) {
            self.fill(room, u64::from(pitch) * at, texels);
        }
        let Some(open) = self.staging.open.get(room.chunk) else { return false };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: room.offset,
            bytes_per_row: Some(pitch),
            rows_per_image: Some(size.height),
        };
        let source = wgpu::TexelCopyBufferInfo { buffer: &open.chunk.buffer, layout };
        self.encoder.copy_buffer_to_texture(source, target, size);
        self.staging.uploaded += bytes.len() as u64;
        true
    }

    /// Makes sure that the next writes, of so many bytes together in so many parts, will not lack memory. False if they
    /// would.
    pub fn reserve(&mut self, bytes: u64, parts: u64) -> bool {
        let staging = &mut *self.staging;
        let bytes = bytes + parts * ALIGNMENT;
        let last = staging.open.last().is_some_and(|open| open.used + bytes <= open.chunk.buffer.size());
        last || staging.open(bytes).is_some()
    }

    /// Names this frame for [`Self::is_lost`] and [`Self::has_landed`] of later ones.
    pub fn watch(&mut self) -> u64 {
        self.watched = true;
        self.number
    }

    /// Whether an earlier frame's encoder was dropped without a submit.
    pub fn is_lost(&self, number: u64) -> bool {
        self.staging.lost.contains(&number)
    }

    /// Whether the GPU is done with an earlier frame.
    pub fn has_landed(&self, number: u64) -> bool {
        number < self.number && !self.is_lost(number) && self.staging.away.iter().all(|(away, _)| *away != number)
    }

    /// As [`Staging::losses`].
    pub fn losses(&self) -> u64 {
        self.staging.losses()
    }
}

impl Drop for Frame<'_> {
    fn drop(&mut self) {
        let staging = &mut *self.staging;
        let used: u64 = staging.open.iter().map(|open| open.used).sum();
        // What comes once is not the rule.
        staging.usual = used.clamp(staging.usual - staging.usual / 64, 2 * staging.usual).max(LEAST);
        for Open { chunk, view, used } in staging.open.drain(..) {
            drop(view);
            if used == 0 && !self.watched {
                staging.free.push(chunk);
                continue;
            }
            chunk.buffer.unmap();
            chunk.state.store(AWAY, Ordering::Release);
            let passenger = Passenger(chunk.state.clone());
            self.encoder.map_buffer_on_submit(&chunk.buffer, wgpu::MapMode::Write, .., move |mapped| {
                if mapped.is_ok() {
                    passenger.0.store(BACK, Ordering::Release);
                }
            });
            staging.away.push((self.number, chunk));
            staging.next = self.number + 1;
        }
    }
}
