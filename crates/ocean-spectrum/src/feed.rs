//! The incoming ambient waves along a straight edge, for feeding an interactive grid.
//!
//! Of each wave only its wavenumber along the edge and its frequency pass into the grid; across the edge it goes on with
//! the wavenumber that the *grid* gives a wave of that frequency. Handed over so, it is a wave of the grid, and nothing is
//! scattered back by the two dispersions being different.

use std::f64::consts::{FRAC_PI_2, TAU};

use open_water_shaders::turns;

use crate::error::check;
use crate::modes::set::ModeSet;
use crate::{CascadeModes, Moment, Ocean, OceanError};

/// Waves summed together.
const LANES: usize = 8;

/// A straight edge of a grid, along x or z, with two rows of points on either side of a line halfway between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeDesc {
    /// Whether the edge runs along x, else along z.
    pub along_x: bool,
    /// World coordinates of the two rows across the edge, metres, at most 2 steps apart.
    pub across: [f64; 2],
    /// Which way across is inwards: 1 or -1. Waves that travel that way are fed.
    pub inward: f64,
    /// World coordinate of the first point along the edge, metres.
    pub first: f64,
    /// Distance of neighbouring points, metres, above 0.
    pub step: f64,
    /// Number of points, 1 to 8,192.
    pub count: usize,
    /// Wave speed of the grid at the edge, m/s, above 0.
    pub wave_speed: f64,
    /// How many of the sea's cascades are fed, longest first, from 1.
    pub cascades: usize,
}

impl EdgeDesc {
    fn validate(&self, ocean: &Ocean) -> Result<(), OceanError> {
        let held = ocean.modes().len();
        let [outside, inside] = self.across;
        for place in [outside, inside, self.first] {
            check("edge place", place, place.abs() <= 1e9, "within 10^9 m")?;
        }
        check("edge step", self.step, self.step > 0.0 && self.step <= 1e4, "above 0 to 10000 m")?;
        let apart = (outside - inside).abs();
        check("edge rows", apart, apart <= 2.0 * self.step, "at most 2 steps apart")?;
        check("edge inward", self.inward, self.inward.abs() == 1.0, "1 or -1")?;
        check("edge count", self.count as f64, (1..=8192).contains(&self.count), "1 to 8192 points")?;
        check(
            "edge wave_speed",
            self.wave_speed,
            self.wave_speed > 0.0 && self.wave_speed <= 1e3,
            "above 0 to 1000 m/s",
        )?;
        check("edge cascades", self.cascades as f64, (1..=held).contains(&self.cascades), "1 to the sea's number")
    }
}

/// Linear heights (without the horizontal displacement) of the ambient waves that come in over an edge.
///
/// Halfway between the rows they are those of the ambient sea. A wave too slow for the grid to carry at its angle dies
/// away inwards, as it must there. Waves that the grid does not resolve, shorter than four of its steps, are left out.
pub struct EdgeFeed {
    count: usize,
    sets: Vec<Fed>,
}

/// The waves of one mode set.
struct Fed {
    /// Which, as in [`Moment::sets`].
    id: u64,
    groups: Vec<Group>,
}

/// All waves of one wavenumber along the edge, up to its sign.
struct Group {
    waves: Vec<Waves>,
    /// Cosine and sine of the wavenumber times the place, by point.
    cos: Vec<f32>,
    sin: Vec<f32>,
}

/// Waves side by side: `height = Re(amp e^(-i omega t))` at the start of a row, on each of the two rows.
#[derive(Clone, Copy, Default)]
struct Waves {
    n: [u32; LANES],
    re: [[f32; LANES]; 2],
    im: [[f32; LANES]; 2],
}

/// A wave at the place 0 along the edge.
struct Wave {
    n: u32,
    amp: [[f64; 2]; 2],
}

impl Fed {
    fn new(set: &ModeSet, desc: &EdgeDesc) -> Self {
        let mut groups = Vec::new();
        for modes in &set.modes[..desc.cascades] {
            for (m, waves) in (0..).zip(incoming(modes, desc, set.desc.loop_time)) {
                if !waves.is_empty() {
                    groups.push(Group::new(m, &waves, f64::from(modes.tile), desc));
                }
            }
        }
        Self { id: set.id, groups }
    }
}

impl EdgeFeed {
    /// Sorts the sea's waves by wavenumber along the edge.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] for the first value of `desc` out of its bound.
    pub fn new(ocean: &Ocean, desc: EdgeDesc) -> Result<Self, OceanError> {
        desc.validate(ocean)?;
        let parts = ocean.parts();
        let sets = std::iter::once(parts.first()).chain(parts.second()).map(|set| Fed::new(set, &desc)).collect();
        Ok(Self { count: desc.count, sets })
    }

