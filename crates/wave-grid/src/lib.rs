//! Interactive water waves on a shifting window with absorbing borders, on the CPU and on wgpu.
