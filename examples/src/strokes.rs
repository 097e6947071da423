//! Lines over the picture: what `explain` tells of a boat, in perspective or from above.

use glam::{Vec2, Vec3};
use image::{Rgba, RgbaImage};
use open_water::{Explanation, LoadKind};
use water_view::Camera;

/// A line in the local world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its ends, local metres.
    pub ends: [Vec3; 2],
    /// sRGB.
    pub color: [u8; 3],
}

/// Pixels between the dots of a line, and a dot's size.
const STEP: f32 = 1.5;
pub(crate) const DOT: f32 = 2.0;
const WATERLINE: [u8; 3] = [255, 255, 255];

/// The waterline, and each force as a line from where it acts, `length` m for the body's weight. A cross marks the centre
/// of buoyancy.
pub(crate) fn sketch(told: &Explanation, length: f32) -> Vec<Stroke> {
    let mut strokes = Vec::new();
    let mut line = |from: Vec3, to: Vec3, color| strokes.push(Stroke { ends: [from, to], color });
    for ring in &told.clip.waterline {
        for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            line(*a, *b, WATERLINE);
        }
    }
    let arm = 0.03 * length;
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        line(told.clip.center - axis * arm, told.clip.center + axis * arm, WATERLINE);
    }
    let weight = told.loads.iter().find(|l| l.kind == LoadKind::Weight).map_or(1.0, |l| l.force.length());
    for load in &told.loads {
        let tip = load.at + load.force * (length / weight);
        let color = color(load.kind);
        line(load.at, tip, color);
        // An arrowhead across whatever is farther from the force's own direction.
        let along = load.force.normalize_or(Vec3::Y);
        let across = along.cross(if along.y.abs() > 0.7 { Vec3::X } else { Vec3::Y }).normalize_or(Vec3::X);
        let head = (0.2 * tip.distance(load.at)).min(0.08 * length);
        for side in [-0.5, 0.5] {
            line(tip, tip - (along - across * side) * head, color);
        }
    }
    strokes
}

fn color(kind: LoadKind) -> [u8; 3] {
    match kind {
        LoadKind::Weight => [235, 60, 50],
        LoadKind::Buoyancy => [70, 140, 255],
        LoadKind::Drag | LoadKind::Keel => [255, 170, 40],
        LoadKind::Radiation | LoadKind::AddedMass => [60, 220, 220],
        LoadKind::Engine => [90, 230, 90],
        LoadKind::Mooring => [250, 240, 90],
        _ => [240, 90, 240],
    }
}

/// Calls `put` with the pixels of dots along the strokes that `project` puts in a picture of `size`.
pub(crate) fn dots(
    strokes: &[Stroke],
    size: [u32; 2],
    project: impl Fn(Vec3) -> Option<Vec2>,
    mut put: impl FnMut(Vec2, [u8; 3]),
) {
    let most = Vec2::new(size[0] as f32, size[1] as f32);
    for stroke in strokes {
        let (Some(a), Some(b)) = (project(stroke.ends[0]), project(stroke.ends[1])) else { continue };
        if !(a.is_finite() && b.is_finite()) || a.distance(b) > 4.0 * most.max_element() {
            continue;
        }
        let count = (a.distance(b) / STEP).ceil().max(1.0) as u32;
        for i in 0..=count {
            let at = a.lerp(b, i as f32 / count as f32);
            if at.cmpge(Vec2::ZERO).all() && at.cmplt(most - DOT).all() {
                put(at, stroke.color);
            }
        }
    }
}

/// Where `camera` sees a point, in pixels from the upper left; nowhere behind it.
pub(crate) fn seen(camera: &Camera, size: [u32; 2]) -> impl Fn(Vec3) -> Option<Vec2> {
    let (eye, from_world) = (camera.position, camera.orientation.inverse());
    let tall = (0.5 * camera.fov_y).tan();
    let (wide, half) = (tall * camera.aspect, Vec2::new(size[0] as f32, size[1] as f32) * 0.5);
    move |point| {
        let p = from_world * (point - eye);
        (p.z < -0.1).then(|| half + half * Vec2::new(p.x / (-p.z * wide), p.y / (p.z * tall)))
    }
}

/// Draws strokes into a picture.
pub(crate) fn ink(picture: &mut RgbaImage, strokes: &[Stroke], project: impl Fn(Vec3) -> Option<Vec2>) {
    let size = [picture.width(), picture.height()];
    dots(strokes, size, project, |at, [r, g, b]| {
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            picture.put_pixel(at.x as u32 + x, at.y as u32 + y, Rgba([r, g, b, 255]));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_ahead_is_in_the_middle_and_up_is_up() {
        let camera = Camera { position: Vec3::new(0.0, 2.0, 10.0), aspect: 2.0, ..Camera::default() };
        let camera = camera.look_at(camera.position, Vec3::new(0.0, 2.0, 0.0));
        let project = seen(&camera, [200, 100]);
        let near = |p: Option<Vec2>, x: f32, y: f32| p.is_some_and(|p| p.distance(Vec2::new(x, y)) < 0.01);
        assert!(near(project(Vec3::new(0.0, 2.0, 0.0)), 100.0, 50.0));
        let (high, right) = (project(Vec3::new(0.0, 3.0, 0.0)), project(Vec3::new(1.0, 2.0, 0.0)));
        assert!(high.is_some_and(|p| p.y < 49.0) && right.is_some_and(|p| p.x > 101.0));
        // Square pixels: one metre up is as long as one to the right.
        let (up, side) = (50.0 - high.map_or(0.0, |p| p.y), right.map_or(0.0, |p| p.x) - 100.0);
        assert!((up - side).abs() < 0.01, "{up} {side}");
        assert_eq!(project(Vec3::new(0.0, 2.0, 11.0)), None);
    }

    #[test]
    fn a_line_is_a_row_of_dots_and_stays_in_the_picture() {
        let mut picture = RgbaImage::new(60, 30);
        let stroke = Stroke { ends: [Vec3::new(-20.0, 10.0, 0.0), Vec3::new(80.0, 10.0, 0.0)], color: [9, 200, 9] };
        ink(&mut picture, &[stroke], |p| Some(Vec2::new(p.x, p.y)));
        let count = picture.pixels().filter(|p| p[1] == 200).count();
        assert!((100..=130).contains(&count), "{count}");
    }
}
