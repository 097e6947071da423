//! Real-time open water for games: FFT ocean, interactive waves and floating bodies on wgpu.
