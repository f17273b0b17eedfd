//! A chart of cases, one below the other, each with two values before and after: bits lost and nanoseconds.

use plotters::prelude::*;

use super::charts::ChartError;
use super::svg::{GRID, INK, with_classes};

/// A case.
pub(super) struct Row {
    /// What stands above its lines.
    pub name: String,
    /// Bits lost before, and after if there is a second form.
    pub bits: (f64, Option<f64>),
    /// The bits that the condition accounts for.
    pub condition: f64,
    /// Nanoseconds before and after, where they were measured.
    pub nanoseconds: Option<(f64, Option<f64>)>,
}

const WIDTH: i32 = 960;
const TOP: i32 = 70;
const BOTTOM: i32 = 24;
const ROW: i32 = 62;
const TEXT: i32 = 24;
const BEFORE: RGBColor = RGBColor(10, 0, 2);
const AFTER: RGBColor = RGBColor(11, 0, 1);
const LINK: RGBColor = RGBColor(10, 0, 1);

/// One of the two scales, from its left end to its right one.
struct Scale {
    pixels: (i32, i32),
    values: (f64, f64),
    logarithmic: bool,
    ticks: &'static [f64],
}

const BITS: Scale =
    Scale { pixels: (30, 600), values: (0.0, 53.0), logarithmic: false, ticks: &[0.0, 10.0, 20.0, 30.0, 40.0, 53.0] };

const TIME: Scale = Scale {
    pixels: (670, 930),
    values: (1.0, 10_000.0),
    logarithmic: true,
    ticks: &[1.0, 10.0, 100.0, 1_000.0, 10_000.0],
};

impl Scale {
    fn place(&self, value: f64) -> i32 {
        let of = |x: f64| if self.logarithmic { x.max(f64::MIN_POSITIVE).log10() } else { x };
        let (from, to) = (of(self.values.0), of(self.values.1));
        let share = ((of(value) - from) / (to - from)).clamp(0.0, 1.0);
        self.pixels.0 + (share * f64::from(self.pixels.1 - self.pixels.0)).round() as i32
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// Draws the rows: a dot before, a ring after, and a stroke at the condition. The scales are those of bits and of time.
pub(super) fn draw(title: &str, [bits, time]: [&str; 2], rows: &[Row]) -> Result<String, ChartError> {
    let height = TOP + BOTTOM + ROW * rows.len() as i32;
    let size = (WIDTH as u32, height as u32);
    let mut svg = String::new();
    {
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        grid(&area, &BITS, bits, height)?;
        if rows.iter().any(|r| r.nanoseconds.is_some()) {
            grid(&area, &TIME, time, height)?;
        }
        for (row, k) in rows.iter().zip(0..) {
            of_row(&area, row, TOP + ROW * k)?;
        }
        area.present().map_err(ChartError::drawing)?;
    }
    Ok(with_classes(&svg, title, size))
}

fn text<'a>(string: String, place: (i32, i32)) -> Text<'a, (i32, i32), String> {
    Text::new(string, place, ("sans-serif", TEXT).into_font().color(&INK))
}

fn grid(area: &Area, scale: &Scale, title: &str, height: i32) -> Result<(), ChartError> {
    area.draw(&text(title.to_owned(), (scale.pixels.0, 8))).map_err(ChartError::drawing)?;
    for tick in scale.ticks {
        let x = scale.place(*tick);
        let line = PathElement::new([(x, TOP - 4), (x, height - BOTTOM)], GRID.stroke_width(2));
        area.draw(&line).map_err(ChartError::drawing)?;
        let digits = tick.to_string();
        let left = x - 6 * digits.len() as i32;
        area.draw(&text(digits, (left, 38))).map_err(ChartError::drawing)?;
    }
    Ok(())
}

fn of_row(area: &Area, row: &Row, top: i32) -> Result<(), ChartError> {
    area.draw(&text(row.name.clone(), (BITS.pixels.0 + 6, top + 2))).map_err(ChartError::drawing)?;
    let y = top + 44;
    let condition = BITS.place(row.condition);
    let stroke = PathElement::new([(condition, y - 11), (condition, y + 11)], INK.stroke_width(3));
    area.draw(&stroke).map_err(ChartError::drawing)?;
    dumbbell(area, &BITS, row.bits, y)?;
    row.nanoseconds.map_or(Ok(()), |times| dumbbell(area, &TIME, times, y))
}

fn dumbbell(area: &Area, scale: &Scale, (before, after): (f64, Option<f64>), y: i32) -> Result<(), ChartError> {
    let left = (scale.place(before), y);
    if let Some(after) = after {
        let right = (scale.place(after), y);
        area.draw(&PathElement::new([left, right], LINK.stroke_width(3))).map_err(ChartError::drawing)?;
        area.draw(&Circle::new(right, 9, AFTER.stroke_width(3))).map_err(ChartError::drawing)?;
    }
    area.draw(&Circle::new(left, 6, BEFORE.filled())).map_err(ChartError::drawing)
}
