//! Tests: transforms are right, and bits are equal at every level of vector units and on every machine.

use std::f64::consts::TAU;

use fearless_simd::{Level, Simd, dispatch, prelude::*};

use crate::synthesis::fft::{Band, Fft};
use crate::synthesis::lanes::{Aligned, Complex, MOST_LANES};
use crate::{CascadeDesc, Ocean, OceanDesc, SeaState, synthesis::levels};

/// Hashes of the transforms of impulses, sizes 16 to 1,024.
const IMPULSES: [u64; 7] = [
    0x6ac6_932c_2a95_493d,
    0xdcdc_ddb7_6024_7a7d,
    0x45a6_8c03_392a_44fd,
    0x0cd1_22e8_1159_29b5,
    0xbcec_8423_d59a_9bf5,
    0x6760_6f89_7f7a_598d,
    0x8845_e020_03ec_8b35,
];
/// Hashes of all arrays of a small sea before, within and after a change.
const SURFACES: [u64; 3] = [0x1dde_9a27_aa93_3bdb, 0x2e32_e6c3_4e1a_f760, 0x162a_420d_c433_f369];

/// One signal: its values, real and imaginary part.
type Signal = Vec<[f32; 2]>;

/// FNV-1a.
fn hash(values: impl Iterator<Item = f32>) -> u64 {
    values.fold(0xcbf2_9ce4_8422_2325, |hash: u64, value| {
        (hash ^ u64::from(value.to_bits())).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// Transforms as many signals as the widest level has lanes. Values outside the band are not read: NaN.
fn transform(level: Level, signals: &[Signal], band: Band) -> Vec<Signal> {
    #[inline(always)]
    fn run<S: Simd>(simd: S, fft: &Fft, signals: &[Signal], band: Band) -> Vec<Signal> {
        let (lanes, floats, size) = (S::f32s::LEN, Complex::<S>::FLOATS, signals[0].len());
        let mut made = Vec::new();
        for signals in signals.chunks(lanes) {
            let (mut line, mut out) = (Aligned::new(size * floats), Aligned::new(size * floats));
            line.fill(f32::NAN);
            for i in (0..band.half).chain(size - (band.half - 1)..size).chain(band.gap(size)) {
                for (lane, signal) in signals.iter().enumerate() {
                    [line[i * floats + lane], line[i * floats + lanes + lane]] = signal[i];
                }
            }
            fft.run(simd, &mut line, band, &mut out);
            made.extend(
                (0..lanes)
                    .map(|lane| out.chunks_exact(floats).map(|value| [value[lane], value[lanes + lane]]).collect()),
            );
        }
        made
    }
    let fft = Fft::new(signals[0].len());
    dispatch!(level, simd => run(simd, &fft, signals, band))
}

fn sizes() -> impl Iterator<Item = usize> {
    (4..=10).map(|power| 1 << power)
}

/// Full, and as narrow as a cascade that a shorter one continues.
fn bands(size: usize) -> [Band; 3] {
    [Band { half: size / 2 }, Band { half: size / 4 }, Band { half: size / 6 + 1 }]
}

#[test]
fn transforms_equal_the_sum_they_stand_for() {
    for (size, band) in sizes().flat_map(|size| bands(size).map(|band| (size, band))) {
        let inside = |i: usize| i < band.half || i + band.half > size;
        let value = |i: usize| ((i * 7919 + 13) % 1009) as f32 / 1009.0 - 0.5;
        let signal = |lane: usize| -> Signal {
            (0..size).map(|i| if inside(i) { [value(i + lane * 77), value(2 * i + lane)] } else { [0.0; 2] }).collect()
        };
        let signals: Vec<Signal> = (0..MOST_LANES).map(signal).collect();
        let made = transform(Level::new(), &signals, band);
        let (mut off, mut all) = (0.0, 0.0);
        for (signal, made) in signals.iter().zip(&made).step_by(5) {
            for (x, made) in made.iter().enumerate() {
                let (mut re, mut im) = (0.0, 0.0);
                for (i, &[p, q]) in signal.iter().enumerate() {
                    let (sin, cos) = (TAU * (i * x % size) as f64 / size as f64).sin_cos();
                    re += f64::from(p) * cos - f64::from(q) * sin;
                    im += f64::from(p) * sin + f64::from(q) * cos;
                }
                off += (f64::from(made[0]) - re).powi(2) + (f64::from(made[1]) - im).powi(2);
                all += re * re + im * im;
            }
        }
        let error = (off / all).sqrt();
        assert!(error < 3e-7, "{size}, {}: {error:e}", band.half);
    }
}

#[test]
fn impulses_give_the_bits_written_down() {
    for level in levels::all() {
        let hashes: Vec<_> = sizes()
            .map(|size| {
                let impulse = |lane: usize| -> Signal {
                    let mut signal = vec![[0.0; 2]; size];
                    signal[(lane * 37 + 1) % (size / 8)] = [0.7, -0.3];
                    signal[size - 1 - lane % (size / 8)] = [0.1 * lane as f32, 0.9];
                    signal
                };
                let signals: Vec<Signal> = (0..MOST_LANES).map(impulse).collect();
                let made = bands(size).into_iter().take(2).flat_map(|band| transform(level, &signals, band));
                hash(made.flatten().flatten())
            })
            .collect();
        assert_eq!(hashes, IMPULSES, "{level:?}: {hashes:#x?}");
    }
}

#[test]
fn surfaces_have_the_bits_written_down() {
    let cascades = vec![CascadeDesc::new(64, 485.0), CascadeDesc::new(32, 60.0), CascadeDesc::new(16, 9.0)];
    let desc = OceanDesc { cascades, seed: 6, choppiness: 0.9, ..Default::default() };
    let shallow = OceanDesc { sea: SeaState { depth: Some(9.0), ..SeaState::wind(7.0, 60e3, 2.0) }, ..desc.clone() };
    for level in levels::all() {
        let mut ocean = Ocean::with_level(desc.clone(), level).unwrap();
        ocean.change_to(shallow.clone(), 100.0, 60.0).unwrap();
        // Before, within and after a fade.
        let hashes = [12.5, 131.0, 1e6].map(|t| {
            ocean.set_time(t);
            let fields = (0..3).map(|c| ocean.fields(c));
            let texels = fields.flat_map(|f| [f.displacement, f.derivative, f.velocity]).flatten().flatten();
            hash(texels.copied())
        });
        assert_eq!(hashes, SURFACES, "{level:?}: {hashes:#x?}");
    }
}

#[test]
fn all_levels_are_tried() {
    let lanes: Vec<_> = levels::all().into_iter().map(levels::lanes).collect();
    assert!(lanes.contains(&4) && lanes.contains(&levels::lanes(Level::new())));
}
