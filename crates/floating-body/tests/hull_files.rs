//! Hull files: three formats of one hull agree, bad ones are refused with a message that helps.
#![cfg(feature = "mesh-files")]

use std::path::PathBuf;

use floating_body::{BodyError, Closure, Hull, TriMesh};
use proptest::prelude::*;

fn asset(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/assets/hulls").join(name)
}

#[test]
fn the_launch_is_the_same_hull_in_three_formats() {
    let hulls = ["launch.stl", "launch.obj", "launch.glb"].map(|n| Hull::from_file(asset(n), Closure::Cap).unwrap());
    for hull in &hulls {
        assert!((hull.volume() / hulls[0].volume() - 1.0).abs() < 1e-5, "{}", hull.volume());
        assert!((hull.centroid() - hulls[0].centroid()).length() < 1e-4);
        assert!(hull.centroid().z.abs() < 1e-4);
        let (low, high) = hull.bounds();
        assert!((high.x - low.x - 8.0).abs() < 1e-3 && (high.z - low.z - 2.5).abs() < 0.2, "{low} {high}");
        assert_eq!(hull.mesh().unwrap().indices.len(), hulls[0].mesh().unwrap().indices.len());
    }
    let wrapped = Hull::from_file(asset("launch.stl"), Closure::ConvexHull).unwrap();
    assert!(wrapped.volume() > hulls[0].volume() && wrapped.volume() < 1.2 * hulls[0].volume(), "{}", wrapped.volume());
}

#[test]
fn an_open_hull_is_refused_with_the_count_of_open_edges() {
    let error = Hull::from_file(asset("launch.obj"), Closure::Require).unwrap_err();
    let text = error.to_string();
    assert!(text.contains("launch.obj") && text.contains("open edges in 1 loops"), "{text}");
    let BodyError::InFile { source, .. } = error else { panic!("{text}") };
    // Two sheer lines of 32 edges and the transom's top of two (port and starboard to its centre).
    let BodyError::OpenMesh { open_edges, loops } = *source else { panic!("{text}") };
    assert_eq!((open_edges, loops), (66, 1));
}

fn message(name: &str, content: &[u8]) -> String {
    TriMesh::from_bytes(name, content).unwrap_err().to_string()
}

#[test]
fn bad_files_name_the_place_and_what_was_found() {
    for (name, content, words) in [
        (
            "a.stl",
            &b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nope\n"[..],
            ["line 4", "\"nope\"", "three numbers"],
        ),
        ("a.stl", b"solid x\nfacet normal 0 0 1\nvertex 0 0 0\nendfacet\n", ["line 4", "1 vertices", "three vertices"]),
        ("a.stl", b"", ["0 bytes", "84-byte header", "a.stl"]),
        ("a.stl", &[7; 200], ["200 bytes", "50 for each", "a.stl"]),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 9\n", ["line 3", "vertex 9 of 2", "start at 1"]),
        ("a.obj", b"v 0 0\n", ["line 1", "\"end of line\"", "three numbers"]),
        ("a.obj", b"# nothing\n", ["whole file", "0 vertices and no triangle", "at least one"]),
        ("a.gltf", b"{", ["whole file", "EOF", "valid glTF 2.0"]),
        (
            "a.gltf",
            br#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":7}}]}]}"#,
            ["primitive 0", "accessor 7 of 0", "an accessor that exists"],
        ),
        ("a.fbx", b"", ["a.fbx", "unknown extension \"fbx\"", ".stl, .obj, .gltf and .glb"]),
    ] {
        let text = message(name, content);
        assert!(words.iter().all(|w| text.contains(w)), "{text}");
    }
    let missing = TriMesh::from_file(asset("missing.stl")).unwrap_err().to_string();
    assert!(missing.contains("missing.stl") && missing.contains("cannot be read"), "{missing}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn garbage_never_panics(bytes in proptest::collection::vec(any::<u8>(), 0..400), kind in 0..4_usize) {
        let name = ["a.stl", "a.obj", "a.gltf", "a.glb"][kind];
        if let Ok(mesh) = TriMesh::from_bytes(name, &bytes) {
            let _ = Hull::from_mesh(&mesh, Closure::Cap);
            let _ = Hull::from_mesh(&mesh, Closure::ConvexHull);
        }
    }

    #[test]
    fn damaged_files_never_panic(
        kind in 0..3_usize,
        cuts in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        keep in 0.5..1.0_f64,
    ) {
        let name = ["launch.stl", "launch.obj", "launch.glb"][kind];
        let mut bytes = std::fs::read(asset(name)).unwrap();
        bytes.truncate((bytes.len() as f64 * keep) as usize);
        if kind != 1 {
            // Most damage goes into headers and JSON, where it hurts.
            bytes.resize(std::fs::read(asset(name)).unwrap().len(), 0);
        }
        for (at, value) in cuts {
            let at = if value % 2 == 0 { at.index(bytes.len()) } else { at.index(bytes.len().min(900)) };
            bytes[at] = value;
        }
        if let Ok(mesh) = TriMesh::from_bytes(name, &bytes) {
            let _ = Hull::from_mesh(&mesh, Closure::Cap);
        }
    }
}
