//! The bed: elevations on a world raster.
//!
//! Between pixels the bed is bilinear; outside the raster it goes on as at its edge.

use glam::DVec2;

use crate::OpenWaterError;

/// Pixels along one side of a map.
const SIDE: std::ops::RangeInclusive<u32> = 2..=2048;
/// Highest land and deepest sea, metres.
const TALLEST: f32 = 10_000.0;
/// A map whose deepest pixel is shallower than this, metres, holds no sea.
const LEAST_DEPTH: f32 = 0.5;

/// How the levels of an image become metres.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthScale {
    /// Height of one level, metres, above 0: brighter is higher.
    pub metres_per_level: f32,
    /// Level of elevation 0, the datum from which the water level counts.
    pub sea_level: u16,
    /// Distance between pixels, metres, .05 to 10,000.
    pub texel: f32,
    /// World place (x, z) of the centre of pixel (0, 0); x runs along rows, z from row to row.
    pub corner: DVec2,
}

/// Elevations of the bed and of the land above it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Raw"))]
pub struct DepthMap {
    corner: DVec2,
    texel: f32,
    size: [u32; 2],
    elevations: Vec<f32>,
}

/// As it is read, unchecked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Raw {
    corner: DVec2,
    texel: f32,
    size: [u32; 2],
    elevations: Vec<f32>,
}

#[cfg(feature = "serde")]
impl TryFrom<Raw> for DepthMap {
    type Error = OpenWaterError;

    fn try_from(raw: Raw) -> Result<Self, OpenWaterError> {
        Self::new(raw.corner, raw.texel, raw.size, raw.elevations)
    }
}

impl DepthMap {
    /// A map from elevations in metres above the datum (the sea's bed is below 0), row-major, x fastest. `corner` is the
    /// world place (x, z) of pixel (0, 0), `texel` the distance between pixels in metres, .05 to 10,000.
    ///
    /// # Errors
    /// A side that is not 2 to 2048 pixels, a wrong number of elevations, an elevation that is not finite or beyond
    /// 10,000 m, or no pixel at least .5 m deep: the map holds no sea, or is upside down.
    pub fn new(corner: DVec2, texel: f32, size: [u32; 2], elevations: Vec<f32>) -> Result<Self, OpenWaterError> {
        Self::checked("depth map", corner, texel, size, elevations)
    }

    fn checked(
        map: &str,
        corner: DVec2,
        texel: f32,
        size: [u32; 2],
        elevations: Vec<f32>,
    ) -> Result<Self, OpenWaterError> {
        let refuse = |field, value: f64, bound| Err(OpenWaterError::Map { map: map.into(), field, value, bound });
        for (field, side) in [("width", size[0]), ("height", size[1])] {
            if !SIDE.contains(&side) {
                return refuse(field, side.into(), "2 to 2048 pixels");
            }
        }
        if elevations.len() as u64 != u64::from(size[0]) * u64::from(size[1]) {
            return refuse("number of elevations", elevations.len() as f64, "width times height");
        }
        if !(0.05..=1e4).contains(&texel) {
            return refuse("texel", texel.into(), "0.05 to 10000 m");
        }
        for (field, place) in [("corner.x", corner.x), ("corner.y", corner.y)] {
            if place.is_nan() || place.abs() > 1e9 {
                return refuse(field, place, "within 10^9 m");
            }
        }
        let pixel = |at: usize| [at as u32 % size[0], at as u32 / size[0]];
        let at_pixel = |at: usize, bound| {
            let value = elevations[at].into();
            Err(OpenWaterError::MapPixel { map: map.into(), field: "elevation", pixel: pixel(at), value, bound })
        };
        if let Some(at) = elevations.iter().position(|e| e.is_nan() || e.abs() > TALLEST) {
            return at_pixel(at, "finite and within 10000 m");
        }
        let lowest = (0..elevations.len()).min_by(|a, b| elevations[*a].total_cmp(&elevations[*b])).unwrap_or(0);
        if elevations[lowest] > -LEAST_DEPTH {
            let bound = "-0.5 m or less at the deepest pixel (is the map upside down? higher levels are higher land)";
            return at_pixel(lowest, bound);
        }
        Ok(Self { corner, texel, size, elevations })
    }

