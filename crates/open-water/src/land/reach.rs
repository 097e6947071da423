//! Shelter: how much of the waves of each direction reaches a place past the land.
//!
//! Each direction sweeps over the raster once, away from where its waves come from: what reaches a pixel is what reached
//! the place one step back, and nothing where it is dry. The steps fall between pixels, so shadows soften with distance,
//! as diffraction softens real ones (about, not exactly). Waves come in undisturbed from outside the raster. Reflection
//! and refraction are left to the grids.

use rayon::prelude::*;

/// Sectors of direction that are told apart.
pub(crate) const SECTORS: usize = 36;

/// For each set of shares of the sectors (waves travelling towards 2 pi i/36): the share of variance that reaches each
/// pixel.
pub(crate) fn reach(wet: &[bool], size: [u32; 2], shares: &[Vec<f32>]) -> Vec<Vec<f32>> {
    let arriving: Vec<Vec<f32>> = (0..SECTORS)
        .into_par_iter()
        .map(|sector| {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * sector as f32 / SECTORS as f32);
            sweep(wet, size, [cos, sin])
        })
        .collect();
    let sum = |shares: &Vec<f32>| {
        let mut sum = vec![0.0f32; wet.len()];
        for (share, arriving) in shares.iter().zip(&arriving) {
            for (sum, a) in sum.iter_mut().zip(arriving) {
                *sum += share * a;
            }
        }
        sum
    };
    shares.par_iter().map(sum).collect()
}

/// What reaches each pixel of the waves of one direction, 0 to 1.
fn sweep(wet: &[bool], size: [u32; 2], direction: [f32; 2]) -> Vec<f32> {
    let [nx, nz] = size.map(|n| n as usize);
    // The axis along which each step is one pixel.
    let along_x = direction[0].abs() >= direction[1].abs();
    let (steps, lanes, ahead, aside) =
        if along_x { (nx, nz, direction[0], direction[1]) } else { (nz, nx, direction[1], direction[0]) };
    let at = |step: usize, lane: usize| if along_x { lane * nx + step } else { step * nx + lane };
    let slant = aside / ahead.abs();
    let mut out = vec![0.0; nx * nz];
    let mut before = vec![1.0f32; lanes];
    let mut now = vec![0.0f32; lanes];
    for k in 0..steps {
        let step = if ahead > 0.0 { k } else { steps - 1 - k };
        for (lane, now) in now.iter_mut().enumerate() {
            let back = (lane as f32 - slant).clamp(0.0, (lanes - 1) as f32);
            let low = (back as usize).min(lanes.saturating_sub(2));
            let t = back - low as f32;
            let value = before[low] + t * (before[low + 1] - before[low]);
            *now = if wet[at(step, lane)] { value } else { 0.0 };
            out[at(step, lane)] = *now;
        }
        std::mem::swap(&mut before, &mut now);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [80, 60];

    /// Open water with a wall across at column 40, rows 0 to 29.
    fn wet() -> Vec<bool> {
        (0..80 * 60).map(|i| i % 80 != 40 || i / 80 >= 30).collect()
    }

    fn towards(sector: usize) -> Vec<f32> {
        (0..SECTORS).map(|s| f32::from(u8::from(s == sector))).collect()
    }

    #[test]
    fn a_wall_casts_its_shadow_where_the_waves_go() {
        let at = |map: &[f32], x: usize, z: usize| map[z * 80 + x];
        let maps = reach(&wet(), SIZE, &[towards(0), towards(18), towards(4)]);
        // Along +x: shadow behind the wall, light before it and beside it.
        assert_eq!([at(&maps[0], 60, 10), at(&maps[0], 20, 10), at(&maps[0], 60, 50)], [0.0, 1.0, 1.0]);
        // Along -x the shadow lies on the other side.
        assert_eq!([at(&maps[1], 20, 10), at(&maps[1], 60, 10)], [0.0, 1.0]);
        // At 40 degrees towards +z the shadow's edge leaves the wall's end (40, 29.5) at tan 40 = .839.
        for (x, edge) in [(50usize, 37.9f32), (60, 46.3)] {
            let row = (0..60).find(|z| at(&maps[2], x, *z) > 0.5 && *z > 20).unwrap() as f32;
            assert!((row - edge).abs() < 1.5, "{x}: {row} {edge}");
        }
    }

    #[test]
    fn directions_add_by_their_shares() {
        let half: Vec<f32> = towards(0).iter().zip(towards(18)).map(|(a, b)| 0.25 * a + 0.75 * b).collect();
        let map = &reach(&wet(), SIZE, &[half])[0];
        assert!((map[10 * 80 + 60] - 0.75).abs() < 1e-6 && (map[10 * 80 + 20] - 0.25).abs() < 1e-6);
        assert!((map[50 * 80 + 60] - 1.0).abs() < 1e-6);
    }
}
