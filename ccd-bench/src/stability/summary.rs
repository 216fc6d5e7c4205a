//! Tables of a survey: how often each method was right, and how far it followed each family.

use super::family::Family;
use super::survey::{Survey, step_name};
use crate::run::contest::{Journal, Verdict};
use crate::show::tables::TextTable;
use std::collections::HashMap;

/// The verdicts, from good to bad.
const VERDICTS: [Verdict; 10] = [
    Verdict::Right,
    Verdict::Early,
    Verdict::Undecided,
    Verdict::Refused,
    Verdict::Unresolved,
    Verdict::False,
    Verdict::Late,
    Verdict::Missed,
    Verdict::Died,
    Verdict::CutOff,
];

/// Returns how bad a verdict is, from 0 for a right answer.
fn badness(verdict: &str) -> usize {
    let same = |known: &Verdict| known.to_string() == verdict;
    VERDICTS.iter().position(same).unwrap_or(VERDICTS.len())
}

/// Counts the verdicts of each method over all queries.
pub fn summary(survey: &Survey, journal: &Journal) -> TextTable {
    let names = VERDICTS.map(|verdict| verdict.to_string());
    let mut header = vec!["method".to_owned(), "queries".to_owned()];
    header.extend(names.iter().cloned());
    let rows = survey.methods.iter().map(|method| {
        let method = method.to_string();
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for trial in journal.trials().iter().filter(|t| t.method == method) {
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
pub fn limits(survey: &Survey, journal: &Journal) -> TextTable {
    let mut worst: HashMap<(&str, &str), &str> = HashMap::new();
    for trial in journal.trials() {
        let verdict = worst
            .entry((&trial.scene, &trial.method))
            .or_insert(&trial.verdict);
        if badness(&trial.verdict) > badness(verdict) {
            *verdict = &trial.verdict;
        }
    }
    let right = Verdict::Right.to_string();
    let limit = |family: &Family, method: &str| {
        let values = survey.extent.values(family);
        values.iter().find_map(|&value| {
            let step = step_name(family, value);
            let verdict = *worst.get(&(step.as_str(), method))?;
            (verdict != right).then(|| format!("{value:e} {verdict}"))
        })
    };
    let methods: Vec<String> = survey.methods.iter().map(ToString::to_string).collect();
    let mut header = vec!["family".to_owned(), "parameter".to_owned()];
    header.extend(methods.iter().cloned());
    let rows = survey.families.iter().map(|family| {
        let mut row = vec![family.name.to_owned(), family.parameter.to_owned()];
        row.extend(methods.iter().map(|m| limit(family, m).unwrap_or_default()));
        row
    });
    TextTable {
        name: "limits".to_owned(),
        title: "The first value at which answers are not right, and how".to_owned(),
        header,
        rows: rows.collect(),
    }
}
