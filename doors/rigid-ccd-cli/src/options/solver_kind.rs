//! Solvers whose schedule, distance backend and motion bound are chosen at run time.

use ccd_core::schedule::{Fast, Naive};
use ccd_core::{Answer, Body, DistanceOracle, InputError, OrElse, Query, Schedule, VelocityBound};
use ccd_distance_gjk::{Direct, Gjk};
use ccd_distance_vmarch::Vmarch;
use clap::ValueEnum;
use rigid_ccd::{CachePadded, Question, Solver};
use std::fmt;

/// The schedule, the distance backend and the motion bound that a solver is made with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SolverKind {
    /// The order in which pairs of pieces are advanced in time.
    pub schedule: ScheduleKind,
    /// The backend that computes distances of pieces.
    pub oracle: OracleKind,
    /// The bound on the bodies' motion over a step, for the schedules that [use one](ScheduleKind::uses_velocity_bound).
    pub motion_bound: BoundKind,
}

/// The order in which a solver advances pairs of pieces in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum ScheduleKind {
    /// Advances the pair first whose proven separation ends first.
    #[default]
    BestFirst,
    /// FAST as published: descends the hull trees, then advances the pairs where the descent stops, all by one common
    /// time step.
    Fast,
    /// Advances all pairs of pieces together, by one step at a time: slow, for comparison on small bodies.
    Naive,
}

/// The bound on the closing velocity by which the schedules `fast` and `naive` divide a distance to get a time step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum BoundKind {
    /// The bound that holds for any rotation.
    #[default]
    Sound,
    /// The bound as published: times may be late, and contacts may be missed.
    Published,
}

impl From<BoundKind> for VelocityBound {
    fn from(kind: BoundKind) -> Self {
        match kind {
            BoundKind::Sound => VelocityBound::Sound,
            BoundKind::Published => VelocityBound::Published,
        }
    }
}

impl ScheduleKind {
    /// Returns whether the schedule makes use of a [hull tree](ccd_core::Body::hull_tree).
    pub fn uses_hull_trees(self) -> bool {
        self == ScheduleKind::Fast
    }

    /// Returns whether the schedule advances all pairs by one common step, for which it uses a [bound](BoundKind).
    pub fn uses_velocity_bound(self) -> bool {
        self != ScheduleKind::BestFirst
    }
}

/// The backend that computes the distance of two convex pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum OracleKind {
    /// Closed forms for points, segments and triangles; `gjk` for pieces of more points, such as boxes.
    #[default]
    Direct,
    /// GJK in double precision, for any convex piece.
    Gjk,
    /// Voronoi marching, as published; `gjk` where it gives up.
    Vmarch,
}

/// A solver of queries that reuses its memory from query to query.
pub trait Solve: Send {
    /// Answers a question about two bodies; `None` if the schedule cannot answer this question. Every schedule can find
    /// the first contact.
    fn answer(
        &mut self,
        question: Question,
        query: &Query<'_>,
    ) -> Option<Result<Answer, InputError>>;
}

impl SolverKind {
    /// Creates a solver of this kind.
    pub fn solver(self) -> Box<dyn Solve> {
        match self.oracle {
            OracleKind::Direct => self.solver_with_oracle(Direct::default()),
            OracleKind::Gjk => self.solver_with_oracle(Gjk),
            OracleKind::Vmarch => self.solver_with_oracle(Vmarch::default().or_else(Gjk)),
        }
    }

    /// Prepares a body for the distance backend, so that the body's first query is as fast as later ones.
    pub fn prepare_body(self, body: &Body) {
        match self.oracle {
            OracleKind::Direct => Direct::prepare(body),
            OracleKind::Gjk => Gjk::prepare(body),
            OracleKind::Vmarch => OrElse::<Vmarch, Gjk>::prepare(body),
        }
    }

    fn solver_with_oracle<O>(self, oracle: O) -> Box<dyn Solve>
    where
        O: DistanceOracle + Send + 'static,
        O::Cache: Send,
    {
        match self.schedule {
            ScheduleKind::BestFirst => Box::new(CachePadded(Solver::with_oracle(oracle))),
            ScheduleKind::Fast => Box::new(CachePadded((
                Fast::<O>::new(self.motion_bound.into()),
                oracle,
            ))),
            ScheduleKind::Naive => Box::new(CachePadded((
                Naive::<O>::new(self.motion_bound.into()),
                oracle,
            ))),
        }
    }
}

impl<O> Solve for CachePadded<Solver<O>>
where
    O: DistanceOracle + Send,
    O::Cache: Send,
{
    fn answer(
        &mut self,
        question: Question,
        query: &Query<'_>,
    ) -> Option<Result<Answer, InputError>> {
        Some(self.0.answer_query(question, query))
    }
}

/// A schedule with its oracle answers only the question about the first contact.
impl<S, O> Solve for CachePadded<(S, O)>
where
    S: Schedule<O> + Send,
    O: DistanceOracle + Send,
{
    fn answer(
        &mut self,
        question: Question,
        query: &Query<'_>,
    ) -> Option<Result<Answer, InputError>> {
        let (schedule, oracle) = &mut self.0;
        (question == Question::FirstContact).then(|| schedule.first_contact(query, oracle))
    }
}

/// Displays values by their names on the command line.
macro_rules! display_option_name {
    ($($kind:ty),*) => {$(
        impl fmt::Display for $kind {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let value = self.to_possible_value();
                value.map_or(Ok(()), |value| f.pad(value.get_name()))
            }
        }
    )*};
}

display_option_name!(ScheduleKind, BoundKind, OracleKind);

#[cfg(test)]
mod tests;
