use floating_body::{Arena, BodyDesc, BodyState, Hull as Shape};
use glam::Quat;
use wave_grid::{GridDesc, GridSample, Hole, WaveGrid};

use super::super::mirror::Mirror;
use super::*;

const DT: f32 = 1.0 / 60.0;

/// A boat that goes round in a grid, and takes all of its water along.
struct Boat {
    mirror: Mirror,
    seen: Hole,
    holes: Vec<Hole>,
    id: BodyId,
    /// Metres and radians a second.
    speed: f64,
    spin: f64,
    /// Radians a second by which the water swings around it.
    swing: f64,
}

impl Boat {
    fn new(speed: f64, spin: f64) -> Self {
        let desc = GridDesc { cells: [96, 64], cell_size: [0.25; 2], ..GridDesc::default() };
        let seen = WaveGrid::new(desc).unwrap().hole(1.0);
        let id = Arena::<BodyId, ()>::default().insert(());
        Self {
            mirror: Mirror::new(desc.cells, desc.cell_size, DT),
            seen,
            holes: Vec::new(),
            id,
            speed,
            spin,
            swing: 0.0,
        }
    }

    fn pose(&self, tick: u64) -> Pose {
        let time = tick as f64 * f64::from(DT);
        let heading = DVec2::from_angle(self.spin * time);
        // As it is after the integral of its heading.
        Pose { place: (heading - DVec2::X).perp() * (-self.speed / self.spin) - DVec2::new(2.0, 1.0), heading }
    }

    fn hull(&self, tick: u64) -> Hull {
        Hull { id: self.id, half: Vec2::new(2.0, 0.8), pose: self.pose(tick) }
    }

    fn height(&self, tick: u64, place: DVec2) -> f32 {
        let pose = self.pose(tick);
        let seen = (place - pose.place).rotate(conjugate(pose.heading));
        let swing = libm::cos(self.swing * tick as f64 * f64::from(DT));
        (0.3 * swing * (1.0 + 0.4 * seen.x) * (-(seen / DVec2::new(1.6, 0.8)).length_squared()).exp()) as f32
    }

    fn copy(&mut self, tick: u64) {
        let corner = [-48, -32];
        let heights = [tick, tick - 1].map(|tick| -> Vec<f32> {
            let place =
                |at: i64| DVec2::new((corner[0] + at % 96) as f64 + 0.5, (corner[1] + at / 96) as f64 + 0.5) * 0.25;
            (0..96 * 64).map(|at| self.height(tick, place(at))).collect()
        });
        self.mirror.take(tick, corner, |out| {
            out.into_iter().zip(heights).for_each(|(out, heights)| *out = heights);
            true
        });
    }

    /// Copies that are `lag` ticks late, up to tick number 40; `hull` tells what is told of each tick.
    fn run(&mut self, lag: u64, hull: impl Fn(&Self, u64) -> Option<Hull>) {
        self.run_in(1..=40, lag, hull);
    }

    fn run_in(&mut self, ticks: impl Iterator<Item = u64>, lag: u64, hull: impl Fn(&Self, u64) -> Option<Hull>) {
        for tick in ticks {
            if tick > lag + 1 && tick % 2 == 0 {
                self.copy(tick - lag);
            }
            let hull = hull(self, tick);
            self.mirror.follow(tick, hull.as_slice());
        }
    }

    fn sample(&self, place: DVec2) -> GridSample {
        let mut out = [GridSample::default()];
        self.mirror.sample(&[(place - self.mirror.origin).as_vec2()], &self.seen, &self.holes, &mut out);
        out[0]
    }

    /// Places around the hull after tick number 40.
    fn places(&self) -> Vec<DVec2> {
        let pose = self.pose(40);
        let seen =
            (0..40).map(|i| DVec2::from_angle(f64::from(i) * 2.4) * (0.05 * f64::from(i)) * DVec2::new(1.4, 0.7));
        seen.map(|seen| pose.place + pose.heading.rotate(seen)).collect()
    }

