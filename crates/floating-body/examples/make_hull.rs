//! Writes the launch's hull as `launch.stl`, `launch.obj` and `launch.glb` into the folder given as argument
//! (default: `examples/assets/hulls`): an open-topped motor launch, 8 m long, 2.5 m wide.
//!
//! x is forward, y up, 0 near the waterline at 2.4 t. The STL is unwelded, the GLB stands z-up under a node that
//! turns it upright, as such files do.

use std::path::PathBuf;

use glam::Vec3;

const STATIONS: usize = 33;
const ACROSS: usize = 9;

/// Keel, chine and sheer of the starboard side at `t` from 0 (transom) to 1 (stem).
fn lines(t: f32) -> [Vec3; 3] {
    let forward = ((t - 0.35) / 0.65).max(0.0);
    let x = |rake: f32| -4.0 + 8.0 * t - rake * forward * forward;
    let fine = 1.0 - forward.powf(2.2);
    [
        Vec3::new(x(0.9), -0.46 + 0.5 * forward.powi(3), 0.0),
        Vec3::new(x(0.35), -0.17 + 0.55 * forward * forward, 1.02 * (0.94 + 0.06 * (1.0 - t)) * fine),
        Vec3::new(x(0.0), 0.62 + 0.38 * forward * forward, 1.25 * (0.92 + 0.08 * (1.0 - (2.0 * t - 0.7).abs())) * fine),
    ]
}

/// A point of a section: `s` from 0 at the keel over the chine at 1/2 to the sheer at 1.
fn section(t: f32, s: f32) -> Vec3 {
    let [keel, chine, sheer] = lines(t);
    if s <= 0.5 { keel.lerp(chine, s * 2.0) } else { chine.lerp(sheer, s * 2.0 - 1.0) }
}

/// Vertices and triangles, welded, wound outwards, open at the top.
fn launch() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::<[u32; 3]>::new());
    let row = 2 * ACROSS - 1; // port sheer .. keel .. starboard sheer
    for i in 0..STATIONS {
        let t = i as f32 / (STATIONS - 1) as f32;
        for j in 0..row {
            let side = j as f32 - (ACROSS - 1) as f32;
            let p = section(t, side.abs() / (ACROSS - 1) as f32);
            vertices.push(Vec3::new(p.x, p.y, p.z * side.signum()));
        }
    }
    let at = |i: usize, j: usize| (i * row + j) as u32;
    for i in 0..STATIONS - 1 {
        for j in 0..row - 1 {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    let center = vertices.len() as u32;
    vertices.push(Vec3::new(-4.0, 0.2, 0.0));
    triangles.extend((0..row - 1).map(|j| [at(0, j + 1), at(0, j), center]));
    // At the stem both sides meet in the centre line: join them there.
    for j in 0..ACROSS - 1 {
        let (port, starboard) = (at(STATIONS - 1, j), at(STATIONS - 1, row - 1 - j));
        triangles.iter_mut().flatten().filter(|v| **v == starboard).for_each(|v| *v = port);
    }
    (vertices, triangles)
}

fn normal(t: &[Vec3; 3]) -> Vec3 {
    (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero()
}

fn stl(corners: &[[Vec3; 3]]) -> Vec<u8> {
    let mut out = vec![b' '; 80];
    out.extend((corners.len() as u32).to_le_bytes());
    for t in corners {
        for v in [normal(t), t[0], t[1], t[2]] {
            out.extend(v.to_array().iter().flat_map(|c| c.to_le_bytes()));
        }
        out.extend([0, 0]);
    }
    out
}

fn obj(vertices: &[Vec3], triangles: &[[u32; 3]]) -> String {
    let mut out = String::from("# motor launch, 8 m, metres, y up, x forward\no launch\n");
    for v in vertices {
        out += &format!("v {} {} {}\n", v.x, v.y, v.z);
    }
    for t in triangles {
        out += &format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    out
}

fn glb(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<u8> {
    let turned: Vec<Vec3> = vertices.iter().map(|v| Vec3::new(v.x, -v.z, v.y)).collect();
    let mut data: Vec<u8> = turned.iter().flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes).collect();
    let positions = data.len();
    data.extend(triangles.iter().flatten().flat_map(|i| (*i as u16).to_le_bytes()));
    data.resize(data.len().next_multiple_of(4), 0);
    let low = turned.iter().copied().fold(Vec3::INFINITY, Vec3::min).to_array();
    let high = turned.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max).to_array();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let mut json = format!(
        concat!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"#,
            r#""nodes":[{{"name":"launch","mesh":0,"rotation":[-{half},0,0,{half}]}}],"#,
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"#,
            r#""buffers":[{{"byteLength":{bytes}}}],"#,
            r#""bufferViews":[{{"buffer":0,"byteLength":{positions}}},"#,
            r#"{{"buffer":0,"byteOffset":{positions},"byteLength":{indices}}}],"#,
            r#""accessors":[{{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3","#,
            r#""min":{low:?},"max":{high:?}}},"#,
            r#"{{"bufferView":1,"componentType":5123,"count":{corners},"type":"SCALAR"}}]}}"#
        ),
        half = half,
        bytes = data.len(),
        positions = positions,
        indices = triangles.len() * 6,
        vertices = vertices.len(),
        corners = triangles.len() * 3,
        low = low,
        high = high,
    )
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut out = b"glTF".to_vec();
    out.extend(2_u32.to_le_bytes());
    out.extend((28 + json.len() as u32 + data.len() as u32).to_le_bytes());
    for (chunk, kind) in [(&json, b"JSON"), (&data, b"BIN\0")] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend(kind);
        out.extend(chunk);
    }
    out
}

fn main() -> std::io::Result<()> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("examples/assets/hulls"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let (vertices, triangles) = launch();
    let corners: Vec<[Vec3; 3]> = triangles.iter().map(|t| t.map(|i| vertices[i as usize])).collect();
    std::fs::write(folder.join("launch.stl"), stl(&corners))?;
    std::fs::write(folder.join("launch.obj"), obj(&vertices, &triangles))?;
    std::fs::write(folder.join("launch.glb"), glb(&vertices, &triangles))?;
    println!("{} vertices, {} triangles in {}", vertices.len(), triangles.len(), folder.display());
    Ok(())
}
