//! Answers to questions about two bodies: one struct for all questions.

use crate::feature::RccdFeature;
use crate::growing::Growing;
use ccd_core::order::lesser;
use rigid_ccd::answer::{ClearanceVerdict, Contact, Limit, Overlap};
use rigid_ccd::{Answer, Outcome};
use rigid_ccd_robot::PathOutcome;

/// The outcome of a query.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdOutcome {
    /// A limit was reached before the query was decided. Nothing touches until `safe_until`. The value is 0, so that an
    /// answer of zeros, which no call has filled, is unresolved.
    Unresolved = 0,
    /// The bodies stay apart over the whole duration.
    Free = 1,
    /// The bodies are in contact at `time`. In answers about the first contact, nothing touches before.
    Contact = 2,
    /// The bodies are within margin + tolerance at the start.
    Touching = 3,
    /// The bodies overlap at the start.
    Overlapping = 4,
    /// The first contact is at `time`, and the last one at `last_time`.
    Interval = 5,
    /// The least distance is between `lower` and `upper`. At `time` the distance is at most `upper`.
    LeastDistance = 6,
}

/// The limit that ended a query.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdLimit {
    /// No limit was reached.
    None = 0,
    /// The budget is spent.
    Budget = 1,
    /// The deadline has passed.
    Deadline = 2,
    /// The query was stopped.
    Stopped = 3,
    /// No further step can be certified.
    Stalled = 4,
    /// The oracle could not compute the distance of two pieces.
    OracleGaveUp = 5,
    /// Rounding leaves it undecided whether the bodies overlap at the start.
    OverlapUndecided = 6,
    /// A limit without a name in this interface.
    Other = 255,
}

/// An answer. Numbers that do not apply to the outcome are NaN.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RccdAnswer {
    /// The size of this struct in the caller's header. Set it before the call.
    pub size: usize,
    /// The outcome of the query.
    pub outcome: RccdOutcome,
    /// The limit that ended the query, even if the outcome was already certain.
    pub limit: RccdLimit,
    /// The time of the contact, or the time at which the least distance was found.
    pub time: f64,
    /// The time of the last contact of an interval.
    pub last_time: f64,
    /// The time until which nothing touches: the duration if the bodies stay apart, the time of a first contact, or the
    /// time that was proven before a limit.
    pub safe_until: f64,
    /// A lower bound of the requested distance. For questions about contacts it holds at all times.
    pub lower: f64,
    /// An upper bound of the same distance; infinity if none is known.
    pub upper: f64,
    /// The unit normal from the first body to the second, in world coordinates, at the contact or at the least distance.
    pub normal: [f64; 3],
    /// The point of the first body that is nearest to the second one.
    pub witness_a: [f64; 3],
    /// The point of the second body that is nearest to the first one.
    pub witness_b: [f64; 3],
    /// The feature of the first body that is in contact.
    pub feature_a: RccdFeature,
    /// The feature of the second body that is in contact.
    pub feature_b: RccdFeature,
    /// For contacts, the largest distance beyond the margin at which one is reported. For distances, their accuracy.
    pub tolerance: f64,
    /// The number of visits that the query took, in the unit of the budget.
    pub work: u64,
}

impl RccdOutcome {
    pub(crate) fn of_path(outcome: &PathOutcome<'_>) -> Self {
        match outcome {
            PathOutcome::Free => RccdOutcome::Free,
            PathOutcome::Contact(_) => RccdOutcome::Contact,
            PathOutcome::LeastDistance { .. } => RccdOutcome::LeastDistance,
            PathOutcome::Unresolved(_) => RccdOutcome::Unresolved,
        }
    }
}

impl RccdLimit {
    /// Returns the name of the limit with a value in C.
    pub(crate) fn name_of(number: i32) -> String {
        let mut limits = Limit::ALL.into_iter();
        let limit = limits.find(|&limit| RccdLimit::from(limit) as i32 == number);
        limit.map_or_else(|| format!("limit {number}"), |limit| limit.to_string())
    }
}

// SAFETY: the struct is `repr(C)`, begins with its size, and has the fields of the first version.
unsafe impl Growing for RccdAnswer {
    const FIRST_SIZE: usize = size_of::<RccdAnswer>();
}

