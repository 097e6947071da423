//! What tests and replays ask of a grid: energy, volume, finiteness, a hash.

use crate::WaveGrid;
use crate::desc::GRAVITY;
use crate::dispersive::{FIELDS, Fields};

impl WaveGrid {
    /// The invariant of the undamped scheme away from its border, m^4/s^2:
    /// hx hz / 2 sum [ ((z - z_old)/dt)^2 - z_old div(a grad z)/dt^2 ] over open water. In f64, row by row.
    ///
    /// Where waves disperse, its own: with q the potential and the screened fields, q_old a sub-step ago,
    /// hx hz g / G times the sum over the cells of G z^2 / 2 + sum_i (X - X_old)^2 / (2 m) + V(q, q_old), V the form of which
    /// the scheme's forces are the slope; of the spectral scheme hx hz / 2 times the sum of g z^2 + phi T phi.
    pub fn energy(&self) -> f64 {
        if let Some(fields) = &self.fields {
            return self.dispersive_energy(fields);
        }
        if let Some(spectral) = &self.spectral {
            return spectral.energy(&self.state.z);
        }
        let state = &self.state;
        let nx = state.nx;
        let (straight, beside) = self.desc.scheme.weights();
        let [ax, az] = self.stepping.a;
        let (edge_x, edge_z) = (ax * straight - az * 2.0 * beside, az * straight - ax * 2.0 * beside);
        let corner = (ax + az) * beside;
        let z = |i: usize| f64::from(state.z[i]);
        let cells = self.cells();
        let mut sum = 0.0;
        for j in 1..state.nz - 1 {
            for at in j * nx + 1..(j + 1) * nx - 1 {
                let old = f64::from(state.old[at]);
                if let Some(cells) = cells {
                    if cells.is_open(at) {
                        let rate = z(at) - old;
                        sum += rate * rate - old * cells.divergence(&state.z, at);
                    }
                    continue;
                }
                let along_x = z(at - 1) + z(at + 1) - 2.0 * z(at);
                let along_z = z(at - nx) + z(at + nx) - 2.0 * z(at);
                let diagonal = z(at - nx - 1) + z(at - nx + 1) + z(at + nx - 1) + z(at + nx + 1) - 4.0 * z(at);
                let rate = z(at) - old;
                sum += rate * rate - old * (edge_x * along_x + edge_z * along_z + corner * diagonal);
            }
        }
        let [hx, hz] = self.desc.cell_size.map(f64::from);
        0.5 * hx * hz * sum / (self.stepping.dt * self.stepping.dt)
    }

    fn dispersive_energy(&self, fields: &Fields) -> f64 {
        let [nx, nz] = [self.state.nx, self.state.nz];
        let g = self.stepping.a[0];
        let bed = self.cells().and_then(|cells| cells.bed.as_ref());
        let (law, border) = (&fields.law, self.desc.border);
        let at = |field: &[f32], i: usize| f64::from(field[i]);
        // Heights in walls are for drawing.
        let open = |at: usize| self.cells().is_none_or(|cells| cells.is_open(at));
        let p_old = |i: usize| at(&fields.potential, i) + g * at(&self.state.z, i);
        let mut sum = 0.0;
        for j in 1..nz {
            for i in 1..nx {
                let here = j * nx + i;
                let inside = [i + 1 < nx, j + 1 < nz];
                // The faces before the cell; before the outermost ring those that face it only. The ring's own values are of
                // the sub-step before.
                let own = border.source(j, nz) * nx + border.source(i, nx);
                for (axis, beside) in [[i - 1, j], [i, j - 1]].into_iter().enumerate() {
                    if !inside[1 - axis] || (!inside[axis] && border.has_ring()) {
                        continue;
                    }
                    let other = border.source(beside[1], nz) * nx + border.source(beside[0], nx);
                    let weight = |k: usize, plain: f32| f64::from(bed.map_or(plain, |bed| bed.faces[axis][k][here]));
                    let potential = |i: usize| at(&fields.potential, i);
                    let slopes = (potential(own) - potential(other)) * (p_old(own) - p_old(other));
                    sum += 0.5 * weight(0, law.c) * slopes;
                    for k in 0..FIELDS {
                        let slope = |field: &[f32]| at(field, own) - at(field, other);
                        sum += 0.5 * weight(k + 1, law.s[k]) * slope(&fields.screened[k]) * slope(&fields.older[k]);
                    }
                }
                if inside != [true; 2] || !open(here) {
                    continue;
                }
                let (z, p) = (at(&self.state.z, here), at(&fields.potential, here));
                sum += 0.5 * g * z * z;
                for k in 0..FIELDS {
                    let (x, old) = (at(&fields.screened[k], here), at(&fields.older[k], here));
                    let m = f64::from(bed.map_or(law.m[k], |bed| bed.m[k][here]));
                    if m > 0.0 {
                        sum += 0.5 * (x - old) * (x - old) / m;
                    }
                    sum += 0.5 * f64::from(law.r[k]) * (p - x) * (p_old(here) - old);
                }
            }
        }
        let [hx, hz] = self.desc.cell_size.map(f64::from);
        hx * hz * GRAVITY / g * sum
    }

