//! The sea: modes, and the surface at one time.

use std::sync::Arc;

use fearless_simd::Level;
use glam::{DVec2, Vec2};
use open_water_shaders::surface::MAX_CASCADES;
use rayon::prelude::*;

use crate::modes::change::Segment;
use crate::modes::moment::{Moment, Parts, finite};
use crate::modes::set::ModeSet;
use crate::query::amplitude::{AmplitudeMap, Placed};
use crate::query::direct::{Direct, Part};
use crate::query::kernel::Texels;
use crate::query::layers::{Layer, Layers, View};
use crate::synthesis::lazy::{Outputs, Source, Synthesis};
use crate::{Notice, OceanDesc, OceanError};

/// Layers of arrays that are to be made.
fn layers(source: &Source) -> Vec<Layer> {
    let pools = Arc::new(source.pools());
    let layer = |c| Layer::new(&source.first, c, Synthesis::new(c, source.clone(), Arc::clone(&pools)));
    (0..source.first.modes.len()).map(layer).collect()
}

fn shape(set: &ModeSet) -> Vec<(u32, f32)> {
    set.modes.iter().map(|modes| (modes.size, modes.tile)).collect()
}

/// The arrays of one cascade at the time set, row-major, x fastest; texel `(i, j)` lies at `(i, j) * tile/size`.
#[derive(Debug, Clone, Copy)]
pub struct CascadeFields<'a> {
    /// Texels per side.
    pub size: u32,
    /// Side, metres.
    pub tile: f32,
    /// `(Dx, h, Dz, dDx/dz)`: displacement in metres, choppiness included, and its cross derivative.
    pub displacement: &'a [[f32; 4]],
    /// `(dh/dx, dh/dz, dDx/dx, dDz/dz)`.
    pub derivative: &'a [[f32; 4]],
    /// `(dDx/dt, dh/dt, dDz/dt, d^2h/dt^2)`, m/s and m/s^2.
    pub velocity: &'a [[f32; 4]],
}

/// A sea whose surface is known at one time, the last that [`Ocean::set_time`] was given (at first 0).
///
/// A clone shares the modes and is cheap but for the arrays; it is the way to look at another time.
#[derive(Clone)]
pub struct Ocean {
    /// The sea before the first change.
    pub(crate) base: Arc<ModeSet>,
    /// Changes in the order of their starts.
    pub(crate) segments: Vec<Arc<Segment>>,
    pub(crate) layers: Vec<Layer>,
    /// Size and tile of each layer.
    shape: Vec<(u32, f32)>,
    pub(crate) time_set: f64,
    pub(crate) moment: Moment,
    pub(crate) revision: u64,
    map: Option<Placed>,
    pub(crate) origin: DVec2,
}

impl Ocean {
    /// Makes the modes and the surface at time 0.
    ///
    /// # Errors
    /// As [`OceanDesc::validate`].
    pub fn new(desc: OceanDesc) -> Result<Self, OceanError> {
        Self::with_level(desc, Level::new())
    }

    /// With vector units of one's own choice.
    pub(crate) fn with_level(desc: OceanDesc, level: Level) -> Result<Self, OceanError> {
        Ok(Self::of_modes(Arc::new(ModeSet::new(desc, level)?)))
    }

    /// The sea of these modes at time 0.
    pub(crate) fn of_modes(base: Arc<ModeSet>) -> Self {
        let moment = Parts::Alone(&base).moment(0.0);
        let source = Source { first: Arc::clone(&base), second: None, moment };
        let layers = layers(&source);
        let shape = shape(&base);
        let segments = Vec::new();
        Self { base, segments, layers, shape, time_set: 0.0, moment, revision: 1, map: None, origin: DVec2::ZERO }
    }

    /// What was changed in the description or left out.
    pub fn notices(&self) -> &[Notice] {
        &self.parts().first().notices
    }

    /// Sets the time, seconds (0 if not finite). Costs nothing: the surface is made where it is first read, by the
    /// thread that reads it, or by [`Self::prepare`].
    pub fn set_time(&mut self, t: f64) {
        self.time_set = finite(t);
        self.refresh();
    }

    /// Makes the surface at the time set, as far as it is wanted and not there yet, on rayon's threads. Allocates
    /// nothing once the memory is there.
    pub fn prepare(&mut self, outputs: Outputs) {
        self.layers.par_iter_mut().for_each(|layer| layer.fields.prepare(outputs));
    }

    /// Brings everything to the time set.
    pub(crate) fn refresh(&mut self) {
        let parts = self.parts();
        let moment = parts.moment(self.time_set);
        if moment == self.moment {
            return;
        }
        let source = Source { first: Arc::clone(parts.first()), second: parts.second().map(Arc::clone), moment };
        self.revision += u64::from(moment.sets != self.moment.sets);
        self.moment = moment;
        if source.first.modes.iter().map(|modes| (modes.size, modes.tile)).ne(self.shape.iter().copied()) {
            (self.layers, self.shape) = (layers(&source), shape(&source.first));
        }
        for c in 0..self.layers.len() {
            self.layers[c].band = self.band(c);
            self.layers[c].fields.set_source(&source);
        }
    }

