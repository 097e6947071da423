//! The border layer of a window that moves over plain water, matched in the frame that moves with it.
//!
//! The wave equation keeps its form under the boost t' = T = g (d/dt + V . grad), g = (1 - V^2/c^2)^(-1/2), so a layer that stands
//! still in the window's frame is perfectly matched there: along x, with N = g1 (d/dx + V1/c^2 d/dt) and
//! g1 = (1 - V1^2/c^2)^(-1/2),
//!
//! z_tt + zeta1 (g1^2/g)(z_t + V1 z_x - V2 z_y) = c^2 lap z + N phi1 + d/dy phi2,
//! T phi1 = -zeta1 phi1 - c^2 zeta1 N z,  T phi2 = zeta1 (c^2 - g1^2 V2^2) z_y,
//!
//! and the same along y; zeta1 zeta2 z in corners as in Grote and Sim's. Kept is chi1 = phi1 + k1 zeta1 z, k1 = g1 V1/g, whose equation
//! and whose share in z_tt have no z_t left; terms with V1 V2 beside the layer's own are left out (a window that moves diagonally: 1 to 4 dB).
//! chi moves with the window: by V dt through the water in each sub-step, read with a cubic; its sources are taken half before,
//! half after that. In V z_x the height is the mean of three sub-steps across x, 1 - a sin^2(k h/2), without which the
//! shortest waves along the layer grow. The ring is a copy of its neighbours on the sides behind: a wall there makes
//! what stands in the window's frame grow.

use std::ops::Range;

use fearless_simd::{Level, dispatch};

use crate::cpu::boost::{Boost, Motion, PEAK, Pull, SLOW, STILL, Table, own, taps};
use crate::cpu::kernels::{Coefficients, flush, note};
use crate::cpu::tiles::{Mode, Tiles};
use crate::state::State;

/// A piece of a row.
#[derive(Debug, Clone)]
struct Piece {
    j: usize,
    x: Range<usize>,
}

/// What the layer keeps besides the state.
#[derive(Debug, Clone, Default)]
pub(crate) struct MovingLayer {
    tables: [Table; 2],
    /// Where chi and its sources are gathered, and where they have been moved along x.
    gathered: [Vec<f32>; 2],
    moved: [Vec<f32>; 2],
    /// Cells whose edges before them, and cells that themselves, are in active tiles of the layer.
    edges: Vec<Piece>,
    nodes: Vec<Piece>,
    row: Vec<f32>,
}

/// What is constant for a grid.
pub(crate) struct Surroundings<'a> {
    pub(crate) level: Level,
    pub(crate) tiles: &'a Tiles,
    pub(crate) thickness: usize,
    /// Cells along x at both sides that the layer takes from the interior.
    pub(crate) strip: usize,
    pub(crate) a: [f64; 2],
    pub(crate) coefficients: &'a Coefficients,
}

impl MovingLayer {
    /// Before a tick: which tiles are active.
    pub(crate) fn prepare(&mut self, state: &State, s: &Surroundings) {
        let (nx, nz, w) = (state.nx, state.nz, s.thickness);
        for array in self.gathered.iter_mut().chain(&mut self.moved) {
            array.resize(nx * nz, 0.0);
            for piece in &self.edges {
                array[piece.j * nx..][piece.x.clone()].fill(0.0);
            }
        }
        self.edges.clear();
        self.nodes.clear();
        let narrow = 2 * (1 + s.strip) >= nx;
        for tz in 0..s.tiles.count[1] {
            for j in s.tiles.span(1, tz).filter(|j| *j > 0) {
                for (tx, tile) in s.tiles.row(tz).iter().enumerate() {
                    if tile.mode != Mode::Active {
                        continue;
                    }
                    let span = s.tiles.span(0, tx);
                    let add = |list: &mut Vec<Piece>, all: bool, more: usize, last: usize| {
                        let within = |from: usize, to: usize| span.start.max(from)..span.end.min(to);
                        let both = [within(1, 1 + s.strip + more), within(nx - 1 - s.strip, last)];
                        let pieces = if all || narrow { [within(1, last), 0..0] } else { both };
                        for x in pieces.into_iter().filter(|x| !x.is_empty()) {
                            match list.last_mut() {
                                Some(piece) if piece.j == j && piece.x.end == x.start => piece.x.end = x.end,
                                _ => list.push(Piece { j, x }),
                            }
                        }
                    };
                    add(&mut self.edges, j <= w + 1 || j >= nz - 1 - w, 1, nx);
                    if j < nz - 1 {
                        add(&mut self.nodes, j <= w || j >= nz - 1 - w, 0, nx - 1);
                    }
                }
            }
        }
    }

