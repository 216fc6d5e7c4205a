//! Runs methods on all scenes of the families, each in a process that can be stopped, and records the answers in a
//! journal.

use super::family::{Family, FamilyScene};
use super::judge::judge;
use crate::method::Method;
use crate::method::guarded::{GuardedMethod, GuardedMethodSettings, MethodPrograms, QueryOutcome};
use crate::method::rival::are_screw_motions;
use crate::run::contest::{Journal, Judgement, Verdict, program_fingerprint, summarise_trials};
use crate::run::measured::Trial;
use crate::truth::{Surface, TruthSolver};
use anyhow::{Context, Result};
use rayon::prelude::*;
use rigid_ccd_cli::{Progress, TotalWork};
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// The plan of a survey: which families are put to which methods, and where the answers are stored.
#[derive(Clone, Debug)]
pub struct Survey {
    /// The families whose scenes are put to the methods.
    pub families: Vec<Family>,
    /// The methods whose answers are judged.
    pub methods: Vec<Method>,
    /// True to use all parameter values of a family; false to use only the easiest, the middle and the hardest value.
    pub full: bool,
    /// The programs that run the methods.
    pub programs: MethodPrograms,
    /// The folder that contains the journal, from which an interrupted survey is resumed.
    pub folder: PathBuf,
}

/// The time that a method may take for one query.
const QUERY_TIME_LIMIT: Duration = Duration::from_secs(3);

/// The time that a method may take to prepare the bodies of a scene.
const PREPARATION_TIME_LIMIT: Duration = Duration::from_secs(20);

/// The number of consecutive scenes at which a method must exceed a time limit before its harder scenes are skipped.
const TIMEOUTS_BEFORE_SKIPPING: usize = 2;

/// Returns the name of a scene in the tables: the family and the parameter value.
pub(super) fn scene_name(family: &Family, value: f64) -> String {
    format!("{} {value:e}", family.name)
}

