//! A ball and a cylinder cut by a plane, in closed form (f64).

use glam::DVec3;

use super::super::shapes::Shape;

/// What lies below the plane.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Part {
    /// m^3.
    pub(crate) volume: f64,
    /// First moment of the volume about the shape's centre, m^4.
    pub(crate) moment: DVec3,
    /// Half the shape's extent along the normal, m.
    pub(crate) extent: f64,
}

const PI: f64 = std::f64::consts::PI;

/// The part of a ball or cylinder below the plane with unit `normal`, `height` m over the centre. `None` for a cuboid,
/// which is a polyhedron.
pub(crate) fn below(shape: &Shape, normal: DVec3, height: f64) -> Option<Part> {
    match *shape {
        Shape::Cuboid { .. } => None,
        Shape::Sphere { radius } => Some(ball(radius, normal, height)),
        Shape::Cylinder { radius, length } | Shape::HollowCylinder { radius, length, .. } => {
            Some(rod(radius, length, normal, height))
        }
    }
}

/// A spherical cap and the integral of `x pi (r^2 - x^2)` along its axis.
fn ball(radius: f64, normal: DVec3, height: f64) -> Part {
    let h = height.clamp(-radius, radius);
    let rest = radius * radius - h * h;
    let volume = PI * (radius * radius * (h + radius) - (h * h * h + radius * radius * radius) / 3.0);
    Part { volume, moment: normal * (-PI / 4.0 * rest * rest), extent: radius }
}

/// Sections across the axis are discs cut by a chord `u` radii from their centres, and `u` is linear along the axis: the
/// integrals of a segment's area `pi/2 + asin u + u sqrt(1 - u^2)`, of `u` times it, and of its first moment
/// `2/3 (1 - u^2)^1.5` are elementary.
fn rod(radius: f64, length: f64, normal: DVec3, height: f64) -> Part {
    let across = libm::hypot(normal.y, normal.z);
    let extent = libm::hypot(normal.x * length / 2.0, radius * across);
    let side = if across > 0.0 { DVec3::new(0.0, normal.y, normal.z) / across } else { DVec3::Y };
    let half = length / 2.0;
    // Chord and its change along x, in radii; a plane square to the axis cuts in no chord but anywhere, steeply.
    let across = across.max(1.0e-9);
    let (u0, slope) = (height / (radius * across), -normal.x / (radius * across));
    let square = radius * radius;
    let (area, along, down) = if (slope * half).abs() > 1.0e-4 {
        let [low, high] = [u0 - slope * half, u0 + slope * half].map(integrals);
        let area = (high.0 - low.0) / slope;
        // x = (u - u0)/slope.
        (area, ((high.1 - low.1) / slope - u0 * area) / slope, (high.2 - low.2) / slope)
    } else {
        let u = u0.clamp(-1.0, 1.0);
        let rest = (1.0 - u * u).max(0.0).sqrt();
        let area = PI / 2.0 + libm::asin(u) + u * rest;
        // dA/du = 2 sqrt(1 - u^2), and the second moment of the length is L^3/12.
        (area * length, 2.0 * rest * slope * length * length * length / 12.0, 2.0 / 3.0 * rest * rest * rest * length)
    };
    let moment = DVec3::X * (along * square) - side * (down * square * radius);
    Part { volume: area * square, moment, extent }
}

/// Integrals from -1 to `u` of the segment's area, of `u` times it and of its first moment. Beyond 1 the area is pi.
fn integrals(u: f64) -> (f64, f64, f64) {
    let v = u.clamp(-1.0, 1.0);
    let (root, angle) = ((1.0 - v * v).max(0.0).sqrt(), libm::asin(v));
    let cube = root * root * root;
    let area = PI / 2.0 * (v + 1.0) + v * angle - PI / 2.0 + root - cube / 3.0;
    let first = PI / 4.0 * (v * v - 1.0)
        + (0.5 * v * v - 0.25) * angle
        + 0.25 * v * root
        + PI / 8.0
        + (angle - v * root * (1.0 - 2.0 * v * v)) / 8.0
        + PI / 16.0;
    let down = 2.0 / 3.0 * (v * root * (5.0 - 2.0 * v * v) + 3.0 * angle + 1.5 * PI) / 8.0;
    let over = (u - 1.0).max(0.0);
    (area + PI * over, first + PI * over * (1.0 + 0.5 * over), down)
}
