//! Counts the outcomes of trials.

use crate::judge::Fault;
use crate::trial::{Failure, Trial};
use ccd_core::Outcome;
use ccd_core::Unresolved;
use std::collections::BTreeMap;
use std::fmt;

#[derive(Default)]
pub struct Tally {
    query_count: u64,
    answer_count: u64,
    answer_counts_by_method: BTreeMap<String, u64>,
    /// The number of answers by status, for the default method.
    status_counts: BTreeMap<String, u64>,
    /// The number of unresolved answers by reason, for all methods.
    unresolved_counts: BTreeMap<String, u64>,
    /// The number of the first query that stayed unresolved for each reason.
    first_unresolved_by_reason: BTreeMap<String, u64>,
    refusal_counts: BTreeMap<String, u64>,
    fault_counts: BTreeMap<Fault, u64>,
    /// The number of queries for which the referee's search was not complete.
    incomplete_search_count: u64,
}

impl Tally {
    /// Counts the outcome of a trial. Returns its failures that are among the first of their kind.
    pub fn add<'t>(&mut self, number: u64, trial: &'t Trial, print: usize) -> Vec<&'t Failure> {
        self.query_count += 1;
        self.answer_count += trial.outcomes.len() as u64;
        self.incomplete_search_count += u64::from(!trial.is_search_complete);
        for (kind, method) in &trial.methods {
            *self
                .answer_counts_by_method
                .entry(format!("{kind} {method}"))
                .or_default() += 1;
        }
        if let Some(outcome) = trial.outcomes.first() {
            *self
                .status_counts
                .entry(status(outcome).to_owned())
                .or_default() += 1;
        }
        for (outcome, (kind, method)) in trial.outcomes.iter().zip(&trial.methods) {
            if let Outcome::Unresolved(Unresolved { limit: reason, .. }) = outcome {
                self.first_unresolved_by_reason
                    .entry(format!("{reason:?}"))
                    .or_insert(number);
                let entry = format!("{reason:?} {kind} {method}");
                *self.unresolved_counts.entry(entry).or_default() += 1;
            }
        }
        if let Some(why) = &trial.refusal_reason {
            let words: Vec<&str> = why
                .split(' ')
                .filter(|w| !w.contains(|c: char| c.is_numeric()))
                .collect();
            *self.refusal_counts.entry(words.join(" ")).or_default() += 1;
        }
        let mut first = Vec::new();
        for failure in &trial.failures {
            let count = self.fault_counts.entry(failure.fault).or_default();
            *count += 1;
            if *count <= print as u64 {
                first.push(failure);
            }
        }
        first
    }

    pub fn has_failures(&self) -> bool {
        !self.fault_counts.is_empty()
    }

    fn fraction(&self, statuses: &[&str]) -> f64 {
        let count = statuses
            .iter()
            .filter_map(|&s| self.status_counts.get(s))
            .sum::<u64>();
        count as f64 / self.query_count as f64
    }

    /// Checks that contacts and free bodies each occur in at least 5 % of the queries.
    ///
    /// # Panics
    /// If almost no query has a contact, or almost all have one: then little is tested.
    pub fn assert_representative(&self) {
        let (hits, misses) = (self.fraction(&["contact"]), self.fraction(&["free"]));
        assert!(
            hits >= 0.05 && misses >= 0.05,
            "hits {hits}, misses {misses}"
        );
    }
}

fn status(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Contact { .. } => "contact",
        Outcome::Free { .. } => "free",
        Outcome::Touching { .. } => "touching",
        Outcome::Overlapping { .. } => "overlapping",
        Outcome::Unresolved(_) => "unresolved",
        Outcome::Interval { .. } | Outcome::LeastDistance { .. } => "not of a first contact",
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tally {
            query_count: queries,
            answer_count: answers,
            incomplete_search_count: sampled,
            ..
        } = self;
        writeln!(
            f,
            "{queries} queries, {answers} answers, {sampled} searched by samples"
        )?;
        let maps = [
            ("by the default", &self.status_counts),
            ("asked", &self.answer_counts_by_method),
            ("unresolved", &self.unresolved_counts),
            ("first query, for --only", &self.first_unresolved_by_reason),
            ("refused", &self.refusal_counts),
        ];
        for (name, map) in maps.into_iter().filter(|(_, map)| !map.is_empty()) {
            let all: Vec<String> = map.iter().map(|(k, n)| format!("{k}: {n}")).collect();
            writeln!(f, "  {name}: {}", all.join("; "))?;
        }
        if self.has_failures() {
            write!(f, "  FAULTS: {:?}", self.fault_counts)
        } else {
            write!(f, "  no fault")
        }
    }
}
