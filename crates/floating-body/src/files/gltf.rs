//! glTF 2.0: all triangle primitives of the default scene, with the nodes' transforms.
//!
//! The `gltf` crate reads and validates the JSON; accessors are read here, with every bound checked, because its own
//! readers trust the file. Sparse and compressed accessors are refused.

use std::path::Path;

use glam::{Mat4, Vec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::json::validation::Checked;
use gltf::mesh::Mode;
use gltf::{Accessor, Document, Gltf, Node, Semantic};

use super::error;
use crate::{BodyError, TriMesh};

/// Deepest nesting of nodes that is followed, and most nodes visited; a cycle runs into either.
const DEEPEST: usize = 64;
const MOST_NODES: usize = 100_000;

struct Reader<'a> {
    name: &'a str,
    buffers: Vec<gltf::buffer::Data>,
    mesh: TriMesh,
    visited: usize,
}

pub(super) fn parse(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<TriMesh, BodyError> {
    let broken = |e: gltf::Error| error(name, "whole file", e.to_string(), "a valid glTF 2.0 file with its buffers");
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(broken)?;
    let json = document.into_json();
    check_positions(name, &json)?;
    let document = Document::from_json(json).map_err(broken)?;
    let buffers = gltf::import_buffers(&document, folder, blob).map_err(broken)?;
    let mut reader = Reader { name, buffers, mesh: TriMesh::default(), visited: 0 };
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let Some(scene) = scene else {
        return Err(error(name, "scenes", "no scene", "a scene with a mesh"));
    };
    for node in scene.nodes() {
        reader.node(&node, Mat4::IDENTITY, 0)?;
    }
    Ok(reader.mesh)
}

/// The crate's own validation follows these without looking whether they exist.
fn check_positions(name: &str, json: &gltf::json::Root) -> Result<(), BodyError> {
    for (i, primitive) in json.meshes.iter().flat_map(|mesh| &mesh.primitives).enumerate() {
        let accessor = primitive.attributes.get(&Checked::Valid(Semantic::Positions)).map(gltf::json::Index::value);
        if let Some(accessor) = accessor.filter(|index| *index >= json.accessors.len()) {
            let found = format!("accessor {accessor} of {}", json.accessors.len());
            return Err(error(name, format!("primitive {i}"), found, "positions of an accessor that exists"));
        }
    }
    Ok(())
}

impl Reader<'_> {
    fn node(&mut self, node: &Node, parent: Mat4, depth: usize) -> Result<(), BodyError> {
        self.visited += 1;
        if depth > DEEPEST || self.visited > MOST_NODES {
            let found = format!("nodes nested deeper than {DEEPEST}, or more than {MOST_NODES}");
            return Err(error(self.name, format!("node {}", node.index()), found, "a tree of nodes without cycles"));
        }
        let transform = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            if primitive.mode() != Mode::Triangles {
                continue;
            }
            let place = format!("mesh of node {}", node.index());
            let Some(positions) = primitive.get(&Semantic::Positions) else {
                return Err(error(self.name, place, "a primitive without POSITION", "positions"));
            };
            let base = self.mesh.vertices.len();
            let count = positions.count();
            self.positions(&positions, transform)?;
            let first = self.mesh.indices.len();
            match primitive.indices() {
                Some(accessor) => self.indices(&accessor, base, count)?,
                None => self.mesh.indices.extend(base as u32..(base + count) as u32),
            }
            let read = self.mesh.indices.len() - first;
            if !read.is_multiple_of(3) {
                return Err(error(self.name, place, format!("{read} indices"), "three for each triangle"));
            }
            if transform.determinant() < 0.0 {
                self.mesh.indices[first..].chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
            }
        }
        node.children().try_for_each(|child| self.node(&child, transform, depth + 1))
    }

    fn positions(&mut self, accessor: &Accessor, transform: Mat4) -> Result<(), BodyError> {
        let kind = (accessor.data_type(), accessor.dimensions());
        if kind != (DataType::F32, Dimensions::Vec3) {
            let place = format!("accessor {}", accessor.index());
            return Err(error(self.name, place, format!("{kind:?}"), "positions of three 32-bit floats"));
        }
        let (data, stride) = self.slice(accessor)?;
        for i in 0..accessor.count() {
            let b = &data[i * stride..];
            let number = |at: usize| f32::from_le_bytes([b[at], b[at + 1], b[at + 2], b[at + 3]]);
            let point = Vec3::new(number(0), number(4), number(8));
            self.mesh.vertices.push(transform.transform_point3(point));
        }
        Ok(())
    }

    fn indices(&mut self, accessor: &Accessor, base: usize, count: usize) -> Result<(), BodyError> {
        let (data, stride) = self.slice(accessor)?;
        for i in 0..accessor.count() {
            let b = &data[i * stride..];
            let index = match accessor.data_type() {
                DataType::U8 => u32::from(b[0]),
                DataType::U16 => u32::from(u16::from_le_bytes([b[0], b[1]])),
                DataType::U32 => u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
                other => {
                    let place = format!("accessor {}", accessor.index());
                    return Err(error(self.name, place, format!("{other:?} indices"), "unsigned indices"));
                }
            } as usize;
            if index >= count {
                let place = format!("accessor {}, element {i}", accessor.index());
                return Err(error(self.name, place, format!("vertex {index} of {count}"), "a vertex that exists"));
            }
            self.mesh.indices.push((base + index) as u32);
        }
        Ok(())
    }

    /// The accessor's bytes, long enough for `count` elements at the returned stride.
    fn slice(&self, accessor: &Accessor) -> Result<(Vec<u8>, usize), BodyError> {
        let place = || format!("accessor {}", accessor.index());
        let Some(view) = accessor.view().filter(|_| accessor.sparse().is_none()) else {
            return Err(error(self.name, place(), "a sparse or compressed accessor", "a plain buffer view"));
        };
        let (size, count) = (accessor.size(), accessor.count());
        let stride = view.stride().unwrap_or(size).max(size);
        let needed = count.checked_sub(1).and_then(|n| n.checked_mul(stride)).and_then(|n| n.checked_add(size));
        let from = view.offset().checked_add(accessor.offset());
        let range = from.zip(needed).and_then(|(from, n)| Some(from..from.checked_add(n)?));
        let within = view.offset().checked_add(view.length());
        let buffer = self.buffers.get(view.buffer().index());
        let data = range.filter(|r| within.is_some_and(|end| r.end <= end));
        match data.and_then(|r| buffer?.get(r)) {
            Some(bytes) => Ok((bytes.to_vec(), stride)),
            None => {
                let found = format!("{count} elements of {stride} bytes in a view of {}", view.length());
                Err(error(self.name, place(), found, "elements within their buffer view"))
            }
        }
    }
}
