// Waves high against the depth and water that rises fast at a wall break too; see foam.rs of wave-grid.
fn foam_excess(
    steep: vec4<f32>, z: vec4<f32>, next: vec4<f32>, a: Row, a_across: vec4<f32>, limit: f32, splash: f32,
) -> vec4<f32> {
    let high = 2.0 * z / (limit * select(vec4<f32>(1.0), a.here, a.here > vec4<f32>(0.0))) - 2.0;
    let least = min(min(a.west, a.east), a_across);
    let rise = select(abs(next - z) * splash - 1.0, vec4<f32>(0.0), least > vec4<f32>(0.0));
    return clamp(max(max(high, rise), steep), vec4<f32>(0.0), vec4<f32>(1.0));
}

// Sum of the jumps to the four neighbours that are no wall.
fn open_bend(s: Row, c: Row, n: Row, faces: Fluxes, aspect: f32) -> vec4<f32> {
    let none = vec4<f32>(0.0);
    return (select(none, c.west - c.here, faces.west > none) + select(none, c.east - c.here, faces.east > none))
        + aspect * (select(none, s.here - c.here, faces.south > none) + select(none, n.here - c.here, faces.north > none));
}
