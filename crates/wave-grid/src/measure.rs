//! What tests and replays ask of a grid: energy, volume, finiteness, a hash.

use crate::WaveGrid;

impl WaveGrid {
    /// The invariant of the undamped scheme away from its border, m^4/s^2:
    /// hx hz / 2 sum [ ((z - z_old)/dt)^2 - z_old div(a grad z)/dt^2 ] over open water. In f64, row by row.
    pub fn energy(&self) -> f64 {
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

    /// Water above the ambient level, cubic metres, walls left out.
    pub fn volume(&self) -> f64 {
        let [hx, hz] = self.desc.cell_size.map(f64::from);
        let (nx, nz) = (self.state.nx, self.state.nz);
        let open = |at: usize| self.cells().is_none_or(|cells| cells.is_open(at));
        let inside = (1..nz - 1).flat_map(|j| j * nx + 1..(j + 1) * nx - 1);
        hx * hz * inside.filter(|at| open(*at)).map(|at| f64::from(self.state.z[at])).sum::<f64>()
    }

    /// Whether no value is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        let s = &self.state;
        let arrays = [&s.z, &s.old, &s.previous, &s.foam, &s.phi[0], &s.phi[1]];
        arrays.iter().all(|array| array.iter().all(|v| v.is_finite()))
    }

    /// 64-bit FNV-1a over the window's place and the bits of the state: equal on every machine and thread count.
    pub fn hash(&self) -> u64 {
        let s = &self.state;
        let mut hash = 0xcbf2_9ce4_8422_2325u64;
        let mut eat = |word: u64| hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        for corner in self.place.window.corner {
            eat(corner as u64);
        }
        for array in [&s.z, &s.old, &s.foam, &s.phi[0], &s.phi[1]] {
            for v in array.iter() {
                // -0 and 0 are the same water.
                eat(u64::from((v + 0.0).to_bits()));
            }
        }
        hash
    }
}
