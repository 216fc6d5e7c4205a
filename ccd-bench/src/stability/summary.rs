//! Summarises a survey as tables and heat maps: how often each method was right, and how much of each family it solved.

use super::family::Family;
use super::findings::Findings;
use super::survey::scene_name;
use crate::run::contest::Verdict;
use crate::run::measured::{MeasurementCell, Trial};
use crate::show::chart::{
    COST_GROWTH_TEXTS, HeatCell, HeatMap, HeatMapTexts, HeatRow, SOLVED_RANGE_TEXTS,
};
use crate::show::tables::TextTable;
use ccd_core::order::greater;
use clap::ValueEnum;
use std::collections::HashMap;

/// Returns a table that counts, for each method, the queries with each verdict.
pub fn summary(findings: &Findings<'_>) -> TextTable {
    let verdicts = Verdict::value_variants().iter();
    let judged = verdicts.filter(|&&verdict| verdict != Verdict::NotJudged);
    let names: Vec<String> = judged.map(Verdict::to_string).collect();
    let columns = ["method", "queries"].map(str::to_owned);
    let columns = columns.into_iter().chain(names.clone());
    let mut table = TextTable::new("Verdicts over all families", columns);
    for method in findings.methods.iter().map(ToString::to_string) {
        let trials = findings.journal.trials().iter();
        let own: Vec<&Trial> = trials.filter(|trial| trial.method == method).collect();
        let count = |name: &String| match own.iter().filter(|t| t.verdict == *name).count() {
            0 => String::new(),
            count => count.to_string(),
        };
        let counts = names.iter().map(count);
        let mut row = vec![method, own.len().to_string()];
        row.extend(counts);
        table.rows.push(row);
    }
    table
}

/// Returns a table with the easiest parameter value at which each method fails in each family, and the worst verdict
/// there.
pub fn first_failure_table(findings: &Findings<'_>) -> TextTable {
    let methods: Vec<String> = findings.methods.iter().map(ToString::to_string).collect();
    let columns = ["family", "parameter"].map(str::to_owned);
    let columns = columns.into_iter().chain(methods.clone());
    let title = "The first value at which answers are not right, and how";
    let mut table = TextTable::new(title, columns);
    for family in &findings.families {
        let limit = |method: &String| match findings.solved_range(family, method) {
            None => "not asked".to_owned(),
            Some(reach) => (reach.first_failure).map_or(String::new(), |(value, verdict)| {
                format!("{value:e} {verdict}")
            }),
        };
        let mut row = vec![
            family.name.to_owned(),
            family.parameter_description.to_owned(),
        ];
        row.extend(methods.iter().map(limit));
        table.rows.push(row);
    }
    table
}

/// Returns the heat map of the fraction of each family that each method solves before its first wrong answer.
pub fn solved_range_heat_map(findings: &Findings<'_>) -> HeatMap {
    make_heat_map(findings, SOLVED_RANGE_TEXTS, |family, method| {
        let reach = findings.solved_range(family, method)?;
        let worst = reach.first_worst_verdict;
        Some(HeatCell::solved_range_cell(
            worst.map_or(Verdict::Right, |(_, verdict)| verdict),
            reach.solved_fraction,
            worst.map_or(String::new(), |(value, _)| format!("{value:e}")),
        ))
    })
}

/// Returns the heat map of cost growth. For each family and method, it shows the largest mean number of steps per query
/// at any parameter value, divided by the number at the easiest value.
pub fn cost_growth_heat_map(findings: &Findings<'_>) -> HeatMap {
    // A query takes no step if the bounds of the whole bodies are enough.
    let cost = |cell: &MeasurementCell| {
        let key = (cell.scene.clone(), cell.method.clone());
        (key, 1.0 + cell.mean_steps)
    };
    let cells = findings.journal.cells().iter();
    let costs: HashMap<(String, String), f64> =
        cells.filter(|cell| cell.cut_off == 0).map(cost).collect();
    make_heat_map(findings, COST_GROWTH_TEXTS, |family, method| {
        let costs = family.parameter_values.iter().filter_map(|&value| {
            let key = (scene_name(family, value), method.to_owned());
            costs.get(&key).copied()
        });
        let costs: Vec<f64> = costs.collect();
        let [easiest, _, ..] = costs[..] else {
            return None;
        };
        let most = costs.iter().copied().fold(0.0, greater);
        // Some methods count no steps.
        (most > 1.0).then_some(HeatCell::cost_growth_cell(most / easiest))
    })
}

/// Makes a heat map with a row per family and a column per method, whose cells the function `cell` computes.
fn make_heat_map(
    findings: &Findings<'_>,
    kind: &'static HeatMapTexts,
    cell: impl Fn(&Family, &str) -> Option<HeatCell>,
) -> HeatMap {
    let methods: Vec<String> = findings.methods.iter().map(ToString::to_string).collect();
    let row = |family: &Family| HeatRow {
        name: family.name.to_owned(),
        parameter_description: family.parameter_description.to_owned(),
        cells: methods.iter().map(|method| cell(family, method)).collect(),
    };
    HeatMap {
        captions: kind,
        rows: findings.families.iter().map(row).collect(),
        methods,
    }
}
