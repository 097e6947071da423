//! Wave makers: paddles that pump water up and down along a line.

use std::f64::consts::TAU;

use glam::Vec2;

use super::Source;
use super::footprint::SOFT;
use crate::dispersion::Direction;
use crate::{GridDesc, GridError};

/// Periods over which a paddle's stroke grows.
const GROWTH: f64 = 2.0;

/// A paddle inside a grid. It pumps water along a line; waves of its height and period leave to both sides.
///
/// A flow q per length at a line makes waves of amplitude q / (2c) on either side. What the grid's cells and the
/// width of the paddle take away is made up for, so the height holds at any resolution of at least 6 cells per wave.
///
/// ```
/// use glam::Vec2;
/// use wave_grid::{GridDesc, WaveGrid, WaveMaker};
///
/// let mut grid = WaveGrid::new(GridDesc::default())?;
/// let maker = WaveMaker { from: Vec2::new(0.0, -40.0), to: Vec2::new(0.0, 40.0), height: 0.2, period: 2.0 };
/// for tick in 0..600 {
///     let time = f64::from(tick) / 60.0;
///     grid.add(maker.source(grid.desc(), grid.desc().wave_speed, time)?);
///     grid.tick();
/// }
/// assert!(grid.heights().iter().any(|z| *z > 0.08));
/// # Ok::<(), wave_grid::GridError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveMaker {
    /// One end, local (x, z), metres. A line from wall to wall makes even waves.
    pub from: Vec2,
    /// The other end.
    pub to: Vec2,
    /// Height of the waves from trough to crest, metres.
    pub height: f32,
    /// Their period, seconds.
    pub period: f32,
}

impl WaveMaker {
    /// What the paddle does in the tick that begins at `time` (seconds since it started; nothing before), on a grid of
    /// this description, where waves travel at `speed` (m/s, [`GridDesc::wave_speed`] in deep water).
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] when the period makes waves of less than 6 cells, the line has no length or a
    /// number is not finite; as [`GridDesc::stepping`].
    pub fn source(&self, desc: &GridDesc, speed: f32, time: f64) -> Result<Source, GridError> {
        let stepping = desc.stepping()?;
        let invalid = |field, value, bound| Err(GridError::InvalidValue { field, value, bound });
        let line = self.to - self.from;
        let length = f64::from(line.length());
        if !(length > 0.0 && length.is_finite()) {
            return invalid("to", length, "ends apart, finite");
        }
        if !self.height.is_finite() {
            return invalid("height", f64::from(self.height), "finite");
        }
        let across = libm::atan2(f64::from(line.x), f64::from(-line.y));
        let direction = Direction::new(desc, &stepping, f64::from(speed), across);
        let Some(k) = direction.number(f64::from(self.period)) else {
            return invalid("period", f64::from(self.period), "waves of at least 6 cells");
        };
        let phase = TAU * time / f64::from(self.period);
        let grown = (time / (GROWTH * f64::from(self.period))).clamp(0.0, 1.0);
        let stroke = libm::cos(phase) * grown * grown * (3.0 - 2.0 * grown);
        // The sheet's q = 2 c A as it is on cells, and what a paddle of its width loses.
        let width = 2.0 * SOFT * f64::from(desc.cell_size[0].max(desc.cell_size[1]));
        let flow = 0.5 * f64::from(self.height) / (direction.response(k) * carried(k * width));
        let flow = flow * f64::from(desc.tick) * stroke;
        Ok(Source::Paddle { from: self.from, to: self.to, flow: flow as f32 })
    }
}

/// Transform of the thinnest box's profile, 1 - 3 x^2 + 2 x^3 for |x| < 1, at `k` radians, over that at zero.
fn carried(k: f64) -> f64 {
    if k < 0.05 {
        return 1.0 - k * k / 15.0;
    }
    let square = k * k;
    2.0 * (12.0 * (1.0 - libm::cos(k)) / square - 6.0 * libm::sin(k) / k) / square
}
