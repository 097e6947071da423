//! Text and lines over the picture: the frame's plan and timings, the forces on a boat.

use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};

use water_view::Camera;

use crate::strokes::{self, Stroke};
use crate::{Gpu, font};

/// Pixels per dot of a glyph.
const DOT: f32 = 2.0;
const MARGIN: f32 = 12.0;
const MAX_DOTS: usize = 16_384;

/// Draws text into the upper left corner.
pub(crate) struct Overlay {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    screen: wgpu::Buffer,
    dots: wgpu::Buffer,
    list: Vec<[f32; 8]>,
}

impl Overlay {
    pub(crate) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("overlay"),
            source: wgpu::ShaderSource::Wgsl(include_str!("overlay.wgsl").into()),
        });
        let layout = group_layout(device, "overlay", wgpu::ShaderStages::VERTEX, &[Slot::Uniform { size: 16 }]);
        let buffer = |size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("overlay"),
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let screen = buffer(16, wgpu::BufferUsages::UNIFORM);
        let dots = buffer((MAX_DOTS * size_of::<[f32; 8]>()) as u64, wgpu::BufferUsages::VERTEX);
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("overlay"),
            layout: Some(&pipeline_layout(device, "overlay", &[&layout])),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("overlay_vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: size_of::<[f32; 8]>() as u64,
                    step_mode: wgpu::VertexStepMode::Instance,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4],
                })],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("overlay_fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format,
                    blend: Some(wgpu::BlendState::ALPHA_BLENDING),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        let group = bind_group(device, "overlay", &layout, &[screen.as_entire_binding()]);
        Self { pipeline, group, screen, dots, list: Vec::new() }
    }

    /// Draws `text` over `target`, on a dark panel so that it reads on any water, and `strokes` as `camera` sees them.
    pub(crate) fn draw(
        &mut self,
        gpu: &Gpu,
        text: &str,
        (strokes, camera): (&[Stroke], &Camera),
        size: [u32; 2],
        target: &wgpu::TextureView,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        self.list.clear();
        let list = &mut self.list;
        strokes::dots(strokes, size, strokes::seen(camera, size), |at, color| {
            let [r, g, b] = color.map(|c| f32::from(c) / 255.0);
            list.push([at.x, at.y, strokes::DOT, strokes::DOT, r, g, b, 1.0]);
        });
        // Words stay whatever the lines need.
        list.truncate(MAX_DOTS / 2);
        if !text.is_empty() {
            let columns = text.lines().map(|line| line.chars().count()).max().unwrap_or(0) * font::ADVANCE;
            let rows = text.lines().count() * font::LINE;
            let panel = |dots: usize| DOT * dots as f32 + MARGIN;
            list.push([0.5 * MARGIN, 0.5 * MARGIN, panel(columns), panel(rows), 0.0, 0.0, 0.0, 0.55]);
            font::dots(text, |x, y| {
                let at = |v: usize| MARGIN + DOT * v as f32;
                list.push([at(x), at(y), DOT, DOT, 0.85, 0.85, 0.85, 1.0]);
            });
        }
        self.list.truncate(MAX_DOTS);
        let screen = [size[0] as f32, size[1] as f32, 0.0, 0.0];
        gpu.queue.write_buffer(&self.screen, 0, bytemuck::cast_slice(&screen));
        gpu.queue.write_buffer(&self.dots, 0, bytemuck::cast_slice(&self.list));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("overlay"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_vertex_buffer(0, self.dots.slice(..));
        pass.draw(0..4, 0..self.list.len() as u32);
    }
}
