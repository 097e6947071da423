//! Pictures of rows: one figure against another, a line a variant, logarithmic where the values allow it.

use std::{collections::BTreeMap, path::Path};

use plotters::{
    coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter},
    prelude::*,
    style::{FontStyle, register_font},
};

use super::{
    Row,
    table::{duration, significant},
};

/// A figure of a row.
#[derive(Debug, Clone, Copy)]
pub enum Axis {
    /// The error, in its unit.
    Error,
    /// The median time.
    Time,
    /// A parameter.
    Param(&'static str),
}

/// A picture drawn from the rows of a case.
#[derive(Debug, Clone, Copy)]
pub struct Plot {
    /// Name of the file without its ending.
    pub file: &'static str,
    /// Shown above.
    pub title: &'static str,
    /// From left to right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// The parameter written beside each point.
    pub label: Option<&'static str>,
}

impl Axis {
    fn value(self, row: &Row) -> Option<f64> {
        match self {
            Self::Error => row.error,
            Self::Time => row.median_ns,
            Self::Param(name) => row.parameters.get(name)?.as_f64(),
        }
    }

    fn name(self, rows: &[&Row]) -> String {
        match self {
            Self::Error => rows.first().map_or("error".to_owned(), |row| format!("error, {}", row.error_unit)),
            Self::Time => "median time".to_owned(),
            Self::Param(name) => name.replace('_', " "),
        }
    }

    fn format(self, value: f64) -> String {
        if matches!(self, Self::Time) { duration(value) } else { significant(value, 2) }
    }
}

/// A range in decades, or an even one where a value is not positive (decibels, exact zeros).
#[derive(Clone)]
struct Span {
    axis: Axis,
    low: f64,
    high: f64,
    decades: bool,
}

impl Span {
    fn of(axis: Axis, values: &[f64]) -> Self {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let decades = least > 0.0 && most / least > 3.0;
        let (mut low, mut high) = if decades { (least.log10(), most.log10()) } else { (least, most) };
        let margin = if high > low { 0.08 * (high - low) } else { 0.5 * high.abs().max(1e-12) };
        low -= margin;
        high += margin;
        Self { axis, low, high, decades }
    }
}

impl Ranged for Span {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let value = if self.decades { value.log10() } else { *value };
        let share = (value - self.low) / (self.high - self.low);
        limit.0 + (share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let most = hint.max_num_points().clamp(2, 10);
        if !self.decades {
            let step = nice((self.high - self.low) / most.min(6) as f64);
            let first = (self.low / step).ceil() as i64;
            return (first..).map(|i| i as f64 * step).take_while(|value| *value <= self.high).collect();
        }
        let within = |steps: &[f64]| -> Vec<f64> {
            (self.low.floor() as i32..=self.high.ceil() as i32)
                .flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)))
                .filter(|value| (self.low..=self.high).contains(&value.log10()))
                .collect()
        };
        let fine = within(&[1.0, 2.0, 5.0]);
        if fine.len() <= most { fine } else { within(&[1.0]) }
    }

    fn range(&self) -> std::ops::Range<f64> {
        if self.decades { 10f64.powf(self.low)..10f64.powf(self.high) } else { self.low..self.high }
    }
}

impl ValueFormatter<f64> for Span {
    fn format_ext(&self, value: &f64) -> String {
        self.axis.format(*value)
    }
}

/// The next of 1, 2, 5 times a power of ten.
fn nice(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|s| *s >= step * 0.999).unwrap_or(step)
}

/// Draws a picture of those rows that have both figures; none is drawn of fewer than two points.
pub fn draw(plot: &Plot, rows: &[&Row], path: &Path) -> Result<bool, String> {
    let mut series: BTreeMap<&str, Vec<(f64, f64, String)>> = BTreeMap::new();
    for row in rows {
        let (Some(x), Some(y)) = (plot.x.value(row), plot.y.value(row)) else {
            continue;
        };
        let label =
            plot.label.and_then(|name| row.parameters.get(name)).map_or(String::new(), |value| value.to_string());
        series.entry(&row.variant).or_default().push((x, y, label));
    }
    let points: Vec<(f64, f64)> = series.values().flatten().map(|(x, y, _)| (*x, *y)).collect();
    if points.len() < 2 {
        return Ok(false);
    }
    // Registered again for each picture: cheap, and no state to keep.
    register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| "the font does not load".to_owned())?;
    paint(plot, rows, &series, &points, path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(true)
}

