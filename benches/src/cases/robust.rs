//! Cases `fuzz` (random bodies in random waters), `tank` (energy of water and bodies between walls), `drift` (a boat left
//! alone) and `account` (what bodies tell a grid against what it holds).

use floating_body::{BodyDesc, Hull, Radiation, WATER_DENSITY};
use glam::{DVec2, Quat, Vec2, Vec3};
use open_water::{BodyId, BodyState, BodyStates, Follow, GridDesc, GridId, OpenWater, OpenWaterDesc, Preset, Scheme};
use rayon::prelude::*;
use wave_grid::Border;

use crate::{
    evidence::{Case, CaseError, Context, Row},
    fixtures::{
        FRAME, boat_hull,
        fuzz::{Trial, meshes, trial},
    },
};

/// See the module.
pub(super) const FUZZ: Case = Case {
    name: "fuzz",
    about: "random bodies (0.01 to 1e7 kg, density 0.01 to 3) in random waters, 1 ms to 1 s a tick: speed over what energy allows",
    plots: &[],
    run: fuzz,
};

/// See the module.
pub(super) const TANK: Case = Case {
    name: "tank",
    about: "bodies dropped into a walled tank: energy of water and bodies together",
    plots: &[],
    run: tank,
};

/// See the module.
pub(super) const DRIFT: Case = Case {
    name: "drift",
    about: "a boat left alone on calm water with its waves coupled: drift in a minute",
    plots: &[],
    run: drift,
};

/// See the module.
pub(super) const ACCOUNT: Case = Case {
    name: "account",
    about: "volume that bodies displace against what their grid holds",
    plots: &[],
    run: account,
};

/// Ticks of a trial.
const TICKS: u32 = 40;

fn fuzz(context: &Context) -> Result<Vec<Row>, CaseError> {
    let (meshes, cases) = (meshes()?, context.pick(3_000u64, 1_000_000));
    let tried: Result<Vec<Trial>, _> = (0..cases).into_par_iter().map(|i| trial(i, TICKS, &meshes)).collect();
    let tried = tried?;
    let count = |what: fn(&Trial) -> bool| tried.iter().filter(|t| what(t)).count() as f64;
    let most = |what: fn(&Trial) -> f64| tried.iter().map(what).fold(0.0, f64::max);
    let (worst, strictly) = (most(|t| t.share), most(|t| t.strictly));
    let row = |variant: &str| Row::new("fuzz", variant).param("cases", cases).param("ticks", TICKS);
    Ok(vec![
        row("not finite, or beyond the limits")
            .error(count(|t| t.broken), "cases", "finite states, speeds at most 200 m/s and 60 rad/s")
            .bound(0.0),
        row("states replaced").error(count(|t| t.resets > 0), "cases", "none").bound(0.0),
        row("speed")
            .param("above", count(|t| t.share > 1.0))
            .error(worst, "of the bound", "kinetic and potential energy at hand, with the water that moves along")
            .bound(1.0),
        row("speed, strictly")
            .param("above", count(|t| t.strictly > 1.0))
            .error(strictly, "of the bound", "the same without the water that a body catches as it falls in")
            .note("what falls into the water keeps its speed where no slamming takes it: light bodies dive too deep"),
    ])
}

/// A calm water with a grid fixed around the origin.
fn calm(grid: GridDesc) -> Result<(OpenWater, GridId), CaseError> {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc)?;
    let id = water.add_grid(grid)?;
    Ok((water, id))
}

fn run(water: &mut OpenWater, store: &mut BodyStates) -> Result<(), CaseError> {
    for tick in water.advance(FRAME) {
        water.tick(tick, store)?;
    }
    Ok(())
}

fn walled(scheme: Scheme) -> GridDesc {
    let (follow, border) = (Follow::Fixed(DVec2::ZERO), Border::Reflecting);
    GridDesc { follow, cells: [96; 2], cell_size: [0.5; 2], scheme, border, ..GridDesc::default() }
}

const SCHEMES: [(&str, Scheme); 2] = [("wave equation", Scheme::NinePoint), ("dispersive", Scheme::Dispersive)];

/// Crates and a barge dropped from above, tilted.
fn drop_bodies(water: &mut OpenWater, store: &mut BodyStates, radiation: Radiation) -> Result<Vec<BodyId>, CaseError> {
    let mut ids = Vec::new();
    for (size, place) in [
        (Vec3::new(6.0, 1.5, 3.0), Vec3::new(-6.0, 1.0, 2.0)),
        (Vec3::new(2.0, 1.0, 2.0), Vec3::new(5.0, 1.5, -4.0)),
        (Vec3::splat(3.0), Vec3::new(4.0, 0.5, 7.0)),
    ] {
        let hull = Hull::cuboid(size)?;
        let mut body = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
        body.center_of_mass.y = -0.2 * size.y;
        body.estimate();
        body.radiation = radiation;
        let id = water.add_body(body)?;
        let rest = water.body(id)?.rest_height();
        let orientation = Quat::from_rotation_x(0.1);
        store.insert(id, BodyState { orientation, ..BodyState::at_rest(place + Vec3::Y * rest) });
        ids.push(id);
    }
    Ok(ids)
}

