//! Bytes back from the device, waiting for them: fine for evidence, never for a game.

use super::{CaseError, Gpu};

impl Gpu {
    /// The f32 values of a buffer that allows `COPY_SRC`.
    pub fn read_buffer(&self, buffer: &wgpu::Buffer) -> Result<Vec<f32>, CaseError> {
        let staging = self.staging(buffer.size());
        self.run(|encoder| encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size()))?;
        self.map(&staging)
    }

    /// The texels of an `Rgba32Float` texture's first mip, layer by layer. Its rows must fill whole 256 bytes.
    pub fn read_texture(&self, texture: &wgpu::Texture) -> Result<Vec<[f32; 4]>, CaseError> {
        let bytes_per_row = texture.width() * 16;
        if !bytes_per_row.is_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT) {
            return Err(format!("a texture {} texels wide cannot be copied row by row", texture.width()).into());
        }
        let size = texture.size();
        let staging = self.staging(u64::from(bytes_per_row * size.height * size.depth_or_array_layers));
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(bytes_per_row),
            rows_per_image: Some(size.height),
        };
        self.run(|encoder| {
            encoder.copy_texture_to_buffer(
                texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo { buffer: &staging, layout },
                size,
            );
        })?;
        Ok(self.map(&staging)?.as_chunks::<4>().0.to_vec())
    }

    fn staging(&self, size: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("evidence readback"),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    fn map(&self, staging: &wgpu::Buffer) -> Result<Vec<f32>, CaseError> {
        staging.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let view = staging.get_mapped_range(..)?;
        Ok(view.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect())
    }
}
