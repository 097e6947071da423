//! Lit triangle meshes under the view's sun and sky: boats, crates, buoys.

use bytemuck::{Pod, Zeroable};
use glam::{Affine3A, Vec3};
use open_water_shaders::view;

use crate::water::{Blend, WaterView, filled, pipeline};

/// A corner of a mesh.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct MeshVertex {
    /// Position in the mesh's own frame, metres.
    pub position: [f32; 3],
    /// Outward normal, unit length.
    pub normal: [f32; 3],
    /// sRGB colour, 0 to 255; alpha is gloss: 0 dull, 255 wet paint.
    pub color: [u8; 4],
}

/// Triangles, counter-clockwise seen from outside (not culled, so open meshes show both sides).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshData {
    /// Corners.
    pub vertices: Vec<MeshVertex>,
    /// Three per triangle.
    pub indices: Vec<u32>,
}

impl MeshData {
    /// Adds a flat-shaded triangle.
    pub fn triangle(&mut self, corners: [Vec3; 3], color: [u8; 4]) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y).into();
        for corner in corners {
            self.indices.push(self.vertices.len() as u32);
            self.vertices.push(MeshVertex { position: corner.into(), normal, color });
        }
    }

    /// Adds a box with edges parallel to the axes.
    pub fn cuboid(&mut self, center: Vec3, half: Vec3, color: [u8; 4]) {
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let mut n = Vec3::ZERO;
                n[axis] = sign;
                let u = Vec3::from_array(std::array::from_fn(|i| f32::from(u8::from(i == (axis + 1) % 3))));
                let v = n.cross(u);
                let corner = |s: f32, t: f32| center + half * (n + s * u + t * v);
                let (p, q, r, o) = (corner(-1., -1.), corner(1., -1.), corner(1., 1.), corner(-1., 1.));
                self.triangle([p, q, r], color);
                self.triangle([p, r, o], color);
            }
        }
    }

    /// Adds a closed cylinder about the line from `a` to `b` with `sides` faces, smooth around.
    pub fn cylinder(&mut self, a: Vec3, b: Vec3, radius: f32, sides: u32, color: [u8; 4]) {
        let axis = (b - a).normalize_or(Vec3::Y);
        let u = axis.any_orthonormal_vector();
        let v = axis.cross(u);
        let around = |i: u32| {
            let (sin, cos) = (std::f32::consts::TAU * i as f32 / sides as f32).sin_cos();
            u * cos + v * sin
        };
        for i in 0..sides {
            let (m, n) = (around(i), around(i + 1));
            let base = self.vertices.len() as u32;
            for (end, side) in [(a, m), (a, n), (b, n), (b, m)] {
                self.vertices.push(MeshVertex { position: (end + radius * side).into(), normal: side.into(), color });
            }
            self.indices.extend([0, 1, 2, 0, 2, 3].map(|k| base + k));
            self.triangle([a, a + radius * n, a + radius * m], color);
            self.triangle([b, b + radius * m, b + radius * n], color);
        }
    }
}

/// Where a mesh stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// From the mesh's frame to local space; rotation and uniform scale.
    pub world_from_mesh: Affine3A,
    /// Multiplies the mesh's colour.
    pub tint: Vec3,
}

/// An instance as the shader reads it: three rows of the transform and the tint.
type Packed = [[f32; 4]; 4];

/// A mesh of a [`MeshView`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshId(usize);

#[derive(Debug)]
struct Mesh {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
    instances: wgpu::Buffer,
    room: usize,
    drawn: u32,
}

/// Draws meshes in the same pass, under the same light, as the [`WaterView`] it was made from.
#[derive(Debug)]
pub struct MeshView {
    pipeline: wgpu::RenderPipeline,
    meshes: Vec<Mesh>,
    scratch: Vec<Packed>,
}

impl MeshView {
    /// Builds the pipeline.
    pub fn new(device: &wgpu::Device, view: &WaterView) -> Self {
        let buffers = [
            Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<MeshVertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4],
            }),
            Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Packed>() as u64,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &wgpu::vertex_attr_array![3 => Float32x4, 4 => Float32x4, 5 => Float32x4, 6 => Float32x4],
            }),
        ];
        Self {
            pipeline: pipeline(device, view.desc(), &view::MESH, &[view.layout()], &buffers, Blend::Opaque, &[]),
            meshes: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// Uploads a mesh with room for `instances` of it. Indices beyond the vertices are dropped with their triangle.
    pub fn add(&mut self, device: &wgpu::Device, data: &MeshData, instances: usize) -> MeshId {
        let count = data.vertices.len() as u32;
        let indices: Vec<u32> =
            data.indices.chunks_exact(3).filter(|t| t.iter().all(|i| *i < count)).flatten().copied().collect();
        self.meshes.push(Mesh {
            vertices: filled(device, "mesh", wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&data.vertices)),
            indices: filled(device, "mesh", wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&indices)),
            index_count: indices.len() as u32,
            instances: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("instances"),
                size: (instances.max(1) * size_of::<Packed>()) as u64,
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            room: instances,
            drawn: 0,
        });
        MeshId(self.meshes.len() - 1)
    }

    /// Says where a mesh stands in the coming frame. Instances beyond its room, and ones that are not finite, are left
    /// out; an id of another view does nothing.
    pub fn place(&mut self, queue: &wgpu::Queue, id: MeshId, instances: &[Instance]) {
        let Some(mesh) = self.meshes.get_mut(id.0) else {
            return;
        };
        self.scratch.clear();
        self.scratch.extend(
            instances.iter().filter(|i| i.world_from_mesh.is_finite() && i.tint.is_finite()).take(mesh.room).map(|i| {
                let m = i.world_from_mesh.matrix3.transpose();
                let t = i.world_from_mesh.translation;
                [
                    Vec3::from(m.x_axis).extend(t.x).into(),
                    Vec3::from(m.y_axis).extend(t.y).into(),
                    Vec3::from(m.z_axis).extend(t.z).into(),
                    i.tint.extend(1.0).into(),
                ]
            }),
        );
        mesh.drawn = self.scratch.len() as u32;
        if mesh.drawn > 0 {
            queue.write_buffer(&mesh.instances, 0, bytemuck::cast_slice(&self.scratch));
        }
    }

    /// Draws all placed meshes with the camera and light of `view`'s last `prepare`.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, view: &WaterView) {
        let Some(group) = view.group() else {
            return;
        };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        for mesh in self.meshes.iter().filter(|m| m.drawn > 0 && m.index_count > 0) {
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_vertex_buffer(1, mesh.instances.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.index_count, 0, 0..mesh.drawn);
        }
    }
}
