//! Land: the bed, walls, beaches and shelter, as maps in the world that all grids and the ambient sea read.
//!
//! A grid reads the maps wherever its window is: speed from the depth, walls from obstacles and dry land, damping on the
//! beach. The ambient sea cannot slow or bend; near land its amplitudes fall with depth and shelter, and a fixed grid
//! that is fed through its edges takes over the waves that it can carry. Bodies touch the
//! bed and the obstacles; those of a physics engine are left to the engine.

mod bake;
mod depth;
mod feed;
mod polygon;
mod reach;
mod shore;
mod solid;
mod terrain;

use glam::DVec2;

use crate::OpenWaterError;

pub(crate) use bake::{Baked, Carrier, bake};
pub use depth::{DepthMap, DepthScale};
pub(crate) use feed::Feeding;
pub(crate) use shore::{Shore, ShoreMark, Turning};
pub(crate) use terrain::Terrain;

/// Land around and under the water. The default of every field but the bed is none.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Land {
    /// The bed and the ground above it. Where it is dry, grids have a reflecting wall.
    pub bed: DepthMap,
    /// Walls that the raster is too coarse for: quays, breakwaters.
    pub obstacles: Vec<Obstacle>,
    /// Outlines (world x, z) inside which there is no water, such as a dry dock below sea level.
    pub no_water: Vec<Vec<DVec2>>,
    /// What takes the waves' energy.
    pub damping: Damping,
    /// How land calms the ambient sea behind it.
    pub shelter: Shelter,
}

impl Land {
    /// Land made of a bed alone, with a beach that breaks waves and shelter computed from it.
    pub fn new(bed: DepthMap) -> Self {
        let (obstacles, no_water) = (Vec::new(), Vec::new());
        Self { bed, obstacles, no_water, damping: Damping::default(), shelter: Shelter::default() }
    }
}

/// A wall with an outline of its own.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Obstacle {
    /// Corners in order (world x, z); the inside is the wall.
    pub outline: Vec<DVec2>,
    /// What it does to waves.
    pub kind: ObstacleKind,
}

/// What a wall does to the waves of grids.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ObstacleKind {
    /// No water passes: waves are reflected upright, as by a real wall.
    #[default]
    Reflecting,
    /// The height is held at 0, as in Yang et al. 2017: waves are reflected upside down.
    Fixed,
}

/// Damping of a grid's waves, `z_tt + sigma z_t = ...`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Damping {
    /// Waves break where it is shallow: sigma = rate (1 - depth/surf_depth)^2.
    Beach {
        /// Depth where it begins, metres, 0 to 100.
        surf_depth: f32,
        /// sigma at the waterline, 1/s, 0 to 10.
        rate: f32,
    },
    /// sigma at every pixel of the bed, 1/s, 0 to 10.
    Given(Vec<f32>),
}

impl Default for Damping {
    /// Waves die within a few of their lengths on a slope of 1 in 20.
    fn default() -> Self {
        Self::Beach { surf_depth: 1.5, rate: 1.5 }
    }
}

/// How land calms the ambient sea.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shelter {
    /// From the map: of the waves of each direction, those arrive that no land blocks.
    #[default]
    Reach,
    /// Factor on the amplitude at every pixel of the bed, 0 to 1.
    Given(Vec<f32>),
    /// Not at all.
    None,
}

impl Land {
    /// Checks what the maps do not check themselves.
    pub(crate) fn check(&self) -> Result<(), OpenWaterError> {
        let invalid =
            |field, value: f32, bound| Err(OpenWaterError::InvalidValue { field, value: value.into(), bound });
        match &self.damping {
            Damping::Beach { surf_depth, rate } => {
                if !(0.0..=100.0).contains(surf_depth) {
                    return invalid("surf_depth", *surf_depth, "0 to 100 m");
                }
                if !(0.0..=10.0).contains(rate) {
                    return invalid("rate", *rate, "0 to 10 1/s");
                }
            }
            Damping::Given(values) => self.check_raster("damping map", "sigma", values, 10.0, "0 to 10 1/s")?,
        }
        match &self.shelter {
            Shelter::Given(values) => self.check_raster("shelter map", "factor", values, 1.0, "0 to 1"),
            Shelter::Reach | Shelter::None => Ok(()),
        }
    }

    fn check_raster(
        &self,
        map: &str,
        field: &'static str,
        values: &[f32],
        most: f32,
        bound: &'static str,
    ) -> Result<(), OpenWaterError> {
        let map = map.to_owned();
        if values.len() != self.bed.elevations().len() {
            let (field, value) = ("number of values", values.len() as f64);
            return Err(OpenWaterError::Map { map, field, value, bound: "one for every pixel of the bed" });
        }
        match values.iter().position(|v| !(0.0..=most).contains(v)) {
            None => Ok(()),
            Some(at) => {
                let nx = self.bed.size()[0];
                let pixel = [at as u32 % nx, at as u32 / nx];
                Err(OpenWaterError::MapPixel { map, field, pixel, value: values[at].into(), bound })
            }
        }
    }
}
