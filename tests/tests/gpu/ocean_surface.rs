//! `open_water_surface`, for a game that has the sea alone, against the CPU's fields.

use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::gpu::{GpuOcean, surface_layout, surface_wgsl};
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc};
use open_water_shaders::ocean::SURFACE_PROBE;
use open_water_shaders::pipeline::{Slot, bind_group, compute_pipeline, group_layout};

use crate::context::Context;

const TIME: f64 = 61.5;

fn sea(cascades: &[(u32, f32)]) -> Ocean {
    let cascades = cascades.iter().map(|&(size, tile)| CascadeDesc::new(size, tile)).collect();
    let mut ocean = Ocean::new(OceanDesc { cascades, seed: 5, ..OceanDesc::default() }).expect("valid");
    ocean.set_origin(DVec2::new(1234.5, -777.25));
    ocean.set_time(TIME);
    ocean
}

/// Displacement and foam, and the normal, at (x, z, footprint).
fn ask(context: &Context, ocean: &Ocean, points: &[(Vec2, f32)]) -> Vec<([f32; 4], Vec3)> {
    let device = &context.device;
    let mut gpu = GpuOcean::new(device, ocean).expect("fits");
    let layout = surface_layout(device);
    let group = gpu.surface_bind_group(device, &layout);
    let own = group_layout(device, "probe", wgpu::ShaderStages::COMPUTE, &[Slot::Read, Slot::ReadWrite]);
    let probe = compute_pipeline(device, &SURFACE_PROBE, "ocean_surface_probe", &[&layout, &own], &[]);
    let points: Vec<[f32; 4]> = points.iter().map(|(p, footprint)| [p.x, p.y, *footprint, 0.0]).collect();
    let asked = context.buffer(&points);
    let answers = context.buffer(&vec![[f32::NAN; 4]; 2 * points.len()]);
    let own_group = bind_group(device, "probe", &own, &[asked.as_entire_binding(), answers.as_entire_binding()]);
    context.frame(|frame| {
        gpu.encode(frame, ocean, TIME, 0.0);
        let mut pass = frame.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&probe);
        pass.set_bind_group(0, &group, &[]);
        pass.set_bind_group(1, &own_group, &[]);
        pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
    });
    let answers: Vec<[f32; 4]> = context.read(&answers);
    answers.as_chunks::<2>().0.iter().map(|[d, n]| (*d, Vec3::from_slice(n))).collect()
}

/// Displacement, and the derivative, of the CPU's fields at a local point, bilinear between texels.
fn bilinear(ocean: &Ocean, point: Vec2) -> ([f64; 3], [f64; 4]) {
    let mut displacement = [0.0; 3];
    let mut derivative = [0.0; 4];
    for c in 0..ocean.modes().len() {
        let fields = ocean.fields(c);
        let size = fields.size as usize;
        let x = (point + ocean.offset(c)).as_dvec2() * f64::from(fields.size) / f64::from(fields.tile);
        let (base, t) = (x.floor(), x - x.floor());
        for (di, dj, weight) in [
            (0.0, 0.0, (1.0 - t.x) * (1.0 - t.y)),
            (1.0, 0.0, t.x * (1.0 - t.y)),
            (0.0, 1.0, (1.0 - t.x) * t.y),
            (1.0, 1.0, t.x * t.y),
        ] {
            let [i, j] = [base.x + di, base.y + dj].map(|x| x.rem_euclid(f64::from(fields.size)) as usize);
            let at = j * size + i;
            for (sum, value) in displacement.iter_mut().zip(fields.displacement[at]) {
                *sum += weight * f64::from(value);
            }
            for (sum, value) in derivative.iter_mut().zip(fields.derivative[at]) {
                *sum += weight * f64::from(value);
            }
        }
    }
    (displacement, derivative)
}

