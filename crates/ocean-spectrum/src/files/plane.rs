//! A measured spectrum over frequency and direction in a sea file: a line of directions, then a row per frequency.

use crate::files::At;
use crate::sea::partition::{Partition, Spectrum, Spreading};
use crate::{DirectionalTable, OceanError};

const MOST_ROWS: usize = 4096;
const MOST_DIRECTIONS: usize = 720;

/// Reads a table whose directions stand at `at`; rows follow in `lines` up to a line of another kind.
pub(crate) fn parse<'a>(
    at: At<'a>,
    directions: &str,
    lines: &mut std::iter::Peekable<impl Iterator<Item = (At<'a>, &'a str)>>,
    end: At<'a>,
) -> Result<Partition, OceanError> {
    let degrees = parse_directions(at, directions)?;
    let (mut frequencies, mut densities): (Vec<f32>, Vec<f32>) = (Vec::new(), Vec::new());
    let numeric =
        |line: &str| line.starts_with(|c: char| c.is_ascii_digit() || ".+-".contains(c)) && !line.contains('=');
    while let Some((at, line)) = lines.next_if(|(_, line)| numeric(line)) {
        let values: Vec<_> = line.split_whitespace().collect();
        let count = degrees.len() + 1;
        if values.len() != count {
            let allowed = format!("{count}, a frequency and one per direction");
            return Err(at.error(format!("{} values", values.len()), allowed));
        }
        if frequencies.len() == MOST_ROWS {
            return Err(at.error("one more row", format!("up to {MOST_ROWS} rows")));
        }
        let frequency = at.number("frequency", values[0], 1e-3..=5.0)?;
        if let Some(last) = frequencies.last().filter(|last| frequency <= **last) {
            let found = format!("frequency {frequency} after {last}");
            return Err(at.error(found, "frequencies that ascend, each once"));
        }
        frequencies.push(frequency);
        for value in &values[1..] {
            // From degrees to radians.
            densities.push(at.number("density", value, 0.0..=1e4)? * 1f32.to_degrees());
        }
    }
    let after = lines.peek().map_or(end, |(at, _)| *at);
    if frequencies.len() < 3 {
        return Err(after.error(format!("{} rows", frequencies.len()), "3 rows or more"));
    }
    if densities.iter().all(|density| *density == 0.0) {
        return Err(after.error("only densities of 0", "one above 0"));
    }
    // From where they come, clockwise from north, to where they go: a quarter turn on, in the same sense.
    let directions = degrees.iter().map(|from| (from + 90.0).to_radians()).collect();
    let table = DirectionalTable::new(frequencies, directions, densities)?;
    Ok(Partition::new(Spectrum::Directional(table), 0.0, Spreading::BothWays))
}

fn parse_directions(at: At, text: &str) -> Result<Vec<f32>, OceanError> {
    let degrees = text
        .split_whitespace()
        .map(|value| at.number("direction", value, -360.0..=360.0))
        .collect::<Result<Vec<_>, _>>()?;
    let count = degrees.len();
    if !(4..=MOST_DIRECTIONS).contains(&count) {
        return Err(at.error(format!("{count} directions"), format!("4 to {MOST_DIRECTIONS}")));
    }
    for (i, from) in degrees.iter().enumerate() {
        let next = degrees.get(i + 1).map_or(degrees[0] + 360.0, |next| *next);
        let gap = next - from;
        if !(0.01..=179.9).contains(&gap) {
            let allowed = "directions that ascend within one turn, less than 180 degrees apart (rows may hold zeros)";
            return Err(at.error(format!("{gap} degrees from direction {from} to the next"), allowed));
        }
    }
    Ok(degrees)
}
