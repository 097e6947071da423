//! The modes as textures: a read from a texture is fast on every adapter.

use bytemuck::cast_slice;

use super::upload::Shape;
use crate::Ocean;

#[derive(Debug)]
struct Pending {
    amplitudes: Vec<[f32; 4]>,
    turns: Vec<u32>,
}

/// Amplitudes and turns, a layer per cascade.
#[derive(Debug)]
pub(super) struct ModeTextures {
    amplitudes: wgpu::Texture,
    turns: wgpu::Texture,
    pending: Option<Pending>,
}

fn texture(device: &wgpu::Device, label: &str, shape: Shape, format: wgpu::TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: shape.extent(shape.count),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn write(queue: &wgpu::Queue, texture: &wgpu::Texture, texels: &[u8]) {
    let size = texture.size();
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(texels.len() as u32 / (size.height * size.depth_or_array_layers)),
        rows_per_image: Some(size.height),
    };
    queue.write_texture(texture.as_image_copy(), texels, layout, size);
}

impl ModeTextures {
    pub(super) fn new(device: &wgpu::Device, shape: Shape, ocean: &Ocean) -> Self {
        let mut textures = Self {
            amplitudes: texture(device, "ocean amplitudes", shape, wgpu::TextureFormat::Rgba32Float),
            turns: texture(device, "ocean turns", shape, wgpu::TextureFormat::R32Uint),
            pending: None,
        };
        textures.set(ocean);
        textures
    }

    /// Takes over the modes, to be uploaded by the next [`Self::flush`].
    pub(super) fn set(&mut self, ocean: &Ocean) {
        self.pending = Some(Pending {
            amplitudes: ocean.modes().iter().flat_map(|modes| modes.amp.iter().copied()).collect(),
            turns: ocean.modes().iter().flat_map(|modes| modes.n.iter().copied()).collect(),
        });
    }

    pub(super) fn flush(&mut self, queue: &wgpu::Queue) {
        if let Some(Pending { amplitudes, turns }) = self.pending.take() {
            write(queue, &self.amplitudes, cast_slice(&amplitudes));
            write(queue, &self.turns, cast_slice(&turns));
        }
    }

    /// Views of the amplitudes and of the turns.
    pub(super) fn views(&self) -> [wgpu::TextureView; 2] {
        [super::upload::level(&self.amplitudes, 0), super::upload::level(&self.turns, 0)]
    }
}