impl RccdAnswer {
    /// Converts an answer about the least distance to an answer about a clearance.
    pub(crate) fn about_clearance(answer: &Answer, duration: f64, clearance: f64) -> Self {
        let distance_answer = RccdAnswer::new(answer, duration);
        match answer.outcome.clearance_verdict(clearance) {
            ClearanceVerdict::Kept => RccdAnswer {
                outcome: RccdOutcome::Free,
                safe_until: duration,
                ..distance_answer
            },
            ClearanceVerdict::Violated
                if matches!(
                    distance_answer.outcome,
                    RccdOutcome::LeastDistance | RccdOutcome::Unresolved
                ) =>
            {
                RccdAnswer {
                    outcome: RccdOutcome::Contact,
                    safe_until: lesser(distance_answer.safe_until, distance_answer.time),
                    ..distance_answer
                }
            }
            ClearanceVerdict::Violated | ClearanceVerdict::Unverified => distance_answer,
        }
    }

    /// Converts an answer to a query from time 0 to `duration`.
    pub(crate) fn new(answer: &Answer, duration: f64) -> Self {
        let outcome = &answer.outcome;
        let (kind, safe_until) = kind_and_safe_until(outcome, duration);
        let last_time = match outcome {
            Outcome::Interval { last, .. } => last.time,
            _ => f64::NAN,
        };
        let (normal, [witness_a, witness_b], [feature_a, feature_b]) = match contact(outcome) {
            Ok(Some(Contact {
                separation,
                feature_a,
                feature_b,
                ..
            })) => (
                separation.normal.to_array(),
                [separation.witness_a, separation.witness_b].map(|witness| witness.to_array()),
                [feature_a, feature_b].map(RccdFeature::from),
            ),
            Ok(None) => ([f64::NAN; 3], [[f64::NAN; 3]; 2], [RccdFeature::NONE; 2]),
            Err(common_point) => ([f64::NAN; 3], [common_point; 2], [RccdFeature::NONE; 2]),
        };
        RccdAnswer {
            size: size_of::<RccdAnswer>(),
            outcome: kind,
            limit: outcome.limit().map_or(RccdLimit::None, RccdLimit::from),
            time: outcome.time().unwrap_or(f64::NAN),
            last_time,
            safe_until,
            lower: outcome.lower(),
            upper: outcome.upper(),
            normal,
            witness_a,
            witness_b,
            feature_a,
            feature_b,
            tolerance: answer.tolerance,
            work: answer.stats.budgeted_work(),
        }
    }
}

fn kind_and_safe_until(outcome: &Outcome, duration: f64) -> (RccdOutcome, f64) {
    match *outcome {
        Outcome::Free { .. } => (RccdOutcome::Free, duration),
        Outcome::Contact { time, .. } => (RccdOutcome::Contact, time),
        Outcome::Touching { .. } => (RccdOutcome::Touching, 0.0),
        Outcome::Overlapping { .. } => (RccdOutcome::Overlapping, 0.0),
        Outcome::Interval { first, .. } => (RccdOutcome::Interval, first.time),
        // The comparison is written so that NaN proves nothing.
        Outcome::LeastDistance { lower, .. } if lower > 0.0 => {
            (RccdOutcome::LeastDistance, duration)
        }
        Outcome::LeastDistance { .. } => (RccdOutcome::LeastDistance, 0.0),
        Outcome::Unresolved(known) => (RccdOutcome::Unresolved, known.safe_until),
    }
}

/// Returns the contact of two pieces, or `None` if there is none. If one body is inside the other, returns the common
/// point as `Err`.
fn contact(outcome: &Outcome) -> Result<Option<Contact>, [f64; 3]> {
    match *outcome {
        Outcome::Overlapping {
            overlap: Overlap::AInsideB(point) | Overlap::BInsideA(point),
            ..
        } => Err(point.to_array()),
        Outcome::Overlapping { overlap, .. } => Ok(overlap.contact()),
        _ => Ok(outcome.nearest_contact().map(|(_, contact)| contact)),
    }
}

impl From<Limit> for RccdLimit {
    fn from(limit: Limit) -> Self {
        match limit {
            Limit::Budget => RccdLimit::Budget,
            Limit::Deadline => RccdLimit::Deadline,
            Limit::Stopped => RccdLimit::Stopped,
            Limit::Stalled => RccdLimit::Stalled,
            Limit::OracleGaveUp => RccdLimit::OracleGaveUp,
            Limit::OverlapUndecided => RccdLimit::OverlapUndecided,
            _ => RccdLimit::Other,
        }
    }
}
