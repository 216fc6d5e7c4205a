//! The reasons why a certificate is not written.

use rigid_ccd_robot::{NothingCompared, RobotError};

/// A body that no proof can be about, because one of its pieces has no mesh triangles.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no proof can be about {body}, because some of its pieces have no mesh triangles; create the body from a mesh, with exact pieces"
)]
pub struct NoMesh {
    /// The name of the body.
    pub body: String,
}

/// The reason why the bodies of a cell cannot be prepared for proofs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CellNotProvable {
    /// A body has pieces without mesh triangles.
    #[error(transparent)]
    NoMesh(#[from] NoMesh),
    /// No pair of bodies is compared, so there is nothing to prove.
    #[error(transparent)]
    NothingCompared(#[from] NothingCompared),
}

/// The reason why no certificate is written.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotProven {
    /// The distance of two triangles is too small for a proof.
    #[error(
        "two triangles cannot be proven apart at time {at} or soon after; their gap has to be at least about 1e-12 of the largest length, \
         and a larger tolerance makes it larger"
    )]
    Touching {
        /// The time until which the certificate is complete.
        at: f64,
    },
    /// The certificate would exceed the maximum length.
    #[error(
        "the certificate already has {bytes} bytes and is complete only until time {at}; a larger tolerance makes it shorter"
    )]
    TooLong {
        /// The time until which the certificate is complete.
        at: f64,
        /// The number of bytes so far.
        bytes: usize,
    },
    /// The points of a witness are too far apart, or are not on the bodies.
    #[error(
        "the points of a contact are {distance} apart, which is more than the margin plus the tolerance"
    )]
    NoContact {
        /// The distance between the nearest points of the meshes.
        distance: f64,
    },
    /// Another thread has set the stop flag.
    #[error("the proof was stopped, and is complete only until time {at}")]
    Stopped {
        /// The time until which the certificate is complete.
        at: f64,
    },
    /// The motion of a link has a number so small that scaling it by a power of two loses bits.
    #[error(
        "the motion of link {link} has a number near 1e-308, which is too small for a certificate"
    )]
    TooSmall {
        /// The link, where 1 is the first one.
        link: usize,
    },
    /// A joint angle exceeds the checker's limit.
    #[error(
        "link {link} rotates too far for the checker: the limit is 256 radians at the start, and at least 128 radians during the motion"
    )]
    RotationTooLarge {
        /// The link, where 1 is the first one.
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
    /// The answer is to another question than the first contact.
    #[error("the answer is not about the first contact; only such an answer can be proven")]
    NoFirstContact,
    /// A segment of the path cannot be proven.
    #[error("segment {segment}: {reason}")]
    Segment {
        /// The index of the segment.
        segment: usize,
        /// The reason why it cannot be proven.
        reason: NotProven,
    },
}
