//! Records of answers about paths, for example of a motion that was stopped. A record can be replayed later.

mod digest;
mod replay;
mod start_policy;

pub use replay::{EvidenceError, Replay, Verdict};

use crate::cell::Cell;
use crate::joint_curve::JointCurve;
use crate::path_answer::{PathAnswer, PathOutcome};
use crate::path_point::PathPoint;
use digest::{body_digest, pairs_digest};
use rigid_ccd::{Pose, Settings, StartPolicy};
use serde::{Deserialize, Serialize};

/// The format name and version at the start of each record.
const FORMAT: &str = "rigid-ccd evidence 2";

/// A record of the first contact on a path: the question, digests of the bodies, and the answer.
///
/// The bodies themselves are not stored: a replay needs the same cell.
///
/// ```
/// # use rigid_ccd_robot::{Cell, Joint, Link, LinkPairs, PositionRule, Robot};
/// use rigid_ccd_robot::evidence::{Evidence, RecordedAnswer, RecordedPath, Verdict};
/// use rigid_ccd::{Body, Pose, Settings};
/// # let links = vec![Link::named("base"), Link::named("arm").with_body(Body::capsule(0.1, 0.4)?, Pose::IDENTITY)];
/// # let hinge = rigid_ccd::trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 1.0, 0.0])?;
/// # let joint = Joint {
/// #     name: "hinge".into(), parent: "base".into(), child: "arm".into(),
/// #     geometry: hinge, position_rule: PositionRule::Independent,
/// # };
/// # let robot = Robot::new(links, vec![joint])?;
/// # let pairs = LinkPairs::from_robot(&robot);
/// # let mut cell = Cell::new(robot, pairs);
/// cell.add_obstacle("post", Body::sphere(0.2)?, Pose::at([0.4, 0.0, 0.0])?)?;
/// let (settings, path) = (Settings::DEFAULT, [[0.0], [1.0]]);
/// let answer = cell.solver().with_settings(settings.clone()).first_contact(&path)?;
///
/// let answer = RecordedAnswer::try_from(&answer)?;
/// let record = Evidence::new(&cell, &settings, RecordedPath::configurations(&path), answer)?;
/// let read = Evidence::from_json(&record.to_json()?)?;
/// assert_eq!(read.replay(&cell)?.verdict, Verdict::SameAnswer);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// The format, with its version.
    pub format: String,
    /// The version of the library that gave the answer.
    pub library: String,
    /// The settings.
    pub settings: RecordedSettings,
    /// The path.
    pub path: RecordedPath,
    /// The answer.
    pub answer: RecordedAnswer,
    /// All bodies: first the robot's, attached bodies included, then the obstacles.
    pub bodies: Vec<RecordedBody>,
    /// The digest of the checked pairs and of the distances at which they count as touching.
    pub pairs_sha256: String,
}

/// The settings on which an answer depends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordedSettings {
    /// The tolerance.
    pub tolerance: f64,
    /// The margin.
    pub margin: f64,
    /// The budget.
    pub budget: u64,
    /// The deadline in seconds, if there was one.
    pub deadline: Option<f64>,
    /// The policy for pairs in contact at the start. A record without it means [`StartPolicy::Report`].
    #[serde(
        default,
        with = "start_policy",
        skip_serializing_if = "start_policy::is_default"
    )]
    pub start: StartPolicy,
}

/// The path of a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RecordedPath {
    /// Configurations, between which all joints move at constant rates.
    Configurations(Vec<Vec<f64>>),
    /// A curve.
    Curve(JointCurve),
}

/// The answer of a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RecordedAnswer {
    /// Nothing touches.
    Free,
    /// Two items touch at a point, and nothing touches before it.
    Contact {
        /// The index of the point's segment.
        segment: usize,
        /// The fraction of the segment before the point.
        fraction: f64,
        /// The names of both items.
        items: [String; 2],
    },
    /// A limit was reached. Nothing touches before a point.
    Unresolved {
        /// The name of the limit.
        limit: String,
        /// The index of the point's segment.
        segment: usize,
        /// The fraction of the segment before the point.
        fraction: f64,
    },
}

/// A body of a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordedBody {
    /// The link, attached body or obstacle that it belongs to.
    pub item: String,
    /// The digest of its shape.
    pub sha256: String,
    /// Its position at the start of the path, in the frame of the robot's base.
    pub position: [f64; 3],
    /// Its orientation there, as a quaternion in the order x, y, z, w.
    pub orientation: [f64; 4],
}

