//! The view from above, drawn on the CPU for machines without any adapter: hill-shaded water, foam, bodies.

use glam::{Vec2, Vec3};
use image::{Rgba, RgbaImage};
use open_water::WaterSample;

use crate::strokes::{self, Stroke};
use crate::{Mark, Scene};

/// Pixels between samples of the water.
const STRIDE: u32 = 3;

/// Sample points and answers, kept from frame to frame.
pub(crate) struct TopView {
    size: [u32; 2],
    points: Vec<Vec2>,
    samples: Vec<WaterSample>,
}

impl TopView {
    pub(crate) fn new(size: [u32; 2]) -> Self {
        Self { size, points: Vec::new(), samples: Vec::new() }
    }

    /// The scene from above, the part it shows; x is right, z is down.
    pub(crate) fn draw<S: Scene>(&mut self, scene: &mut S, strokes: &[Stroke]) -> RgbaImage {
        scene.look_down();
        let [width, height] = self.size;
        let (center, across) = scene.map();
        let scale = across / width as f32;
        let corner = center - 0.5 * scale * Vec2::new(width as f32, height as f32);
        let (columns, rows) = (width.div_ceil(STRIDE) + 1, height.div_ceil(STRIDE) + 1);
        self.points.clear();
        self.points.extend(
            (0..columns * rows)
                .map(|k| corner + scale * STRIDE as f32 * Vec2::new((k % columns) as f32, (k / columns) as f32)),
        );
        self.samples.resize(self.points.len(), WaterSample::default());
        scene.water().sample(&self.points, &mut self.samples);
        let tall = scene.water().ocean().map_or(1.0, |ocean| ocean.significant_height()).max(0.2);
        let level = scene.water().level();
        let mut picture = RgbaImage::new(width, height);
        for (x, y, pixel) in picture.enumerate_pixels_mut() {
            let (i, j) = (x / STRIDE, y / STRIDE);
            let (s, t) = ((x % STRIDE) as f32 / STRIDE as f32, (y % STRIDE) as f32 / STRIDE as f32);
            let at = |i: u32, j: u32| &self.samples[(j * columns + i) as usize];
            let quad = [
                (at(i, j), (1. - s) * (1. - t)),
                (at(i + 1, j), s * (1. - t)),
                (at(i, j + 1), (1. - s) * t),
                (at(i + 1, j + 1), s * t),
            ];
            let height: f32 = quad.iter().map(|(sample, w)| w * sample.height).sum();
            let normal: Vec3 = quad.iter().map(|(sample, w)| *w * sample.normal).sum();
            let at = corner + scale * Vec2::new(x as f32, y as f32);
            let foam = scene.foam(at);
            let normal = normal.normalize_or(Vec3::Y);
            let water = |height: f32, foam: f32| shade((height - level) / tall, normal, foam);
            *pixel = match scene.ground(at) {
                None => water(height, foam),
                Some(ground) => {
                    let step = scale.max(0.5);
                    let east = scene.ground(at + Vec2::X * step).unwrap_or(ground);
                    let south = scene.ground(at + Vec2::Y * step).unwrap_or(ground);
                    let land = earth(ground - level, Vec2::new(east - ground, south - ground) / step);
                    // The bed shows through shallow water, which ends in a white edge.
                    let depth = height - ground;
                    let seen = (-0.7 * depth.max(0.0)).exp();
                    let edge = (1.0 - depth / 0.25).clamp(0.0, 1.0) * 0.7;
                    if depth <= 0.0 { land } else { blend(water(height, foam.max(edge)), land, seen) }
                }
            };
        }
        for mark in scene.marks() {
            fill(&mut picture, &mark, corner, scale);
        }
        strokes::ink(&mut picture, strokes, |p| Some((Vec2::new(p.x, p.z) - corner) / scale));
        picture
    }
}

/// Colour of water of a height (in significant heights) under a light from the upper left.
fn shade(height: f32, normal: Vec3, foam: f32) -> Rgba<u8> {
    let sun = Vec3::new(-0.55, 0.6, -0.58);
    // Slopes of the sea are small: shaded three times as steep.
    let normal = Vec3::new(3.0 * normal.x, normal.y, 3.0 * normal.z).normalize();
    let light = normal.dot(sun).max(0.0);
    let half = (sun + Vec3::Y).normalize();
    let glint = normal.dot(half).max(0.0).powi(60);
    let deep = Vec3::new(0.01, 0.07, 0.12);
    let crest = Vec3::new(0.05, 0.28, 0.34);
    let water = deep.lerp(crest, (0.5 + 0.8 * height).clamp(0.0, 1.0)) * (0.2 + 1.1 * light) + Vec3::splat(0.1 * glint);
    // As much white as lace of this amount has (`foam_cover`).
    let foam = foam.clamp(0.0, 1.0);
    let cover = foam * foam * (1.5 - 0.5 * foam);
    let color = water.lerp(Vec3::splat(0.85 * (0.4 + 0.8 * light)), cover);
    let byte = |v: f32| (v.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0 + 0.5) as u8;
    Rgba([byte(color.x), byte(color.y), byte(color.z), 255])
}

