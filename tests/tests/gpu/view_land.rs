//! The sea over land: what it lets through, where it ends, its foam, its level.

use glam::{Vec2, Vec3};
use open_water_shaders::surface::SurfaceLand;
use water_view::{ViewDesc, ViewParams, WaterLook};

use crate::context::Context;
use crate::view_stage::{Draw, Picture, Sea, Stage, camera, render};

const SIZE: [u32; 2] = [320, 180];
/// Height of the camera that looks down, metres.
const ABOVE: f32 = 20.0;

/// Rasters of a land: (bed, open water, nearness of walls, 0), texel (0, 0) at `corner`, `size` texels a side.
pub(crate) struct Ground {
    corner: Vec2,
    texel: f32,
    size: u32,
    texels: Vec<[f32; 4]>,
}

impl Ground {
    /// 65 x 65 texels of a metre around the origin.
    fn of(at: impl Fn(Vec2) -> [f32; 3]) -> Self {
        let (size, corner) = (65, Vec2::splat(-32.0));
        let texel = |k: u32| {
            let [bed, open, near] = at(corner + Vec2::new((k % size) as f32, (k / size) as f32));
            [bed, open, near, 0.0]
        };
        Self { corner, texel: 1.0, size, texels: (0..size * size).map(texel).collect() }
    }

    pub(crate) fn entry(&self) -> SurfaceLand {
        SurfaceLand {
            corner: self.corner.into(),
            texel: self.texel,
            present: 1,
            size: [self.size; 2],
            ..SurfaceLand::default()
        }
    }

    /// Three layers; the sea is as high everywhere.
    pub(crate) fn texture(&self, context: &Context) -> wgpu::TextureView {
        let size = wgpu::Extent3d { width: self.size, height: self.size, depth_or_array_layers: 3 };
        let texture = context.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("ground"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let even = vec![[1.0f32; 4]; self.texels.len()];
        let all: Vec<[f32; 4]> = [&even, &even, &self.texels].into_iter().flatten().copied().collect();
        context.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(&all),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(16 * self.size),
                rows_per_image: Some(self.size),
            },
            size,
        );
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        })
    }
}

/// The sea alone from above its level, with its alpha: how much it covers.
fn look_down(context: &Context, sea: &Sea, water: WaterLook) -> (Picture, ViewParams) {
    let eye = Vec3::new(0.0, sea.level + ABOVE, 0.0);
    let mut params = ViewParams::new(camera(eye, 0.0, -1.57).view(true));
    (params.wave_height, params.level, params.water) = (sea.wave_height, sea.level, water);
    let desc = ViewDesc { grid: [128, 192], ..ViewDesc::default() };
    (render(context, &Stage::new(context, sea), &desc, &params, SIZE, Draw::WaterOnly), params)
}

/// The pixel of a point of the level (x, z).
fn pixel(params: &ViewParams, x: f32, z: f32) -> [u32; 2] {
    let clip = params.view.clip_from_view * params.view.view_from_world;
    let p = clip.project_point3(Vec3::new(x, params.level, z));
    [((0.5 + 0.5 * p.x) * SIZE[0] as f32) as u32, ((0.5 - 0.5 * p.y) * SIZE[1] as f32) as u32]
}

/// Mean of green, of which the ground has none, over the points of `rows` (x) with |z| < 6.
fn white(picture: &Picture, params: &ViewParams, rows: std::ops::Range<i32>) -> f32 {
    let points = rows.flat_map(|x| (-60..60).map(move |z| (0.1 * x as f32, 0.1 * z as f32)));
    let (sum, count) = points.fold((0.0, 0), |(sum, count), (x, z)| {
        let [i, j] = pixel(params, x, z);
        (sum + f32::from(picture.at(i, j)[1]), count + 1)
    });
    sum / count as f32
}

#[test]
fn a_view_may_leave_the_land_out() {
    let context = Context::new();
    let mut params = ViewParams::new(camera(Vec3::new(0.0, ABOVE, 0.0), 0.0, -1.57).view(true));
    params.water.absorption = Vec3::new(0.5, 0.1, 0.3);
    let draw = |ground: Option<Ground>, land: bool| {
        let sea = Sea { land: ground, ..Sea::flat() };
        let desc = ViewDesc { grid: [128, 192], land, ..ViewDesc::default() };
        render(&context, &Stage::new(&context, &sea), &desc, &params, SIZE, Draw::WaterOnly)
    };
    let shallow = || Some(Ground::of(|_| [-0.3, 1.0, 0.0]));
    let middle = [SIZE[0] / 2, SIZE[1] / 2];
    let [with, without] = [true, false].map(|land| draw(None, land).at(middle[0], middle[1]));
    assert_eq!(with, without, "the open sea is the same");
    let [with, without] = [true, false].map(|land| draw(shallow(), land).at(middle[0], middle[1])[3]);
    assert!(with < 200 && without == 255, "{with} {without}");
}

