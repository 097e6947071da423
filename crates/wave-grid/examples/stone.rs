//! Drops a stone into still water and prints how its ring spreads: the height along a line from where it fell.

use std::error::Error;

use glam::Vec2;
use wave_grid::{GridDesc, GridSample, Source, WaveGrid};

fn main() -> Result<(), Box<dyn Error>> {
    // 64 x 64 m of water whose waves travel at 12.4 m/s, at 60 ticks a second in one sub-step each.
    let mut grid = WaveGrid::new(GridDesc { cell_size: [0.25; 2], wave_speed: 12.4, ..GridDesc::default() })?;
    grid.add(Source::Displacement { center: Vec2::ZERO, radius: 1.0, volume: 0.5 });

    let places: Vec<Vec2> = (0..64).map(|i| Vec2::new(0.4 * i as f32, 0.0)).collect();
    let mut line = vec![GridSample::default(); places.len()];
    println!("metres from the stone: 0 to 25; heights in mm");
    for tick in 1..=150 {
        grid.tick();
        if tick % 15 == 0 {
            grid.sample(&places, &mut line);
            let highest = line.iter().map(|s| s.height).fold(0.0, f32::max);
            let drawn: String = line.iter().map(|s| mark(s.height / highest)).collect();
            println!("{:4.2} s |{drawn}| highest {:5.1}", f64::from(tick) / 60.0, 1e3 * highest);
        }
    }
    println!("{} of 289 tiles are still stepped; all is calm: {}", grid.active_tiles(), grid.is_asleep());
    Ok(())
}

/// A height between -1 and 1 as a character.
fn mark(height: f32) -> char {
    match height {
        0.6.. => '#',
        0.2.. => '+',
        0.02.. => '.',
        -0.02.. => ' ',
        _ => '_',
    }
}
