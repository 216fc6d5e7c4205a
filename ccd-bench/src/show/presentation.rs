//! Turns measurements into tables, a chart and a page.

use crate::method::PAPER_TOLERANCE;
use crate::run::evaluation::Evaluation;
use crate::show::chart::{Charts, Family, MethodFacts};
use crate::show::comparable::Reference;
use crate::show::page;
use crate::show::tables::{self, TextTable};
use crate::show::views::Views;
use crate::show::write;
use anyhow::Result;
use std::path::{Path, PathBuf};

/// The finer of the two tolerances at which methods are compared.
const FINE_TOLERANCE: f64 = 1e-6;
/// The name of the reference method of comparisons.
const REFERENCE_METHOD: &str = "best-first direct";
/// The name of the paper's own method.
const PAPER_METHOD: &str = "fast vmarch";
/// The methods that the paper compares its own with; the factors are in the table's title.
const PAPERS_RIVALS: [&str; 2] = ["CONTACT", "Dynamic Collision Checker"];

/// Writes the tables, the chart and the page of an evaluation into a folder. Returns the table of wrong answers, and
/// the page's path.
///
/// # Errors
/// If there is nothing to draw, or a file cannot be written.
pub fn present(evaluated: &Evaluation, folder: &Path) -> Result<(TextTable, PathBuf)> {
    let (cells, trials) = (evaluated.journal.cells(), evaluated.journal.trials());
    let methods = tables::methods(cells).into_iter();
    let methods: Vec<MethodFacts<'_>> = methods.map(MethodFacts::named).collect();
    let scenes = evaluated.scenes.iter().map(|scene| scene.name.as_str());
    let scenes: Vec<&str> = scenes.collect();
    let is_other = |method: &&MethodFacts<'_>| {
        matches!(method.family, Family::Rival | Family::Peer) || method.name == PAPER_METHOD
    };
    let others = methods.iter().filter(is_other).map(|method| method.name);
    let others: Vec<&str> = others.collect();
    let compared = |tolerance| tables::ratios(trials, REFERENCE_METHOD, &others, tolerance);
    let mut published = tables::ratios(trials, PAPER_METHOD, &PAPERS_RIVALS, PAPER_TOLERANCE);
    published.title += "; the paper reports 1.4 to 45.5 over CONTACT";
    let reference = Reference::new(REFERENCE_METHOD, trials);
    let safety = tables::safety(cells, trials);
    let tables = [
        compared(PAPER_TOLERANCE),
        compared(FINE_TOLERANCE),
        published,
        safety.clone(),
    ];
    let charts = Charts {
        cells: &reference.comparable_cells(cells),
        scenes: &scenes,
        methods: &methods,
    };
    let chart = charts.pareto()?.unwrap_or_default();
    write(&folder.join("pareto.svg"), &chart)?;
    let text: Vec<String> = tables.iter().map(|table| format!("{table}\n")).collect();
    write(&folder.join("tables.md"), &text.join("\n"))?;
    let page = folder.join("index.html");
    let views = Views::new(&evaluated.scenes)?;
    write(&page, &page::html(&chart, &views, &tables)?)?;
    Ok((safety, page))
}
