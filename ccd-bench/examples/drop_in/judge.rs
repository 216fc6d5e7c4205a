//! The rule by which answers are judged.
//!
//! - A contact is *late* after the expected time, *early* before the time at which the bodies come within the
//!   tolerance, *missed* without a hit. Times are compared to a relative 1e-9, as the suite's own judge does.
//! - A row may ask for a finer tolerance than the function's, 1e-9 in double and 1e-6 in single precision. The time in
//!   which the bodies approach by that is then allowed on the early side, and bodies that come that near without touching
//!   may be reported or not.
//! - Bodies that stay apart are *false* with a hit. Bodies in contact at the start are *late* or *missed* unless the
//!   hit is at time 0. Bodies that come within the tolerance without touching may be reported or not. Which bodies are
//!   let go at the start, where that is asked for, is what parry's own test of the row says.
//! - In single precision the numbers of a row are rounded, which moves the bodies: by `6e-8` of the sum of all
//!   coordinates, sizes and ways. The time in which they approach by that, at the rate at which they do at the hit, is
//!   allowed on either side, and a unit in the last place of the time. What the library stops at in single precision,
//!   1.2e-6, is allowed on the early side.
//! - An answer is *hung* if there is none after a second, *panicked* if the library does. It is *failed* if the time is
//!   wrong and its status says so.

use crate::rows::{Expected, Row};
use ccd_core::order::greater;
use std::fmt;

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reply {
    Free,
    Hit {
        time: f64,
        /// The status says that the search did not end well.
        failed: bool,
    },
    Unsupported,
    Hung,
    Panicked,
}

/// What is wrong about an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    Late(f64),
    Early(f64),
    Missed,
    False,
    /// With a status that says so, and a wrong time: late if positive, early if negative.
    Failed(f64),
    Unsupported,
    Hung,
    Panicked,
}

/// How far times may be off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Allowance {
    pub(crate) late: f64,
    pub(crate) early: f64,
    /// The distance at which bodies that stay apart may be reported.
    pub(crate) near: f64,
}

impl Allowance {
    /// Returns the allowance for a row in single precision, for bodies that approach at that rate.
    pub(crate) fn single(row: &Row, closing_speed: Option<f64>) -> Self {
        let q = &row.query;
        let of_motion = |motion: &ccd_core::Motion| {
            let time = match row.expected {
                Expected::Contact { time, .. } => time,
                Expected::Free | Expected::Near | Expected::Start => 0.0,
            };
            motion.start().translation().abs().element_sum()
                + motion.velocity().abs().element_sum() * time
        };
        let sizes: f64 = row.shapes.iter().map(|shape| 4.0 * shape.size()).sum();
        let moved = 6e-8 * (of_motion(&q.a) + of_motion(&q.b) + sizes + row.margin);
        let rounded = match row.expected {
            Expected::Contact { time, .. } => f64::from(f32::EPSILON) * time,
            Expected::Free | Expected::Near | Expected::Start => 0.0,
        };
        let time = |length: f64| rounded + time_for(length, closing_speed);
        Allowance {
            late: time(moved),
            early: time(moved + greater(1.2e-6 - row.tolerance, 0.0)),
            near: 1.2e-6 + moved,
        }
    }

    /// Returns the allowance for a row in double precision.
    pub(crate) fn double(row: &Row, closing_speed: Option<f64>) -> Self {
        Allowance {
            late: 0.0,
            early: time_for(greater(1e-9 - row.tolerance, 0.0), closing_speed),
            near: 1e-9,
        }
    }
}

/// Returns the time in which bodies approach by a length.
fn time_for(length: f64, closing_speed: Option<f64>) -> f64 {
    let speed = closing_speed.filter(|speed| *speed > 0.0);
    speed.map_or(0.0, |speed| length / speed)
}

/// Returns what is wrong about an answer; none if it is right.
pub(crate) fn judge(row: &Row, reply: Reply, allowed: Allowance) -> Option<Fault> {
    let (time, failed) = match reply {
        Reply::Unsupported => return Some(Fault::Unsupported),
        Reply::Hung => return Some(Fault::Hung),
        Reply::Panicked => return Some(Fault::Panicked),
        Reply::Free => {
            let right = matches!(row.expected, Expected::Free | Expected::Near);
            return (!right).then_some(Fault::Missed);
        }
        Reply::Hit { time, failed } => (time, failed),
    };
    let (earliest, latest) = match row.expected {
        Expected::Near => return None,
        Expected::Free => {
            let near = row
                .least_distance
                .is_some_and(|least| least <= allowed.near);
            return (!near).then_some(Fault::False);
        }
        Expected::Start => (0.0, 0.0),
        Expected::Contact { earliest, time } => (earliest.unwrap_or(0.0), time),
    };
    let least = earliest - 1e-9 * greater(latest.abs(), 1e-3) - 1e-12 - allowed.early;
    let most = latest * (1.0 + 1e-9) + allowed.late;
    if time > most {
        Some(if failed {
            Fault::Failed(time - latest)
        } else {
            Fault::Late(time - latest)
        })
    } else if time >= least {
        None
    } else {
        Some(if failed {
            Fault::Failed(time - earliest)
        } else {
            Fault::Early(earliest - time)
        })
    }
}

impl Fault {
    /// How far the time is off; none for other faults.
    pub(crate) fn amount(self) -> Option<f64> {
        match self {
            Fault::Late(by) | Fault::Early(by) | Fault::Failed(by) => Some(by.abs()),
            _ => None,
        }
    }

    /// The word for it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Fault::Late(_) => "late",
            Fault::Early(_) => "early",
            Fault::Missed => "missed",
            Fault::False => "false",
            Fault::Failed(_) => "failed",
            Fault::Unsupported => "unsupported",
            Fault::Hung => "hung",
            Fault::Panicked => "panicked",
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Late(by) | Fault::Early(by) | Fault::Failed(by) => {
                write!(f, "{} by {by:.2e}", self.name())
            }
            _ => f.write_str(self.name()),
        }
    }
}

impl fmt::Display for Reply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reply::Free => write!(f, "free"),
            Reply::Hit {
                time,
                failed: false,
            } => write!(f, "{time}"),
            Reply::Hit { time, failed: true } => write!(f, "{time} failed"),
            Reply::Unsupported => write!(f, "unsupported"),
            Reply::Hung => write!(f, "hung"),
            Reply::Panicked => write!(f, "panicked"),
        }
    }
}

impl std::str::FromStr for Reply {
    type Err = anyhow::Error;

    fn from_str(text: &str) -> anyhow::Result<Self> {
        Ok(match text {
            "free" => Reply::Free,
            "unsupported" => Reply::Unsupported,
            "hung" => Reply::Hung,
            "panicked" => Reply::Panicked,
            hit => {
                let (time, failed) = match hit.strip_suffix(" failed") {
                    Some(time) => (time, true),
                    None => (hit, false),
                };
                Reply::Hit {
                    time: time.parse()?,
                    failed,
                }
            }
        })
    }
}
