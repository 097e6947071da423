//! Shape, parameters and buffers of a sea on the GPU.

use open_water_shaders::ocean::{FFT_BLOCK, FFT_THREADS, MIN_SIZE};

use super::error::{GpuError, at_most, equal};
use crate::CascadeModes;

/// Cascades and their size, from which every array's size follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shape {
    pub(super) count: u32,
    pub(super) size: u32,
}

impl Shape {
    pub(super) fn of(modes: &[CascadeModes]) -> Self {
        // The modes of a cascade do not depend on its size: all are synthesised at the largest.
        let size = modes.iter().map(|modes| modes.size).max().unwrap_or(MIN_SIZE);
        Self { count: modes.len() as u32, size }
    }

    /// Layers of displacement and derivative together.
    pub(super) fn layers(self) -> u32 {
        2 * self.count
    }

    /// Size of a texture with so many layers.
    pub(super) fn extent(self, depth_or_array_layers: u32) -> wgpu::Extent3d {
        wgpu::Extent3d { width: self.size, height: self.size, depth_or_array_layers }
    }

    pub(super) fn check(self, limits: &wgpu::Limits) -> Result<(), GpuError> {
        let foam = 4 * u64::from(self.count) * u64::from(self.size).pow(2);
        let binding = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        at_most("bytes of foam", foam, binding)?;
        at_most("texels per side", self.size.into(), limits.max_texture_dimension_2d.into())?;
        at_most("texture layers", self.layers().into(), limits.max_texture_array_layers.into())?;
        let memory = limits.max_compute_workgroup_storage_size;
        at_most("bytes of workgroup memory", u64::from(16 * FFT_BLOCK), memory.into())?;
        let invocations = limits.max_compute_invocations_per_workgroup;
        at_most("invocations of a workgroup", FFT_THREADS.into(), invocations.into())?;
        let textures = limits.max_storage_textures_per_shader_stage;
        at_most("storage textures of a stage", 3, textures.into())
    }

    pub(super) fn check_same(self, other: Self) -> Result<(), GpuError> {
        equal("number of cascades", other.count, self.count)?;
        equal("size of the largest cascade", other.size, self.size)
    }
}

/// A texture array of both kinds of layers, and the views of each kind.
pub(super) fn texture(
    device: &wgpu::Device,
    label: &str,
    shape: Shape,
    format: wgpu::TextureFormat,
    mip_level_count: u32,
) -> (wgpu::Texture, [wgpu::TextureView; 2]) {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: shape.extent(shape.layers()),
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let views = [0, shape.count].map(|base_array_layer| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some(label),
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            base_array_layer,
            array_layer_count: Some(shape.count),
            ..Default::default()
        })
    });
    (texture, views)
}

/// One mip level, all layers.
pub(super) fn level(texture: &wgpu::Texture, base_mip_level: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        label: Some("mip level"),
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_mip_level,
        mip_level_count: Some(1),
        ..Default::default()
    })
}
