//! `ocean_looks` and `ocean_mips`: half-float mips against a box filter on the CPU, and the foam.

use ocean_spectrum::gpu::{FOAM_SECONDS, GpuOcean};
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, SeaState};

use crate::context::Context;

fn sea(size: u32, wind: f32, choppiness: f32) -> Ocean {
    let cascades = [300.0, 40.0].map(|tile| CascadeDesc::new(size, tile)).to_vec();
    let sea = SeaState::wind(wind, 300e3, 0.0);
    Ocean::new(OceanDesc { sea, cascades, choppiness, ..OceanDesc::default() }).expect("valid")
}

/// A half-precision float.
fn half(bits: u16) -> f32 {
    let magnitude = f32::from_bits((u32::from(bits) & 0x7fff) << 13) * f32::from_bits(0x7780_0000);
    if bits & 0x8000 == 0 { magnitude } else { -magnitude }
}

/// One mip level, all layers.
fn level(context: &Context, gpu: &GpuOcean, mip: u32) -> Vec<[f32; 4]> {
    let texels: Vec<[u16; 4]> = context.read_texture(gpu.looks(), mip);
    texels.into_iter().map(|texel| texel.map(half)).collect()
}

/// Means of 2 x 2 texels of every layer.
fn halved(texels: &[[f32; 4]], side: usize) -> Vec<[f32; 4]> {
    let mut out = Vec::new();
    for layer in texels.chunks(side * side) {
        for j in (0..side).step_by(2) {
            for i in (0..side).step_by(2) {
                let at = |x: usize, z: usize| layer[z * side + x];
                let four = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
                out.push(std::array::from_fn(|c| four.iter().map(|t| t[c]).sum::<f32>() / 4.0));
            }
        }
    }
    out
}

fn largest_difference(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Foam of every texel of every cascade.
fn foam(context: &Context, gpu: &GpuOcean) -> Vec<f32> {
    let texels = level(context, gpu, 0);
    texels[..texels.len() / 2].iter().map(|texel| texel[3]).collect()
}

#[test]
fn mips_match_a_box_filter() {
    let context = Context::new();
    for size in [16, 64, 512] {
        let ocean = sea(size, 15.0, 1.0);
        let mut gpu = GpuOcean::new(&context.device, &ocean).expect("fits");
        context.frame(|frame| gpu.encode(frame, &ocean, 64.0, 0.1));
        let fields: Vec<[f32; 4]> = context.read_texture(gpu.fields(), 0);
        assert_eq!(gpu.looks().mip_level_count(), size.ilog2());

        let first = level(&context, &gpu, 0);
        let foams = foam(&context, &gpu);
        let mut exact = fields;
        for (texel, &foam) in exact.iter_mut().zip(&foams) {
            texel[3] = foam;
        }
        let scale = exact.iter().flatten().fold(0.0f32, |m, x| m.max(x.abs()));
        // Half floats have 11 bits; from level 3 on every other level is made from rounded texels.
        let rounding = scale / 1024.0;
        let difference = largest_difference(&first, &exact);
        assert!(difference <= rounding, "size {size}: {difference} of {scale}");
        let mut side = size as usize;
        for mip in 1..size.ilog2() {
            exact = halved(&exact, side);
            side /= 2;
            let difference = largest_difference(&level(&context, &gpu, mip), &exact);
            assert!(difference <= rounding * (1 + mip / 2) as f32, "size {size}, level {mip}: {difference} of {scale}");
        }
    }
}

#[test]
fn foam_stays_between_0_and_1_and_fades() {
    let context = Context::new();
    let rough = sea(64, 20.0, 1.3);
    let mut gpu = GpuOcean::new(&context.device, &rough).expect("fits");
    for i in 0..20u32 {
        context.frame(|frame| gpu.encode(frame, &rough, f64::from(i), 0.1));
    }
    let before = foam(&context, &gpu);
    assert!(before.iter().all(|f| (0.0..=1.0).contains(f)));
    assert!(before.iter().any(|&f| f > 0.3), "a rough sea breaks somewhere");

    // A sea without horizontal displacement breaks nowhere: what is left is old foam, fading.
    let smooth = sea(64, 20.0, 0.0);
    context.frame(|frame| gpu.encode(frame, &smooth, 0.0, FOAM_SECONDS));
    let after = foam(&context, &gpu);
    let factor = (-1.0f32).exp();
    for (before, after) in before.iter().zip(&after) {
        assert!((after - before * factor).abs() < 2e-3, "{before} became {after}");
    }
    context.frame(|frame| gpu.encode(frame, &smooth, 0.0, f32::NAN));
    assert_eq!(foam(&context, &gpu), after, "a time that is not a number fades nothing");
    context.frame(|frame| gpu.encode(frame, &smooth, 0.0, 1e9));
    assert!(foam(&context, &gpu).iter().all(|f| (0.0..1e-3).contains(f)));
}

#[test]
fn foam_grows_with_the_wind() {
    let context = Context::new();
    let cover = [6.0, 12.0, 24.0].map(|wind| {
        let ocean = sea(128, wind, 1.0);
        let mut gpu = GpuOcean::new(&context.device, &ocean).expect("fits");
        context.frame(|frame| gpu.encode(frame, &ocean, 96.0, 0.0));
        let foams = foam(&context, &gpu);
        // Summed over the two cascades, as the composite surface does.
        2.0 * foams.iter().sum::<f32>() / foams.len() as f32
    });
    assert!(cover[0] < 0.02 && cover[0] < cover[1] && cover[1] < cover[2] && cover[2] < 0.3, "{cover:?}");
}

#[test]
fn looks_are_left_alone_when_only_fields_are_asked_for() {
    let context = Context::new();
    let ocean = sea(32, 15.0, 1.0);
    let mut gpu = GpuOcean::new(&context.device, &ocean).expect("fits");
    context.frame(|frame| gpu.encode_fields(frame, &ocean, 64.0));
    assert!(level(&context, &gpu, 0).iter().flatten().all(|&x| x == 0.0));
    assert_eq!(gpu.look_dispatches(), 2);
}
