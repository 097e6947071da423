//! A textured plane moved by the water: the game's own mesh, texture, pipeline and shader (`shaders/docs/plane.wgsl`), and the
//! water's bind group next to its own. Writes the picture `plane.png`; `--frames N` runs N frames before it, `--out FILE`
//! names it.

use std::error::Error;

use glam::{Mat4, Vec2, Vec3, camera::rh::proj::directx::perspective_infinite_reverse};
use image::{Rgba, RgbaImage, imageops};
use open_water::{BodyStates, Consumers, OpenWater, OpenWaterDesc, View};
use open_water_examples::{Backend, Capture, Pick};
use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};
use open_water_shaders::surface;
use wgpu::util::{DeviceExt, TextureDataOrder};

const SIZE: [u32; 2] = [1280, 720];
/// Cells of the plane along each side, and their size, metres.
const CELLS: u32 = 256;
const CELL: f32 = 0.25;

/// Tiles of two colours with joints, and all smaller mips.
fn tiles() -> (u32, Vec<u8>) {
    let tile = RgbaImage::from_fn(256, 256, |x, y| match (x % 64 < 3 || y % 64 < 3, (x / 64 + y / 64) % 2) {
        (true, _) => Rgba([225, 225, 215, 255]),
        (_, 0) => Rgba([20, 110, 150, 255]),
        _ => Rgba([45, 160, 175, 255]),
    });
    let mips = (0..9).map(|level| imageops::thumbnail(&tile, 256 >> level, 256 >> level).into_raw());
    (9, mips.collect::<Vec<_>>().concat())
}

/// Vertices at rest (x, z), and two triangles a cell.
fn mesh() -> (Vec<[f32; 2]>, Vec<u32>) {
    let row = CELLS + 1;
    let place = |k: u32| (Vec2::new((k % row) as f32, (k / row) as f32) - 0.5 * CELLS as f32) * CELL;
    let cell = |k: u32| {
        let a = k / CELLS * row + k % CELLS;
        [a, a + row, a + 1, a + 1, a + row, a + row + 1]
    };
    ((0..row * row).map(|k| place(k).into()).collect(), (0..CELLS * CELLS).flat_map(cell).collect())
}

fn main() -> Result<(), Box<dyn Error>> {
    let after = |name: &str| std::env::args().skip_while(|arg| arg != name).nth(1);
    let frames = after("--frames").map_or(Ok(120), |n| n.parse::<u32>())?;
    let Pick::Gpu(gpu) = Pick::choose(Backend::Gpu, &wgpu::Instance::default(), None)? else { return Ok(()) };
    let (device, queue) = (&gpu.device, &gpu.queue);
    let mut water = OpenWater::new(device, queue, OpenWaterDesc::default())?;

    // The game's own: mesh, texture, camera.
    let (vertices, indices) = mesh();
    let buffer = |contents: &[u8], usage| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let vertices = buffer(bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX);
    let index_count = indices.len() as u32;
    let indices = buffer(bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX);
    let texture = |size: [u32; 2], mip_level_count, format, usage| wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    };
    let (mips, texels) = tiles();
    let desc = texture([256; 2], mips, wgpu::TextureFormat::Rgba8UnormSrgb, wgpu::TextureUsages::TEXTURE_BINDING);
    let tiles = device.create_texture_with_data(queue, &desc, TextureDataOrder::LayerMajor, &texels);
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        anisotropy_clamp: 8,
        ..Default::default()
    });
    let eye = Vec3::new(0.0, 12.0, 40.0);
    let look = glam::camera::rh::view::look_at_mat4(eye, Vec3::new(0.0, -2.0, 4.0), Vec3::Y);
    let clip_from_world: Mat4 = perspective_infinite_reverse(0.8, SIZE[0] as f32 / SIZE[1] as f32, 0.1) * look;
    let mut camera = clip_from_world.to_cols_array().to_vec();
    camera.extend(eye.extend(CELL).to_array());
    let camera = buffer(bytemuck::cast_slice(&camera), wgpu::BufferUsages::UNIFORM);
    let slots = [Slot::Uniform { size: 80 }, Slot::Texture { filterable: true }, Slot::Sampler];
    let own_layout = group_layout(device, "plane", wgpu::ShaderStages::VERTEX_FRAGMENT, &slots);
    let view = tiles.create_view(&Default::default());
    let resources = [wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&sampler)];
    let own = bind_group(device, "plane", &own_layout, &[&[camera.as_entire_binding()], &resources[..]].concat());

    // Its pipeline: the water's text in front of its own, the water's layout as group 1.
    let text = surface::wgsl(1) + include_str!("../shaders/docs/plane.wgsl");
    let source = wgpu::ShaderSource::Wgsl(text.into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("plane"), source });
    let surface_layout = water.surface_layout().ok_or("no device")?;
    let layout = pipeline_layout(device, "plane", &[&own_layout, surface_layout]);
    let attributes = &wgpu::vertex_attr_array![0 => Float32x2];
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("plane"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes,
            })],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            targets: &[Some(Capture::FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let capture = Capture::new(&gpu, SIZE);
    let format = wgpu::TextureFormat::Depth32Float;
    let depth = device.create_texture(&texture(SIZE, 1, format, wgpu::TextureUsages::RENDER_ATTACHMENT));
    let depth = depth.create_view(&Default::default());

    // Frames: ticks, plan, the water's commands, then the game's own pass.
    let mut picture = None;
    for _ in 0..frames {
        for tick in water.advance(1.0 / 60.0) {
            water.tick(tick, &mut BodyStates::default())?;
        }
        let plan = water.plan(&[View { eye, pixel_angle: 1e-3 }], Consumers::NORMALS | Consumers::FOAM);
        let mut encoder = device.create_command_encoder(&Default::default());
        water.encode(&plan, &mut encoder);
        let clear = wgpu::LoadOp::Clear(wgpu::Color { r: 0.72, g: 0.8, b: 0.86, a: 1.0 });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: capture.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: clear, store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &own, &[]);
        pass.set_bind_group(1, water.surface_bind_group(), &[]);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..index_count, 0, 0..1);
        drop(pass);
        picture = Some(capture.take(&gpu, encoder)?);
    }
    let file = after("--out").unwrap_or_else(|| "plane.png".into());
    picture.ok_or("no frames")?.save(&file)?;
    eprintln!("{file}: {frames} frames");
    Ok(())
}
