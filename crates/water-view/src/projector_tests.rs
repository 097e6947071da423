use super::*;
use crate::camera::Camera;

const COLUMNS: u32 = 128;
const ROWS: u32 = 192;

fn covers(p: &Projector, at: Vec2) -> bool {
    let d = at - p.pole;
    let row = d.length().ln() / p.row_step - p.first_row as f32;
    let radial = (p.closed || row >= 0.0) && row <= ROWS as f32;
    let column = d.y.atan2(d.x).rem_euclid(TAU) / (TAU / p.turn as f32);
    let offset = (column - p.first_column as f32).rem_euclid(p.turn as f32);
    radial && (p.closed || offset <= COLUMNS as f32)
}

/// Walks rays through the picture to the slab and asks whether the grid covers where they may meet displaced water.
#[test]
fn all_that_is_seen_lies_on_the_grid() {
    for height in [0.5f32, 2.0, 6.0, 40.0, 300.0] {
        for pitch in [-90f32, -60.0, -35.0, -12.0, -3.0, 0.0, 8.0] {
            for yaw in [0f32, 77.0, 200.0, 315.0] {
                let (p, y) = (pitch.to_radians(), yaw.to_radians());
                let dir = Vec3::new(p.cos() * y.cos(), p.sin(), p.cos() * y.sin());
                let eye = Vec3::new(100.0, height, -40.0);
                let camera = Camera { aspect: 1.78, ..Camera::default() }.look_at(eye, eye + dir);
                let rays = Rays::of(&camera.view(true)).unwrap();
                let reach = 2.2;
                let grid = Projector::place(&rays, reach, COLUMNS, ROWS).unwrap();
                for (u, v) in (0..81).map(|i| ((i % 9) as f32 / 4.0 - 1.0, (i / 9) as f32 / 4.0 - 1.0)) {
                    let ray = rays.center + u * rays.right + v * rays.up;
                    for level in [-2.1f32, -1.0, 0.0, 1.0, 2.1] {
                        let t = (level - eye.y) / ray.y;
                        let hit = eye + t * ray;
                        let away = Vec2::new(hit.x - eye.x, hit.z - eye.z).length();
                        if t <= 0.0 || away > 0.9 * grid.far {
                            continue;
                        }
                        for side in [Vec2::ZERO, Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y] {
                            let rest = Vec2::new(hit.x, hit.z) + 2.1 * side;
                            assert!(covers(&grid, rest), "h {height} pitch {pitch} yaw {yaw} at {rest} {grid:?}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn turning_the_camera_leaves_the_ladders_alone() {
    let place = |yaw: f32| {
        let eye = Vec3::new(0.0, 6.0, 0.0);
        let dir = Vec3::new(yaw.cos(), -0.2, yaw.sin());
        let camera = Camera { aspect: 1.78, ..Camera::default() }.look_at(eye, eye + dir);
        Projector::place(&Rays::of(&camera.view(true)).unwrap(), 2.0, COLUMNS, ROWS).unwrap()
    };
    let (a, b) = (place(0.3), place(0.304));
    assert_eq!((a.row_step, a.turn), (b.row_step, b.turn));
}

#[test]
fn a_look_at_the_sky_draws_no_water() {
    let eye = Vec3::new(0.0, 10.0, 0.0);
    let camera = Camera::default().look_at(eye, eye + Vec3::new(0.1, 1.0, 0.0));
    let rays = Rays::of(&camera.view(true)).unwrap();
    assert!(Projector::place(&rays, 2.0, COLUMNS, ROWS).is_none());
}
