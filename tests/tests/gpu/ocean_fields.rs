//! `ocean_rows` and `ocean_columns`: fields on the GPU against the direct sum in f64, the CPU's, and a naive transform.

use glam::DVec2;
use ocean_spectrum::gpu::{FftKernel, GpuError, GpuOcean};
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, SeaState, reference};

use crate::context::Context;

const SENTINEL: f32 = -12_345.0;

fn desc(size: u32, tiles: &[f32]) -> OceanDesc {
    let cascades = tiles.iter().map(|&tile| CascadeDesc::new(size, tile)).collect();
    OceanDesc { cascades, seed: 7, choppiness: 1.3, ..OceanDesc::default() }
}

/// Fills the fields with a sentinel, so that a texel not written shows.
fn prefill(context: &Context, gpu: &GpuOcean) {
    let texture = gpu.fields();
    let texels = vec![[SENTINEL; 4]; (gpu.size() * gpu.size() * 2 * gpu.cascades()) as usize];
    context.queue.write_texture(
        texture.as_image_copy(),
        bytemuck::cast_slice(&texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(16 * gpu.size()),
            rows_per_image: Some(gpu.size()),
        },
        texture.size(),
    );
}

/// All layers of the fields at a time.
fn fields(context: &Context, gpu: &mut GpuOcean, ocean: &Ocean, t: f64) -> Vec<Vec<[f32; 4]>> {
    prefill(context, gpu);
    context.frame(|frame| gpu.encode_fields(frame, ocean, t));
    let texels: Vec<[f32; 4]> = context.read_texture(gpu.fields(), 0);
    let layers: Vec<_> = texels.chunks((gpu.size() * gpu.size()) as usize).map(<[_]>::to_vec).collect();
    assert_eq!(layers.len(), 2 * gpu.cascades() as usize);
    assert!(texels.iter().flatten().all(|&x| x != SENTINEL && x.is_finite()), "a texel was not written");
    layers
}

/// Relative root mean square of each of the four channels.
fn relative_rms(pairs: impl Iterator<Item = ([f32; 4], [f64; 4])>) -> [f64; 4] {
    let mut error = [0.0; 4];
    let mut power = [0.0; 4];
    for (got, want) in pairs {
        for i in 0..4 {
            error[i] += (f64::from(got[i]) - want[i]).powi(2);
            power[i] += want[i].powi(2);
        }
    }
    std::array::from_fn(|i| (error[i] / power[i]).sqrt())
}

fn assert_below(errors: [f64; 4], bound: f64, what: &str) {
    assert!(errors.iter().all(|&e| e <= bound), "{what}: relative RMS {errors:?} above {bound:e}");
}

#[test]
fn fields_match_the_direct_sum_in_f64() {
    let context = Context::new();
    let ocean = Ocean::new(desc(64, &[300.0, 40.0])).expect("valid");
    let mut gpu = GpuOcean::new(&context.device, &ocean).expect("fits");
    // A time that 32 bits of a loop hold exactly, thousands of loops from the start.
    let loop_time = ocean.desc().loop_time;
    let t = loop_time * (3_000.0 + 123_457.0 / 1_048_576.0);
    let layers = fields(&context, &mut gpu, &ocean, t);
    for (c, modes) in ocean.modes().iter().enumerate() {
        let texel = f64::from(modes.tile) / f64::from(modes.size);
        let cells: Vec<usize> = (0..64 * 64).step_by(37).collect();
        let want: Vec<_> = cells
            .iter()
            .map(|&cell| {
                let x = DVec2::new((cell % 64) as f64, (cell / 64) as f64) * texel;
                reference::direct_sum(modes, f64::from(ocean.desc().choppiness), loop_time, x, t)
            })
            .collect();
        let at = |layer: usize| cells.iter().map(move |&cell| layer * 4096 + cell);
        let all: Vec<[f32; 4]> = layers.iter().flatten().copied().collect();
        let displacement = at(c).map(|i| all[i]).zip(want.iter().map(|w| w.displacement));
        assert_below(relative_rms(displacement), 3e-6, "displacement");
        let derivative = at(c + ocean.modes().len()).map(|i| all[i]).zip(want.iter().map(|w| w.derivative));
        assert_below(relative_rms(derivative), 3e-6, "derivative");
    }
}

#[test]
fn fields_match_the_cpu_at_every_size() {
    let context = Context::new();
    for size in [16, 32, 64, 128, 256, 512, 1024] {
        let tiles: &[f32] = if size <= 256 { &[300.0, 60.0, 9.0] } else { &[300.0] };
        let mut ocean = Ocean::new(desc(size, tiles)).expect("valid");
        ocean.set_time(1_234.5);
        for kernel in [FftKernel::Lines, FftKernel::Stages] {
            let mut gpu = GpuOcean::with_kernel(&context.device, &ocean, kernel).expect("fits");
            let dispatches = gpu.field_dispatches(gpu.cascades());
            // Stages: the last cascade is filled to its edge and does not share dispatches with the others.
            assert!(dispatches == 2 || kernel == FftKernel::Stages && dispatches <= 8, "{dispatches} dispatches");
            let layers = fields(&context, &mut gpu, &ocean, 1_234.5);
            for c in 0..tiles.len() {
                let want = ocean.fields(c);
                for (layer, want) in [(c, want.displacement), (c + tiles.len(), want.derivative)] {
                    let pairs = layers[layer].iter().zip(want).map(|(&got, want)| (got, want.map(f64::from)));
                    assert_below(relative_rms(pairs), 3e-6, &format!("{kernel:?}, size {size}, layer {layer}"));
                }
            }
        }
    }
}

