//! Asks a method about an attempt, and judges the answer by the exact one.

use super::attempt::{Attempt, Body};
use crate::method::Method;
use crate::method::guarded::{Asked, Guarded, Programs, Setting};
use crate::method::solver::Claim;
use crate::run::contest::{Judged, Verdict, judge, judge_asked};
use crate::truth::{Referee, Surface, Truth};
use ccd_decomp::TriangleMesh;
use rigid_ccd::table::motions::Query;
use std::io;
use std::time::Duration;

/// Asks one method about attempts.
#[derive(Debug)]
pub(super) struct Examiner {
    programs: Programs,
    method: Method,
    patience: Duration,
    open: Option<Open>,
}

/// A method that has prepared two meshes.
#[derive(Debug)]
struct Open {
    bodies: [Body; 2],
    tolerance: f64,
    surfaces: [Surface; 2],
    guarded: Guarded,
}

/// A judged answer.
#[derive(Clone, Debug)]
pub(super) struct Examined {
    pub(super) asked: Asked,
    pub(super) truth: Truth,
    pub(super) judged: Judged,
    pub(super) duration: f64,
    /// The distance at the claimed time over the tolerance.
    pub(super) ratio: Option<f64>,
}

/// The tests of pairs for an exact answer: some seconds. An attempt that needs more is left out.
const REFEREE_TESTS: u64 = 300_000;

/// The time to prepare the bodies.
const PREPARATION: Duration = Duration::from_secs(20);

/// What the poses of two formulas of one motion may differ by, as a share of the largest coordinate. A
/// lateness that moves the bodies by less is none.
const POSES_DIFFER: f64 = 1e-14;

impl Examiner {
    pub(super) fn new(programs: Programs, method: Method, patience: Duration) -> Self {
        Examiner {
            programs,
            method,
            patience,
            open: None,
        }
    }

    /// Asks about an attempt; `None` if it is invalid, the method refuses it, or nobody knows the answer.
    ///
    /// # Errors
    /// If the method's process cannot be started.
    pub(super) fn examine(&mut self, attempt: &Attempt) -> io::Result<Option<Examined>> {
        let Some(query) = query_of(self.method, attempt) else {
            return Ok(None);
        };
        let patience = self.patience;
        let Some(open) = self.open(attempt)? else {
            return Ok(None);
        };
        let [a, b] = &open.surfaces;
        let referee = Referee::new(a, b).within(REFEREE_TESTS);
        let truth = referee.first_contact(&query);
        if !matches!(truth, Truth::Hit { .. } | Truth::Free) {
            return Ok(None);
        }
        let asked = open.guarded.ask(&query, patience)?;
        let examined = judged(attempt, &query, referee, truth, asked);
        Ok(Some(examined).filter(|examined| !is_ours_inside(self.method, examined)))
    }

    /// Returns the method with the attempt's meshes; `None` if it does not take them.
    fn open(&mut self, attempt: &Attempt) -> io::Result<Option<&mut Open>> {
        let fits = |open: &Open| open.is_of(attempt);
        if !self.open.as_ref().is_some_and(fits) {
            self.open = None;
            let Ok(meshes) = attempt.meshes() else {
                return Ok(None);
            };
            let setting = Setting {
                preparation: PREPARATION,
                ..Setting::new(self.method, attempt.tolerance)
            };
            let guarded = match Guarded::start(&self.programs, setting, meshes.each_ref()) {
                Ok(guarded) => guarded,
                Err(error) if error.kind() == io::ErrorKind::Unsupported => return Ok(None),
                Err(error) => return Err(error),
            };
            self.open = Some(Open {
                bodies: attempt.bodies.clone(),
                tolerance: attempt.tolerance,
                surfaces: meshes.each_ref().map(Surface::new),
                guarded,
            });
        }
        Ok(self.open.as_mut())
    }
}

impl Open {
    /// Returns true if the process has the meshes and the tolerance of an attempt.
    fn is_of(&self, attempt: &Attempt) -> bool {
        let mut bodies = self.bodies.iter().zip(&attempt.bodies);
        self.tolerance == attempt.tolerance
            && bodies.all(|(a, b)| a.vertices == b.vertices && a.faces == b.faces)
    }
}

/// Returns the meshes and the query of an attempt, as a method is asked about it.
pub(super) fn scene(method: Method, attempt: &Attempt) -> Option<([TriangleMesh; 2], Query)> {
    Some((attempt.meshes().ok()?, query_of(method, attempt)?))
}

/// Returns the query of an attempt, along the motion that the method takes.
fn query_of(method: Method, attempt: &Attempt) -> Option<Query> {
    method.motion_kind().of(attempt.query().ok()?).ok()
}

fn judged(
    attempt: &Attempt,
    query: &Query,
    referee: Referee<'_>,
    truth: Truth,
    asked: Asked,
) -> Examined {
    let mut ratio = None;
    let mut verdict = judge_asked(&asked, |reply| {
        let tolerance = reply.judged_by(attempt.tolerance);
        if let Claim::Contact { time } = reply.claim {
            ratio = Some(referee.distance(query, time).lower / tolerance);
        }
        judge(&referee, query, truth, reply.claim, tolerance)
    });
    if verdict.verdict == Verdict::Late && !is_seen(attempt, query, truth, &asked) {
        verdict = Judged::plain(Verdict::Undecided);
    }
    Examined {
        asked,
        truth,
        judged: verdict,
        duration: query.duration,
        ratio,
    }
}

/// Returns true unless a lateness is within what two formulas of one motion differ by.
fn is_seen(attempt: &Attempt, query: &Query, truth: Truth, asked: &Asked) -> bool {
    let (Truth::Hit { hi, .. }, Some(time)) = (truth, asked.claim().and_then(Claim::time)) else {
        return true;
    };
    let (mut way, mut farthest) = (0.0, 0.0);
    for (body, motion) in attempt.bodies.iter().zip([&query.a, &query.b]) {
        let reach = body.size() + motion.centre().length();
        let travel = motion.velocity().length();
        way += travel + motion.spin().length() * reach;
        farthest += motion.start().translation().length() + reach + travel;
    }
    // An invalid time is no rounding.
    !((time - hi) * way <= POSES_DIFFER * farthest)
}

/// Returns true for a contact at the start of bodies of this project of which one is inside the other: they
/// are solids, of which the referee knows only the surfaces.
fn is_ours_inside(method: Method, examined: &Examined) -> bool {
    let at_start = examined.asked.claim() == Some(Claim::Contact { time: 0.0 });
    let is_ours = matches!(method, Method::Ours(..));
    is_ours && at_start && examined.ratio.is_some_and(|ratio| ratio > 1.0)
}
