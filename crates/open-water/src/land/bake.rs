//! From land to the raster that the ambient sea, the composite surface and the renderer read, on the bed's pixels.
//!
//! Each cascade's amplitude is scaled by three factors: what reaches the place past the land, what its depth lets stand
//! (TMA and breaking), and what no grid has taken over. All are made anew when land, water level or fed grids change.

use std::sync::Arc;

use glam::DVec2;
use ocean_spectrum::Ocean;
use rayon::prelude::*;
use wave_grid::WaveGrid;

use super::reach::{SECTORS, reach};
use super::{Shelter, Terrain};
use crate::OpenWaterError;

/// Factors per pixel: one for each cascade that a sea may have.
pub(crate) type Factors = [f32; open_water_shaders::surface::MAX_CASCADES];

/// Distance from a wall within which foam may gather, metres.
#[cfg(feature = "gpu")]
const WALL_REACH: f64 = 4.0;
/// Depths at which the factors of depth are computed, metres: geometric between.
const DEPTHS: (f32, f32, usize) = (0.05, 300.0, 96);

/// A fed grid: it shows the waves of the first cascades instead of the ambient sea.
pub(crate) struct Carrier<'a> {
    pub(crate) grid: &'a WaveGrid,
    /// How many of the longest cascades it carries.
    pub(crate) cascades: usize,
}

/// Maps of the bed's pixels.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Baked {
    /// Factor on the amplitude of each cascade.
    pub(crate) factors: Vec<Factors>,
    /// The same of the longest cascade, before grids took it over: what a fed edge lets in.
    pub(crate) incoming: Vec<f32>,
    /// (bed above the datum in metres, 1 or 0 where there is no water, nearness of a wall 0 to 1, 0).
    #[cfg(feature = "gpu")]
    pub(crate) ground: Vec<[f32; 4]>,
}

/// Makes the maps.
pub(crate) fn bake(terrain: &Terrain, ocean: Option<&Ocean>, carriers: &[Carrier]) -> Baked {
    let size = terrain.bed().size();
    let nx = size[0] as usize;
    let places = |at: usize| terrain.bed().place([at % nx, at / nx]);
    let count = terrain.bed().elevations().len();
    let mut baked = Baked::default();
    #[cfg(feature = "gpu")]
    baked.ground.par_extend((0..count).into_par_iter().map(|at| ground(terrain, at, places(at))));
    let Some(ocean) = ocean else { return baked };
    let cascades = ocean.modes().len();
    let sheltered = shelter(terrain, ocean, count, places);
    let depths = DepthTable::new(ocean);
    let open: Vec<Factors> = (0..count)
        .into_par_iter()
        .map(|at| {
            let depth = depths.at(terrain.level - terrain.bed().elevations()[at]);
            std::array::from_fn(|c| if c < cascades { depth[c] * sheltered(c, at) } else { 1.0 })
        })
        .collect();
    baked.incoming = open.iter().map(|f| f[0]).collect();
    baked.factors = open;
    for carrier in carriers {
        baked.factors.par_iter_mut().enumerate().for_each(|(at, factors)| {
            let left = 1.0 - carrier.grid.fade_at(places(at));
            factors.iter_mut().take(carrier.cascades).for_each(|f| *f *= left);
        });
    }
    baked
}

impl Baked {
    /// Whether they are of so many pixels.
    pub(crate) fn is_of(&self, pixels: usize) -> bool {
        self.factors.len() == pixels && self.incoming.len() == pixels
    }

    /// The same with what only the GPU reads, which bytes do not hold.
    pub(crate) fn whole(maps: &Arc<Self>, terrain: &Terrain) -> Arc<Self> {
        #[cfg(feature = "gpu")]
        if maps.ground.is_empty() {
            let (nx, count) = (terrain.bed().size()[0] as usize, terrain.bed().elevations().len());
            let ground = |at: usize| ground(terrain, at, terrain.bed().place([at % nx, at / nx]));
            return Arc::new(Self { ground: (0..count).into_par_iter().map(ground).collect(), ..(**maps).clone() });
        }
        let _ = terrain;
        Arc::clone(maps)
    }

    /// The factors `share` of the way from these to those of another sea on the same land.
    pub(crate) fn towards(&self, to: &Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + share * (b - a);
        let mut baked = to.clone();
        for (factors, from) in baked.factors.iter_mut().zip(&self.factors) {
            factors.iter_mut().zip(from).for_each(|(to, from)| *to = mix(*from, *to));
        }
        baked.incoming.iter_mut().zip(&self.incoming).for_each(|(to, from)| *to = mix(*from, *to));
        baked
    }

