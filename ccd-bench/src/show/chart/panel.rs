//! A pair of axes with data.

use super::axis::Axis;
use super::sheet::{DrawError, FRAME, Pen, RULE, Rect, Sheet, Spot, TEXT, TextFormat, Turn};
use super::style::{MARKER, MethodStyle};
use plotters::style::FontStyle;
use plotters::style::text_anchor::{HPos, VPos};

/// The gap between an axis and its numbers.
const TICK_GAP: f64 = 5.0;
/// The distance from the left edge of a panel to the middle of its axis' label.
const Y_LABEL: f64 = 44.0;
/// The distance from the lower edge of a panel to the middle of its axis' label.
const X_LABEL: f64 = 32.0;
/// The space to the left of a panel for numbers and label.
pub(super) const LEFT_MARGIN: f64 = Y_LABEL + 10.0;
/// The space below a panel for numbers and label.
pub(super) const BOTTOM_MARGIN: f64 = X_LABEL + 18.0;
/// The space above a panel for its title.
pub(super) const TOP_MARGIN: f64 = 20.0;
/// The share of the axis within which a tick counts as at the end.
const END: f64 = 0.03;
/// The height of the arrow on a value that is a lower bound.
const ARROW: f64 = 12.0;

/// A rectangle with its axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<'a> {
    pub(super) rect: Rect,
    pub(super) title: &'a str,
    pub(super) x: &'a Axis,
    pub(super) y: &'a Axis,
    /// The axes with labels: those whose neighbour has none.
    pub(super) labelled: Labelled,
}

/// The axes of a panel that have numbers and a label.
#[derive(Clone, Copy, Debug)]
pub(super) struct Labelled {
    pub(super) x: Label,
    pub(super) y: Label,
}

/// The presence of numbers and a label on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Label {
    Written,
    Left,
}

/// A value to draw.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) kind: Kind,
}

/// The meaning of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The value is the quantity itself.
    Measured,
    /// The quantity is at least this, since the measurement was cut off.
    AtLeast,
}

impl Panel<'_> {
    /// Draws the frame, title, lines across and labels of the axes.
    pub(super) fn draw(&self, sheet: &Sheet<'_>) -> Result<(), DrawError> {
        self.draw_x_axis(sheet)?;
        self.draw_y_axis(sheet)?;
        sheet.frame(self.rect, FRAME)?;
        let format = TextFormat {
            weight: FontStyle::Bold,
            ..TextFormat::default()
        };
        sheet.text(self.title, (self.rect.left, self.rect.top - 9.0), format)
    }

    /// Draws a line through values, with a marker on each.
    pub(super) fn series(
        &self,
        sheet: &Sheet<'_>,
        points: &[Point],
        style: &MethodStyle,
    ) -> Result<(), DrawError> {
        let spots: Vec<_> = points.iter().filter_map(|p| self.spot(p.x, p.y)).collect();
        if spots.len() > 1 {
            sheet.line(&spots, style.pen(1.4))?;
        }
        self.markers(sheet, points, style)
    }

    /// Draws the markers alone.
    pub(super) fn markers(
        &self,
        sheet: &Sheet<'_>,
        points: &[Point],
        style: &MethodStyle,
    ) -> Result<(), DrawError> {
        for point in points {
            let Some(spot) = self.spot(point.x, point.y) else {
                continue;
            };
            mark(sheet, spot, point.kind, style)?;
        }
        Ok(())
    }

    /// Returns the position of a value, or `None` for NaN.
    pub(super) fn spot(&self, x: f64, y: f64) -> Option<Spot> {
        let across = self.rect.left + self.x.share(x)? * self.rect.width;
        let down = self.rect.bottom() - self.y.share(y)? * self.rect.height;
        Some((across, down))
    }

    fn draw_x_axis(&self, sheet: &Sheet<'_>) -> Result<(), DrawError> {
        let (top, bottom) = (self.rect.top, self.rect.bottom());
        let format = TextFormat {
            across: HPos::Center,
            down: VPos::Top,
            ..TextFormat::default()
        };
        for tick in self.x.ticks() {
            let x = self.rect.left + tick.share * self.rect.width;
            sheet.line(&[(x, top), (x, bottom)], Pen::solid(RULE, 1.0))?;
            let written = tick
                .text
                .as_deref()
                .filter(|_| self.labelled.x == Label::Written);
            if let Some(text) = written {
                let across = across(tick.share);
                sheet.text(
                    text,
                    (x, bottom + TICK_GAP),
                    TextFormat { across, ..format },
                )?;
            }
        }
        let middle = self.rect.left + 0.5 * self.rect.width;
        let format = TextFormat {
            down: VPos::Center,
            ..format
        };
        match self.labelled.x {
            Label::Written => sheet.text(self.x.label(), (middle, bottom + X_LABEL), format),
            Label::Left => Ok(()),
        }
    }

    fn draw_y_axis(&self, sheet: &Sheet<'_>) -> Result<(), DrawError> {
        let (left, right) = (self.rect.left, self.rect.right());
        let format = TextFormat {
            across: HPos::Right,
            ..TextFormat::default()
        };
        for tick in self.y.ticks() {
            let y = self.rect.bottom() - tick.share * self.rect.height;
            sheet.line(&[(left, y), (right, y)], Pen::solid(RULE, 1.0))?;
            let written = tick
                .text
                .as_deref()
                .filter(|_| self.labelled.y == Label::Written);
            if let Some(text) = written {
                sheet.text(text, (left - TICK_GAP, y), format)?;
            }
        }
        let middle = self.rect.top + 0.5 * self.rect.height;
        let format = TextFormat {
            across: HPos::Center,
            turn: Turn::Upwards,
            ..format
        };
        match self.labelled.y {
            Label::Written => sheet.text(self.y.label(), (left - Y_LABEL, middle), format),
            Label::Left => Ok(()),
        }
    }
}

/// Returns the alignment of a label at its tick: labels at the ends stay within the panel.
fn across(share: f64) -> HPos {
    match share {
        share if share < END => HPos::Left,
        share if share > 1.0 - END => HPos::Right,
        _ => HPos::Center,
    }
}

/// Draws a marker, with an arrow upwards if the value is a lower bound.
pub(super) fn mark(
    sheet: &Sheet<'_>,
    (x, y): Spot,
    kind: Kind,
    style: &MethodStyle,
) -> Result<(), DrawError> {
    if kind == Kind::AtLeast {
        let tip = y - ARROW;
        let pen = Pen::solid(style.colour, 1.3);
        let head = [(x - 3.0, tip + 4.0), (x, tip), (x + 3.0, tip + 4.0)];
        sheet.line(&[(x, y - MARKER), (x, tip)], pen)?;
        sheet.line(&head, pen)?;
    }
    sheet.marker((x, y), style)
}

/// Returns the style of a panel's remarks.
pub(super) fn remark() -> TextFormat {
    TextFormat {
        size: TEXT - 1.0,
        ..TextFormat::default()
    }
}