    /// World position (x, z) of the local origin, metres. The sea stays where it is in the world. Ignored if not finite.
    pub fn set_origin(&mut self, origin: DVec2) {
        if !origin.is_finite() {
            return;
        }
        self.origin = origin;
        self.set_amplitudes(self.amplitudes().cloned());
    }

    /// Scales the waves over the world from now on, in every query; `None` leaves them as they are everywhere. The
    /// arrays ([`Self::fields`]) stay whole.
    pub fn set_amplitudes(&mut self, map: Option<Arc<AmplitudeMap>>) {
        self.map = map.map(|map| Placed::new(map, self.origin));
    }

    /// The map that scales the waves.
    pub fn amplitudes(&self) -> Option<&Arc<AmplitudeMap>> {
        self.map.as_ref().map(|placed| &placed.map)
    }

    /// What queries read of the longest `count` cascades, made if it is not there.
    pub(crate) fn layers(&self, count: usize, reads: Outputs) -> Layers<'_> {
        let mut views = [View::default(); MAX_CASCADES];
        let layers = &self.layers[..count];
        for (c, ((view, &(size, tile)), layer)) in views.iter_mut().zip(&self.shape).zip(layers).enumerate() {
            view.texels_per_metre = f64::from(size) / f64::from(tile);
            let size = size as usize;
            let texels =
                |texels: fn(&Synthesis) -> &[[f32; 4]]| Texels { size, flat: texels(&layer.fields).as_flattened() };
            view.offset = self.offset_within(c);
            view.band = layer.band;
            view.displacement = texels(Synthesis::displacement);
            if reads.slopes {
                view.derivative = texels(Synthesis::derivative);
            }
            if reads.motion {
                view.velocity = texels(Synthesis::velocity);
            }
        }
        Layers { count, views, map: self.map.as_ref() }
    }

    /// What queries sum where the description says so.
    pub(crate) fn direct(&self) -> Option<Direct<'_>> {
        let parts = self.parts();
        let sets = [Some(parts.first()), parts.second()];
        let mut direct = Direct {
            parts: [None; 2],
            choppiness: self.moment.choppiness,
            tiles: [(1.0, DVec2::ZERO); MAX_CASCADES],
            count: self.layers.len(),
            map: self.map.as_ref(),
        };
        for (s, set) in sets.into_iter().enumerate() {
            if let Some(waves) = set.and_then(|set| set.largest.as_ref()) {
                let (phase, weight) = (self.moment.phase[s], self.moment.weight[s]);
                direct.parts[s] = Some(Part { waves, phase, weight });
            }
        }
        for (c, (tile, shape)) in direct.tiles.iter_mut().zip(&self.shape).enumerate() {
            *tile = (shape.1.into(), self.offset_within(c));
        }
        direct.parts[0].is_some().then_some(direct)
    }

    /// Significant height in metres of the sea at the time set where it is highest between two local corners, as a map of
    /// amplitudes leaves it there.
    pub fn significant_height_within(&self, low: Vec2, high: Vec2) -> f32 {
        let factors = self.map.as_ref().map_or([1.0; MAX_CASCADES], |map| map.largest(low, high));
        let variance = self.layers.iter().zip(factors).map(|(layer, f)| f * f * layer.band.variance);
        4.0 * variance.sum::<f32>().sqrt()
    }

    fn offset_within(&self, c: usize) -> DVec2 {
        self.offset_on(self.shape[c].1)
    }

    /// The local origin within a tile, metres.
    fn offset_on(&self, tile: f32) -> DVec2 {
        let tile = f64::from(tile);
        DVec2::new(self.origin.x.rem_euclid(tile), self.origin.y.rem_euclid(tile))
    }

    /// As [`Self::offset`], of each cascade that the sea has at time `t`, seconds (0 if not finite).
    pub fn offsets_at(&self, t: f64) -> impl Iterator<Item = Vec2> {
        self.mode_sets_at(t).0.iter().map(|modes| self.offset_on(modes.tile).as_vec2())
    }

    /// The local origin within the tile of cascade `c`, metres: add it to a local position to get one in the arrays.
    ///
    /// # Panics
    /// If there is no such cascade.
    pub fn offset(&self, c: usize) -> Vec2 {
        self.offset_within(c).as_vec2()
    }

    /// The displacement of cascade `c` alone; see [`CascadeFields::displacement`].
    ///
    /// # Panics
    /// If there is no such cascade.
    pub fn displacement(&self, c: usize) -> &[[f32; 4]] {
        self.layers[c].fields.displacement()
    }

    /// The arrays of cascade `c`, all of which are made if they are not there.
    ///
    /// # Panics
    /// If there is no such cascade.
    pub fn fields(&self, c: usize) -> CascadeFields<'_> {
        let fields = &self.layers[c].fields;
        CascadeFields {
            size: self.shape[c].0,
            tile: self.shape[c].1,
            displacement: fields.displacement(),
            derivative: fields.derivative(),
            velocity: fields.velocity(),
        }
    }
}