    /// Makes chi hold for another velocity over the speed of waves than `held`: phi stays.
    pub(crate) fn turn(&mut self, state: &mut State, held: [f64; 2], motion: &Motion, s: &Surroundings) {
        self.shape(state, motion, s);
        let (from, to) = (Boost::new(held, s.a), Boost::new(motion.beta, s.a));
        let State { nx, z, old, phi, .. } = state;
        for (k, back) in [(0, 1), (1, *nx)] {
            let change = 0.25 * (to.axes[k].kappa - from.axes[k].kappa);
            if change == 0.0 {
                continue;
            }
            for Piece { j, x } in &self.edges {
                for i in x.clone() {
                    let at = j * *nx + i;
                    let zeta = self.tables[k].edge[if k == 0 { i } else { *j }];
                    phi[k][at] =
                        flush(phi[k][at] + change * zeta * ((z[at] + z[at - back]) + (old[at] + old[at - back])));
                }
            }
        }
    }

    /// The layer's share of a sub-step: writes z+ over `old` and the next phi, notes the largest |z| of each tile.
    pub(crate) fn step(&mut self, state: &mut State, tops: &mut [f32], motion: &Motion, s: &Surroundings) {
        self.shape(state, motion, s);
        let boost = Boost::new(motion.beta, s.a);
        ring(state, motion.beta, false);
        dispatch!(s.level, _simd => self.passes(state, tops, &boost, s));
        ring(state, motion.beta, true);
    }

    /// Where the layer stands and how strong it is.
    fn shape(&mut self, state: &State, motion: &Motion, s: &Surroundings) {
        let width = s.thickness as f64 - 1.0;
        let beta = motion.beta;
        let speed = (beta[0] * beta[0] + beta[1] * beta[1]).sqrt();
        let peak = PEAK + (2.0 * STILL / width - PEAK).max(0.0) * (1.0 - speed / SLOW).max(0.0);
        for (k, n) in [state.nx, state.nz].into_iter().enumerate() {
            self.tables[k].fill(n, width, peak * s.a[k].sqrt(), motion.lean[k]);
        }
    }

    #[inline(always)]
    fn passes(&mut self, state: &mut State, tops: &mut [f32], boost: &Boost, s: &Surroundings) {
        self.gather(state, boost, s.coefficients);
        for axis in 0..2 {
            self.carry(axis, state.nx, state.nz, boost);
        }
        self.advance_memory(state, boost);
        self.advance_heights(state, tops, boost, s);
    }

    /// (g - Z/2) chi + S/2 on every edge.
    #[inline(always)]
    fn gather(&mut self, state: &State, boost: &Boost, k: &Coefficients) {
        let (nx, nz) = (state.nx, state.nz);
        let [x, y] = &self.tables;
        let [bx, bz] = boost.axes;
        let [px, pz]: [&[f32]; 2] = [&state.phi[0], &state.phi[1]];
        let z: &[f32] = &state.z;
        let [gathered_x, gathered_z] = &mut self.gathered;
        let across_x = bx.gamma * (1.0 - bz.gamma * bz.gamma * bx.beta * bx.beta);
        let across_z = bz.gamma * (1.0 - bx.gamma * bx.gamma * bz.beta * bz.beta);
        for Piece { j, x: run } in &self.edges {
            let j = *j;
            let (at, n) = (j * nx + run.start, run.len());
            let around = |at: usize, n: usize| [&z[at - nx..][..n], &z[at..][..n]];
            let (edge, node) = (&x.edge[run.start..][..n], &x.node[run.start..][..n]);
            if j < nz - 1 {
                let ([south, here], [south_west, west]) = (around(at, n), around(at - 1, n));
                let (north, north_west) = (&z[at + nx..][..n], &z[at + nx - 1..][..n]);
                let (out, phi, other) = (&mut gathered_x[at..][..n], &px[at..][..n], y.node[j]);
                for i in 0..n {
                    let own = edge[i];
                    let beside = (north[i] - north_west[i]) + (south[i] - south_west[i]);
                    let flux = k.straight[0] * (here[i] - west[i]) + k.beside[0] * beside;
                    let stood = own * own * bx.kappa * (0.5 * (here[i] + west[i]));
                    let source = (other * across_x - own / bx.gamma) * flux + stood;
                    out[i] = (boost.gamma - 0.5 * own) * phi[i] + 0.5 * source;
                }
            }
            let n = run.end.min(nx - 1) - run.start;
            let ([south_west, west], [south, here]) = (around(at - 1, n), around(at, n));
            let [south_east, east] = around(at + 1, n);
            let (out, phi, own) = (&mut gathered_z[at..][..n], &pz[at..][..n], y.edge[j]);
            let node = &node[..n];
            for i in 0..n {
                let beside = (east[i] - south_east[i]) + (west[i] - south_west[i]);
                let flux = k.straight[1] * (here[i] - south[i]) + k.beside[1] * beside;
                let stood = own * own * bz.kappa * (0.5 * (here[i] + south[i]));
                let source = (node[i] * across_z - own / bz.gamma) * flux + stood;
                out[i] = (boost.gamma - 0.5 * own) * phi[i] + 0.5 * source;
            }
        }
    }

