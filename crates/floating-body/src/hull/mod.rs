//! Hulls: the shape that displaces water, from a triangle mesh or in closed form.
//!
//! The hull's frame has x forward, y up and z to starboard, in metres. A hull knows geometry only; mass and where it
//! sits come with a [`BodyDesc`](crate::BodyDesc). Hulls are shared: a clone is a pointer.

pub(crate) mod clip;
mod columns;
mod convex;
mod dry;
mod lid;
mod quadrature;
pub(crate) mod shapes;
mod solid;
mod spans;
mod topology;
#[cfg(feature = "serde")]
mod values;
mod waterline;

use std::sync::{Arc, Mutex, PoisonError};

use glam::{DVec3, Mat3, Vec3};

pub use self::clip::{Clip, Clipper, Push};
pub use self::dry::DryHull;
use self::shapes::Shape;
use self::solid::Solid;
use self::spans::Span;
pub use self::topology::Closure;
pub use self::waterline::Waterline;
use crate::error::check_range;
use crate::lewis::Strip;
use crate::{BodyError, ForcePoint};

/// A triangle mesh in the hull's frame: vertices in m, three indices per triangle. May be unwelded.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TriMesh {
    /// Positions in m.
    pub vertices: Vec<Vec3>,
    /// Three per triangle, counted from 0.
    pub indices: Vec<u32>,
}

impl TriMesh {
    /// The same mesh with another unit, for example 0.001 for a file in millimetres.
    #[must_use]
    pub fn scaled(mut self, factor: f32) -> Self {
        self.vertices.iter_mut().for_each(|v| *v *= factor);
        self
    }

    /// The same mesh turned from z up, as drawing programs have it, to y up (x stays).
    #[must_use]
    pub fn from_z_up(mut self) -> Self {
        self.vertices.iter_mut().for_each(|v| *v = Vec3::new(v.x, v.z, -v.y));
        self
    }
}

/// What a hull is made of, for building something else of the same shape.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum HullKind<'a> {
    /// A box about its centre.
    Cuboid {
        /// Half its sides in m.
        half: Vec3,
    },
    /// A ball.
    Sphere {
        /// In m.
        radius: f32,
    },
    /// A cylinder along x, hollow or not.
    Cylinder {
        /// In m.
        radius: f32,
        /// In m.
        length: f32,
    },
    /// A closed mesh.
    Mesh(&'a TriMesh),
}

/// A shape that displaces water.
#[derive(Clone, Debug)]
pub struct Hull(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    made: Made,
    solid: Solid,
    spans: Vec<Span>,
    /// Points of meshes by count and bits of the displaced volume.
    fitted: Mutex<Vec<Fitted>>,
}

type Fitted = ((u32, u32), Vec<ForcePoint>);

/// Sets of force points that a mesh keeps.
const FITS_KEPT: usize = 8;

#[derive(Debug)]
enum Made {
    Shape(Shape),
    Mesh(TriMesh),
}

/// Bounds of the lengths of closed shapes, in m.
const SIZE: (f32, f32, &str) = (0.001, 1000.0, "in [0.001, 1000] m");

impl Hull {
    /// A hull from a triangle mesh: welds it, gives it one winding, closes it as `closure` says.
    ///
    /// # Errors
    /// [`BodyError`] for an empty mesh, bad vertices or indices, open or non-manifold edges, no volume.
    pub fn from_mesh(mesh: &TriMesh, closure: Closure) -> Result<Self, BodyError> {
        let surface = topology::close(mesh, closure)?;
        let solid = Solid::of(&surface)?;
        let spans = spans::spans_of(&surface, solid.low, solid.high, solid.volume);
        if spans.is_empty() {
            return Err(BodyError::NoVolume { volume: solid.volume });
        }
        let mesh = TriMesh {
            vertices: surface.vertices.iter().map(|v| v.as_vec3()).collect(),
            indices: surface.triangles.iter().flatten().copied().collect(),
        };
        Ok(Self(Arc::new(Inner { made: Made::Mesh(mesh), solid, spans, fitted: Mutex::default() })))
    }

