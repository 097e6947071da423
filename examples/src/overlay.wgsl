// Dots of text as squares, each an instance: corner and side in pixels, and a brightness.
struct Screen {
    size: vec2<f32>,
    dot: f32,
    pad: f32,
}

@group(0) @binding(0) var<uniform> screen: Screen;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) light: f32,
}

@vertex
fn overlay_vertex(@builtin(vertex_index) index: u32, @location(0) at: vec2<f32>, @location(1) light: f32) -> Corner {
    let corner = at + screen.dot * vec2<f32>(f32(index & 1u), f32(index >> 1u));
    let clip = vec2<f32>(2.0, -2.0) * corner / screen.size + vec2<f32>(-1.0, 1.0);
    return Corner(vec4<f32>(clip, 0.0, 1.0), light);
}

@fragment
fn overlay_fragment(in: Corner) -> @location(0) vec4<f32> {
    return vec4<f32>(vec3<f32>(in.light), 1.0);
}
