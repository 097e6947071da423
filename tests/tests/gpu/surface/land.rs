//! The composite surface over land: amplitudes, bed, open water, walls and level, against the CPU and by hand.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use ocean_spectrum::gpu::GpuOcean;
use ocean_spectrum::{AmplitudeMap, CascadeDesc, CascadeFactors, Ocean, OceanDesc, OceanSample};
use open_water_shaders::pipeline::{Slot, bind_group, compute_pipeline, group_layout};
use open_water_shaders::surface::{self, HIDDEN_SLOPE_BIAS, SurfaceCascade, SurfaceLand, SurfaceTable};
use open_water_shaders::{Pass, no_constants};

use crate::context::Context;

const SIZE: [u32; 2] = [24, 17];
const TEXEL: f32 = 7.0;
const CORNER: Vec2 = Vec2::new(-81.0, -52.5);
const LEVEL: f32 = 1.75;

/// Water level, and factors by place.
type Land = (f32, fn(Vec2) -> CascadeFactors);
/// What one call answers at each point.
type Answers = Vec<[f32; 4]>;

struct Stage<'a> {
    context: &'a Context,
    ocean: Ocean,
    gpu: GpuOcean,
}

fn sea(cascades: &[f32]) -> OceanDesc {
    let cascades = cascades.iter().map(|&tile| CascadeDesc::new(128, tile)).collect();
    OceanDesc { cascades, ..OceanDesc::default() }
}

/// Different for every cascade and both axes, 0 in places, beyond 1 in others.
fn hills(place: Vec2) -> CascadeFactors {
    std::array::from_fn(|c| {
        let c = c as f32;
        (0.6 + 0.5 * (place.x / 17.0 + c).sin() + 0.4 * (place.y / (13.0 + c)).cos()).clamp(0.0, 1.2)
    })
}

fn raster<T>(f: impl Fn(Vec2) -> T) -> Vec<T> {
    let place = |i: u32| CORNER + TEXEL * Vec2::new((i % SIZE[0]) as f32, (i / SIZE[0]) as f32);
    (0..SIZE[0] * SIZE[1]).map(|i| f(place(i))).collect()
}

/// (elevation, open, wall, 0): planes, so that bilinear reading is exact.
fn ground(p: Vec2) -> [f32; 4] {
    [-6.0 + 0.05 * p.x + 0.02 * p.y, 0.5 + 0.004 * p.x, 0.25 - 0.003 * p.y, 0.0]
}

impl<'a> Stage<'a> {
    fn new(context: &'a Context, desc: OceanDesc) -> Self {
        let mut ocean = Ocean::new(desc).unwrap();
        ocean.set_time(61.5);
        let mut gpu = GpuOcean::new(&context.device, &ocean).unwrap();
        context.frame(|frame| gpu.encode(frame, &ocean, 61.5, 0.1));
        Self { context, ocean, gpu }
    }

    fn table(&self, land: Option<f32>) -> SurfaceTable {
        let mut table = SurfaceTable { cascade_count: self.ocean.modes().len() as u32, ..SurfaceTable::default() };
        for (slot, modes) in table.cascades.iter_mut().zip(self.ocean.modes()) {
            *slot = SurfaceCascade { tile: modes.tile, size: modes.size as f32, ..SurfaceCascade::default() };
        }
        for (i, slope) in table.hidden_slope.iter_mut().enumerate() {
            *slope = self.ocean.hidden_slope((i as f32 - HIDDEN_SLOPE_BIAS as f32).exp2());
        }
        if let Some(level) = land {
            table.land = SurfaceLand {
                corner: CORNER.into(),
                texel: TEXEL,
                present: 1,
                size: SIZE,
                level,
                ..Default::default()
            };
        }
        table
    }

