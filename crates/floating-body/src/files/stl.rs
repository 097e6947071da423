//! STL, binary and text. Corners stay unwelded; normals in the file are ignored in favour of the winding.

use glam::Vec3;

use super::{coordinates, error, shorten};
use crate::{BodyError, TriMesh};

const HEADER: usize = 84;
const RECORD: usize = 50;

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<TriMesh, BodyError> {
    // Some binary files start with "solid" too, so the length decides where it fits.
    let count = bytes.get(80..HEADER).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    let fits = count.is_some_and(|n| n.checked_mul(RECORD).and_then(|l| l.checked_add(HEADER)) == Some(bytes.len()));
    let is_text = bytes.trim_ascii_start().starts_with(b"solid");
    match count {
        Some(count) if fits => Ok(binary(bytes, count)),
        _ if is_text => text(name, bytes),
        Some(count) => {
            let found = format!("{} bytes for {count} triangles", bytes.len());
            Err(error(name, "bytes 80 to 83 (triangle count)", found, "84 bytes and 50 for each triangle"))
        }
        None => Err(error(name, "whole file", format!("{} bytes", bytes.len()), "\"solid\" or an 84-byte header")),
    }
}

fn binary(bytes: &[u8], count: usize) -> TriMesh {
    let mut mesh = TriMesh::default();
    let number = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    for record in bytes[HEADER..].chunks_exact(RECORD) {
        for corner in record[12..48].chunks_exact(12) {
            mesh.vertices.push(Vec3::new(number(corner), number(&corner[4..]), number(&corner[8..])));
        }
    }
    mesh.indices = (0..3 * count as u32).collect();
    mesh
}

fn text(name: &str, bytes: &[u8]) -> Result<TriMesh, BodyError> {
    let content = String::from_utf8_lossy(bytes);
    let (mut mesh, mut corners, mut open) = (TriMesh::default(), 0, false);
    for (number, line) in (1..).zip(content.lines()) {
        let place = || format!("line {number}");
        let mut words = line.split_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("facet") if !open => (open, corners) = (true, 0),
            Some("facet") => return Err(error(name, place(), "facet within a facet", "endfacet first")),
            Some("vertex") if open => {
                mesh.indices.push(mesh.vertices.len() as u32);
                mesh.vertices.push(coordinates(name, number, &mut words)?);
                corners += 1;
            }
            Some("vertex") => return Err(error(name, place(), "a vertex outside a facet", "facet first")),
            Some("endfacet") if open && corners == 3 => open = false,
            Some("endfacet") => {
                return Err(error(name, place(), format!("{corners} vertices in a facet"), "three vertices"));
            }
            Some("solid" | "endsolid" | "outer" | "endloop") | None => {}
            Some(other) => {
                return Err(error(
                    name,
                    place(),
                    shorten(other),
                    "solid, facet, outer, vertex, endloop, endfacet or endsolid",
                ));
            }
        }
    }
    if open { Err(error(name, "end of file", "an unfinished facet", "endfacet")) } else { Ok(mesh) }
}
