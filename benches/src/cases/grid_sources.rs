//! Cases `source_volume` (what sources write, and how fast), `source_drop` (the ring of a drop), `wave_maker` and
//! `wave_train` (waves of a given height), `hull_walls` (what a hull that moves costs).

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{
    CellKind, Edges, GridDesc, HullOutline, Medium, MediumCell, Rain, Scheme, Source, WaveGrid, WaveMaker, WaveTrain,
};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure, measure_together},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const VOLUME: Case = Case {
    name: "source_volume",
    about: "volume on a grid after many sources of a kind, and the time of one",
    plots: &[],
    run: volume,
};

/// See the module.
pub(super) const DROP: Case = Case {
    name: "source_drop",
    about: "the ring of a drop against the wave equation's Hankel integral",
    plots: &[Plot {
        file: "source_drop",
        title: "Error of a drop's ring against the crater's size",
        x: Axis::Param("crater_cells"),
        y: Axis::Error,
        label: Some("crater_cells"),
    }],
    run: drops,
};

/// See the module.
pub(super) const MAKER: Case = Case {
    name: "wave_maker",
    about: "height of the waves of a paddle from wall to wall, both sides",
    plots: &[],
    run: makers,
};

/// See the module.
pub(super) const TRAIN: Case = Case {
    name: "wave_train",
    about: "what wave trains fed in through all sides leave outside the contour",
    plots: &[],
    run: trains,
};

/// See the module.
pub(super) const HULLS: Case =
    Case { name: "hull_walls", about: "a hull that moves as a wall: time of telling it", plots: &[], run: hulls };

fn volume(context: &Context) -> Result<Vec<Row>, CaseError> {
    type Make = fn(Vec2, f32, f32) -> (Source, f32);
    let kinds: [(&str, Make); 4] = [
        ("displacement", |center, radius, volume| (Source::Displacement { center, radius, volume }, volume)),
        ("box", |center, radius, volume| {
            (Source::Box { center, half: Vec2::new(2.0 * radius, radius), heading: radius, volume }, volume)
        }),
        ("drop", |center, radius, volume| (Source::Drop { center, radius, volume }, 0.0)),
        ("pressure", |center, radius, volume| (Source::Pressure { center, radius, pressure: 1e3 * volume }, 0.0)),
    ];
    let count = context.pick(20_000, 100_000);
    let mut rows = Vec::new();
    for (variant, make) in kinds {
        let mut grid = WaveGrid::new(GridDesc { cells: [128; 2], ..GridDesc::default() })?;
        let mut random = Random::new(4);
        let (mut told, mut moved) = (0.0, 0.0);
        for _ in 0..count {
            let [x, z] = [0, 1].map(|_| random.within(-15.0, 15.0) as f32);
            let (radius, volume) = (random.within(0.0, 2.0) as f32, random.within(-0.5, 0.5) as f32);
            let (source, net) = make(Vec2::new(x, z), radius, volume);
            if !grid.add(source) {
                return Err("a source was dropped".into());
            }
            told += f64::from(net);
            moved += f64::from(volume.abs());
        }
        let error = (grid.volume() - told).abs() / moved;
        let mut n = 0.0f32;
        let timing = measure(context.effort, || {
            n += 0.37;
            let center = 10.0 * Vec2::from_angle(n);
            grid.add(make(center, 0.77, 1e-3).0);
        });
        rows.push(
            Row::new("source_volume", variant)
                .param("sources", count)
                .error(error, "ratio", "volume told; over all volume moved")
                .bound(1e-7)
                .time("one source of 0.77 m on cells of 0.5 m", &timing),
        );
    }
    let desc = GridDesc { cells: [128; 2], cell_size: [0.02; 2], wave_speed: 0.5, ..GridDesc::default() };
    let mut grid = WaveGrid::new(desc)?;
    let rain = Rain { rate: 20.0, drop_radius: 0.0015, seed: 1 };
    let (mut tick, mut fallen) = (0, 0);
    let timing = measure(context.effort, || {
        fallen += grid.add_rain(&rain, tick);
        tick += 1;
    });
    let mean = fallen as f64 / tick as f64;
    rows.push(
        Row::new("source_volume", "rain")
            .param("drops_per_tick", (mean * 100.0).round() / 100.0)
            .time("a tick's rain of 20 mm/h on 2.56 m x 2.56 m", &timing),
    );
    Ok(rows)
}

