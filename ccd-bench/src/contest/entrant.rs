//! Everybody who competes, by name.

use crate::contender::{Adjustable, Claim, Contender, Reply};
use crate::engine::{BoundKind, Method, OracleKind, ScheduleKind, Solver};
use crate::motions::Query;
use crate::peer::PeerKind;
use crate::query::{Bodies, solve};
use crate::rival::{C2a, Contact, DynamicChecker, Stepping};
use crate::scene::{Pieces, Scene};
use ccd_core::{Config, Outcome};
use std::fmt;

/// Somebody who answers queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Entrant {
    /// A method of this project, over bodies made of such pieces.
    Ours(Method, Pieces),
    /// A published rival, built here.
    Rival(RivalKind),
    /// A library.
    Peer(PeerKind),
}

/// The rivals there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RivalKind {
    /// Continuous tests of oriented boxes.
    Contact,
    /// Adaptive bisection.
    DynamicChecker,
    /// Controlled conservative advancement.
    C2a,
    /// Static tests at equal steps.
    Stepping,
}

/// Which motion somebody moves the bodies along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// As the query says: a centre straight, the body turning about it.
    Given,
    /// From the same pose at the start to the same at the end, along a screw.
    Screw,
}

const RIVALS: [RivalKind; 4] = [
    RivalKind::Contact,
    RivalKind::DynamicChecker,
    RivalKind::C2a,
    RivalKind::Stepping,
];

impl Entrant {
    /// All of them, the default method first.
    pub fn all() -> Vec<Entrant> {
        let method = |schedule, oracle| Method {
            schedule,
            oracle,
            bound: BoundKind::Sound,
        };
        let (best, fast) = (ScheduleKind::BestFirst, ScheduleKind::Fast);
        let ours = [
            (method(best, OracleKind::Direct), Pieces::Least),
            (method(best, OracleKind::Gjk), Pieces::Least),
            (method(best, OracleKind::GjkF32), Pieces::Least),
            (method(fast, OracleKind::Vmarch), Pieces::Patches),
            (method(fast, OracleKind::Gjk), Pieces::Patches),
            (
                method(ScheduleKind::Naive, OracleKind::Direct),
                Pieces::Least,
            ),
            (method(best, OracleKind::Direct), Pieces::Triangles),
            (method(best, OracleKind::Direct), Pieces::Patches),
            (method(best, OracleKind::Direct), Pieces::ApproximateHulls),
        ];
        let ours = ours.map(|(method, pieces)| Entrant::Ours(method, pieces));
        let rivals = RIVALS.map(Entrant::Rival);
        let peers = PeerKind::ALL.into_iter().map(Entrant::Peer);
        ours.into_iter().chain(rivals).chain(peers).collect()
    }

    /// Whether it is measured at every tolerance: not where none changes its answers, nor for models of
    /// the bodies that are compared with each other alone.
    pub fn takes_tolerances(self) -> bool {
        match self {
            Entrant::Ours(..) => !self.is_model(),
            Entrant::Rival(_) => true,
            Entrant::Peer(kind) => kind.takes_tolerance(),
        }
    }

    /// Whether it is the default method over pieces that it would not choose itself.
    pub fn is_model(self) -> bool {
        match self {
            Entrant::Ours(method, pieces) => {
                let own = match method.schedule.uses_hull_trees() {
                    true => Pieces::Patches,
                    false => Pieces::Least,
                };
                pieces != own
            }
            Entrant::Rival(_) | Entrant::Peer(_) => false,
        }
    }

    /// Which motion it moves the bodies along.
    pub fn path(self) -> Path {
        match self {
            Entrant::Rival(RivalKind::Contact) => Path::Screw,
            _ => Path::Given,
        }
    }
}

impl RivalKind {
    /// Takes a seat at a scene.
    pub fn enter(self, scene: &Scene, tolerance: f64) -> Box<dyn Adjustable> {
        let (a, b) = (scene.a.mesh(), scene.b.mesh());
        match self {
            RivalKind::Contact => Box::new(Contact::new(a, b, tolerance)),
            RivalKind::DynamicChecker => Box::new(DynamicChecker::new(a, b, tolerance)),
            RivalKind::C2a => Box::new(C2a::new(a, b, tolerance)),
            RivalKind::Stepping => Box::new(Stepping::new(a, b, tolerance)),
        }
    }
}

/// One of this project's methods as a contender.
pub struct Ours<'s> {
    bodies: Bodies<'s>,
    method: Method,
    solver: Box<dyn Solver>,
    config: Config,
}

impl<'s> Ours<'s> {
    /// A method on two bodies.
    pub fn new(method: Method, bodies: Bodies<'s>, tolerance: f64) -> Self {
        Ours {
            bodies,
            method,
            solver: method.solver(),
            config: Config {
                tolerance,
                ..Config::default()
            },
        }
    }
}

impl Adjustable for Ours<'_> {
    fn set_tolerance(&mut self, tolerance: f64) {
        self.config.tolerance = tolerance;
    }
}

impl Contender for Ours<'_> {
    /// Steps are advancements of all pairs where there is such a thing, else pairs of nodes visited.
    fn answer(&mut self, query: &Query) -> Reply {
        let Ok(answer) = solve(self.bodies, query, &self.config, self.solver.as_mut()) else {
            // A query that cannot be posed is not answered.
            return Reply {
                claim: Claim::Unresolved { safe_until: 0.0 },
                steps: 0,
            };
        };
        let claim = match answer.outcome {
            Outcome::Contact { time, .. } => Claim::Contact { time },
            Outcome::Touching { .. } | Outcome::Overlapping { .. } => Claim::Contact { time: 0.0 },
            Outcome::Free { .. } => Claim::Free,
            Outcome::Unresolved { safe_until, .. } => Claim::Unresolved { safe_until },
        };
        let steps = match self.method.schedule.uses_a_bound() {
            true => answer.stats.advancements,
            false => answer.stats.iterations,
        };
        Reply { claim, steps }
    }
}

impl fmt::Display for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Entrant::Ours(method, pieces) => {
                write!(f, "{} {}", method.schedule, method.oracle)?;
                match (pieces, method.schedule.uses_hull_trees()) {
                    (Pieces::Least, _) | (Pieces::Patches, true) => Ok(()),
                    (Pieces::Triangles, _) => f.write_str(" over triangles"),
                    (Pieces::Patches, false) => f.write_str(" over patches"),
                    (Pieces::ApproximateHulls, _) => f.write_str(" over hulls"),
                }
            }
            Entrant::Rival(RivalKind::Contact) => f.write_str("CONTACT"),
            Entrant::Rival(RivalKind::DynamicChecker) => f.write_str("Dynamic Collision Checker"),
            Entrant::Rival(RivalKind::C2a) => f.write_str("C2A"),
            Entrant::Rival(RivalKind::Stepping) => f.write_str("discrete stepping"),
            Entrant::Peer(kind) => f.write_str(kind.name()),
        }
    }
}