impl Survey {
    /// Runs the scenes whose answers the journal in the folder does not have yet, and returns the journal.
    ///
    /// # Errors
    /// If a scene cannot be made, a method cannot be started, or the journal cannot be kept; earlier answers are kept.
    pub fn run(&self) -> Result<Journal> {
        for &method in &self.methods {
            self.programs.check_script_starts(method)?;
        }
        let journal = Mutex::new(Journal::open(&self.folder, &fingerprint())?);
        let scenes = self.families.iter().map(|f| self.selected_values(f).len());
        let scenes: usize = scenes.sum();
        let progress = Progress::new(TotalWork::Steps(scenes * self.methods.len()));
        let families = self.families.par_iter();
        families.try_for_each(|family| self.run_family_queries(family, &journal, &progress))?;
        drop(progress);
        Ok(journal.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns the parameter values of a family that the survey uses.
    fn selected_values(&self, family: &Family) -> Vec<f64> {
        let all = &family.parameter_values;
        if self.full {
            return all.clone();
        }
        let mut rows = vec![0, all.len() / 2, all.len() - 1];
        rows.dedup();
        rows.into_iter().map(|row| all[row]).collect()
    }

    fn run_family_queries(
        &self,
        family: &Family,
        journal: &Mutex<Journal>,
        progress: &Progress,
    ) -> Result<()> {
        let mut stopped = vec![0; self.methods.len()];
        for value in self.selected_values(family) {
            let name = scene_name(family, value);
            let scene = (family.make_scene)(value).with_context(|| name.clone())?;
            let ready = PreparedFamilyScene {
                scene: &scene,
                name: &name,
                body_surfaces: scene.meshes.each_ref().map(Surface::new),
            };
            for (&method, stopped) in self.methods.iter().zip(&mut stopped) {
                progress.set_message(&format!("{name}: {method}"));
                progress.step();
                let locked = || journal.lock().unwrap_or_else(PoisonError::into_inner);
                let known = locked().has_cell(&name, &method.to_string(), scene.tolerance);
                if *stopped >= TIMEOUTS_BEFORE_SKIPPING || known {
                    continue;
                }
                let trials = ready.run_queries(method, &self.programs);
                let trials = trials.with_context(|| method.to_string())?;
                let cut_off = Verdict::CutOff.to_string();
                if trials.iter().any(|trial| trial.verdict == cut_off) {
                    *stopped += 1;
                } else {
                    *stopped = 0;
                }
                locked().add(summarise_trials(&trials), trials)?;
            }
        }
        Ok(())
    }
}

/// A scene of a family with its name, and its two meshes as surfaces for the exact reference answers.
struct PreparedFamilyScene<'s> {
    scene: &'s FamilyScene,
    name: &'s str,
    body_surfaces: [Surface; 2],
}

impl PreparedFamilyScene<'_> {
    /// Runs a method on all queries of the scene; stops after the first query that exceeds the time limit.
    fn run_queries(&self, method: Method, programs: &MethodPrograms) -> io::Result<Vec<Trial>> {
        let scene = self.scene;
        let setting = GuardedMethodSettings {
            margin: scene.margin,
            preparation_limit: PREPARATION_TIME_LIMIT,
            ..GuardedMethodSettings::new(method, scene.tolerance)
        };
        let name = method.to_string();
        let trial = |row: usize, outcome: &QueryOutcome, judged: (Judgement, String)| {
            Trial::new(
                (self.name, &name, scene.tolerance),
                (row, &row.to_string()),
                (outcome, QUERY_TIME_LIMIT),
                judged,
            )
        };
        let mut guarded = match GuardedMethod::start(programs, setting, scene.meshes.each_ref()) {
            Ok(guarded) => guarded,
            Err(error) => {
                let note = error.to_string();
                let judged = (judge_failed_start(error)?, note);
                return Ok(vec![trial(0, &QueryOutcome::Crashed, judged)]);
            }
        };
        let [a, b] = &self.body_surfaces;
        let mut trials = Vec::new();
        for (row, case) in scene.cases.iter().enumerate() {
            if method.moves_along_screws() && !are_screw_motions(&case.query) {
                let refused = Judgement::without_time_error(Verdict::Refused);
                let note = "bodies move along screws only".to_owned();
                trials.push(trial(row, &QueryOutcome::Crashed, (refused, note)));
                continue;
            }
            let outcome = guarded.run_query(&case.query, QUERY_TIME_LIMIT)?;
            let judged = judge(scene, case, &TruthSolver::new(a, b), &outcome);
            trials.push(trial(row, &outcome, (judged, self.reply_remark(&outcome))));
            if outcome == QueryOutcome::CutOff {
                break;
            }
        }
        Ok(trials)
    }

    /// Returns the method's remark about its answer, such as a raised tolerance; empty if there is none.
    fn reply_remark(&self, outcome: &QueryOutcome) -> String {
        let Some(reply) = outcome.reply() else {
            return String::new();
        };
        let raised = reply
            .tolerance
            .filter(|tolerance| *tolerance > self.scene.tolerance);
        let raised = raised.map(|tolerance| format!("tolerance raised to {tolerance:e}"));
        let parts: Vec<String> = reply.reason.clone().into_iter().chain(raised).collect();
        parts.join("; ")
    }
}

/// Judges a method that could not be started or that ended before its first query.
fn judge_failed_start(error: io::Error) -> io::Result<Judgement> {
    Ok(Judgement::without_time_error(match error.kind() {
        io::ErrorKind::Unsupported => Verdict::Refused,
        io::ErrorKind::TimedOut => Verdict::CutOff,
        io::ErrorKind::Other => Verdict::Crashed,
        _ => return Err(error),
    }))
}

/// Returns a text that identifies this program and the limits of its measurements. A survey is resumed in a folder only
/// if the text stored there is the same.
fn fingerprint() -> String {
    let program = program_fingerprint();
    format!("{program}patience {QUERY_TIME_LIMIT:?} {PREPARATION_TIME_LIMIT:?}\n")
}
