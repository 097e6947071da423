//! Renders the README's pictures as PPM files: `cargo run --release -p wave-grid --example pictures -- FOLDER`.

use std::{error::Error, fs, path::Path, sync::Arc};

use glam::{DVec2, Vec2};
use wave_grid::{Border, CellKind, GridDesc, Medium, MediumCell, Rain, Scheme, Source, WaveGrid, WaveMaker};

/// 64 x 64 m, at 60 ticks a second near the scheme's bound.
const WATER: f32 = 12.4;
const CELL: f32 = 0.25;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target".to_owned());
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    stone(&folder.join("stone.ppm"))?;
    boat(&folder.join("boat.ppm"))?;
    coast(Coast::Gap, &folder.join("gap.ppm"))?;
    coast(Coast::Shoal, &folder.join("shoal.ppm"))?;
    wake(Reach::Quay, &folder.join("wake-quay.ppm"))?;
    wake(Reach::Bank, &folder.join("wake-bank.ppm"))?;
    rain(&folder.join("rain.ppm"))
}

fn water() -> GridDesc {
    GridDesc { cell_size: [CELL; 2], wave_speed: WATER, ..GridDesc::default() }
}

fn stone(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut grid = WaveGrid::new(water())?;
    grid.add(Source::Displacement { center: Vec2::new(-6.0, 4.0), radius: 1.5, volume: 1.0 });
    for _ in 0..100 {
        grid.tick();
    }
    picture(&grid, |_| Bed::Deep, 0.02, path)
}

/// A boat 1.6 times as fast as the waves, its window after it.
fn boat(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut grid = WaveGrid::new(water())?;
    let step = DVec2::from_angle(0.5) * 1.6 * f64::from(WATER) / 60.0;
    for tick in 0..600 {
        let place = step * f64::from(tick);
        grid.center_on(place);
        grid.set_origin(place);
        for (center, volume) in [(Vec2::ZERO, 1.0), (-step.as_vec2(), -1.0)] {
            grid.add(Source::Displacement { center, radius: 1.2, volume });
        }
        grid.tick();
    }
    picture(&grid, |_| Bed::Deep, 0.15, path)
}

/// What waves of 1/2 s run against.
#[derive(Clone, Copy, PartialEq)]
enum Coast {
    /// A wall with a gap of 12 m.
    Gap,
    /// A round shoal, on its top waves have two fifths of their speed.
    Shoal,
}

impl Coast {
    fn is_wall(self, place: DVec2) -> bool {
        self == Coast::Gap && place.x.abs() < 0.6 && place.y.abs() > 6.0
    }
}

