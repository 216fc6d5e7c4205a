//! Maps of stability, with families as rows and methods as columns: the reach of each method, and the growth of its
//! cost.

use super::Drawing;
use super::sheet::{INK, MARGIN, Sheet, Spot, TextFormat, WIDTH, rect, svg, text, text_width};
use super::style::COLOURS;
use crate::run::contest::Verdict;
use anyhow::Result;
use plotters::style::text_anchor::HPos;
use plotters::style::{FontTransform, RGBColor, WHITE};

/// A heat map of families and methods.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// The quantity of the map.
    pub kind: &'static HeatKind,
    /// The names of the methods.
    pub methods: Vec<String>,
    /// The families.
    pub rows: Vec<HeatRow>,
}

/// One family.
#[derive(Clone, Debug)]
pub struct HeatRow {
    /// The name of the family.
    pub name: String,
    /// The parameter that makes the family harder.
    pub parameter: String,
    /// One cell for each method; `None` without data.
    pub cells: Vec<Option<HeatCell>>,
}

/// The quantity of a map, in words.
#[derive(Debug)]
pub struct HeatKind {
    name: &'static str,
    title: &'static str,
    /// The lines of the remark.
    remark: [&'static str; 2],
    legend: &'static [(&'static str, RGBColor)],
}

/// The reach of each method in each family: cells of [`HeatCell::reach`].
pub const REACH: &HeatKind = &HeatKind {
    name: "stability",
    title: "How far each method follows each family: bluer is better",
    remark: [
        "A cell has the colour of the worst answer, and names the first value at which it came. The bar shows the share of",
        "the steps, from the easy ones, before the first that is not right.",
    ],
    legend: &[
        ("right", RIGHT),
        ("unresolved or refused", GREY),
        ("early", EARLY),
        ("false contact", FALSE),
        ("late or missed", WARNING),
        ("died or cut off", BLACK),
    ],
};

/// The growth of the cost: cells of [`HeatCell::growth`].
pub const GROWTH: &HeatKind = &HeatKind {
    name: "growth",
    title: "How the cost of a query grows from the easy steps to the hard ones: lighter is better",
    remark: [
        "The largest mean number of steps of a query and one for the query itself, as a multiple of that of the family's",
        "easiest value. Only answered queries count: a method that is stopped has no more than is shown.",
    ],
    legend: &[
        ("up to 3 times", GROWN[0]),
        ("30", GROWN[1]),
        ("1,000", GROWN[2]),
        ("more", GROWN[3]),
    ],
};

/// The colours from light to dark, for costs that grow by up to 3, 30, 1000 times, and more.
const GROWN: [RGBColor; 4] = [
    RGBColor(0xea, 0xf2, 0xf8),
    RGBColor(0x9e, 0xc4, 0xe0),
    RGBColor(0x3b, 0x7d, 0xb3),
    RGBColor(0x10, 0x2f, 0x54),
];

/// The width of the column of names.
const NAMES: f64 = 196.0;
/// The height of a row.
const ROW: f64 = 24.0;
/// The height of the bar in a cell.
const BAR: f64 = 5.0;
/// The top of the first row.
const TOP: f64 = 250.0;
/// The sizes of small and smallest text.
const SMALL: f64 = 10.5;
const SMALLEST: f64 = 7.5;

/// The colour of steps that are right.
const RIGHT: RGBColor = COLOURS[0];
/// The colour of missing answers.
const GREY: RGBColor = RGBColor(0xbc, 0xbc, 0xbc);
/// The colours of false contacts.
const EARLY: RGBColor = RGBColor(0xf5, 0xdd, 0xa0);
const FALSE: RGBColor = COLOURS[4];
/// The colour of missed contacts.
const WARNING: RGBColor = COLOURS[1];
const BLACK: RGBColor = COLOURS[6];

/// One method on one family: a colour, two lines of text, and a bar.
#[derive(Clone, Debug)]
pub struct HeatCell {
    fill: RGBColor,
    ink: RGBColor,
    lines: [String; 2],
    /// The length of the bar, as a share of the cell's width.
    bar: f64,
}

impl HeatCell {
    /// Returns the cell of the reach of a method: its worst verdict, the share of the values, from the easiest, before
    /// the first wrong one, and the first value with the worst verdict, empty if all are right.
    pub fn reach(worst: Verdict, share: f64, limit: String) -> Self {
        let (fill, word, ink) = look_of(worst);
        HeatCell {
            fill,
            ink,
            lines: [word.to_owned(), limit],
            bar: share,
        }
    }

