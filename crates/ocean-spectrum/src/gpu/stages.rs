//! Which dispatches a synthesis is made of.

use std::ops::Range;

use open_water_shaders::Pass;
use open_water_shaders::ocean::{COLUMNS, FFT_BLOCK, FFT_POINTS, FFT_THREADS, FIRST, ROWS, STAGE};

use super::synthesis::FftKernel;
use super::upload::Shape;
use crate::CascadeModes;

/// Halves of neighbouring cascades that differ by less share dispatches.
const ALIKE: u32 = 2;
/// Smaller cascades share dispatches however they are filled: there a dispatch costs more than what it could skip.
const SMALL: u32 = 128;
/// From here on none share: all stages of one cascade after the other stay in a CPU's cache, a stage of all does not.
const LARGE: u32 = 512;

/// Neighbouring cascades whose transforms run in the same dispatches.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Class {
    pub(super) cascades: Range<u32>,
    /// Rows and columns that hold modes in any of them: `0..half` and `size - half + 1..size`.
    pub(super) half: u32,
}

/// [`Class::half`] of a cascade alone.
pub(super) fn half(modes: &CascadeModes) -> u32 {
    // A cell that the band's end cuts may reach beyond it by half its diagonal.
    let end = (modes.band[1] / modes.step() + 0.71).ceil();
    if end < f64::from(modes.size / 2) { end as u32 } else { modes.size / 2 }
}

pub(super) fn classes(kernel: FftKernel, size: u32, halves: &[u32]) -> Vec<Class> {
    let mut classes: Vec<Class> = Vec::new();
    for (c, &half) in (0..).zip(halves) {
        match classes.last_mut() {
            Some(last)
                if kernel == FftKernel::Lines
                    || size < SMALL
                    || size < LARGE && half.max(last.half) < ALIKE * half.min(last.half) =>
            {
                last.cascades.end = c + 1;
                last.half = last.half.max(half);
            }
            _ => classes.push(Class { cascades: c..c + 1, half }),
        }
    }
    classes
}

/// A dispatch, but for what it reads and writes.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) pass: &'static Pass,
    pub(super) constants: Vec<(&'static str, f64)>,
    pub(super) workgroups: [u32; 2],
    pub(super) bytes: u64,
}

/// Radices of the stages of a transform. One of 32 saves a pass over memory, but along z it touches 32 rows at once, more
/// than a CPU prefetches, and takes three times as long as one of 16: there it comes first, where rows without modes are
/// left out, or not at all.
fn radices(size: u32, along_x: bool) -> Vec<u32> {
    match (size, along_x) {
        (32, _) => vec![32],
        (512, true) => vec![FFT_POINTS, 32],
        (512, false) => vec![32, FFT_POINTS],
        (1024, true) => vec![32, 32],
        (1024, false) => vec![FFT_POINTS, FFT_POINTS, 4],
        _ if size <= FFT_POINTS => vec![size],
        _ => vec![FFT_POINTS, size / FFT_POINTS],
    }
}

/// The dispatches of a class, one per stage of the whole synthesis.
pub(super) fn steps(kernel: FftKernel, shape: Shape, class: &Class, mixed: bool) -> Vec<Step> {
    let size = shape.size;
    let cascades = class.cascades.end - class.cascades.start;
    let rows = 2 * class.half - 1;
    let cells = |lines: u32, points: u32| u64::from(2 * cascades) * u64::from(lines) * u64::from(points);
    // 16 bytes of amplitudes and 4 of turns a cell, for a cascade or (lines) for each of its layers.
    let modes = |readers: u64| cells(rows, rows) / 2 * readers * if mixed { 40 } else { 20 };
    let step = |pass, constants: &[(&'static str, f64)], workgroups, bytes| {
        let own = [("N", size.into()), ("FIRST_CASCADE", class.cascades.start.into())];
        Step { pass, constants: [&own, constants].concat(), workgroups, bytes }
    };
    let (is_mixed, half) = (("MIXED", f64::from(u8::from(mixed))), ("HALF", f64::from(class.half)));
    if kernel == FftKernel::Lines {
        let groups = |lines: u32| [lines.div_ceil(FFT_BLOCK / size), 2 * cascades];
        return vec![
            step(&ROWS, &[is_mixed], groups(rows), modes(2) + 16 * cells(rows, size)),
            step(&COLUMNS, &[], groups(size), 16 * (cells(rows, size) + cells(size, size))),
        ];
    }
    let mut steps = Vec::new();
    for along_x in [true, false] {
        let lines = if along_x { rows } else { size };
        let mut done = 1;
        for radix in radices(size, along_x) {
            let wide = radix > FFT_POINTS;
            let threads = size / if wide { 32 } else { FFT_POINTS };
            let groups = (lines * threads).div_ceil(FFT_THREADS);
            let wide = ("WIDE", f64::from(u8::from(wide)));
            let along = ("ALONG_X", f64::from(u8::from(along_x)));
            let write = 16 * cells(lines, size);
            let stage = [wide, along, ("DONE", done.into())];
            steps.push(match (done, along_x) {
                (1, true) => step(&FIRST, &[wide, is_mixed, half], [groups, cascades], modes(1) + write),
                (1, false) => {
                    let sparse = [stage.as_slice(), &[half]].concat();
                    step(&STAGE, &sparse, [groups, 2 * cascades], 16 * cells(rows, size) + write)
                }
                _ => step(&STAGE, &stage, [groups, 2 * cascades], 2 * write),
            });
            done *= radix;
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_transform_takes_few_stages() {
        for size in (4..=10).map(|power| 1u32 << power) {
            for along_x in [true, false] {
                let radices = radices(size, along_x);
                assert_eq!(radices.iter().product::<u32>(), size);
                assert!(radices.len() <= 1 + usize::from(size > 32) + usize::from(size > 512), "{size}: {radices:?}");
            }
        }
    }

    #[test]
    fn cascades_with_as_many_rows_share_dispatches() {
        let found = classes(FftKernel::Stages, 256, &[42, 41, 128]);
        assert_eq!(found, [Class { cascades: 0..2, half: 42 }, Class { cascades: 2..3, half: 128 }]);
        assert_eq!(classes(FftKernel::Lines, 256, &[42, 41, 128]).len(), 1);
        assert_eq!(classes(FftKernel::Stages, 64, &[9, 32]).len(), 1);
        assert_eq!(classes(FftKernel::Stages, 512, &[42, 41]).len(), 2);
    }
}