/// The normal by the exact gradient of the surface without dDx/dz, kept from lying down as documented.
fn normal(d: [f64; 4]) -> Vec3 {
    let (a, b) = (1.0 + d[2], 1.0 + d[3]);
    let slope = DVec2::new(b * d[0], a * d[1]) / (a * b).max(0.05);
    let slope = (slope / (1.0 + slope.length_squared() / 1.44).sqrt()).as_vec2();
    Vec3::new(-slope.x, 1.0, -slope.y).normalize()
}

#[test]
fn at_texels_it_is_the_field() {
    let context = Context::new();
    let ocean = sea(&[(64, 200.0)]);
    let points: Vec<(Vec2, f32)> = (0..64 * 64)
        .step_by(11)
        .map(|cell| (Vec2::new((cell % 64) as f32, (cell / 64) as f32) * (200.0 / 64.0) - ocean.offset(0), 0.0))
        .collect();
    let hs = ocean.significant_height();
    for ((point, _), (made, n)) in points.iter().zip(ask(&context, &ocean, &points)) {
        let (want, derivative) = bilinear(&ocean, *point);
        for (made, want) in made.iter().zip(want) {
            assert!((f64::from(*made) - want).abs() < 2e-3 * f64::from(hs), "at {point}: {made}, {want}");
        }
        assert!(n.distance(normal(derivative)) < 2e-3, "at {point}: {n}");
        assert!((0.0..=1.0).contains(&made[3]));
    }
}

#[test]
fn between_texels_and_cascades_it_is_bilinear() {
    let context = Context::new();
    // Equal sizes: the CPU's arrays of smaller cascades would be coarser.
    let ocean = sea(&[(128, 300.0), (128, 60.0), (128, 9.0)]);
    let points: Vec<(Vec2, f32)> = (0..500).map(|i| (Vec2::from_angle(i as f32) * (0.37 * i as f32), 0.0)).collect();
    let hs = ocean.significant_height();
    for ((point, _), (made, n)) in points.iter().zip(ask(&context, &ocean, &points)) {
        let (want, derivative) = bilinear(&ocean, *point);
        for (made, want) in made.iter().zip(want) {
            assert!((f64::from(*made) - want).abs() < 3e-3 * f64::from(hs), "at {point}: {made}, {want}");
        }
        assert!(n.distance(normal(derivative)) < 6e-3, "at {point}: {n}, {}", normal(derivative));
    }
}

#[test]
fn a_footprint_averages_and_then_hides() {
    let context = Context::new();
    let ocean = sea(&[(64, 200.0), (64, 20.0)]);
    let texel = 200.0 / 64.0;
    // The middle of 4 x 4 texels of the first cascade, over which the second has faded.
    let point = Vec2::new(20.0 + 1.5, 8.0 + 1.5) * texel - ocean.offset(0);
    let asked = [(point, 4.0 * texel), (point, 0.3 * 200.0), (point, 120.0)];
    let answers = ask(&context, &ocean, &asked);
    let fields = ocean.fields(0);
    let mean = (0..16).map(|i| fields.displacement[(8 + i / 4) * 64 + 20 + i % 4][1]).sum::<f32>() / 16.0;
    assert!((answers[0].0[1] - mean).abs() < 2e-3, "{} against {mean}", answers[0].0[1]);
    assert!(answers[1].0[1].abs() < 0.2 * ocean.significant_height() && answers[1].0[1] != 0.0);
    assert_eq!((answers[2].0, answers[2].1), ([0.0; 4], Vec3::Y), "wider than half the longest tile: calm");
}

#[test]
fn the_text_goes_in_front_of_a_vertex_and_a_fragment_shader() {
    let text = surface_wgsl(2)
        + "@vertex fn v(@location(0) xz: vec2<f32>) -> @builtin(position) vec4<f32> {
            return vec4<f32>(open_water_surface_over(xz, 0.5).displacement, 1.0);
        }
        @fragment fn f(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
            let s = open_water_surface(p.xy);
            return vec4<f32>(s.normal, s.foam);
        }";
    let module = naga::front::wgsl::parse_str(&text).expect("parses");
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).expect("valid");
}
