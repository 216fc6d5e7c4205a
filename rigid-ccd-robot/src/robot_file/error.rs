//! Errors of URDF, MJCF and SRDF files.

use super::mjcf_error::MjcfError;
use super::urdf_error::UrdfError;
use crate::error::RobotError;
use crate::srdf::SrdfError;
use ccd_decomp::{MeshError, PrepareError};
use rigid_ccd::InputError;
use std::path::PathBuf;

/// The reason why a robot cannot be read, with the file, link or joint that causes it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RobotFileError {
    /// A file cannot be read.
    #[error("{}: {error}", file.display())]
    Unreadable {
        /// The file that cannot be read.
        file: PathBuf,
        /// The operating system's message.
        error: String,
    },
    /// A file is not valid XML.
    #[error("{}: {error}", file.display())]
    Syntax {
        /// The file in which the parser found an error.
        file: PathBuf,
        /// The parser's message.
        error: String,
    },
    /// An error occurred in a link, a joint, or a geom of an MJCF.
    #[error("{kind} `{name}`: {error}")]
    Within {
        /// The kind of the element: `link`, `joint` or `geom`.
        kind: &'static str,
        /// The name of the element. A geom without a name has its index in its body.
        name: String,
        /// The error in the element.
        error: Box<RobotFileError>,
    },
    /// An element of an MJCF cannot be read.
    #[error(transparent)]
    Mjcf(#[from] MjcfError),
    /// An element of a URDF cannot be read.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// An SRDF cannot be read, or belongs to another robot.
    #[error("{}: {error}", file.display())]
    Srdf {
        /// The file.
        file: PathBuf,
        /// The reason.
        error: SrdfError,
    },
    /// A package folder does not exist.
    #[error("there is no folder {} to search for packages", folder.display())]
    NoFolder {
        /// The path of the folder.
        folder: PathBuf,
    },
    /// A floating, planar or spherical joint has a `mimic`.
    #[error("only a joint with one degree of freedom can mimic another one")]
    CompoundMimic,
    /// A mesh file is not at any of the paths that its name may refer to.
    #[error("`{uri}` is not found; looked for {}", searched_paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", "))]
    MeshNotFound {
        /// The name of the mesh in the robot's file: a file name, or a `package://` URI.
        uri: String,
        /// The paths that were searched, in order.
        searched_paths: Vec<PathBuf>,
    },
    /// A mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh cannot be converted to a body.
    #[error("{}: {error}", file.display())]
    Prepare {
        /// The path of the mesh file.
        file: PathBuf,
        /// The reason.
        error: PrepareError,
    },
    /// A shape, a pose or an axis is not valid.
    #[error(transparent)]
    InvalidElement(#[from] InputError),
    /// The links and joints do not make a robot, for example because of a loop.
    #[error(transparent)]
    Robot(#[from] RobotError),
}

impl RobotFileError {
    /// Adds the kind and the name of the element in which the error occurred.
    pub(super) fn within(self, kind: &'static str, name: &str) -> Self {
        RobotFileError::Within {
            kind,
            name: name.to_owned(),
            error: Box::new(self),
        }
    }
}
