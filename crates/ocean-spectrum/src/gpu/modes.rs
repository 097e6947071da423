//! The modes as textures: a read from a texture is fast on every adapter.

use bytemuck::{Pod, cast_slice};
use open_water_shaders::pipeline::Frame;

use super::upload::{self, Shape};
use crate::{CascadeModes, Ocean};

/// Amplitudes and turns, a layer per cascade; while two mode sets are mixed, as many again for the second.
#[derive(Debug, Clone)]
pub(super) struct ModeTextures {
    shape: Shape,
    amplitudes: wgpu::Texture,
    turns: wgpu::Texture,
    /// [`crate::Moment::sets`] of what they hold; 0 for nothing yet.
    held: [u64; 2],
    /// [`Frame::losses`] as they were written.
    losses: u64,
}

fn texture(device: &wgpu::Device, label: &str, size: wgpu::Extent3d, format: wgpu::TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Writes layers from `base` on.
fn write(frame: &mut Frame<'_>, texture: &wgpu::Texture, base: u32, layers: u32, texels: &[u8]) -> bool {
    let size = wgpu::Extent3d { depth_or_array_layers: layers, ..texture.size() };
    let origin = wgpu::Origin3d { z: base, ..wgpu::Origin3d::ZERO };
    frame.write_texels(wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() }, size, texels)
}

/// Cells of all cascades in arrays of `size`: modes do not depend on the array that holds them.
fn padded<T: Pod>(set: &[CascadeModes], size: u32, cells: impl Fn(&CascadeModes) -> &[T]) -> Vec<T> {
    let side = size as usize;
    let mut all = vec![T::zeroed(); set.len() * side * side];
    for (layer, modes) in all.chunks_exact_mut(side * side).zip(set) {
        let own = modes.size as usize;
        let place = |index: usize| if index < own / 2 { index } else { index + side - own };
        for (row, cells) in cells(modes).chunks_exact(own).enumerate() {
            let (low, high) = cells.split_at(own / 2);
            let line = &mut layer[place(row) * side..][..side];
            line[..own / 2].copy_from_slice(low);
            line[side - own / 2..].copy_from_slice(high);
        }
    }
    all
}

impl ModeTextures {
    pub(super) fn new(device: &wgpu::Device, shape: Shape, mixed: bool) -> Self {
        let size = shape.extent(shape.count * if mixed { 2 } else { 1 });
        Self {
            shape,
            amplitudes: texture(device, "ocean amplitudes", size, wgpu::TextureFormat::Rgba32Float),
            turns: texture(device, "ocean turns", size, wgpu::TextureFormat::R32Uint),
            held: [0; 2],
            losses: 0,
        }
    }

    /// Whether there is room for a second set.
    pub(super) fn is_mixed(&self) -> bool {
        self.amplitudes.depth_or_array_layers() > self.shape.count
    }

    /// Holds nothing any more, as far as it knows.
    pub(super) fn forget(&mut self) {
        self.held = [0; 2];
    }

    /// Uploads the mode sets of a time, as far as they are not held.
    pub(super) fn set(&mut self, frame: &mut Frame<'_>, ocean: &Ocean, t: f64) {
        let sets = ocean.moment_at(t).sets;
        let (first, second) = ocean.mode_sets_at(t);
        if self.losses != frame.losses() {
            self.losses = frame.losses();
            self.held = [0; 2];
        }
        for (slot, set) in [Some(first), second].into_iter().enumerate() {
            let Some(set) = set.filter(|_| self.held[slot] != sets[slot]) else { continue };
            let (base, count, size) = (slot as u32 * self.shape.count, self.shape.count, self.shape.size);
            let amplitudes = padded(set, size, |modes| &modes.amp);
            let turns = padded(set, size, |modes| &modes.n);
            if write(frame, &self.amplitudes, base, count, cast_slice(&amplitudes))
                && write(frame, &self.turns, base, count, cast_slice(&turns))
            {
                self.held[slot] = sets[slot];
            }
        }
    }

    /// Views of the amplitudes and of the turns.
    pub(super) fn views(&self) -> [wgpu::TextureView; 2] {
        [upload::level(&self.amplitudes, 0), upload::level(&self.turns, 0)]
    }
}
