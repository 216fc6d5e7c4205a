//! How a claim stands against the truth.

use crate::method::solver::Claim;
use crate::truth::{Referee, Truth};
use ccd_core::order::greater;
use rigid_ccd::table::motions::Query;
use std::fmt;

/// What a claim is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// As it has to be.
    Right,
    /// A contact after the exact first one.
    Late,
    /// Free, though there is a contact.
    Missed,
    /// A contact where there is none, the bodies being farther apart than the tolerance.
    False,
    /// A contact while the bodies are still farther apart than the tolerance.
    Early,
    /// Nothing but a time until which nothing touches.
    Unresolved,
    /// Stopped: it took longer than anybody would wait.
    CutOff,
    /// The peer's process ended instead of answering.
    Died,
    /// The truth is not known well enough.
    Undecided,
    /// It is no answer to the query, such as a single distance that others are compared with.
    NotJudged,
}

/// A verdict, and by how much the time is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// The verdict.
    pub verdict: Verdict,
    /// How far the time of contact lies outside of the bracket of the true one, as a share of the
    /// duration; none where there is no time, or no true one.
    pub error: Option<f64>,
}

/// How much later than the end of the bracket a time may be before it counts as late, as a share of
/// the duration: poses by two formulas of one motion differ by some 1e-15 of the coordinates, and the
/// slowest of the scenes moves by a hundredth of these during its duration; ten times over.
const SLACK: f64 = 1e-12;

/// The widest bracket that is taken for a time, as a share of the duration.
const WIDEST: f64 = 1e-9;

/// How much more than its tolerance, as a share of it, a solver may round a distance to.
const ROUNDING: f64 = 1e-6;

impl Judged {
    /// A verdict where there is no time to be off.
    pub fn plain(verdict: Verdict) -> Self {
        Judged {
            verdict,
            error: None,
        }
    }
}

/// Judges a claim made with a tolerance.
pub fn judge(
    referee: &Referee<'_>,
    query: &Query,
    truth: Truth,
    claim: Claim,
    tolerance: f64,
) -> Judged {
    let near = |time: f64| referee.distance(query, time).lower <= tolerance * (1.0 + ROUNDING);
    let plain = Judged::plain;
    let (lo, hi) = match truth {
        Truth::Hit { lo, hi } if hi - lo > WIDEST * query.duration => {
            return plain(Verdict::Undecided);
        }
        Truth::Hit { lo, hi } => (lo, hi),
        Truth::Free => {
            return plain(match claim {
                Claim::Contact { time } if near(time) => Verdict::Right,
                Claim::Contact { .. } => Verdict::False,
                Claim::Free => Verdict::Right,
                Claim::Unresolved { .. } | Claim::Refused => Verdict::Unresolved,
            });
        }
        Truth::Start | Truth::Graze { .. } | Truth::Undecided { .. } => {
            return plain(Verdict::Undecided);
        }
    };
    let time = match claim {
        Claim::Contact { time } => time,
        Claim::Free => return plain(Verdict::Missed),
        // Also a proof, which may be wrong.
        Claim::Unresolved { safe_until } if safe_until > hi + SLACK * query.duration => {
            return plain(Verdict::Late);
        }
        Claim::Unresolved { .. } | Claim::Refused => return plain(Verdict::Unresolved),
    };
    let off = greater(0.0, greater(lo - time, time - hi)) / query.duration;
    // Written so that NaN is late.
    let verdict = if !(time <= hi + SLACK * query.duration) {
        Verdict::Late
    } else if time < lo && !near(time) {
        Verdict::Early
    } else {
        Verdict::Right
    };
    Judged {
        verdict,
        // Of a time that is none there is no error: `max` has passed over the NaN.
        error: Some(off).filter(|_| !time.is_nan()),
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Verdict::Right => "right",
            Verdict::Late => "late",
            Verdict::Missed => "missed",
            Verdict::False => "false",
            Verdict::Early => "early",
            Verdict::Unresolved => "unresolved",
            Verdict::CutOff => "cut off",
            Verdict::Died => "died",
            Verdict::Undecided => "undecided",
            Verdict::NotJudged => "not judged",
        })
    }
}
