//! Sea and sky.

use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout, shader};
use open_water_shaders::view::{self, ViewFrame};

use crate::desc::{Output, ViewDesc, ViewError};
use crate::foam;
use crate::frame::Sky;
use crate::frame::{ViewParams, build};
use crate::sky::Light;

/// Columns drawn together, so that a small post-transform cache keeps a row of them.
const BLOCK: u32 = 12;

/// Draws the sea and the sky.
#[derive(Debug)]
pub struct WaterView {
    desc: ViewDesc,
    output: Output,
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    frame: wgpu::Buffer,
    foam: Option<wgpu::Texture>,
    water: wgpu::RenderPipeline,
    sky: wgpu::RenderPipeline,
    indices: wgpu::Buffer,
    index_count: u32,
    light: Option<(Sky, Light)>,
    ready: bool,
    water_in_view: bool,
}

/// Two triangles a cell, in blocks of columns, each block from near to far.
fn grid_indices(columns: u32, rows: u32) -> Vec<u32> {
    let stride = columns + 1;
    let mut indices = Vec::with_capacity((columns * rows * 6) as usize);
    for first in (0..columns).step_by(BLOCK as usize) {
        for row in 0..rows {
            for column in first..(first + BLOCK).min(columns) {
                let a = row * stride + column;
                let (b, c, d) = (a + 1, a + stride, a + stride + 1);
                indices.extend_from_slice(&[a, c, b, b, c, d]);
            }
        }
    }
    indices
}

/// A buffer with content. A lost device leaves it empty; it says so itself.
pub(crate) fn filled(device: &wgpu::Device, label: &str, usage: wgpu::BufferUsages, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: (bytes.len() as u64).max(4),
        usage,
        mapped_at_creation: true,
    });
    if let Ok(mut range) = buffer.get_mapped_range_mut(..) {
        range.slice(..bytes.len()).copy_from_slice(bytes);
    }
    buffer.unmap();
    buffer
}

/// How a pass meets what is in the targets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Blend {
    /// Hides what is behind it.
    Opaque,
    /// Covers what is behind it as far as its alpha says, premultiplied; stands in the depth target.
    Over,
    /// Fills what is left, without depth.
    Behind,
}

/// A pipeline of a view pass on the host's targets: `groups` are its bind group layouts, `constants` its overrides.
pub(crate) fn pipeline(
    device: &wgpu::Device,
    desc: &ViewDesc,
    pass: &open_water_shaders::Pass,
    groups: &[&wgpu::BindGroupLayout],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    how: Blend,
    constants: &[(&str, f64)],
) -> wgpu::RenderPipeline {
    let options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
    let module = shader(device, pass);
    let layout = pipeline_layout(device, pass.name, groups);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.name),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(pass.entry_points[0]),
            compilation_options: options.clone(),
            buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(desc.depth_stencil(how != Blend::Behind)),
        multisample: wgpu::MultisampleState { count: desc.samples, ..wgpu::MultisampleState::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(pass.entry_points[1]),
            compilation_options: options,
            targets: &[Some(wgpu::ColorTargetState {
                format: desc.color_format,
                blend: (how == Blend::Over).then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

impl WaterView {
    /// Builds pipelines and buffers. `surface_layout` is the layout of the composite's bind group, which
    /// [`WaterView::draw`] takes.
    ///
    /// # Errors
    /// A field of `desc` out of its bound.
    pub fn new(
        device: &wgpu::Device,
        desc: &ViewDesc,
        surface_layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, ViewError> {
        let output = desc.check()?;
        let layout = group_layout(
            device,
            "view",
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            &[Slot::Uniform { size: size_of::<ViewFrame>() }, Slot::Texture { filterable: true }, Slot::Sampler],
        );
        let frame = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("view frame"),
            size: size_of::<ViewFrame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let foam = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("foam"),
            size: wgpu::Extent3d { width: foam::SIZE, height: foam::SIZE, depth_or_array_layers: 1 },
            mip_level_count: foam::MIPS,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("foam"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        });
        let foam_view = foam.create_view(&wgpu::TextureViewDescriptor::default());
        let group = bind_group(
            device,
            "view",
            &layout,
            &[
                frame.as_entire_binding(),
                wgpu::BindingResource::TextureView(&foam_view),
                wgpu::BindingResource::Sampler(&sampler),
            ],
        );
        let list = grid_indices(desc.grid[0], desc.grid[1]);
        let indices = filled(device, "projected grid", wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&list));
        let land = [("SURFACE_LAND", f64::from(u8::from(desc.land)))];
        let water = pipeline(device, desc, &view::WATER, &[&layout, surface_layout], &[], Blend::Over, &land);
        let sky = pipeline(device, desc, &view::SKY, &[&layout], &[], Blend::Behind, &[]);
        Ok(Self {
            desc: desc.clone(),
            output,
            layout,
            group,
            frame,
            foam: Some(foam),
            water,
            sky,
            indices,
            index_count: list.len() as u32,
            light: None,
            ready: false,
            water_in_view: false,
        })
    }

    /// The description it was made from.
    pub fn desc(&self) -> &ViewDesc {
        &self.desc
    }

    /// Writes the constants of the coming frame. A camera that is not finite or not perspective keeps the last frame's;
    /// before the first usable one nothing is drawn.
    pub fn prepare(&mut self, queue: &wgpu::Queue, params: &ViewParams) {
        if let Some(foam) = self.foam.take() {
            upload(queue, &foam);
        }
        let light = match self.light {
            Some((sky, light)) if sky == params.sky => light,
            _ => Light::of(&params.sky),
        };
        self.light = Some((params.sky, light));
        if let Some((frame, water_in_view)) = build(&self.desc, self.output, params, &light) {
            queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&frame));
            self.ready = true;
            self.water_in_view = water_in_view;
        }
    }

    /// Draws the sea, then the sky where nothing stands in front of it. Draw what is opaque first, the bed of a land too:
    /// shallow water lets it show through.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, surface: &wgpu::BindGroup) {
        self.draw_water(pass, surface);
        self.draw_sky(pass);
    }

    /// Draws the sea alone.
    pub fn draw_water(&self, pass: &mut wgpu::RenderPass<'_>, surface: &wgpu::BindGroup) {
        if !self.ready || !self.water_in_view {
            return;
        }
        pass.set_pipeline(&self.water);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_bind_group(view::SURFACE_GROUP, surface, &[]);
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }

    /// Draws the sky alone, at the far depth.
    pub fn draw_sky(&self, pass: &mut wgpu::RenderPass<'_>) {
        if !self.ready {
            return;
        }
        pass.set_pipeline(&self.sky);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }

    pub(crate) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// The view's bind group, once there is a frame to draw.
    pub(crate) fn group(&self) -> Option<&wgpu::BindGroup> {
        self.ready.then_some(&self.group)
    }
}

/// Fills the foam texture.
fn upload(queue: &wgpu::Queue, texture: &wgpu::Texture) {
    for (level, texels) in (0..).zip(foam::mips()) {
        let size = foam::SIZE >> level;
        queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: level,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            &texels,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(size), rows_per_image: None },
            wgpu::Extent3d { width: size, height: size, depth_or_array_layers: 1 },
        );
    }
}
