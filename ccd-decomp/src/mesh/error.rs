//! Errors of reading a mesh.

use crate::messages::{LFS_ADVICE, Prefix};
use ccd_core::limits::MAX_COORDINATE;
use std::fmt;
use std::io;
use std::path::PathBuf;

/// A mesh that cannot be read: the file, and the fault.
#[derive(Debug, thiserror::Error)]
#[error("{}{fault}", Prefix(.file))]
pub struct MeshError {
    /// The file, if the mesh came from one.
    pub file: Option<PathBuf>,
    /// The fault, with the line and element.
    pub fault: MeshFault,
}

/// The fault of a mesh. Lines count from 1, faces and vertices from 0, both in the file's order.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFault {
    /// The operating system does not give the bytes.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The path names a folder.
    #[error("is a folder; name a mesh in it, .obj, .stl, .ply or .off")]
    Folder,
    /// The file's extension names no known format.
    #[error("{}; use .obj, .stl, .ply or .off", Extension(.extension))]
    UnknownExtension {
        /// The text after the last dot; empty without a dot.
        extension: String,
    },
    /// The format is known, but this variant of it is not supported.
    #[error("holds {what}, which is not supported; export it as {instead}")]
    Unsupported {
        /// The unsupported content.
        what: String,
        /// The content that can be read instead.
        instead: &'static str,
    },
    /// The file is a pointer of Git LFS.
    #[error("{LFS_ADVICE}")]
    LfsPointer,
    /// The mesh has no vertices.
    #[error("has no vertices; is it a mesh, and all of it?")]
    NoVertices,
    /// The mesh has no faces.
    #[error("has no faces; export it as triangles or polygons, not as points or lines")]
    NoFaces,
    /// The content does not follow the format.
    #[error("{}{problem}; mend it or export the mesh again", Line(*.line))]
    Syntax {
        /// The line, in a text.
        line: Option<usize>,
        /// The text that was found, and the text that was expected.
        problem: String,
    },
    /// The file ends before the elements that it announces.
    #[error("ends before {missing} is complete; copy or export it again")]
    Truncated {
        /// The first missing element.
        missing: String,
    },
    /// A coordinate is NaN or infinite.
    #[error("{}vertex {vertex} is NaN or infinite; give it finite coordinates", Line(*.line))]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// The line, in a text.
        line: Option<usize>,
    },
    /// A coordinate is beyond the largest that is computed with.
    #[error("{}vertex {vertex} has a coordinate beyond ±{MAX_COORDINATE:e}; use a larger unit of length", Line(*.line))]
    TooLarge {
        /// The vertex.
        vertex: usize,
        /// The line, in a text.
        line: Option<usize>,
    },
    /// A face uses a vertex that does not exist.
    #[error("{}face {face} names vertex {vertex}, but there are {vertices}, numbered from {base}", Line(*.line))]
    NoSuchVertex {
        /// The face.
        face: usize,
        /// The line, in a text.
        line: Option<usize>,
        /// The vertex as the file writes it; a negative one of an OBJ counts back from the face.
        vertex: i64,
        /// The number of vertices.
        vertices: usize,
        /// The number that the format gives to the first vertex.
        base: u8,
    },
    /// A face has less than three corners.
    #[error("{}face {face} has {corners} corners; remove it or give it three", Line(*.line))]
    TooFewCorners {
        /// The face.
        face: usize,
        /// The line, in a text.
        line: Option<usize>,
        /// The number of its corners.
        corners: usize,
    },
    /// There are more elements than an index can name.
    #[error("{count} {what} are too many; split the mesh into several")]
    TooMany {
        /// The kind of elements.
        what: &'static str,
        /// The number of elements.
        count: usize,
    },
}

impl MeshFault {
    /// Makes a syntax error, and cuts long quotes of the file to a length that fits a message.
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

/// The most characters of a message about syntax.
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
