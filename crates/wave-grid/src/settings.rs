//! What a grid is told besides sources: what it lies in, which sides are fed.

use std::sync::Arc;

use glam::DVec2;

use crate::cpu::ghosts;
use crate::cpu::tiles::Class;
use crate::feed::{Feed, FeedLine};
use crate::ground::{Cells, Ground};
use crate::medium::{CellLaw, Medium, SharedMedium};
use crate::state::State;
use crate::{Border, Edges, WaveGrid};

impl WaveGrid {
    /// Sets what the water lies in; `None` (default) is open deep water everywhere. May change while waves run: those in
    /// what becomes wall or held water are let go, what a wall leaves behind is calm. A grid that repeats takes none, nor does
    /// [`crate::Scheme::Spectral`].
    pub fn set_medium(&mut self, medium: Option<Arc<dyn Medium>>) {
        let medium = medium.filter(|_| self.desc.border != Border::Periodic && self.spectral.is_none());
        let law = self.cell_law();
        let corner = self.place.window.corner;
        // The ghosts of the old walls go, then whatever stands in the new ones.
        self.dry_walls();
        for tile in &mut self.tiles.tiles {
            tile.class = Class::Plain;
        }
        let ground = medium.map(|medium| Ground::new(SharedMedium(medium), law, corner, &mut self.tiles));
        self.ground = ground.map(Arc::new);
        self.dry_walls();
        if let Some(cells) = self.ground.as_ref().and_then(|ground| ground.cells.as_ref()) {
            let State { z, old, previous, .. } = &mut self.state;
            ghosts::fill([z, old, previous], &self.tiles, cells);
        }
        self.renew_feed();
    }

    /// What turns a medium into coefficients.
    pub(crate) fn cell_law(&self) -> CellLaw {
        CellLaw::new(&self.desc, &self.stepping, self.fields.as_ref().map(|fields| fields.table.clone()))
    }

    /// Reads the medium anew.
    pub(crate) fn read_ground(&mut self) {
        if let Some(ground) = self.ground.take() {
            let corner = self.place.window.corner;
            let ground = Ground::new(ground.medium.clone(), ground.law.clone(), corner, &mut self.tiles);
            self.ground = Some(Arc::new(ground));
        }
    }

    /// The medium's cells, where it is felt at all.
    pub(crate) fn cells(&self) -> Option<&Cells> {
        self.ground.as_ref()?.cells.as_ref()
    }

    /// Nothing stands in walls and held water, nothing flows through their faces.
    pub(crate) fn dry_walls(&mut self) {
        if let Some(cells) = self.ground.as_ref().and_then(|ground| ground.cells.as_ref()) {
            self.state.dry_walls(cells);
            if let Some(fields) = &mut self.fields {
                fields.dry_walls(cells);
            }
        }
    }

    /// Sets which sides of the window waves are fed through by [`Self::tick_fed`]; none by default. On those sides the
    /// drawn height fades to zero at the contour instead of the window's edge. A border that absorbs nothing takes none, nor does
    /// another scheme than the wave equation.
    pub fn set_feed(&mut self, edges: Edges) {
        let takes = !self.desc.border.has_ring() && self.desc.scheme.is_wave_equation();
        let edges = if takes { edges } else { Edges::default() };
        self.place.fed = edges;
        self.feed = edges.any().then(|| self.new_feed(edges));
        self.update_fade();
    }

    pub(crate) fn new_feed(&self, edges: Edges) -> Feed {
        Feed::new(edges, &self.desc, &self.stepping, &self.place.window, self.cells())
    }

    /// Reads anew what feeds know of window and medium.
    pub(crate) fn renew_feed(&mut self) {
        if let Some(edges) = self.feed.as_ref().map(|feed| feed.edges) {
            self.feed = Some(self.new_feed(edges));
        }
    }

    /// Where the incident heights of [`Self::tick_fed`] are asked for, one line a fed side in the order of [`Edges`]'
    /// fields. They change with the window, the medium and [`Self::set_feed`].
    pub fn feed_lines(&self) -> Vec<FeedLine> {
        self.feed.iter().flat_map(Feed::lines).collect()
    }

    /// The fade as drawn, 0 to 1, at a world point: 0 outside the window and outside the contour of fed sides.
    pub fn fade_at(&self, world: DVec2) -> f32 {
        let at = world / self.place.window.h();
        let fade = |axis: usize, x: f64| self.place.fade_of(axis, x - self.place.window.corner[axis] as f64);
        fade(0, at.x) * fade(1, at.y)
    }
}
