//! Draws a scene's frame into a target by the renderer.

use glam::Vec3;
use open_water::{Consumers, FramePlan, View};
use water_view::{Camera, MeshView, ViewDesc, ViewParams, WaterView};

use crate::{Gpu, Options, Scene, SceneError};

/// Sea, sky and meshes on targets of one size.
pub(crate) struct Painter {
    view: WaterView,
    meshes: MeshView,
    depth: wgpu::TextureView,
    /// The multisampled colour, resolved into the target.
    color: Option<wgpu::TextureView>,
    size: [u32; 2],
}

fn texture(gpu: &Gpu, desc: &ViewDesc, format: wgpu::TextureFormat, size: [u32; 2]) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("target"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: desc.samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

impl Painter {
    pub(crate) fn new<S: Scene>(
        gpu: &Gpu,
        options: &Options,
        scene: &mut S,
        format: wgpu::TextureFormat,
        size: [u32; 2],
    ) -> Result<Self, SceneError> {
        let desc = ViewDesc {
            color_format: format,
            samples: options.samples(gpu.software),
            grid: options.view_grid(),
            land: scene.water().land().is_some(),
            ..ViewDesc::default()
        };
        let Some(layout) = scene.water().surface_layout() else {
            return Err(SceneError::Gpu("the water was made without a device".into()));
        };
        let view = WaterView::new(&gpu.device, &desc, layout)?;
        let mut meshes = MeshView::new(&gpu.device, &view);
        scene.build(&gpu.device, &mut meshes);
        let mut painter = Self { depth: texture(gpu, &desc, desc.depth_format, size), color: None, view, meshes, size };
        painter.resize(gpu, size);
        Ok(painter)
    }

    pub(crate) fn resize(&mut self, gpu: &Gpu, size: [u32; 2]) {
        let desc = self.view.desc();
        self.depth = texture(gpu, desc, desc.depth_format, size);
        self.color = (desc.samples > 1).then(|| texture(gpu, desc, desc.color_format, size));
        self.size = size;
    }

    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Plans and records a frame of the scene, seen by `camera`.
    pub(crate) fn record<S: Scene>(
        &mut self,
        gpu: &Gpu,
        scene: &mut S,
        camera: &Camera,
        target: &wgpu::TextureView,
        encoder: &mut wgpu::CommandEncoder,
    ) -> FramePlan {
        let eye = View { eye: camera.position, pixel_angle: camera.fov_y / self.size[1] as f32 };
        let plan = scene.water().plan(&[eye], Consumers::NORMALS | Consumers::FOAM);
        scene.water_mut().encode(&plan, encoder);
        let mut params = ViewParams::new(camera.view(self.view.desc().reverse_z));
        params.sky.sun_direction = Vec3::new(-0.75, 0.55, -0.6);
        params.wave_height = scene.water().ocean().map_or(0.0, |ocean| ocean.significant_height());
        params.level = scene.water().level();
        params.water = scene.look();
        self.view.prepare(&gpu.queue, &params);
        scene.place(&gpu.queue, &mut self.meshes);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: self.color.as_ref().unwrap_or(target),
                depth_slice: None,
                resolve_target: self.color.is_some().then_some(target),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
        self.meshes.draw(&mut pass, &self.view);
        if let Some(surface) = scene.water().surface_bind_group() {
            self.view.draw(&mut pass, surface);
        }
        drop(pass);
        plan
    }
}