    fn samples(&self) -> Vec<GridSample> {
        self.places().into_iter().map(|place| self.sample(place)).collect()
    }

    /// Errors of height, slope and vertical velocity after tick number 40, rms.
    fn errors(&self) -> [f32; 3] {
        let mut errors = [0.0; 3];
        for (place, found) in self.places().into_iter().zip(self.samples()) {
            let truth = self.height(40, place);
            let slope = [DVec2::X, DVec2::Y].map(|axis| (self.height(40, place + 0.01 * axis) - truth) / 0.01);
            let rate = (truth - self.height(39, place)) / DT;
            errors[0] += (found.height - truth).powi(2);
            errors[1] += (found.slope - Vec2::from(slope)).length_squared();
            errors[2] += (found.vertical_velocity - rate).powi(2);
        }
        errors.map(|error| (error / 40.0).sqrt())
    }
}

fn told(boat: &Boat, tick: u64) -> Option<Hull> {
    Some(boat.hull(tick))
}

#[test]
fn water_moves_along_with_a_hull_that_turns() {
    for (speed, spin, lag) in [(7.0, 0.1, 6), (6.0, 1.2, 6), (6.0, -1.2, 6), (5.0, 0.8, 12)] {
        let [mut boat, mut alone] = [Boat::new(speed, spin), Boat::new(speed, spin)];
        boat.run(lag, told);
        alone.run(lag, |_, _| None);
        let (with, without) = (boat.errors(), alone.errors());
        assert!(with[0] < 0.25 * without[0], "{speed} {spin} {lag}: {with:?} of {without:?}");
        // The kernel's error, carried on, and half a tick between the rate now and that of the last tick.
        assert!(with[1] < 0.005 * lag as f32 && with[2] < 0.03 * speed as f32, "{speed} {spin} {lag}: {with:?}");
    }
}

#[test]
fn a_new_origin_changes_nothing() {
    let [mut here, mut there] = [Boat::new(6.0, 1.2), Boat::new(6.0, 1.2)];
    here.run(6, told);
    there.mirror.origin = DVec2::new(-4.0, 3.0);
    there.run(6, told);
    for (here, there) in here.samples().into_iter().zip(there.samples()) {
        assert!((here.height - there.height).abs() < 1e-5, "{here:?} {there:?}");
    }
}

#[test]
fn without_a_way_that_is_known_the_parabola_stays() {
    type Told = fn(&Boat, u64) -> Option<Hull>;
    let jumped: Told = |boat, tick| {
        let mut hull = boat.hull(tick);
        hull.pose.place.x -= if tick < 38 { 5.0 } else { 0.0 };
        Some(hull)
    };
    let lost: Told = |boat, tick| {
        let mut hull = boat.hull(tick);
        hull.pose.place.y *= if tick == 37 { f64::NAN } else { 1.0 };
        Some(hull)
    };
    let upside_down: Told = |boat, tick| {
        let mut hull = boat.hull(tick);
        hull.pose.heading *= if tick < 37 { -1.0 } else { 1.0 };
        Some(hull)
    };
    let gone: Told = |boat, tick| (tick < 40).then(|| boat.hull(tick));
    let away: Told = |boat, tick| (tick != 36).then(|| boat.hull(tick));
    let slow = (1.0, told as Told);
    let cases = [slow, (6.0, jumped), (6.0, lost), (6.0, upside_down), (6.0, gone), (6.0, away)];
    for (at, (speed, told)) in cases.into_iter().enumerate() {
        let [mut boat, mut alone] = [Boat::new(speed, 0.5), Boat::new(speed, 0.5)];
        boat.run(6, told);
        alone.run(6, |_, _| None);
        assert_eq!(boat.samples(), alone.samples(), "{at}");
    }
    // Nor over a tick in which the grid slept.
    let [mut boat, mut alone] = [Boat::new(6.0, 0.5), Boat::new(6.0, 0.5)];
    let awake = || (1..=40).filter(|tick| *tick != 37);
    boat.run_in(awake(), 6, told);
    alone.run_in(awake(), 6, |_, _| None);
    assert_eq!(boat.samples(), alone.samples());
}