#[test]
fn water_covers_its_bed_by_its_depth() {
    let context = Context::new();
    let water = WaterLook { absorption: Vec3::new(0.5, 0.1, 0.3), ..WaterLook::default() };
    // Straight down; the sun comes in slant, refracted by n = 4/3.
    let sun = water_view::Sky::default().sun_direction.normalize();
    let path = 1.0 + 1.0 / (1.0 - (1.0 - sun.y * sun.y) * 0.5625).sqrt();
    let mut last = 0.0;
    for depth in [0.3f32, 0.6, 1.0, 2.0, 3.0, 12.0] {
        let sea = Sea { land: Some(Ground::of(|_| [-depth, 1.0, 0.0])), ..Sea::flat() };
        let (picture, params) = look_down(&context, &sea, water);
        let [i, j] = pixel(&params, 0.0, 0.0);
        let got = f32::from(picture.at(i, j)[3]) / 255.0;
        // What the weakest colour lets through, less what the surface reflects.
        let through = ((-0.5 * depth * path).exp() - 0.01).max(0.0) / 0.99;
        let expected = 1.0 - 0.98 * through;
        assert!((got - expected).abs() < 0.02, "{got} of the bed covered at {depth} m, {expected} expected");
        assert!(got > last);
        last = got;
    }
    assert_eq!(last, 1.0, "deep water is opaque");
}

#[test]
fn no_water_shows_on_land_nor_where_there_is_none() {
    let context = Context::new();
    let bed = |p: Vec2| if p.x < 0.0 { 0.1 } else { -8.0 };
    let open = |p: Vec2| if p.y < 0.0 { 0.0 } else { 1.0 };
    let sea = Sea { land: Some(Ground::of(|p| [bed(p), open(p), 0.0])), ..Sea::flat() };
    let (picture, params) = look_down(&context, &sea, WaterLook::default());
    for (x, z, expected) in [(-3.0, 3.0, 0), (-3.0, -3.0, 0), (3.0, -3.0, 0), (3.0, 3.0, 255)] {
        let [i, j] = pixel(&params, x, z);
        assert_eq!(picture.at(i, j)[3], expected, "at {x}, {z}");
        let stands = picture.depth[(j * SIZE[0] + i) as usize] > 0.0;
        assert_eq!(stands, expected > 0, "something stands in the depth target at {x}, {z}");
    }
}

#[test]
fn the_level_lifts_the_whole_sea() {
    let context = Context::new();
    let desc = ViewDesc { grid: [128, 192], ..ViewDesc::default() };
    let take = |level: f32| {
        let sea = Sea { level, ..Sea::waves(0.1) };
        let mut params = ViewParams::new(camera(Vec3::new(0.0, level + 4.0, 0.0), 1.0, -0.2).view(true));
        (params.wave_height, params.level) = (sea.wave_height, level);
        render(&context, &Stage::new(&context, &sea), &desc, &params, SIZE, Draw::All)
    };
    let (low, high) = (take(0.0), take(300.0));
    let apart: u64 =
        low.color.iter().flatten().zip(high.color.iter().flatten()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    let mean = apart as f32 / (4 * SIZE[0] * SIZE[1]) as f32;
    assert!(mean < 0.3, "water at 300 m, seen from as much higher: {mean} levels apart");
}

#[test]
fn a_beach_has_a_band_of_foam_where_the_water_ends() {
    let context = Context::new();
    // A beach of 1:10 towards -x; still water ends at x = 0, or three metres up with 0.3 m more of it.
    for (level, edge) in [(0.0, 0.0f32), (0.3, -3.0)] {
        let land = || Some(Ground::of(|p| [-0.1 * p.x, 1.0, 0.0]));
        let sea = Sea { land: land(), level, ..Sea::flat() };
        let (picture, params) = look_down(&context, &sea, WaterLook::default());
        let at = |x: f32| ((edge + x) * 10.0) as i32;
        let none = look_down(&context, &sea, WaterLook { surf: 0.0, ..WaterLook::default() }).0;
        let more = |x: std::ops::Range<i32>| white(&picture, &params, x.clone()) - white(&none, &params, x);
        let (swash, off) = (more(at(0.6)..at(1.2)), more(at(4.0)..at(6.0)));
        assert!(swash > 15.0, "foam makes the swash {swash} levels whiter at level {level}");
        assert!(off.abs() < 0.5, "foam makes the water off the beach {off} levels whiter at level {level}");
    }
}

#[test]
fn walls_foam_in_waves_and_not_in_still_water() {
    let context = Context::new();
    let deep = |near: f32| Some(Ground::of(|p| [-30.0, 1.0, if p.x < 0.0 { near } else { 0.0 }]));
    let take = |sea: Sea| {
        let (picture, params) = look_down(&context, &sea, WaterLook::default());
        [white(&picture, &params, -80..-10), white(&picture, &params, 10..80)]
    };
    let wall = take(Sea { land: deep(1.0), ..Sea::waves(0.12) });
    let open = take(Sea { land: deep(0.0), ..Sea::waves(0.12) });
    assert!(wall[0] > open[0] + 5.0, "at the wall {}, without it {}", wall[0], open[0]);
    assert!((wall[1] - open[1]).abs() < 0.5, "away from the wall {}, without it {}", wall[1], open[1]);
    let wall = take(Sea { land: deep(1.0), ..Sea::flat() });
    let open = take(Sea { land: deep(0.0), ..Sea::flat() });
    assert!((wall[0] - open[0]).abs() < 0.5, "still water at the wall {}, without it {}", wall[0], open[0]);
}