impl RecordedPath {
    /// Creates a record of a path through configurations.
    pub fn configurations<Q: AsRef<[f64]>>(configurations: &[Q]) -> Self {
        let copies = configurations
            .iter()
            .map(|configuration| configuration.as_ref().to_vec());
        RecordedPath::Configurations(copies.collect())
    }

    /// Returns the first configuration; `None` for an empty path.
    fn start(&self) -> Option<Vec<f64>> {
        match self {
            RecordedPath::Configurations(all) => all.first().cloned(),
            RecordedPath::Curve(curve) => Some(curve.positions(*curve.times().first()?)),
        }
    }
}

impl TryFrom<&PathAnswer<'_>> for RecordedAnswer {
    type Error = EvidenceError;

    fn try_from(answer: &PathAnswer<'_>) -> Result<Self, EvidenceError> {
        if !answer.is_free_until_contact() {
            return Err(EvidenceError::NoFirstContact);
        }
        let PathPoint { segment, fraction } = answer.free_until;
        match &answer.outcome {
            PathOutcome::Free => Ok(RecordedAnswer::Free),
            PathOutcome::Contact(contact) => Ok(RecordedAnswer::Contact {
                segment,
                fraction,
                items: contact.items.map(|item| item.name().to_owned()),
            }),
            PathOutcome::Unresolved(known) => Ok(RecordedAnswer::Unresolved {
                limit: known.limit.to_string(),
                segment,
                fraction,
            }),
            PathOutcome::LeastDistance { .. } => Err(EvidenceError::NoFirstContact),
        }
    }
}

impl RecordedAnswer {
    /// Returns the point before which nothing touches; `None` if the whole path is free.
    pub fn free_until(&self) -> Option<PathPoint> {
        match *self {
            RecordedAnswer::Free => None,
            RecordedAnswer::Contact {
                segment, fraction, ..
            }
            | RecordedAnswer::Unresolved {
                segment, fraction, ..
            } => Some(PathPoint { segment, fraction }),
        }
    }
}

impl Evidence {
    /// Creates a record of an answer to [`first_contact`](crate::CellSolver::first_contact).
    ///
    /// # Errors
    /// [`EvidenceError::Path`] for a path that does not fit the robot.
    pub fn new(
        cell: &Cell,
        settings: &Settings,
        path: RecordedPath,
        answer: RecordedAnswer,
    ) -> Result<Self, EvidenceError> {
        Ok(Evidence {
            format: FORMAT.to_owned(),
            library: concat!("rigid-ccd ", env!("CARGO_PKG_VERSION")).to_owned(),
            settings: RecordedSettings {
                tolerance: settings.tolerance,
                margin: settings.margin,
                budget: settings.budget,
                deadline: settings.deadline.map(|deadline| deadline.as_secs_f64()),
                start: settings.start_policy,
            },
            bodies: bodies_at_start(cell, &path)?,
            path,
            answer,
            pairs_sha256: pairs_digest(cell, settings.margin),
        })
    }

    /// Returns the record as JSON. Every number reads back exactly.
    ///
    /// # Errors
    /// Never for a record of an answer, because its numbers are finite.
    pub fn to_json(&self) -> Result<String, EvidenceError> {
        Ok(serde_json::to_string_pretty(self)?)
    }

    /// Reads a record from JSON.
    ///
    /// # Errors
    /// [`EvidenceError::NoRecord`] and [`EvidenceError::OtherFormat`].
    pub fn from_json(text: &str) -> Result<Self, EvidenceError> {
        let record: Evidence = serde_json::from_str(text)?;
        if record.format == FORMAT {
            Ok(record)
        } else {
            Err(EvidenceError::OtherFormat(record.format))
        }
    }
}

/// Returns all bodies of a cell, at their poses at the start of a path.
fn bodies_at_start(cell: &Cell, path: &RecordedPath) -> Result<Vec<RecordedBody>, EvidenceError> {
    let start = path.start().ok_or(EvidenceError::EmptyPath)?;
    let placed = cell.placed_bodies(&start).map_err(EvidenceError::Path)?;
    let record = |(item, body, pose): (crate::cell::Item<'_>, _, Pose)| RecordedBody {
        item: item.name().to_owned(),
        sha256: body_digest(body),
        position: pose.translation().to_array(),
        orientation: pose.rotation().to_array(),
    };
    Ok(placed.into_iter().map(record).collect())
}

#[cfg(test)]
mod tests;
