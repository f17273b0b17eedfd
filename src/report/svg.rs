//! Drawing a chart with plotters as an SVG that takes its colours from the page.
//!
//! plotters writes colours into the elements; here each is a sentinel that is then replaced by a class, so that the page's
//! style sheet gives the same chart its colours in light and dark.

use super::charts::ChartError;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use std::ops::Range;

/// A line of a chart.
pub(super) struct Series {
    /// Its colour: 1 to 6, or 7 for a broad line behind the others.
    pub colour: u8,
    /// Whether its line is dashed and its markers are rings.
    pub dashed: bool,
    /// Whether its points are marked.
    pub markers: bool,
    /// Its points, in the axes' units.
    pub points: Vec<(f64, f64)>,
}

/// An axis; a logarithmic one has its ticks at powers of ten.
#[derive(Clone)]
pub(super) struct Axis {
    pub label: &'static str,
    pub range: Range<f64>,
    pub logarithmic: bool,
}

/// The canvas, in the units of the SVG's `viewBox`.
const SIZE: (u32, u32) = (960, 600);
const TEXT: i32 = 30;
/// The sentinels of text and axes, and of grids.
pub(super) const INK: RGBColor = RGBColor(1, 1, 1);
pub(super) const GRID: RGBColor = RGBColor(2, 2, 2);

impl Axis {
    /// Where a value lies: its logarithm on a logarithmic axis.
    fn place(&self, value: f64) -> f64 {
        if self.logarithmic { value.log10() } else { value }
    }

    fn ticks(&self) -> Vec<f64> {
        let (from, to) = (self.place(self.range.start), self.place(self.range.end));
        if self.logarithmic {
            // At most eight numbers, at a whole number of decades from each other.
            let every = ((to - from) / 8.0).ceil().max(1.0) as usize;
            (from.ceil() as i32..=to.floor() as i32).step_by(every).map(|n| 10f64.powi(n)).collect()
        } else {
            (0..=5).map(|i| from + (to - from) * f64::from(i) / 5.0).collect()
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (low, high): (i32, i32)) -> i32 {
        let (from, to) = (self.place(self.range.start), self.place(self.range.end));
        let share = (self.place(*value) - from) / (to - from);
        low + (share * f64::from(high - low)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        match self.place(*value) {
            place if !self.logarithmic => format!("{place}"),
            0.0 => "1".to_owned(),
            1.0 => "10".to_owned(),
            place => format!("10{}", super::text::superscript(place.round() as i32)),
        }
    }
}

/// Draws lines over two axes; points outside of the axes, or without a place on them (zero on a logarithmic axis), are
/// left out.
pub(super) fn plot(title: &str, x: &Axis, y: &Axis, series: &[Series]) -> Result<String, ChartError> {
    let mut svg = String::new();
    {
        let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        let mut chart = ChartBuilder::on(&area)
            .margin(16)
            .margin_right(36)
            .x_label_area_size(84)
            .y_label_area_size(116)
            .build_cartesian_2d(x.clone(), y.clone())
            .map_err(ChartError::drawing)?;
        chart
            .configure_mesh()
            .bold_line_style(GRID.stroke_width(2))
            .light_line_style(TRANSPARENT)
            .axis_style(INK.stroke_width(2))
            .label_style(("sans-serif", TEXT).into_font().color(&INK))
            .x_desc(x.label)
            .y_desc(y.label)
            .draw()
            .map_err(ChartError::drawing)?;
        for line in series {
            let colour = RGBColor(if line.dashed { 11 } else { 10 }, 0, line.colour);
            let inside = |v: f64, axis: &Axis| v >= axis.range.start && v <= axis.range.end;
            let points = line.points.iter().filter(|p| inside(p.0, x) && inside(p.1, y));
            let points: Vec<_> = points.copied().collect();
            chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(3))).map_err(ChartError::drawing)?;
            if line.markers {
                let style = if line.dashed { colour.stroke_width(3) } else { colour.filled() };
                let radius = if line.dashed { 10 } else { 6 };
                chart
                    .draw_series(points.iter().map(|p| Circle::new(*p, radius, style)))
                    .map_err(ChartError::drawing)?;
            }
        }
        area.present().map_err(ChartError::drawing)?;
    }
    Ok(with_classes(&svg, title, SIZE))
}

/// Replaces the sentinels by classes: `ink`, `grid`, `line-1`, `dash-1`, `fill-1`, `ring-1`.
pub(super) fn with_classes(svg: &str, title: &str, (width, height): (u32, u32)) -> String {
    let head = format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\" xmlns=\"http://www.w3.org/2000/svg\">",
        super::text::escape(title)
    );
    let body = svg.split_once('>').map_or("", |(_, body)| body);
    let mut body = body.replace(" opacity=\"1\"", "").replace(" font-family=\"sans-serif\"", "");
    for (colour, class) in [("#010101", "ink"), ("#020202", "grid")] {
        body = body.replace(&format!("stroke=\"{colour}\""), &format!("class=\"{class}\""));
        body = body.replace(&format!("fill=\"{colour}\""), "class=\"label\"");
    }
    for n in 1..=7 {
        for (colour, stroke) in [("#0A000", "line"), ("#0B000", "dash")] {
            body = body.replace(&format!("stroke=\"{colour}{n}\""), &format!("class=\"{stroke}-{n}\""));
            body = body.replace(&format!("fill=\"{colour}{n}\""), &format!("class=\"fill-{n}\""));
        }
    }
    // A ring is a dashed line's marker, and not dashed itself.
    let lines = body
        .lines()
        .map(|line| if line.starts_with("<circle") { line.replace("dash-", "ring-") } else { line.to_owned() });
    head + &lines.collect::<Vec<_>>().join("\n") + "\n"
}
