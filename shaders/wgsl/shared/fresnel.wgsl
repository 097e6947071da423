// Reflectance of a water surface (Schlick 1994, n = 1.33) at cosine c.
fn fresnel(c: f32) -> f32 {
    let x = 1.0 - clamp(c, 0.0, 1.0);
    let x2 = x * x;
    return 0.02 + 0.98 * x2 * x2 * x;
}
