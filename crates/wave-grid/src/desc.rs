//! The description of a grid and what follows from it: sub-steps and the Courant number.

use crate::{Border, GridError};

/// Most sub-steps of a tick. A wave must not cross a tile within one tick.
pub const MAX_SUBSTEPS: u32 = 16;
/// Most cells along one side of a grid.
pub(crate) const MOST_CELLS: usize = 4096;
/// Cells along one side of a tile.
pub const TILE: usize = open_water_shaders::grid::TILE as usize;
/// Gravity, m/s^2.
pub(crate) const GRAVITY: f64 = 9.81;

/// Which waves a grid carries, and how they are discretised.
///
/// The first two are the wave equation, explicit, in flux form, second order: all waves travel at one speed, so a boat draws
/// a Mach wedge. The other two are water waves: long ones outrun short ones, and a boat draws Kelvin's wedge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Scheme {
    /// Isotropic 9-point flux form. At `a = .7` the phase velocity errs by 0.8 % at 8 cells per wave, the same in all directions to 0.03 %.
    #[default]
    NinePoint,
    /// The 5-point form of Yang et al. 2017, Eq. 2; 1.3 % along the axes at 8 cells per wave, none along the diagonals.
    FivePoint,
    /// The dispersion of water waves by an explicit scheme with three screened fields, from 6 to 128 cells a wave: over a bed,
    /// between walls, in an absorbing border. Square cells. About four times the cost of the wave equation.
    Dispersive,
    /// The exact dispersion of water of one depth by Fourier transforms; no walls and no bed. For reference, and where
    /// waves of all lengths matter. Its bits depend on the machine.
    Spectral,
}

impl Scheme {
    /// Whether all waves travel at the speed of [`GridDesc::wave_speed`].
    pub const fn is_wave_equation(self) -> bool {
        matches!(self, Scheme::NinePoint | Scheme::FivePoint)
    }

    /// Largest [`Stepping::a`] that is accepted. The theoretical bounds of the wave equation are 3/4 and 1/2, where a
    /// checkerboard grows linearly.
    pub const fn bound(self) -> f64 {
        match self {
            Scheme::NinePoint => 0.74,
            Scheme::FivePoint => 0.49,
            Scheme::Dispersive => crate::dispersive::MOST_G,
            Scheme::Spectral => f64::INFINITY,
        }
    }

    /// The `a` that the automatic number of sub-steps stays below.
    pub const fn target(self) -> f64 {
        match self {
            Scheme::NinePoint => 0.70,
            Scheme::FivePoint | Scheme::Dispersive | Scheme::Spectral => self.bound(),
        }
    }

    /// Weight of a face's own jump and of the two jumps beside it.
    pub const fn weights(self) -> (f64, f64) {
        match self {
            Scheme::NinePoint => (10.0 / 12.0, 1.0 / 12.0),
            Scheme::FivePoint | Scheme::Dispersive | Scheme::Spectral => (1.0, 0.0),
        }
    }
}

/// What a grid is made of. Checked by [`crate::WaveGrid::new`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridDesc {
    /// Cells along x and z, the border layer included: 48 to 4096 each. Default 256 x 256.
    pub cells: [u32; 2],
    /// Cell size h along x and z, metres: 0.001 to 1000. Default 0.5.
    pub cell_size: [f32; 2],
    /// Wave speed c of the wave equation in deep water, m/s: 0.001 to 1000. Default 6. All wavelengths travel at this speed;
    /// a [`crate::Medium`] can lower it. [`Scheme::Dispersive`] and [`Scheme::Spectral`] have no use for it.
    pub wave_speed: f32,
    /// Depth of the water where no [`crate::Medium`] tells it, metres: 0.01 and more. Default infinite. The wave equation
    /// has no use for it.
    #[cfg_attr(feature = "serde", serde(with = "crate::values::endless"))]
    pub depth: f32,
    /// Discretisation. Default nine-point.
    pub scheme: Scheme,
    /// What is at the window's edge. Default a layer of 12 cells that absorbs.
    pub border: Border,
    /// Linear damping sigma of `z_tt + sigma z_t = c^2 lap z`, 1/s: 0 to 10. Default 0.
    pub damping: f32,
    /// Length of a tick, seconds: 0.0001 to 1. Default 1/60.
    pub tick: f32,
    /// Sub-steps of a tick, 1 to 16; `None` (default) takes as few as are stable.
    pub substeps: Option<u32>,
}

impl Default for GridDesc {
    fn default() -> Self {
        Self {
            cells: [256; 2],
            cell_size: [0.5; 2],
            wave_speed: 6.0,
            depth: f32::INFINITY,
            scheme: Scheme::default(),
            border: Border::default(),
            damping: 0.0,
            tick: 1.0 / 60.0,
            substeps: None,
        }
    }
}

/// Numbers that follow from a checked description.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// Sub-steps per tick.
    pub substeps: u32,
    /// Length of a sub-step, seconds.
    pub dt: f64,
    /// `(c dt / h)^2` along x and z; of water waves `g dt^2 / h`, the same of a deep-water wave of 2 pi cells.
    pub a: [f64; 2],
}