    /// Runs `call`, WGSL for a vec4 at `p`, with factors by place.
    fn ask(&self, land: Option<Land>, call: &str, points: &[Vec2]) -> Answers {
        let Context { device, queue, .. } = self.context;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("land"),
            size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 3 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        if let Some((_, factors)) = land {
            let low = raster(|p| <[f32; 4]>::try_from(&factors(p)[..4]).unwrap());
            let high = raster(|p| <[f32; 4]>::try_from(&factors(p)[4..]).unwrap());
            let texels = [low, high, raster(ground)].concat();
            let rows = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(16 * SIZE[0]),
                rows_per_image: Some(SIZE[1]),
            };
            queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(&texels), rows, texture.size());
        }
        let array =
            wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() };
        let view = texture.create_view(&array);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let table = self.context.buffer(&[self.table(land.map(|(level, _)| level))]);
        let pool = self.context.buffer(&[[0.0f32; 2]; 2]);
        let layout = surface::layout(device);
        let texture = wgpu::BindingResource::TextureView;
        let group = bind_group(
            device,
            "water",
            &layout,
            &[
                table.as_entire_binding(),
                texture(self.gpu.displacement()),
                texture(self.gpu.derivative()),
                pool.as_entire_binding(),
                texture(self.gpu.looks_displacement()),
                texture(self.gpu.looks_derivative()),
                wgpu::BindingResource::Sampler(&sampler),
                texture(&view),
            ],
        );
        let own = group_layout(device, "ask", wgpu::ShaderStages::COMPUTE, &[Slot::Read, Slot::ReadWrite]);
        let text = format!(
            "{}@group(1) @binding(0) var<storage, read> points: array<vec2<f32>>;
            @group(1) @binding(1) var<storage, read_write> answers: array<vec4<f32>>;
            @compute @workgroup_size(64) fn ask(@builtin(global_invocation_id) id: vec3<u32>) {{
                if id.x < arrayLength(&points) {{ let p = points[id.x]; answers[id.x] = {call}; }}
            }}",
            surface::wgsl(0)
        );
        let parts: &[&str] = &[Box::leak(text.into_boxed_str())];
        let pass = Pass {
            name: "ask",
            constants: no_constants,
            parts: Box::leak(parts.into()),
            entry_points: &["ask"],
            params: &[],
        };
        let pipeline = compute_pipeline(device, &pass, "ask", &[&layout, &own], &[]);
        let (input, output) = (self.context.buffer(points), self.context.buffer(&vec![[9e9f32; 4]; points.len()]));
        let own = bind_group(device, "ask", &own, &[input.as_entire_binding(), output.as_entire_binding()]);
        self.context.submit(|encoder| {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_bind_group(1, &own, &[]);
            pass.dispatch_workgroups((points.len() as u32).div_ceil(64), 1, 1);
        });
        self.context.read(&output)
    }
}

/// On no lattice, within the raster and around it.
fn points() -> Vec<Vec2> {
    let spiral = |i: u32| Vec2::from_angle(i as f32 * 2.399_963) * 2.4 * (i as f32).sqrt();
    (0..4000).map(spiral).collect()
}

const EXACT: &str = "vec4<f32>(surface_at(p).height, surface_at(p).normal)";

#[test]
fn a_map_and_a_level_are_the_same_on_both_sides() {
    let context = Context::new();
    // Five cascades read the second layer too.
    for tiles in [&[485.0, 72.4, 10.8][..], &[300.0, 150.0, 75.0, 37.0, 18.0][..]] {
        let mut stage = Stage::new(&context, sea(tiles));
        let found = stage.ask(Some((LEVEL, hills)), EXACT, &points());
        let map = AmplitudeMap::new(CORNER.as_dvec2(), TEXEL, SIZE, raster(hills)).unwrap();
        let mut open = vec![OceanSample::default(); points().len()];
        stage.ocean.sample(&points(), &mut open);
        stage.ocean.set_amplitudes(Some(Arc::new(map)));
        let mut expected = open.clone();
        stage.ocean.sample(&points(), &mut expected);
        let bound = (1e-3 * stage.ocean.significant_height()).max(1e-3);
        for ((point, f), e) in points().iter().zip(&found).zip(&expected) {
            assert!((f[0] - LEVEL - e.height).abs() <= bound, "{point}: {f:?} against {e:?}");
            assert!(e.folded || Vec3::new(f[1], f[2], f[3]).distance(e.normal) < 1e-3, "{point}: {f:?} against {e:?}");
        }
        let changed = open.iter().zip(&expected).filter(|(a, b)| (a.height - b.height).abs() > 0.1).count();
        assert!(changed > 1000, "the map does little: {changed}");
    }
}

