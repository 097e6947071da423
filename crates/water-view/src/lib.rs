//! Projected-grid renderer for Open Water on plain wgpu.