/// Colour of land at a height above still water under the same light.
fn earth(height: f32, slope: Vec2) -> Rgba<u8> {
    let light = Vec3::new(-slope.x, 1.0, -slope.y).normalize().dot(Vec3::new(-0.55, 0.6, -0.58)).max(0.0);
    let sand = Vec3::new(0.48, 0.37, 0.2);
    let grass = Vec3::new(0.09, 0.13, 0.035);
    let dry = sand.lerp(grass, ((height - 2.0) / 1.5).clamp(0.0, 1.0));
    let color = dry * (0.3 + 1.1 * light) * if height < 0.3 { 0.6 } else { 1.0 };
    let byte = |v: f32| (v.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0 + 0.5) as u8;
    Rgba([byte(color.x), byte(color.y), byte(color.z), 255])
}

/// `a`, or as much of `b` as `share` says.
fn blend(a: Rgba<u8>, b: Rgba<u8>, share: f32) -> Rgba<u8> {
    Rgba(std::array::from_fn(|c| (f32::from(a[c]) + share * (f32::from(b[c]) - f32::from(a[c]))) as u8))
}

/// Fills a convex outline.
fn fill(picture: &mut RgbaImage, mark: &Mark, corner: Vec2, scale: f32) {
    let outline: Vec<Vec2> = mark.outline.iter().map(|p| (*p - corner) / scale).collect();
    let low = outline.iter().copied().fold(Vec2::INFINITY, Vec2::min).max(Vec2::ZERO);
    let end = Vec2::new(picture.width() as f32 - 1.0, picture.height() as f32 - 1.0);
    let high = outline.iter().copied().fold(Vec2::NEG_INFINITY, Vec2::max).min(end);
    if !(low.is_finite() && high.is_finite() && low.cmple(high).all()) {
        return;
    }
    let color = Rgba([mark.color[0], mark.color[1], mark.color[2], 255]);
    for y in low.y as u32..=high.y as u32 {
        for x in low.x as u32..=high.x as u32 {
            let p = Vec2::new(x as f32, y as f32);
            let side = |i: usize| (outline[(i + 1) % outline.len()] - outline[i]).perp_dot(p - outline[i]);
            let first = side(0);
            if (1..outline.len()).all(|i| side(i) * first >= 0.0) {
                picture.put_pixel(x, y, color);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_towards_the_light_are_brighter_and_foam_is_white() {
        let lit = shade(0.0, Vec3::new(-0.3, 1.0, -0.3).normalize(), 0.0);
        let dark = shade(0.0, Vec3::new(0.3, 1.0, 0.3).normalize(), 0.0);
        let foam = shade(0.0, Vec3::Y, 1.0);
        assert!(lit[1] > dark[1] + 10 && foam[0] > lit[0]);
        assert!(dark[2] > dark[0], "water is blue");
    }

    #[test]
    fn land_is_sand_then_grass_and_brighter_towards_the_light() {
        let (sand, grass) = (earth(1.0, Vec2::ZERO), earth(8.0, Vec2::ZERO));
        assert!(sand[0] > grass[0] + 40 && grass[1] > grass[0]);
        assert!(earth(8.0, Vec2::splat(0.4))[1] > earth(8.0, Vec2::splat(-0.4))[1] + 20);
        assert_eq!(blend(sand, grass, 1.0), grass);
        assert_eq!(blend(sand, grass, 0.0), sand);
    }

    #[test]
    fn an_outline_covers_its_area() {
        let mut picture = RgbaImage::new(100, 100);
        let outline = [(2.0, 3.0), (7.0, 3.0), (7.0, 8.0), (2.0, 8.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        fill(&mut picture, &Mark { outline, color: [255, 0, 0] }, Vec2::ZERO, 0.1);
        let count = picture.pixels().filter(|p| p[0] == 255).count();
        assert!((2500..=2700).contains(&count), "{count}");
    }
}
