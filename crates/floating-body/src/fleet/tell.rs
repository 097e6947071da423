//! What pieces tell the water: each the change of its whole displaced volume, as [`Column`](crate::source) does for a point.

use fearless_simd::{Simd, f32x8, prelude::*};

use super::kernel::Motion;
use super::lanes::{LANES, V3};
use super::pack::{Pack, Told};
use super::template::Template;
use super::wet::{Surface, displaced};
use crate::Displacement;
use crate::source::{NEAR, QUIET};

/// Notes the volumes displaced at the end of a tick of `dt` s; a piece that has told nothing yet starts without a splash.
#[inline(always)]
pub(super) fn measure<S: Simd>(
    simd: S,
    template: &Template,
    dt: f32,
    surface: &Surface<S>,
    motion: &Motion<S>,
    pack: &mut Pack,
) {
    let (x, z) = (motion.position.x, motion.position.z);
    let now = displaced(simd, template, surface, dt, motion.position, &motion.turn.matrix());
    let V3 { x: old_x, y: old_z, z: old } = V3::load(simd, &pack.told[0]);
    let starts = old.simd_lt(f32x8::splat(simd, 0.0));
    let (dx, dz) = (x - old_x, z - old_z);
    let near = NEAR * template.radius;
    let moved = starts | (dx * dx + dz * dz).simd_ge(f32x8::splat(simd, near * near));
    let changed = moved | (now - old).abs().simd_ge(f32x8::splat(simd, QUIET * template.whole));
    for (i, (new, old)) in [(x, old_x), (z, old_z)].into_iter().enumerate() {
        moved.select(new, old).store_slice(&mut pack.told[0][i]);
        starts.select(new, old).store_slice(&mut pack.told[1][i]);
    }
    changed.select(now, old).store_slice(&mut pack.told[0][2]);
    starts.select(now, old).store_slice(&mut pack.told[1][2]);
}

/// Appends what `count` pieces tell.
pub(super) fn tell(packs: &[Pack], count: usize, radius: f32, out: &mut Vec<Displacement>) {
    let mut push = |told: Told, volume: f32| {
        if volume != 0.0 {
            out.push(Displacement { center: told.at, radius, volume, foam: 0.0 });
        }
    };
    for i in 0..count {
        let (now, old) = packs[i / LANES].tells(i % LANES);
        if now.volume < 0.0 {
            continue;
        }
        if now.at == old.at {
            push(now, now.volume - old.volume);
        } else {
            push(old, -old.volume);
            push(now, now.volume);
        }
    }
}