#[test]
fn without_land_nothing_changes() {
    let context = Context::new();
    let stage = Stage::new(&context, sea(&[485.0, 72.4]));
    for call in [EXACT, "vec4<f32>(surface_vertex(p, 0.5), surface_shading(p, 0.3).roughness)"] {
        // An empty texture is bound, and not read.
        let bare = stage.ask(None, call, &points());
        assert_eq!(stage.ask(Some((0.0, |_| [1.0; 8])), call, &points()), bare);
    }
    let land = stage.ask(None, "vec4<f32>(bed_at(p), water_open(p), wall_nearness(p), water_depth(p))", &points()[..9]);
    assert!(land.iter().all(|&a| a == [-1000.0, 1.0, 0.0, 1000.0]), "{land:?}");
}

#[test]
fn bed_and_walls_are_read_between_texels_and_held_outside() {
    let context = Context::new();
    let stage = Stage::new(&context, sea(&[100.0]));
    let call = "vec4<f32>(bed_at(p), water_open(p), wall_nearness(p), water_depth(p))";
    let found = stage.ask(Some((LEVEL, hills)), call, &points());
    let far = CORNER + TEXEL * Vec2::new((SIZE[0] - 1) as f32, (SIZE[1] - 1) as f32);
    for (point, found) in points().iter().zip(found) {
        let [bed, open, wall, _] = ground(point.clamp(CORNER, far));
        let off = Vec3::new(found[0] - bed, found[1] - open, found[2] - wall).abs().max_element();
        assert!(off < 1e-4 && (found[3] - (LEVEL - bed)).abs() < 1e-4, "{point}: {found:?}");
    }
    assert!(points().iter().any(|p| p.clamp(CORNER, far) != *p));
}

#[test]
fn looks_show_the_factors() {
    let context = Context::new();
    let stage = Stage::new(&context, sea(&[485.0, 72.4, 10.8]));
    let at = &points()[..500];
    let look = "vec4<f32>(surface_vertex(p, 0.5).y, surface_shading(p, 0.3).roughness, surface_shading(p, 0.3).foam, surface_shading(p, 0.02).normal.y)";
    let open = stage.ask(None, look, at);
    // Half of the sea, calm water, and calm but for the finest cascade's ripples.
    let half = stage.ask(Some((LEVEL, |_| [0.5; 8])), look, at);
    let calm = stage.ask(Some((LEVEL, |_| [0.0; 8])), look, at);
    let fine = stage.ask(Some((LEVEL, |_| [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])), look, at);
    for ((open, half), (calm, fine)) in open.iter().zip(&half).zip(calm.iter().zip(&fine)) {
        assert!((half[0] - LEVEL - 0.5 * open[0]).abs() < 1e-5, "{half:?} of {open:?}");
        assert!((half[1] - 0.25 * open[1]).abs() < 1e-6 && (half[2] - 0.5 * open[2]).abs() < 0.51 * open[2].max(1e-6));
        assert_eq!(*calm, [LEVEL, 0.0, 0.0, 1.0]);
        assert!((fine[0] - LEVEL).abs() < 0.1 && fine[1] > 0.9 * open[1] && fine[3] <= 1.0, "{fine:?} of {open:?}");
    }
    let steep = |a: &Answers| a.iter().map(|a| 1.0 - a[3]).sum::<f32>();
    assert!(steep(&fine) > 0.2 * steep(&open), "no ripples");
    assert!(steep(&half) < 0.5 * steep(&open) && steep(&half) > 0.1 * steep(&open));
    assert!(open.iter().any(|a| a[2] > 0.05), "no foam to weaken");
}
