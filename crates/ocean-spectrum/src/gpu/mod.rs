//! The sea's fields on the GPU, from the same modes as on the CPU.
//!
//! [`GpuOcean`] records compute work into the host's encoder; it never submits, polls or blocks. It answers no queries:
//! those are the CPU's, from [`crate::Ocean`].

mod error;
mod foam;
mod looks;
mod modes;
mod synthesis;
mod upload;

use open_water_shaders::ocean::OceanParams;

use crate::Ocean;
pub use error::GpuError;
pub use foam::{FOAM_SECONDS, FOAM_THRESHOLD};
use looks::Looks;
pub use synthesis::FftKernel;
use synthesis::Synthesis;
use upload::Shape;

/// A sea's modes, fields and looks on one device.
///
/// *Fields*, 32-bit floats: one texture array with a layer per cascade for the displacement and as many again for the
/// derivative, each as in [`crate::CascadeFields`]. *Looks*: half-float copies with mips down to 2 x 2 texels, the
/// displacement's spare channel holding foam, 0 to 1.
#[derive(Debug)]
pub struct GpuOcean {
    shape: Shape,
    params: OceanParams,
    params_buffer: wgpu::Buffer,
    synthesis: Synthesis,
    looks: Looks,
}

impl GpuOcean {
    /// Makes textures and pipelines, and takes over the modes.
    ///
    /// # Errors
    /// [`GpuError::InvalidValue`] if the cascades differ in size, or need more than the device's limits allow.
    pub fn new(device: &wgpu::Device, ocean: &Ocean) -> Result<Self, GpuError> {
        Self::with_kernel(device, ocean, FftKernel::of(device))
    }

    /// As [`Self::new`], with transforms of one's own choice.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_kernel(device: &wgpu::Device, ocean: &Ocean, kernel: FftKernel) -> Result<Self, GpuError> {
        let shape = Shape::of(ocean)?;
        shape.check(&device.limits())?;
        let params = upload::params(ocean);
        let params_buffer =
            upload::buffer(device, "ocean params", bytemuck::bytes_of(&params), wgpu::BufferUsages::UNIFORM);
        let synthesis = Synthesis::new(device, kernel, shape, ocean, &params_buffer);
        let looks = Looks::new(device, shape, &params_buffer, &synthesis.fields);
        Ok(Self { shape, params, params_buffer, synthesis, looks })
    }

    /// Takes over a changed sea with as many cascades of the same size. Foam stays.
    ///
    /// # Errors
    /// [`GpuError::InvalidValue`] if number or size of the cascades changed: make a new one then.
    pub fn reload(&mut self, ocean: &Ocean) -> Result<(), GpuError> {
        self.shape.check_same(Shape::of(ocean)?)?;
        self.params = upload::params(ocean);
        self.synthesis.modes.set(ocean);
        Ok(())
    }

    /// Sets the time for the work that is encoded next: `phase` from [`Ocean::phase_at`], and the seconds since the
    /// last looks, by which foam fades (not finite or negative: 0). A changed sea is uploaded here. It holds for everything up to the next submit.
    pub fn set_time(&mut self, queue: &wgpu::Queue, phase: u32, foam_dt: f32) {
        self.synthesis.modes.flush(queue);
        self.params.phase = phase;
        self.params.foam_decay = foam::decay(foam_dt);
        queue.write_buffer(&self.params_buffer, 0, bytemuck::bytes_of(&self.params));
    }

    /// Records the synthesis of the fields: [`Self::field_dispatches`] dispatches.
    pub fn record_fields(&self, pass: &mut wgpu::ComputePass<'_>) {
        self.synthesis.record(pass, self.shape);
    }

    /// Records the looks of the fields synthesised before: [`Self::look_dispatches`] dispatches.
    pub fn record_looks(&self, pass: &mut wgpu::ComputePass<'_>) {
        self.looks.record(pass, self.shape);
    }

    /// Fields and looks at `phase`, in one compute pass.
    pub fn encode(&mut self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, phase: u32, foam_dt: f32) {
        self.set_time(queue, phase, foam_dt);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("ocean"), timestamp_writes: None });
        self.record_fields(&mut pass);
        self.record_looks(&mut pass);
    }

    /// Fields alone at `phase`, in one compute pass: for when nothing looks at foam or filtered fields.
    pub fn encode_fields(&mut self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, phase: u32) {
        self.set_time(queue, phase, 0.0);
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("ocean fields"), timestamp_writes: None });
        self.record_fields(&mut pass);
    }

    /// Dispatches of [`Self::record_fields`].
    pub fn field_dispatches(&self) -> u32 {
        self.synthesis.dispatches()
    }

    /// Dispatches of [`Self::record_looks`].
    pub fn look_dispatches(&self) -> u32 {
        self.looks.dispatches()
    }

    /// Number of cascades.
    pub fn cascades(&self) -> u32 {
        self.shape.count
    }

    /// Texels per side of every cascade.
    pub fn size(&self) -> u32 {
        self.shape.size
    }

    /// The texture of the fields (`Rgba32Float`): displacement layers, then derivative layers.
    pub fn fields(&self) -> &wgpu::Texture {
        &self.synthesis.fields
    }

    /// The texture of the looks (`Rgba16Float`, with mips): displacement layers, then derivative layers.
    pub fn looks(&self) -> &wgpu::Texture {
        &self.looks.texture
    }

    /// `(Dx, h, Dz, dDx/dz)`, a layer per cascade: binding 1 of the composite surface.
    pub fn displacement(&self) -> &wgpu::TextureView {
        &self.synthesis.displacement
    }

    /// `(dh/dx, dh/dz, dDx/dx, dDz/dz)`, a layer per cascade: binding 2 of the composite surface.
    pub fn derivative(&self) -> &wgpu::TextureView {
        &self.synthesis.derivative
    }

    /// `(Dx, h, Dz, foam)`, filterable, with mips: binding 4 of the composite surface.
    pub fn looks_displacement(&self) -> &wgpu::TextureView {
        &self.looks.displacement
    }

    /// As [`Self::derivative`], filterable, with mips: binding 5 of the composite surface.
    pub fn looks_derivative(&self) -> &wgpu::TextureView {
        &self.looks.derivative
    }
}
