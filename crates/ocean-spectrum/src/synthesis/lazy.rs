//! The arrays of one cascade, made when they are first read.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayon::prelude::*;

use crate::Moment;
use crate::modes::set::ModeSet;
use crate::synthesis::Job;
use crate::synthesis::lanes::Aligned;
use crate::synthesis::pool::Pools;

/// Which arrays of [`crate::CascadeFields`] are wanted; the displacement always is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Slopes and gradient of the displacement: normals, the Jacobian, and queries that invert strong chop.
    pub slopes: bool,
    /// Velocity and acceleration.
    pub motion: bool,
}

impl Outputs {
    /// All there is.
    pub const ALL: Self = Self { slopes: true, motion: true };
}

/// What the arrays are made from: one or two mode sets at one time.
#[derive(Clone)]
pub(crate) struct Source {
    pub(crate) first: Arc<ModeSet>,
    pub(crate) second: Option<Arc<ModeSet>>,
    pub(crate) moment: Moment,
}

/// The arrays of one cascade. A clone shares nothing that is made.
pub(crate) struct Synthesis {
    cascade: usize,
    source: Source,
    pools: Arc<Pools>,
    arrays: [Array; 3],
}

type Texels = Aligned<[f32; 4]>;

#[derive(Default)]
struct Array {
    made: OnceLock<Texels>,
    rest: Mutex<Rest>,
}

#[derive(Default)]
struct Rest {
    /// The array's memory while it is not made.
    spare: Option<Texels>,
    /// The states that were mixed last, by their phase.
    states: [Option<(u32, Texels)>; 2],
}

impl Clone for Synthesis {
    fn clone(&self) -> Self {
        Self::new(self.cascade, self.source.clone(), Arc::clone(&self.pools))
    }
}

impl Synthesis {
    pub(crate) fn new(cascade: usize, source: Source, pools: Arc<Pools>) -> Self {
        Self { cascade, source, pools, arrays: Default::default() }
    }

    /// From now on the arrays are those of `source`.
    pub(crate) fn set_source(&mut self, source: &Source) {
        let other_modes = source.moment.sets != self.source.moment.sets;
        self.source.clone_from(source);
        for array in &mut self.arrays {
            if other_modes {
                for state in &mut array.rest.get_mut().unwrap_or_else(PoisonError::into_inner).states {
                    *state = None;
                }
            }
            if let Some(texels) = array.made.take() {
                array.rest.get_mut().unwrap_or_else(PoisonError::into_inner).spare = Some(texels);
            }
        }
    }

    /// Makes what is wanted and not there yet, on rayon's threads.
    pub(crate) fn prepare(&mut self, outputs: Outputs) {
        let wanted = [true, outputs.slopes, outputs.motion];
        let (cascade, source, pools) = (self.cascade, &self.source, &*self.pools);
        self.arrays.par_iter_mut().enumerate().filter(|(which, _)| wanted[*which]).for_each(|(which, array)| {
            if array.made.get().is_none() {
                let texels = array.texels(source, cascade, |moment, out| {
                    source.job(cascade, which, moment).run(pools, out);
                });
                // Cannot be taken: nobody else has the array.
                let _ = array.made.set(texels);
            }
        });
    }

    /// An array, made by the calling thread alone if it is not there: no task of rayon's can come between and wait for
    /// what this one is making.
    fn array(&self, which: usize) -> &[[f32; 4]] {
        let array = &self.arrays[which];
        array.made.get_or_init(|| {
            array.texels(&self.source, self.cascade, |moment, out| {
                self.source.job(self.cascade, which, moment).run_alone(&self.pools, out);
            })
        })
    }

    pub(crate) fn displacement(&self) -> &[[f32; 4]] {
        self.array(0)
    }

    pub(crate) fn derivative(&self) -> &[[f32; 4]] {
        self.array(1)
    }

    pub(crate) fn velocity(&self) -> &[[f32; 4]] {
        self.array(2)
    }
}

impl Array {
    /// The array, by a function that makes it at a moment.
    fn texels(&self, source: &Source, cascade: usize, make: impl Fn(Moment, &mut Texels)) -> Texels {
        let lock = || self.rest.lock().unwrap_or_else(PoisonError::into_inner);
        let size = source.first.modes[cascade].size as usize;
        // Nobody else makes this array; the lock is not held meanwhile.
        let Rest { spare, mut states } = std::mem::take(&mut *lock());
        let room = |texels: Option<Texels>| texels.unwrap_or_else(|| Aligned::new(size * size));
        let mut texels = room(spare);
        match source.between(cascade) {
            None => make(source.moment, &mut texels),
            Some((phases, share)) => {
                let held = [0, 1].map(|i: usize| states[i].as_ref().map(|state| state.0));
                if held[1] == Some(phases[0]) || held[0] == Some(phases[1]) {
                    states.swap(0, 1);
                }
                for (state, phase) in states.iter_mut().zip(phases) {
                    if state.as_ref().is_none_or(|state| state.0 != phase) {
                        let mut made = room(state.take().map(|state| state.1));
                        make(Moment { phase: [phase, 0], ..source.moment }, &mut made);
                        *state = Some((phase, made));
                    }
                }
                if let [Some((_, from)), Some((_, to))] = &states {
                    mix(from, to, share, &mut texels);
                }
            }
        }
        *lock() = Rest { spare: None, states };
        texels
    }
}

/// `from + share (to - from)`.
fn mix(from: &[[f32; 4]], to: &[[f32; 4]], share: f32, out: &mut [[f32; 4]]) {
    let values = from.as_flattened().iter().zip(to.as_flattened());
    for (out, (from, to)) in out.as_flattened_mut().iter_mut().zip(values) {
        *out = from + share * (to - from);
    }
}

impl Source {
    fn job(&self, cascade: usize, which: usize, moment: Moment) -> Job<'_> {
        Job::new((&self.first, self.second.as_deref()), cascade, which, moment)
    }

    /// The phases of the two states that a cascade lies between, and how far from the first to the second; `None` for
    /// one that is made exactly. They follow from the time alone, not from what was asked for before.
    fn between(&self, cascade: usize) -> Option<([u32; 2], f32)> {
        let desc = &self.first.desc;
        let interval = f64::from(desc.cascades[cascade].interval);
        if interval == 0.0 || self.second.is_some() {
            return None;
        }
        let count = libm::ceil(desc.loop_time / interval) as u64;
        let place = u64::from(self.moment.phase[0]) * count;
        let phase = |state: u64| (((state << 32) + count / 2) / count) as u32;
        let (state, share) = (place >> 32, place as u32);
        Some(([phase(state), phase(state + 1)], (f64::from(share) / 4_294_967_296.0) as f32))
    }

    /// Work memory for all its cascades.
    pub(crate) fn pools(&self) -> Pools {
        let cascades = self.first.modes.len();
        let needs = (0..cascades).map(|cascade| self.job(cascade, 0, self.moment).needs());
        let [half, lines] = needs.fold([0, 0], |[a, b], [c, d]| [a.max(c), b.max(d)]);
        Pools::new(3 * cascades, half, rayon::current_num_threads(), lines)
    }
}
