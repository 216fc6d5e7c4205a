//! A sheet of panels that share their axes, with one legend.

use super::axis::Axis;
use super::legend::Legend;
use super::panel::{BOTTOM_MARGIN, LEFT_MARGIN, Label, Labelled, Panel, TOP_MARGIN, remark};
use super::sheet::{DrawError, MARGIN, Rect, Sheet, TextFormat, WIDTH};
use plotters::style::FontStyle;

/// The height of the chart's title and of the line below it.
pub(super) const HEAD: f64 = 50.0;
/// The height of a line of remarks.
const REMARK: f64 = 16.0;
/// The gap between two panels.
const GUTTER: f64 = 14.0;

/// The common properties of panels.
pub(super) struct Grid<'a> {
    pub(super) title: &'a str,
    /// The direction of better values, and other information that the title lacks.
    pub(super) subtitle: &'a str,
    /// The remarks below the legend, one per line.
    pub(super) remarks: Vec<String>,
    pub(super) legend: Legend<'a>,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) columns: usize,
    /// The height of a panel's axes.
    pub(super) height: f64,
    /// The space to the right of a panel's axes.
    pub(super) right_margin: f64,
}

impl Grid<'_> {
    /// Returns the SVG of panels with these titles; `body` draws the data of a panel by its index.
    pub(super) fn draw(
        &self,
        titles: &[&str],
        body: impl Fn(&Sheet<'_>, usize, &Panel<'_>) -> Result<(), DrawError>,
    ) -> Result<String, DrawError> {
        let columns = self.columns.max(1);
        let rows = titles.len().div_ceil(columns);
        let pitch = self.height + TOP_MARGIN + GUTTER;
        let panels_end = HEAD + pitch * rows as f64 - GUTTER + BOTTOM_MARGIN;
        let remarks_top = panels_end + self.legend.height() + GUTTER;
        let height = remarks_top + REMARK * self.remarks.len() as f64 + MARGIN;
        Sheet::draw(self.title, (WIDTH, height), |sheet| {
            head(sheet, self.title, self.subtitle)?;
            for (number, title) in titles.iter().enumerate() {
                let (row, column) = (number / columns, number % columns);
                let panel = Panel {
                    rect: self.rect_of(row, column),
                    title,
                    x: &self.x,
                    y: &self.y,
                    labelled: Labelled {
                        x: written(number + columns >= titles.len()),
                        y: written(column == 0),
                    },
                };
                panel.draw(sheet)?;
                body(sheet, number, &panel)?;
            }
            self.legend.draw(sheet, (MARGIN, panels_end))?;
            foot(sheet, &self.remarks, remarks_top)
        })
    }

    fn rect_of(&self, row: usize, column: usize) -> Rect {
        let columns = self.columns.max(1) as f64;
        let inside = WIDTH - LEFT_MARGIN - 2.0 * MARGIN;
        let pitch = (inside + GUTTER) / columns;
        Rect {
            left: MARGIN + LEFT_MARGIN + pitch * column as f64,
            top: HEAD + TOP_MARGIN + (self.height + TOP_MARGIN + GUTTER) * row as f64,
            width: pitch - GUTTER - self.right_margin,
            height: self.height,
        }
    }
}

/// Draws a chart's title, and the line below it.
pub(super) fn head(sheet: &Sheet<'_>, title: &str, subtitle: &str) -> Result<(), DrawError> {
    let format = TextFormat {
        size: 16.0,
        weight: FontStyle::Bold,
        ..TextFormat::default()
    };
    sheet.text(title, (MARGIN, 16.0), format)?;
    sheet.text(subtitle, (MARGIN, 36.0), TextFormat::default())
}

/// Draws remarks, one below the other.
pub(super) fn foot(sheet: &Sheet<'_>, remarks: &[String], top: f64) -> Result<(), DrawError> {
    for (line, remark_text) in remarks.iter().enumerate() {
        let middle = top + REMARK * line as f64;
        sheet.text(remark_text, (MARGIN, middle), remark())?;
    }
    Ok(())
}

fn written(outermost: bool) -> Label {
    if outermost {
        Label::Written
    } else {
        Label::Left
    }
}
