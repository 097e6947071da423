// A plane with a texture of the game's own, moved by the water. The game's own things are bind group 0, the water is 1.
struct Camera {
    clip_from_world: mat4x4<f32>,
    eye: vec3<f32>,
    spacing: f32, // of the mesh's vertices, metres
}
@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var tiles: texture_2d<f32>;
@group(0) @binding(2) var tiles_sampler: sampler;

struct Vertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) rest: vec2<f32>,
}

@vertex
fn plane_vertex(@location(0) rest: vec2<f32>) -> Vertex {
    // Waves that the mesh cannot carry are left to the shading.
    let world = surface_vertex(rest, 1.5 * camera.spacing);
    return Vertex(camera.clip_from_world * vec4<f32>(world, 1.0), world, rest);
}

@fragment
fn plane_fragment(in: Vertex) -> @location(0) vec4<f32> {
    let color = textureSample(tiles, tiles_sampler, in.rest / 8.0).rgb;
    let footprint = max(length(dpdx(in.rest)), length(dpdy(in.rest)));
    if surface_is_dry(in.world) {
        discard; // the inside of a boat
    }
    let look = surface_shading(in.rest, footprint);
    let sun = normalize(vec3<f32>(-0.5, 0.6, -0.6));
    let halfway = normalize(sun + normalize(camera.eye - in.world));
    let lit = mix(color, vec3<f32>(0.9), look.foam) * (0.3 + 0.9 * max(dot(look.normal, sun), 0.0));
    return vec4<f32>(lit + 0.5 * pow(max(dot(look.normal, halfway), 0.0), 60.0), 1.0);
}
