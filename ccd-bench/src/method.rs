//! The methods of the comparison, by name: this project's, published rivals built here, and peer libraries.

pub mod guarded;
pub mod peer;
pub mod rival;
pub mod script;
pub mod solver;
pub mod wire;

use crate::method::peer::PeerKind;
use crate::method::rival::{C2a, Contact, DynamicChecker, FixedTimeSteps};
use crate::method::script::ScriptMethod;
use crate::method::solver::{ContactClaim, Reply, Solver};
use crate::names::name_of;
use crate::scene::PieceKind;
use ccd_core::Answer;
use ccd_core::{InputError, Outcome, Settings};
use ccd_decomp::TriangleMesh;
use ccd_tables::batch::BodyPair;
use ccd_tables::motions::Motions;
use clap::ValueEnum;
use rigid_ccd::Question;
use rigid_ccd_cli::{BoundKind, OracleKind, ScheduleKind, Solve, SolverKind};
use std::fmt;

/// A method that answers queries: one of this project, a published one, or a library.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// A solver of this project, on bodies made of the given kind of pieces.
    ThisProject(SolverKind, PieceKind),
    /// A published method that is built here for comparison.
    Rival(RivalKind),
    /// A peer library that this program calls directly.
    Peer(PeerKind),
    /// A peer library that a script runs, since it has no Rust interface.
    Script(ScriptMethod),
}

/// The published methods that are built here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum RivalKind {
    /// The method CONTACT: tests of oriented boxes over intervals of time.
    #[value(name = "CONTACT")]
    Contact,
    /// The method of the dynamic collision checker: adaptive bisection of time.
    #[value(name = "Dynamic Collision Checker")]
    DynamicChecker,
    /// The method C2A: controlled conservative advancement.
    #[value(name = "C2A")]
    C2a,
    /// Static intersection tests at equal steps in time.
    #[value(name = "discrete stepping")]
    FixedTimeSteps,
}

/// The tolerance of the paper's benchmarks `[FAST06 §6.2]`, at which methods without a tolerance setting are measured.
pub const PAPER_TOLERANCE: f64 = 1e-3;

impl Method {
    /// Returns all methods that this program runs itself, this project's default first.
    pub fn built_in_methods() -> Vec<Method> {
        let kind = |schedule, oracle| SolverKind {
            schedule,
            oracle,
            motion_bound: BoundKind::Sound,
        };
        let (best, fast) = (ScheduleKind::BestFirst, ScheduleKind::Fast);
        let ours = [
            (kind(best, OracleKind::Direct), PieceKind::FewestPieces),
            (kind(best, OracleKind::Gjk), PieceKind::FewestPieces),
            (kind(fast, OracleKind::Vmarch), PieceKind::Patches),
            (kind(fast, OracleKind::Gjk), PieceKind::Patches),
            (
                kind(ScheduleKind::Naive, OracleKind::Direct),
                PieceKind::FewestPieces,
            ),
            (kind(best, OracleKind::Direct), PieceKind::Triangles),
            (kind(best, OracleKind::Direct), PieceKind::Patches),
        ];
        let ours = ours.map(|(kind, pieces)| Method::ThisProject(kind, pieces));
        let (rivals, peers) = (
            methods_of_all_variants(Method::Rival),
            methods_of_all_variants(Method::Peer),
        );
        ours.into_iter().chain(rivals).chain(peers).collect()
    }

    /// Returns every method that has a name, including FAST as published and those that a script runs. The bound of
    /// FAST as published does not hold over a step, so that its answers may be late.
    pub fn known_methods() -> Vec<Method> {
        let published = SolverKind {
            schedule: ScheduleKind::Fast,
            oracle: OracleKind::Vmarch,
            motion_bound: BoundKind::Published,
        };
        let mut methods = Method::built_in_methods();
        // After its variants with a sound bound.
        let is_fast = |method: &Method| matches!(method, Method::ThisProject(kind, _) if kind.schedule == ScheduleKind::Fast);
        let last = methods.iter().rposition(is_fast).map_or(0, |last| last + 1);
        methods.insert(last, Method::ThisProject(published, PieceKind::Patches));
        methods.extend(Method::script_methods());
        methods
    }

    /// Returns all methods that a script runs.
    pub fn script_methods() -> impl Iterator<Item = Method> {
        methods_of_all_variants(Method::Script)
    }

    /// Returns the method with the given name; `None` if there is none.
    pub fn from_name(name: &str) -> Option<Method> {
        let mut known = Method::known_methods().into_iter();
        known.find(|method| method.to_string() == name)
    }

    /// Returns true if the method is measured at every tolerance. Methods whose answers do not depend on
    /// the tolerance are not, nor are models of the bodies that are only compared with each other.
    pub fn runs_at_all_tolerances(self) -> bool {
        match self {
            Method::ThisProject(..) => !self.has_non_default_pieces(),
            Method::Rival(_) => true,
            Method::Peer(kind) => kind.takes_tolerance(),
            Method::Script(kind) => kind != ScriptMethod::CoalDistance,
        }
    }

