//! A survey as tables and a map: how often each method was right, and its reach in each family.

use super::family::Family;
use super::findings::{Findings, VERDICTS};
use super::survey::step_name;
use crate::run::contest::Verdict;
use crate::run::measured::Cell;
use crate::show::chart::{GROWTH, HeatCell, HeatKind, HeatMap, HeatRow, REACH};
use crate::show::tables::TextTable;
use ccd_core::order::greater;
use std::collections::HashMap;

/// Counts the verdicts of each method over all queries.
pub fn summary(findings: &Findings<'_>) -> TextTable {
    let names = VERDICTS.map(|verdict| verdict.to_string());
    let mut header = vec!["method".to_owned(), "queries".to_owned()];
    header.extend(names.iter().cloned());
    let rows = findings.methods.iter().map(|method| {
        let method = method.to_string();
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for trial in findings
            .journal
            .trials()
            .iter()
            .filter(|t| t.method == method)
        {
            *counts.entry(trial.verdict.as_str()).or_default() += 1;
        }
        let all: usize = counts.values().sum();
        let count = |name: &String| {
            counts
                .get(name.as_str())
                .map_or(String::new(), usize::to_string)
        };
        let mut row = vec![method, all.to_string()];
        row.extend(names.iter().map(count));
        row
    });
    TextTable {
        name: "stability".to_owned(),
        title: "Verdicts over all families".to_owned(),
        header,
        rows: rows.collect(),
    }
}

/// Lists for each family and method the first value, from the easiest, at which not all answers are right, and
/// the worst verdict there.
pub fn limits(findings: &Findings<'_>) -> TextTable {
    let methods: Vec<String> = findings.methods.iter().map(ToString::to_string).collect();
    let mut header = vec!["family".to_owned(), "parameter".to_owned()];
    header.extend(methods.iter().cloned());
    let rows = findings.families.iter().map(|family| {
        let limit = |method: &String| match findings.reach(family, method) {
            None => "not asked".to_owned(),
            Some(reach) => reach.first.map_or(String::new(), |limit| {
                format!("{:e} {}", limit.value, limit.verdict)
            }),
        };
        let mut row = vec![family.name.to_owned(), family.parameter.to_owned()];
        row.extend(methods.iter().map(limit));
        row
    });
    TextTable {
        name: "limits".to_owned(),
        title: "The first value at which answers are not right, and how".to_owned(),
        header,
        rows: rows.collect(),
    }
}

/// Returns the map of the reach of each method in each family.
pub fn reach_map(findings: &Findings<'_>) -> HeatMap {
    map(findings, REACH, |family, method| {
        let reach = findings.reach(family, method)?;
        let worst = reach.worst;
        Some(HeatCell::reach(
            worst.map_or(Verdict::Right, |limit| limit.verdict),
            reach.share,
            worst.map_or(String::new(), |limit| format!("{:e}", limit.value)),
        ))
    })
}

/// Returns the map of the growth of each method's cost over each family.
pub fn growth_map(findings: &Findings<'_>) -> HeatMap {
    // A query takes no step if the bounds of the whole bodies are enough.
    let cost = |cell: &Cell| {
        let key = (cell.scene.clone(), cell.method.clone());
        (key, 1.0 + cell.mean_steps)
    };
    let cells = findings.journal.cells().iter();
    let costs: HashMap<(String, String), f64> =
        cells.filter(|cell| cell.cut_off == 0).map(cost).collect();
    map(findings, GROWTH, |family, method| {
        let costs = family.values.iter().filter_map(|&value| {
            let key = (step_name(family, value), method.to_owned());
            costs.get(&key).copied()
        });
        let costs: Vec<f64> = costs.collect();
        let [easiest, _, ..] = costs[..] else {
            return None;
        };
        let most = costs.iter().copied().fold(0.0, greater);
        // Some methods count no steps.
        (most > 1.0).then_some(HeatCell::growth(most / easiest))
    })
}

/// Makes a map from a function of the family and the method.
fn map(
    findings: &Findings<'_>,
    kind: &'static HeatKind,
    cell: impl Fn(&Family, &str) -> Option<HeatCell>,
) -> HeatMap {
    let methods: Vec<String> = findings.methods.iter().map(ToString::to_string).collect();
    let row = |family: &Family| HeatRow {
        name: family.name.to_owned(),
        parameter: family.parameter.to_owned(),
        cells: methods.iter().map(|method| cell(family, method)).collect(),
    };
    HeatMap {
        kind,
        rows: findings.families.iter().map(row).collect(),
        methods,
    }
}
