//! Cases `asleep` and `riding`: what pieces cost that need no forces, against pieces awake, and what a switch shows.

use std::hint::black_box;

use floating_body::{Activity, BodyState, FlatWater, Fleet, FleetDesc};
use glam::Vec3;

use super::fleet_kernel::{DT, crate_desc, pool};
use super::fleet_water::Sea;
use crate::evidence::{Case, CaseError, Context, Row, fastest};

/// See the module.
pub(super) const ASLEEP: Case = Case {
    name: "asleep",
    about: "10,000 crates asleep on calm water against as many awake, one thread",
    plots: &[],
    run: asleep,
};

/// See the module.
pub(super) const RIDING: Case = Case {
    name: "riding",
    about: "10,000 crates that ride against as many awake, one thread; jumps and errors of riders",
    plots: &[],
    run: riding,
};

const SIDE: usize = 100;

/// Crates in rows and columns, 4 m apart.
fn field(side: usize, sleeps: bool) -> Result<Fleet, CaseError> {
    let mut fleet = Fleet::new(FleetDesc { sleeps, ..FleetDesc::new(crate_desc()?) })?;
    let y = fleet.template().rest_height();
    for i in 0..side * side {
        let place = Vec3::new((i % side) as f32 * 4.0, y + 0.02, (i / side) as f32 * 4.0);
        fleet.add(BodyState::at_rest(place))?;
    }
    Ok(fleet)
}

fn share(fleet: &Fleet, what: Activity) -> f64 {
    let all = fleet.iter().filter(|(id, _)| fleet.activity(*id) == Some(what)).count();
    all as f64 / fleet.len() as f64
}

fn asleep(context: &Context) -> Result<Vec<Row>, CaseError> {
    let (one, effort, water) = (pool(1)?, context.effort, FlatWater::default());
    let (mut awake, mut asleep) = (field(SIDE, false)?, field(SIDE, true)?);
    let mut ticks = 0;
    while share(&asleep, Activity::Asleep) < 1.0 && ticks < 7200 {
        (0..60).for_each(|_| asleep.step(DT, &water));
        ticks += 60;
    }
    (0..600).for_each(|_| awake.step(DT, &water));
    // Timed within the pool: to wake its thread takes ten times as long as a tick of all asleep.
    let [sleeping, waking] = one.install(|| {
        fastest(effort, [&mut || asleep.step(DT, black_box(&water)), &mut || awake.step(DT, black_box(&water))])
    });
    Ok(vec![
        Row::new("asleep", "10,000 crates")
            .param("asleep_%", 100.0 * share(&asleep, Activity::Asleep))
            .param("fell_asleep_after_s", f64::from(ticks) * f64::from(DT))
            .error(
                100.0 * sleeping.median_ns / waking.median_ns,
                "% of the time of pieces awake",
                "the same, not allowed to sleep",
            )
            .param("target_%", 2)
            .time("a tick of all", &sleeping)
            .baseline("all awake", &waking),
    ])
}

fn riding(context: &Context) -> Result<Vec<Row>, CaseError> {
    let (one, effort, sea) = (pool(1)?, context.effort, Sea::new());
    let far = Some(Vec3::new(0.0, 5.0, 5000.0));
    let (mut awake, mut riders) = (field(SIDE, true)?, field(SIDE, true)?);
    for tick in 0..200 {
        let water = sea.clone().at(f64::from(tick) * f64::from(DT));
        riders.look(if tick > 100 { far } else { None });
        awake.step(DT, &water);
        riders.step(DT, &water);
    }
    let water = sea.clone().at(200.0 * f64::from(DT));
    let [ride, swim] = one.install(|| {
        fastest(effort, [&mut || riders.step(DT, black_box(&water)), &mut || awake.step(DT, black_box(&water))])
    });
    let found = jumps(&sea, context.pick(1800, 7200))?;
    let base = || Row::new("riding", "10,000 crates").param("waves", 12);
    let mut rows = vec![
        base()
            .param("riding_%", 100.0 * share(&riders, Activity::Riding))
            .error(100.0 * ride.median_ns / swim.median_ns, "% of the time of pieces awake", "the same, nobody looking")
            .param("target_%", 20)
            .time("a tick of all", &ride)
            .baseline("all awake", &swim),
    ];
    let jump = |variant: &str, error: f64| {
        Row::new("riding", variant).error(error, "cm", "where its velocities before and after would have brought it")
    };
    rows.push(jump("jump where riding begins or ends", found.switch).bound(2.0));
    rows.push(jump("jump where a rider reads its plane", found.ride).bound(2.0));
    rows.push(jump("change of place in a tick of pieces awake, beyond their velocity", found.awake));
    rows.push(Row::new("riding", "height of riders").error(
        found.height,
        "% of the waves' RMS",
        "the surface under them and the height at which each began, RMS",
    ));
    Ok(rows)
}

#[derive(Default)]
struct Jumps {
    /// Largest, cm.
    switch: f64,
    ride: f64,
    awake: f64,
    /// RMS.
    height: f64,
}

/// Pieces that are seen near and far by turns.
fn jumps(sea: &Sea, ticks: u32) -> Result<Jumps, CaseError> {
    let mut fleet = field(10, true)?;
    let (near, far) = (Some(Vec3::new(0.0, 5.0, 0.0)), Some(Vec3::new(0.0, 5.0, 5000.0)));
    let mut old: Vec<_> = fleet.iter().map(|(id, s)| (id, s, Activity::Awake)).collect();
    let mut began = vec![0.0f32; old.len()];
    let (mut jumps, mut off, mut waves) = (Jumps::default(), 0.0, 0.0);
    for tick in 0..ticks {
        let time = f64::from(tick) * f64::from(DT);
        fleet.look(if tick / 300 % 2 == 1 { far } else { near });
        fleet.step(DT, &sea.clone().at(time));
        let after = sea.clone().at(time + f64::from(DT));
        for ((id, state, was), began) in old.iter_mut().zip(&mut began) {
            let now = fleet.state(*id).ok_or("a piece is gone")?;
            let is = fleet.activity(*id).ok_or("a piece is gone")?;
            let on = state.position + (state.velocity + now.velocity) * (0.5 * DT);
            let jump = 100.0 * f64::from(on.distance(now.position));
            let kind = match (*was, is) {
                (Activity::Riding, Activity::Riding) => &mut jumps.ride,
                (Activity::Awake, Activity::Awake) => &mut jumps.awake,
                _ => &mut jumps.switch,
            };
            // They settle first.
            if tick > 200 {
                *kind = kind.max(jump);
            }
            if is == Activity::Riding {
                use floating_body::WaterSurface;
                let height = after.patch(glam::Vec2::new(now.position.x, now.position.z), 0.6).height;
                if *was != is {
                    *began = now.position.y - height;
                }
                off += f64::from((now.position.y - height - *began).powi(2));
                waves += f64::from(height.powi(2));
            }
            (*state, *was) = (now, is);
        }
    }
    jumps.height = 100.0 * (off / waves).sqrt();
    Ok(jumps)
}
