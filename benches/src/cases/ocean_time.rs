//! Cases `phase` (a wave's angle after a long time), `update_rate` (a cascade that is made less often and interpolated
//! in time) and `sea_change` (the sea of another wind comes without a pop).

use std::hint::black_box;

use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, SeaState};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure_together},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const PHASE: Case = Case {
    name: "phase",
    about: "angle of the fastest wave at 10^7 s against integer arithmetic",
    plots: &[],
    run: phase,
};

/// See the module.
pub(super) const RATE: Case = Case {
    name: "update_rate",
    about: "the longest cascade made at some times and interpolated between: error and time",
    plots: &[Plot {
        file: "update_rate",
        title: "Longest cascade of 256 x 256, one thread, per 1/60 s (beside the points: states a second)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("states_per_second"),
    }],
    run: update_rate,
};

/// See the module.
pub(super) const CHANGE: Case = Case {
    name: "sea_change",
    about: "largest step of a height from tick to tick during a change over 60 s, against the two seas' own",
    plots: &[],
    run: sea_change,
};

const TICK: f64 = 1.0 / 60.0;

fn phase(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for loop_time in [200.0, 600.3, 1024.0, 9999.9] {
        let ocean = Ocean::new(OceanDesc { loop_time, ..fixtures::ocean(256) })?;
        let fastest = ocean.modes().iter().flat_map(|modes| modes.n.iter().copied()).max().unwrap_or(0);
        let mut random = Random::new(3);
        let mut worst = 0.0f64;
        for _ in 0..context.pick(20_000, 1_000_000) {
            let t = 1e7 + random.within(-1e5, 1e5);
            let made = f64::from(fastest.wrapping_mul(ocean.phase_at(t))) / 4_294_967_296.0;
            let off = (made - exact_turns(fastest, t, loop_time)).abs();
            worst = worst.max(off.min(1.0 - off));
        }
        let row = Row::new("phase", "wrapping product of 32 bits")
            .param("loop_s", loop_time)
            .param("turns_per_loop", fastest)
            .error(worst, "turns", "n t / loop in integers of 128 bits, at times within 10^5 s of 10^7 s");
        // Half a unit of the time's 32 bits, times the turns.
        rows.push(if fastest < 8_000 {
            row.bound(1e-6)
        } else {
            row.note("all waves are off by one and the same time, at most 2^-33 of the loop (here 1.2 microseconds)")
        });
    }
    Ok(rows)
}

/// The fraction of `n t / period`, `t` and `period` being the numbers that the floats are.
fn exact_turns(n: u32, t: f64, period: f64) -> f64 {
    // t = a / 2^p, period = b / 2^q.
    let split = |x: f64| {
        let bits = x.to_bits();
        let (digits, exponent) = (bits & ((1 << 52) - 1) | 1 << 52, 1075 - (bits >> 52) as i32);
        let twos = (digits.trailing_zeros() as i32).min(exponent);
        (u128::from(digits >> twos), (exponent - twos) as u32)
    };
    let ((a, p), (b, q)) = (split(t), split(period));
    let whole = b << p;
    // n a 2^q modulo the whole, a bit at a time so that nothing overflows.
    let rest = (0..q).fold(u128::from(n) * a % whole, |rest, _| 2 * rest % whole);
    (rest as f64) / (whole as f64)
}

