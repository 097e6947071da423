// Squares of one colour, each an instance: corner and size in pixels, colour and opacity.
@group(0) @binding(0) var<uniform> screen: vec4<f32>;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec4<f32>,
}

@vertex
fn overlay_vertex(@builtin(vertex_index) index: u32, @location(0) at: vec4<f32>, @location(1) paint: vec4<f32>) -> Corner {
    let corner = at.xy + at.zw * vec2<f32>(f32(index & 1u), f32(index >> 1u));
    let clip = vec2<f32>(2.0, -2.0) * corner / screen.xy + vec2<f32>(-1.0, 1.0);
    return Corner(vec4<f32>(clip, 0.0, 1.0), paint);
}

@fragment
fn overlay_fragment(in: Corner) -> @location(0) vec4<f32> {
    return in.color;
}
