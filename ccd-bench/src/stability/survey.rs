//! Runs methods on all steps of families, each in a process that can be stopped, and records the answers in a journal.

use super::family::{Family, Step, StepError};
use super::judge::judge;
use crate::method::guarded::{Guarded, Programs, QueryOutcome, Setting};
use crate::method::rival::is_screw;
use crate::method::solver::{Claim, Reply};
use crate::method::{Method, MotionKind};
use crate::run::contest::{Journal, JournalError, Judged, Verdict, program_stamp, sum_up};
use crate::run::measured::Trial;
use crate::truth::{Referee, Surface};
use rayon::prelude::*;
use rigid_ccd::command::{Progress, Total};
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// The plan of a survey.
#[derive(Clone, Debug)]
pub struct Survey {
    /// The families.
    pub families: Vec<Family>,
    /// The methods.
    pub methods: Vec<Method>,
    /// The extent of each family.
    pub extent: Extent,
    /// The programs that run the methods.
    pub programs: Programs,
    /// The folder of the journal.
    pub folder: PathBuf,
}

/// The extent of a survey within each family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The easiest value, the hardest, and one between.
    Quick,
    /// All values.
    Full,
}

/// A survey ended early.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SurveyError {
    /// A scene cannot be made.
    #[error("{family} at {value:e}: {source}")]
    Step {
        /// The family.
        family: &'static str,
        /// The value.
        value: f64,
        /// The cause.
        source: StepError,
    },
    /// A method's process cannot be started.
    #[error("{method}: {source}")]
    Start {
        /// The method.
        method: String,
        /// The cause.
        source: io::Error,
    },
    /// The journal cannot be kept.
    #[error(transparent)]
    Journal(#[from] JournalError),
}

/// The time limit of one query.
const PATIENCE: Duration = Duration::from_secs(3);

/// The time limit for preparing the bodies of a step.
const PREPARATION: Duration = Duration::from_secs(20);

/// The number of consecutive steps at which a method is stopped before its harder steps are skipped.
const CHANCES: usize = 2;

impl Extent {
    /// Returns the values of a family to survey.
    fn values(self, family: &Family) -> Vec<f64> {
        let all = &family.values;
        match self {
            Extent::Full => all.clone(),
            Extent::Quick => {
                let mut rows = vec![0, all.len() / 2, all.len() - 1];
                rows.dedup();
                rows.into_iter().map(|row| all[row]).collect()
            }
        }
    }
}

/// Returns the name of a step in the tables.
pub(super) fn step_name(family: &Family, value: f64) -> String {
    format!("{} {value:e}", family.name)
}

impl Survey {
    /// Runs the steps that the folder does not have yet.
    ///
    /// # Errors
    /// [`SurveyError`]; earlier answers are kept.
    pub fn run(&self) -> Result<Journal, SurveyError> {
        for &method in &self.methods {
            let started = self.programs.check(method);
            started.map_err(|source| SurveyError::Start {
                method: method.to_string(),
                source,
            })?;
        }
        let journal = Mutex::new(Journal::open(&self.folder, &stamp(), &[])?);
        let steps: usize = self
            .families
            .iter()
            .map(|f| self.extent.values(f).len())
            .sum();
        let progress = Progress::new(Total::Steps(steps * self.methods.len()));
        let asked: Result<(), SurveyError> = self
            .families
            .par_iter()
            .try_for_each(|family| self.ask_family(family, &journal, &progress));
        asked?;
        drop(progress);
        Ok(journal.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    fn ask_family(
        &self,
        family: &Family,
        journal: &Mutex<Journal>,
        progress: &Progress,
    ) -> Result<(), SurveyError> {
        let mut stopped = vec![0; self.methods.len()];
        for value in self.extent.values(family) {
            let failed = |source| SurveyError::Step {
                family: family.name,
                value,
                source,
            };
            let step = (family.make)(value).map_err(failed)?;
            let name = step_name(family, value);
            let ready = Ready::new(&step, &name);
            for (&method, stopped) in self.methods.iter().zip(&mut stopped) {
                progress.say(&format!("{name}: {method}"));
                progress.step();
                let locked = || journal.lock().unwrap_or_else(PoisonError::into_inner);
                let known = locked().has(&name, &method.to_string(), step.tolerance);
                if *stopped >= CHANCES || known {
                    continue;
                }
                let trials =
                    ready
                        .ask(method, &self.programs)
                        .map_err(|source| SurveyError::Start {
                            method: method.to_string(),
                            source,
                        })?;
                let cut_off = Verdict::CutOff.to_string();
                if trials.iter().any(|trial| trial.verdict == cut_off) {
                    *stopped += 1;
                } else {
                    *stopped = 0;
                }
                locked().add(sum_up(&trials), trials)?;
            }
        }
        Ok(())
    }
}

/// A step with its prepared meshes.
struct Ready<'s> {
    step: &'s Step,
    name: &'s str,
    surfaces: [Surface; 2],
}

impl<'s> Ready<'s> {
    fn new(step: &'s Step, name: &'s str) -> Self {
        let surfaces = step.meshes.each_ref().map(Surface::new);
        Ready {
            step,
            name,
            surfaces,
        }
    }

