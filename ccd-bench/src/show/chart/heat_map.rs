//! How far each method follows each family of scenes: families down, methods across.

use super::look::COLOURS;
use super::sheet::{DrawError, INK, MARGIN, Rect, Sheet, TextFormat, Turn, WIDTH, text_width};
use super::{ChartError, Drawing, failed};
use crate::run::contest::Verdict;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor, WHITE};

/// The data of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// The names of the methods.
    pub methods: Vec<String>,
    /// The families.
    pub rows: Vec<HeatRow>,
}

/// One family.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatRow {
    /// Its name.
    pub name: String,
    /// The parameter that makes it harder.
    pub parameter: String,
    /// One cell for each method; `None` if it was not asked.
    pub cells: Vec<Option<HeatCell>>,
}

/// One method on one family.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatCell {
    /// The worst verdict.
    pub worst: Verdict,
    /// The share of the values, from the easiest, before the first that is not right.
    pub reached: f64,
    /// The first value that is not right; empty if all are.
    pub limit: String,
}

const NAME: &str = "stability";
const TITLE: &str = "How far each method follows each family: bluer is better";
const REMARK: &str = "A cell has the colour of the worst answer, and names the first value that is not right. \
                      The bar shows the share of the steps, from the easy ones, before it.";

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
/// The colour of answers that are none.
const GREY: RGBColor = RGBColor(0xbc, 0xbc, 0xbc);
/// The colours of contacts that are none.
const EARLY: RGBColor = RGBColor(0xf5, 0xdd, 0xa0);
const FALSE: RGBColor = COLOURS[4];
/// The colour of contacts that were passed.
const WARNING: RGBColor = COLOURS[1];
const BLACK: RGBColor = COLOURS[6];

/// The kinds of answers in the legend.
const KINDS: [(&str, RGBColor); 6] = [
    ("right", RIGHT),
    ("unresolved or refused", GREY),
    ("early", EARLY),
    ("false contact", FALSE),
    ("late or missed", WARNING),
    ("died or cut off", BLACK),
];

impl HeatMap {
    /// Draws the map.
    ///
    /// # Errors
    /// If the drawing library fails.
    pub fn draw(&self) -> Result<Drawing, ChartError> {
        let height = TOP + ROW * self.rows.len() as f64 + MARGIN;
        let svg = Sheet::draw(TITLE, (WIDTH, height), |sheet| {
            head(sheet)?;
            for (column, method) in self.methods.iter().enumerate() {
                let format = TextFormat {
                    size: SMALL,
                    turn: Turn::Upwards,
                    down: VPos::Center,
                    ..TextFormat::default()
                };
                let middle = self.left(column) + 0.5 * self.column();
                sheet.text(method, (middle, TOP - 6.0), format)?;
            }
            for (number, row) in self.rows.iter().enumerate() {
                self.row(sheet, TOP + ROW * number as f64, row)?;
            }
            Ok(())
        });
        Ok(Drawing {
            name: NAME.to_owned(),
            title: TITLE.to_owned(),
            svg: svg.map_err(failed(NAME))?,
        })
    }

    /// The width of a column.
    fn column(&self) -> f64 {
        (WIDTH - 2.0 * MARGIN - NAMES) / self.methods.len() as f64
    }

    fn left(&self, column: usize) -> f64 {
        MARGIN + NAMES + self.column() * column as f64
    }

    fn row(&self, sheet: &Sheet<'_>, top: f64, row: &HeatRow) -> Result<(), DrawError> {
        let small = TextFormat {
            size: SMALL,
            ..TextFormat::default()
        };
        let smallest = TextFormat {
            size: SMALLEST,
            ..small
        };
        sheet.text(&row.name, (MARGIN, top + 0.34 * ROW), small)?;
        sheet.text(&row.parameter, (MARGIN, top + 0.76 * ROW), smallest)?;
        for (column, cell) in row.cells.iter().enumerate() {
            let Some(cell) = cell else {
                continue;
            };
            let place = Rect {
                left: self.left(column) + 0.5,
                top: top + 0.5,
                width: self.column() - 1.0,
                height: ROW - 1.0,
            };
            draw_cell(sheet, place, cell)?;
        }
        Ok(())
    }
}

