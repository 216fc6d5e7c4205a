//! Errors of robots: links and joints that form no tree, and positions that do not fit a robot.

use crate::path_point::PathPoint;
use ccd_core::limits::MAX_COORDINATE;
use rigid_ccd::{InputError, Pose};

/// The reason why links and joints form no robot, or why a configuration does not fit a robot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// A link, an attached body or an obstacle has the name already.
    #[error("there is already a link, an attached body or an obstacle named `{name}`")]
    NameTaken {
        /// The name that is given twice.
        name: String,
    },
    /// Two things in a cell are never compared: both are obstacles, or they are the same.
    #[error("`{a}` and `{b}` are never compared")]
    NeverCompared {
        /// The name of the first one.
        a: String,
        /// The name of the second one.
        b: String,
    },
    /// Pairs of links that are checked are not of the robot with which they are given.
    #[error("the pairs of links given with robot `{robot}` are of another robot")]
    PairsOfAnotherRobot {
        /// The name of the robot.
        robot: String,
    },
    /// An attached body or an obstacle has the empty text as its name.
    #[error("an attached body or an obstacle needs a name that is not empty")]
    EmptyName,
    /// Nothing in the cell has the given name.
    #[error("there is no link, attached body or obstacle `{name}`")]
    NoSuchItem {
        /// The name that nothing has.
        name: String,
    },
    /// No obstacle of the cell has the given name.
    #[error("there is no obstacle `{name}`")]
    NoSuchObstacle {
        /// The name that no obstacle has.
        name: String,
    },
    /// No body with the given name is attached to a link.
    #[error("there is no attached body `{name}`")]
    NoSuchAttachedBody {
        /// The name that no attached body has.
        name: String,
    },
    /// The robot has no links; it needs at least its base.
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
    /// No link of the robot has the given name.
    #[error("there is no link `{link}`")]
    NoSuchLink {
        /// The name that no link has.
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
    /// Several links are the child of no joint, so that the tree has several parts.
    #[error("links `{first_base}` and `{second_base}` both hang on no joint; a robot has one base")]
    TwoBases {
        /// The name of the first base.
        first_base: String,
        /// The name of the second base.
        second_base: String,
    },
    /// A link is the parent and the child of no joint, though the robot has joints.
    #[error(
        "link `{link}` has no joint, and a robot has one base, `{base}`; is it the name of the link that was meant?"
    )]
    LinkWithoutJoint {
        /// The name of the link.
        link: String,
        /// The name of the base.
        base: String,
    },
    /// The lower limit of a joint is above the upper one, or one of them is not a number.
    #[error("joint `{joint}`: its limits are {low} and {high}; give the lower one first")]
    InvalidLimits {
        /// The name of the joint.
        joint: String,
        /// The lower limit.
        low: f64,
        /// The upper limit.
        high: f64,
    },
    /// A joint is [reversed](rigid_ccd::trajectory::Joint::reversed).
    #[error("joint `{joint}` is reversed; exchange its parent and its child instead")]
    ReversedJoint {
        /// The name of the joint.
        joint: String,
    },
    /// A joint moves a link with a plane. Such a half-space would be everywhere at once.
    #[error("link `{link}` has a plane, and a joint moves it; only a link at rest has planes")]
    MovingPlane {
        /// The name of the link with the plane.
        link: String,
    },
    /// Joints form a loop.
    #[error("link `{link}` is in a loop of joints; loops are no tree")]
    Loop {
        /// The name of a link in the loop.
        link: String,
    },
    /// A joint follows another joint that does not exist.
    #[error("joint `{joint}` follows `{followed_joint}`, but there is no such joint")]
    NoSuchMimicJoint {
        /// The name of the joint that was to follow another joint.
        joint: String,
        /// The name that no joint has.
        followed_joint: String,
    },
    /// A joint follows another joint that has no position, or follows the first joint in turn.
    #[error("joint `{joint}` follows `{followed_joint}`, which has no position of its own")]
    InvalidMimicJoint {
        /// The name of the joint that was to follow another joint.
        joint: String,
        /// The name of the joint that was to be followed.
        followed_joint: String,
    },
    /// A configuration does not have exactly one position for each joint with a position of its own.
    #[error("{given_count} positions for {expected_count} joints: {joint_names}")]
    WrongPositionCount {
        /// The number of positions in the configuration.
        given_count: usize,
        /// The number of joints with a position of their own: those that are neither fixed nor follow another joint.
        expected_count: usize,
        /// The names of the joints with a position of their own, separated by commas.
        joint_names: String,
    },
    /// A position is outside of its joint's limits or not finite, or the rule of a joint that follows another one is not.
    #[error("joint `{joint}`: {error}")]
    InvalidPosition {
        /// The name of the joint whose position is refused.
        joint: String,
        /// The reason why the position is refused.
        error: InputError,
    },
    /// A joint, a body of a link, an attached body or an obstacle is too far from the frame that it is in.
    #[error(
        "{what} `{name}` has a coordinate of {coordinate}; coordinates are within {MAX_COORDINATE:e} of 0"
    )]
    TooFar {
        /// What it is.
        what: &'static str,
        /// The name of the joint, the link, the body or the obstacle.
        name: String,
        /// The coordinate.
        coordinate: f64,
    },
    /// A pose or a motion is not valid.
    #[error(transparent)]
    Input(#[from] InputError),
}

