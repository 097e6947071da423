// The texel of the next mip level over four.
fn mean4(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>, d: vec4<f32>) -> vec4<f32> {
    return 0.25 * ((a + b) + (c + d));
}
