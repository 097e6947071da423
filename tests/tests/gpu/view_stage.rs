//! A stage for the renderer: the composite's bind group filled from arrays, and a target to draw it into.

use glam::{Mat4, Vec3};
use open_water_shaders::pipeline::bind_group;
use open_water_shaders::surface::{self, SurfaceCascade, SurfaceGrid, SurfaceTable};
use water_view::{Camera, ViewDesc, ViewParams, WaterView};

use crate::context::Context;
use crate::view_land::Ground;

/// Texels of one cascade: (Dx, h, Dz, foam) and (dh/dx, dh/dz, dDx/dx, dDz/dz).
pub(crate) struct Cascade {
    pub(crate) tile: f32,
    pub(crate) displacement: Vec<[f32; 4]>,
    pub(crate) derivative: Vec<[f32; 4]>,
}

/// A sea as arrays.
#[derive(Default)]
pub(crate) struct Sea {
    pub(crate) size: u32,
    pub(crate) cascades: Vec<Cascade>,
    pub(crate) grids: Vec<(SurfaceGrid, Vec<[f32; 2]>)>,
    pub(crate) hidden_slope: [f32; 16],
    pub(crate) wave_height: f32,
    /// Bed, open water and walls, where there is land.
    pub(crate) land: Option<Ground>,
    /// Level of still water, metres.
    pub(crate) level: f32,
}

impl Sea {
    /// No waves at all.
    pub(crate) fn flat() -> Self {
        let texels = vec![[0.0; 4]; 64];
        let cascade = Cascade { tile: 50.0, displacement: texels.clone(), derivative: texels };
        Self { size: 8, cascades: vec![cascade], ..Self::default() }
    }

    /// Sharp-crested waves on two tiles, periods of a few metres to sixty; `steepness` about .1 for a moderate sea.
    pub(crate) fn waves(steepness: f32) -> Self {
        let size = 128u32;
        let mut variance = 0.0;
        let cascades: Vec<_> = [(240.0f32, 4.0f32, 11.0f32), (31.0, 3.0, 20.0)]
            .iter()
            .enumerate()
            .map(|(layer, &(tile, low, high))| {
                let mut cascade = Cascade {
                    tile,
                    displacement: vec![[0.0; 4]; (size * size) as usize],
                    derivative: vec![[0.0; 4]; (size * size) as usize],
                };
                for mode in 0..10 {
                    // Whole waves per tile, spread about +x; phases by the golden ratio.
                    let m = (low * (high / low).powf(mode as f32 / 9.0)).round();
                    let n = (m * 0.6 * ((mode * 7 + layer * 3) % 10) as f32 / 9.0 - 0.3 * m).round();
                    let k = std::f32::consts::TAU / tile * glam::Vec2::new(m, n);
                    let a = 0.32 * steepness / k.length();
                    variance += 0.5 * a * a;
                    let phase = std::f32::consts::TAU * (0.618 * (mode + 10 * layer) as f32).fract();
                    for (t, (d, s)) in cascade.displacement.iter_mut().zip(&mut cascade.derivative).enumerate() {
                        let at =
                            glam::Vec2::new((t as u32 % size) as f32, (t as u32 / size) as f32) * (tile / size as f32);
                        let (sin, cos) = (k.dot(at) + phase).sin_cos();
                        let hat = k.normalize();
                        *d = [d[0] - a * hat.x * sin, d[1] + a * cos, d[2] - a * hat.y * sin, 0.0];
                        *s = [
                            s[0] - a * k.x * sin,
                            s[1] - a * k.y * sin,
                            s[2] - a * k.x * hat.x * cos,
                            s[3] - a * k.y * hat.y * cos,
                        ];
                    }
                }
                cascade
            })
            .collect();
        Self {
            size,
            cascades,
            hidden_slope: std::array::from_fn(|i| 0.02 * (i as f32 / 15.0).min(1.0) + 0.003),
            wave_height: 4.0 * variance.sqrt(),
            ..Self::default()
        }
    }
}

