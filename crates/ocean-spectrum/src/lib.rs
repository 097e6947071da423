//! FFT ocean: sea state to spectrum to modes to surface, on the CPU and on wgpu.
