//! The land's rasters on the device.

use glam::DVec2;
use open_water_shaders::surface::SurfaceLand;

use crate::OpenWaterError;

/// Layers of the raster.
const LAYERS: u32 = 3;

/// The land as the composite surface reads it.
pub(crate) struct LandTexels {
    /// World place of texel (0, 0), metres.
    pub(crate) corner: DVec2,
    /// Distance of neighbouring texels, metres.
    pub(crate) texel: f32,
    /// Texels along x and z, from 2.
    pub(crate) size: [u32; 2],
    /// Row-major, x fastest: factors of cascades 0 to 3, of 4 to 7, and (elevation of the bed in metres above datum, open
    /// water 0 to 1, nearness of walls 0 to 1, 0).
    pub(crate) layers: [Vec<[f32; 4]>; LAYERS as usize],
}

/// A texture that holds [`LandTexels`].
pub(crate) struct Land {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    corner: DVec2,
    texel: f32,
}

impl Land {
    /// Room for rasters of that size.
    pub(crate) fn new(device: &wgpu::Device, size: [u32; 2]) -> Result<Self, OpenWaterError> {
        let most = device.limits().max_texture_dimension_2d;
        let needed = size[0].max(size[1]);
        if needed > most {
            let limit = "max_texture_dimension_2d";
            return Err(OpenWaterError::DeviceLimit { limit, found: most.into(), needed: needed.into() });
        }
        let [width, height] = size;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("surface_land"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: LAYERS },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Ok(Self { texture, view, corner: DVec2::ZERO, texel: 1.0 })
    }

    /// Replaces what the texture holds by a raster of the same size.
    pub(crate) fn write(&mut self, queue: &wgpu::Queue, texels: &LandTexels) {
        (self.corner, self.texel) = (texels.corner, texels.texel);
        let [width, height] = self.size();
        for (z, layer) in (0..).zip(&texels.layers) {
            let place = wgpu::TexelCopyTextureInfo {
                texture: &self.texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y: 0, z },
                aspect: wgpu::TextureAspect::All,
            };
            let row = width * size_of::<[f32; 4]>() as u32;
            let layout =
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: Some(height) };
            let extent = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
            queue.write_texture(place, bytemuck::cast_slice(layer), layout, extent);
        }
    }

    pub(crate) fn size(&self) -> [u32; 2] {
        [self.texture.width(), self.texture.height()]
    }

    pub(crate) fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// The table's entry, for a local origin in the world.
    pub(crate) fn entry(&self, origin: DVec2) -> SurfaceLand {
        SurfaceLand {
            corner: (self.corner - origin).as_vec2().into(),
            texel: self.texel,
            present: 1,
            size: self.size(),
            ..Default::default()
        }
    }
}
