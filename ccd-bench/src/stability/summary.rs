//! A survey in tables and a map: how often each method was right, and how far it followed each family.

use super::family::Family;
use super::survey::{Survey, step_name};
use crate::run::contest::{Journal, Verdict};
use crate::run::measured::{Cell, Trial};
use crate::show::chart::{HeatCell, HeatKind, HeatMap, HeatRow};
use crate::show::tables::TextTable;
use ccd_core::order::greater;
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

/// The first step of a family at which a method was not right.
struct Limit {
    value: f64,
    /// The worst verdict at that step.
    verdict: Verdict,
}

/// How far a method followed a family.
struct Reach {
    /// The share of the steps, from the easiest, before the limit.
    share: f64,
    limit: Option<Limit>,
    /// The worst verdict at any step.
    worst: Verdict,
}

/// The worst answer to each step by each method, and how bad it is.
pub(super) struct Answers<'j>(HashMap<(&'j str, &'j str), (usize, &'j Trial)>);

impl<'j> Answers<'j> {
    pub(super) fn of(journal: &'j Journal) -> Self {
        let mut worst = HashMap::new();
        for trial in journal.trials() {
            let same = |known: &Verdict| known.to_string() == trial.verdict;
            let bad = VERDICTS.iter().position(same).unwrap_or(VERDICTS.len() - 1);
            let so_far = worst.entry((trial.scene.as_str(), trial.method.as_str()));
            let so_far = so_far.or_insert((bad, trial));
            if bad > so_far.0 {
                *so_far = (bad, trial);
            }
        }
        Answers(worst)
    }

    /// Returns the worst answer of a method to a step; none if it was not asked.
    pub(super) fn worst(&self, family: &Family, value: f64, method: &str) -> Option<&'j Trial> {
        let step = step_name(family, value);
        let (_, trial) = self.0.get(&(step.as_str(), method))?;
        Some(trial)
    }

    /// Returns how far a method followed a family; none if it was not asked.
    fn reach(&self, values: &[f64], family: &Family, method: &str) -> Option<Reach> {
        let asked: Vec<(f64, usize)> = values
            .iter()
            .filter_map(|&value| {
                let step = step_name(family, value);
                Some((value, self.0.get(&(step.as_str(), method))?.0))
            })
            .collect();
        let worst = asked.iter().map(|&(_, bad)| bad).max()?;
        let right = asked.iter().take_while(|&&(_, bad)| bad == 0).count();
        Some(Reach {
            share: right as f64 / values.len() as f64,
            limit: asked.get(right).map(|&(value, bad)| Limit {
                value,
                verdict: VERDICTS[bad],
            }),
            worst: VERDICTS[worst],
        })
    }
}

/// Lists for each family and method the first value, from the easiest, at which not all answers are right, and
/// the worst verdict there.
pub fn limits(survey: &Survey, journal: &Journal) -> TextTable {
    let answers = Answers::of(journal);
    let methods: Vec<String> = survey.methods.iter().map(ToString::to_string).collect();
    let mut header = vec!["family".to_owned(), "parameter".to_owned()];
    header.extend(methods.iter().cloned());
    let rows = survey.families.iter().map(|family| {
        let values = survey.extent.values(family);
        let limit = |method: &String| {
            let limit = answers.reach(&values, family, method)?.limit?;
            Some(format!("{:e} {}", limit.value, limit.verdict))
        };
        let mut row = vec![family.name.to_owned(), family.parameter.to_owned()];
        row.extend(
            methods
                .iter()
                .map(|method| limit(method).unwrap_or_default()),
        );
        row
    });
    TextTable {
        name: "limits".to_owned(),
        title: "The first value at which answers are not right, and how".to_owned(),
        header,
        rows: rows.collect(),
    }
}

/// Returns the map of how far each method followed each family.
pub fn reach_map(survey: &Survey, journal: &Journal) -> HeatMap {
    let answers = Answers::of(journal);
    map(survey, HeatKind::Reach, |family, values, method| {
        let reach = answers.reach(values, family, method)?;
        let limit = reach.limit.map(|limit| format!("{:e}", limit.value));
        Some(HeatCell::Reach {
            worst: reach.worst,
            share: reach.share,
            limit: limit.unwrap_or_default(),
        })
    })
}

/// Returns the map of how the cost of each method grew over each family.
pub fn growth_map(survey: &Survey, journal: &Journal) -> HeatMap {
    // A query takes no step if a look at the whole bodies is enough.
    let cost = |cell: &Cell| {
        let key = (cell.scene.clone(), cell.method.clone());
        (key, 1.0 + cell.mean_steps)
    };
    let answered = journal.cells().iter().filter(|cell| cell.cut_off == 0);
    let costs: HashMap<(String, String), f64> = answered.map(cost).collect();
    map(survey, HeatKind::Growth, |family, values, method| {
        let costs = values.iter().filter_map(|&value| {
            let key = (step_name(family, value), method.to_owned());
            costs.get(&key).copied()
        });
        let costs: Vec<f64> = costs.collect();
        let [easiest, _, ..] = costs[..] else {
            return None;
        };
        let most = costs.iter().copied().fold(0.0, greater);
        // Some methods count no steps.
        (most > 1.0).then_some(HeatCell::Growth(most / easiest))
    })
}

/// Makes a map, with a function of the family, its values, and the method.
fn map(
    survey: &Survey,
    kind: HeatKind,
    cell: impl Fn(&Family, &[f64], &str) -> Option<HeatCell>,
) -> HeatMap {
    let methods: Vec<String> = survey.methods.iter().map(ToString::to_string).collect();
    let row = |family: &Family| {
        let values = survey.extent.values(family);
        HeatRow {
            name: family.name.to_owned(),
            parameter: family.parameter.to_owned(),
            cells: methods
                .iter()
                .map(|method| cell(family, &values, method))
                .collect(),
        }
    };
    HeatMap {
        kind,
        rows: survey.families.iter().map(row).collect(),
        methods,
    }
}