    /// Returns the cell of the largest cost of a step, as a multiple of that of the easiest one.
    pub fn growth(factor: f64) -> Self {
        let steps = [3.0, 30.0, 1000.0].iter();
        let darkness = steps.filter(|&&most| factor > most).count();
        let number = match factor {
            ..9.95 => format!("{factor:.1}"),
            ..99_999.0 => format!("{factor:.0}"),
            _ => format!("{factor:.0e}"),
        };
        HeatCell {
            fill: GROWN[darkness],
            ink: if darkness < 2 { INK } else { WHITE },
            lines: [String::new(), number],
            bar: 0.0,
        }
    }
}

impl HeatMap {
    /// Draws the map.
    ///
    /// # Errors
    /// If the drawing library fails.
    pub fn draw(&self) -> Result<Drawing> {
        let height = TOP + ROW * self.rows.len() as f64 + MARGIN;
        let svg = svg(self.kind.title, (WIDTH, height), |sheet| {
            head(sheet, self.kind)?;
            let format = TextFormat {
                turn: FontTransform::Rotate270,
                ..small()
            };
            for (column, method) in self.methods.iter().enumerate() {
                let middle = self.left(column) + 0.5 * self.column();
                text(sheet, method, (middle, TOP - 6.0), &format)?;
            }
            for (number, row) in self.rows.iter().enumerate() {
                self.row(sheet, TOP + ROW * number as f64, row)?;
            }
            Ok(())
        })?;
        let name = self.kind.name.to_owned();
        Ok(Drawing { name, svg })
    }

    /// The width of a column.
    fn column(&self) -> f64 {
        (WIDTH - 2.0 * MARGIN - NAMES) / self.methods.len() as f64
    }

    fn left(&self, column: usize) -> f64 {
        MARGIN + NAMES + self.column() * column as f64
    }

    fn row(&self, sheet: &Sheet<'_>, top: f64, row: &HeatRow) -> Result<()> {
        let smallest = TextFormat {
            size: SMALLEST,
            ..small()
        };
        text(sheet, &row.name, (MARGIN, top + 0.34 * ROW), &small())?;
        text(sheet, &row.parameter, (MARGIN, top + 0.76 * ROW), &smallest)?;
        for (column, cell) in row.cells.iter().enumerate() {
            if let Some(cell) = cell {
                let corner = (self.left(column) + 0.5, top + 0.5);
                draw_cell(sheet, corner, self.column() - 1.0, cell)?;
            }
        }
        Ok(())
    }
}

fn small() -> TextFormat {
    TextFormat {
        size: SMALL,
        ..TextFormat::default()
    }
}

/// Draws title, remark and legend.
fn head(sheet: &Sheet<'_>, kind: &HeatKind) -> Result<()> {
    let title = TextFormat {
        size: 15.0,
        ..small()
    };
    text(sheet, kind.title, (MARGIN, 18.0), &title)?;
    for (line, words) in kind.remark.iter().enumerate() {
        text(sheet, words, (MARGIN, 38.0 + 14.0 * line as f64), &small())?;
    }
    let (mut left, top) = (MARGIN, 72.0);
    for &(name, colour) in kind.legend {
        rect(sheet, (left, top), (12.0, 12.0), colour)?;
        text(sheet, name, (left + 17.0, top + 6.0), &small())?;
        left += 34.0 + text_width(name, SMALL);
    }
    Ok(())
}

/// Draws a cell, given by its upper left corner and its width.
fn draw_cell(sheet: &Sheet<'_>, (x, y): Spot, width: f64, cell: &HeatCell) -> Result<()> {
    let height = ROW - 1.0;
    rect(sheet, (x, y), (width, height), cell.fill)?;
    let bar = (width * cell.bar, BAR);
    rect(sheet, (x, y + height - BAR), bar, RIGHT)?;
    let format = TextFormat {
        size: SMALLEST,
        colour: cell.ink,
        across: HPos::Center,
        ..TextFormat::default()
    };
    for (line, down) in cell.lines.iter().zip([5.0, 13.5]) {
        text(sheet, line, (x + 0.5 * width, y + down), &format)?;
    }
    Ok(())
}

/// Returns the colour of a verdict, a word for it, and the colour of text on it.
fn look_of(verdict: Verdict) -> (RGBColor, &'static str, RGBColor) {
    match verdict {
        Verdict::Right => (RIGHT, "", WHITE),
        Verdict::Undecided | Verdict::NotJudged => (GREY, "?", INK),
        Verdict::Refused => (GREY, "refused", INK),
        Verdict::Unresolved => (GREY, "unres.", INK),
        Verdict::Early => (EARLY, "early", INK),
        Verdict::False => (FALSE, "false", INK),
        Verdict::Late => (WARNING, "late", WHITE),
        Verdict::Missed => (WARNING, "missed", WHITE),
        Verdict::Died => (BLACK, "died", WHITE),
        Verdict::CutOff => (BLACK, "cut off", WHITE),
    }
}

#[cfg(test)]
mod tests;
