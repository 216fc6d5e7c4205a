//! Draws heat maps with families of scenes as rows and methods as columns: how far each method is right, and how its
//! cost grows.

use super::sheet::{
    CHART_MARGIN, CHART_WIDTH, PixelPosition, Sheet, TEXT_COLOUR, draw_svg, draw_text, fill_rect,
    text_style, text_width,
};
use super::style::COLOURS;
use crate::run::contest::Verdict;
use anyhow::Result;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontTransform, RGBColor, WHITE};

/// A heat map with a row for each family of scenes, and a column for each method.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// The kind of map: what the colours of its cells mean.
    pub captions: &'static HeatMapTexts,
    /// The names of the methods, one for each column.
    pub methods: Vec<String>,
    /// The rows of the map, one for each family of scenes.
    pub rows: Vec<HeatRow>,
}

/// A row of a heat map: one family of scenes.
#[derive(Clone, Debug)]
pub struct HeatRow {
    /// The name of the family of scenes.
    pub name: String,
    /// The description of the parameter that makes the family harder.
    pub parameter_description: String,
    /// One cell for each method; `None` without measurements.
    pub cells: Vec<Option<HeatCell>>,
}

/// The texts of a heat map that say what its colours mean: title, remark and legend.
#[derive(Debug)]
pub struct HeatMapTexts {
    title: &'static str,
    /// The two lines of text below the title.
    remark_lines: [&'static str; 2],
    legend_entries: &'static [(&'static str, RGBColor)],
}

/// The kind of map that shows how far each method is right in each family; it has cells of [`HeatCell::solved_range_cell`].
pub const SOLVED_RANGE_TEXTS: &HeatMapTexts = &HeatMapTexts {
    title: "How far each method follows each family: bluer is better",
    remark_lines: [
        "A cell has the colour of the worst answer, and names the first value at which it came. The bar shows the fraction of",
        "the steps, from the easy ones, before the first that is not right.",
    ],
    legend_entries: &[
        ("right", CORRECT_COLOUR),
        ("unresolved or refused", NO_VERDICT_COLOUR),
        ("early", EARLY_COLOUR),
        ("false contact", FALSE_CONTACT_COLOUR),
        ("late or missed", LATE_OR_MISSED_COLOUR),
        ("died or cut off", STOPPED_PROCESS_COLOUR),
    ],
};

/// The kind of map that shows how the cost of each method grows in each family; it has cells of
/// [`HeatCell::cost_growth_cell`].
pub const COST_GROWTH_TEXTS: &HeatMapTexts = &HeatMapTexts {
    title: "How the cost of a query grows from the easy steps to the hard ones: lighter is better",
    remark_lines: [
        "The largest mean number of steps of a query and one for the query itself, as a multiple of that of the family's",
        "easiest value. Only answered queries count: a method that is stopped has no more than is shown.",
    ],
    legend_entries: &[
        ("up to 3 times", GROWTH_COLOURS[0]),
        ("30", GROWTH_COLOURS[1]),
        ("1,000", GROWTH_COLOURS[2]),
        ("more", GROWTH_COLOURS[3]),
    ],
};

/// The colours of cost growth, from light to dark: up to 3, 30 and 1000 times, and more.
const GROWTH_COLOURS: [RGBColor; 4] = [
    RGBColor(0xea, 0xf2, 0xf8),
    RGBColor(0x9e, 0xc4, 0xe0),
    RGBColor(0x3b, 0x7d, 0xb3),
    RGBColor(0x10, 0x2f, 0x54),
];

/// The width of the column of family names, in pixels.
const NAME_COLUMN_WIDTH: f64 = 196.0;
/// The height of a row, in pixels.
const ROW_HEIGHT: f64 = 24.0;
/// The height of the bar in a cell, in pixels.
const CELL_BAR_HEIGHT: f64 = 5.0;
/// The distance of the first row from the top of the sheet, in pixels.
const FIRST_ROW_TOP: f64 = 250.0;
/// The font size of small text, in pixels.
const SMALL_FONT_SIZE: f64 = 10.5;
/// The font size of the smallest text, in pixels.
const SMALLEST_FONT_SIZE: f64 = 7.5;