    /// Returns whether the method is this project's own on triangles or patches, which are not its default pieces.
    pub fn has_non_default_pieces(self) -> bool {
        matches!(self, Method::ThisProject(kind, pieces)
            if pieces != PieceKind::FewestPieces && !kind.schedule.uses_hull_trees())
    }

    /// Returns whether the method moves the bodies along screws between the start and end poses of a query, instead of
    /// along the query's motions.
    pub fn moves_along_screws(self) -> bool {
        self == Method::Rival(RivalKind::Contact)
    }
}

fn methods_of_all_variants<K: ValueEnum + 'static>(
    method: fn(K) -> Method,
) -> impl Iterator<Item = Method> {
    K::value_variants().iter().cloned().map(method)
}

impl RivalKind {
    /// Returns a solver that runs this method on two meshes.
    pub fn solver(self, a: &TriangleMesh, b: &TriangleMesh) -> Box<dyn Solver> {
        match self {
            RivalKind::Contact => Box::new(Contact::new(a, b)),
            RivalKind::DynamicChecker => Box::new(DynamicChecker::new(a, b)),
            RivalKind::C2a => Box::new(C2a::new(a, b)),
            RivalKind::FixedTimeSteps => Box::new(FixedTimeSteps::new(a, b)),
        }
    }
}

/// Finds the first contact of two moving bodies with a solver of this project.
///
/// # Errors
/// A motion or the duration is out of range.
pub(crate) fn first_contact(
    bodies: BodyPair<'_>,
    query: &Motions,
    settings: &Settings,
    solver: &mut dyn Solve,
) -> Result<Answer, InputError> {
    let (a, b) = ((bodies.a, query.a), (bodies.b, query.b));
    let query = rigid_ccd::Query::new(a, b, query.duration, settings)?;
    let answer = solver.answer(Question::FirstContact, &query);
    answer.expect("all schedules find the first contact")
}

/// A solver of this project, with the bodies that it is asked about.
pub struct ProjectSolver<'s> {
    bodies: BodyPair<'s>,
    solver_kind: SolverKind,
    solver: Box<dyn Solve>,
    margin: f64,
}

impl<'s> ProjectSolver<'s> {
    /// Creates a solver of the given kind for two bodies, and the margin that they are to keep.
    pub fn new(kind: SolverKind, bodies: BodyPair<'s>, margin: f64) -> Self {
        ProjectSolver {
            bodies,
            solver_kind: kind,
            solver: kind.solver(),
            margin,
        }
    }
}

impl Solver for ProjectSolver<'_> {
    /// Answers a query with the solver of this project, which refuses an invalid query. Steps are advancements of all
    /// pairs together, or pairs of nodes visited by the best-first schedule.
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply {
        let settings = Settings {
            tolerance,
            margin: self.margin,
            ..Settings::DEFAULT
        };
        let answer = match first_contact(self.bodies, query, &settings, self.solver.as_mut()) {
            Ok(answer) => answer,
            // An invalid query is not answered.
            Err(error) => {
                return Reply {
                    reason: Some(error.to_string()),
                    ..Reply::new(ContactClaim::Refused, 0)
                };
            }
        };
        let claim = match answer.outcome {
            Outcome::Contact { time, .. } => ContactClaim::Contact { time },
            Outcome::Touching { .. } | Outcome::Overlapping { .. } => {
                ContactClaim::Contact { time: 0.0 }
            }
            Outcome::Free { .. } => ContactClaim::NoContact,
            Outcome::Unresolved(known) => ContactClaim::Unresolved {
                safe_until: known.safe_until,
            },
            Outcome::Interval { .. } | Outcome::LeastDistance { .. } => {
                unreachable!("no outcome of a first contact")
            }
        };
        let steps = if self.solver_kind.schedule.uses_velocity_bound() {
            answer.stats.advancements
        } else {
            answer.stats.iterations
        };
        let reason = answer.outcome.limit().map(|limit| limit.to_string());
        Reply {
            claim,
            steps,
            tolerance: Some(answer.tolerance),
            reason,
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Method::ThisProject(kind, pieces) => {
                write!(f, "{} {}", kind.schedule, kind.oracle)?;
                if kind.motion_bound == BoundKind::Published {
                    f.write_str(" published")?;
                }
                match (pieces, kind.schedule.uses_hull_trees()) {
                    (PieceKind::FewestPieces, _) | (PieceKind::Patches, true) => Ok(()),
                    (PieceKind::Triangles, _) => f.write_str(" over triangles"),
                    (PieceKind::Patches, false) => f.write_str(" over patches"),
                }
            }
            Method::Rival(kind) => f.write_str(&name_of(kind)),
            Method::Peer(kind) => f.write_str(&name_of(kind)),
            Method::Script(kind) => f.write_str(&name_of(kind)),
        }
    }
}