/// Draws title, remark and legend.
fn head(sheet: &Sheet<'_>) -> Result<(), DrawError> {
    let usual = TextFormat::default();
    let title = TextFormat {
        size: 15.0,
        ..usual
    };
    sheet.text(TITLE, (MARGIN, 18.0), title)?;
    let small = TextFormat {
        size: SMALL,
        ..usual
    };
    for (line, text) in wrapped(REMARK, WIDTH - 2.0 * MARGIN).iter().enumerate() {
        sheet.text(text, (MARGIN, 38.0 + 14.0 * line as f64), small)?;
    }
    let (mut left, top) = (MARGIN, 72.0);
    for (kind, colour) in KINDS {
        let square = Rect {
            left,
            top,
            width: 12.0,
            height: 12.0,
        };
        sheet.rect(square, colour.filled())?;
        sheet.text(kind, (left + 17.0, top + 6.0), small)?;
        left += 34.0 + text_width(kind, SMALL);
    }
    Ok(())
}

/// Breaks a text into lines of a width.
fn wrapped(text: &str, width: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        let longer = format!("{} {word}", lines[last]);
        if lines[last].is_empty() {
            lines[last] = word.to_owned();
        } else if text_width(&longer, SMALL) <= width {
            lines[last] = longer;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

fn draw_cell(sheet: &Sheet<'_>, place: Rect, cell: &HeatCell) -> Result<(), DrawError> {
    let (colour, word, ink) = look(cell.worst);
    sheet.rect(place, colour.filled())?;
    let bar = Rect {
        top: place.bottom() - BAR,
        width: place.width * cell.reached,
        height: BAR,
        ..place
    };
    sheet.rect(bar, RIGHT.filled())?;
    let format = TextFormat {
        size: SMALLEST,
        colour: ink,
        across: HPos::Center,
        ..TextFormat::default()
    };
    let middle = place.left + 0.5 * place.width;
    sheet.text(word, (middle, place.top + 5.0), format)?;
    sheet.text(&cell.limit, (middle, place.top + 13.5), format)
}

/// Returns the colour of a verdict, a word for it, and the colour of text on it.
fn look(verdict: Verdict) -> (RGBColor, &'static str, RGBColor) {
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
mod tests {
    use super::*;

    #[test]
    fn a_map_has_all_names_and_the_colour_of_each_worst_answer() {
        let cell = |worst, reached, limit: &str| {
            Some(HeatCell {
                worst,
                reached,
                limit: limit.to_owned(),
            })
        };
        let map = HeatMap {
            methods: vec!["ours".to_owned(), "theirs".to_owned(), "absent".to_owned()],
            rows: vec![HeatRow {
                name: "bullet and paper".to_owned(),
                parameter: "way against thickness".to_owned(),
                cells: vec![
                    cell(Verdict::Right, 1.0, ""),
                    cell(Verdict::Missed, 0.25, "1e5"),
                    None,
                ],
            }],
        };
        let svg = map.draw().unwrap().svg;
        for text in [
            "bullet and paper",
            "way against thickness",
            "theirs",
            "missed",
            "1e5",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        let count = |colour: &str| svg.matches(&format!("fill=\"{colour}\"")).count();
        // The legend, a cell that is right, and two bars; the legend, and a cell that is missed.
        assert_eq!((count("#0072B2"), count("#D55E00")), (4, 2), "{svg}");
    }

    #[test]
    fn long_remarks_are_wrapped() {
        let lines = wrapped("one two three", text_width("one two", SMALL));
        assert_eq!(lines, ["one two", "three"]);
    }
}