/// Writes a picture, pixel by pixel.
pub fn picture(path: &Path, size: [usize; 2], color: impl Fn(usize, usize) -> [u8; 3]) -> Result<(), String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let root = BitMapBackend::new(path, (size[0] as u32, size[1] as u32)).into_drawing_area();
    for y in 0..size[1] {
        for x in 0..size[0] {
            let [r, g, b] = color(x, y);
            root.draw_pixel((x as i32, y as i32), &RGBColor(r, g, b)).map_err(|error| failed(&error))?;
        }
    }
    root.present().map_err(|error| failed(&error))
}

fn paint(
    plot: &Plot,
    rows: &[&Row],
    series: &BTreeMap<&str, Vec<(f64, f64, String)>>,
    points: &[(f64, f64)],
    path: &Path,
) -> Result<(), Box<dyn std::error::Error>> {
    let xs: Vec<f64> = points.iter().map(|p| p.0).collect();
    let ys: Vec<f64> = points.iter().map(|p| p.1).collect();
    let (x, y) = (Span::of(plot.x, &xs), Span::of(plot.y, &ys));
    let root = BitMapBackend::new(path, (960, 640)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .caption(plot.title, ("sans-serif", 24))
        .margin(14)
        .x_label_area_size(56)
        .y_label_area_size(96)
        .build_cartesian_2d(x.clone(), y.clone())?;
    chart
        .configure_mesh()
        .x_desc(plot.x.name(rows))
        .y_desc(plot.y.name(rows))
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .light_line_style(WHITE)
        .draw()?;
    for (i, (name, points)) in series.iter().enumerate() {
        let colour = Palette99::pick(i).to_rgba();
        chart
            .draw_series(LineSeries::new(points.iter().map(|(x, y, _)| (*x, *y)), colour.stroke_width(2)))?
            .label(*name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(3)));
        chart.draw_series(points.iter().map(|(x, y, label)| {
            EmptyElement::at((*x, *y))
                + Circle::new((0, 0), 4, colour.filled())
                + Text::new(label.clone(), (7, -16), ("sans-serif", 14))
        }))?;
    }
    chart
        .configure_series_labels()
        .label_font(("sans-serif", 16))
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    root.present()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::Timing;

    const PLOT: Plot = Plot { file: "test", title: "A title", x: Axis::Time, y: Axis::Error, label: Some("width") };

    fn row(width: u32, error: f64) -> Row {
        let timing = Timing { median_ns: 1e4 * f64::from(width * width), spread_ns: 0.0, repeats: 1 };
        Row::new("c", "v").param("width", width).error(error, "%", "truth").time("t", &timing)
    }

    #[test]
    fn a_picture_needs_two_points_and_shows_more_than_lines() {
        let path = std::env::temp_dir().join(format!("open-water-plot-{}.png", std::process::id()));
        let rows = [row(4, 10.0), row(8, 1.0), row(64, 0.01)];
        assert_eq!(draw(&PLOT, &[&rows[0]], &path), Ok(false));
        assert_eq!(draw(&PLOT, &rows.each_ref(), &path), Ok(true));
        let bytes = std::fs::read(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert!(bytes.starts_with(b"\x89PNG") && bytes.len() > 5_000, "{} bytes", bytes.len());
    }

    #[test]
    fn spans_of_decibels_are_even_and_of_times_in_decades() {
        assert!(!Span::of(Axis::Error, &[-80.0, -20.0]).decades);
        assert!(Span::of(Axis::Time, &[1e3, 1e6]).decades);
    }
}