    /// Moves what axis `k` has gathered on with the window, into `moved`.
    #[inline(always)]
    fn carry(&mut self, k: usize, nx: usize, nz: usize, boost: &Boost) {
        let last = [nx - 1, nz - 1];
        // x-edges end a row earlier, z-edges a column.
        let [end_x, end_z] = [last[0] - k, last[1] - (1 - k)];
        let [wx, wz] = boost.axes.map(|axis| taps(axis.v));
        let (gathered, moved) = (&self.gathered[k], &mut self.moved[k]);
        self.row.resize(nx, 0.0);
        for Piece { j, x } in &self.edges {
            if *j > end_z {
                continue;
            }
            let x = x.start..x.end.min(end_x + 1);
            let row = &mut self.row[x.clone()];
            row.fill(0.0);
            // Along z into the row's own sum, along x while reading: for the windows that move along an axis, five taps.
            for (o, weight_z) in wz.iter().enumerate().filter(|(_, w)| **w != 0.0) {
                let from = &gathered[(j + o).saturating_sub(2).clamp(1, end_z) * nx..][..nx];
                for (p, weight_x) in wx.iter().enumerate().filter(|(_, w)| **w != 0.0) {
                    let weight = weight_x * weight_z;
                    // Where none of the cells read lies beyond an end.
                    let first = (3 - p.min(2)).clamp(x.start, x.end);
                    let end = (end_x + 3 - p).clamp(first, x.end);
                    let inside = &mut row[first - x.start..end - x.start];
                    for (sum, v) in inside.iter_mut().zip(&from[(first + p).saturating_sub(2)..]) {
                        *sum += weight * v;
                    }
                    for i in (x.start..first).chain(end..x.end) {
                        row[i - x.start] += weight * from[(i + p).saturating_sub(2).clamp(1, end_x)];
                    }
                }
            }
            moved[j * nx..][x].copy_from_slice(row);
        }
    }

    /// chi a sub-step on: (moved + S/2) / (g + Z/2).
    #[inline(always)]
    fn advance_memory(&mut self, state: &mut State, boost: &Boost) {
        let (nx, nz) = (state.nx, state.nz);
        let [x, y] = &self.tables;
        for Piece { j, x: run } in &self.edges {
            let ends = [run.end * usize::from(*j < nz - 1), run.end.min(nx - 1)];
            for (k, end) in ends.into_iter().enumerate() {
                let n = end.saturating_sub(run.start);
                let at = j * nx + run.start;
                let (gathered, moved) = (&self.gathered[k][at..][..n], &self.moved[k][at..][..n]);
                let (phi, out) = (&state.phi[k][at..][..n], &mut state.phi_next[k][at..][..n]);
                let along = if k == 0 { &x.edge } else { &x.node };
                let (along, across) = (&along[run.start..][..n], if k == 0 { y.node[*j] } else { y.edge[*j] });
                for i in 0..n {
                    let own = if k == 0 { along[i] } else { across };
                    let source = gathered[i] - (boost.gamma - 0.5 * own) * phi[i];
                    let next = flush((moved[i] + source) / (boost.gamma + 0.5 * own));
                    out[i] = if along[i] + across > 0.0 { next } else { 0.0 };
                }
            }
        }
    }

