//! The sum of the cascades at rest points, each scaled by the map's factor there, and the way back from a world point
//! to the rest point that is seen there. The twin of `wgsl/shared/surface_at.wgsl`.

use glam::Vec2;
use open_water_shaders::surface::{
    CHOP_FIXED_ROUNDS, CHOP_LEAST_SLOPE, CHOP_LEAST_STEP, CHOP_NEWTON_ROUNDS, CHOP_TOLERANCE,
};

use crate::amplitude::Placed;
use crate::kernel::Taps;
use crate::lazy::Synthesis;
use crate::patch::Band;
use crate::set::ModeSet;

/// A cascade as a query reads it.
#[derive(Clone)]
pub(crate) struct Layer {
    /// Local origin within the tile, metres.
    pub(crate) offset: Vec2,
    texels_per_metre: f32,
    size: usize,
    pub(crate) band: Band,
    pub(crate) fields: Synthesis,
}

impl Layer {
    pub(crate) fn new(set: &ModeSet, c: usize, fields: Synthesis) -> Self {
        let modes = &set.modes[c];
        Self {
            offset: Vec2::ZERO,
            texels_per_metre: modes.size as f32 / modes.tile,
            size: modes.size as usize,
            band: set.bands[c],
            fields,
        }
    }

    #[inline]
    pub(crate) fn taps(&self, rest: Vec2) -> Taps {
        Taps::new((rest + self.offset) * self.texels_per_metre, self.size)
    }
}

/// All cascades and what scales them.
#[derive(Clone, Copy)]
pub(crate) struct Layers<'a> {
    pub(crate) layers: &'a [Layer],
    pub(crate) map: Option<&'a Placed>,
}

/// The surface's gradient by rest coordinates.
#[derive(Clone, Copy)]
pub(crate) struct Gradient {
    /// `(dh/dx, dh/dz, dDx/dx, dDz/dz)`.
    pub(crate) d: [f32; 4],
    /// `(dDx/dz, dDz/dx)`: equal but for what the map's slopes add.
    pub(crate) cross: [f32; 2],
}

/// All there is at a rest point.
pub(crate) struct State {
    /// `(Dx, h, Dz, ..)`.
    pub(crate) displacement: [f32; 4],
    pub(crate) gradient: Gradient,
    pub(crate) velocity: [f32; 4],
}

/// Where the water at a point comes from.
pub(crate) struct Found {
    pub(crate) rest: Vec2,
    pub(crate) residual: f32,
    displacement: [f32; 4],
}

fn add(sum: &mut [f32; 4], term: [f32; 4]) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += term;
    }
}

fn add_scaled(sum: &mut [f32; 4], factor: f32, term: [f32; 4]) {
    add(sum, term.map(|term| factor * term));
}

impl Gradient {
    /// What the slopes of a factor add, at a place of this displacement.
    fn tilt(&mut self, slope_x: f32, slope_z: f32, [x, h, z, _]: [f32; 4]) {
        add(&mut self.d, [h * slope_x, h * slope_z, x * slope_x, z * slope_z]);
        self.cross[0] += x * slope_z;
        self.cross[1] += z * slope_x;
    }

    /// Determinant of the rest-to-world gradient: not above 0 where the surface folds.
    pub(crate) fn jacobian(&self) -> f32 {
        (1.0 + self.d[2]) * (1.0 + self.d[3]) - self.cross[0] * self.cross[1]
    }

    /// Slope in world coordinates.
    pub(crate) fn world_slope(&self) -> Vec2 {
        let [x, z, xx, zz] = self.d;
        let [p, q] = self.cross;
        Vec2::new((1.0 + zz) * x - q * z, (1.0 + xx) * z - p * x) / self.jacobian().max(CHOP_LEAST_SLOPE)
    }

    /// The step at rest that moves the surface by `miss`.
    fn newton_step(&self, miss: Vec2) -> Vec2 {
        let (a, b) = (1.0 + self.d[2], 1.0 + self.d[3]);
        let [p, q] = self.cross;
        // Near a fold the step would be arbitrarily long.
        let jacobian = self.jacobian().max(CHOP_LEAST_STEP);
        let step = Vec2::new(b * miss.x - p * miss.y, a * miss.y - q * miss.x) / jacobian;
        step.clamp_length_max(4.0 * miss.length())
    }
}

