//! The text and the bind group that a game's own shaders use: in every stage, at any index, in several views.

use glam::{Mat4, Vec2, Vec3, Vec4};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use open_water::{Consumers, Preset, WaterSample};
use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};
use open_water_shaders::surface;
use wgpu::util::{DeviceExt, TextureDataOrder};

use super::{DT, scene, view};
use crate::context::Context;

const PLANE: &str = include_str!("../../../../shaders/docs/plane.wgsl");
const GUIDE: &str = include_str!("../../../../shaders/docs/surface.md");

/// Calls everything that the guide tells of.
const ALL: &str = "
fn all_of_it(point: vec3<f32>) -> f32 {
    let vertex: vec3<f32> = surface_vertex(point.xz, 0.5);
    let look: SurfaceLook = surface_shading(vertex.xz, 0.5);
    let at: SurfacePoint = surface_at(vertex.xz);
    let grids: vec4<f32> = grids_at(at.rest);
    let land: f32 = bed_at(point.xz) + water_depth(point.xz) + water_open(point.xz) + wall_nearness(point.xz);
    let table: f32 = surface_table.time + surface_table.significant_height + surface_table.land.level;
    let dry: bool = surface_is_dry(point);
    return look.normal.y + look.roughness + look.foam + at.height + at.normal.y + grids.x + land + table + f32(dry);
}
@vertex fn vs(@location(0) point: vec3<f32>) -> @builtin(position) vec4<f32> { return vec4<f32>(all_of_it(point)); }
@fragment fn fs(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> { return vec4<f32>(all_of_it(at.xyz)); }
@compute @workgroup_size(1) fn cs(@builtin(global_invocation_id) id: vec3<u32>) { _ = all_of_it(vec3<f32>(id)); }";

fn checked(source: &str) -> naga::Module {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module).unwrap();
    module
}

#[test]
fn the_text_is_good_in_every_stage_and_at_every_index() {
    for group in 0..4 {
        let module = checked(&(surface::wgsl(group) + ALL));
        assert_eq!(module.entry_points.len(), 3);
        let mut bindings: Vec<_> = module.global_variables.iter().filter_map(|(_, v)| v.binding).collect();
        bindings.sort_unstable_by_key(|b| b.binding);
        let found: Vec<_> = bindings.iter().map(|b| (b.group, b.binding)).collect();
        assert_eq!(found, (0..8).map(|binding| (group, binding)).collect::<Vec<_>>());
    }
    checked(&(surface::wgsl(1) + PLANE));
}

#[test]
fn the_guide_names_functions_as_they_are() {
    let text = surface::wgsl(0);
    let listed: Vec<&str> = GUIDE.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next()).collect();
    let functions: Vec<&&str> = listed.iter().filter(|name| name.contains('(')).collect();
    assert!(functions.len() >= 9, "{listed:?}");
    for function in functions {
        assert!(text.contains(&format!("fn {function} {{")), "{function}");
    }
}

