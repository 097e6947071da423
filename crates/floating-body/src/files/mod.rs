//! Hull meshes from files: STL (binary and text, unwelded), OBJ, glTF (`.gltf`, `.glb`, scene transforms applied).
//!
//! Units and axes are taken as they are, metres with y up and x forward; [`TriMesh::scaled`] and
//! [`TriMesh::from_z_up`] turn others. Materials, normals and textures are ignored. A broken file gives an error that
//! names the place, never a panic.

mod gltf;
mod obj;
mod stl;

use std::path::Path;

use crate::{BodyError, Closure, Hull, TriMesh};

impl TriMesh {
    /// The triangles of a `.stl`, `.obj`, `.gltf` or `.glb` file, as they stand in it.
    ///
    /// # Errors
    /// [`BodyError::Read`], [`BodyError::UnknownExtension`] or [`BodyError::Parse`], naming the file and the place.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, BodyError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|source| BodyError::Read { path: path.into(), source })?;
        parse(&path.display().to_string(), &bytes, path.parent())
    }

    /// The triangles of a file's content; the extension of `name` tells the format. A glTF must embed its buffers.
    ///
    /// # Errors
    /// As [`TriMesh::from_file`].
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, BodyError> {
        parse(name, bytes, None)
    }
}

impl Hull {
    /// A hull from a mesh file.
    ///
    /// # Errors
    /// As [`TriMesh::from_file`] and [`Hull::from_mesh`]; the file is named in both cases.
    pub fn from_file(path: impl AsRef<Path>, closure: Closure) -> Result<Self, BodyError> {
        let path = path.as_ref();
        Self::from_mesh(&TriMesh::from_file(path)?, closure)
            .map_err(|e| BodyError::InFile { name: path.display().to_string(), source: Box::new(e) })
    }
}

fn parse(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<TriMesh, BodyError> {
    let extension = Path::new(name).extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
    let mesh = match extension.as_str() {
        "stl" => stl::parse(name, bytes),
        "obj" => obj::parse(name, bytes),
        "gltf" | "glb" => gltf::parse(name, bytes, folder),
        _ => return Err(BodyError::UnknownExtension { name: name.into(), found: extension }),
    }?;
    if mesh.indices.is_empty() {
        let found = format!("{} vertices and no triangle", mesh.vertices.len());
        return Err(error(name, "whole file", found, "at least one triangle"));
    }
    Ok(mesh)
}

/// A parse error.
fn error(name: &str, place: impl Into<String>, found: impl Into<String>, expected: &'static str) -> BodyError {
    BodyError::Parse { name: name.into(), place: place.into(), found: found.into(), expected }
}

/// The three coordinates that `words` should start with.
fn coordinates<'a>(
    name: &str,
    line: usize,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<glam::Vec3, BodyError> {
    let mut read = || {
        let word = words.next().unwrap_or("end of line");
        word.parse::<f32>().map_err(|_| error(name, format!("line {line}"), shorten(word), "three numbers"))
    };
    Ok(glam::Vec3::new(read()?, read()?, read()?))
}

/// A word fit for a message.
fn shorten(word: &str) -> String {
    let mut short: String = word.chars().take(40).filter(|c| !c.is_control()).collect();
    if word.chars().count() > 40 {
        short.push_str("...");
    }
    format!("{short:?}")
}
