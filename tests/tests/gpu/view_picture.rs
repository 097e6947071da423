//! Pictures of the renderer, judged by what must be true of any picture of a sea; no stored images.

use glam::{Affine3A, Vec3};
use water_view::{Instance, MeshData, MeshView, ViewDesc, ViewParams, WaterView};

use crate::context::Context;
use crate::view_stage::{Draw, Picture, Sea, Stage, camera, frame, frame_with, render, shifted};

const SIZE: [u32; 2] = [320, 180];

fn desc() -> ViewDesc {
    ViewDesc { grid: [128, 192], ..ViewDesc::default() }
}

fn params(eye: Vec3, yaw: f32, pitch: f32, sea: &Sea) -> ViewParams {
    let mut params = ViewParams::new(camera(eye, yaw, pitch).view(true));
    params.wave_height = sea.wave_height;
    params
}

/// Row of the horizon, from the camera alone.
fn horizon(pitch: f32) -> f32 {
    let half = (0.5 * water_view::Camera::default().fov_y).tan();
    0.5 * SIZE[1] as f32 * (1.0 + pitch.tan() / half)
}

fn drawn(picture: &Picture, x: u32, y: u32) -> bool {
    picture.at(x, y)[3] == 255
}

/// Mean absolute difference of two pictures, in levels, `b` read `dx` pixels further right.
fn difference(a: &Picture, b: &Picture, dx: u32) -> f32 {
    let mut sum = 0u64;
    let mut count = 0u64;
    for y in 0..a.size[1] {
        for x in 0..a.size[0] - dx {
            for (p, q) in a.at(x, y).iter().zip(b.at(x + dx, y)).take(3) {
                sum += u64::from(p.abs_diff(q));
                count += 1;
            }
        }
    }
    sum as f32 / count as f32
}

#[test]
fn the_horizon_is_where_the_camera_says() {
    let context = Context::new();
    let sea = Sea::flat();
    let stage = Stage::new(&context, &sea);
    for (height, pitch) in [(2.0, 0.0f32), (8.0, -0.2), (8.0, 0.15), (150.0, -0.3)] {
        let view = params(Vec3::new(5.0, height, -3.0), 0.7, pitch, &sea);
        let picture = render(&context, &stage, &desc(), &view, SIZE, Draw::WaterOnly);
        for x in [0, 97, 160, 319] {
            let top = (0..SIZE[1]).find(|&y| drawn(&picture, x, y)).unwrap_or(SIZE[1]) as f32;
            let expected = horizon(pitch);
            assert!((top - expected).abs() <= 1.0, "height {height}, pitch {pitch}, column {x}: {top} for {expected}");
        }
    }
}

#[test]
fn the_sea_has_no_cracks() {
    let context = Context::new();
    let sea = Sea::waves(0.12);
    let stage = Stage::new(&context, &sea);
    assert!((0.3..4.0).contains(&sea.wave_height), "{}", sea.wave_height);
    let mut view = WaterView::new(&context.device, &desc(), &stage.layout).unwrap();
    for (height, yaw, pitch) in
        [(2.5, 0.0f32, -0.05f32), (6.0, 2.0, -0.3), (6.0, 4.4, -0.9), (30.0, 5.5, -1.5), (200.0, 1.0, -0.4)]
    {
        let look = params(Vec3::new(40.0, height, 12.0), yaw, pitch, &sea);
        let picture = frame(&context, &stage, &mut view, &look, SIZE, Draw::WaterOnly);
        // Crests of waves stand at most as far above the horizon as the eye is below them.
        let band = horizon(pitch).max(0.0) as u32 + 1;
        for x in 0..SIZE[0] {
            let mut seen = false;
            for y in 0..SIZE[1] {
                let here = drawn(&picture, x, y);
                assert!(here || !seen, "crack at ({x}, {y}), height {height}, yaw {yaw}, pitch {pitch}");
                assert!(here || y < band, "sky below the horizon at ({x}, {y}), height {height}, pitch {pitch}");
                seen |= here;
            }
        }
    }
}

#[test]
fn a_still_picture_is_still_and_a_moved_one_only_moves() {
    let context = Context::new();
    let sea = Sea::waves(0.12);
    let stage = Stage::new(&context, &sea);
    let mut view = WaterView::new(&context.device, &desc(), &stage.layout).unwrap();
    for (height, pitch) in [(3.0, -0.1), (10.0, -0.35), (80.0, -0.5)] {
        let look = params(Vec3::new(0.0, height, 0.0), 2.6, pitch, &sea);
        let mut take = |look: &ViewParams| frame(&context, &stage, &mut view, look, SIZE, Draw::All);
        let first = take(&look);
        assert!(take(&look).color == first.color, "two frames of one moment differ");
        // Half a pixel: up to .66 levels with the filters, 5 without.
        let half = difference(&first, &take(&shifted(look, [0.5, 0.0], SIZE)), 0);
        assert!(half < 0.9, "half a pixel changes the picture by {half} levels at {height} m");
        // Whole pixels: the same picture, elsewhere. What is left is dither, and vertices that stand elsewhere: .51 levels,
        // .79 when the mesh carries waves it cannot.
        let whole = difference(&first, &take(&shifted(look, [6.0, 0.0], SIZE)), 6);
        assert!(whole < 0.6, "a pan of six pixels changes the picture by {whole} levels at {height} m");
    }
}

