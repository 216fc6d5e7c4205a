//! Errors of robots, cells and paths.

use crate::path_point::PathPoint;
use ccd_core::limits::MAX_COORDINATE;
use rigid_ccd::{InputError, Pose};

/// The reason why links and joints do not make a robot, or why an input does not fit a robot or cell.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// The name is already in use by a link, an attached body or an obstacle.
    #[error("there is already a link, an attached body or an obstacle named `{name}`")]
    NameTaken {
        /// The name.
        name: String,
    },
    /// A pair of items can never be checked: both are obstacles, no joint moves one relative to the other, or they are
    /// the same item.
    #[error("`{a}` and `{b}` are never compared")]
    NeverCompared {
        /// The name of the first item.
        a: String,
        /// The name of the second item.
        b: String,
    },
    /// The pairs of a [`PlacedRobot`](crate::PlacedRobot) belong to another robot.
    #[error("the pairs of links for robot `{robot}` belong to another robot")]
    PairsOfAnotherRobot {
        /// The name of the robot.
        robot: String,
    },
    /// The name of an attached body or obstacle is empty.
    #[error("an attached body or an obstacle needs a name that is not empty")]
    EmptyName,
    /// The cell has no item with this name.
    #[error("there is no link, attached body or obstacle `{name}`")]
    NoSuchItem {
        /// The unknown name.
        name: String,
    },
    /// The cell has no obstacle with this name.
    #[error("there is no obstacle `{name}`")]
    NoSuchObstacle {
        /// The unknown name.
        name: String,
    },
    /// The cell has no attached body with this name.
    #[error("there is no attached body `{name}`")]
    NoSuchAttachedBody {
        /// The unknown name.
        name: String,
    },
    /// The robot has no links. It needs at least its base.
    #[error("the robot has no links")]
    NoLinks,
    /// Two links have the same name.
    #[error("two links are named `{link}`")]
    LinkNameTaken {
        /// The name of both links.
        link: String,
    },
    /// Two joints have the same name.
    #[error("two joints are named `{joint}`")]
    JointNameTaken {
        /// The name of both joints.
        joint: String,
    },
    /// The robot has no link with this name.
    #[error("there is no link `{link}`")]
    NoSuchLink {
        /// The unknown name.
        link: String,
    },
    /// A link is the child of two joints.
    #[error("link `{link}` is the child of joint `{joint}` and of another one")]
    TwoParents {
        /// The name of the link with two parents.
        link: String,
        /// The name of the second joint that has the link as its child.
        joint: String,
    },
    /// Several links are not the child of any joint, so the robot is not one tree.
    #[error(
        "links `{first_base}` and `{second_base}` are both children of no joint; a robot has one base"
    )]
    TwoBases {
        /// The name of one base.
        first_base: String,
        /// The name of another base.
        second_base: String,
    },
    /// A link is neither the parent nor the child of a joint, although the robot has joints.
    #[error(
        "link `{link}` has no joint, but only the base `{base}` may have no parent; is the link's name misspelt in a joint?"
    )]
    LinkWithoutJoint {
        /// The name of the link.
        link: String,
        /// The name of the base.
        base: String,
    },
    /// The lower limit of a joint is above the upper one, or a limit is NaN.
    #[error("joint `{joint}`: its limits are {low} and {high}; give the lower one first")]
    InvalidLimits {
        /// The name of the joint.
        joint: String,
        /// The lower limit.
        low: f64,
        /// The upper limit.
        high: f64,
    },
    /// The joint is [reversed](rigid_ccd::trajectory::Joint::reversed).
    #[error("joint `{joint}` is reversed; exchange its parent and its child instead")]
    ReversedJoint {
        /// The name of the joint.
        joint: String,
    },
    /// A joint moves a link that has a plane. Planes must be static.
    #[error("link `{link}` has a plane, and a joint moves it; only a static link may have planes")]
    MovingPlane {
        /// The name of the link with the plane.
        link: String,
    },
    /// Joints form a loop, so the robot is not a tree.
    #[error("link `{link}` is in a loop of joints; a robot is a tree, without loops")]
    Loop {
        /// The name of a link in the loop.
        link: String,
    },
    /// A joint follows a joint that does not exist.
    #[error("joint `{joint}` follows `{followed_joint}`, but there is no such joint")]
    NoSuchMimicJoint {
        /// The name of the joint that follows.
        joint: String,
        /// The unknown name.
        followed_joint: String,
    },
    /// A joint follows a fixed joint, or a joint that directly or indirectly follows itself.
    #[error("joint `{joint}` follows `{followed_joint}`, which is fixed or follows itself")]
    InvalidMimicJoint {
        /// The name of the joint that follows.
        joint: String,
        /// The name of the followed joint.
        followed_joint: String,
    },
    /// A configuration has the wrong number of positions. It needs one for each independent joint.
    #[error("{given_count} positions for {expected_count} joints: {joint_names}")]
    WrongPositionCount {
        /// The number of positions in the configuration.
        given_count: usize,
        /// The number of independent joints: all joints except fixed joints and joints that follow another one.
        expected_count: usize,
        /// The names of the independent joints, separated by commas.
        joint_names: String,
    },
    /// A position is outside its joint's limits or not finite, or the multiplier or offset of a mimic joint is not
    /// finite.
    #[error("joint `{joint}`: {error}")]
    InvalidPosition {
        /// The name of the joint.
        joint: String,
        /// The reason.
        error: InputError,
    },
    /// A joint, body, plane or obstacle is too far from the origin of its frame.
    #[error(
        "{what} `{name}` has a coordinate of {coordinate}; coordinates are within {MAX_COORDINATE:e} of 0"
    )]
    TooFar {
        /// The kind of the element, such as `joint`.
        what: &'static str,
        /// The name of the element, or of the link that it belongs to.
        name: String,
        /// The coordinate.
        coordinate: f64,
    },
    /// A pose or a motion is not valid.
    #[error(transparent)]
    Input(#[from] InputError),
}