    /// The maps of two seas for the cascades that both have on the way from one to the other; a cascade that one of them has
    /// not has the other's.
    pub(crate) fn placed(maps: [&Self; 2], places: &[[Option<usize>; 2]]) -> [Self; 2] {
        std::array::from_fn(|which| {
            let mut placed = maps[which].clone();
            for (at, factors) in placed.factors.iter_mut().enumerate() {
                *factors = Factors::default().map(|_| 1.0);
                for (factor, place) in factors.iter_mut().zip(places) {
                    let own = place[which].map(|c| (which, c)).or(place[1 - which].map(|c| (1 - which, c)));
                    if let Some((map, c)) = own {
                        *factor = maps[map].factors.get(at).map_or(1.0, |factors| factors[c]);
                    }
                }
            }
            placed
        })
    }
}

#[cfg(feature = "gpu")]
impl Baked {
    /// As the composite surface reads it.
    pub(crate) fn texels(&self, bed: &super::DepthMap) -> crate::gpu::land::LandTexels {
        let factors = |first: usize| match self.factors.is_empty() {
            true => vec![[1.0; 4]; self.ground.len()],
            false => self.factors.iter().map(|f| std::array::from_fn(|c| f[first + c])).collect(),
        };
        let layers = [factors(0), factors(4), self.ground.clone()];
        crate::gpu::land::LandTexels { corner: bed.corner(), texel: bed.texel(), size: bed.size(), layers }
    }
}

#[cfg(feature = "gpu")]
fn ground(terrain: &Terrain, at: usize, place: DVec2) -> [f32; 4] {
    let near = 1.0 - terrain.wall_distance(place, WALL_REACH) / WALL_REACH;
    let open = f32::from(u8::from(!terrain.is_kept_dry(place)));
    [terrain.bed().elevations()[at], open, near as f32, 0.0]
}

/// Factor on the amplitude of a cascade at a pixel, for what reaches it.
fn shelter(
    terrain: &Terrain,
    ocean: &Ocean,
    count: usize,
    places: impl Fn(usize) -> DVec2 + Sync,
) -> impl Fn(usize, usize) -> f32 + Sync {
    let maps = match terrain.shelter() {
        Shelter::None => Vec::new(),
        Shelter::Given(factors) => vec![factors.clone(); ocean.modes().len()],
        Shelter::Reach => {
            let wet: Vec<bool> = (0..count).into_par_iter().map(|at| terrain.is_wet(places(at))).collect();
            let shares: Vec<_> = (0..ocean.modes().len()).map(|c| ocean.directional_energy(c, SECTORS)).collect();
            let mut maps = reach(&wet, terrain.bed().size(), &shares);
            maps.iter_mut().flatten().for_each(|variance| *variance = variance.clamp(0.0, 1.0).sqrt());
            maps
        }
    };
    move |cascade, at| maps.get(cascade).map_or(1.0, |map| map[at])
}

/// Factors of depth, tabulated.
struct DepthTable(Vec<Factors>);

impl DepthTable {
    fn new(ocean: &Ocean) -> Self {
        let (least, most, count) = DEPTHS;
        let step = libm::logf(most / least) / (count - 1) as f32;
        Self((0..count).into_par_iter().map(|i| ocean.depth_factors(least * libm::expf(step * i as f32))).collect())
    }

    fn at(&self, depth: f32) -> Factors {
        let (least, most, count) = DEPTHS;
        if depth <= least {
            return [0.0; size_of::<Factors>() / size_of::<f32>()];
        }
        let x = (libm::logf(depth / least) / libm::logf(most / least) * (count - 1) as f32).min((count - 1) as f32);
        let low = (x as usize).min(count - 2);
        let t = x - low as f32;
        std::array::from_fn(|c| self.0[low][c] + t * (self.0[low + 1][c] - self.0[low][c]))
    }
}

impl Carrier<'_> {
    /// How many of the longest cascades a grid can carry: those whose shortest wave has six cells.
    pub(crate) fn capacity(ocean: &Ocean, cell_size: [f32; 2]) -> usize {
        let fits = |top: f64| std::f64::consts::TAU / top >= 6.0 * f64::from(cell_size[0].max(cell_size[1]));
        ocean.modes().iter().take_while(|modes| fits(modes.band[1].min(f64::MAX))).count()
    }

    /// Whether the grid's window lies on the map, as the ambient sea makes room for it there only.
    pub(crate) fn check(&self, terrain: &Terrain) -> Result<(), OpenWaterError> {
        let window = self.grid.window();
        let low = window.world_corner();
        let extent = glam::UVec2::from(window.cells).as_dvec2() * glam::Vec2::from(window.cell_size).as_dvec2();
        let (first, last) = (terrain.bed().corner(), terrain.bed().far_corner());
        let out = (first - low).max(low + extent - last).max_element();
        if out > 0.0 {
            let bound = "0 m: a fed grid's window must lie on the depth map";
            return Err(OpenWaterError::InvalidValue {
                field: "feed: metres outside the depth map",
                value: out,
                bound,
            });
        }
        if self.cascades == 0 {
            let bound = "a sixth of the shortest wave of the longest cascade, or less";
            let value = f64::from(window.cell_size[0].max(window.cell_size[1]));
            return Err(OpenWaterError::InvalidValue { field: "feed: cell_size", value, bound });
        }
        Ok(())
    }
}
