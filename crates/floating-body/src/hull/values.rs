//! A hull as a `serde` value: what it is made from, checked when it is read.

use glam::Vec3;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::shapes::Shape;
use super::{Closure, Hull, Made, TriMesh};

/// What a hull is made from. A mesh is closed already.
#[derive(Serialize, Deserialize)]
enum Form<M> {
    Cuboid { size: Vec3 },
    Sphere { radius: f32 },
    Cylinder { radius: f32, length: f32 },
    HollowCylinder { length: f32, radius: f32, ratio: f32 },
    Mesh(M),
}

impl Serialize for Hull {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        // Shapes were made from 32-bit numbers: nothing is lost.
        let form: Form<&TriMesh> = match &self.0.made {
            Made::Shape(Shape::Cuboid { half }) => Form::Cuboid { size: (*half * 2.0).as_vec3() },
            Made::Shape(Shape::Sphere { radius }) => Form::Sphere { radius: *radius as f32 },
            Made::Shape(Shape::Cylinder { radius, length }) => {
                Form::Cylinder { radius: *radius as f32, length: *length as f32 }
            }
            Made::Shape(Shape::HollowCylinder { length, radius, ratio }) => {
                Form::HollowCylinder { length: *length as f32, radius: *radius as f32, ratio: *ratio as f32 }
            }
            Made::Mesh(mesh) => Form::Mesh(mesh),
        };
        form.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Hull {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match Form::<TriMesh>::deserialize(from)? {
            Form::Cuboid { size } => Self::cuboid(size),
            Form::Sphere { radius } => Self::sphere(radius),
            Form::Cylinder { radius, length } => Self::cylinder(radius, length),
            Form::HollowCylinder { length, radius, ratio } => Self::hollow_cylinder(length, radius, ratio),
            Form::Mesh(mesh) => Self::from_mesh(&mesh, Closure::Require),
        }
        .map_err(D::Error::custom)
    }
}