    /// Water above the ambient level, cubic metres, walls left out.
    pub fn volume(&self) -> f64 {
        let [hx, hz] = self.desc.cell_size.map(f64::from);
        let (nx, nz) = (self.state.nx, self.state.nz);
        let open = |at: usize| self.cells().is_none_or(|cells| cells.is_open(at));
        let inside = (1..nz - 1).flat_map(|j| j * nx + 1..(j + 1) * nx - 1);
        hx * hz * inside.filter(|at| open(*at)).map(|at| f64::from(self.state.z[at])).sum::<f64>()
    }

    /// Water that was put into the grid and has not left it, cubic metres: with walls all around the sum of the sources. It
    /// is [`volume`](Self::volume), but where waves disperse the heights alone do not keep it while waves run; with them
    /// the screened fields do: less the sum of (X - X_old) / m.
    pub fn held_volume(&self) -> f64 {
        let Some(fields) = &self.fields else { return self.volume() };
        let bed = self.cells().and_then(|cells| cells.bed.as_ref());
        let (nx, nz) = (self.state.nx, self.state.nz);
        let mut kept = 0.0;
        for at in (1..nz - 1).flat_map(|j| j * nx + 1..(j + 1) * nx - 1) {
            if self.cells().is_some_and(|cells| !cells.is_open(at)) {
                continue;
            }
            for k in 0..FIELDS {
                let m = f64::from(bed.map_or(fields.law.m[k], |bed| bed.m[k][at]));
                if m > 0.0 {
                    kept += (f64::from(fields.screened[k][at]) - f64::from(fields.older[k][at])) / m;
                }
            }
        }
        let [hx, hz] = self.desc.cell_size.map(f64::from);
        self.volume() - hx * hz * kept
    }

    /// Whether no value is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        let s = &self.state;
        let arrays = [&s.z, &s.old, &s.previous, &s.foam, &s.phi[0], &s.phi[1]];
        let fields = self.fields.iter().flat_map(|fields| fields.kept());
        let fields = fields.chain(self.spectral.iter().map(|spectral| spectral.potential()));
        let memory = self.fields.iter().flat_map(|fields| &fields.layer).flat_map(|layer| layer.memory.values());
        arrays.into_iter().chain(fields).flat_map(|array| array.iter()).chain(memory).all(|v| v.is_finite())
    }

    /// 64-bit FNV-1a over the window's place and the bits of the state: equal on every machine and thread count.
    pub fn hash(&self) -> u64 {
        let s = &self.state;
        let mut hash = 0xcbf2_9ce4_8422_2325u64;
        let mut eat = |word: u64| hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        for corner in self.place.window.corner {
            eat(corner as u64);
        }
        let fields = self.fields.iter().flat_map(|fields| fields.kept());
        let fields = fields.chain(self.spectral.iter().map(|spectral| spectral.potential()));
        let memory = self.fields.iter().flat_map(|fields| &fields.layer).flat_map(|layer| layer.memory.values());
        let arrays = [&s.z, &s.old, &s.foam, &s.phi[0], &s.phi[1]];
        for v in arrays.into_iter().chain(fields).flat_map(|array| array.iter()).chain(memory) {
            // -0 and 0 are the same water.
            eat(u64::from((v + 0.0).to_bits()));
        }
        hash
    }
}
