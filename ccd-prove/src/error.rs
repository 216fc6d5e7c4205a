//! Why a certificate is not written.

use rigid_ccd_robot::RobotError;

/// No proof can be about a body: a piece of it has no triangles of a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{body} has pieces without triangles")]
pub struct NoMesh {
    /// The name of the body.
    pub body: String,
}

/// The reason why no certificate is written.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotProven {
    /// Two triangles are too near each other to be proven apart.
    #[error("two triangles cannot be proven apart, at time {at} or soon after")]
    Touching {
        /// The start of the stretch of time that is not proven.
        at: f64,
    },
    /// The certificate would be too long.
    #[error("the certificate has {bytes} bytes, and is not complete from time {at} on")]
    TooLong {
        /// The start of the stretch of time that is not proven.
        at: f64,
        /// The number of its bytes.
        bytes: usize,
    },
}

/// The reason why a path of a robot has no certificates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathNotProven {
    /// The path does not fit the robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A segment of the path cannot be proven.
    #[error("segment {segment}: {reason}")]
    Segment {
        /// The number of the segment.
        segment: usize,
        /// Why.
        reason: NotProven,
    },
}
