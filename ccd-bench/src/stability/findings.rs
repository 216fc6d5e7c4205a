//! Finds, for each family and method of a survey, the worst answers and the first wrong one.

use super::family::Family;
use super::survey::scene_name;
use crate::method::Method;
use crate::run::contest::{Journal, Verdict};
use clap::ValueEnum;
use std::collections::{HashMap, HashSet};

/// The worst verdicts of a survey, looked up by family and method.
#[derive(Debug)]
pub struct Findings<'j> {
    /// The families with answers in the journal, each with only the parameter values that have answers.
    pub(super) families: Vec<Family>,
    /// The methods with answers in the journal.
    pub(super) methods: Vec<Method>,
    pub(super) journal: &'j Journal,
    /// The worst verdict on a method's answers at one step of a family, by the step's scene name and the method's name.
    worst_verdicts: HashMap<(&'j str, &'j str), Verdict>,
}

/// A value of a family's parameter, and the worst verdict on a method's answers at that step.
pub(super) type StepVerdict = (f64, Verdict);

/// How many steps of a family a method solves, from the easiest, and where it first fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SolvedRange {
    /// The fraction of the family's steps, from the easiest, before the first wrong answer.
    pub(super) solved_fraction: f64,
    /// The easiest step with a wrong answer; `None` if all answers are right.
    pub(super) first_failure: Option<StepVerdict>,
    /// The easiest step that has the method's worst verdict in the family; `None` if all answers are right.
    pub(super) first_worst_verdict: Option<StepVerdict>,
}

impl<'j> Findings<'j> {
    /// Collects the worst verdicts in a journal; families, parameter values and methods without answers are left out.
    pub fn new(families: Vec<Family>, methods: Vec<Method>, journal: &'j Journal) -> Self {
        let mut worst = HashMap::new();
        for trial in journal.trials() {
            let verdict = Verdict::from_str(&trial.verdict, false).unwrap_or(Verdict::CutOff);
            let so_far = worst.entry((trial.scene.as_str(), trial.method.as_str()));
            let so_far = so_far.or_insert(verdict);
            *so_far = verdict.max(*so_far);
        }
        let (steps, asked): (HashSet<&str>, HashSet<&str>) = worst.keys().copied().unzip();
        let asked_about = |mut family: Family| {
            let name = |value: f64| scene_name(&family, value);
            let values = family.parameter_values.iter().copied();
            family.parameter_values = values
                .filter(|&v| steps.contains(name(v).as_str()))
                .collect();
            (!family.parameter_values.is_empty()).then_some(family)
        };
        let was_asked = |method: &Method| asked.contains(method.to_string().as_str());
        Findings {
            families: families.into_iter().filter_map(asked_about).collect(),
            methods: methods.into_iter().filter(was_asked).collect(),
            journal,
            worst_verdicts: worst,
        }
    }

    /// Returns true if the journal has no answers to any of the families by any of the methods.
    pub fn is_empty(&self) -> bool {
        self.families.is_empty() || self.methods.is_empty()
    }

    /// Returns the fraction of a family's steps that a method solves, from the easiest step on, and its first failure.
    /// Returns `None` if the journal has no answers of the method to the family.
    pub(super) fn solved_range(&self, family: &Family, method: &str) -> Option<SolvedRange> {
        let answer = |&value: &f64| {
            let step = scene_name(family, value);
            Some((value, *self.worst_verdicts.get(&(step.as_str(), method))?))
        };
        let asked: Vec<StepVerdict> = family.parameter_values.iter().filter_map(answer).collect();
        let most = asked.iter().map(|&(_, verdict)| verdict).max()?;
        let is_right = |asked: &&StepVerdict| asked.1 == Verdict::Right;
        let right = asked.iter().take_while(is_right).count();
        let worst = asked.iter().find(|step| step.1 == most && !is_right(step));
        Some(SolvedRange {
            solved_fraction: right as f64 / family.parameter_values.len() as f64,
            first_failure: asked.get(right).copied(),
            first_worst_verdict: worst.copied(),
        })
    }
}
