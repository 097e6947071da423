//! The arrays of one cascade, made when they are first read.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayon::prelude::*;

use crate::Moment;
use crate::lanes::Aligned;
use crate::pool::Pools;
use crate::set::ModeSet;
use crate::synthesis::Job;

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

#[derive(Default)]
struct Array {
    made: OnceLock<Aligned<[f32; 4]>>,
    /// Its memory while it is not made.
    spare: Mutex<Option<Aligned<[f32; 4]>>>,
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
        self.source.clone_from(source);
        for array in &mut self.arrays {
            if let Some(texels) = array.made.take() {
                *array.spare.get_mut().unwrap_or_else(PoisonError::into_inner) = Some(texels);
            }
        }
    }

    /// Makes what is wanted and not there yet, on rayon's threads.
    pub(crate) fn prepare(&mut self, outputs: Outputs) {
        let wanted = [true, outputs.slopes, outputs.motion];
        let (cascade, source, pools) = (self.cascade, &self.source, &*self.pools);
        self.arrays.par_iter_mut().enumerate().filter(|(which, _)| wanted[*which]).for_each(|(which, array)| {
            if array.made.get().is_none() {
                let mut texels = array.room(source, cascade);
                source.job(cascade, which).run(pools, &mut texels);
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
            let mut texels = array.room(&self.source, self.cascade);
            self.source.job(self.cascade, which).run_alone(&self.pools, &mut texels);
            texels
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
    fn room(&self, source: &Source, cascade: usize) -> Aligned<[f32; 4]> {
        let spare = self.spare.lock().unwrap_or_else(PoisonError::into_inner).take();
        let size = source.first.modes[cascade].size as usize;
        spare.unwrap_or_else(|| Aligned::new(size * size))
    }
}

impl Source {
    fn job(&self, cascade: usize, which: usize) -> Job<'_> {
        Job::new((&self.first, self.second.as_deref()), cascade, which, self.moment)
    }

    /// Work memory for all its cascades.
    pub(crate) fn pools(&self) -> Pools {
        let cascades = self.first.modes.len();
        let needs = (0..cascades).map(|cascade| self.job(cascade, 0).needs());
        let [half, lines] = needs.fold([0, 0], |[a, b], [c, d]| [a.max(c), b.max(d)]);
        Pools::new(3 * cascades, half, rayon::current_num_threads(), lines)
    }
}
