//! The smallest complete winit + wgpu program of one's own that draws the sea with its own shader: device, pass and shader
//! are yours, the water comes through `surface_bind_group()` and the WGSL include. Without a display it draws `--frames N`.

use open_water::{BodyStates, Consumers, OpenWater, OpenWaterDesc, View};
use open_water_shaders::{pipeline, surface};
use std::error::Error;
use std::sync::Arc;
use wgpu::VertexState;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::window::{Window, WindowId};
use winit::{application::ApplicationHandler, event::WindowEvent};

/// 255 x 255 cells of a metre, moved by the water, lit by its normal; drawn from far to near instead of a depth buffer.
const SHADER: &str = "
struct Out { @builtin(position) clip: vec4<f32>, @location(0) rest: vec2<f32> }
@vertex fn vs(@builtin(vertex_index) i: u32, @builtin(instance_index) row: u32) -> Out {
    let rest = vec2<f32>(f32(i / 2u) - 127.5, f32(255u - row - (i & 1u)));
    let p = surface_vertex(rest, 1.0) - vec3<f32>(0.0, 8.0, -4.0); // the eye is 8 m up and looks along +z
    return Out(vec4<f32>(1.2 * p.x, 2.0 * p.y + 0.6 * p.z, 0.1, max(p.z, 0.1)), rest);
}
@fragment fn fs(in: Out) -> @location(0) vec4<f32> {
    let look = surface_shading(in.rest, max(length(dpdx(in.rest)), length(dpdy(in.rest))));
    let sky = vec3<f32>(0.6, 0.75, 0.85);
    let facing = dot(look.normal, normalize(vec3<f32>(-in.rest.x, 8.0, -4.0 - in.rest.y)));
    let water = mix(vec3<f32>(0.01, 0.07, 0.1), sky, pow(1.0 - clamp(facing, 0.0, 1.0), 5.0)) + 0.4 * look.foam;
    return vec4<f32>(mix(water, sky, in.rest.y / 255.0), 1.0);
}";

struct Sea {
    device: wgpu::Device,
    queue: wgpu::Queue,
    water: OpenWater,
    pipeline: wgpu::RenderPipeline,
}

impl Sea {
    fn new(adapter: &wgpu::Adapter, format: wgpu::TextureFormat) -> Result<Self, Box<dyn Error>> {
        let desc = wgpu::DeviceDescriptor { required_limits: OpenWater::required_limits(), ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&desc))?;
        let water = OpenWater::new(&device, &queue, OpenWaterDesc::default())?;
        let source = wgpu::ShaderSource::Wgsl((surface::wgsl(0) + SHADER).into()); // the water is bind group 0
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("sea"), source });
        let layout = pipeline::pipeline_layout(&device, "sea", &[water.surface_layout().ok_or("no device")?]);
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("sea"),
            layout: Some(&layout),
            vertex: VertexState {
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(Self { device, queue, water, pipeline })
    }

    fn draw(&mut self, dt: f32, target: &wgpu::Texture) {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut BodyStates::default()).expect("ticks come in order");
        }
        let plan = self.water.plan(&[View { eye: glam::Vec3::Y * 8.0, pixel_angle: 1e-3 }], Consumers::all());
        let mut encoder = self.device.create_command_encoder(&Default::default());
        self.water.encode(&plan, &mut encoder);
        let load = wgpu::LoadOp::Clear(wgpu::Color { r: 0.6, g: 0.75, b: 0.85, a: 1.0 });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.create_view(&Default::default()),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, self.water.surface_bind_group(), &[]);
        pass.draw(0..512, 0..255);
        drop(pass);
        self.queue.submit([encoder.finish()]);
    }
}

/// The window and what draws into it, once there are both.
struct App(Option<(Arc<Window>, wgpu::Surface<'static>, Sea)>);

fn open(event_loop: &ActiveEventLoop) -> Result<(Arc<Window>, wgpu::Surface<'static>, Sea), Box<dyn Error>> {
    let window = Arc::new(event_loop.create_window(Window::default_attributes().with_resizable(false))?);
    let display = Box::new(event_loop.owned_display_handle());
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle(display));
    let surface = instance.create_surface(window.clone())?;
    let options = wgpu::RequestAdapterOptions { compatible_surface: Some(&surface), ..Default::default() };
    let adapter = pollster::block_on(instance.request_adapter(&options))?;
    let size = window.inner_size();
    let config = surface.get_default_config(&adapter, size.width, size.height).ok_or("no format")?;
    let sea = Sea::new(&adapter, config.format)?;
    surface.configure(&sea.device, &config);
    window.request_redraw();
    Ok((window, surface, sea))
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        self.0 = open(event_loop).inspect_err(|error| eprintln!("{error}")).ok();
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        use wgpu::CurrentSurfaceTexture::{Suboptimal, Success};
        let Some((window, surface, sea)) = &mut self.0 else { return event_loop.exit() };
        if event == WindowEvent::CloseRequested {
            event_loop.exit();
        } else if event == WindowEvent::RedrawRequested {
            if let Success(picture) | Suboptimal(picture) = surface.get_current_texture() {
                sea.draw(1.0 / 60.0, &picture.texture);
                sea.queue.present(picture);
            }
            window.request_redraw();
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let Err(why) = EventLoop::new().map(|events| events.run_app(&mut App(None))) else { return Ok(()) };
    let frames = std::env::args().skip_while(|arg| arg != "--frames").nth(1).map_or(Ok(3), |n| n.parse::<u32>())?;
    eprintln!("{why}: drawing {frames} frames into a texture");
    let adapter = pollster::block_on(wgpu::Instance::default().request_adapter(&Default::default()))?;
    let mut sea = Sea::new(&adapter, wgpu::TextureFormat::Rgba8UnormSrgb)?;
    let picture = sea.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: 1280, height: 720, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    (0..frames).for_each(|_| sea.draw(1.0 / 60.0, &picture));
    Ok(sea.device.poll(wgpu::PollType::wait_indefinitely()).map(drop)?)
}
