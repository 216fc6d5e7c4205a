//! The choice of schedule and oracle at run time.

use ccd_core::Bound;
use ccd_core::schedule::{BestFirst, Fast, Naive};
use ccd_core::{Answer, DistanceOracle, OrElse, Problem, Schedule};
use ccd_distance_gjk::{Direct, Gjk};
use ccd_distance_vmarch::Vmarch;
use clap::ValueEnum;
use std::fmt;

/// A schedule with an oracle: what queries are answered by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SolverKind {
    /// In which order pairs are looked at.
    pub schedule: ScheduleKind,
    /// Who measures the distance of two pieces.
    pub oracle: OracleKind,
    /// For the schedules that [use one](ScheduleKind::uses_a_bound).
    pub bound: BoundKind,
}

/// The schedules there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum ScheduleKind {
    /// The pair whose proof expires first is looked at next.
    #[default]
    BestFirst,
    /// As published: one step for all pairs at which the distance query over hull trees stops.
    Fast,
    /// All pairs of pieces, one step for all: slow, for comparison on small meshes.
    Naive,
}

/// How a schedule that takes one step for all bounds the bodies' advance over it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum BoundKind {
    /// Holds however far they turn.
    #[default]
    Sound,
    /// As the paper prints it: times may be late, and contacts missed.
    Published,
}

impl From<BoundKind> for Bound {
    fn from(kind: BoundKind) -> Self {
        match kind {
            BoundKind::Sound => Bound::Sound,
            BoundKind::Published => Bound::Published,
        }
    }
}

impl ScheduleKind {
    /// Whether it is of use only for bodies with a [hull tree](ccd_core::Body::hull_tree).
    pub fn uses_hull_trees(self) -> bool {
        match self {
            ScheduleKind::Fast => true,
            ScheduleKind::BestFirst | ScheduleKind::Naive => false,
        }
    }

    /// Whether it takes one step for all pairs, which a [bound](BoundKind) is chosen for.
    pub fn uses_a_bound(self) -> bool {
        match self {
            ScheduleKind::Fast | ScheduleKind::Naive => true,
            ScheduleKind::BestFirst => false,
        }
    }
}

/// The oracles there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum OracleKind {
    /// Closed forms for points, segments and triangles; pieces of more points (a box) go to gjk.
    #[default]
    Direct,
    /// GJK in double precision, for any convex piece.
    Gjk,
    /// Voronoi marching, as published; where that gives up, gjk.
    Vmarch,
}

/// Answers queries one after another, keeping its memory in between.
pub trait Solve: Send {
    /// As [`Schedule::solve`].
    fn solve(&mut self, problem: &Problem<'_>) -> Answer;
}

impl SolverKind {
    /// All combinations that are never late.
    pub fn all() -> impl Iterator<Item = SolverKind> {
        ScheduleKind::value_variants().iter().flat_map(|&schedule| {
            OracleKind::value_variants()
                .iter()
                .map(move |&oracle| SolverKind {
                    schedule,
                    oracle,
                    bound: BoundKind::Sound,
                })
        })
    }

    /// A solver with memory of its own.
    pub fn solver(self) -> Box<dyn Solve> {
        match self.oracle {
            OracleKind::Direct => self.with_oracle::<Direct>(),
            OracleKind::Gjk => self.with_oracle::<Gjk>(),
            OracleKind::Vmarch => self.with_oracle::<OrElse<Vmarch, Gjk>>(),
        }
    }

    fn with_oracle<O>(self) -> Box<dyn Solve>
    where
        O: DistanceOracle + Default + Send + 'static,
        O::Cache: Send,
    {
        let oracle = O::default();
        match self.schedule {
            ScheduleKind::BestFirst => Box::new(Pairing {
                schedule: BestFirst::<O>::default(),
                oracle,
            }),
            ScheduleKind::Fast => Box::new(Pairing {
                schedule: Fast::<O>::new(self.bound.into()),
                oracle,
            }),
            ScheduleKind::Naive => Box::new(Pairing {
                schedule: Naive::<O>::new(self.bound.into()),
                oracle,
            }),
        }
    }
}

struct Pairing<S, O> {
    schedule: S,
    oracle: O,
}

impl<O, S> Solve for Pairing<S, O>
where
    O: DistanceOracle + Send,
    S: Schedule<O> + Send,
{
    fn solve(&mut self, problem: &Problem<'_>) -> Answer {
        self.schedule.solve(problem, &mut self.oracle)
    }
}

impl fmt::Display for ScheduleKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_value(self, f)
    }
}

impl fmt::Display for BoundKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_value(self, f)
    }
}

impl fmt::Display for OracleKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_value(self, f)
    }
}

/// The name that the command line knows a value by.
fn write_value(value: &impl ValueEnum, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match value.to_possible_value() {
        Some(value) => f.pad(value.get_name()),
        None => Ok(()),
    }
}
