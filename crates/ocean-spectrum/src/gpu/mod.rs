//! The sea's fields on the GPU, from the same modes as on the CPU.
//!
//! [`GpuOcean`] records compute work into the host's encoder, in a [`Frame`] of uploads; it never submits or blocks. It answers no queries:
//! those are the CPU's, from [`crate::Ocean`].
//!
//! All cascades are synthesised at the size of the largest: a cascade's modes do not depend on its size, so the surface
//! is the same, drawn finer. A change of the sea needs no word: the mode sets in use are uploaded when they change, and
//! mixed in the first stage.
//!
//! # How a synthesis runs
//! Two packed spectra share a texel, two texels hold a cascade's eight fields. Transforms run along x, then along z; rows
//! that hold no modes are not transformed along x, nor read along z. A cascade with a neighbour that takes its short
//! waves holds modes in some 81 rows, whatever its size. See [`FftKernel`] for the two ways to run the transforms, and
//! [`GpuOcean::field_passes`] for what each dispatch moves.

mod error;
mod foam;
mod looks;
mod modes;
mod stages;
mod surface;
mod synthesis;
mod upload;

use std::ops::Range;

use open_water_shaders::ocean::{MAX_CASCADES, OceanCascade, OceanParams};
use open_water_shaders::surface::SurfaceCascade;

use crate::{CascadeModes, Ocean};
pub use error::GpuError;
use foam::Divergence;
pub use foam::{FOAM_SECONDS, FOAM_THRESHOLD};
use looks::Looks;
pub use open_water_shaders::pipeline::{Frame, Staging};
pub use surface::{surface_layout, surface_wgsl};
pub use synthesis::FftKernel;
use synthesis::Synthesis;
use upload::Shape;

/// A sea's modes, fields and looks on one device.
///
/// *Fields*, 32-bit floats: one texture array with a layer per cascade for the displacement and as many again for the
/// derivative, each as in [`crate::CascadeFields`]. *Looks*: half-float copies with mips down to 2 x 2 texels, the
/// displacement's spare channel holding foam, 0 to 1.
#[derive(Debug, Clone)]
pub struct GpuOcean {
    shape: Shape,
    params_buffer: wgpu::Buffer,
    divergence: Divergence,
    synthesis: Synthesis,
    looks: Looks,
}

/// A dispatch, for who wants to measure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GpuPass {
    /// Name of its shader.
    pub name: &'static str,
    /// The cascades it works on.
    pub cascades: Range<u32>,
    /// Bytes of textures and buffers that it reads and writes, each once.
    pub bytes: u64,
}

impl GpuOcean {
    /// Makes textures and pipelines. The modes are uploaded by the first [`Self::set_time`].
    ///
    /// # Errors
    /// [`GpuError::InvalidValue`] if the cascades need more than the device's limits allow.
    pub fn new(device: &wgpu::Device, ocean: &Ocean) -> Result<Self, GpuError> {
        Self::with_kernel(device, ocean, FftKernel::of(device))
    }

