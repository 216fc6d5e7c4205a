//! Turns measurements into tables, a chart and a page.

use crate::method::PAPER_TOLERANCE;
use crate::run::evaluation::Evaluation;
use crate::show::chart::{ChartData, ChartedMethod, MethodFamily};
use crate::show::comparable::ReferenceTimes;
use crate::show::page;
use crate::show::tables::{self, TextTable};
use crate::show::views::SceneAnimations;
use crate::show::write_text_file;
use anyhow::Result;
use std::path::{Path, PathBuf};

/// The finer of the two tolerances at which the report compares methods.
const FINE_TOLERANCE: f64 = 1e-6;
/// The name of the method with whose times the report compares all others.
const REFERENCE_METHOD: &str = "best-first direct";
/// The name of the paper's method FAST, with a sound bound.
const PAPER_METHOD: &str = "fast vmarch";
/// The names of the methods with which the paper compares FAST. The paper's factors are in the table's title.
const PAPERS_RIVALS: [&str; 2] = ["CONTACT", "Dynamic Collision Checker"];

/// Writes the tables, the chart and the page of an evaluation into a folder. Returns the table of wrong answers, and
/// the page's path.
///
/// # Errors
/// If there is nothing to draw, or a file cannot be written.
pub fn write_report(evaluated: &Evaluation, folder: &Path) -> Result<(TextTable, PathBuf)> {
    let (cells, trials) = (evaluated.journal.cells(), evaluated.journal.trials());
    let methods = tables::methods(cells).into_iter();
    let methods: Vec<ChartedMethod<'_>> = methods.filter_map(ChartedMethod::from_name).collect();
    let scenes = evaluated.scenes.iter().map(|scene| scene.name.as_str());
    let scenes: Vec<&str> = scenes.collect();
    let is_other = |method: &&ChartedMethod<'_>| {
        matches!(
            method.method_family,
            MethodFamily::Rival | MethodFamily::Peer
        ) || method.name == PAPER_METHOD
    };
    let others = methods.iter().filter(is_other).map(|method| method.name);
    let others: Vec<&str> = others.collect();
    let compared =
        |tolerance| tables::time_ratio_table(trials, REFERENCE_METHOD, &others, tolerance);
    let mut published =
        tables::time_ratio_table(trials, PAPER_METHOD, &PAPERS_RIVALS, PAPER_TOLERANCE);
    published.title += "; the paper reports 1.4 to 45.5 over CONTACT";
    let reference = ReferenceTimes::new(REFERENCE_METHOD, trials);
    let safety = tables::safety_table(cells, trials);
    let tables = [
        compared(PAPER_TOLERANCE),
        compared(FINE_TOLERANCE),
        published,
        safety.clone(),
    ];
    let charts = ChartData {
        cells: &reference.cells_with_comparable_medians(cells),
        scenes: &scenes,
        methods: &methods,
    };
    let chart = charts.draw_pareto_chart()?.unwrap_or_default();
    write_text_file(&folder.join("pareto.svg"), &chart)?;
    let text: Vec<String> = tables.iter().map(|table| format!("{table}\n")).collect();
    write_text_file(&folder.join("tables.md"), &text.join("\n"))?;
    let page = folder.join("index.html");
    let views = SceneAnimations::new(&evaluated.scenes)?;
    write_text_file(&page, &page::page_html(&chart, &views, &tables)?)?;
    Ok((safety, page))
}
