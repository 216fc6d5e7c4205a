//! What is looked for, and how near an answer is to it.

use super::examiner::Examined;
use crate::method::guarded::Asked;
use crate::method::solver::Claim;
use crate::run::contest::Verdict;
use crate::truth::Truth;
use ccd_core::order::{greater, lesser};
use clap::ValueEnum;
use std::fmt;

/// A kind of failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Aim {
    /// A contact reported after the first one, or not at all.
    Late,
    /// A contact reported while the bodies are farther apart than the tolerance.
    Early,
    /// A query that does not end in time, or that ends the process.
    Stuck,
}

/// The score from which on an answer is a failure.
pub(super) const FAILURE: f64 = 1.0;

/// The steps, or microseconds, that count as a failure, which nothing reaches before its time is over.
const MOST_STEPS: f64 = 1e9;

/// The highest score of an answer that is no failure.
const ALMOST: f64 = 0.999_999;

/// A contact that is reported farther away than this multiple of the tolerance is as good as any other.
const FARTHEST: f64 = 10.0;

/// The score of an answer that cannot be judged, or that does not lead anywhere.
const NOWHERE: f64 = -10.0;

impl Aim {
    /// All kinds of failures.
    pub const ALL: [Aim; 3] = [Aim::Late, Aim::Early, Aim::Stuck];

    /// Returns what it means, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Aim::Late => "contacts reported after the first one, or not at all",
            Aim::Early => "contacts reported out of reach",
            Aim::Stuck => "no answer in time",
        }
    }

    /// Describes the best score of answers that are no failures.
    pub(super) fn nearest(self, score: f64) -> String {
        match self {
            Aim::Late if score > NOWHERE => {
                format!(
                    "{:.1e} of the tolerance left",
                    greater(0.0, FAILURE - score)
                )
            }
            Aim::Early if score > NOWHERE => format!("{score:.4} of the tolerance"),
            Aim::Stuck if score > NOWHERE => format!("{:.0} steps or µs", score * MOST_STEPS),
            Aim::Late | Aim::Early | Aim::Stuck => String::new(),
        }
    }

    /// Returns true if an answer is a failure of this kind.
    pub(super) fn is_met(self, examined: &Examined) -> bool {
        let failures: &[Verdict] = match self {
            Aim::Late => &[Verdict::Late, Verdict::Missed],
            Aim::Early => &[Verdict::Early, Verdict::False],
            Aim::Stuck => &[Verdict::CutOff, Verdict::Died],
        };
        failures.contains(&examined.judged.verdict)
    }

    /// Returns how near an answer is to a failure: more than [`FAILURE`] for a failure, the more the worse.
    pub(super) fn score(self, examined: &Examined) -> f64 {
        let Asked::Answered { reply, micros } = &examined.asked else {
            return match self {
                Aim::Stuck => f64::INFINITY,
                Aim::Late | Aim::Early => NOWHERE,
            };
        };
        match self {
            Aim::Late => lateness(examined, reply.claim),
            Aim::Early => match (reply.claim, examined.ratio) {
                (Claim::Contact { .. }, Some(ratio)) => ratio,
                _ => NOWHERE,
            },
            // Steps do not depend on how busy the machine is; methods that count none have their time.
            Aim::Stuck => {
                let cost = match reply.steps {
                    0 => *micros,
                    steps => steps as f64,
                };
                lesser(cost / MOST_STEPS, ALMOST)
            }
        }
    }
}

/// Returns the lateness of a claim: as a share of the duration above [`FAILURE`], and below it by how little
/// of the tolerance the bodies are still apart.
fn lateness(examined: &Examined, claim: Claim) -> f64 {
    let duration = examined.duration;
    match (examined.truth, claim) {
        (
            Truth::Hit { hi, .. },
            Claim::Contact { time } | Claim::Unresolved { safe_until: time },
        ) if time > hi => FAILURE + (time - hi) / duration,
        (Truth::Hit { hi, .. }, Claim::Free) => FAILURE + (duration - hi) / duration,
        (Truth::Hit { .. }, Claim::Contact { .. }) => match examined.ratio {
            Some(ratio) => FAILURE - lesser(ratio, FARTHEST),
            None => NOWHERE,
        },
        _ => NOWHERE,
    }
}

impl fmt::Display for Aim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Aim::Late => "late",
            Aim::Early => "early",
            Aim::Stuck => "stuck",
        })
    }
}
