//! What can be wrong with a file that holds a mesh.

use crate::messages::{LFS_ADVICE, Prefix};
use ccd_core::tolerance::MAX_COORDINATE;
use std::fmt;
use std::io;
use std::path::PathBuf;

/// A mesh that could not be read: which file, and what is wrong with it where.
#[derive(Debug, thiserror::Error)]
#[error("{}{fault}", Prefix(.file))]
pub struct MeshError {
    /// The file, where the mesh came from one.
    pub file: Option<PathBuf>,
    /// What is wrong with it.
    pub fault: MeshFault,
}

/// What is wrong with a mesh. Lines count from 1, faces and vertices from 0, both in the file's
/// order.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFault {
    /// The operating system would not give the bytes.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// It is no file.
    #[error("is a folder; name a mesh in it, .obj, .stl, .ply or .off")]
    Folder,
    /// The file's name does not tell its format.
    #[error("{}; use .obj, .stl, .ply or .off", Extension(.extension))]
    UnknownExtension {
        /// What follows the last dot; empty when there is none.
        extension: String,
    },
    /// The format is known, but not this kind of it.
    #[error("holds {what}, which is not supported; export it as {instead}")]
    Unsupported {
        /// What the file holds.
        what: String,
        /// What can be read instead.
        instead: &'static str,
    },
    /// Git stands for it with a few lines.
    #[error("{LFS_ADVICE}")]
    LfsPointer,
    /// There is no vertex.
    #[error("has no vertices; is it a mesh, and all of it?")]
    NoVertices,
    /// There is no face.
    #[error("has no faces; export it as triangles or polygons, not as points or lines")]
    NoFaces,
    /// Something does not read as the format says.
    #[error("{}{problem}; mend it or export the mesh again", Line(*.line))]
    Syntax {
        /// Where.
        line: Option<usize>,
        /// What was found, and what was expected.
        problem: String,
    },
    /// The file ends before everything it announces is there.
    #[error("ends before {missing} is complete; copy or export it again")]
    Truncated {
        /// What is missing.
        missing: String,
    },
    /// A coordinate is NaN or infinite.
    #[error("{}vertex {vertex} is NaN or infinite; give it finite coordinates", Line(*.line))]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// Where, in a text.
        line: Option<usize>,
    },
    /// A coordinate is beyond what is computed with.
    #[error("{}vertex {vertex} has a coordinate beyond ±{MAX_COORDINATE:e}; use a larger unit of length", Line(*.line))]
    TooLarge {
        /// The vertex.
        vertex: usize,
        /// Where, in a text.
        line: Option<usize>,
    },
    /// A face names a vertex that does not exist.
    #[error("{}face {face} names vertex {vertex}, but there are {vertices}, numbered from {base}", Line(*.line))]
    NoSuchVertex {
        /// The face.
        face: usize,
        /// Where, in a text.
        line: Option<usize>,
        /// The vertex as the file names it; a negative one of an OBJ counts back from the face.
        vertex: i64,
        /// How many vertices there are.
        vertices: usize,
        /// The number that the format gives to the first vertex.
        base: u8,
    },
    /// A face has less than three corners.
    #[error("{}face {face} has {corners} corners; remove it or give it three", Line(*.line))]
    TooFewCorners {
        /// The face.
        face: usize,
        /// Where, in a text.
        line: Option<usize>,
        /// How many it has.
        corners: usize,
    },
    /// More than an index can name.
    #[error("{count} {what} are too many; split the mesh into several")]
    TooMany {
        /// Vertices or faces.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
}

impl MeshFault {
    /// A syntax error; what it quotes of the file is cut to a length that fits a message.
    pub(crate) fn syntax(line: Option<usize>, mut problem: String) -> Self {
        if let Some((end, _)) = problem.char_indices().nth(QUOTED) {
            problem.truncate(end);
            problem.push('…');
        }
        MeshFault::Syntax { line, problem }
    }

    pub(crate) fn in_file(self, file: impl Into<PathBuf>) -> MeshError {
        MeshError {
            file: Some(file.into()),
            fault: self,
        }
    }
}

/// Characters that a message about syntax may have.
const QUOTED: usize = 200;

impl From<MeshFault> for MeshError {
    fn from(fault: MeshFault) -> Self {
        MeshError { file: None, fault }
    }
}

struct Extension<'a>(&'a str);

impl fmt::Display for Extension<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            "" => write!(f, "has no extension, which tells the format of a mesh"),
            other => write!(f, "{other:?} is not the extension of a mesh"),
        }
    }
}

struct Line(Option<usize>);

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(line) => write!(f, "line {line}: "),
            None => Ok(()),
        }
    }
}
