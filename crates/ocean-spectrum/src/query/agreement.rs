//! Queries give the same bits on every vector unit, and whoever comes with a point.

use std::sync::Arc;

use fearless_simd::Level;
use glam::{DVec2, Vec2};

use crate::query::patch::Patches;
use crate::query::{Heights, Samples};
use crate::synthesis::levels;
use crate::{AmplitudeMap, Ocean, OceanDesc, OceanPatch, OceanSample, Queries};

fn seas() -> Vec<Ocean> {
    let map = |size: u32| {
        let factor = |i: u32| std::array::from_fn(|c| (i * 7 + 3 * c as u32) as f32 % 11.0 / 8.0);
        AmplitudeMap::new(DVec2::splat(-100.0), 9.0, [size, size], (0..size * size).map(factor).collect()).unwrap()
    };
    let mut seas = Vec::new();
    for queries in [Queries::Arrays, Queries::Largest(60)] {
        // The second folds in places.
        for choppiness in [1.0, 2.0] {
            for with_map in [false, true] {
                let mut ocean = Ocean::new(OceanDesc { queries, choppiness, ..OceanDesc::default() }).unwrap();
                ocean.set_amplitudes(with_map.then(|| Arc::new(map(23))));
                ocean.set_origin(DVec2::new(1e5, -3e6));
                ocean.set_time(1e6);
                seas.push(ocean);
            }
        }
    }
    seas
}

fn points() -> Vec<Vec2> {
    let part = |i: u32, m: u32| ((i.wrapping_mul(m) >> 8) as f32 / 16_777_216.0 - 0.5) * 400.0;
    let mut points: Vec<_> = (1..700).map(|i| Vec2::new(part(i, 2_654_435_761), part(i, 2_246_822_519))).collect();
    // No places among them, and places at the edges of texels and tiles.
    points[3] = Vec2::NAN;
    points[12] = Vec2::new(f32::INFINITY, 1.0);
    points[13] = Vec2::new(9e7, -9e7);
    points.extend([Vec2::ZERO, Vec2::new(-0.0, 1e-30)]);
    points
}

#[derive(PartialEq)]
struct Answers {
    samples: Vec<OceanSample>,
    patches: Vec<OceanPatch>,
    heights: Vec<u32>,
}

fn answers(ocean: &Ocean, level: Level, points: &[Vec2]) -> Answers {
    let mut samples = vec![OceanSample::default(); points.len()];
    let mut patches = vec![OceanPatch::default(); points.len()];
    let mut heights = vec![0.0; points.len()];
    // A body's size belongs to its place here, so that it comes along.
    let radii: Vec<f32> = points.iter().map(|p| (p.x.abs() % 7.0).min(5.0)).collect();
    ocean.answer(level, ocean.layers.len(), Samples, points, &mut samples);
    ocean.answer(level, ocean.layers.len(), Patches { radii: &radii }, points, &mut patches);
    ocean.answer(level, ocean.layers.len(), Heights, points, &mut heights);
    Answers { samples, patches, heights: heights.into_iter().map(f32::to_bits).collect() }
}

#[test]
fn vector_units_agree_bit_for_bit() {
    for ocean in seas() {
        let points = points();
        let expected = answers(&ocean, Level::new(), &points);
        for level in levels::all() {
            assert!(answers(&ocean, level, &points) == expected, "{level:?}");
        }
        assert!(expected.samples[3] == OceanSample::default());
    }
}

#[test]
fn a_point_does_not_know_its_company() {
    for ocean in seas() {
        let points = points();
        let together = answers(&ocean, Level::new(), &points);
        let reversed: Vec<_> = points.iter().rev().copied().collect();
        let mut back = answers(&ocean, Level::new(), &reversed);
        back.samples.reverse();
        back.patches.reverse();
        back.heights.reverse();
        assert!(back == together);
        for i in [0, 5, 12, 13, 255, 511, 512, 699] {
            let alone = answers(&ocean, Level::new(), &points[i..=i]);
            assert_eq!(alone.samples[0], together.samples[i]);
            assert_eq!(alone.patches[0], together.patches[i]);
            assert_eq!(alone.heights[0], together.heights[i]);
            assert_eq!(together.heights[i], together.samples[i].height.to_bits());
        }
    }
}
