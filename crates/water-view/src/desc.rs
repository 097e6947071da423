//! What a view draws into, and what can be wrong with that.

use wgpu::TextureFormat;

/// Description of a [`crate::WaterView`]: the host's targets and the size of the grid.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewDesc {
    /// Format of the colour target. Float formats receive linear radiance times exposure (tone mapping is the host's);
    /// unorm formats receive the display curve, dithered, sRGB-encoded by the target or by the shader.
    pub color_format: TextureFormat,
    /// Format of the depth target. The sea and meshes are tested against it and written into it.
    pub depth_format: TextureFormat,
    /// Samples per pixel of both targets: 1, 2, 4, 8 or 16, as the adapter allows.
    pub samples: u32,
    /// Whether depth 0 is far and 1 near.
    pub reverse_z: bool,
    /// Columns and rows of the projected grid, 8 to 4096 each.
    pub grid: [u32; 2],
    /// Whether the water may have land, now or later. A view without does not show it, and is cheaper on software
    /// adapters, which run both sides of a branch.
    pub land: bool,
}

impl Default for ViewDesc {
    fn default() -> Self {
        Self {
            color_format: TextureFormat::Rgba8UnormSrgb,
            depth_format: TextureFormat::Depth32Float,
            samples: 1,
            reverse_z: true,
            grid: [256, 384],
            land: true,
        }
    }
}

/// A description that cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A number is out of its bound.
    #[error("{field} is {value}, allowed: {bound}")]
    InvalidValue {
        /// Field of the description.
        field: &'static str,
        /// What it held.
        value: f64,
        /// What it may hold.
        bound: &'static str,
    },
    /// A texture format does not fit.
    #[error("{field} is {format:?}, allowed: {bound}")]
    InvalidFormat {
        /// Field of the description.
        field: &'static str,
        /// What it held.
        format: TextureFormat,
        /// What it may hold.
        bound: &'static str,
    },
}

/// How colour leaves the shader.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Output {
    /// `ViewFrame::output_mode`.
    pub(crate) mode: u32,
    /// `ViewFrame::display_step`.
    pub(crate) step: f32,
}

impl ViewDesc {
    /// Checks every field and finds out how colour is to be written.
    pub(crate) fn check(&self) -> Result<Output, ViewError> {
        if !matches!(self.samples, 1 | 2 | 4 | 8 | 16) {
            return Err(ViewError::InvalidValue {
                field: "samples",
                value: f64::from(self.samples),
                bound: "1, 2, 4, 8 or 16",
            });
        }
        for (field, value) in [("grid[0]", self.grid[0]), ("grid[1]", self.grid[1])] {
            if !(8..=4096).contains(&value) {
                return Err(ViewError::InvalidValue { field, value: f64::from(value), bound: "8 to 4096" });
            }
        }
        if !self.depth_format.has_depth_aspect() {
            return Err(ViewError::InvalidFormat {
                field: "depth_format",
                format: self.depth_format,
                bound: "a format with depth",
            });
        }
        use TextureFormat as F;
        let (mode, step) = match self.color_format {
            F::Rgba16Float | F::Rg11b10Ufloat | F::Rgba32Float => (0, 0.0),
            F::Rgba8UnormSrgb | F::Bgra8UnormSrgb => (1, 1.0 / 255.0),
            F::Rgba8Unorm | F::Bgra8Unorm => (2, 1.0 / 255.0),
            F::Rgb10a2Unorm => (2, 1.0 / 1023.0),
            format => {
                return Err(ViewError::InvalidFormat {
                    field: "color_format",
                    format,
                    bound: "Rgba8Unorm(Srgb), Bgra8Unorm(Srgb), Rgb10a2Unorm, Rg11b10Ufloat, Rgba16Float, Rgba32Float",
                });
            }
        };
        Ok(Output { mode, step })
    }

    /// Depth state of what is drawn into the host's pass.
    pub(crate) fn depth_stencil(&self, write: bool) -> wgpu::DepthStencilState {
        wgpu::DepthStencilState {
            format: self.depth_format,
            depth_write_enabled: Some(write),
            depth_compare: Some(if self.reverse_z {
                wgpu::CompareFunction::GreaterEqual
            } else {
                wgpu::CompareFunction::LessEqual
            }),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_field_value_and_bound() {
        let bad = ViewDesc { samples: 3, ..ViewDesc::default() };
        let text = bad.check().unwrap_err().to_string();
        assert_eq!(text, "samples is 3, allowed: 1, 2, 4, 8 or 16");
        let bad = ViewDesc { grid: [256, 4], ..ViewDesc::default() };
        let text = bad.check().unwrap_err().to_string();
        assert_eq!(text, "grid[1] is 4, allowed: 8 to 4096");
        let bad = ViewDesc { color_format: TextureFormat::R8Uint, ..ViewDesc::default() };
        let text = bad.check().unwrap_err().to_string();
        assert!(text.starts_with("color_format is R8Uint"), "{text}");
        let bad = ViewDesc { depth_format: TextureFormat::Rgba8Unorm, ..ViewDesc::default() };
        let text = bad.check().unwrap_err().to_string();
        assert!(text.starts_with("depth_format is Rgba8Unorm"), "{text}");
        assert!(ViewDesc::default().check().is_ok());
    }
}
