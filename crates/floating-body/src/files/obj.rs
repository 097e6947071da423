//! Wavefront OBJ: `v` and `f` lines; polygons are cut into fans. Other lines are skipped.

use super::{coordinates, error, shorten};
use crate::{BodyError, TriMesh};

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<TriMesh, BodyError> {
    let content = String::from_utf8_lossy(bytes);
    let mut mesh = TriMesh::default();
    let mut face = Vec::new();
    for (number, line) in (1..).zip(content.lines()) {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => mesh.vertices.push(coordinates(name, number, &mut words)?),
            Some("f") => {
                face.clear();
                for word in words {
                    face.push(corner(name, number, word, mesh.vertices.len())?);
                }
                if face.len() < 3 {
                    let found = format!("a face of {} corners", face.len());
                    return Err(error(name, format!("line {number}"), found, "at least three corners"));
                }
                let pairs = face[1..].windows(2);
                mesh.indices.extend(pairs.flat_map(|p| [face[0], p[0], p[1]]));
            }
            _ => {}
        }
    }
    Ok(mesh)
}

/// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or from the end when negative.
fn corner(name: &str, number: usize, word: &str, vertices: usize) -> Result<u32, BodyError> {
    let place = || format!("line {number}");
    let index = word.split('/').next().unwrap_or_default();
    let index: i64 =
        index.parse().map_err(|_| error(name, place(), shorten(word), "a vertex number such as 7 or 7/1/3"))?;
    let from_zero = if index < 0 { vertices as i64 + index } else { index - 1 };
    if (0..vertices as i64).contains(&from_zero) {
        Ok(from_zero as u32)
    } else {
        let found = format!("vertex {index} of {vertices} so far");
        Err(error(name, place(), found, "a vertex that was given above (numbers start at 1)"))
    }
}