/// Bessel's J0 by its integral.
fn bessel(x: f64) -> f64 {
    let n = 48 + x as usize;
    (0..n).map(|i| (x * (PI * (i as f64 + 0.5) / n as f64).sin()).cos()).sum::<f64>() / n as f64
}

/// Hankel transform of a smoothstep of unit volume that falls from the middle to zero at `end`, at `k`.
fn transform(k: f64, end: f64) -> f64 {
    let n = 120;
    let (mut sum, mut total) = (0.0, 0.0);
    for i in 0..n {
        let r = (f64::from(i) + 0.5) / f64::from(n);
        let s = (1.0 - r).powi(2) * (1.0 + 2.0 * r) * r;
        sum += s * bessel(k * r * end);
        total += s;
    }
    sum / (TAU * total)
}

fn drops(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, scheme, speed) in [("9-point", Scheme::NinePoint, 25.0f32), ("5-point", Scheme::FivePoint, 21.0)] {
        for &crater in context.pick(&[8.0, 16.0][..], &[3.0, 6.0, 8.0, 12.0, 16.0, 24.0]) {
            let desc = GridDesc { cells: [512; 2], wave_speed: speed, scheme, ..GridDesc::default() };
            let mut grid = WaveGrid::new(desc)?;
            // Half a metre a cell. The crater ends 1.5 cells beyond its radius.
            let (volume, end): (f64, f64) = (1.0, 0.5 * crater);
            let radius = (end - 0.75) as f32;
            grid.add(Source::Drop { center: Vec2::ZERO, radius, volume: volume as f32 });
            let ticks = 160;
            for _ in 0..ticks {
                grid.tick();
            }
            // At rest half a step before it was told.
            let time = (f64::from(ticks) + 0.5) / 60.0;
            let step = 0.012 / end.max(6.0) * 6.0;
            let spectrum: Vec<(f64, f64)> = (0..(30.0 / end / step) as usize)
                .map(|i| (i as f64 + 0.5) * step)
                .map(|k| (k, volume * (transform(k, 2.0 * end) - transform(k, end)) * k * step))
                .collect();
            let (mut worst, mut peak) = (0.0f64, 0.0f64);
            for i in 0..200u32 {
                let r = 0.5 * (f64::from(i) + 0.5f64).hypot(0.5);
                let wave = |(k, s): &(f64, f64)| s * (f64::from(speed) * k * time).cos() * bessel(k * r);
                let exact: f64 = spectrum.iter().map(wave).sum();
                worst = worst.max((f64::from(grid.heights()[256 * 512 + 256 + i as usize]) - exact).abs());
                peak = peak.max(exact.abs());
            }
            let mut row = Row::new("source_drop", variant)
                .param("crater_cells", crater)
                .param("way_cells", (f64::from(speed) * time * 2.0).round())
                .error(100.0 * worst / peak, "%", "Hankel integral of the wave equation; over the highest crest");
            if scheme == Scheme::NinePoint && crater == 16.0 {
                row = row.bound(5.0);
            }
            rows.push(row);
        }
    }
    Ok(rows)
}

/// A channel along x, 24 cells of half a metre wide.
struct Channel;