    /// Runs a method on all queries of the step, up to the first at which it is stopped.
    fn ask(&self, method: Method, programs: &Programs) -> io::Result<Vec<Trial>> {
        let step = self.step;
        let setting = Setting {
            margin: step.margin,
            preparation: PREPARATION,
            ..Setting::new(method, step.tolerance)
        };
        let mut guarded = match Guarded::start(programs, setting, step.meshes.each_ref()) {
            Ok(guarded) => guarded,
            Err(error) => {
                let note = error.to_string();
                let trial = self.trial(method, 0, &QueryOutcome::Died, not_started(error)?);
                return Ok(vec![Trial { note, ..trial }]);
            }
        };
        let [a, b] = &self.surfaces;
        let mut trials = Vec::new();
        for (row, case) in step.cases.iter().enumerate() {
            if method.motion_kind() == MotionKind::Screw && !is_screw(&case.query) {
                let trial = self.trial(
                    method,
                    row,
                    &QueryOutcome::Died,
                    Judged::plain(Verdict::Refused),
                );
                let note = "bodies move along screws only".to_owned();
                trials.push(Trial { note, ..trial });
                continue;
            }
            let outcome = guarded.ask(&case.query, PATIENCE)?;
            let judged = judge(step, case, &Referee::new(a, b), &outcome);
            trials.push(self.trial(method, row, &outcome, judged));
            if outcome == QueryOutcome::CutOff {
                break;
            }
        }
        Ok(trials)
    }

    fn trial(&self, method: Method, row: usize, outcome: &QueryOutcome, judged: Judged) -> Trial {
        let silent = Reply::new(Claim::Refused, 0);
        let (reply, micros) = match outcome {
            QueryOutcome::Answered { reply, micros } => (reply, *micros),
            QueryOutcome::CutOff => (&silent, PATIENCE.as_secs_f64() * 1e6),
            QueryOutcome::Died => (&silent, f64::NAN),
        };
        Trial {
            scene: self.name.to_owned(),
            method: method.to_string(),
            tolerance: self.step.tolerance,
            row,
            id: row.to_string(),
            micros,
            steps: reply.steps,
            verdict: judged.verdict.to_string(),
            error: judged.error.unwrap_or(f64::NAN),
            time: reply.claim.time().unwrap_or(f64::NAN),
            note: self.note(reply),
        }
    }

    /// Returns the method's remark about its answer.
    fn note(&self, reply: &Reply) -> String {
        let raised = reply
            .tolerance
            .filter(|tolerance| *tolerance > self.step.tolerance);
        let raised = raised.map(|tolerance| format!("tolerance raised to {tolerance:e}"));
        let parts: Vec<String> = reply.reason.clone().into_iter().chain(raised).collect();
        parts.join("; ")
    }
}

/// Judges a method that ends before its first query.
fn not_started(error: io::Error) -> io::Result<Judged> {
    Ok(Judged::plain(match error.kind() {
        io::ErrorKind::Unsupported => Verdict::Refused,
        io::ErrorKind::TimedOut => Verdict::CutOff,
        io::ErrorKind::Other => Verdict::Died,
        _ => return Err(error),
    }))
}

/// Describes the settings that determine all answers.
fn stamp() -> String {
    let program = program_stamp();
    format!("{program}patience {PATIENCE:?} {PREPARATION:?}\n")
}