impl Medium for Coast {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        if *self == Coast::Gap {
            let kind = if self.is_wall(place) { CellKind::Wall } else { CellKind::Open };
            return MediumCell { kind, ..MediumCell::default() };
        }
        let top = (-place.distance_squared(DVec2::new(-6.0, 0.0)) / 60.0).exp() as f32;
        MediumCell { speed: deep_speed * (1.0 - 0.6 * top), ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn coast(coast: Coast, path: &Path) -> Result<(), Box<dyn Error>> {
    let mut grid = WaveGrid::new(water())?;
    grid.set_medium(Some(Arc::new(coast)));
    let (from, to) = (Vec2::new(-26.0, -27.0), Vec2::new(-26.0, 27.0));
    let paddle = WaveMaker { from, to, height: 0.3, period: 0.5 };
    for tick in 0..360 {
        grid.add(paddle.source(grid.desc(), WATER, f64::from(tick) / 60.0)?);
        grid.tick();
    }
    picture(&grid, |place| Bed::wall(coast.is_wall(place)), 0.12, path)
}

/// What a boat runs along.
#[derive(Clone, Copy, PartialEq)]
enum Reach {
    /// A wall.
    Quay,
    /// A round bank that rises from 10 m to 0.4 m below the surface.
    Bank,
}

impl Reach {
    fn is_wall(self, place: DVec2) -> bool {
        self == Reach::Quay && place.y < -16.0
    }

    /// Of the bank's height: 0 outside, 1 on its top.
    fn rise(self, place: DVec2) -> f64 {
        let up = ((28.0 - place.distance(DVec2::new(-10.0, 22.0))) / 12.0).clamp(0.0, 1.0);
        if self == Reach::Bank { up * up * (3.0 - 2.0 * up) } else { 0.0 }
    }
}

impl Medium for Reach {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        if *self == Reach::Quay {
            let kind = if self.is_wall(place) { CellKind::Wall } else { CellKind::Open };
            return MediumCell { kind, ..MediumCell::default() };
        }
        MediumCell { depth: (10.0 - 9.6 * self.rise(place)) as f32, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

/// Water waves on 128 x 128 m behind a boat at 4.5 m/s.
fn wake(reach: Reach, path: &Path) -> Result<(), Box<dyn Error>> {
    let border = Border::Absorbing { width: 16 };
    let mut grid = WaveGrid::new(GridDesc { scheme: Scheme::Dispersive, border, ..GridDesc::default() })?;
    grid.set_medium(Some(Arc::new(reach)));
    let place = |tick: u32| Vec2::new(-64.0 + 4.5 / 60.0 * tick as f32, -4.0);
    for tick in 0..1480 {
        for (center, volume) in [(place(tick + 1), 1.0), (place(tick), -1.0)] {
            grid.add(Source::Displacement { center, radius: 1.0, volume });
        }
        grid.tick();
    }
    let bed = |place| if reach.is_wall(place) { Bed::Wall } else { Bed::Bank(reach.rise(place) as f32) };
    picture(&grid, bed, 0.04, path)
}

/// 5 x 5 m in a shower.
fn rain(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut grid = WaveGrid::new(GridDesc { cell_size: [0.02; 2], wave_speed: 1.0, damping: 1.5, ..water() })?;
    let shower = Rain { rate: 30.0, drop_radius: 0.004, seed: 1 };
    for tick in 0..300 {
        grid.add_rain(&shower, tick);
        grid.tick();
    }
    picture(&grid, |_| Bed::Deep, 0.001, path)
}

/// What is below a pixel.
#[derive(Clone, Copy, PartialEq)]
enum Bed {
    Deep,
    /// So much of a bank's height.
    Bank(f32),
    Wall,
}

impl Bed {
    fn wall(is: bool) -> Self {
        if is { Self::Wall } else { Self::Deep }
    }
}

/// The drawn heights, lit from the upper left; `steep` is the slope that is drawn white.
fn picture(grid: &WaveGrid, bed: impl Fn(DVec2) -> Bed, steep: f32, path: &Path) -> Result<(), Box<dyn Error>> {
    let window = grid.window();
    let [nx, nz] = window.cells.map(|n| n as usize);
    let cell = DVec2::new(f64::from(window.cell_size[0]), f64::from(window.cell_size[1]));
    let mut drawn = vec![[0.0; 2]; nx * nz];
    grid.draw(1.0, &mut drawn);
    let mut pixels = format!("P6\n{nx} {nz}\n255\n").into_bytes();
    for j in 0..nz {
        for i in 0..nx {
            let bed = bed(window.world_corner() + cell * DVec2::new(i as f64 + 0.5, j as f64 + 0.5));
            if bed == Bed::Wall {
                pixels.extend([70, 60, 50]);
                continue;
            }
            let pale = if let Bed::Bank(rise) = bed { 0.3 * rise } else { 0.0 };
            let height = |i: usize, j: usize| drawn[j.min(nz - 1) * nx + i.min(nx - 1)][0];
            let slope =
                height(i + 1, j) - height(i.saturating_sub(1), j) + height(i, j + 1) - height(i, j.saturating_sub(1));
            let light = (0.5 + 0.5 * slope / (4.0 * steep * cell.x as f32)).clamp(0.0, 1.0);
            pixels.extend([[10.0, 190.0, 225.0], [50.0, 225.0, 210.0], [80.0, 235.0, 160.0]].map(
                |[low, high, sand]| {
                    let water = low + (high - low) * light;
                    (water + (sand - water) * pale) as u8
                },
            ));
        }
    }
    Ok(fs::write(path, pixels)?)
}
