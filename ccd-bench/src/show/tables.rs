//! Summarises the measurements as tables of text.

#[cfg(test)]
pub(crate) mod tests;

use crate::method::Method;
use crate::run::contest::Verdict;
use crate::run::measured::{MeasurementCell, Trial};
use ccd_tables::batch::median;
use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{CellAlignment, Table};
use std::collections::{HashMap, HashSet};
use std::fmt;

/// A table of texts, with a title and named columns.
#[derive(Clone, Debug, PartialEq)]
pub struct TextTable {
    /// The title above the table.
    pub title: String,
    /// The names of the columns.
    pub header: Vec<String>,
    /// The rows, each with one text per column.
    pub rows: Vec<Vec<String>>,
}

/// The number of rows below which a median is shown together with the number of rows.
const SMALL_SAMPLE_SIZE: usize = 10;

/// The text in place of a value that is missing.
const NO_VALUE: &str = "–";

impl TextTable {
    /// Creates a table with a title and names of columns, but without rows.
    pub fn new(title: &str, header: impl IntoIterator<Item = impl Into<String>>) -> Self {
        TextTable {
            title: title.to_owned(),
            header: header.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }
}

impl fmt::Display for TextTable {
    /// Writes the title and the table, in Markdown.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = Table::new();
        table.load_style(ASCII_MARKDOWN).set_header(&self.header);
        for (index, column) in table.column_iter_mut().enumerate() {
            // Words are aligned left, numbers right.
            let is_words = |row: &Vec<String>| {
                row.get(index)
                    .is_some_and(|cell| cell.starts_with(char::is_alphabetic))
            };
            if !self.rows.iter().any(is_words) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        table.add_rows(&self.rows);
        write!(f, "{}\n\n{table}", self.title)
    }
}

/// A count in a table of measurements: its name, and the function that returns it.
type CountColumn = (&'static str, fn(&MeasurementCell) -> usize);

/// The counts that are summed over all cells of a method.
const COUNT_COLUMNS: [CountColumn; 8] = [
    ("queries", |cell| cell.rows),
    ("late", |cell| cell.late),
    ("missed", |cell| cell.missed),
    ("false", |cell| cell.false_contacts),
    ("early", |cell| cell.early),
    ("unresolved", |cell| cell.unresolved),
    ("of these cut off", |cell| cell.cut_off),
    ("undecided", |cell| cell.undecided),
];

/// Returns a table that counts how often each method was late, missed a contact, or reported a false one, over all
/// scenes and tolerances. Methods that answer no query are left out.
pub fn safety_table(cells: &[MeasurementCell], trials: &[Trial]) -> TextTable {
    let not_judged = Verdict::NotJudged.to_string();
    let answers = |method: &str| {
        let judged = |t: &Trial| t.method == method && t.verdict != not_judged;
        trials.iter().any(judged)
    };
    let title = "Answers compared with the truth, all scenes and tolerances";
    let names = COUNT_COLUMNS.map(|(name, _)| name);
    let mut table = TextTable::new(title, ["method"].into_iter().chain(names));
    for method in methods(cells).into_iter().filter(|m| answers(m)) {
        let sum = |(_, count): CountColumn| {
            let of = cells.iter().filter(|cell| cell.method == method);
            of.map(count).sum::<usize>().to_string()
        };
        let mut row = vec![method.to_owned()];
        row.extend(COUNT_COLUMNS.map(sum));
        table.rows.push(row);
    }
    table
}

/// Returns a table that compares the times of other methods with those of a reference, scene by scene. A cell has the
/// median of the ratios query by query (and the ratio of the total times) over the queries that both were asked, and a
/// mark if the other method was late or missed a contact there.
pub fn time_ratio_table(
    trials: &[Trial],
    reference: &str,
    others: &[&str],
    tolerance: f64,
) -> TextTable {
    let title = format!("Time in units of {reference}, tolerance {tolerance:e}");
    let mut table = TextTable::new(&title, ["scene"].iter().chain(others).copied());
    let at = |t: &&Trial| t.tolerance == tolerance;
    let scenes = trials.iter().filter(at).map(|trial| trial.scene.as_str());
    for scene in distinct(scenes) {
        let of = |method: &str| -> HashMap<&str, &Trial> {
            let here = trials.iter().filter(at);
            here.filter(|t| t.scene == scene && t.method == method)
                .map(|t| (t.id.as_str(), t))
                .collect()
        };
        let base = of(reference);
        let mut row = vec![scene.to_owned()];
        row.extend(others.iter().map(|other| ratio_text(&base, &of(other))));
        table.rows.push(row);
    }
    table
}

fn ratio_text(base: &HashMap<&str, &Trial>, other: &HashMap<&str, &Trial>) -> String {
    let mut ratios = Vec::new();
    let (mut ours, mut theirs) = (0.0, 0.0);
    for (id, trial) in other {
        if let Some(same) = base.get(id).filter(|_| !trial.micros.is_nan()) {
            ratios.push(trial.micros / same.micros);
            ours += same.micros;
            theirs += trial.micros;
        }
    }
    if ratios.is_empty() {
        return NO_VALUE.to_owned();
    }
    let mark_any = |verdicts: [Verdict; 2], mark: &'static str| {
        let names = verdicts.map(|verdict| verdict.to_string());
        let mut verdicts = other.values().map(|trial| &trial.verdict);
        let occurs = verdicts.any(|verdict| names.contains(verdict));
        if occurs { mark } else { "" }
    };
    let given_up = mark_any([Verdict::CutOff, Verdict::Unresolved], "> ");
    let rows = match ratios.len() {
        few @ ..SMALL_SAMPLE_SIZE => format!(" [{few}]"),
        _ => String::new(),
    };
    let unsafe_mark = mark_any([Verdict::Late, Verdict::Missed], " †");
    let typical = format_three_digits(median(&mut ratios));
    let total = format_three_digits(theirs / ours);
    format!("{given_up}{typical} ({total}){rows}{unsafe_mark}")
}

fn format_three_digits(value: f64) -> String {
    match value {
        ..10.0 => format!("{value:.2}"),
        10.0..100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

/// Returns each name once, in the order of first occurrence.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = HashSet::new();
    names.filter(|name| seen.insert(*name)).collect()
}

/// Returns the names of the methods in a table: first those that this program runs, in their usual order, then all
/// others.
pub fn methods(cells: &[MeasurementCell]) -> Vec<&str> {
    let order: Vec<String> = Method::built_in_methods()
        .iter()
        .map(ToString::to_string)
        .collect();
    let mut methods = distinct(cells.iter().map(|cell| cell.method.as_str()));
    // Methods that a script runs come last.
    methods.sort_by_key(|name| order.iter().position(|o| o == name).unwrap_or(order.len()));
    methods
}
