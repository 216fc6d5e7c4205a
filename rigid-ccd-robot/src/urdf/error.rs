//! Errors of URDF and SRDF files.

use crate::error::RobotError;
use ccd_decomp::{MeshError, PrepareError};
use rigid_ccd::InputError;
use std::path::PathBuf;

/// The reason why a file is no robot, with the element.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UrdfError {
    /// A file cannot be read.
    #[error("{}: {error}", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// The reason.
        error: String,
    },
    /// A file is no URDF or SRDF.
    #[error("{}: {error}", file.display())]
    Syntax {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        error: String,
    },
    /// Something is wrong with a link.
    #[error("link `{link}`: {error}")]
    Link {
        /// The name of the link.
        link: String,
        /// The reason.
        error: Box<UrdfError>,
    },
    /// Something is wrong with a joint.
    #[error("joint `{joint}`: {error}")]
    Joint {
        /// The name of the joint.
        joint: String,
        /// The reason.
        error: Box<UrdfError>,
    },
    /// A joint is of a kind that is not supported.
    #[error("a {kind} joint is not supported; use revolute, continuous, prismatic or fixed joints")]
    JointType {
        /// The kind of the joint, as in the file.
        kind: String,
    },
    /// A package or a file of a mesh was not found.
    #[error("`{uri}` is not found; looked for {}", tried.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", "))]
    MeshNotFound {
        /// The name of the mesh in the URDF.
        uri: String,
        /// The paths where it was looked for.
        tried: Vec<PathBuf>,
    },
    /// A mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// No body can be made of a mesh.
    #[error("{}: {error}", file.display())]
    Prepare {
        /// The file of the mesh.
        file: PathBuf,
        /// The reason.
        error: PrepareError,
    },
    /// A shape, a pose or an axis is not valid.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The links and joints are no robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
}

impl UrdfError {
    /// Names the link where the error is.
    pub(super) fn of_link(self, link: &str) -> Self {
        UrdfError::Link {
            link: link.to_owned(),
            error: Box::new(self),
        }
    }

    /// Names the joint where the error is.
    pub(super) fn of_joint(self, joint: &str) -> Self {
        UrdfError::Joint {
            joint: joint.to_owned(),
            error: Box::new(self),
        }
    }
}
