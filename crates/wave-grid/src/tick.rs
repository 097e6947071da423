//! A tick: which tiles are stepped, sub-steps, foam; and what is kept to draw between two ticks.

use crate::cpu::boost::Motion;
use crate::cpu::current::Carrier;
use crate::cpu::step::{Keep, Setting};
use crate::cpu::tiles::Mode;
use crate::feed::{Feed, Incident};
use crate::ground::{Cells, REACH};
use crate::{Border, WaveGrid, cpu};

impl WaveGrid {
    /// Advances by one tick. A grid at rest returns at once.
    pub fn tick(&mut self) {
        self.advance(None);
    }

    /// Advances by one tick with waves entering through the sides of [`Self::set_feed`]. For each line (by its index in
    /// [`Self::feed_lines`]) and sub-step, `incident` writes the heights of the incident waves as the sub-step
    /// begins: at the points outside the contour and at those inside. What is not finite counts as zero.
    pub fn tick_fed(&mut self, incident: &mut Incident) {
        // Not in its place while the state is written.
        let mut feed = self.feed.take();
        self.advance(feed.as_mut().map(|feed| (feed, incident)));
        self.feed = feed;
    }

    fn advance(&mut self, mut fed: Option<(&mut Feed, &mut Incident)>) {
        self.capture();
        self.drift.note(&self.place, &self.stepping);
        if let Some((feed, incident)) = &mut fed {
            feed.ask(incident, 0);
            feed.wake(&mut self.tiles, self.state.nx);
        }
        if self.skipping && self.at_rest() {
            return;
        }
        if self.skipping && (self.spectral.is_none() || self.tiles.asleep()) {
            self.desc.border.schedule(&mut self.tiles);
        } else {
            self.tiles.activate_all();
        }
        for tz in 0..self.tiles.count[1] {
            for tx in 0..self.tiles.count[0] {
                if self.tiles.row(tz)[tx].mode == Mode::Ending {
                    self.keep(tx, tz);
                    self.state.clear_cells(self.tiles.span(0, tx), self.tiles.span(1, tz));
                    if let Some(fields) = &mut self.fields {
                        fields.clear_cells(self.tiles.span(0, tx), self.tiles.span(1, tz));
                    }
                    self.captured = false;
                }
            }
        }
        if self.tiles.active == 0 {
            if let Some(spectral) = &mut self.spectral {
                spectral.clear();
            }
            return;
        }
        if self.spectral.is_some() {
            self.advance_spectrum();
            return;
        }
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        if self.carrier.is_none() && cells.is_some_and(Cells::drifts) {
            self.carrier = Some(Carrier::new([self.state.nx, self.state.nz], self.profile.thickness));
        }
        self.tops.resize(self.tiles.tiles.len(), 0.0);
        if let Some(layer) = self.fields.as_mut().and_then(|fields| fields.layer.as_mut()) {
            layer.move_with(self.drift.beta(), self.stepping.root_time());
        }
        let moves = self.moving
            && self.desc.scheme.is_wave_equation()
            && matches!(self.desc.border, Border::Absorbing { .. })
            && self.matched
            && fed.is_none()
            && self.tiles.all_plain();
        for substep in 0..self.stepping.substeps {
            // After a tick of one sub-step the older state is that of the tick before, but where it was carried on.
            let keep = match (substep, self.stepping.substeps) {
                (0, 1) => Keep::Carried,
                (0, _) => Keep::All,
                _ => Keep::Nothing,
            };
            if let Some(fields) = &mut self.fields {
                let setting = cpu::dispersive::step::Setting {
                    level: self.level,
                    tiles: &self.tiles,
                    border: self.desc.border,
                    cells,
                    keep,
                };
                cpu::dispersive::step::step(&mut self.state, fields, &mut self.tops, &setting);
                self.tiles.note(&self.tops);
                if substep == 0 {
                    self.tiles.note_kept(keep == Keep::All);
                }
                continue;
            }
            let setting = Setting {
                level: self.level,
                tiles: &self.tiles,
                axes: &self.axes,
                thickness: self.profile.thickness,
                coefficients: self.coefficients,
                cells,
                keep,
                a: self.stepping.a,
                moves,
            };
            self.desc.border.fill_ring(&mut self.state.z, [self.state.nx, self.state.nz]);
            let held = self.drift.held;
            let mut motion = Motion::default();
            let mut moving = None;
            if moves || held != motion.beta {
                let (around, layer) = (setting.surroundings(), self.layer.get_or_insert_default());
                if moves {
                    motion = self.drift.motion(&self.place, substep, self.stepping.substeps);
                }
                if substep == 0 {
                    layer.prepare(&self.state, &around);
                    if motion.beta != held {
                        layer.turn(&mut self.state, held, &motion, &around);
                        self.drift.held = motion.beta;
                    }
                }
                moving = moves.then_some((layer, &motion));
            }
            cpu::step::step(&mut self.state, &mut self.tops, &setting, moving);
            self.tiles.note(&self.tops);
            if substep == 0 {
                self.tiles.note_kept(keep == Keep::All);
            }
            if let Some((feed, incident)) = &mut fed {
                if substep > 0 {
                    feed.ask(incident, substep);
                }
                feed.correct(&mut self.state.z);
            }
            if let (Some(carrier), Some(cells)) = (&mut self.carrier, cells.filter(|cells| cells.drifts())) {
                carrier.carry([&mut self.state.z, &mut self.state.old], &self.tiles, cells);
            }
        }
        if let Some(cells) = cells {
            cpu::ghosts::fill([&mut self.state.z, &mut self.state.old], &self.tiles, cells);
        }
        if fed.is_some() || self.carrier.is_some() {
            // What was fed and carried is not in the tops.
            cpu::foam::measure(&self.state, &mut self.tiles, fed.is_some());
        }
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        cpu::foam::settle(&mut self.state, &mut self.tiles, cells, self.law);
        if self.desc.border.has_ring() {
            self.desc.border.fill_rings(&mut self.state);
        }
        self.captured = false;
    }