/// A plane of vertices `spacing` m apart around a place, in two pictures of (x, y, z, `surface_at`): from above and from below.
fn pictures(context: &Context, water: &open_water::OpenWater, middle: Vec2, spacing: f32) -> [Vec<[f32; 4]>; 2] {
    const SIDE: u32 = 160;
    const PIXELS: u32 = 96;
    let device = &context.device;
    let row = SIDE + 1;
    let rest = |k: u32| middle + spacing * (Vec2::new((k % row) as f32, (k / row) as f32) - 0.5 * SIDE as f32);
    let vertices: Vec<Vec2> = (0..row * row).map(rest).collect();
    let indices: Vec<u32> = (0..SIDE * SIDE)
        .flat_map(|k| {
            let a = k / SIDE * row + k % SIDE;
            [a, a + row, a + 1, a + 1, a + row, a + row + 1]
        })
        .collect();
    let buffer = |contents: &[u8], usage| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let vertices = buffer(bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX);
    let indices = buffer(bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX);
    let texture = |side, format, usage| wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    };
    let tile = texture(1, wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureUsages::TEXTURE_BINDING);
    let tile = device.create_texture_with_data(&context.queue, &tile, TextureDataOrder::LayerMajor, &[90, 60, 30, 255]);
    let tile = tile.create_view(&Default::default());
    let sampler = device.create_sampler(&Default::default());
    let slots = [Slot::Uniform { size: 80 }, Slot::Texture { filterable: true }, Slot::Sampler];
    let own_layout = group_layout(device, "own", wgpu::ShaderStages::VERTEX_FRAGMENT, &slots);
    let layout = pipeline_layout(device, "plane", &[&own_layout, water.surface_layout().unwrap()]);
    let answer = "
        @fragment fn answer(in: Vertex) -> @location(0) vec4<f32> {
            return vec4<f32>(in.world, surface_at(in.world.xz).height);
        }";
    let source = wgpu::ShaderSource::Wgsl((surface::wgsl(1) + PLANE + answer).into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let formats = [wgpu::TextureFormat::Rgba32Float, wgpu::TextureFormat::Rgba8Unorm];
    let pipelines = [0, 1].map(|k| {
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 8,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x2],
                })],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(["answer", "plane_fragment"][k]),
                compilation_options: Default::default(),
                targets: &[Some(formats[k].into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    });
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    let reach = 0.35 * SIDE as f32 * spacing;
    let views = [1.0f32, -1.0].map(|side| {
        let scale = Vec3::new(side / reach, 0.01 * side, 1.0 / reach);
        // x to the right, z up; y into the depth, 0.5 at 0.
        let clip =
            Mat4::from_cols(scale.x * Vec4::X, scale.y * Vec4::Z, scale.z * Vec4::Y, Vec4::new(0.0, 0.0, 0.5, 1.0))
                * Mat4::from_translation(-Vec3::new(middle.x, 0.0, middle.y));
        let mut camera = clip.to_cols_array().to_vec();
        camera.extend(Vec3::new(middle.x, 50.0 * side, middle.y).extend(spacing).to_array());
        let camera = buffer(bytemuck::cast_slice(&camera), wgpu::BufferUsages::UNIFORM);
        let resources = [wgpu::BindingResource::TextureView(&tile), wgpu::BindingResource::Sampler(&sampler)];
        bind_group(device, "own", &own_layout, &[&[camera.as_entire_binding()], &resources[..]].concat())
    });
    let targets = [0, 1].map(|_| formats.map(|format| device.create_texture(&texture(PIXELS, format, usage))));
    context.submit(|encoder| {
        for (own, targets) in views.iter().zip(&targets) {
            for (pipeline, target) in pipelines.iter().zip(targets) {
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &target.create_view(&Default::default()),
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    ..Default::default()
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, own, &[]);
                pass.set_bind_group(1, water.surface_bind_group(), &[]);
                pass.set_vertex_buffer(0, vertices.slice(..));
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..6 * SIDE * SIDE, 0, 0..1);
            }
        }
    });
    for targets in &targets {
        let colors: Vec<[u8; 4]> = context.read_texture(&targets[1], 0);
        let reds = colors.iter().map(|c| c[0]);
        assert!(colors.iter().all(|c| c[3] == 255) && reds.clone().max() > reds.min(), "the plane is not drawn");
    }
    targets.map(|targets| context.read_texture(&targets[0], 0))
}

#[test]
fn a_plane_drawn_by_a_games_own_shader_lies_in_the_water() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    for _ in 0..90 {
        scene.frame(None, DT, Consumers::NORMALS);
    }
    let mut plan = scene.water.plan(&view(), Consumers::NORMALS | Consumers::FOAM);
    (plan.time, plan.alpha) = (scene.water.time(), 1.0);
    context.submit(|encoder| scene.water.encode(&plan, encoder));
    let at = scene.store.get(scene.boat).unwrap().position;
    let height = scene.water.ocean().unwrap().significant_height();
    for picture in pictures(&context, &scene.water, Vec2::new(at.x, at.z), 0.2) {
        let points: Vec<Vec2> = picture.iter().map(|p| Vec2::new(p[0], p[2])).collect();
        let mut expected = vec![WaterSample::default(); points.len()];
        scene.water.sample(&points, &mut expected);
        let (mut exact, mut drawn) = (0.0f32, 0.0f64);
        for (p, e) in picture.iter().zip(&expected) {
            exact = exact.max((p[3] - e.height).abs());
            drawn += f64::from(p[1] - e.height).powi(2);
        }
        let drawn = (drawn / points.len() as f64).sqrt() as f32;
        println!("largest error of surface_at {exact} m, rms of the drawn plane {drawn} m, waves {height} m");
        assert!(exact < 2e-3 * height && drawn < 0.02 * height, "{exact} and {drawn} m of {height} m");
    }
    assert!(context.take_errors().is_empty());
}