    #[inline(always)]
    fn advance_heights(&self, state: &mut State, tops: &mut [f32], boost: &Boost, s: &Surroundings) {
        let (tiles, k) = (s.tiles, s.coefficients);
        let nx = state.nx;
        let [x, y] = &self.tables;
        let [bx, bz] = boost.axes;
        let State { z, old, phi, phi_next, .. } = state;
        let z: &[f32] = z;
        let [px, pz, nx_, nz_]: [&[f32]; 4] = [&phi[0], &phi[1], &phi_next[0], &phi_next[1]];
        let square = |b: &Pull| b.gamma * b.gamma / boost.gamma;
        let damp = [square(&bx), square(&bz)];
        let [damped_x, damped_z] = [damp[0] * (1.0 + bx.beta * bx.beta), damp[1] * (1.0 + bz.beta * bz.beta)];
        for Piece { j, x: run } in &self.nodes {
            let j = *j;
            let (z2, e2) = (y.node[j], [y.edge[j], y.edge[j + 1]]);
            let (first, n) = (run.start, run.len());
            let at = j * nx + first;
            let [below, row, above] = [at - nx, at, at + nx].map(|at| &z[at - 1..][..n + 2]);
            let (south_west, south, south_east) = (&below[..n], &below[1..][..n], &below[2..][..n]);
            let (west, here, east) = (&row[..n], &row[1..][..n], &row[2..][..n]);
            let (north_west, north, north_east) = (&above[..n], &above[1..][..n], &above[2..][..n]);
            let (node, edge0, edge1) = (&x.node[first..][..n], &x.edge[first..][..n], &x.edge[first + 1..][..n]);
            let at_x = [px, nx_].map(|a| [&a[at..][..n], &a[at + 1..][..n]]);
            let at_z = [pz, nz_].map(|a| [&a[at..][..n], &a[at + nx..][..n]]);
            let old = &mut old[at..][..n];
            for i in 0..n {
                let (c, w, e, s, t) = (here[i], west[i], east[i], south[i], north[i]);
                let (sw, se, nw, ne) = (south_west[i], south_east[i], north_west[i], north_east[i]);
                let flux_w = k.straight[0] * (c - w) + k.beside[0] * ((t - nw) + (s - sw));
                let flux_e = k.straight[0] * (e - c) + k.beside[0] * ((ne - t) + (se - s));
                let flux_s = k.straight[1] * (c - s) + k.beside[1] * ((e - se) + (w - sw));
                let flux_n = k.straight[1] * (t - c) + k.beside[1] * ((ne - e) + (nw - w));
                // Mean of three sub-steps of waves across each axis.
                let mean = |c: f32, a: f32, low: f32, high: f32| c + 0.25 * a * ((low - c) + (high - c));
                let (in_x, in_z) = (mean(c, bz.a, s, t), mean(c, bx.a, w, e));
                let (mean_w, mean_e) = (mean(w, bz.a, sw, nw), mean(e, bz.a, se, ne));
                let (mean_s, mean_n) = (mean(s, bx.a, sw, se), mean(t, bx.a, nw, ne));
                let (z1, e1) = (node[i], [edge0[i], edge1[i]]);
                let drift = bx.v * (0.5 * (mean_e - mean_w));
                let drift_z = bz.v * (0.5 * (mean_n - mean_s));
                let [q_w, q_e] = [at_x[0][0][i] + at_x[1][0][i], at_x[0][1][i] + at_x[1][1][i]];
                let [q_s, q_n] = [at_z[0][0][i] + at_z[1][0][i], at_z[0][1][i] + at_z[1][1][i]];
                let plain = (flux_e - flux_w) + (flux_n - flux_s);
                let layer = 0.5 * ((q_e - q_w) / bx.gamma + (q_n - q_s) / bz.gamma);
                let along = (damp[0] * z1 - damp[1] * z2) * (drift_z - drift);
                let own_x = own(&bx, z1, e1, [q_w + q_e, drift, c], [mean_w, in_x, mean_e]);
                let own_z = own(&bz, z2, e2, [q_s + q_n, drift_z, c], [mean_s, in_z, mean_n]);
                let (half, corner) = (0.5 * (damped_x * z1 + damped_z * z2), 0.25 * z1 * z2);
                let keep = 1.0 - half + corner - k.damping;
                let still = keep * (c - old[i]) - 4.0 * corner * c;
                let rest = (plain + layer) + (along + (own_x + own_z));
                old[i] = flush(c + (still + rest) / (1.0 + half + corner + k.damping));
            }
            let (row, mut from) = (tiles.of(1, j) * tiles.count[0], first);
            while from < run.end {
                let tx = tiles.of(0, from);
                let end = tiles.span(0, tx).end.min(run.end);
                let top = &mut tops[row + tx];
                old[from - first..end - first].iter().for_each(|z| note(top, *z));
                from = end;
            }
        }
    }
}

/// Fills the ring of both heights on the sides behind with what is beside it, or clears it.
fn ring(state: &mut State, beta: [f64; 2], clear: bool) {
    let State { nx, nz, z, old, .. } = state;
    let (nx, nz) = (*nx, *nz);
    for z in [z, old] {
        if beta[0] != 0.0 {
            let (ring, inside) = if beta[0] > 0.0 { (0, 1) } else { (nx - 1, nx - 2) };
            for row in z.chunks_exact_mut(nx) {
                row[ring] = if clear { 0.0 } else { row[inside] };
            }
        }
        if beta[1] != 0.0 {
            let (ring, inside) = if beta[1] > 0.0 { (0, 1) } else { (nz - 1, nz - 2) };
            if clear {
                z[ring * nx..][..nx].fill(0.0);
            } else {
                z.copy_within(inside * nx..(inside + 1) * nx, ring * nx);
            }
        }
    }
}
