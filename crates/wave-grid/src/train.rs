//! Wave trains that enter a grid through its fed sides.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::dispersion::Direction;
use crate::{FeedLine, GridDesc, GridError, Side, WaveGrid};

/// Periods over which a train grows.
const GROWTH: f64 = 8.0;

/// Plane waves of one height and period. They solve the grid's own scheme, so that they enter through the fed sides
/// without a trace outside.
///
/// ```
/// use glam::DVec2;
/// use wave_grid::{Edges, GridDesc, WaveGrid, WaveTrain};
///
/// let mut grid = WaveGrid::new(GridDesc::default())?;
/// grid.set_feed(Edges { low_x: true, high_x: true, low_z: true, high_z: true });
/// let swell = WaveTrain { height: 0.5, period: 3.0, heading: 0.3 };
/// for tick in 0..3600 {
///     grid.tick_trains(&[swell], f64::from(tick) / 60.0)?;
/// }
/// let highest = grid.heights().iter().fold(0.0f32, |most, z| most.max(*z));
/// assert!((highest - 0.25).abs() < 0.01);
/// # Ok::<(), wave_grid::GridError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveTrain {
    /// Height from trough to crest, metres.
    pub height: f32,
    /// Period, seconds.
    pub period: f32,
    /// Where they travel to, radians from x towards z.
    pub heading: f32,
}

/// A train on a grid.
struct Plane {
    amplitude: f64,
    /// Wave vector, 1/m.
    k: DVec2,
    /// Radians per second.
    turn: f64,
    /// k . x where the train is met first.
    front: f64,
    /// Group over phase velocity: with that what grows travels.
    group: f64,
}

impl WaveTrain {
    /// Wavenumber of the grid's scheme for this period and heading in water of `speed` (m/s, that of deep water or
    /// less), radians per metre.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] when the wave is shorter than 6 cells or a number is not finite; as [`GridDesc::stepping`].
    pub fn wavenumber(&self, desc: &GridDesc, speed: f32) -> Result<f64, GridError> {
        let invalid = |field, value: f32, bound| Err(GridError::InvalidValue { field, value: f64::from(value), bound });
        if !self.height.is_finite() {
            return invalid("height", self.height, "finite");
        }
        if !self.heading.is_finite() {
            return invalid("heading", self.heading, "finite");
        }
        let direction = Direction::new(desc, &desc.stepping()?, f64::from(speed), f64::from(self.heading));
        match direction.number(f64::from(self.period)) {
            Some(k) => Ok(k),
            None => invalid("period", self.period, "waves of at least 6 cells"),
        }
    }

    fn plane(&self, desc: &GridDesc, lines: &[FeedLine]) -> Result<Plane, GridError> {
        let speed = lines.first().map_or(desc.wave_speed, |line| line.speed as f32);
        let (sin, cos) = libm::sincos(f64::from(self.heading));
        let length = self.wavenumber(desc, speed)?;
        let longer = Self { period: (f64::from(self.period) * 1.01) as f32, ..*self };
        let share = f64::from(self.period) / f64::from(longer.period);
        let group = (1.0 - share) * length / (length - longer.wavenumber(desc, speed)?);
        let k = DVec2::new(cos, sin) * length;
        let ends = lines.iter().flat_map(|line| [0, line.count - 1].map(|i| line.place(0, i)));
        let front = ends.map(|place| k.dot(place)).fold(f64::INFINITY, f64::min);
        Ok(Plane { amplitude: 0.5 * f64::from(self.height), k, turn: TAU / f64::from(self.period), front, group })
    }
}

impl FeedLine {
    /// World place of point `i` of the row outside (0) or inside (1) the contour.
    pub fn place(&self, row: usize, i: usize) -> DVec2 {
        let (across, along) = (self.across[row], self.first + i as f64 * self.step);
        match self.side {
            Side::LowX | Side::HighX => DVec2::new(across, along),
            Side::LowZ | Side::HighZ => DVec2::new(along, across),
        }
    }
}

impl Plane {
    /// Adds its heights at `time`.
    fn add(&self, line: &FeedLine, time: f64, rows: [&mut [f32]; 2]) {
        for (row, heights) in rows.into_iter().enumerate() {
            let step = self.k.dot(line.place(row, 1) - line.place(row, 0));
            let start = self.k.dot(line.place(row, 0)) - self.front;
            let phase = start - self.turn * time;
            let ((turn_sin, turn_cos), (mut sin, mut cos)) = (libm::sincos(step), libm::sincos(phase));
            for (i, height) in heights.iter_mut().enumerate() {
                let met = self.turn * time * self.group - (start + i as f64 * step);
                let grown = (met / (GROWTH * TAU)).clamp(0.0, 1.0);
                // Flat to the fourth order at both ends, so that growing sheds nothing.
                let grown = grown.powi(4) * (35.0 - grown * (84.0 - grown * (70.0 - 20.0 * grown)));
                *height += (self.amplitude * grown * cos) as f32;
                (cos, sin) = (cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin);
            }
        }
    }
}

impl WaveGrid {
    /// Advances by one tick that begins at `time` (seconds since the trains set out), with wave trains entering
    /// through the sides of [`Self::set_feed`]. Water along the fed sides should be equally deep: the trains
    /// take their length from the first.
    ///
    /// # Errors
    /// As [`WaveTrain::wavenumber`]; nothing has moved then.
    pub fn tick_trains(&mut self, trains: &[WaveTrain], time: f64) -> Result<(), GridError> {
        let lines = self.feed_lines();
        let planes = trains.iter().map(|train| train.plane(&self.desc, &lines)).collect::<Result<Vec<_>, _>>()?;
        let dt = self.stepping.dt;
        self.tick_fed(&mut |line, substep, [outer, inner]| {
            outer.fill(0.0);
            inner.fill(0.0);
            for plane in &planes {
                plane.add(&lines[line], time + f64::from(substep) * dt, [&mut *outer, &mut *inner]);
            }
        });
        Ok(())
    }
}