#[test]
fn another_sea_is_taken_over_and_another_shape_refused() {
    let context = Context::new();
    let ocean = Ocean::new(desc(32, &[300.0, 150.0])).expect("valid");
    let mut gpu = GpuOcean::new(&context.device, &ocean).expect("fits");
    let before = fields(&context, &mut gpu, &ocean, 20.0);
    // Other tiles: more rows hold modes.
    let changed = Ocean::new(OceanDesc { seed: 8, choppiness: 0.5, ..desc(32, &[300.0, 40.0]) }).expect("valid");
    gpu.check(&changed).expect("same shape");
    let after = fields(&context, &mut gpu, &changed, 20.0);
    assert_ne!(before, after);
    let mut fresh = GpuOcean::new(&context.device, &changed).expect("fits");
    assert_eq!(fields(&context, &mut fresh, &changed, 20.0), after);

    let larger = Ocean::new(desc(64, &[300.0, 150.0])).expect("valid");
    let error = gpu.check(&larger).expect_err("another size");
    assert!(matches!(error, GpuError::InvalidValue { field: "size of the largest cascade", value: 64.0, .. }));
    context.frame(|frame| gpu.encode_fields(frame, &larger, 20.0));
    assert_eq!(fields(&context, &mut gpu, &changed, 20.0), after, "a sea that does not fit is ignored");
}

#[test]
fn cascades_of_different_sizes_are_synthesised_at_the_largest() {
    let context = Context::new();
    for sizes in [[64u32, 256, 128], [512, 32, 64]] {
        let tiles = [300.0, 60.0, 9.0];
        let cascades = sizes.iter().zip(tiles).map(|(&size, tile)| CascadeDesc::new(size, tile)).collect();
        let desc = OceanDesc { cascades, seed: 3, ..OceanDesc::default() };
        let mut ocean = Ocean::new(desc).expect("valid");
        ocean.set_time(77.0);
        let largest = sizes.into_iter().max().expect("three");
        for kernel in [FftKernel::Lines, FftKernel::Stages] {
            let mut gpu = GpuOcean::with_kernel(&context.device, &ocean, kernel).expect("fits");
            assert_eq!(gpu.size(), largest);
            let layers = fields(&context, &mut gpu, &ocean, 77.0);
            for (c, size) in sizes.into_iter().enumerate() {
                // Every texel of the CPU's array is one of the GPU's.
                let every = (largest / size) as usize;
                let cells = (0..size as usize).flat_map(|j| (0..size as usize).map(move |i| (i, j)));
                let at: Vec<usize> = cells.map(|(i, j)| (j * largest as usize + i) * every).collect();
                let want = ocean.fields(c);
                for (layer, want) in [(c, want.displacement), (c + 3, want.derivative)] {
                    let pairs = at.iter().zip(want).map(|(&at, want)| (layers[layer][at], want.map(f64::from)));
                    assert_below(relative_rms(pairs), 3e-6, &format!("{kernel:?}, sizes {sizes:?}, layer {layer}"));
                }
            }
        }
    }
}

#[test]
fn the_middle_of_a_change_matches_the_cpu() {
    let context = Context::new();
    let from = desc(64, &[300.0, 40.0]);
    let stronger = OceanDesc { sea: SeaState::wind(18.0, 200e3, 0.0), choppiness: 0.8, ..from.clone() };
    let other = OceanDesc { seed: 5, loop_time: 700.0, ..from.clone() };
    for (name, to) in [("amplitudes move", stronger), ("two seas cross-fade", other)] {
        let mut ocean = Ocean::new(from.clone()).expect("valid");
        let mut gpu = GpuOcean::new(&context.device, &ocean).expect("fits");
        let before = fields(&context, &mut gpu, &ocean, 90.0);
        let plain_dispatches = gpu.field_dispatches(gpu.cascades());
        ocean.change_to(to, 100.0, 60.0).expect("same cascades");
        // Before, in the middle of, after the change; and back.
        for t in [90.0, 100.0, 117.0, 150.0, 161.0, 130.0, 90.0] {
            ocean.set_time(t);
            let layers = fields(&context, &mut gpu, &ocean, t);
            assert_eq!(gpu.field_dispatches(gpu.cascades()), plain_dispatches, "mixing takes no dispatch");
            for c in 0..2 {
                let want = ocean.fields(c);
                for (layer, want) in [(c, want.displacement), (c + 2, want.derivative)] {
                    let pairs = layers[layer].iter().zip(want).map(|(&got, want)| (got, want.map(f64::from)));
                    assert_below(relative_rms(pairs), 4e-6, &format!("{name}, {t} s, layer {layer}"));
                }
            }
            if t == 90.0 {
                assert_eq!(layers, before, "{name}: no change yet");
            }
        }
    }
}