    /// A box of `size` m (length x, height y, width z) about its centre.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] unless each side is in [0.001, 1000] m.
    pub fn cuboid(size: Vec3) -> Result<Self, BodyError> {
        for side in size.to_array() {
            check_range("size", side, SIZE.0, SIZE.1, SIZE.2)?;
        }
        Ok(Self::closed(Shape::Cuboid { half: size.as_dvec3() / 2.0 }))
    }

    /// A ball of `radius` m.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] unless the radius is in [0.001, 1000] m.
    pub fn sphere(radius: f32) -> Result<Self, BodyError> {
        let radius = f64::from(check_range("radius", radius, SIZE.0, SIZE.1, SIZE.2)?);
        Ok(Self::closed(Shape::Sphere { radius }))
    }

    /// A solid cylinder along x: a log, a barrel lying.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] unless radius and length are in [0.001, 1000] m.
    pub fn cylinder(radius: f32, length: f32) -> Result<Self, BodyError> {
        let radius = f64::from(check_range("radius", radius, SIZE.0, SIZE.1, SIZE.2)?);
        let length = f64::from(check_range("length", length, SIZE.0, SIZE.1, SIZE.2)?);
        Ok(Self::closed(Shape::Cylinder { radius, length }))
    }

    /// The stand-in body of Yang et al. 2017, section 3: the mass of a tube along x of `length`, outer `radius` (m) and
    /// inner over outer radius `ratio`, on water that it keeps out.
    ///
    /// Its inertia (Eqs. 9, 10) is isotropic if and only if `radius^2 (1 + ratio^2) = length^2 / 3`, and is then
    /// `M length^2 / 6`: see [`Hull::isotropic_radius`]. The paper's `radius = length / 2` needs `ratio = 1/sqrt 3`;
    /// its printed 0.905 is `(1 + 0.9^2)/2`.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] unless lengths are in [0.001, 1000] m and the ratio in [0, 1].
    pub fn hollow_cylinder(length: f32, radius: f32, ratio: f32) -> Result<Self, BodyError> {
        let length = f64::from(check_range("length", length, SIZE.0, SIZE.1, SIZE.2)?);
        let radius = f64::from(check_range("radius", radius, SIZE.0, SIZE.1, SIZE.2)?);
        let ratio = f64::from(check_range("ratio", ratio, 0.0, 1.0, "in [0, 1]")?);
        Ok(Self::closed(Shape::HollowCylinder { length, radius, ratio }))
    }

    /// Outer radius in m at which a hollow cylinder's inertia is isotropic: `length / sqrt(3 (1 + ratio^2))`.
    pub fn isotropic_radius(length: f32, ratio: f32) -> f32 {
        length / (3.0 * (1.0 + ratio * ratio)).sqrt()
    }

    fn closed(shape: Shape) -> Self {
        let solid = shape.solid();
        let spans = shape.spans(&solid);
        Self(Arc::new(Inner { made: Made::Shape(shape), solid, spans, fitted: Mutex::default() }))
    }

    /// Whole volume in m^3.
    pub fn volume(&self) -> f32 {
        self.0.solid.volume as f32
    }

    /// Centre of the whole volume in m.
    pub fn centroid(&self) -> Vec3 {
        self.0.solid.centroid.as_vec3()
    }

    /// Inertia tensor about the centroid per kg, in m^2, of a solid of one density (of the tube for a hollow cylinder).
    pub fn unit_inertia(&self) -> Mat3 {
        self.0.solid.unit_inertia.as_mat3()
    }