    /// Reads a map from a 16-bit greyscale PNG.
    ///
    /// # Errors
    /// The file cannot be read or is no 16-bit greyscale PNG; the scale is out of its range; otherwise as
    /// [`DepthMap::new`]. Errors name the file and the pixel.
    #[cfg(feature = "map-files")]
    pub fn from_png(path: impl AsRef<std::path::Path>, scale: &DepthScale) -> Result<Self, OpenWaterError> {
        let map = path.as_ref().display().to_string();
        let unreadable = |reason: String| OpenWaterError::MapFile { map: map.clone(), reason };
        let file = std::fs::File::open(path.as_ref()).map_err(|error| unreadable(error.to_string()))?;
        let image = image::ImageReader::with_format(std::io::BufReader::new(file), image::ImageFormat::Png)
            .decode()
            .map_err(|error| unreadable(error.to_string()))?;
        let image::DynamicImage::ImageLuma16(levels) = image else {
            return Err(unreadable(format!("its pixels are {:?}, but must be 16-bit greyscale", image.color())));
        };
        let metres = scale.metres_per_level;
        if !(metres > 0.0 && metres <= 100.0) {
            let bound = "above 0 to 100 m: brighter is higher";
            return Err(OpenWaterError::Map { map, field: "metres_per_level", value: metres.into(), bound });
        }
        let elevation = |level: &u16| (f32::from(*level) - f32::from(scale.sea_level)) * metres;
        let size = [levels.width(), levels.height()];
        let elevations = levels.as_raw().iter().map(elevation).collect();
        Self::checked(&map, scale.corner, scale.texel, size, elevations)
    }

    /// World place (x, z) of pixel (0, 0).
    pub fn corner(&self) -> DVec2 {
        self.corner
    }

    /// World place of the last pixel.
    pub fn far_corner(&self) -> DVec2 {
        self.place(self.size.map(|n| n as usize - 1))
    }

    /// Distance between pixels, metres.
    pub fn texel(&self) -> f32 {
        self.texel
    }

    /// Pixels along x and z.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Elevations, metres above the datum, row-major, x fastest.
    pub fn elevations(&self) -> &[f32] {
        &self.elevations
    }

    /// World place of a pixel.
    pub(crate) fn place(&self, pixel: [usize; 2]) -> DVec2 {
        self.corner + DVec2::new(pixel[0] as f64, pixel[1] as f64) * f64::from(self.texel)
    }

    /// Elevation of the bed at a world place (x, z), metres above the datum; 0 for a place that is not a number.
    pub fn elevation(&self, place: DVec2) -> f32 {
        self.between(place, &self.elevations)
    }

    /// Any raster of this map's pixels, bilinear.
    pub(crate) fn between(&self, place: DVec2, values: &[f32]) -> f32 {
        let [nx, nz] = self.size.map(|n| n as usize);
        let at = self.pixel_of(place);
        if at.is_nan() {
            return 0.0;
        }
        let base = at.floor().min(DVec2::new((nx - 2) as f64, (nz - 2) as f64));
        let t = (at - base).as_vec2();
        let first = base.y as usize * nx + base.x as usize;
        let row = |at: usize| values[at] + t.x * (values[at + 1] - values[at]);
        let (low, high) = (row(first), row(first + nx));
        low + t.y * (high - low)
    }

    /// A world place in pixels, kept on the raster.
    fn pixel_of(&self, place: DVec2) -> DVec2 {
        let last = DVec2::new(f64::from(self.size[0] - 1), f64::from(self.size[1] - 1));
        let at = (place - self.corner) / f64::from(self.texel);
        if at.is_nan() { at } else { at.clamp(DVec2::ZERO, last) }
    }

