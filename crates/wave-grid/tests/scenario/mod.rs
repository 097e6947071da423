//! Grids with sources, shifts and a medium, by arithmetic that is the same on every machine.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, Medium, MediumCell, Scheme, Source, WaveGrid};

/// A bed, a lossy strip, walls and held water on part of the plane, by arithmetic only.
pub(crate) struct Harbour;

impl Medium for Harbour {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let [x, z] = [place.x, place.y];
        let kind = match () {
            () if x > 30.0 && x < 34.0 && z.abs() < 12.0 => CellKind::Wall,
            () if (x - 22.0).abs() < 1.2 && (z + 9.0).abs() < 1.2 => CellKind::Fixed,
            () => CellKind::Open,
        };
        let slow = ((x - 10.0) / 60.0).clamp(0.0, 0.6) as f32;
        let damping = if z > 20.0 && x > 10.0 { 1.5 } else { 0.0 };
        let current = if z < -20.0 { Vec2::new(1.5, -0.5) } else { Vec2::ZERO };
        let depth = if x < 10.0 { f32::INFINITY } else { 30.0 * (1.0 - slow) };
        MediumCell { speed: deep_speed * (1.0 - slow), damping, kind, current, depth }
    }

    fn is_plain(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 10.0
    }

    fn is_deep(&self, low: DVec2, high: DVec2, _: f32) -> bool {
        self.is_plain(low, high, 0.0)
    }
}

/// What happens before tick `t`: the window moves in circles of squares, stones fall for `active` ticks.
pub(crate) fn disturb(grid: &mut WaveGrid, t: u32, active: u32) {
    let side = |t: u32| 0.3 * f64::from(t % 60) / 30.0;
    let at = (0..=t).fold(DVec2::ZERO, |at, t| {
        at + if t / 60 % 2 == 0 { DVec2::new(0.4, side(t)) } else { DVec2::new(-0.3, -0.8 * side(t)) }
    });
    grid.center_on(at);
    grid.set_origin(at);
    if t.is_multiple_of(3) && t < active {
        let center = Vec2::new((t % 7) as f32 - 3.0, (t % 11) as f32 - 5.0);
        let volume = if t.is_multiple_of(2) { 3.0 } else { -2.5 };
        grid.add(Source::Displacement { center, radius: 1.5, volume });
        grid.add(Source::Turbulence { center, radius: 2.0, foam: 0.3 });
    }
}

/// Grids of the wave equation's schemes and of water waves, with one and several sub-steps and with oblong cells; without a medium and with one.
pub(crate) fn grids() -> Vec<WaveGrid> {
    let nine = GridDesc { cells: [176, 144], wave_speed: 25.0, ..Default::default() };
    let five = GridDesc { scheme: Scheme::FivePoint, damping: 0.2, wave_speed: 40.0, ..nine };
    let oblong = GridDesc { cells: [150, 101], cell_size: [0.7, 0.5], ..nine };
    let mut grids = Vec::new();
    let water = GridDesc { scheme: Scheme::Dispersive, cells: [144, 127], substeps: Some(2), ..Default::default() };
    for desc in [nine, five, oblong, water] {
        for medium in [false, true] {
            let mut grid = WaveGrid::new(desc).unwrap();
            grid.set_medium(medium.then(|| Arc::new(Harbour) as Arc<dyn Medium>));
            grids.push(grid);
        }
    }
    grids
}

/// Runs ticks `first..last`.
pub(crate) fn run(grid: &mut WaveGrid, ticks: std::ops::Range<u32>) {
    for t in ticks {
        disturb(grid, t, 120);
        grid.tick();
    }
}
