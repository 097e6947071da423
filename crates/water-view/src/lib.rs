//! A renderer of Open Water's composite surface on plain wgpu: the sea on a projected grid, the sky above it, and
//! simple lit meshes, drawn into the host's own render pass against the host's own depth.
//!
//! ```no_run
//! # fn f(device: &wgpu::Device, queue: &wgpu::Queue, surface_layout: &wgpu::BindGroupLayout, surface: &wgpu::BindGroup,
//! #      pass: &mut wgpu::RenderPass<'_>) -> Result<(), water_view::ViewError> {
//! use water_view::{Camera, ViewDesc, ViewParams, WaterView};
//!
//! let desc = ViewDesc::default();
//! let mut view = WaterView::new(device, &desc, surface_layout)?;
//! // Every frame:
//! let camera = Camera { aspect: 16.0 / 9.0, ..Camera::default() };
//! view.prepare(queue, &ViewParams::new(camera.view(desc.reverse_z)));
//! view.draw(pass, surface);
//! # Ok(())
//! # }
//! ```
//!
//! It never submits, never blocks, and allocates nothing on the GPU after `new` (meshes excepted). It knows only the
//! composite's bind group, not who fills it. Not here: the view from under water, reflections of meshes in the water,
//! shadows, clouds, orthographic cameras.

mod camera;
mod desc;
mod foam;
mod frame;
mod mesh;
mod projector;
mod sky;
mod water;

pub use camera::{Camera, View};
pub use desc::{ViewDesc, ViewError};
pub use frame::{Sky, ViewParams, WaterLook};
pub use mesh::{Instance, MeshData, MeshId, MeshVertex, MeshView};
pub use water::WaterView;
