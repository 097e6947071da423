//! The file `evidence.json`. `EVIDENCE.md` beside the package explains every field; keep both in step.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Machine, Timing};

/// Version of the file's layout. Raised when a field changes its meaning or goes; new fields do not raise it.
pub const SCHEMA: u32 = 1;

/// The whole file.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Report {
    /// [`SCHEMA`] of the program that wrote it.
    pub schema: u32,
    /// Whether the short forms of the cases ran (`--quick`).
    pub quick: bool,
    /// Where it ran.
    pub machine: Machine,
    /// Whether every row is ok.
    pub ok: bool,
    /// The rows, in the order of the cases.
    pub rows: Vec<Row>,
}

/// One figure: an error against its bound, or a time, or both.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Row {
    /// The case.
    pub case: String,
    /// Which form of the method, short.
    pub variant: String,
    /// Sizes and settings: numbers or words by name, units in the name.
    pub parameters: BTreeMap<String, Value>,
    /// How wrong the result is; smaller is better. `null` when this row is only a time, or when it is not finite.
    pub error: Option<f64>,
    /// Unit of `error` and `bound`.
    pub error_unit: String,
    /// What the result was compared with.
    pub relative_to: String,
    /// Largest `error` allowed; `null` when the row is for comparison only.
    pub bound: Option<f64>,
    /// False when `error` exceeds `bound`, is not finite, or the case failed.
    pub ok: bool,
    /// Words for the reader, such as why the case failed.
    pub note: Option<String>,
    /// What one repeat does.
    pub timed: Option<String>,
    /// Median time of one repeat, nanoseconds.
    pub median_ns: Option<f64>,
    /// Interquartile range of the repeats, nanoseconds.
    pub spread_ns: Option<f64>,
    /// Number of timed repeats.
    pub repeats: u32,
    /// What `ratio_to_baseline` compares with, timed in turns with this row.
    pub baseline: Option<String>,
    /// `median_ns` over the baseline's: below 1 is faster than the baseline.
    pub ratio_to_baseline: Option<f64>,
    /// The machine's limit that bounds this, measured in the same run.
    pub limit: Option<String>,
    /// `median_ns` over the time that the limit alone would take: 1 is as fast as the machine allows.
    pub ratio_to_limit: Option<f64>,
}

impl Row {
    /// A row without figures yet.
    pub fn new(case: &str, variant: impl Into<String>) -> Self {
        Self {
            case: case.to_owned(),
            variant: variant.into(),
            parameters: BTreeMap::new(),
            error: None,
            error_unit: String::new(),
            relative_to: String::new(),
            bound: None,
            ok: true,
            note: None,
            timed: None,
            median_ns: None,
            spread_ns: None,
            repeats: 0,
            baseline: None,
            ratio_to_baseline: None,
            limit: None,
            ratio_to_limit: None,
        }
    }

    /// The row of a case that could not run.
    pub fn failed(case: &str, why: impl ToString) -> Self {
        let mut row = Self::new(case, "failed");
        row.ok = false;
        row.note = Some(why.to_string());
        row
    }

    /// Adds a parameter.
    pub fn param(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.parameters.insert(name.to_owned(), value.into());
        self
    }

    /// The error, its unit, and what it is relative to. An error that is not a number makes the row bad.
    pub fn error(mut self, error: f64, unit: &str, relative_to: &str) -> Self {
        self.error = error.is_finite().then_some(error);
        self.error_unit = unit.to_owned();
        self.relative_to = relative_to.to_owned();
        self.ok &= error.is_finite();
        self
    }

    /// The largest error allowed; call it after [`Self::error`].
    pub fn bound(mut self, bound: f64) -> Self {
        self.bound = Some(bound);
        self.ok &= self.error.is_some_and(|error| error <= bound);
        self
    }

    /// The time of one repeat of `timed`.
    pub fn time(mut self, timed: &str, timing: &Timing) -> Self {
        self.timed = Some(timed.to_owned());
        self.median_ns = Some(timing.median_ns);
        self.spread_ns = Some(timing.spread_ns);
        self.repeats = timing.repeats;
        self
    }

    /// The time of a baseline for the same work; call it after [`Self::time`].
    pub fn baseline(mut self, name: &str, timing: &Timing) -> Self {
        self.baseline = Some(name.to_owned());
        self.ratio_to_baseline = self.median_ns.map(|ns| ns / timing.median_ns);
        self
    }

    /// The time that the machine's limit alone would take; call it after [`Self::time`].
    pub fn limit(mut self, name: &str, limit_ns: f64) -> Self {
        self.limit = Some(name.to_owned());
        self.ratio_to_limit = self.median_ns.map(|ns| ns / limit_ns);
        self
    }

    /// Words for the reader.
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = Some(note.into());
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_bad_above_its_bound_and_when_its_error_is_not_a_number() {
        let row = |error: f64| Row::new("c", "v").error(error, "m", "truth").bound(1e-3);
        assert!(row(1e-3).ok);
        assert!(!row(1.1e-3).ok);
        assert!(!row(f64::NAN).ok);
        assert_eq!(row(f64::NAN).error, None);
    }

    #[test]
    fn ratios_are_times_over_times() {
        let timing = |ns| Timing { median_ns: ns, spread_ns: 0.0, repeats: 1 };
        let row = Row::new("c", "v").time("t", &timing(50.0)).baseline("b", &timing(100.0)).limit("l", 25.0);
        assert_eq!(row.ratio_to_baseline, Some(0.5));
        assert_eq!(row.ratio_to_limit, Some(2.0));
    }

    #[test]
    fn the_file_survives_a_round_trip() {
        let row = Row::new("c", "v").param("size", 256).error(-80.0, "dB", "truth").bound(-75.0);
        let text = serde_json::to_string(&row).unwrap();
        let back: Row = serde_json::from_str(&text).unwrap();
        assert_eq!(back.parameters["size"], 256);
        assert_eq!(back.error, Some(-80.0));
        assert!(back.ok);
    }
}
