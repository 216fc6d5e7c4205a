//! Why a certificate is not written.

use rigid_ccd_robot::{NothingCompared, RobotError};

/// No proof can be about a body: a piece of it has no triangles of a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{body} has pieces without triangles; prepare it with exact meshes")]
pub struct NoMesh {
    /// The name of the body.
    pub body: String,
}

/// The reason why the bodies of a cell are not prepared for proofs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CellNotProvable {
    /// A body has pieces without triangles.
    #[error(transparent)]
    NoMesh(#[from] NoMesh),
    /// No pair of bodies is compared: a proof would be about nothing.
    #[error(transparent)]
    NothingCompared(#[from] NothingCompared),
}

/// The reason why no certificate is written.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotProven {
    /// Two triangles are too near each other to be proven apart.
    #[error(
        "two triangles cannot be proven apart, at time {at} or soon after; a proof needs a gap of some 1e-12 of the largest \
         length, and a larger tolerance leaves a larger one"
    )]
    Touching {
        /// The start of the stretch of time that is not proven.
        at: f64,
    },
    /// The certificate would be too long.
    #[error(
        "the certificate has {bytes} bytes, and is not complete from time {at} on; a larger tolerance makes it shorter"
    )]
    TooLong {
        /// The start of the stretch of time that is not proven.
        at: f64,
        /// The number of its bytes.
        bytes: usize,
    },
    /// The points of a witness are too far from each other, or not on the bodies.
    #[error("the points of a contact are {distance} apart, more than the margin and the tolerance")]
    NoContact {
        /// The distance of the points of the meshes.
        distance: f64,
    },
    /// Another thread has set the flag that stops the work.
    #[error("the proof is not complete from time {at} on: it was stopped")]
    Stopped {
        /// The start of the stretch of time that is not proven.
        at: f64,
    },
    /// A link moves by numbers that cannot be scaled by a power of two.
    #[error(
        "link {link} moves by numbers so small that they have fewer bits than others, near 1e-308"
    )]
    TooSmall {
        /// The number of the link, counted from 1.
        link: usize,
    },
    /// A link turns farther than the checker takes.
    #[error(
        "link {link} turns by more than the checker takes: 256 radians to its start, or at least 128 from there"
    )]
    TurnsTooFar {
        /// The number of the link, counted from 1.
        link: usize,
    },
}

/// The reason why a path of a robot has no certificates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathNotProven {
    /// The path does not fit the robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The answer is to another question than that about the first contact.
    #[error("the answer is not one about the first contact: only such are proven")]
    NoFirstContact,
    /// A segment of the path cannot be proven.
    #[error("segment {segment}: {reason}")]
    Segment {
        /// The number of the segment.
        segment: usize,
        /// Why.
        reason: NotProven,
    },
}