/// Lagrange's weights at a fraction of the interval between the middle two of four states.
fn cubic(x: f32) -> [f32; 4] {
    [
        -x * (x - 1.0) * (x - 2.0) / 6.0,
        (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
        -(x + 1.0) * x * (x - 2.0) / 2.0,
        (x + 1.0) * x * (x - 1.0) / 6.0,
    ]
}

/// All fields between four states.
fn mix_four(x: f32, states: &[Vec<f32>; 4], out: &mut [f32]) {
    let [a, b, c, d] = cubic(x);
    let states = states[0].iter().zip(&states[1]).zip(states[2].iter().zip(&states[3]));
    for (out, ((p, q), (r, s))) in out.iter_mut().zip(states) {
        *out = a * p + b * q + c * r + d * s;
    }
}

/// The fields of the longest cascade, made by this thread.
fn state(ocean: &mut Ocean, t: f64) -> Vec<f32> {
    ocean.set_time(t);
    let fields = ocean.fields(0);
    [fields.displacement, fields.derivative, fields.velocity].concat().into_flattened()
}

fn update_rate(context: &Context) -> Result<Vec<Row>, CaseError> {
    /// Ticks that are timed together: whole intervals.
    const TICKS: u32 = 60;
    let mut exact = Ocean::new(fixtures::ocean(256))?;
    let hs = f64::from(exact.significant_height());
    let mut random = Random::new(8);
    let starts: Vec<f64> = (0..context.pick(3, 12)).map(|_| (10.0 * random.within(0.0, 1000.0)).round()).collect();
    let rms = |truth: &[f32], made: &[f32]| {
        let heights = truth.iter().zip(made).skip(1).step_by(4).take(256 * 256);
        heights.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>() / 65_536.0
    };
    let mut out = state(&mut exact, 0.0);
    let mut rows = Vec::new();
    for &states_per_second in context.pick(&[20.0, 10.0, 6.0][..], &[30.0, 20.0, 15.0, 12.0, 10.0, 8.0, 6.0]) {
        // As the library numbers its states: as many whole ones as fill the loop.
        let interval = 1.0 / states_per_second;
        let mut desc = fixtures::ocean(256);
        desc.cascades[0].interval = interval as f32;
        let count = (desc.loop_time / f64::from(interval as f32)).ceil();
        let step = desc.loop_time / count;
        let mut slow = Ocean::new(desc)?;
        let (mut two, mut four) = (0.0, 0.0);
        for start in &starts {
            // The error is largest half way.
            let half_way = (start + 0.5) * step;
            let truth = state(&mut exact, half_way);
            two += rms(&truth, &state(&mut slow, half_way)) / starts.len() as f64;
            let states = [-1.0, 0.0, 1.0, 2.0].map(|i| state(&mut exact, (start + i) * step));
            mix_four(0.5, &states, &mut out);
            four += rms(&truth, &out) / starts.len() as f64;
        }
        let states = [0.0, 1.0, 2.0, 3.0].map(|i| state(&mut exact, i * step));
        let mut times = [0.0; 2];
        let run = |ocean: &mut Ocean, time: &mut f64| {
            for _ in 0..TICKS {
                *time += TICK;
                ocean.set_time(*time);
                black_box(ocean.fields(0));
            }
        };
        let [a, b] = &mut times;
        let [whole, slow, mix] = measure_together(
            context.effort,
            [&mut || run(&mut exact, a), &mut || run(&mut slow, b), &mut || {
                mix_four(black_box(0.3), &states, black_box(&mut out));
            }],
        );
        let (whole, slow) = (whole.per(TICKS.into()), slow.per(TICKS.into()));
        // A state now and then, and the mix at every tick.
        let mut cubic = mix;
        cubic.median_ns += whole.median_ns * states_per_second * TICK;
        for (name, error, timing) in [("two states (the library)", two, slow), ("four states", four, cubic)] {
            rows.push(
                Row::new("update_rate", name)
                    .param("states_per_second", states_per_second)
                    .error(
                        100.0 * error.sqrt() / hs,
                        "% of Hs",
                        "the cascade made at that time; heights half way between states, RMS",
                    )
                    .time("a tick of 1/60 s, mean", &timing)
                    .baseline("the cascade made at every tick", &whole),
            );
        }
    }
    Ok(rows)
}

fn sea_change(context: &Context) -> Result<Vec<Row>, CaseError> {
    let cascades = vec![CascadeDesc::new(64, 300.0), CascadeDesc::new(64, 60.0)];
    let before = OceanDesc { sea: SeaState::wind(8.0, 80e3, 0.4), cascades, seed: 2, ..OceanDesc::default() };
    let windy = OceanDesc { sea: SeaState::wind(14.0, 80e3, 0.4), ..before.clone() };
    let turned = OceanDesc { sea: SeaState::wind(8.0, 80e3, 2.4), ..before.clone() };
    let shallow = OceanDesc { sea: SeaState { depth: Some(6.0), ..before.sea.clone() }, ..before.clone() };
    let longer = OceanDesc { loop_time: 1500.0, ..before.clone() };
    let mut rows = Vec::new();
    for (name, after) in
        [("wind rises to 14 m/s", windy), ("wind turns", turned), ("depth becomes 6 m", shallow), ("loop time", longer)]
    {
        let start = 5e5;
        let mut seas = [Ocean::new(before.clone())?, Ocean::new(after.clone())?, Ocean::new(before.clone())?];
        seas[2].change_to(after, start, 60.0)?;
        let mut worst = [0.0f32; 3];
        let every = context.pick(20, 1);
        for (ocean, worst) in seas.iter_mut().zip(&mut worst) {
            for tick in (-60..60 * 61).step_by(every) {
                *worst = worst.max(step(ocean, start + f64::from(tick) * TICK));
            }
        }
        rows.push(
            Row::new("sea_change", name)
                .param("own_step_mm", (1e4 * f64::from(worst[0].max(worst[1]))).round() / 10.0)
                .error(f64::from(worst[2] / worst[0].max(worst[1])), "of the seas' own", "largest step of a texel")
                .bound(1.3),
        );
    }
    Ok(rows)
}

/// Largest change of a height over one tick.
fn step(ocean: &mut Ocean, t: f64) -> f32 {
    ocean.set_time(t);
    let before: Vec<_> = (0..2).map(|c| ocean.displacement(c).to_vec()).collect();
    ocean.set_time(t + TICK);
    let steps = before.iter().enumerate().flat_map(|(c, before)| {
        before.iter().zip(ocean.displacement(c)).map(|(before, after)| (after[1] - before[1]).abs())
    });
    steps.fold(0.0, f32::max)
}