/// Bits of the half-float nearest to `x` towards zero; what a texture wants. Small numbers flush to zero.
fn half(x: f32) -> u16 {
    let bits = x.to_bits();
    let sign = (bits >> 16) as u16 & 0x8000;
    let exponent = (bits >> 23 & 0xff) as i32 - 112;
    match exponent {
        ..=0 => sign,
        31.. => sign | 0x7bff,
        e => sign | (e as u16) << 10 | (bits >> 13 & 0x3ff) as u16,
    }
}

/// The composite's bind group, filled.
pub(crate) struct Stage {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
}

impl Stage {
    pub(crate) fn new(context: &Context, sea: &Sea) -> Self {
        let device = &context.device;
        let layout = surface::layout(device);
        let mut table = SurfaceTable {
            cascade_count: sea.cascades.len() as u32,
            grid_count: sea.grids.len() as u32,
            significant_height: sea.wave_height,
            hidden_slope: sea.hidden_slope,
            land: sea.land.as_ref().map_or(Default::default(), Ground::entry),
            ..SurfaceTable::default()
        };
        table.land.level = sea.level;
        for (slot, cascade) in table.cascades.iter_mut().zip(&sea.cascades) {
            *slot = SurfaceCascade { tile: cascade.tile, size: sea.size as f32, ..SurfaceCascade::default() };
        }
        let mut pool = Vec::new();
        for (slot, (grid, cells)) in table.grids.iter_mut().zip(&sea.grids) {
            *slot = SurfaceGrid { base: pool.len() as u32, ..*grid };
            pool.extend_from_slice(cells);
        }
        pool.resize(pool.len().max(2), [0.0; 2]);
        let table = context.buffer(&[table]);
        let pool = context.buffer(&pool);
        let full = |pick: fn(&Cascade) -> &[[f32; 4]]| texture(context, sea, pick, false);
        let looks = |pick: fn(&Cascade) -> &[[f32; 4]]| texture(context, sea, pick, true);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let views =
            [full(|c| &c.displacement), full(|c| &c.derivative), looks(|c| &c.displacement), looks(|c| &c.derivative)];
        let ground = sea.land.as_ref().map(|land| land.texture(context));
        let group = bind_group(
            device,
            "stage",
            &layout,
            &[
                table.as_entire_binding(),
                wgpu::BindingResource::TextureView(&views[0]),
                wgpu::BindingResource::TextureView(&views[1]),
                pool.as_entire_binding(),
                wgpu::BindingResource::TextureView(&views[2]),
                wgpu::BindingResource::TextureView(&views[3]),
                wgpu::BindingResource::Sampler(&sampler),
                // Without land any view will do.
                wgpu::BindingResource::TextureView(ground.as_ref().unwrap_or(&views[0])),
            ],
        );
        Self { layout, group }
    }
}

fn texture(context: &Context, sea: &Sea, pick: fn(&Cascade) -> &[[f32; 4]], looks: bool) -> wgpu::TextureView {
    let texture = context.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("stage"),
        size: wgpu::Extent3d { width: sea.size, height: sea.size, depth_or_array_layers: sea.cascades.len() as u32 },
        mip_level_count: if looks { sea.size.ilog2() + 1 } else { 1 },
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: if looks { wgpu::TextureFormat::Rgba16Float } else { wgpu::TextureFormat::Rgba32Float },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (layer, cascade) in (0..).zip(&sea.cascades) {
        let mut texels = pick(cascade).to_vec();
        for level in 0..texture.mip_level_count() {
            let n = sea.size >> level;
            let write = |bytes: &[u8]| {
                context.queue.write_texture(
                    wgpu::TexelCopyTextureInfo {
                        texture: &texture,
                        mip_level: level,
                        origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
                        aspect: wgpu::TextureAspect::All,
                    },
                    bytes,
                    wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(bytes.len() as u32 / n),
                        rows_per_image: Some(n),
                    },
                    wgpu::Extent3d { width: n, height: n, depth_or_array_layers: 1 },
                );
            };
            if looks {
                let halves: Vec<_> = texels.iter().map(|t| t.map(half)).collect();
                write(bytemuck::cast_slice(&halves));
            } else {
                write(bytemuck::cast_slice(&texels));
            }
            let (m, n) = ((n / 2) as usize, n as usize);
            texels = (0..m * m)
                .map(|k| {
                    let at = 2 * (k % m) + 2 * (k / m) * n;
                    let quad = [at, at + 1, at + n, at + n + 1].map(|i| texels[i]);
                    std::array::from_fn(|c| 0.25 * quad.iter().map(|t| t[c]).sum::<f32>())
                })
                .collect();
        }
    }
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// Colour and depth of a frame. Where neither sea nor sky was drawn the colour is magenta, alpha 0.
pub(crate) struct Picture {
    pub(crate) size: [u32; 2],
    pub(crate) color: Vec<[u8; 4]>,
    /// Empty when multisampled.
    pub(crate) depth: Vec<f32>,
}

