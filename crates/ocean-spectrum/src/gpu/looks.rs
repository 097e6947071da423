//! Fields to filtered half-float looks with foam: `ocean_looks`, then `ocean_mips` as often as needed.

use open_water_shaders::ocean::{LOOKS, MIPS, OceanParams};
use open_water_shaders::pipeline::{Slot, bind_group, compute_pipeline, group_layout};

use super::GpuPass;
use super::upload::{self, Shape};

/// Levels that `ocean_looks` writes.
const FIRST_LEVELS: u32 = 3;
/// Levels that `ocean_mips` writes.
const MORE_LEVELS: u32 = 2;
/// Texels per side that a workgroup reads.
const BLOCK: u32 = 32;

#[derive(Debug, Clone)]
struct Mips {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    /// Texels per side of the level read.
    side: u32,
}

#[derive(Debug, Clone)]
pub(super) struct Looks {
    first: (wgpu::ComputePipeline, wgpu::BindGroup),
    mips: Vec<Mips>,
    pub(super) texture: wgpu::Texture,
    pub(super) displacement: wgpu::TextureView,
    pub(super) derivative: wgpu::TextureView,
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

impl Looks {
    pub(super) fn new(device: &wgpu::Device, shape: Shape, params: &wgpu::Buffer, fields: &wgpu::Texture) -> Self {
        // Down to 2 x 2 texels: beyond, a cascade is faded out.
        let levels = shape.size.ilog2();
        let (texture, [displacement, derivative]) = upload::texture(device, "ocean looks", shape, FORMAT, levels);
        // wgpu clears new buffers: no foam at first.
        let foam = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("ocean foam"),
            size: 4 * u64::from(shape.count) * u64::from(shape.size).pow(2),
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let write = Slot::WriteTextureArray { format: FORMAT };
        let read = Slot::TextureArray { filterable: false };
        let uniform = Slot::Uniform { size: size_of::<OceanParams>() };
        let compute = wgpu::ShaderStages::COMPUTE;

        let layout = group_layout(device, LOOKS.name, compute, &[uniform, read, Slot::ReadWrite, write, write, write]);
        let all_fields = upload::level(fields, 0);
        let views: Vec<_> = (0..FIRST_LEVELS).map(|l| upload::level(&texture, l)).collect();
        let mut resources =
            vec![params.as_entire_binding(), wgpu::BindingResource::TextureView(&all_fields), foam.as_entire_binding()];
        resources.extend(views.iter().map(wgpu::BindingResource::TextureView));
        let first = (
            compute_pipeline(device, &LOOKS, "ocean_looks", &[&layout], &[("N", f64::from(shape.size))]),
            bind_group(device, LOOKS.name, &layout, &resources),
        );

        let layout = group_layout(device, MIPS.name, compute, &[read, write, write]);
        let mips = (FIRST_LEVELS..levels)
            .step_by(MORE_LEVELS as usize)
            .map(|level| Self::mips(device, shape, &layout, &texture, level))
            .collect();
        Self { first, mips, texture, displacement, derivative }
    }

    /// The dispatch that writes `level` and the one after it.
    fn mips(
        device: &wgpu::Device,
        shape: Shape,
        layout: &wgpu::BindGroupLayout,
        texture: &wgpu::Texture,
        level: u32,
    ) -> Mips {
        let side = shape.size >> (level - 1);
        let views: Vec<_> = (0..=MORE_LEVELS)
            .map(|i| level - 1 + i)
            .map(|l| if l < texture.mip_level_count() { upload::level(texture, l) } else { unused(device, shape) })
            .collect();
        let resources: Vec<_> = views.iter().map(wgpu::BindingResource::TextureView).collect();
        Mips {
            pipeline: compute_pipeline(device, &MIPS, "ocean_mips", &[layout], &[("SIDE", f64::from(side))]),
            group: bind_group(device, MIPS.name, layout, &resources),
            side,
        }
    }

    pub(super) fn passes(&self, shape: Shape) -> Vec<GpuPass> {
        let level = |side: u32| 8 * u64::from(shape.layers()) * u64::from(side).pow(2);
        let pass = |name, bytes| GpuPass { name, cascades: 0..shape.count, bytes };
        // Both kinds of fields (the derivative twice, for the foam too), and the foam before and after.
        let read = 3 * level(shape.size) + level(shape.size) / 2;
        let written = (0..FIRST_LEVELS).map(|l| level(shape.size >> l)).sum::<u64>();
        let mips = self.mips.iter().map(|mips| {
            let levels = if mips.side >= 8 { 0..=MORE_LEVELS } else { 0..=1 };
            pass(MIPS.name, levels.map(|l| level(mips.side >> l)).sum())
        });
        std::iter::once(pass(LOOKS.name, read + written)).chain(mips).collect()
    }

    /// Number of dispatches.
    pub(super) fn count(&self) -> u32 {
        1 + self.mips.len() as u32
    }

    /// Records one dispatch, or all, for so many cascades, the longest first. Returns how many were recorded.
    pub(super) fn record(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        shape: Shape,
        only: Option<usize>,
        cascades: u32,
    ) -> u32 {
        let layers = 2 * cascades.min(shape.count);
        if layers == 0 {
            return 0;
        }
        let mut recorded = 0;
        let (pipeline, group) = &self.first;
        let stages = self.mips.iter().map(|mips| (&mips.pipeline, &mips.group, mips.side));
        let all = std::iter::once((pipeline, group, shape.size)).chain(stages).enumerate();
        for (_, (pipeline, group, side)) in all.filter(|(i, _)| only.is_none_or(|only| *i == only)) {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            let blocks = side.div_ceil(BLOCK);
            pass.dispatch_workgroups(blocks, blocks, layers);
            recorded += 1;
        }
        recorded
    }
}

/// Stands at a binding whose level does not exist; nothing is written to it.
fn unused(device: &wgpu::Device, shape: Shape) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("ocean looks, no such level"),
        size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: shape.layers() },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::STORAGE_BINDING,
        view_formats: &[],
    });
    upload::level(&texture, 0)
}