/// The colour of cells in which all answers are right, and of bars.
const CORRECT_COLOUR: RGBColor = COLOURS[0];
/// The colour of cells whose worst answer is undecided, refused or unresolved.
const NO_VERDICT_COLOUR: RGBColor = RGBColor(0xbc, 0xbc, 0xbc);
/// The colour of cells whose worst answer is an early contact.
const EARLY_COLOUR: RGBColor = RGBColor(0xf5, 0xdd, 0xa0);
/// The colour of cells whose worst answer is a false contact.
const FALSE_CONTACT_COLOUR: RGBColor = COLOURS[4];
/// The colour of cells whose worst answer is a late or a missed contact.
const LATE_OR_MISSED_COLOUR: RGBColor = COLOURS[1];
const STOPPED_PROCESS_COLOUR: RGBColor = COLOURS[6];

/// A cell of a heat map: a colour, two lines of text, and a bar.
#[derive(Clone, Debug)]
pub struct HeatCell {
    fill_colour: RGBColor,
    text_colour: RGBColor,
    text_lines: [String; 2],
    /// The length of the bar, as a fraction of the cell's width.
    bar_fraction: f64,
}

impl HeatCell {
    /// Returns the cell that shows how far a method is right in a family. `worst` is its worst verdict, `fraction` is the
    /// fraction of the values before the first wrong answer, and `limit` is the first value with the worst verdict, empty
    /// if all are right.
    pub fn solved_range_cell(worst: Verdict, fraction: f64, limit: String) -> Self {
        let (fill, word, ink) = verdict_style(worst);
        HeatCell {
            fill_colour: fill,
            text_colour: ink,
            text_lines: [word.to_owned(), limit],
            bar_fraction: fraction,
        }
    }

    /// Returns the cell that shows by which factor a method's cost grows, from the easiest value of a family to the
    /// costliest.
    pub fn cost_growth_cell(factor: f64) -> Self {
        let steps = [3.0, 30.0, 1000.0].iter();
        let darkness = steps.filter(|&&most| factor > most).count();
        let number = match factor {
            ..9.95 => format!("{factor:.1}"),
            ..99_999.0 => format!("{factor:.0}"),
            _ => format!("{factor:.0e}"),
        };
        HeatCell {
            fill_colour: GROWTH_COLOURS[darkness],
            text_colour: if darkness < 2 { TEXT_COLOUR } else { WHITE },
            text_lines: [String::new(), number],
            bar_fraction: 0.0,
        }
    }
}

impl HeatMap {
    /// Draws the map on a sheet of its own; returns the text of an SVG file.
    ///
    /// # Errors
    /// If the drawing library fails.
    pub fn draw(&self) -> Result<String> {
        let height = FIRST_ROW_TOP + ROW_HEIGHT * self.rows.len() as f64 + CHART_MARGIN;
        draw_svg(self.captions.title, (CHART_WIDTH, height), |sheet| {
            draw_header(sheet, self.captions)?;
            let upwards = text_style(SMALL_FONT_SIZE).transform(FontTransform::Rotate270);
            for (column, method) in self.methods.iter().enumerate() {
                let middle = self.column_left(column) + 0.5 * self.column_width();
                draw_text(sheet, method, (middle, FIRST_ROW_TOP - 6.0), &upwards)?;
            }
            for (number, row) in self.rows.iter().enumerate() {
                self.draw_row(sheet, FIRST_ROW_TOP + ROW_HEIGHT * number as f64, row)?;
            }
            Ok(())
        })
    }

    /// Returns the width of a method's column, in pixels.
    fn column_width(&self) -> f64 {
        (CHART_WIDTH - 2.0 * CHART_MARGIN - NAME_COLUMN_WIDTH) / self.methods.len() as f64
    }