impl Picture {
    pub(crate) fn at(&self, x: u32, y: u32) -> [u8; 4] {
        self.color[(y * self.size[0] + x) as usize]
    }
}

/// What to draw besides the sea.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Draw {
    All,
    WaterOnly,
}

/// Draws one frame of a new view.
pub(crate) fn render(
    context: &Context,
    stage: &Stage,
    desc: &ViewDesc,
    params: &ViewParams,
    size: [u32; 2],
    draw: Draw,
) -> Picture {
    let mut view = WaterView::new(&context.device, desc, &stage.layout).expect("a valid description");
    frame(context, stage, &mut view, params, size, draw)
}

/// Draws one frame.
pub(crate) fn frame(
    context: &Context,
    stage: &Stage,
    view: &mut WaterView,
    params: &ViewParams,
    size: [u32; 2],
    draw: Draw,
) -> Picture {
    frame_with(context, view, params, size, |pass, view| match draw {
        Draw::All => view.draw(pass, &stage.group),
        Draw::WaterOnly => view.draw_water(pass, &stage.group),
    })
}

/// Draws one frame by `draw`.
pub(crate) fn frame_with(
    context: &Context,
    view: &mut WaterView,
    params: &ViewParams,
    size: [u32; 2],
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>, &WaterView),
) -> Picture {
    let desc = view.desc().clone();
    let texture = |format, samples| {
        context.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("target"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: if samples == 1 {
                wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC
            } else {
                wgpu::TextureUsages::RENDER_ATTACHMENT
            },
            view_formats: &[],
        })
    };
    let view_of = |t: &wgpu::Texture| t.create_view(&wgpu::TextureViewDescriptor::default());
    let color = texture(desc.color_format, 1);
    let depth = texture(desc.depth_format, desc.samples);
    let many = (desc.samples > 1).then(|| view_of(&texture(desc.color_format, desc.samples)));
    let (color_view, depth_view) = (view_of(&color), view_of(&depth));
    view.prepare(&context.queue, params);
    context.submit(|encoder| {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: many.as_ref().unwrap_or(&color_view),
                depth_slice: None,
                resolve_target: many.is_some().then_some(&color_view),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r: 1.0, g: 0.0, b: 1.0, a: 0.0 }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(if desc.reverse_z { 0.0 } else { 1.0 }),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        draw(&mut pass, view);
    });
    Picture {
        size,
        color: context.read_texture(&color, 0),
        depth: if desc.samples == 1 { context.read_texture(&depth, 0) } else { Vec::new() },
    }
}

/// A camera at `eye` that looks along `yaw` (from +x towards +z), `pitch` up, 16:9.
pub(crate) fn camera(eye: Vec3, yaw: f32, pitch: f32) -> Camera {
    let dir = Vec3::new(pitch.cos() * yaw.cos(), pitch.sin(), pitch.cos() * yaw.sin());
    Camera { aspect: 16.0 / 9.0, ..Camera::default() }.look_at(eye, eye + dir)
}

/// The same camera with its picture moved by a fraction of a pixel.
pub(crate) fn shifted(mut params: ViewParams, pixels: [f32; 2], size: [u32; 2]) -> ViewParams {
    let by = Vec3::new(2.0 * pixels[0] / size[0] as f32, 2.0 * pixels[1] / size[1] as f32, 0.0);
    params.view.clip_from_view = Mat4::from_translation(by) * params.view.clip_from_view;
    params
}
