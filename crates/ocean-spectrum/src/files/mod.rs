//! Reads a sea state from text: parameters, or a table of a measured spectrum.

pub(crate) mod ndbc;
pub(crate) mod parameters;
pub(crate) mod plane;
pub(crate) mod table;

use std::path::Path;

use crate::files::parameters::Keys;
use crate::{OceanError, SeaState};

/// Largest file that is read, bytes.
const LARGEST: u64 = 1 << 20;

/// Where in which file something was found, to report it.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) file: &'a str,
    pub(crate) line: usize,
}

impl At<'_> {
    pub(crate) fn error(self, found: impl Into<String>, allowed: impl Into<String>) -> OceanError {
        OceanError::File { file: self.file.into(), line: self.line, found: found.into(), allowed: allowed.into() }
    }

    /// A finite number within a range.
    pub(crate) fn number(
        self,
        what: &str,
        text: &str,
        allowed: std::ops::RangeInclusive<f32>,
    ) -> Result<f32, OceanError> {
        match text.parse::<f32>() {
            Ok(value) if allowed.contains(&value) => Ok(value),
            _ => Err(self.error(
                format!("{what} `{}`", shortened(text)),
                format!("a number from {} to {}", allowed.start(), allowed.end()),
            )),
        }
    }
}

/// A piece of the file as an error shows it.
pub(crate) fn shortened(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.into(),
    }
}

pub(crate) fn read(path: &Path) -> Result<SeaState, OceanError> {
    let name = path.display().to_string();
    let unreadable = |reason: String| OceanError::Unreadable { file: name.clone(), reason };
    let length = std::fs::metadata(path).map_err(|error| unreadable(error.to_string()))?.len();
    if length > LARGEST {
        return Err(unreadable(format!("{length} bytes; allowed: up to {LARGEST}")));
    }
    let bytes = std::fs::read(path).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..valid].iter().filter(|&&byte| byte == b'\n').count();
        At { file: &name, line }.error(format!("byte {:#04x}", error.as_bytes()[valid]), "UTF-8 text")
    })?;
    parse(&name, &text)
}

pub(crate) fn parse(file: &str, text: &str) -> Result<SeaState, OceanError> {
    let mut lines = text
        .trim_start_matches('\u{feff}')
        .lines()
        .enumerate()
        .map(|(i, line)| (At { file, line: i + 1 }, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
        .peekable();
    let end = At { file, line: text.lines().count() + 1 };
    let mut depth = None;
    let mut partitions = Vec::new();
    let mut keys = Keys::default();
    let mut keys_at = end;
    while let Some((at, line)) = lines.next() {
        if line.starts_with('[') {
            if !line.ends_with(']') {
                return Err(at.error(format!("`{}`", shortened(line)), "`[name]` to start a partition"));
            }
            if !keys.is_empty() {
                partitions.push(std::mem::take(&mut keys).finish(keys_at)?);
            }
            // A section without keys is an error at its own line.
            keys_at = at;
            match lines.peek() {
                Some((_, next)) if !next.starts_with('[') => {}
                _ => return Err(at.error("a partition without keys", "`key = value` lines")),
            }
        } else if let Some((key, value)) = line.split_once('=') {
            let (key, value) = (key.trim(), value.trim());
            if key == "depth" {
                if depth.replace(at.number("depth", value, 0.5..=20e3)?).is_some() {
                    return Err(at.error("a second `depth`", "one"));
                }
            } else {
                keys_at = at;
                keys.set(at, key, value)?;
            }
        } else {
            if !keys.is_empty() {
                partitions.push(std::mem::take(&mut keys).finish(keys_at)?);
            }
            partitions.push(match line.strip_prefix("directions") {
                Some(directions) => plane::parse(at, directions, &mut lines, end)?,
                None => table::parse(at, line, &mut lines, end)?,
            });
        }
    }
    if !keys.is_empty() {
        partitions.push(keys.finish(keys_at)?);
    }
    if partitions.is_empty() {
        return Err(end.error("no sea", "`key = value` lines or a table with a line of column names"));
    }
    if depth.is_none() && partitions.iter().any(|partition| partition.depth_limited) {
        return Err(end.error("a sea limited by depth, without `depth`", "`depth`, from 0.5 to 20000"));
    }
    if partitions.len() > 16 {
        return Err(end.error(format!("{} partitions", partitions.len()), "up to 16"));
    }
    let sea = SeaState { partitions, depth };
    sea.validate()?;
    Ok(sea)
}

/// Direction towards which waves travel, radians from +x to +z, of a compass direction they come from (degrees
/// clockwise from north): north is -z, east +x.
pub(crate) fn towards(from: f32) -> f32 {
    // From the north (0): towards +z, a quarter turn. From the west (270): towards +x.
    (from + 90.0).rem_euclid(360.0).to_radians()
}
