//! Windows that follow what the game sets: a point, a view.

use glam::{DVec2, Vec3};
use open_water::{
    BodyStates, Border, Follow, GridDesc, GridId, Look, OpenWater, OpenWaterDesc, OpenWaterError, Preset,
};

const DT: f32 = 1.0 / 60.0;

fn calm() -> OpenWater {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    OpenWater::headless(desc).unwrap()
}

fn small(follow: Follow) -> GridDesc {
    let border = Border::Absorbing { width: 8 };
    GridDesc { follow, cells: [128; 2], cell_size: [0.125; 2], border, ..Preset::Low.grid() }
}

fn tick(water: &mut OpenWater) {
    for tick in water.advance(DT) {
        water.tick(tick, &mut BodyStates::default()).unwrap();
    }
}

/// The middle of the grid's window, metres.
fn middle(water: &OpenWater, id: GridId) -> DVec2 {
    let window = water.grid(id).unwrap().unwrap().window();
    window.world_corner() + 0.5 * 128.0 * 0.125
}

#[test]
fn a_window_follows_a_point_and_ignores_what_is_none() {
    let mut water = calm();
    let grid = water.add_grid(small(Follow::Point)).unwrap();
    tick(&mut water);
    assert!(middle(&water, grid).length() < 0.13);
    water.set_follow_point(grid, DVec2::new(70.0, -30.0)).unwrap();
    tick(&mut water);
    assert!(middle(&water, grid).distance(DVec2::new(70.0, -30.0)) < 0.3);
    for bad in [DVec2::new(f64::NAN, 0.0), DVec2::new(0.0, f64::INFINITY), DVec2::splat(1e300)] {
        water.set_follow_point(grid, bad).unwrap();
        tick(&mut water);
        assert!(middle(&water, grid).distance(DVec2::new(70.0, -30.0)) < 0.3, "{bad}");
    }
}

#[test]
fn only_a_grid_with_a_point_takes_one() {
    let mut water = calm();
    let fixed = water.add_grid(small(Follow::Fixed(DVec2::ZERO))).unwrap();
    let error = water.set_follow_point(fixed, DVec2::ONE).unwrap_err();
    assert!(matches!(error, OpenWaterError::NotAPoint(_)) && error.to_string().contains("Follow::Point"), "{error}");
    water.remove_grid(fixed).unwrap();
    assert!(matches!(water.set_follow_point(fixed, DVec2::ONE), Err(OpenWaterError::UnknownGrid(_))));
}

#[test]
fn a_window_stays_in_what_a_camera_sees() {
    let mut water = calm();
    let grid = water.add_grid(small(Follow::View)).unwrap();
    tick(&mut water);
    assert!(middle(&water, grid).length() < 0.13, "until the game looks it stays");
    let look = Look { eye: Vec3::new(0.0, 3.0, 0.0), direction: Vec3::new(1.0, -0.2, 0.0), fov_y: 0.9, aspect: 1.6 };
    water.look(look);
    tick(&mut water);
    let at = middle(&water, grid);
    // The nearest water in view is 3/tan(.45 + .197) = 3.97 m ahead, the window without its border 13 m long.
    assert!((at.x - (3.97 + 6.5)).abs() < 0.5 && at.y.abs() < 0.3, "{at}");
    // The water rises to within a metre of the eye: what is nearest in view comes nearer.
    water.set_level(2.0).unwrap();
    tick(&mut water);
    assert!((middle(&water, grid).x - (3.97 / 3.0 + 6.5)).abs() < 0.5, "{}", middle(&water, grid));
    let stood = middle(&water, grid);
    let bad = [
        Look { eye: Vec3::NAN, ..look },
        Look { direction: Vec3::ZERO, ..look },
        Look { direction: Vec3::splat(f32::INFINITY), ..look },
        Look { fov_y: 4.0, ..look },
        Look { aspect: f32::NAN, ..look },
        // The sky: no water to follow.
        Look { direction: Vec3::Y, ..look },
    ];
    for bad in bad {
        water.look(bad);
        tick(&mut water);
        assert_eq!(middle(&water, grid), stood, "{bad:?}");
    }
}
