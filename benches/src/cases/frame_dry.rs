//! Case `dry_hulls`: what keeping hulls dry costs a pass that shades the water.

use floating_body::{BodyDesc, BodyState};
use glam::Vec3;
use open_water::{BodyStates, OpenWater, OpenWaterDesc};
use open_water_shaders::{pipeline::pipeline_layout, surface};

use super::facade::draw;
use crate::evidence::{Case, CaseError, Context, Gpu, Row, fastest, measure};
use crate::fixtures::{FRAME, boat_hull};

/// See the module.
pub(super) const DRY: Case = Case {
    name: "dry_hulls",
    about: "shading 640 x 360 pixels of water without the test for dry hulls, and with none, one and sixteen in the picture",
    plots: &[],
    run,
};

/// A pixel is 10 cm of water.
const SHADER: &str = "
override DRY: bool = true;
@vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.5, 1.0);
}
@fragment fn fs(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let rest = 0.1 * (at.xy - vec2<f32>(320.0, 180.0));
    let look = surface_shading(rest, 0.1);
    if DRY && surface_is_dry(vec3<f32>(rest.x, 0.0, rest.y)) {
        discard;
    }
    return vec4<f32>(look.normal, look.foam);
}";

/// A sea with so many boats in the picture.
fn water(gpu: &Gpu, boats: u16) -> Result<OpenWater, CaseError> {
    let mut water = OpenWater::new(&gpu.device, &gpu.queue, OpenWaterDesc::default())?;
    let mut bodies = BodyStates::default();
    let hull = boat_hull()?;
    let room = hull.dry(0.0, 0.0)?;
    for k in 0..boats {
        let boat = water.add_body(BodyDesc::boat(&hull, 1500.0, 8.0))?;
        let [column, row] = [k % 4, k / 4].map(f32::from);
        bodies.insert(boat, BodyState::at_rest(Vec3::new(15.0 * column - 22.0, 0.0, 9.0 * row - 13.0)));
        water.set_dry(boat, Some(room.clone()))?;
    }
    for tick in water.advance(FRAME) {
        water.tick(tick, &mut bodies)?;
    }
    draw(gpu, &mut water)?;
    Ok(water)
}

fn pipeline(gpu: &Gpu, layout: &wgpu::BindGroupLayout, dry: bool) -> wgpu::RenderPipeline {
    let device = &gpu.device;
    let source = wgpu::ShaderSource::Wgsl((surface::wgsl(0) + SHADER).into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let constants = [("DRY", f64::from(u8::from(dry)))];
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&pipeline_layout(device, "dry_hulls", &[layout])),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: options.clone(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: options,
            targets: &[Some(wgpu::TextureFormat::Rgba8Unorm.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let waters = [water(gpu, 0)?, water(gpu, 0)?, water(gpu, 1)?, water(gpu, 16)?];
    let layout = waters[0].surface_layout().ok_or("no layout of the surface")?;
    let [without, with] = [false, true].map(|dry| pipeline(gpu, layout, dry));
    let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: 640, height: 360, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let target = target.create_view(&Default::default());
    let shade = |pipeline: &wgpu::RenderPipeline, water: &OpenWater| {
        let _ = gpu.run(|encoder| {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, water.surface_bind_group(), &[]);
            pass.draw(0..3, 0..1);
        });
    };
    let times = fastest(
        context.effort,
        [
            &mut || shade(&without, &waters[0]),
            &mut || shade(&with, &waters[1]),
            &mut || shade(&with, &waters[2]),
            &mut || shade(&with, &waters[3]),
        ],
    );
    let hull = boat_hull()?;
    let made = measure(context.effort, || {
        let _ = std::hint::black_box(hull.dry(0.0, 0.0));
    });
    let mut rows: Vec<Row> = ["without the test", "no hull", "1 hull", "16 hulls"]
        .iter()
        .zip(&times)
        .map(|(name, time)| {
            let share = time.median_ns / times[0].median_ns;
            let row = Row::new("dry_hulls", *name).param("of_without", (share * 1e3).round() / 1e3);
            row.time("640 x 360 pixels, submit and wait", time)
        })
        .collect();
    rows.push(Row::new("dry_hulls", "raster").param("raster_KiB", 48).time("made of a hull, once", &made));
    Ok(rows)
}