    /// A tick of the spectral scheme: no tile is left out, nothing else is felt.
    fn advance_spectrum(&mut self) {
        if self.stepping.substeps > 1 {
            self.keep_around(self.desc.cells.map(|n| [0, n as usize]));
        }
        if let Some(spectral) = &mut self.spectral {
            for _ in 0..self.stepping.substeps {
                spectral.step(&self.state.z, &mut self.state.old);
                std::mem::swap(&mut self.state.z, &mut self.state.old);
            }
        }
        cpu::foam::measure(&self.state, &mut self.tiles, true);
        cpu::foam::settle(&mut self.state, &mut self.tiles, None, self.law);
        self.desc.border.fill_rings(&mut self.state);
        self.captured = false;
    }

    /// From now on what stands is drawn as the tick before.
    pub(crate) fn capture(&mut self) {
        if !self.captured {
            self.tiles.forget_kept();
            self.captured = true;
        }
    }

    /// Keeps the heights of the tiles that a source changes, as drawn for the tick before.
    pub(crate) fn keep_around(&mut self, [x, z]: [[usize; 2]; 2]) {
        // Walls within reach of a cubic kernel show the water beside them.
        let by = if self.cells().is_some() { REACH } else { 0 };
        let tiles = |axis: usize, [first, end]: [usize; 2]| {
            let last = (end - 1 + by).min(self.tiles.cells[axis] - 1);
            self.tiles.of(axis, first.saturating_sub(by))..=self.tiles.of(axis, last)
        };
        let (columns, rows) = (tiles(0, x), tiles(1, z));
        for tz in rows {
            for tx in columns.clone() {
                self.keep(tx, tz);
            }
        }
    }

    fn keep(&mut self, tx: usize, tz: usize) {
        let tile = &mut self.tiles.tiles[tz * self.tiles.count[0] + tx];
        if !tile.kept {
            tile.kept = true;
            self.state.keep_cells(self.tiles.span(0, tx), self.tiles.span(1, tz));
        }
    }

    /// What is drawn as the tick before, where the tiles have not kept it.
    pub(crate) fn before(&self) -> &[f32] {
        if self.captured { &self.state.z } else { &self.state.old }
    }

    /// What is drawn as the tick before.
    pub(crate) fn drawn_before(&self) -> Vec<f32> {
        let mut heights = self.before().to_vec();
        for tz in 0..self.tiles.count[1] {
            for tx in (0..self.tiles.count[0]).filter(|tx| self.tiles.row(tz)[*tx].kept) {
                for j in self.tiles.span(1, tz) {
                    let x = self.tiles.span(0, tx);
                    let row = j * self.state.nx + x.start..j * self.state.nx + x.end;
                    heights[row.clone()].copy_from_slice(&self.state.previous[row]);
                }
            }
        }
        heights
    }
}
