//! Explicit bind group layouts and compute pipelines from a [`Pass`], the [`Staging`] ring upwards and the [`Readback`]
//! ring downwards, and errors of a device as values ([`guarded`]).
//!
//! Nothing here submits, blocks, or decides when a pass runs.

mod guard;
mod readback;
mod staging;

use std::num::NonZeroU64;

use crate::Pass;

pub use guard::{Injected, Refusal, guarded, inject, is_alive};
pub use readback::{Readback, Reading};
pub use staging::{Frame, MAX_FRAMES, Room, Staging};

/// What stands at one binding of a bind group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slot {
    /// A uniform buffer of at least `size` bytes.
    Uniform {
        /// Size of the struct in bytes.
        size: usize,
    },
    /// A uniform buffer with a dynamic offset, of at least `size` bytes from the offset on.
    DynamicUniform {
        /// Size of the struct in bytes.
        size: usize,
    },
    /// A storage buffer that is only read.
    Read,
    /// A storage buffer that is read and written.
    ReadWrite,
    /// A sampled float texture array.
    TextureArray {
        /// Whether a filtering sampler may read it (never true for 32-bit floats).
        filterable: bool,
    },
    /// A sampled texture array of unsigned integers.
    UintTextureArray,
    /// A sampled float texture.
    Texture {
        /// Whether a filtering sampler may read it (never true for 32-bit floats).
        filterable: bool,
    },
    /// A storage texture array that is only written.
    WriteTextureArray {
        /// Its format.
        format: wgpu::TextureFormat,
    },
    /// A filtering sampler.
    Sampler,
}

impl Slot {
    fn ty(self) -> wgpu::BindingType {
        let buffer = |ty, has_dynamic_offset, size: usize| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size: NonZeroU64::new(size as u64),
        };
        let texture = |sample_type, view_dimension| wgpu::BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        let float = |filterable| wgpu::TextureSampleType::Float { filterable };
        match self {
            Slot::Uniform { size } => buffer(wgpu::BufferBindingType::Uniform, false, size),
            Slot::DynamicUniform { size } => buffer(wgpu::BufferBindingType::Uniform, true, size),
            Slot::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }, false, 0),
            Slot::ReadWrite => buffer(wgpu::BufferBindingType::Storage { read_only: false }, false, 0),
            Slot::TextureArray { filterable } => texture(float(filterable), wgpu::TextureViewDimension::D2Array),
            Slot::UintTextureArray => texture(wgpu::TextureSampleType::Uint, wgpu::TextureViewDimension::D2Array),
            Slot::Texture { filterable } => texture(float(filterable), wgpu::TextureViewDimension::D2),
            Slot::WriteTextureArray { format } => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format,
                view_dimension: wgpu::TextureViewDimension::D2Array,
            },
            Slot::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

/// A bind group layout whose binding `i` is `slots[i]`.
pub fn group_layout(
    device: &wgpu::Device,
    label: &str,
    visibility: wgpu::ShaderStages,
    slots: &[Slot],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(slots)
        .map(|(binding, slot)| wgpu::BindGroupLayoutEntry { binding, visibility, ty: slot.ty(), count: None })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// A bind group whose binding `i` is `resources[i]`.
pub fn bind_group(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}

/// The shader module of a pass.
pub fn shader(device: &wgpu::Device, pass: &Pass) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(pass.name),
        source: wgpu::ShaderSource::Wgsl(guard::source(pass).into()),
    })
}

/// A pipeline layout whose group `i` is `groups[i]`.
pub fn pipeline_layout(device: &wgpu::Device, label: &str, groups: &[&wgpu::BindGroupLayout]) -> wgpu::PipelineLayout {
    let groups: Vec<_> = groups.iter().copied().map(Some).collect();
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &groups,
        immediate_size: 0,
    })
}

/// The compute pipeline of a pass: entry point named `entry_point`, group `i` laid out as `groups[i]`, and the
/// values of the `override` constants by name.
///
/// Workgroup memory is *not* zeroed first: a pass writes before it reads.
pub fn compute_pipeline(
    device: &wgpu::Device,
    pass: &Pass,
    entry_point: &str,
    groups: &[&wgpu::BindGroupLayout],
    constants: &[(&str, f64)],
) -> wgpu::ComputePipeline {
    let layout = pipeline_layout(device, pass.name, groups);
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry_point),
        layout: Some(&layout),
        module: &shader(device, pass),
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions { constants, zero_initialize_workgroup_memory: false },
        cache: None,
    })
}
