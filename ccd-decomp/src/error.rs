//! What can be wrong with a file, a mesh or the description of a body.

use crate::file::StoreError;
use crate::pieces::vhacd::VhacdError;
use crate::solid::crossings::Crossing;
use crate::solid::topology::{Edge, Topology};
use crate::tally::Tally;
use crate::tree::hull_tree::BuildError;
use ccd_core::tolerance::{LEAST_COORDINATE, MAX_COORDINATE};
use ccd_core::{HullTreeError, InputError};
use serde::{Deserialize, Serialize};
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

/// How a file begins that Git LFS has in the place of one that is not fetched yet.
const LFS_BEGINNING: &[u8] = b"version https://git-lfs";

/// What to do about it.
pub(crate) const LFS_ADVICE: &str = "is a Git LFS pointer, a few lines that stand for the file; run `git \
                                     lfs pull` to fetch the file itself";

/// Whether a file is but a pointer of Git LFS, told by how it begins.
pub(crate) fn is_lfs_pointer(bytes: &[u8]) -> bool {
    bytes.starts_with(LFS_BEGINNING)
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

/// Why a mesh cannot be decomposed exactly: it does not bound a solid. Faces, edges and vertices by
/// their numbers in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DecomposeError {
    /// Its edges do not have one face on either side.
    #[error("{topology}; {}, or use triangles", .topology.advice())]
    NotManifold {
        /// Which edges.
        topology: Box<Topology>,
    },
    /// Faces without area have no inner side.
    #[error("faces without area: {faces}; remove them, or use triangles")]
    NoArea {
        /// The faces.
        faces: Tally<u32>,
    },
    /// Faces meet that share no vertex or edge there.
    #[error("faces that intersect: {pairs}; mend them, or use triangles")]
    SelfIntersecting {
        /// The pairs of faces, a thousand at most: there may be more.
        pairs: Tally<Crossing>,
    },
    /// The solid is in front of a face, not behind it.
    #[error("the part with face {face} is inside out; turn its faces, or use triangles")]
    InsideOut {
        /// A face of the part.
        face: u32,
    },
    /// A part's volume is too small to tell its inside.
    #[error("the part with face {face} holds no volume to speak of; use triangles")]
    NoVolume {
        /// A face of the part.
        face: u32,
    },
    /// Every corner that was looked at is one of another part, too, so that what surrounds the part
    /// cannot be told.
    #[error(
        "the part with face {face} touches other parts at its corners; take the parts for themselves, or use triangles"
    )]
    Entangled {
        /// A face of the part.
        face: u32,
    },
    /// It is not convex.
    #[error("not convex at {edge}; use patches or triangles")]
    NotConvex {
        /// An edge at which the solid's angle is more than half a turn.
        edge: Edge,
    },
    /// It is not convex, as it is not in one part.
    #[error("{parts} parts, each of which may be convex; use patches or triangles")]
    NotInOnePart {
        /// How many parts.
        parts: u32,
    },
    /// Only as much may be spent as was allowed for, and that did not suffice to tell.
    #[error("use patches or a hull to have them however long it takes, or triangles")]
    TooLong,
    /// A coordinate is too near to 0 for exact computations.
    #[error("vertex {vertex} has a coordinate nearer to 0 than {LEAST_COORDINATE:e}; make it 0")]
    TooFine {
        /// The vertex.
        vertex: usize,
    },
}

/// A text that describes no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// Nothing was given.
    #[error("no body given; {EXAMPLES}")]
    Empty,
    /// The word before the colon is none of the shapes.
    #[error("there is no shape {shape:?}; {EXAMPLES}")]
    UnknownShape {
        /// The word.
        shape: String,
    },
    /// A shape needs another number of lengths.
    #[error("{shape:?} takes {expected} lengths, not {given}; {EXAMPLES}")]
    WrongCount {
        /// The shape.
        shape: &'static str,
        /// How many it takes.
        expected: usize,
        /// How many were given.
        given: usize,
    },
    /// A length is beyond what is computed with.
    #[error(
        "{length:?} is too large a length of {shape:?}: lengths are from 0 to {MAX_COORDINATE:e}; use a larger unit of length"
    )]
    TooLong {
        /// The shape.
        shape: &'static str,
        /// The text given for the length.
        length: String,
    },
    /// A length is not a finite number of at least 0.
    #[error(
        "{length:?} is not a length of {shape:?}: a number from 0 to {MAX_COORDINATE:e}; {EXAMPLES}"
    )]
    BadLength {
        /// The shape.
        shape: &'static str,
        /// The text given for the length.
        length: String,
    },
}

const EXAMPLES: &str = "use box:1,2,3 (half extents), sphere:0.5 (radius), capsule:0.2,1 (radius, \
                        half height) or a file such as part.obj";

/// Why there is no body.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// The description reads as no body.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The stored body cannot be read.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The mesh cannot be made into the pieces that were asked for.
    #[error(transparent)]
    Decompose(#[from] DecomposeError),
    /// The mesh cannot be approximated.
    #[error(transparent)]
    Vhacd(#[from] VhacdError),
    /// No hull tree can be built.
    #[error(transparent)]
    BuildHullTree(#[from] BuildError),
    /// A hull tree does not belong to the pieces.
    #[error(transparent)]
    HullTree(#[from] HullTreeError),
    /// The core does not take it.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Any of these, of the mesh in a file.
    #[error("{}: {error}", .file.display())]
    InFile {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        error: Box<BodyError>,
    },
}

pub(crate) struct Prefix<'a>(pub(crate) &'a Option<PathBuf>);

impl fmt::Display for Prefix<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(file) => write!(f, "{}: ", file.display()),
            None => Ok(()),
        }
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