    /// Heights along the two rows at a moment of the sea ([`Ocean::moment_at`]), metres; as many as each slice holds, 0
    /// beyond the edge's points. Allocates nothing. The feed knows the mode sets that the sea had at the time set when it
    /// was made, and no other: make it anew when [`Ocean::revision`] has changed.
    pub fn rows(&mut self, moment: Moment, rows: [&mut [f32]; 2]) {
        let mut rows = rows.map(|row| {
            row.fill(0.0);
            let held = row.len().min(self.count);
            &mut row[..held]
        });
        for Fed { id, groups } in &self.sets {
            let Some(set) = moment.sets.iter().position(|other| other == id) else { continue };
            let (phase, weight) = (moment.phase[set], moment.weight[set]);
            for group in groups {
                let amps = group.amplitudes(phase);
                for (row, amp) in rows.iter_mut().zip(amps) {
                    let [re, im] = amp.map(|part| weight * part);
                    for ((height, cos), sin) in row.iter_mut().zip(&group.cos).zip(&group.sin) {
                        *height += re * cos - im * sin;
                    }
                }
            }
        }
    }
}

/// The waves of a cascade that come in, by the magnitude of their integer wavenumber along the edge. Those with a
/// negative one are turned into their conjugates, which have the same heights.
fn incoming(modes: &CascadeModes, desc: &EdgeDesc, loop_time: f64) -> Vec<Vec<Wave>> {
    let size = modes.size as usize;
    let tile = f64::from(modes.tile);
    let middle = 0.5 * (desc.across[0] + desc.across[1]);
    let finest = FRAC_PI_2 / desc.step;
    let mut by_number: Vec<Vec<Wave>> = (0..=size / 2).map(|_| Vec::new()).collect();
    for (cell, (amp, &n)) in modes.amp.iter().zip(&modes.n).enumerate() {
        let (i, j) = (modes.signed((cell % size) as u32), modes.signed((cell / size) as u32));
        let (along, across) = if desc.along_x { (i, j) } else { (j, i) };
        if n == 0 || f64::from(across) * desc.inward <= 0.0 {
            continue;
        }
        let tangential = f64::from(along) * modes.step();
        let whole = TAU * f64::from(n) / loop_time / desc.wave_speed;
        if tangential.abs().max(whole) > finest {
            continue;
        }
        // The wave that travels along k has twice the amplitude of its h0.
        let (sin, cos) = turned(f64::from(across), middle, tile);
        let (re, im) = (2.0 * f64::from(amp[0]), 2.0 * f64::from(amp[1]));
        let amp = [re * cos - im * sin, re * sin + im * cos];
        let on_row = |row: f64| {
            let inwards = desc.inward * (row - middle);
            let normal = whole * whole - tangential * tangential;
            let by = normal.abs().sqrt() * inwards;
            if normal < 0.0 {
                return amp.map(|part| part * libm::exp(-by));
            }
            let (sin, cos) = libm::sincos(by);
            [amp[0] * cos - amp[1] * sin, amp[0] * sin + amp[1] * cos]
        };
        let mut wave = Wave { n, amp: desc.across.map(on_row) };
        if along < 0 {
            wave.n = n.wrapping_neg();
            wave.amp = wave.amp.map(|[re, im]| [re, -im]);
        }
        by_number[along.unsigned_abs() as usize].push(wave);
    }
    by_number
}

/// Sine and cosine of `number` turns over `tile`, at `place`. The place is reduced first: exact far away.
fn turned(number: f64, place: f64, tile: f64) -> (f64, f64) {
    let turns = number * (place.rem_euclid(tile) / tile);
    libm::sincos(TAU * (turns - turns.floor()))
}

impl Group {
    fn new(m: u32, waves: &[Wave], tile: f64, desc: &EdgeDesc) -> Self {
        let pack = |waves: &[Wave]| {
            let mut packed = Waves::default();
            for (lane, wave) in waves.iter().enumerate() {
                packed.n[lane] = wave.n;
                for (row, amp) in wave.amp.iter().enumerate() {
                    (packed.re[row][lane], packed.im[row][lane]) = (amp[0] as f32, amp[1] as f32);
                }
            }
            packed
        };
        let at = |point: usize| turned(f64::from(m), desc.first + desc.step * point as f64, tile);
        let (sin, cos) = (0..desc.count).map(at).map(|(sin, cos)| (sin as f32, cos as f32)).unzip();
        Self { waves: waves.chunks(LANES).map(pack).collect(), cos, sin }
    }

    /// Real and imaginary part of the group on each row.
    fn amplitudes(&self, phase: u32) -> [[f32; 2]; 2] {
        let mut sum = [[[0.0f32; LANES]; 2]; 2];
        for waves in &self.waves {
            for l in 0..LANES {
                // e^(-i omega t)
                let [cos, sin] = turns::cos_sin(waves.n[l].wrapping_mul(phase));
                for (row, [re, im]) in sum.iter_mut().enumerate() {
                    re[l] += waves.re[row][l] * cos + waves.im[row][l] * sin;
                    im[l] += waves.im[row][l] * cos - waves.re[row][l] * sin;
                }
            }
        }
        sum.map(|row| row.map(|lanes| lanes.iter().sum()))
    }
}
