//! Calls a check for every backend, schedule and kind of piece.

use crate::models::PieceKind;
use crate::query::{Bodies, Query};
use ccd_core::schedule::{BestFirst, Fast, Naive};
use ccd_core::{Answer, Body, DistanceOracle, Schedule, Settings};
use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
use ccd_distance_vmarch::Vmarch;

/// The schedule of a backend, which orders the pairs of pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScheduleKind {
    /// Takes pairs from a queue in the order of the times until which they are proven apart.
    BestFirst,
    /// Advances all pairs together in each step, over the front of a descent through hull trees.
    Fast,
    /// Advances all pairs of pieces together in each step, without trees.
    Naive,
}

/// The algorithm by which a backend computes the distance of two pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OracleKind {
    /// Uses closed forms, for pieces of at most three points.
    ClosedForm,
    /// Uses GJK in f64.
    Gjk,
    /// Uses closed forms where there are any, and GJK for the other pairs of pieces.
    Direct,
    /// Uses Voronoi marching, and GJK if the marching gives up.
    Vmarch,
}

impl OracleKind {
    /// Returns true if the oracle supports all pieces of both bodies.
    pub fn supports(self, bodies: &Bodies) -> bool {
        let small = |body: &Body| body.pieces().iter().all(|piece| piece.points.len() <= 3);
        self != OracleKind::ClosedForm || small(bodies.a()) && small(bodies.b())
    }
}

/// A schedule with a distance oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Backend {
    /// The schedule, which orders the pairs of pieces.
    pub schedule: ScheduleKind,
    /// The oracle, which computes the distances of pieces.
    pub oracle: OracleKind,
}

/// The backend and the kinds of pieces that gave an answer. It is printed if an assertion fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BackendSetup {
    /// The backend that gave the answer.
    pub backend: Backend,
    /// The kinds of pieces of bodies A and B.
    pub piece_kinds: [PieceKind; 2],
}

/// The largest number of pairs of pieces for which the naive schedule is tested.
const MAX_NAIVE_PAIRS: usize = 400;

impl Backend {
    /// The backend that the engine uses by default.
    pub const DEFAULT: Backend = Backend {
        schedule: ScheduleKind::BestFirst,
        oracle: OracleKind::Direct,
    };

    /// Returns every combination of a schedule and an oracle.
    pub fn all() -> impl Iterator<Item = Backend> {
        use OracleKind::{ClosedForm, Direct, Gjk, Vmarch};
        let oracles = [ClosedForm, Gjk, Direct, Vmarch];
        let orders = [
            ScheduleKind::BestFirst,
            ScheduleKind::Fast,
            ScheduleKind::Naive,
        ];
        orders.into_iter().flat_map(move |order| {
            oracles.map(|oracle| Backend {
                schedule: order,
                oracle,
            })
        })
    }

    /// Returns true if the backend supports the bodies and is fast enough for them in a test.
    pub fn suits_bodies(self, bodies: &Bodies) -> bool {
        let fit = match self.schedule {
            ScheduleKind::BestFirst => true,
            // Without trees, the answer would be that of another schedule.
            ScheduleKind::Fast => {
                bodies.piece_pair_count() > 1
                    && [bodies.a(), bodies.b()].iter().all(has_tree_or_one_piece)
            }
            ScheduleKind::Naive => bodies.piece_pair_count() <= MAX_NAIVE_PAIRS,
        };
        fit && self.oracle.supports(bodies)
    }

    /// Answers a query with a fresh schedule and a fresh oracle.
    pub fn solve(self, problem: &ccd_core::Query<'_>) -> Answer {
        match self.oracle {
            OracleKind::ClosedForm => self.solve_with(problem, &mut ClosedForm::default()),
            OracleKind::Gjk => self.solve_with(problem, &mut Gjk),
            OracleKind::Direct => self.solve_with(problem, &mut Direct::default()),
            OracleKind::Vmarch => self.solve_with(problem, &mut Vmarch::default().or_else(Gjk)),
        }
    }

    /// Answers a query with the backend's schedule and a given oracle.
    pub fn solve_with<O: DistanceOracle>(
        self,
        problem: &ccd_core::Query<'_>,
        oracle: &mut O,
    ) -> Answer {
        match self.schedule {
            ScheduleKind::BestFirst => BestFirst::<O>::default()
                .first_contact(problem, oracle)
                .unwrap(),
            ScheduleKind::Fast => Fast::<O>::default().first_contact(problem, oracle).unwrap(),
            ScheduleKind::Naive => Naive::<O>::default()
                .first_contact(problem, oracle)
                .unwrap(),
        }
    }
}

fn has_tree_or_one_piece(body: &&Body) -> bool {
    body.pieces().len() == 1 || body.hull_tree().is_some()
}

/// Calls `check` with the answer of every suitable backend, for all kinds of pieces of the query's shapes.
pub fn for_each_setup(
    query: &Query,
    config: &Settings,
    mut check: impl FnMut(&Bodies, BackendSetup, Answer),
) {
    for bodies in query.bodies_of_kind_pairs() {
        let problem = query.problem(&bodies, config);
        for backend in Backend::all().filter(|backend| backend.suits_bodies(&bodies)) {
            let setup = BackendSetup {
                backend,
                piece_kinds: bodies.piece_kinds,
            };
            check(&bodies, setup, backend.solve(&problem));
        }
    }
}

/// Returns the answer of the default backend to a query, with both bodies made of triangles.
pub fn default_backend_answer(query: &Query, config: &Settings) -> Answer {
    let bodies = query.bodies_of_triangles();
    Backend::DEFAULT.solve(&query.problem(&bodies, config))
}
