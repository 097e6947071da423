//! The rows as a table for the terminal.

use super::Row;

/// One line a row, columns aligned; bad rows are marked.
pub fn table(rows: &[Row]) -> String {
    let head =
        ["", "case", "variant", "parameters", "error", "bound", "unit", "median", "spread", "/baseline", "/limit"]
            .map(str::to_owned);
    let mut lines = vec![head];
    lines.extend(rows.iter().map(cells));
    let widths: [usize; 11] =
        std::array::from_fn(|i| lines.iter().map(|line| line[i].chars().count()).max().unwrap_or(0));
    let mut text = String::new();
    for line in &lines {
        for (i, (cell, width)) in line.iter().zip(widths).enumerate() {
            let numeric = matches!(i, 4 | 5 | 7..);
            text += &if numeric { format!("{cell:>width$}  ") } else { format!("{cell:<width$}  ") };
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    for row in rows {
        if let Some(note) = row.note.as_ref().filter(|_| !row.ok) {
            text += &format!("{}, {}: {note}\n", row.case, row.variant);
        }
    }
    text
}

fn cells(row: &Row) -> [String; 11] {
    let number = |value: Option<f64>| value.map_or(String::new(), |value| significant(value, 4));
    let parameters: Vec<String> = row
        .parameters
        .iter()
        .map(|(name, value)| {
            let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            format!("{name}={value}")
        })
        .collect();
    [
        if row.ok { "ok" } else { "BAD" }.to_owned(),
        row.case.clone(),
        row.variant.clone(),
        parameters.join(" "),
        number(row.error),
        number(row.bound),
        row.error_unit.clone(),
        row.median_ns.map_or(String::new(), duration),
        row.spread_ns.map_or(String::new(), duration),
        row.ratio_to_baseline.map_or(String::new(), |ratio| significant(ratio, 3)),
        row.ratio_to_limit.map_or(String::new(), |ratio| significant(ratio, 3)),
    ]
}

/// A time in the unit that suits it.
pub(super) fn duration(ns: f64) -> String {
    match ns {
        ns if ns >= 1e9 => format!("{} s", significant(ns / 1e9, 3)),
        ns if ns >= 1e6 => format!("{} ms", significant(ns / 1e6, 3)),
        ns if ns >= 1e3 => format!("{} us", significant(ns / 1e3, 3)),
        ns => format!("{} ns", significant(ns, 3)),
    }
}

/// A number with so many significant digits; very large and very small ones with an exponent.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if !(-4..6).contains(&exponent) {
        return format!("{value:.*e}", digits - 1);
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits() {
        assert_eq!(significant(0.0123456, 3), "0.0123");
        assert_eq!(significant(1234.56, 3), "1235");
        assert_eq!(significant(-75.25, 3), "-75.2");
        assert_eq!(significant(3.21e-7, 3), "3.21e-7");
        assert_eq!(duration(1500.0), "1.50 us");
    }

    #[test]
    fn a_bad_row_shows_its_note() {
        let text = table(&[Row::failed("hs", "no sea")]);
        assert!(text.contains("BAD") && text.contains("hs, failed: no sea"));
    }
}
