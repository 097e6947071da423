// Relative air mass towards elevation sin(e) = y (Rozenberg 1966): 1 at the zenith, 40 at the horizon.
fn air_mass(y: f32) -> f32 {
    return 1.0 / (y + 0.025 * exp(-11.0 * y));
}

// Radiance of the clear sky, without the sun's disc: light scattered once by clear air (Rayleigh) and aerosol
// (Cornette-Shanks, g = 0.76), the path's own extinction included. Below the horizon it is the horizon's.
fn sky_radiance(direction: vec3<f32>) -> vec3<f32> {
    let d = normalize(vec3<f32>(direction.x, max(direction.y, 0.0), direction.z));
    let c = dot(d, view.sun);
    let c2 = 1.0 + c * c;
    let clear = 0.0596831 * c2;
    let g = 0.76;
    let g2 = g * g;
    let s = max(1.0 + g2 - 2.0 * g * c, 1e-4);
    let aerosol = 0.1193662 * (1.0 - g2) * c2 / ((2.0 + g2) * s * sqrt(s));
    let total = view.rayleigh + view.mie;
    let phase = (view.rayleigh * clear + view.mie * aerosol) / total;
    return view.airlight * phase * (1.0 - exp(-total * air_mass(d.y)));
}

// The sun's disc, its edge one pixel soft.
fn sun_disc(direction: vec3<f32>, pixel_angle: f32) -> vec3<f32> {
    let radius = 0.00465;
    let angle = length(direction - view.sun);
    let cover = 1.0 - smoothstep(radius - 0.5 * pixel_angle, radius + 0.5 * pixel_angle, angle);
    return view.sunlight * (cover / (3.14159265 * radius * radius));
}