impl Layers<'_> {
    /// Everything at a rest point, cascade `c` weakened to `share(c)`.
    pub(crate) fn state(&self, rest: Vec2, share: impl Fn(usize) -> f32) -> State {
        let mut state =
            State { displacement: [0.0; 4], gradient: Gradient { d: [0.0; 4], cross: [0.0; 2] }, velocity: [0.0; 4] };
        let factors = self.map.map(|map| map.at(rest));
        for (c, layer) in self.layers.iter().enumerate() {
            let share = share(c);
            let factor = share * factors.as_ref().map_or(1.0, |factors| factors.value[c]);
            if share == 0.0 {
                continue;
            }
            let taps = layer.taps(rest);
            let displacement = taps.read(layer.fields.displacement());
            add_scaled(&mut state.displacement, factor, displacement);
            add_scaled(&mut state.gradient.d, factor, taps.read(layer.fields.derivative()));
            add_scaled(&mut state.velocity, factor, taps.read(layer.fields.velocity()));
            if let Some(factors) = &factors {
                state.gradient.tilt(share * factors.slope[0][c], share * factors.slope[1][c], displacement);
            }
        }
        for cross in &mut state.gradient.cross {
            *cross += state.displacement[3];
        }
        state
    }

    /// The same at a place found, all cascades whole.
    pub(crate) fn state_found(&self, found: &Found) -> State {
        if self.map.is_some() {
            return self.state(found.rest, |_| 1.0);
        }
        let (mut d, mut velocity) = ([0.0; 4], [0.0; 4]);
        for layer in self.layers {
            let taps = layer.taps(found.rest);
            add(&mut d, taps.read(layer.fields.derivative()));
            add(&mut velocity, taps.read(layer.fields.velocity()));
        }
        let gradient = Gradient { d, cross: [found.displacement[3]; 2] };
        State { displacement: found.displacement, gradient, velocity }
    }

    /// Finds the rest point whose water is seen at `point`.
    pub(crate) fn find(&self, point: Vec2) -> Found {
        let layers = self.layers;
        match self.map {
            None => invert(
                point,
                |rest| sum(layers, rest, Synthesis::displacement),
                |rest, cross| Gradient { d: sum(layers, rest, Synthesis::derivative), cross: [cross; 2] },
            ),
            // The slopes of the map are left out of the steps: they are near enough without.
            Some(map) => invert(
                point,
                |rest| scaled_sum(layers, map, rest, Synthesis::displacement),
                |rest, cross| Gradient { d: scaled_sum(layers, map, rest, Synthesis::derivative), cross: [cross; 2] },
            ),
        }
    }
}

/// The sum of one array, without a map.
#[inline]
fn sum(layers: &[Layer], rest: Vec2, texels: impl Fn(&Synthesis) -> &[[f32; 4]]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for layer in layers {
        add(&mut sum, layer.taps(rest).read(texels(&layer.fields)));
    }
    sum
}

/// The same, scaled by a map.
fn scaled_sum(layers: &[Layer], map: &Placed, rest: Vec2, texels: impl Fn(&Synthesis) -> &[[f32; 4]]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for (layer, factor) in layers.iter().zip(map.values(rest)) {
        add_scaled(&mut sum, factor, layer.taps(rest).read(texels(&layer.fields)));
    }
    sum
}

/// Inverts the horizontal displacement: finds `rest` with `rest + D(rest) = point`, given D and its gradient.
fn invert(
    point: Vec2,
    displacement_at: impl Fn(Vec2) -> [f32; 4],
    gradient_at: impl Fn(Vec2, f32) -> Gradient,
) -> Found {
    let mut rest = point;
    let mut best = Found { rest, residual: f32::INFINITY, displacement: [0.0; 4] };
    for round in 0..=CHOP_FIXED_ROUNDS + CHOP_NEWTON_ROUNDS {
        let displacement = displacement_at(rest);
        let miss = point - rest - Vec2::new(displacement[0], displacement[2]);
        let residual = miss.length();
        if residual < best.residual {
            best = Found { rest, residual, displacement };
        }
        if residual < CHOP_TOLERANCE {
            break;
        }
        rest += if round < CHOP_FIXED_ROUNDS { miss } else { gradient_at(rest, displacement[3]).newton_step(miss) };
    }
    best
}