impl Medium for Channel {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = if place.y.abs() > 6.0 { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn makers(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for &(variant, wave_speed) in &[("one sub-step a tick", 20.0f32), ("three", 70.0)] {
        for &cells in context.pick(&[8.0, 12.0, 24.0][..], &[6.0, 8.0, 12.0, 16.0, 24.0, 40.0]) {
            let desc = GridDesc { cells: [512, 64], wave_speed, ..GridDesc::default() };
            let mut grid = WaveGrid::new(desc)?;
            grid.set_medium(Some(Arc::new(Channel)));
            let period = 0.5 * cells / f64::from(wave_speed);
            let (from, to) = (Vec2::new(2.1, -6.0), Vec2::new(2.1, 6.0));
            let maker = WaveMaker { from, to, height: 0.3, period: period as f32 };
            let settled = 60.0 / f64::from(wave_speed) + 3.0 * period;
            // Whole periods.
            let last = settled + (1.0 / period).ceil() * period;
            let mut sums = [[0.0; 2]; 2];
            for tick in 0..(last * 60.0) as u32 {
                let time = f64::from(tick) / 60.0;
                grid.add(maker.source(&desc, wave_speed, time)?);
                grid.tick();
                if time > settled {
                    for (side, sum) in [156..206usize, 310..360].into_iter().zip(&mut sums) {
                        for z in &grid.heights()[32 * 512..33 * 512][side] {
                            *sum = [sum[0] + f64::from(*z).powi(2), sum[1] + 1.0];
                        }
                    }
                }
            }
            let errors = sums.map(|[square, count]| ((2.0 * square / count).sqrt() / 0.15 - 1.0).abs());
            rows.push(
                Row::new("wave_maker", variant)
                    .param("cells_per_wavelength", cells)
                    .error(100.0 * errors[0].max(errors[1]), "%", "the height asked for, the worse side")
                    .bound(if cells < 12.0 { 5.0 } else { 3.0 }),
            );
        }
    }
    Ok(rows)
}

fn trains(_: &Context) -> Result<Vec<Row>, CaseError> {
    let all = Edges { low_x: true, high_x: true, low_z: true, high_z: true };
    let mut rows = Vec::new();
    for (variant, scheme, heading, cells, wave_speed) in [
        ("9-point", Scheme::NinePoint, 0.4f32, 12.0f32, 20.0f32),
        ("5-point", Scheme::FivePoint, -2.2, 20.0, 33.0),
        ("9-point", Scheme::NinePoint, 1.2, 30.0, 60.0),
    ] {
        let mut grid = WaveGrid::new(GridDesc { cells: [128; 2], wave_speed, scheme, ..GridDesc::default() })?;
        grid.set_feed(all);
        let train = WaveTrain { height: 2.0, period: cells * 0.5 / wave_speed, heading };
        let seconds = f64::from(train.period) * 9.0 + 5.0 * 64.0 / f64::from(wave_speed);
        let ticks = (seconds * 60.0) as u32;
        let [mut inside, mut outside, mut growing] = [0.0f32; 3];
        for tick in 0..ticks {
            grid.tick_trains(&[train], f64::from(tick) / 60.0)?;
            for (at, z) in grid.heights().iter().enumerate() {
                let within = [at % 128, at / 128].iter().all(|i| (15..113).contains(i));
                let most = match (within, tick + 60 > ticks) {
                    (true, _) => &mut inside,
                    (false, true) => &mut outside,
                    (false, false) => &mut growing,
                };
                *most = most.max(z.abs());
            }
        }
        let decibels = |z: f32| 20.0 * f64::from(z / inside).max(1e-30).log10();
        rows.push(
            Row::new("wave_train", variant)
                .param("cells_per_wavelength", cells)
                .param("while_growing_db", decibels(growing).round())
                .error(decibels(outside), "dB", "highest wave outside the contour over that inside")
                .bound(-100.0),
        );
    }
    Ok(rows)
}

fn hulls(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, length, beam) in [("boat of 6 m x 2 m", 6.0f32, 2.0f32), ("ship of 40 m x 8 m", 40.0, 8.0)] {
        let grid = || -> Result<WaveGrid, CaseError> {
            let mut grid = WaveGrid::new(GridDesc { cells: [256; 2], ..fixtures::grid() })?;
            grid.add(Source::Displacement { center: Vec2::ZERO, radius: 2.0, volume: 1.0 });
            Ok(grid)
        };
        let (mut with, mut without) = (grid()?, grid()?);
        let half = Vec2::new(0.5 * length, 0.5 * beam);
        let corners = [half, half * Vec2::new(-1.0, 1.0), -half, half * Vec2::new(1.0, -1.0)];
        let mut hull = [HullOutline { points: corners.to_vec() }];
        let mut time = 0.0f32;
        // 6 m/s in a circle.
        let mut tell = || {
            time += 1.0 / 60.0;
            let turn = Vec2::from_angle(0.4 * time);
            let out = &mut hull[0].points;
            out.clear();
            out.extend(corners.map(|corner| turn.rotate(corner + Vec2::new(0.0, 15.0))));
            with.set_hulls(&hull);
            with.tick();
        };
        let [ours, theirs] = measure_together(context.effort, [&mut tell, &mut || without.tick()]);
        rows.push(
            Row::new("hull_walls", variant)
                .param("cells", (length * beam * 4.0).round())
                .time("a tick of 256^2 with the hull told anew", &ours)
                .baseline("the same window without", &theirs),
        );
    }
    Ok(rows)
}