    /// Highest elevation of a world rectangle.
    pub(crate) fn highest(&self, low: DVec2, high: DVec2) -> f32 {
        let (first, last) = (self.pixel_of(low).floor(), self.pixel_of(high).ceil());
        if first.is_nan() || last.is_nan() {
            return f32::INFINITY;
        }
        let nx = self.size[0] as usize;
        let columns = first.x as usize..=last.x as usize;
        (first.y as usize..=last.y as usize)
            .flat_map(|row| &self.elevations[row * nx..][columns.clone()])
            .fold(f32::NEG_INFINITY, |most, e| most.max(*e))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(elevations: Vec<f32>) -> Result<DepthMap, OpenWaterError> {
        DepthMap::new(DVec2::new(10.0, -4.0), 2.0, [3, 2], elevations)
    }

    #[test]
    fn the_bed_is_bilinear_and_goes_on_outside() {
        let bed = map(vec![-4.0, -2.0, 0.0, -8.0, -4.0, 2.0]).unwrap();
        for (x, z, expected) in
            [(10.0, -4.0, -4.0), (11.0, -4.0, -3.0), (11.0, -3.0, -4.5), (14.0, -2.0, 2.0), (99.0, 99.0, 2.0)]
        {
            assert!((bed.elevation(DVec2::new(x, z)) - expected).abs() < 1e-6, "{x} {z}");
        }
        assert_eq!(bed.highest(DVec2::new(10.5, -4.0), DVec2::new(11.5, -2.5)), -2.0);
        assert_eq!(bed.highest(DVec2::new(-50.0, -50.0), DVec2::new(-40.0, 50.0)), -4.0);
        assert_eq!(bed.elevation(DVec2::NAN), 0.0);
    }

    #[test]
    fn bad_maps_name_pixel_value_and_bound() {
        let error = map(vec![-4.0, f32::NAN, 0.0, -8.0, -4.0, 2.0]).unwrap_err().to_string();
        assert!(error.contains("pixel (1, 0)") && error.contains("NaN"), "{error}");
        let error = map(vec![4.0, 2.0, 0.0, 8.0, 0.5, 2.0]).unwrap_err().to_string();
        assert!(error.contains("pixel (2, 0)") && error.contains("upside down"), "{error}");
        let error = map(vec![-4.0; 5]).unwrap_err().to_string();
        assert!(error.contains("number of elevations is 5"), "{error}");
        let error = DepthMap::new(DVec2::ZERO, 2.0, [1, 9], vec![-4.0; 9]).unwrap_err().to_string();
        assert!(error.contains("width is 1") && error.contains("2 to 2048"), "{error}");
    }

    #[cfg(feature = "map-files")]
    fn file(name: &str, image: &image::DynamicImage) -> std::path::PathBuf {
        let path = std::env::temp_dir().join(format!("open-water-{}-{name}.png", std::process::id()));
        image.save(&path).unwrap();
        path
    }

    #[cfg(feature = "map-files")]
    #[test]
    fn files_are_read_as_the_scale_says() {
        use image::{DynamicImage, ImageBuffer, Luma};
        let scale = DepthScale { metres_per_level: 0.01, sea_level: 32_768, texel: 2.0, corner: DVec2::ZERO };
        let levels = |pixels: [u16; 6]| ImageBuffer::<Luma<u16>, _>::from_raw(3, 2, pixels.to_vec()).unwrap();
        let good = file("good", &levels([32_768, 32_268, 31_768, 0, 65_535, 33_000]).into());
        let bed = DepthMap::from_png(&good, &scale).unwrap();
        assert_eq!(bed.size(), [3, 2]);
        for (found, expected) in bed.elevations().iter().zip([0.0, -5.0, -10.0, -327.68, 327.67, 2.32]) {
            assert!((found - expected).abs() < 1e-3, "{found} {expected}");
        }
        let refused = |path: &std::path::Path, scale: &DepthScale| {
            let error = DepthMap::from_png(path, scale).unwrap_err().to_string();
            assert!(error.contains(&path.display().to_string()), "{error}");
            error
        };
        assert!(refused(&good, &DepthScale { metres_per_level: -0.01, ..scale }).contains("brighter is higher"));
        assert!(refused(&good, &DepthScale { texel: f32::NAN, ..scale }).contains("texel is NaN"));
        let dry = refused(&good, &DepthScale { sea_level: 0, ..scale });
        assert!(dry.contains("pixel (0, 1)") && dry.contains("upside down"), "{dry}");
        let eight = file("eight", &DynamicImage::new_luma8(4, 4));
        assert!(refused(&eight, &scale).contains("16-bit greyscale"));
        assert!(refused(std::path::Path::new("nowhere.png"), &scale).contains("os error"));
        let text = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        assert!(refused(&text, &scale).contains("PNG signature"));
        for path in [good, eight] {
            std::fs::remove_file(path).unwrap();
        }
    }
}