#[test]
fn slopes_are_those_of_the_heights_at_the_edge_of_a_hole() {
    let mut boat = Boat::new(6.0, 0.5);
    let mut finer = WaveGrid::new(GridDesc { cells: [48; 2], cell_size: [0.125; 2], ..GridDesc::default() }).unwrap();
    finer.center_on(boat.pose(40).place + 1.0);
    boat.holes.push(finer.hole(0.8));
    boat.run(6, told);
    for place in boat.places() {
        let rise =
            |axis: DVec2| (boat.sample(place + 0.01 * axis).height - boat.sample(place - 0.01 * axis).height) / 0.02;
        let (slope, rises) = (boat.sample(place).slope, Vec2::new(rise(DVec2::X), rise(DVec2::Y)));
        assert!(slope.distance(rises) < 0.01, "{slope} {rises}");
    }
}

#[test]
fn a_hull_that_goes_on_without_copies_leaves_bounded_water() {
    let mut boat = Boat::new(6.0, 0.3);
    boat.swing = 30.0;
    boat.run(6, told);
    for tick in 41..200 {
        let hull = boat.hull(tick);
        boat.mirror.follow(tick, &[hull]);
        for place in (0..60).map(|i| hull.pose.place + DVec2::from_angle(f64::from(i)) * 0.05 * f64::from(i)) {
            let sample = boat.sample(place);
            assert!(sample.height.abs() < 0.7 && sample.vertical_velocity.is_finite(), "{tick}: {sample:?}");
            assert!(tick < 80 || sample.vertical_velocity == 0.0, "{tick}: {sample:?}");
        }
    }
}

#[test]
fn of_many_hulls_the_largest_count() {
    let boat = Boat::new(6.0, 0.3);
    let mut ids = Arena::<BodyId, ()>::default();
    // Small ones side by side, told before the boat.
    let small: Vec<BodyId> = (0..40).map(|_| ids.insert(())).collect();
    let (own, mut hulls) = (ids.insert(()), Hulls::default());
    for tick in 1..=20 {
        let hull = boat.hull(tick);
        let beside = |(at, id): (u32, &BodyId)| {
            let place = hull.pose.place + DVec2::new(0.0, 20.0 + 5.0 * f64::from(at));
            Hull { id: *id, half: Vec2::splat(0.3), pose: Pose { place, ..hull.pose } }
        };
        let told: Vec<Hull> = (0..).zip(&small).map(beside).chain([Hull { id: own, ..hull }]).collect();
        hulls.go(tick, &told);
    }
    hulls.carry(6, 2, DT, [0.25; 2]);
    let share = hulls.around(boat.pose(20).place).map(|(share, _)| share);
    assert!(hulls.frames.len() == MOST && share.is_some_and(|share| share > 0.99), "{share:?}");
}

#[test]
fn a_hull_lies_where_its_body_does() {
    let shape = Shape::cuboid(Vec3::new(6.0, 1.0, 2.0)).unwrap();
    let desc = BodyDesc { center_of_mass: Vec3::new(-1.0, 0.0, 0.0), ..BodyDesc::from_hull(&shape, 500.0) };
    let mut body = Body::new(desc).unwrap();
    // Its bow, along x, points along z.
    let orientation = Quat::from_rotation_y(-std::f32::consts::FRAC_PI_2);
    body.set_state(BodyState { orientation, ..BodyState::at_rest(Vec3::new(3.0, 0.0, 7.0)) });
    let hull = Hull::of(Boat::new(1.0, 1.0).id, &body, DVec2::new(100.0, 200.0));
    assert!(hull.half.distance(Vec2::new(3.0, 1.0)) < 1e-5, "{hull:?}");
    assert!(hull.pose.heading.distance(DVec2::Y) < 1e-6, "{hull:?}");
    assert!(hull.pose.place.distance(DVec2::new(103.0, 208.0)) < 1e-5, "{hull:?}");
}
