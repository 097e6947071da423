//! The rules by which a frame leaves work out: one function each, each with a switch.
//!
//! They say what is not worth doing and why; `planner.rs` asks them in turn.

use glam::{Vec2, Vec3};
use ocean_spectrum::Ocean;

use crate::desc::{Consumers, View};
use crate::grids::Grid;
use crate::plan::Reason;
use crate::planner::{Shown, ShownSea};
use crate::water::OpenWater;

bitflags::bitflags! {
    /// What may be left out ([`OpenWater::set_rules`]): all of it by default. To measure what each saves, and to look for
    /// one that is suspected of hiding something; none changes what is simulated.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Rules: u32 {
        /// Nothing is drawn while there are neither views nor consumers. GPU-homed grids are stepped all the same.
        const UNSEEN = 1;
        /// Filtered copies, normals and foam of the sea are not made where no consumer reads them. Exact.
        const UNASKED = 2;
        /// Grids whose waves have died down are not drawn: what would be drawn are zeros. Exact.
        const ASLEEP = 4;
        /// What was encoded for the same moment is not made again. Exact.
        const UNCHANGED = 8;
        /// The shortest cascades that no view resolves are left out: looks fade them out anyway where a pixel is as
        /// wide as they begin to repeat, and heights miss by less than a pixel of the view that sees best.
        const SHORT = 16;
        /// The sea is not made anew while the crests of its peak have moved by less than a quarter of the finest pixel: heights
        /// miss by less than .1 pixel rms.
        const STILL = 32;
        /// CPU-homed grids and dry hulls of which no view resolves anything are left out: looks fade such grids out anyway, their
        /// heights miss by less than a pixel.
        const FAR = 64;
        /// What no body and no fleet reads of the sea is not made on the CPU before a tick; queries make what they read. Exact.
        const UNREAD = 128;
    }
}

impl Default for Rules {
    fn default() -> Self {
        Self::all()
    }
}

/// Pixels that are as wide as so many cells of a grid show nothing of it: `grids_vertex` and `grids_look` in WGSL.
const CELLS_A_PIXEL: f32 = 32.0;
/// Pixels that the crests of the peak may move before the sea is made anew.
const STILL_PIXELS: f64 = 0.25;
/// Pixels that the significant height of what is left out may take: its highest crest then takes less than one.
const LOW_PIXELS: f32 = 0.5;

impl View {
    /// Width of a pixel on what is so many metres away; 0, as if all could be seen, where that is not known.
    pub(crate) fn pixel(&self, distance: f32) -> f32 {
        let width = distance.max(0.0) * self.pixel_angle;
        if width.is_finite() { width.max(0.0) } else { 0.0 }
    }
}

/// Width of the finest pixel that a view makes of what is `distance` metres from its eye at least; 0 without views.
fn finest(views: &[View], distance: impl Fn(Vec3) -> f32) -> f32 {
    let widths = views.iter().map(|view| view.pixel(distance(view.eye)));
    widths.reduce(f32::min).unwrap_or(0.0)
}

/// Rule [`Rules::UNSEEN`].
pub(crate) fn unseen(rules: Rules, views: &[View], consumers: Consumers) -> bool {
    rules.contains(Rules::UNSEEN) && views.is_empty() && consumers.is_empty()
}

/// Rule [`Rules::UNASKED`]: whether looks are made.
pub(crate) fn looks(rules: Rules, consumers: Consumers) -> bool {
    !rules.contains(Rules::UNASKED) || consumers.intersects(Consumers::NORMALS | Consumers::FOAM)
}

/// Width of the finest pixel of any view on the nearest water, metres: that below the eye's own height over the crests.
pub(crate) fn pixel_on_water(views: &[View], level: f32, crests: f32) -> f32 {
    finest(views, |eye| (eye.y - level).abs() - crests)
}

/// Rule [`Rules::SHORT`]: how many cascades, the longest first, are made at time `t`. One stays.
pub(crate) fn cascades(rules: Rules, ocean: &Ocean, t: f64, pixel: f32, looks: bool) -> usize {
    let (modes, changing) = ocean.mode_sets_at(t);
    let all = modes.len();
    // While the sea changes its heights are those of neither.
    if !rules.contains(Rules::SHORT) || changing.is_some() || ocean.modes().len() != all || pixel == 0.0 {
        return all;
    }
    let fades = |c: &usize| !looks || pixel >= open_water_shaders::surface::SHADING_END * modes[*c].tile;
    let low = |c: &usize| ocean.significant_height_of(*c..all) < LOW_PIXELS * pixel;
    let left_out = (1..all).rev().take_while(|c| fades(c) && low(c)).count();
    all - left_out
}

/// Rules [`Rules::UNCHANGED`] and [`Rules::STILL`]: why what is shown will do at time `t` with looks or without.
pub(crate) fn sea_stands(
    rules: Rules,
    ocean: &Ocean,
    (t, pixel, looks): (f64, f32, bool),
    cascades: usize,
    shown: Option<ShownSea>,
) -> Option<Reason> {
    let shown = shown.filter(|shown| shown.cascades >= cascades && (shown.looks || !looks))?;
    if rules.contains(Rules::UNCHANGED) && shown.time == t {
        return Some(Reason::Unchanged);
    }
    let still = || {
        let moved = (t - shown.time).abs() * f64::from(ocean.peak_phase_speed());
        ocean.moment_at(t).sets == shown.sets && shown.sets[1] == 0 && moved < STILL_PIXELS * f64::from(pixel)
    };
    (rules.contains(Rules::STILL) && shown.time != t && still()).then_some(Reason::Still)
}

/// Rule [`Rules::ASLEEP`].
pub(crate) fn asleep(rules: Rules, grid: &Grid) -> bool {
    rules.contains(Rules::ASLEEP) && !grid.is_awake()
}

/// Rule [`Rules::FAR`] for a CPU-homed grid. Those on the GPU are drawn for what comes back of them.
pub(crate) fn far(rules: Rules, grid: &Grid, views: &[View], level: f32) -> bool {
    if !rules.contains(Rules::FAR) || grid.repeats() {
        return false;
    }
    let window = grid.window();
    let size = Vec2::from(window.cell_size) * Vec2::new(window.cells[0] as f32, window.cells[1] as f32);
    let low = window.local_corner(grid.origin);
    let pixel = finest(views, |eye| {
        let flat = Vec2::new(eye.x, eye.z);
        let off = (low - flat).max(flat - low - size).max(Vec2::ZERO);
        off.length().hypot(eye.y - level)
    });
    pixel >= CELLS_A_PIXEL * window.cell_size[0].min(window.cell_size[1])
        && grid.largest_within(low, low + size) < LOW_PIXELS * pixel
}

/// Rule [`Rules::FAR`] for a dry hull of that size at a place.
pub(crate) fn hull_far(rules: Rules, views: &[View], place: Vec3, size: f32) -> bool {
    rules.contains(Rules::FAR) && size < finest(views, |eye| eye.distance(place) - size)
}

impl OpenWater {
    /// Says what frames may leave out: all that the rules know by default.
    pub fn set_rules(&mut self, rules: Rules) {
        self.rules = rules;
    }

    /// What frames may leave out.
    pub fn rules(&self) -> Rules {
        self.rules
    }
}

impl Shown {
    /// Rule [`Rules::UNCHANGED`] for a grid.
    pub(crate) fn has_grid(&self, rules: Rules, grid: &Grid, moment: (u64, f32)) -> bool {
        rules.contains(Rules::UNCHANGED) && self.grids == Some(moment) && self.listed.contains(&grid.id)
    }
}
