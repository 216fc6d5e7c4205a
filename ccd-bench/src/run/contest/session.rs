//! A method that is ready for queries about a scene.

use super::MAX_PAIRS_FOR_NAIVE_SCHEDULE;
use crate::method::guarded::{GuardedMethod, GuardedMethodSettings, MethodPrograms, QueryOutcome};
use crate::method::solver::{Solver, answer_timed};
use crate::method::{Method, PAPER_TOLERANCE, ProjectSolver};
use crate::scene::Scene;
use ccd_core::Settings;
use ccd_tables::motions::Motions;
use rigid_ccd_cli::ScheduleKind;
use std::io;
use std::time::{Duration, Instant};

/// A method that is prepared for queries about one scene, with the solver or the process that answers.
pub struct Session<'s> {
    method: Method,
    runner: Runner<'s>,
}

/// The solver of a session, in this process or in a separate one that can be stopped.
enum Runner<'s> {
    InProcess(Box<dyn Solver + 's>),
    SeparateProcess(Box<GuardedMethod>),
}

impl<'s> Session<'s> {
    /// Prepares a method for queries about a scene; `None` if the method does not support the scene.
    ///
    /// # Errors
    /// If a peer cannot be prepared.
    pub fn open(
        method: Method,
        scene: &'s Scene,
        programs: &MethodPrograms,
    ) -> io::Result<Option<Self>> {
        let runner = match method {
            Method::ThisProject(kind, pieces) => {
                let too_many = scene.piece_pair_count() > MAX_PAIRS_FOR_NAIVE_SCHEDULE;
                let suits = kind.schedule != ScheduleKind::Naive || !too_many;
                let Some(bodies) = scene.bodies_with_pieces(pieces).filter(|_| suits) else {
                    return Ok(None);
                };
                Runner::InProcess(Box::new(ProjectSolver::new(
                    kind,
                    bodies,
                    Settings::DEFAULT.margin,
                )))
            }
            Method::Rival(kind) => {
                let (a, b) = (scene.a.mesh(), scene.b.mesh());
                Runner::InProcess(kind.solver(a, b))
            }
            Method::Peer(_) | Method::Script(_) => {
                let meshes = [scene.a.mesh(), scene.b.mesh()];
                let setting = GuardedMethodSettings::new(method, PAPER_TOLERANCE);
                Runner::SeparateProcess(Box::new(GuardedMethod::new(programs, setting, meshes)?))
            }
        };
        Ok(Some(Session { method, runner }))
    }

    /// Returns the method that the session runs.
    pub fn method(&self) -> Method {
        self.method
    }

    /// Answers queries for a limited time before they are measured, if the solver prepares pieces on first use. Returns
    /// the number of prepared queries.
    pub(super) fn run_warm_up_queries<'q>(
        &mut self,
        queries: impl ExactSizeIterator<Item = &'q Motions>,
        tolerance: f64,
        time: Duration,
    ) -> usize {
        let start = Instant::now();
        match (&mut self.runner, self.method) {
            (Runner::InProcess(solver), Method::ThisProject(kind, _))
                if kind.schedule.uses_hull_trees() =>
            {
                let prepared = queries.take_while(|_| start.elapsed() < time);
                prepared
                    .map(|query| solver.answer(query, tolerance))
                    .count()
            }
            _ => queries.len(),
        }
    }

    /// Runs one query, with a time limit for methods in a separate process.
    ///
    /// # Errors
    /// If a peer's process does not restart.
    pub(super) fn ask(
        &mut self,
        query: &Motions,
        tolerance: f64,
        patience: Duration,
    ) -> io::Result<QueryOutcome> {
        match &mut self.runner {
            Runner::InProcess(solver) => {
                let timed = answer_timed(solver.as_mut(), query, tolerance);
                Ok(QueryOutcome::Answered(timed))
            }
            Runner::SeparateProcess(guarded) => {
                guarded.set_tolerance(tolerance);
                guarded.run_query(query, patience)
            }
        }
    }
}
