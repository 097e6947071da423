//! What a game's own shader includes when it has the sea alone.

use open_water_shaders::ocean;
use open_water_shaders::pipeline::bind_group;

use super::GpuOcean;

/// WGSL with `open_water_surface`, its bind group at index `group`: put it in front of your own shader.
///
/// ```wgsl
/// struct OpenWaterSurface { displacement: vec3<f32>, normal: vec3<f32>, foam: f32 }
/// fn open_water_surface(xz: vec2<f32>) -> OpenWaterSurface
/// fn open_water_surface_over(xz: vec2<f32>, footprint: f32) -> OpenWaterSurface
/// ```
///
/// `xz` is a local position of calm water, metres: the mesh's vertex before it moves. `footprint` is the width in metres
/// that a sample stands for (0 in the first form); mips leave out what is finer. In a vertex shader it is the distance of
/// neighbouring vertices; in a fragment shader `max(length(dpdx(xz)), length(dpdy(xz)))`. A footprint wider than a
/// quarter of a cascade's tile fades that cascade out.
///
/// The answers come from half-float looks ([`GpuOcean::record_looks`]), bilinearly, for looks: heights of the default sea
/// err by .34 % of the significant wave height (rms), of which half floats bring .01 %. What floats asks
/// [`Ocean::sample`](crate::Ocean::sample). Near folds the normal is kept from lying down, and
/// `dDx/dz` is left out of it. Maps ([`Ocean::set_amplitudes`](crate::Ocean::set_amplitudes)) do not apply.
///
/// ```
/// use ocean_spectrum::gpu::{GpuOcean, Staging, surface_layout, surface_wgsl};
/// use ocean_spectrum::{Ocean, OceanDesc};
///
/// const VERTEX: &str = "
/// @vertex fn sea(@location(0) xz: vec2<f32>) -> @builtin(position) vec4<f32> {
///     let s = open_water_surface_over(xz, 0.5);
///     return vec4<f32>(0.01 * (vec3<f32>(xz.x, 0.0, xz.y) + s.displacement), 1.0);
/// }";
///
/// /// At the start: the shader, its layout and group 0.
/// fn make(device: &wgpu::Device, sea: &GpuOcean) -> (wgpu::ShaderModule, wgpu::BindGroupLayout, wgpu::BindGroup) {
///     let source = wgpu::ShaderSource::Wgsl((surface_wgsl(0) + VERTEX).into());
///     let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
///     let layout = surface_layout(device);
///     let group = sea.surface_bind_group(device, &layout);
///     (module, layout, group)
/// }
///
/// /// Every frame, before the pass that draws with that group. The staging ring is made once, by `Staging::new(device)`.
/// fn frame(ring: &mut Staging, encoder: &mut wgpu::CommandEncoder, sea: &mut GpuOcean, ocean: &Ocean, t: f64, dt: f32) {
///     // None behind a slow GPU: what was encoded last stays in sight.
///     if let Some(mut frame) = ring.frame(encoder) {
///         sea.encode(&mut frame, ocean, t, dt);
///     }
/// }
/// ```
pub fn surface_wgsl(group: u32) -> String {
    ocean::surface_wgsl(group)
}

/// Layout of the bind group of [`surface_wgsl`], for vertex, fragment and compute stages: a uniform buffer, two filterable
/// texture arrays, a filtering sampler.
pub fn surface_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    ocean::surface_layout(device)
}

impl GpuOcean {
    /// The bind group of [`surface_wgsl`]: it stays valid as long as this sea does, and shows what was encoded last.
    pub fn surface_bind_group(&self, device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("sea"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let texture = wgpu::BindingResource::TextureView;
        bind_group(
            device,
            "sea",
            layout,
            &[
                self.params_buffer.as_entire_binding(),
                texture(self.looks_displacement()),
                texture(self.looks_derivative()),
                wgpu::BindingResource::Sampler(&sampler),
            ],
        )
    }
}