impl RobotError {
    /// Checks that a pose is not too far from the origin of its frame.
    pub(crate) fn check_pose(what: &'static str, name: &str, pose: &Pose) -> Result<(), Self> {
        let coordinates = pose.translation().to_array();
        match coordinates
            .into_iter()
            .find(|coordinate| !(coordinate.abs() <= MAX_COORDINATE))
        {
            None => Ok(()),
            Some(coordinate) => Err(RobotError::TooFar {
                what,
                name: name.to_owned(),
                coordinate,
            }),
        }
    }
}

/// The error of a question about a cell in which no pair is checked. An answer would be meaningless.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "nothing is compared in this cell: {checked}; obstacles are compared with moving links that have bodies, and a clearance \
     includes a pair of links"
)]
pub struct NothingCompared {
    /// The text of the [`CheckSummary`](crate::CheckSummary).
    pub checked: String,
}

/// The error of a question about a path.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// The path has no configuration.
    #[error("the path has no configuration")]
    EmptyPath,
    /// A configuration does not fit the robot.
    #[error("configuration {configuration_index} of the path: {error}")]
    InvalidConfiguration {
        /// The index of the configuration.
        configuration_index: usize,
        /// The reason.
        error: RobotError,
    },
    /// A curve has the wrong number of joints, or a joint leaves its limits on the curve.
    #[error("segment {}, after {} of it: {error}", .at.segment, .at.fraction)]
    InvalidCurvePoint {
        /// The point of the curve.
        at: PathPoint,
        /// The reason.
        error: RobotError,
    },
    /// Prismatic joints may move a body beyond the distance from the base within which a plane's box acts as a
    /// half-space.
    #[error(
        "a body may be up to {distance} from the base, beyond the reach {reach} of the planes; limit the prismatic joints"
    )]
    BeyondPlane {
        /// An upper bound of the distance of any body from the base on the path.
        distance: f64,
        /// The distance from the base up to which planes are valid.
        reach: f64,
    },
    /// A mimic joint jumps, because its multiplier enlarges a small jump of the joint that it follows.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A range setting is out of its range.
    #[error("{name}: {value} is not {allowed}")]
    InvalidRangeSetting {
        /// The name of the setting.
        name: &'static str,
        /// The value.
        value: f64,
        /// The allowed values.
        allowed: &'static str,
    },
    /// No pair of the cell is checked.
    #[error(transparent)]
    NothingCompared(#[from] NothingCompared),
    /// The question does not support a setting.
    #[error("this question does not take {setting}")]
    UnsupportedSetting {
        /// The setting, and which questions support it.
        setting: &'static str,
    },
    /// The contact of an answer about a distance was requested.
    #[error("the answer is a distance and has no contact; ask for the first or any contact")]
    NoContactAsked,
    /// The question cannot be asked about a path.
    #[error("{question} cannot be asked about a path")]
    UnsupportedQuestion {
        /// The question.
        question: rigid_ccd::Question,
    },
    /// A query is invalid or reached a limit.
    #[error(transparent)]
    Query(#[from] rigid_ccd::Error),
}

/// The reason why polynomials do not make a [`JointCurve`](crate::JointCurve).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// The curve has fewer than two times.
    #[error("a curve needs at least two times, not {count}")]
    TooFewTimes {
        /// The number of times.
        count: usize,
    },
    /// The end time of a segment is not after its start time.
    #[error("the times of segment {segment} do not increase, or are not finite")]
    TimesNotIncreasing {
        /// The index of the segment.
        segment: usize,
    },
    /// The number of segments, configurations or joints does not match.
    #[error("{given} {what} instead of {expected}, at index {index}")]
    WrongCount {
        /// The kind of the counted objects.
        what: &'static str,
        /// The index of the segment or configuration.
        index: usize,
        /// The given number.
        given: usize,
        /// The expected number.
        expected: usize,
    },
    /// The degree of a polynomial is too high.
    #[error("a polynomial has the degree {degree}; at most 9 is supported")]
    DegreeTooHigh {
        /// The degree.
        degree: usize,
    },
    /// A coefficient is not finite.
    #[error("segment {segment}: a coefficient of joint {joint} is not finite")]
    NotFinite {
        /// The index of the segment.
        segment: usize,
        /// The index of the joint's position in a configuration.
        joint: usize,
    },
    /// The position of a joint at the start of a segment differs from its position at the end of the previous segment.
    #[error("joint {joint} jumps by {jump} at the start of segment {segment}")]
    Jump {
        /// The index of the segment.
        segment: usize,
        /// The index of the joint's position in a configuration.
        joint: usize,
        /// The difference.
        jump: f64,
    },
}