impl Stepping {
    /// a along z over a along x: 1 for square cells.
    pub(crate) fn aspect(&self) -> f32 {
        (self.a[1] / self.a[0]) as f32
    }

    /// A tick in sub-steps times sqrt(a): of water waves, its length over sqrt(h / g).
    pub(crate) fn root_time(&self) -> f64 {
        f64::from(self.substeps) * self.a[0].sqrt()
    }

    /// The `a` of square cells that are as close to the bound: the largest eigenvalue of the scheme is 4 at the bound.
    fn tightest(&self, scheme: Scheme) -> f64 {
        let [x, z] = self.a;
        let mean = 0.5 * (x + z);
        match scheme {
            // Waves of two cells along x, along z, along both: 4 x, 4 z, 8/3 (x + z).
            Scheme::NinePoint => mean.max(0.75 * x.max(z)),
            // 4 (x + z).
            Scheme::FivePoint => mean,
            Scheme::Dispersive | Scheme::Spectral => x.max(z),
        }
    }
}

fn within(field: &'static str, value: f64, low: f64, high: f64, bound: &'static str) -> Result<(), GridError> {
    if value >= low && value <= high { Ok(()) } else { Err(GridError::InvalidValue { field, value, bound }) }
}

impl GridDesc {
    /// Checks every field.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] for a field out of range, [`GridError::Unstable`] when no allowed sub-step is short enough.
    pub fn stepping(&self) -> Result<Stepping, GridError> {
        for (field, n) in [("cells[0]", self.cells[0]), ("cells[1]", self.cells[1])] {
            within(field, f64::from(n), 48.0, MOST_CELLS as f64, "48 to 4096 cells")?;
        }
        for (field, h) in [("cell_size[0]", self.cell_size[0]), ("cell_size[1]", self.cell_size[1])] {
            within(field, f64::from(h), 0.001, 1000.0, "0.001 to 1000 m")?;
        }
        within("wave_speed", f64::from(self.wave_speed), 0.001, 1000.0, "0.001 to 1000 m/s")?;
        if let Border::Absorbing { width } | Border::Sponge { width } = self.border {
            if self.scheme.is_wave_equation() {
                within("border: width", f64::from(width), 4.0, 20.0, "4 to 20 cells")?;
            } else {
                within("border: width", f64::from(width), 4.0, 48.0, "4 to 48 cells")?;
                for (field, n) in [("cells[0]", self.cells[0]), ("cells[1]", self.cells[1])] {
                    let least = f64::from(2 * width.next_multiple_of(8) + 16);
                    within(
                        field,
                        f64::from(n),
                        least,
                        MOST_CELLS as f64,
                        "16 cells and twice the border, in steps of 8",
                    )?;
                }
            }
        }
        within("depth", f64::from(self.depth), 0.01, f64::INFINITY, "0.01 m and more")?;
        within("damping", f64::from(self.damping), 0.0, 10.0, "0 to 10 1/s")?;
        within("tick", f64::from(self.tick), 0.0001, 1.0, "0.0001 to 1 s")?;
        if self.scheme == Scheme::Dispersive && self.cell_size[0] != self.cell_size[1] {
            let bound = "cell_size[0]: the dispersive scheme has square cells";
            return Err(GridError::InvalidValue { field: "cell_size[1]", value: self.cell_size[1].into(), bound });
        }
        if self.scheme == Scheme::Spectral && self.border == Border::Reflecting {
            let bound = "a border that absorbs or repeats: the spectral scheme has no walls";
            return Err(GridError::InvalidValue { field: "border", value: 0.0, bound });
        }
        let (c, h, tick) = (f64::from(self.wave_speed), self.cell_size.map(f64::from), f64::from(self.tick));
        let number = |n: u32| {
            let dt = tick / f64::from(n);
            let a = h.map(|h| {
                let courant = c * dt / h;
                if self.scheme.is_wave_equation() { courant * courant } else { GRAVITY * dt * dt / h }
            });
            Stepping { substeps: n, dt, a }
        };
        // Speeds and ticks are f32: a bound met exactly in decimals must not fail by their rounding.
        let stable = |a: f64, bound: f64| a <= bound * (1.0 + 1e-6);
        let (chosen, bound) = match self.substeps {
            Some(n) => {
                within("substeps", f64::from(n), 1.0, f64::from(MAX_SUBSTEPS), "1 to 16")?;
                (number(n), self.scheme.bound())
            }
            None => {
                let fewest = (1..MAX_SUBSTEPS).find(|&n| stable(number(n).tightest(self.scheme), self.scheme.target()));
                (number(fewest.unwrap_or(MAX_SUBSTEPS)), self.scheme.target())
            }
        };
        let a = chosen.tightest(self.scheme);
        if !stable(a, bound) && !self.scheme.is_wave_equation() {
            let bound = "at most 0.006: smaller ticks, more sub-steps or larger cells";
            return Err(GridError::InvalidValue { field: "tick: g (tick / substeps)^2 / cell_size", value: a, bound });
        }
        if !stable(a, bound) {
            return Err(GridError::Unstable { dt: chosen.dt, h: h[0].min(h[1]), c, a, bound });
        }
        Ok(chosen)
    }
}
