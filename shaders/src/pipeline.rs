//! Bind group layouts, pipelines and readback on wgpu.
