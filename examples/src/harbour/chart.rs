//! The depth map, and the land made of it.

use std::path::Path;

use glam::{DVec2, Vec2};
use open_water::{
    Damping, DepthMap, DepthScale, Edges, Follow, GridDesc, Land, Obstacle, ObstacleKind, Preset, Scheme,
};

use super::ground::Extent;
use super::plan::{
    ARM_PROFILE, JETTY, JETTY_HALF_WIDTH, MAP_METRES_PER_LEVEL, MAP_SEA_LEVEL, MAP_TEXEL, NORTH_ARM, QUAY_HIGH,
    QUAY_LOW, SOUTH_ARM, arm_outline, walls,
};
use crate::{Mark, SceneError};

/// Cells of the basin's grid, its cell size and its centre, metres.
const BASIN: ([u32; 2], f32, DVec2) = ([328, 344], 1.0, DVec2::new(4.0, 2.0));

/// How a map of this many pixels is read: its middle is the harbour's.
fn scale(size: [u32; 2]) -> DepthScale {
    let half = DVec2::new(f64::from(size[0]), f64::from(size[1])) * (0.5 * f64::from(MAP_TEXEL));
    DepthScale { metres_per_level: MAP_METRES_PER_LEVEL, sea_level: MAP_SEA_LEVEL, texel: MAP_TEXEL, corner: -half }
}

/// Reads a depth map: the file, or the harbour's own.
///
/// # Errors
/// The file is bad; the error names it, and the pixel.
pub fn depth_map(path: Option<&Path>) -> Result<DepthMap, SceneError> {
    let map = match path {
        // A file whose size cannot be read is refused below.
        Some(path) => DepthMap::from_png(path, &scale(image::image_dimensions(path).map_or([2; 2], Into::into))),
        None => {
            let bytes = include_bytes!("../../assets/harbour/depth.png");
            let levels = image::load_from_memory(bytes).map_err(SceneError::usage)?.into_luma16();
            let size = levels.dimensions().into();
            let height = |level: &u16| (f32::from(*level) - f32::from(MAP_SEA_LEVEL)) * MAP_METRES_PER_LEVEL;
            DepthMap::new(scale(size).corner, MAP_TEXEL, size, levels.as_raw().iter().map(height).collect())
        }
    };
    map.map_err(SceneError::usage)
}

/// The rectangle that a map covers.
pub fn extent(map: &DepthMap) -> Extent {
    Extent { low: map.corner().as_vec2(), high: map.far_corner().as_vec2(), step: map.texel() }
}

/// The land: the bed, breakwaters and quay as walls, a beach that breaks waves.
pub fn land(bed: DepthMap) -> Land {
    let wall = |outline| Obstacle { outline, kind: ObstacleKind::Reflecting };
    Land {
        obstacles: walls().into_iter().map(wall).collect(),
        damping: Damping::Beach { surf_depth: 2.0, rate: 1.5 },
        ..Land::new(bed)
    }
}

/// The grid of the basin, which the sea enters from the west: waves of `period` seconds are as fast in it as they are.
pub fn basin(preset: Preset, period: f32) -> GridDesc {
    let (cells, cell_size, center) = BASIN;
    GridDesc {
        follow: Follow::Fixed(center),
        cells,
        cell_size: [cell_size; 2],
        scheme: Scheme::NinePoint,
        wave_speed: (1.56 * period).clamp(6.0, 16.0),
        feed: Edges { low_x: true, low_z: true, high_z: true, ..Edges::default() },
        ..preset.grid()
    }
}

/// The works as flat shapes, each convex.
pub fn marks() -> Vec<Mark> {
    let quad = |low: Vec2, high: Vec2, color| Mark {
        outline: vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)],
        color,
    };
    let (low, high) = (JETTY[0].min(JETTY[1]), JETTY[0].max(JETTY[1]));
    let side = Vec2::Y * JETTY_HALF_WIDTH;
    let mut marks = vec![quad(QUAY_LOW, QUAY_HIGH, [164, 160, 150]), quad(low - side, high + side, [126, 102, 74])];
    for axis in [&NORTH_ARM, &SOUTH_ARM] {
        for (half, color) in [(ARM_PROFILE[1].0, [112, 108, 102]), (ARM_PROFILE[0].0, [176, 172, 162])] {
            let outline = arm_outline(axis, half);
            let (n, last) = (axis.len(), outline.len() - 1);
            for i in 0..n - 1 {
                let corners = [i, i + 1, last - i - 1, last - i].map(|k| outline[k]).to_vec();
                marks.push(Mark { outline: corners, color });
            }
            marks.push(Mark { outline: outline[n - 1..=last + 1 - n].to_vec(), color });
        }
    }
    marks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harbour::elevation;

    #[test]
    fn the_committed_file_reads_as_the_harbour() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/harbour/depth.png");
        let file = depth_map(Some(&path)).unwrap();
        assert_eq!(file, depth_map(None).unwrap());
        assert_eq!((file.size(), file.corner()), ([256, 256], DVec2::splat(-256.0)));
        for p in [(-250.0, 10.0), (0.0, 0.0), (120.0, 30.0), (200.0, -100.0)] {
            let p = Vec2::from(p);
            let (map, ground) = (file.elevation(p.as_dvec2()), elevation(p));
            assert!((map - ground).abs() < 0.006, "{map} for {ground} at {p}");
        }
    }

    #[test]
    fn bad_maps_are_named() {
        let error = depth_map(Some(Path::new("nowhere.png"))).unwrap_err();
        assert!(error.to_string().contains("nowhere.png"), "{error}");
        assert!(matches!(error, SceneError::Usage(_)), "it is the command line's fault");
        let folder = std::env::temp_dir().join(format!("harbour-map-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("upside-down.png");
        image::ImageBuffer::from_pixel(8, 8, image::Luma([40_000u16])).save(&path).unwrap();
        let error = depth_map(Some(&path)).unwrap_err().to_string();
        assert!(error.contains("upside-down.png") && error.contains("72.3"), "{error}");
        let path = folder.join("coarse.png");
        image::ImageBuffer::from_pixel(8, 8, image::Luma([40u8])).save(&path).unwrap();
        let error = depth_map(Some(&path)).unwrap_err().to_string();
        assert!(error.contains("coarse.png") && error.contains("16-bit"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
