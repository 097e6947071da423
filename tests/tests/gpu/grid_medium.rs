//! Grids over walls, depths and held water on the GPU against the CPU grid: moving windows, changing media.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{Border, CellKind, GridDesc, Medium, MediumCell, Scheme, Source};

use crate::context::Context;
use crate::grid_step::{Twins, stone, twins};

/// Blocks of wall, held water and slower or damped water, whose place `salt` decides, from x = 40 m on.
struct Blocks {
    salt: u64,
    size: f64,
}

impl Medium for Blocks {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let [x, z] = [place.x, place.y].map(|x| (x / self.size).floor() as i64);
        let mut h = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (z as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        h = (h ^ self.salt ^ (h >> 31)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        let h = (h >> 40) as f32 / (1u64 << 24) as f32;
        let kind = match h {
            h if place.x < 40.0 || h > 0.3 => CellKind::Open,
            h if h < 0.08 => CellKind::Fixed,
            _ => CellKind::Wall,
        };
        let slow = place.x >= 40.0 && h > 0.5;
        let speed = if slow { deep_speed * (1.3 - h) } else { deep_speed };
        MediumCell { speed, damping: if slow { h } else { 0.0 }, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 40.0
    }
}

fn set_medium(twins: &mut Twins, medium: Option<Arc<dyn Medium>>) {
    for pair in &mut twins.pairs {
        pair.cpu.set_medium(medium.clone());
    }
    twins.gpu.set_medium(medium);
}

#[test]
fn a_medium_is_the_same_on_both_sides() {
    let context = Context::new();
    let descs = [
        GridDesc { cells: [128, 128], wave_speed: 25.0, ..Default::default() },
        GridDesc { cells: [150, 101], wave_speed: 40.0, scheme: Scheme::FivePoint, damping: 0.1, ..Default::default() },
        GridDesc {
            cells: [96, 112],
            cell_size: [0.5, 0.8],
            wave_speed: 45.0,
            border: Border::Absorbing { width: 8 },
            ..Default::default()
        },
    ];
    let mut twins = twins(&context, &descs);
    let ticks = 500;
    let mut peak = [0.0f32; 3];
    for t in 0..ticks {
        let time = f64::from(t) / 60.0;
        match t {
            20 => set_medium(&mut twins, Some(Arc::new(Blocks { salt: 1, size: 4.3 }))),
            260 => set_medium(&mut twins, Some(Arc::new(Blocks { salt: 5, size: 3.1 }))),
            420 => set_medium(&mut twins, None),
            440 => set_medium(&mut twins, Some(Arc::new(Blocks { salt: 5, size: 3.1 }))),
            _ => {}
        }
        // The first enters and leaves, the second stands among them, the third rushes about, with a teleport.
        twins.center_on(0, DVec2::new(10.0 + 90.0 * (0.5 * time).sin(), 20.0 * (0.3 * time).sin()));
        twins.center_on(1, DVec2::new(70.0, 3.0));
        twins.center_on(2, DVec2::new(if t < 300 { 30.0 + 45.0 * time } else { 90.0 - 30.0 * time }, 40.0 * time));
        for (k, desc) in descs.iter().enumerate() {
            let middle = twins.pairs[k].cpu.window().world_corner()
                + DVec2::new(f64::from(desc.cells[0]), f64::from(desc.cells[1])) * 0.25;
            let [x, z] = middle.as_vec2().to_array();
            let wobble = (t as f32 * 0.1).sin();
            twins.add(k, stone(x + 3.0 * wobble, z, 1.0 + 0.5 * wobble, 0.8 * (t as f32 * 0.23).sin()));
            if t % 7 == 0 {
                twins.add(k, Source::Turbulence { center: Vec2::new(x - 4.0, z + 1.0), radius: 1.5, foam: 0.3 });
            }
        }
        twins.tick();
        if t % 4 == 3 {
            twins.encode(&context);
        }
        if t % 20 == 19 {
            for (k, [height, foam, most]) in
                twins.compare(&context, if t == ticks - 1 { 1.0 } else { 0.3 }).iter().enumerate()
            {
                peak[k] = peak[k].max(*most);
                if t % 100 == 99 {
                    println!("tick {t} grid {k}: height {height:e} of {most}, foam {foam:e}");
                }
                assert!(
                    *height <= 4e-5 * peak[k].max(0.05) && *foam < 2e-3,
                    "tick {t} grid {k}: {height} of {most}, {foam}"
                );
            }
        }
    }
    assert!(peak.iter().all(|p| *p > 0.05), "{peak:?}");
}