    /// Lowest and highest corner of the bounding box in m.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        (self.0.solid.low.as_vec3(), self.0.solid.high.as_vec3())
    }

    /// The welded, closed, outward mesh; `None` for closed shapes.
    pub fn mesh(&self) -> Option<&TriMesh> {
        match &self.0.made {
            Made::Mesh(mesh) => Some(mesh),
            Made::Shape(_) => None,
        }
    }

    /// What the hull is made of.
    pub fn kind(&self) -> HullKind<'_> {
        match &self.0.made {
            Made::Mesh(mesh) => HullKind::Mesh(mesh),
            Made::Shape(Shape::Cuboid { half }) => HullKind::Cuboid { half: half.as_vec3() },
            Made::Shape(Shape::Sphere { radius }) => HullKind::Sphere { radius: *radius as f32 },
            Made::Shape(Shape::Cylinder { radius, length } | Shape::HollowCylinder { length, radius, .. }) => {
                HullKind::Cylinder { radius: *radius as f32, length: *length as f32 }
            }
        }
    }

    /// Where the hull floats upright when it displaces `volume` m^3; wholly immersed if it cannot.
    pub fn waterline(&self, volume: f32) -> Waterline {
        waterline::waterline(&self.0.spans, f64::from(volume))
    }

    /// Cross-sections of a mesh that displaces `volume` m^3; none of a closed shape.
    pub(crate) fn strips(&self, volume: f32) -> Vec<Strip> {
        match self.0.made {
            Made::Mesh(_) => {
                let level = waterline::level_for(&self.0.spans, f64::from(volume));
                spans::strips(&self.0.spans, level)
            }
            Made::Shape(_) => Vec::new(),
        }
    }

    /// About `count` force points for a body that displaces `volume` m^3 afloat: columns for a mesh, pieces for closed
    /// shapes (always one for a sphere). Their volumes sum to the hull's.
    pub fn force_points(&self, count: u32, volume: f32) -> Vec<ForcePoint> {
        let Solid { low, high, .. } = self.0.solid;
        match &self.0.made {
            Made::Mesh(mesh) => self.fitted_points(mesh, count, volume, (low, high)),
            Made::Shape(shape) => shape.points(count),
        }
    }

    /// Columns fitted to the mesh, which takes some ms; those fitted last are kept.
    fn fitted_points(&self, mesh: &TriMesh, count: u32, volume: f32, bounds: (DVec3, DVec3)) -> Vec<ForcePoint> {
        let key = (count, volume.to_bits());
        let kept = || self.0.fitted.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = kept().iter().find(|f| f.0 == key) {
            return found.1.clone();
        }
        let mut points = columns::columns(&self.0.spans, bounds.0, bounds.1, count, f64::from(volume));
        let panels = clip::panels::Panels::new(mesh, Vec3::ZERO, &[]);
        quadrature::fit(&mut points, &panels, bounds, f64::from(volume), self.0.solid.volume);
        let mut kept = kept();
        if kept.len() >= FITS_KEPT {
            kept.remove(0);
        }
        kept.push((key, points.clone()));
        points
    }

    /// Number of force points when none is asked for: as few as keep the draft within 1 %.
    pub(crate) fn default_count(&self) -> u32 {
        let size: DVec3 = self.0.solid.high - self.0.solid.low;
        match &self.0.made {
            Made::Shape(Shape::Sphere { .. }) => 1,
            Made::Shape(Shape::Cylinder { .. }) => 4,
            Made::Shape(Shape::Cuboid { .. }) if size.max_element() < f64::from(crate::desc::PATCH_LENGTH) => 8,
            Made::Shape(Shape::Cuboid { .. }) | Made::Mesh(_) => 32,
            Made::Shape(Shape::HollowCylinder { .. }) => 12,
        }
    }

    /// Whether the hull is blunt at its ends (closed shapes) rather than drawn to a bow (meshes).
    pub(crate) fn is_blunt(&self) -> bool {
        matches!(self.0.made, Made::Shape(_))
    }

    /// A ball or a cylinder.
    pub(crate) fn round(&self) -> Option<Shape> {
        match self.0.made {
            Made::Shape(Shape::Cuboid { .. }) | Made::Mesh(_) => None,
            Made::Shape(shape) => Some(shape),
        }
    }

    /// Whether the hull is a ball.
    pub(crate) fn is_sphere(&self) -> bool {
        matches!(self.0.made, Made::Shape(Shape::Sphere { .. }))
    }
}