    fn column_left(&self, column: usize) -> f64 {
        CHART_MARGIN + NAME_COLUMN_WIDTH + self.column_width() * column as f64
    }

    fn draw_row(&self, sheet: &Sheet<'_>, top: f64, row: &HeatRow) -> Result<()> {
        for (text, down, size) in [
            (&row.name, 0.34, SMALL_FONT_SIZE),
            (&row.parameter_description, 0.76, SMALLEST_FONT_SIZE),
        ] {
            let at = (CHART_MARGIN, top + down * ROW_HEIGHT);
            draw_text(sheet, text, at, &text_style(size))?;
        }
        for (column, cell) in row.cells.iter().enumerate() {
            if let Some(cell) = cell {
                let corner = (self.column_left(column) + 0.5, top + 0.5);
                draw_cell(sheet, corner, self.column_width() - 1.0, cell)?;
            }
        }
        Ok(())
    }
}

/// Draws the title, the remark and the legend of a kind of map.
fn draw_header(sheet: &Sheet<'_>, kind: &HeatMapTexts) -> Result<()> {
    let small = text_style(SMALL_FONT_SIZE);
    draw_text(sheet, kind.title, (CHART_MARGIN, 18.0), &text_style(15.0))?;
    for (words, top) in kind.remark_lines.iter().zip([38.0, 52.0]) {
        draw_text(sheet, words, (CHART_MARGIN, top), &small)?;
    }
    let (mut left, top) = (CHART_MARGIN, 72.0);
    for &(name, colour) in kind.legend_entries {
        fill_rect(sheet, (left, top), (12.0, 12.0), colour)?;
        draw_text(sheet, name, (left + 17.0, top + 6.0), &small)?;
        left += 34.0 + text_width(name, SMALL_FONT_SIZE);
    }
    Ok(())
}

/// Draws a cell with the given upper left corner and width, in pixels.
fn draw_cell(sheet: &Sheet<'_>, (x, y): PixelPosition, width: f64, cell: &HeatCell) -> Result<()> {
    let height = ROW_HEIGHT - 1.0;
    fill_rect(sheet, (x, y), (width, height), cell.fill_colour)?;
    let bar = (width * cell.bar_fraction, CELL_BAR_HEIGHT);
    fill_rect(
        sheet,
        (x, y + height - CELL_BAR_HEIGHT),
        bar,
        CORRECT_COLOUR,
    )?;
    let centered = text_style(SMALLEST_FONT_SIZE)
        .color(&cell.text_colour)
        .pos(Pos::new(HPos::Center, VPos::Center));
    for (line, down) in cell.text_lines.iter().zip([5.0, 13.5]) {
        draw_text(sheet, line, (x + 0.5 * width, y + down), &centered)?;
    }
    Ok(())
}

/// Returns how a verdict is shown: its colour, a word for it, and the colour of the word.
fn verdict_style(verdict: Verdict) -> (RGBColor, &'static str, RGBColor) {
    match verdict {
        Verdict::Right => (CORRECT_COLOUR, "", WHITE),
        Verdict::Undecided | Verdict::NotJudged => (NO_VERDICT_COLOUR, "?", TEXT_COLOUR),
        Verdict::Refused => (NO_VERDICT_COLOUR, "refused", TEXT_COLOUR),
        Verdict::Unresolved => (NO_VERDICT_COLOUR, "unres.", TEXT_COLOUR),
        Verdict::Early => (EARLY_COLOUR, "early", TEXT_COLOUR),
        Verdict::FalseContact => (FALSE_CONTACT_COLOUR, "false", TEXT_COLOUR),
        Verdict::Late => (LATE_OR_MISSED_COLOUR, "late", WHITE),
        Verdict::Missed => (LATE_OR_MISSED_COLOUR, "missed", WHITE),
        Verdict::Crashed => (STOPPED_PROCESS_COLOUR, "died", WHITE),
        Verdict::CutOff => (STOPPED_PROCESS_COLOUR, "cut off", WHITE),
    }
}

#[cfg(test)]
mod tests;