impl RobotError {
    /// Refuses a pose that is too far from the origin of its frame.
    pub(crate) fn check_pose(what: &'static str, name: &str, pose: &Pose) -> Result<(), Self> {
        let coordinates = pose.translation().to_array();
        match coordinates
            .into_iter()
            .find(|own| !(own.abs() <= MAX_COORDINATE))
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

/// The error of a question about a cell of which no pair is compared: whatever its answer, it would be about nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "nothing is compared in this cell: {checked}; an obstacle is compared with links that have bodies and move, and a clearance \
     between two links checks them"
)]
pub struct NothingCompared {
    /// What is checked and what is left out, by [`CheckSummary`](crate::CheckSummary).
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
        /// The number of the configuration, from 0.
        configuration_index: usize,
        /// The reason why it does not fit.
        error: RobotError,
    },
    /// A curve has another number of joints than the robot, or a joint leaves its limits on it.
    #[error("segment {}, after {} of it: {error}", .at.segment, .at.share)]
    InvalidCurvePoint {
        /// Where on the curve.
        at: PathPoint,
        /// What is wrong there.
        error: RobotError,
    },
    /// Joints slide so far that a body may leave the place in which a plane is certain to have no end.
    #[error(
        "a body may get {distance} from the base, and planes end {reach} from it; give the joints that slide limits"
    )]
    BeyondPlane {
        /// A bound of how far any body gets from the base on the path.
        distance: f64,
        /// How far from the base planes are certain to have no end.
        reach: f64,
    },
    /// A joint that follows another one by a large factor jumps.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A number of the [`RangeSettings`](crate::RangeSettings) is out of its range.
    #[error("{name}: {value} is not {allowed}")]
    InvalidRangeSetting {
        /// The name of the number.
        name: &'static str,
        /// The number.
        value: f64,
        /// The values that are allowed.
        allowed: &'static str,
    },
    /// No pair of the cell is compared.
    #[error(transparent)]
    NothingCompared(#[from] NothingCompared),
    /// A question does not take a setting.
    #[error("this question does not take {setting}")]
    UnsupportedSetting {
        /// The setting, and which questions take it.
        setting: &'static str,
    },
    /// An answer about a distance was asked for its contact.
    #[error("the answer is a distance, which knows no margin: ask for a contact")]
    NoContactAsked,
    /// A question is none about paths.
    #[error("{question} is no question about a path")]
    UnsupportedQuestion {
        /// The question.
        question: rigid_ccd::Question,
    },
    /// A query is invalid, or reached a limit.
    #[error(transparent)]
    Query(#[from] rigid_ccd::Error),
}

/// The reason why polynomials form no [`JointCurve`](crate::JointCurve).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// A curve needs at least two times.
    #[error("a curve needs at least two times, not {count}")]
    TooFewTimes {
        /// The number of times.
        count: usize,
    },
    /// The end of a segment is not after its start.
    #[error("the times of segment {segment} do not increase, or are not finite")]
    TimesNotIncreasing {
        /// The number of the segment.
        segment: usize,
    },
    /// There are more or fewer segments, configurations or joints than needed.
    #[error("{given} {what} instead of {expected}, at {index}")]
    WrongCount {
        /// What is counted.
        what: &'static str,
        /// The number of the segment or of the configuration.
        index: usize,
        /// The number given.
        given: usize,
        /// The number needed.
        expected: usize,
    },
    /// The degree of a polynomial is too high.
    #[error("a polynomial has the degree {degree}; at most 9 is supported")]
    DegreeTooHigh {
        /// The degree.
        degree: usize,
    },
    /// A coefficient of a polynomial is not finite.
    #[error("segment {segment}: a coefficient of joint {joint} is not finite")]
    NotFinite {
        /// The number of the segment.
        segment: usize,
        /// The number of the joint in a configuration.
        joint: usize,
    },
    /// A joint is elsewhere at the start of a segment than at the end of the one before.
    #[error("joint {joint} jumps by {jump} at the start of segment {segment}")]
    Jump {
        /// The number of the segment.
        segment: usize,
        /// The number of the joint in a configuration.
        joint: usize,
        /// The size of the jump.
        jump: f64,
    },
}