#[test]
fn both_directions_of_depth_and_all_sample_counts_agree() {
    let context = Context::new();
    let sea = Sea::waves(0.12);
    let stage = Stage::new(&context, &sea);
    let look = params(Vec3::new(0.0, 4.0, 0.0), 1.2, -0.15, &sea);
    let reverse = render(&context, &stage, &desc(), &look, SIZE, Draw::All);
    let forward = ViewDesc { reverse_z: false, ..desc() };
    let mut other = look;
    other.view = camera(Vec3::new(0.0, 4.0, 0.0), 1.2, -0.15).view(false);
    let forward = render(&context, &stage, &forward, &other, SIZE, Draw::All);
    assert!(difference(&reverse, &forward, 0) < 0.1);
    let near = reverse.depth.iter().filter(|d| **d > 0.001).count();
    assert!(near > 1000, "the sea writes depth: {near}");
    for (a, b) in reverse.depth.iter().zip(&forward.depth) {
        assert!((a + b - 1.0).abs() < 1e-4, "depths {a} and {b}");
    }
    let many = ViewDesc { samples: 4, ..desc() };
    let many = render(&context, &stage, &many, &look, SIZE, Draw::All);
    let apart = difference(&reverse, &many, 0);
    assert!(apart < 0.5, "four samples differ from one by {apart} levels");
    assert!(many.color.iter().all(|c| c[3] == 255), "sea and sky cover everything");
}

#[test]
fn water_is_blue_green_below_bright_at_grazing_angles_and_white_under_foam() {
    let context = Context::new();
    let mut sea = Sea::flat();
    let mean = |p: &Picture, rows: std::ops::Range<u32>| {
        let mut sum = [0.0f32; 3];
        for (x, y) in rows.clone().flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
            (0..3).for_each(|c| sum[c] += f32::from(p.at(x, y)[c]));
        }
        sum.map(|s| s / (rows.len() as u32 * SIZE[0]) as f32)
    };
    // Away from the sun.
    let look = params(Vec3::new(0.0, 10.0, 0.0), 1.9, -0.45, &sea);
    let stage = Stage::new(&context, &sea);
    let picture = render(&context, &stage, &desc(), &look, SIZE, Draw::All);
    let near = mean(&picture, 170..180);
    let far = mean(&picture, horizon(-0.45) as u32 + 3..horizon(-0.45) as u32 + 8);
    assert!(near[2] > 1.3 * near[0] && near[1] > 1.2 * near[0], "not blue-green: {near:?}");
    assert!(far[1] > 1.5 * near[1], "no Fresnel: {near:?} near, {far:?} far");
    let sky = mean(&picture, 0..3);
    assert!(sky[2] > 90.0 && sky[2] >= sky[0], "sky {sky:?}");
    for texel in &mut sea.cascades[0].displacement {
        texel[3] = 1.0;
    }
    let stage = Stage::new(&context, &sea);
    let picture = render(&context, &stage, &desc(), &look, SIZE, Draw::All);
    let foam = mean(&picture, 150..180);
    assert!(foam.iter().all(|c| *c > 150.0), "foam {foam:?}");
}

#[test]
fn meshes_stand_in_the_water() {
    let context = Context::new();
    let sea = Sea::flat();
    let stage = Stage::new(&context, &sea);
    let mut view = WaterView::new(&context.device, &desc(), &stage.layout).unwrap();
    let mut meshes = MeshView::new(&context.device, &view);
    let mut data = MeshData::default();
    data.cuboid(Vec3::ZERO, Vec3::splat(1.0), [255, 0, 0, 0]);
    let id = meshes.add(&context.device, &data, 1);
    let at = Affine3A::from_translation(Vec3::new(12.0, 0.0, 0.0));
    let broken = Affine3A::from_translation(Vec3::NAN);
    let place = [broken, at].map(|world_from_mesh| Instance { world_from_mesh, tint: Vec3::ONE });
    meshes.place(&context.queue, id, &place);
    let look = params(Vec3::new(0.0, 2.0, 0.0), 0.0, -0.1, &sea);
    let picture = frame_with(&context, &mut view, &look, SIZE, |pass, view| {
        meshes.draw(pass, view);
        view.draw(pass, &stage.group);
    });
    let row = |y: f32| {
        let below = (2.0 - y) / 11.0; // its near face is 11 m away
        let angle = below.atan() - 0.1;
        (90.0 + 90.0 * angle.tan() / (0.5 * water_view::Camera::default().fov_y).tan()) as u32
    };
    let red = |y: f32| {
        let c = picture.at(160, row(y));
        c[0] > 40 && c[0] / 2 > c[2]
    };
    assert!(red(0.8) && red(0.1), "the part above the water shows");
    assert!(!red(-0.2) && !red(-0.8), "the part below is under water");
}

#[test]
fn a_broken_camera_keeps_the_last_frame() {
    let context = Context::new();
    let sea = Sea::waves(0.12);
    let stage = Stage::new(&context, &sea);
    let mut view = WaterView::new(&context.device, &desc(), &stage.layout).unwrap();
    let look = params(Vec3::new(0.0, 4.0, 0.0), 0.4, -0.2, &sea);
    let mut broken = look;
    broken.view.view_from_world.w_axis.x = f32::NAN;
    let nothing = frame(&context, &stage, &mut view, &broken, SIZE, Draw::All);
    assert!(nothing.color.iter().all(|c| c[3] == 0), "nothing is drawn before the first camera");
    let first = frame(&context, &stage, &mut view, &look, SIZE, Draw::All);
    let kept = frame(&context, &stage, &mut view, &broken, SIZE, Draw::All);
    assert!(first.color == kept.color);
    let mut odd = look;
    (odd.wave_height, odd.sky.visibility, odd.sky.sun_direction) = (f32::NAN, -1.0, Vec3::ZERO);
    let odd = frame(&context, &stage, &mut view, &odd, SIZE, Draw::All);
    assert!(odd.color.iter().all(|c| c[3] == 255));
}