/// Kinetic energy and that of standing over rest, J.
fn energy(water: &OpenWater, id: BodyId) -> Result<f64, CaseError> {
    let body = water.body(id)?;
    let (s, desc) = (body.state(), body.desc());
    let spin = s.orientation.inverse() * s.angular_velocity;
    let moving = desc.mass * s.velocity.length_squared() + spin.dot(body.inertia() * spin);
    let over = f64::from(s.position.y - body.rest_height());
    let area = f64::from(body.waterline().area);
    // In the air it is weight that pulls.
    let spring = f64::from(desc.water_density * 9.81) * area;
    let draft = f64::from(body.waterline().draft);
    let lifted = if over > draft { spring * draft * (over - 0.5 * draft) } else { 0.5 * spring * over * over };
    Ok(0.5 * f64::from(moving) + lifted)
}

/// Energy of a grid's waves, J.
fn waves(water: &OpenWater, id: GridId, scheme: Scheme) -> Result<f64, CaseError> {
    let grid = water.grid(id)?.ok_or("no grid")?;
    // What the wave equation keeps has the height's rate for a velocity.
    let speed = f64::from(grid.desc().wave_speed);
    let factor = if scheme == Scheme::Dispersive { 1.0 } else { 9.81 / (speed * speed) };
    Ok(f64::from(WATER_DENSITY) * factor * grid.energy())
}

fn tank(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (name, scheme) in SCHEMES {
        for radiation in [Radiation::Grid, Radiation::Coefficients] {
            let (mut water, grid) = calm(walled(scheme))?;
            let mut store = BodyStates::default();
            let ids = drop_bodies(&mut water, &mut store, radiation)?;
            let whole = |water: &OpenWater| -> Result<f64, CaseError> {
                ids.iter().try_fold(waves(water, grid, scheme)?, |sum, id| Ok(sum + energy(water, *id)?))
            };
            run(&mut water, &mut store)?;
            let start = whole(&water)?;
            // Means over five seconds, since a body's energy and the water's come and go.
            let (mut least, mut worst, mut last) = (start, 0.0f64, 0.0);
            for window in 0..context.pick(12, 60) {
                let mut mean = 0.0;
                for _ in 0..300 {
                    run(&mut water, &mut store)?;
                    mean += whole(&water)? / 300.0;
                }
                worst = if window == 0 { (mean - start).max(0.0) } else { worst.max(mean - least) };
                (least, last) = (least.min(mean), mean);
            }
            let row = Row::new("tank", format!("{name}, {radiation:?}"))
                .param("seconds", context.pick(60, 300))
                .param("left_%", (100.0 * last / start * 100.0).round() / 100.0)
                .error(100.0 * worst / start, "% of the start", "five seconds' mean that rose over an earlier one");
            rows.push(row.bound(1.0));
        }
    }
    Ok(rows)
}

fn drift(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (name, scheme) in SCHEMES {
        for radiation in [Radiation::Grid, Radiation::Coefficients] {
            let hull = boat_hull()?;
            let mut desc: OpenWaterDesc = Preset::Low.water();
            desc.sea.partitions.clear();
            let mut water = OpenWater::headless(desc)?;
            let id = water.add_body(BodyDesc { radiation, ..BodyDesc::boat(&hull, 1500.0, 8.0) })?;
            water.add_grid(GridDesc {
                follow: Follow::Body(id),
                cells: [128; 2],
                cell_size: [0.25; 2],
                scheme,
                border: Border::Absorbing { width: 12 },
                ..GridDesc::default()
            })?;
            let mut store = BodyStates::default();
            store.insert(id, BodyState::at_rest(Vec3::Y * (water.body(id)?.rest_height() + 0.1)));
            // Dropped, it finds its trim and lets its waves go.
            for _ in 0..60 * 60 {
                run(&mut water, &mut store)?;
            }
            let place = |store: &BodyStates| store.get(id).map(|s| Vec2::new(s.position.x, s.position.z)).ok_or("none");
            let from = place(&store)?;
            for _ in 0..60 * 60 {
                run(&mut water, &mut store)?;
            }
            let way = f64::from(place(&store)?.distance(from));
            rows.push(
                Row::new("drift", format!("{name}, {radiation:?}"))
                    .param("seconds", 60)
                    .error(1e3 * way, "mm", "staying where it is, after a minute to settle")
                    .bound(1.0),
            );
        }
    }
    Ok(rows)
}

fn account(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (name, scheme) in SCHEMES {
        let (mut water, grid) = calm(walled(scheme))?;
        let mut store = BodyStates::default();
        let ids = drop_bodies(&mut water, &mut store, Radiation::Grid)?;
        let told = |water: &OpenWater| -> Result<f64, CaseError> {
            ids.iter().try_fold(0.0, |sum, id| Ok(sum + f64::from(water.body(*id)?.told_volume())))
        };
        let held =
            |water: &OpenWater| -> Result<f64, CaseError> { Ok(water.grid(grid)?.ok_or("no grid")?.held_volume()) };
        // In the air they displace nothing; what they start with is told to nobody.
        run(&mut water, &mut store)?;
        let start = [told(&water)?, held(&water)?];
        let (mut worst, mut most) = (0.0f64, 0.0f64);
        for _ in 0..60 * 20 {
            run(&mut water, &mut store)?;
            let now = [told(&water)? - start[0], held(&water)? - start[1]];
            worst = worst.max((now[0] - now[1]).abs());
            most = most.max(now[0].abs());
        }
        let row = Row::new("account", name).param("told_m3", (most * 1e3).round() / 1e3).error(
            100.0 * worst / most,
            "% of the most displaced",
            "what the grid holds; worst tick of 20 s",
        );
        let textures = "fails while bodies heave: a texture's own volume stands for the change of the columns', cut off at its reach";
        rows.push(if scheme == Scheme::Dispersive { row.note(textures) } else { row.bound(1.0) });
    }
    Ok(rows)
}