    /// As [`Self::new`], with transforms of one's own choice.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_kernel(device: &wgpu::Device, ocean: &Ocean, kernel: FftKernel) -> Result<Self, GpuError> {
        Self::of_modes(device, ocean.modes(), kernel)
    }

    /// As [`Self::new`], for the sea as it is at time `t`, seconds: another one while cascades change.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn new_at(device: &wgpu::Device, ocean: &Ocean, t: f64) -> Result<Self, GpuError> {
        Self::of_modes(device, ocean.mode_sets_at(t).0, FftKernel::of(device))
    }

    fn of_modes(device: &wgpu::Device, modes: &[CascadeModes], kernel: FftKernel) -> Result<Self, GpuError> {
        let shape = Shape::of(modes);
        shape.check(&device.limits())?;
        let params_buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("ocean params"),
            size: size_of::<OceanParams>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let synthesis = Synthesis::new(device, kernel, shape, modes, &params_buffer);
        let looks = Looks::new(device, shape, &params_buffer, &synthesis.fields);
        Ok(Self { shape, params_buffer, divergence: Divergence::default(), synthesis, looks })
    }

    /// Whether another sea can be drawn by this: one with as many cascades, the largest of the same size.
    ///
    /// # Errors
    /// [`GpuError::InvalidValue`] if it cannot: make a new one then.
    pub fn check(&self, ocean: &Ocean) -> Result<(), GpuError> {
        self.shape.check_same(Shape::of(ocean.modes()))
    }

    /// Whether the sea can be drawn at time `t`, seconds, and without making anything more.
    pub fn is_ready_at(&self, ocean: &Ocean, t: f64) -> bool {
        let (first, second) = ocean.mode_sets_at(t);
        self.shape == Shape::of(first) && self.synthesis.suits(first) && (second.is_none() || self.synthesis.mixes())
    }

    /// What is ready for the sea at time `t`, seconds: made on any thread while this draws on. It shares what stays
    /// the same; foam stays where the cascades do.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn ready_at(&self, device: &wgpu::Device, ocean: &Ocean, t: f64) -> Result<Self, GpuError> {
        let (first, second) = ocean.mode_sets_at(t);
        let mut ready = if self.shape == Shape::of(first) { self.clone() } else { Self::new_at(device, ocean, t)? };
        ready.synthesis.forget();
        ready.synthesis.suit(first);
        if second.is_some() {
            ready.synthesis.prepare_mixed();
        }
        Ok(ready)
    }

    /// Sets the time for the work that is encoded next: `t` in seconds, and the seconds since the last looks, by which
    /// foam fades (not finite or negative: 0). Mode sets that changed are uploaded, also those of another sea; foam
    /// stays. One that does not pass [`Self::check`] at that time is ignored. It holds for what the frame's encoder does from here on.
    pub fn set_time(&mut self, frame: &mut Frame<'_>, ocean: &Ocean, t: f64, foam_dt: f32) {
        if self.shape != Shape::of(ocean.mode_sets_at(t).0) {
            return;
        }
        self.synthesis.set(frame, ocean, t);
        self.divergence.set(ocean, t);
        let moment = ocean.moment_at(t);
        let mut params = OceanParams {
            phase: moment.phase,
            weight: moment.weight,
            cascade_count: self.shape.count,
            choppiness: moment.choppiness,
            foam_threshold: FOAM_THRESHOLD,
            foam_decay: foam::decay(foam_dt),
            cascades: [OceanCascade::default(); MAX_CASCADES],
        };
        let known = ocean.mode_sets_at(t).0.iter().zip(self.divergence.cascades(&moment)).zip(&self.synthesis.halves);
        for (cascade, ((modes, (foam_spread, foam_share)), &half)) in params.cascades.iter_mut().zip(known) {
            let place = SurfaceCascade { offset: [0.0; 2], tile: modes.tile, size: self.shape.size as f32 };
            *cascade = OceanCascade { wave_step: modes.step() as f32, foam_spread, foam_share, half, place };
        }
        for (offset, cascade) in ocean.offsets_at(t).zip(&mut params.cascades) {
            cascade.place.offset = offset.into();
        }
        frame.write(&self.params_buffer, 0, bytemuck::bytes_of(&params));
    }

    /// Records the synthesis of the fields of `cascades` cascades, the longest first; the others keep what they hold. Returns
    /// the number of dispatches.
    pub fn record_fields(&self, pass: &mut wgpu::ComputePass<'_>, cascades: u32) -> u32 {
        self.synthesis.record(pass, None, cascades)
    }

    /// Records the looks of the fields synthesised before, of as many cascades. Returns the number of dispatches.
    pub fn record_looks(&self, pass: &mut wgpu::ComputePass<'_>, cascades: u32) -> u32 {
        self.looks.record(pass, self.shape, None, cascades)
    }

    /// Fields and looks at time `t` in one compute pass; see [`Self::set_time`].
    pub fn encode(&mut self, frame: &mut Frame<'_>, ocean: &Ocean, t: f64, foam_dt: f32) {
        self.set_time(frame, ocean, t, foam_dt);
        let of = wgpu::ComputePassDescriptor { label: Some("ocean"), timestamp_writes: None };
        let mut pass = frame.encoder.begin_compute_pass(&of);
        self.record_fields(&mut pass, self.shape.count);
        self.record_looks(&mut pass, self.shape.count);
    }

    /// Fields alone at time `t` in one compute pass: for when nothing looks at foam or filtered fields.
    pub fn encode_fields(&mut self, frame: &mut Frame<'_>, ocean: &Ocean, t: f64) {
        self.set_time(frame, ocean, t, 0.0);
        let of = wgpu::ComputePassDescriptor { label: Some("ocean fields"), timestamp_writes: None };
        let mut pass = frame.encoder.begin_compute_pass(&of);
        self.record_fields(&mut pass, self.shape.count);
    }

    /// The dispatches of [`Self::record_fields`], in order.
    pub fn field_passes(&self) -> Vec<GpuPass> {
        self.synthesis.passes().cloned().collect()
    }

    /// The dispatches of [`Self::record_looks`], in order.
    pub fn look_passes(&self) -> Vec<GpuPass> {
        self.looks.passes(self.shape)
    }

    /// Records dispatch `index` of [`Self::field_passes`] alone, or, from their number on, of [`Self::look_passes`]: to
    /// time each.
    pub fn record_one(&self, pass: &mut wgpu::ComputePass<'_>, index: usize) {
        let fields = self.synthesis.passes().count();
        match index.checked_sub(fields) {
            None => self.synthesis.record(pass, Some(index), self.shape.count),
            Some(index) => self.looks.record(pass, self.shape, Some(index), self.shape.count),
        };
    }

    /// Number of dispatches of [`Self::record_fields`] of so many cascades.
    pub fn field_dispatches(&self, cascades: u32) -> u32 {
        self.synthesis.count(cascades)
    }

    /// Number of dispatches of [`Self::record_looks`].
    pub fn look_dispatches(&self) -> u32 {
        self.looks.count()
    }

    /// Number of cascades.
    pub fn cascades(&self) -> u32 {
        self.shape.count
    }

    /// Texels per side of every cascade's layers: the size of the largest.
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
