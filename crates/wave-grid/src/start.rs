//! What a scheme of water waves keeps besides heights, where heights are imposed or waves are taken over.

use crate::dispersive::Law;
use crate::dispersive::start::Start;
use crate::{GridDesc, WaveGrid};

impl WaveGrid {
    /// Finds the potential and the screened fields of the waves whose heights, now and a sub-step ago, are in the state.
    pub(crate) fn start_from_heights(&mut self) {
        let starter = self.starter();
        let (z, old) = (&self.state.z[..], &self.state.old[..]);
        if let (Some(fields), Some(start)) = (&mut self.fields, starter) {
            start.by_heights(z, old, fields);
        } else if let Some(spectral) = &mut self.spectral {
            spectral.start(&self.desc, z, old);
        }
    }

    /// Finds them from the heights in the state and the velocity potential, m^2/s.
    pub(crate) fn start_from_potential(&mut self, phi: &mut [f32]) {
        let starter = self.starter();
        if let (Some(fields), Some(start)) = (&mut self.fields, starter) {
            let share = (self.stepping.dt / f64::from(self.desc.cell_size[0])) as f32;
            phi.iter_mut().for_each(|phi| *phi *= share);
            start.by_potential(&self.state.z, phi, fields);
        } else if let Some(spectral) = &mut self.spectral {
            spectral.start_from_potential(phi);
        }
    }

    /// The velocity potential of the surface now, m^2/s; the wave equation has none.
    pub(crate) fn velocity_potential(&self) -> Option<Vec<f32>> {
        if let Some(fields) = &self.fields {
            // P is half a sub-step ahead.
            let (share, half) = (self.desc.cell_size[0] / self.stepping.dt as f32, 0.5 * self.stepping.a[0] as f32);
            let both = fields.potential.iter().zip(self.state.z.iter());
            return Some(both.map(|(p, z)| share * (p + half * z)).collect());
        }
        self.spectral.as_ref().map(|spectral| spectral.velocity_potential())
    }

    /// For the dispersive scheme; over a bed that of its mean depth, in logarithms.
    fn starter(&self) -> Option<Start> {
        let fields = self.fields.as_ref()?;
        let Some((bed, cells)) = self.cells().and_then(|cells| Some((cells.bed.as_ref()?, cells))) else {
            return Some(Start::new(&self.desc, fields.law));
        };
        let (mut sum, mut count) = (0.0, 0.0f64);
        for (at, depth) in bed.depth.iter().enumerate() {
            if cells.is_open(at) && *depth > 0.0 {
                sum += libm::log(f64::from(depth.clamp(0.1, crate::dispersive::DEEP)));
                count += 1.0;
            }
        }
        let depth = (libm::exp(sum / count.max(1.0)) * f64::from(self.desc.cell_size[0])) as f32;
        let desc = GridDesc { depth, ..self.desc };
        Some(Start::new(&self.desc, Law::new(&desc, &self.stepping, &fields.table)))
    }
}
