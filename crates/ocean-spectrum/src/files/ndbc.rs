//! Spectra as the National Data Buoy Center publishes them in real time, one file each of densities, directions, widths.

use crate::files::{At, shortened, towards};
use crate::sea::partition::{Partition, Spectrum, Spreading, TableRow};
use crate::{OceanError, SeaState};

/// What stands for a value that is missing, or more.
const MISSING: f32 = 999.0;
const MOST_FREQUENCIES: usize = 1024;

/// A row: one moment, with a value (if it is there) by frequency.
struct Row<'a> {
    at: At<'a>,
    /// Year, month, day, hour, minute.
    time: [u32; 5],
    values: Vec<(f32, Option<f32>)>,
}

pub(crate) fn parse(data_spec: &str, swdir: &str, swr1: &str) -> Result<SeaState, OceanError> {
    let densities = rows("data_spec", data_spec, true, 0.0..=1e6)?;
    let directions = rows("swdir", swdir, false, -360.0..=360.0)?;
    let widths = rows("swr1", swr1, false, 0.0..=1.0)?;
    let of = |rows: &[Row], time| rows.iter().position(|row| row.time == time);
    let newest = densities
        .iter()
        .filter_map(|row| Some((row, &directions[of(&directions, row.time)?], &widths[of(&widths, row.time)?])))
        .max_by_key(|(row, ..)| row.time);
    let Some((density, direction, width)) = newest else {
        let [y, mo, d, h, mi] = densities[0].time;
        let found = format!("no time that swdir and swr1 have too, such as {y}-{mo:02}-{d:02} {h:02}:{mi:02}");
        return Err(densities[0].at.error(found, "rows of the same moment in all three files"));
    };
    let table: Vec<_> = density
        .values
        .iter()
        .filter_map(|(frequency, value)| {
            let r1 = nearest(&width.values, *frequency)?;
            Some(TableRow {
                frequency: *frequency,
                density: (*value)?,
                direction: towards(nearest(&direction.values, *frequency)?),
                // The first Fourier coefficient of cos^2s(theta/2) is s/(1 + s).
                s: (r1 / (1.0 - r1).max(1e-6)).clamp(0.0, 1000.0),
            })
        })
        .collect();
    for (row, what) in [(direction, "directions"), (width, "values of r1")] {
        if row.values.iter().all(|(_, value)| value.is_none()) {
            return Err(row.at.error(format!("no {what} but missing ones"), "a value at one frequency or more"));
        }
    }
    if table.len() < 3 {
        return Err(density.at.error(format!("densities at {} frequencies", table.len()), "3 or more"));
    }
    if table.iter().all(|row| row.density == 0.0) {
        return Err(density.at.error("only densities of 0", "one above 0"));
    }
    let sea =
        SeaState { partitions: vec![Partition::new(Spectrum::Table(table), 0.0, Spreading::BothWays)], depth: None };
    sea.validate()?;
    Ok(sea)
}

/// The value at the nearest frequency that has one.
fn nearest(values: &[(f32, Option<f32>)], frequency: f32) -> Option<f32> {
    let known = values.iter().filter_map(|(at, value)| Some(((at - frequency).abs(), (*value)?)));
    known.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, value)| value)
}

fn rows<'a>(
    file: &'a str,
    text: &str,
    separation: bool,
    allowed: std::ops::RangeInclusive<f32>,
) -> Result<Vec<Row<'a>>, OceanError> {
    let lines = text.lines().enumerate().map(|(i, line)| (At { file, line: i + 1 }, line.trim()));
    let rows = lines
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .map(|(at, line)| row(at, line, separation, &allowed))
        .collect::<Result<Vec<_>, _>>()?;
    if rows.is_empty() {
        let end = At { file, line: text.lines().count() + 1 };
        return Err(end.error("no row", "rows `year month day hour minute value (frequency) ...`"));
    }
    Ok(rows)
}

fn row<'a>(
    at: At<'a>,
    line: &str,
    separation: bool,
    allowed: &std::ops::RangeInclusive<f32>,
) -> Result<Row<'a>, OceanError> {
    let mut words = line.split_whitespace();
    let mut time = [0; 5];
    for (slot, (name, range)) in time.iter_mut().zip([
        ("year", 1900..=2999),
        ("month", 1..=12),
        ("day", 1..=31),
        ("hour", 0..=24),
        ("minute", 0..=59),
    ]) {
        let found = words.next().unwrap_or("");
        *slot = found.parse().ok().filter(|value| range.contains(value)).ok_or_else(|| {
            at.error(format!("{name} `{}`", shortened(found)), format!("{} to {}", range.start(), range.end()))
        })?;
    }
    if separation {
        // The frequency that separates swell from wind sea is not used.
        at.number("separation frequency", words.next().unwrap_or(""), 0.0..=MISSING)?;
    }
    let mut values: Vec<(f32, Option<f32>)> = Vec::new();
    while let Some(value) = words.next() {
        let frequency = words.next().unwrap_or("");
        let inner = frequency.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')).ok_or_else(|| {
            at.error(format!("`{}` after `{}`", shortened(frequency), shortened(value)), "a frequency, as `(0.100)`")
        })?;
        let frequency = at.number("frequency", inner, 1e-3..=5.0)?;
        if let Some((last, _)) = values.last().filter(|(last, _)| frequency <= *last) {
            return Err(at.error(format!("frequency {frequency} after {last}"), "frequencies that ascend, each once"));
        }
        if values.len() == MOST_FREQUENCIES {
            return Err(at.error("one more frequency", format!("up to {MOST_FREQUENCIES}")));
        }
        let missing = value.parse::<f32>().is_ok_and(|value| (MISSING..MISSING + 1.0).contains(&value));
        let value = if missing { None } else { Some(at.number("value", value, allowed.clone())?) };
        values.push((frequency, value));
    }
    if values.is_empty() {
        return Err(at.error("no values", "`value (frequency)`, once or more"));
    }
    Ok(Row { at, time, values })
}
