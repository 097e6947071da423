//! The uploads of one frame, into the encoder that takes them along.

use std::sync::atomic::Ordering;

use super::{ALIGNMENT, AWAY, BACK, LEAST, Open, Passenger, Staging};

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
    pub(super) staging: &'a mut Staging,
    /// The host's encoder.
    pub encoder: &'a mut wgpu::CommandEncoder,
    pub(super) number: u64,
    pub(super) watched: bool,
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
