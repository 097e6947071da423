//! A measured spectrum as wave buoys publish it: a line of column names, then a row per frequency.

use crate::OceanError;
use crate::files::{At, shortened, towards};
use crate::sea::partition::{Partition, Spectrum, Spreading, TableRow};

const MOST_ROWS: usize = 4096;
const NAMES: &str = "columns frequency, density, direction, and spread or r1";

/// Columns, by position in a row.
struct Columns {
    frequency: usize,
    density: usize,
    direction: usize,
    spread: Width,
    count: usize,
}

enum Width {
    /// Circular standard deviation, degrees.
    Spread(usize),
    /// First Fourier coefficient of the spreading.
    R1(usize),
}

/// Reads a table whose column names stand at `at`; rows follow in `lines` up to a line of another kind.
pub(crate) fn parse<'a>(
    at: At<'a>,
    names: &str,
    lines: &mut std::iter::Peekable<impl Iterator<Item = (At<'a>, &'a str)>>,
    end: At<'a>,
) -> Result<Partition, OceanError> {
    let columns = Columns::parse(at, names)?;
    let mut rows: Vec<TableRow> = Vec::new();
    let ends = |line: &str| line.contains('=') || line.starts_with('[') || line.starts_with("directions");
    while let Some((at, line)) = lines.next_if(|(_, line)| !ends(line)) {
        let row = columns.row(at, line)?;
        if let Some(last) = rows.last()
            && row.frequency <= last.frequency
        {
            let found = format!("frequency {} after {}", row.frequency, last.frequency);
            return Err(at.error(found, "frequencies that ascend, each once"));
        }
        if rows.len() == MOST_ROWS {
            return Err(at.error("one more row", format!("up to {MOST_ROWS} rows")));
        }
        rows.push(row);
    }
    let after = lines.peek().map_or(end, |(at, _)| *at);
    if rows.len() < 3 {
        return Err(after.error(format!("{} rows", rows.len()), "3 rows or more"));
    }
    if rows.iter().all(|row| row.density == 0.0) {
        return Err(after.error("only densities of 0", "one above 0"));
    }
    // Direction and spreading are those of the rows.
    Ok(Partition::new(Spectrum::Table(rows), 0.0, Spreading::BothWays))
}

impl Columns {
    fn parse(at: At, line: &str) -> Result<Self, OceanError> {
        let (mut frequency, mut density, mut direction, mut spread) = (None, None, None, None);
        let mut count = 0;
        for (i, name) in line.split_whitespace().enumerate() {
            count += 1;
            let taken = match name {
                "frequency" => frequency.replace(i).is_some(),
                "density" => density.replace(i).is_some(),
                "direction" => direction.replace(i).is_some(),
                "spread" => spread.replace(Width::Spread(i)).is_some(),
                "r1" => spread.replace(Width::R1(i)).is_some(),
                _ => return Err(at.error(format!("`{}`", shortened(name)), format!("`key = value`, or {NAMES}"))),
            };
            if taken {
                return Err(at.error(format!("a second column for `{name}`"), NAMES));
            }
        }
        let missing = |name: &str| at.error(format!("no column `{name}`"), NAMES);
        Ok(Self {
            frequency: frequency.ok_or_else(|| missing("frequency"))?,
            density: density.ok_or_else(|| missing("density"))?,
            direction: direction.ok_or_else(|| missing("direction"))?,
            spread: spread.ok_or_else(|| missing("spread"))?,
            count,
        })
    }

    fn row(&self, at: At, line: &str) -> Result<TableRow, OceanError> {
        let values: Vec<_> = line.split_whitespace().collect();
        if values.len() != self.count {
            return Err(at.error(format!("{} values", values.len()), format!("{}, one per column", self.count)));
        }
        let s = match self.spread {
            // The circular deviation of cos^2s(theta/2) is sqrt(2/(1 + s)).
            Width::Spread(i) => {
                let deviation = at.number("spread", values[i], 0.0..=81.1)?.to_radians();
                2.0 / (deviation * deviation).max(1e-6) - 1.0
            }
            // Its first Fourier coefficient is s/(1 + s).
            Width::R1(i) => {
                let r1 = at.number("r1", values[i], 0.0..=1.0)?;
                r1 / (1.0 - r1).max(1e-6)
            }
        };
        Ok(TableRow {
            frequency: at.number("frequency", values[self.frequency], 1e-3..=5.0)?,
            density: at.number("density", values[self.density], 0.0..=1e6)?,
            direction: towards(at.number("direction", values[self.direction], -360.0..=360.0)?),
            s: s.clamp(0.0, 1000.0),
        })
    }
}
