//! The interface of all solvers: this project's methods, published rivals built here, and peer libraries.

use ccd_core::order::greater;
use ccd_tables::batch::median;
use ccd_tables::motions::Motions;
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// A solver that answers queries about two bodies, one after another.
pub trait Solver {
    /// Finds the first contact of the bodies at a tolerance, given as a length, and returns the solver's reply.
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply;
}

/// A solver's reply to a query, with the time that it took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimedReply {
    /// The solver's reply to the query.
    pub reply: Reply,
    /// The median time that the solver took for the query, in microseconds.
    pub micros: f64,
}

/// The maximum number of times that a query is answered for timing. The time is the median of all answers except the
/// first, which finds cold caches; clocks and caches make short times uncertain.
const MAX_TIMING_RUNS: usize = 4;
/// A query that has taken this long in total is not answered once more to improve its timing.
const REPEAT_TIME_LIMIT: Duration = Duration::from_millis(40);

/// Answers a query and times it, in the same way for all solvers.
pub fn answer_timed(solver: &mut dyn Solver, query: &Motions, tolerance: f64) -> TimedReply {
    let mut micros = Vec::with_capacity(MAX_TIMING_RUNS);
    let first = Instant::now();
    loop {
        let start = Instant::now();
        let reply = solver.answer(query, tolerance);
        micros.push(start.elapsed().as_secs_f64() * 1e6);
        if first.elapsed() > REPEAT_TIME_LIMIT || micros.len() == MAX_TIMING_RUNS {
            let warm = usize::from(micros.len() > 1);
            let micros = median(&mut micros[warm..]);
            return TimedReply { reply, micros };
        }
    }
}

/// The reply of a solver to one query.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reply {
    /// What the solver claims about the first contact.
    pub claim: ContactClaim,
    /// The number of steps in time: advancements, halvings or samples, depending on the solver.
    pub steps: u64,
    /// The tolerance at which the solver answered, if it states one.
    pub tolerance: Option<f64>,
    /// The reason for an incomplete answer, if the solver gives one.
    pub reason: Option<String>,
}

impl Reply {
    /// Returns a reply with the given claim and steps, without a tolerance or a reason.
    pub fn new(claim: ContactClaim, steps: u64) -> Self {
        Reply {
            claim,
            steps,
            tolerance: None,
            reason: None,
        }
    }

    /// Returns the tolerance by which the reply is judged: that of the query, or a higher one that the solver states.
    pub fn judging_tolerance(&self, tolerance: f64) -> f64 {
        greater(tolerance, self.tolerance.unwrap_or(0.0))
    }
}

/// What a solver claims about the first contact of a query.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactClaim {
    /// The bodies come within the tolerance at a time, and not before.
    Contact {
        /// The time of the claimed contact, from 0 to the query's duration.
        time: f64,
    },
    /// The bodies do not come within the tolerance over the whole duration.
    NoContact,
    /// The solver gave up before the end of the duration.
    Unresolved {
        /// The time before which there is no contact, according to the solver.
        safe_until: f64,
    },
    /// The solver does not support the query.
    Refused,
    /// The solver measured something else, such as a single distance, for a comparison of times.
    OtherMeasurement,
}

impl ContactClaim {
    /// Returns the name of the claim's kind in tables.
    pub fn status(self) -> &'static str {
        match self {
            ContactClaim::Contact { .. } => "contact",
            ContactClaim::NoContact => "free",
            ContactClaim::Unresolved { .. } => "unresolved",
            ContactClaim::Refused => "refused",
            ContactClaim::OtherMeasurement => "static",
        }
    }

    /// Returns the claimed time of a contact, or the time until which there is none.
    pub fn contact_or_safe_time(self) -> Option<f64> {
        match self {
            ContactClaim::Contact { time } | ContactClaim::Unresolved { safe_until: time } => {
                Some(time)
            }
            ContactClaim::NoContact | ContactClaim::Refused | ContactClaim::OtherMeasurement => {
                None
            }
        }
    }
}
