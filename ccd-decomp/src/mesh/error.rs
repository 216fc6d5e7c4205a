//! Errors of reading a mesh file, due to its content, its size or its format.

use crate::messages::{FileError, HTML_ADVICE, LFS_ADVICE};
use ccd_core::limits::MAX_COORDINATE;
use std::io;

/// The error of reading a mesh: the file, and its fault, which names the line and the element.
pub type MeshError = FileError<MeshFault>;

/// The reason why a mesh cannot be read. Lines are numbered from 1; faces and vertices from 0, both in the file's
/// order.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFault {
    /// The operating system reported an error when the file was read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The path leads to a folder, not to a file.
    #[error("is a folder; name a mesh in it, such as a .glb, .obj, .stl, .ply or .off")]
    Folder,
    /// The file's extension is not that of a known format.
    #[error("{}", file_extension_advice(.extension))]
    UnknownExtension {
        /// The file extension after the last dot; empty without a dot.
        extension: String,
    },
    /// The format is known, but this variant of it is not supported.
    #[error("holds {unsupported_content}, which is not supported; export it as {alternative}")]
    UnsupportedContent {
        /// The content that is not supported, as a noun phrase for the message.
        unsupported_content: String,
        /// The content to export instead, which is supported.
        alternative: &'static str,
    },
    /// The file is a STEP file, but has the extension of a mesh format.
    #[error("is a STEP file, whatever its name says: {}", cad_advice("step"))]
    StepFile,
    /// The file is a page of HTML, but has the extension of a mesh format.
    #[error("{HTML_ADVICE}")]
    Html,
    /// The format is known, but this build has no reader for it.
    #[error(
        "is {format}, which this build cannot read; build it with the feature {cargo_feature:?}"
    )]
    MissingFeature {
        /// The name of the format.
        format: &'static str,
        /// The Cargo feature of this crate that enables the reader.
        cargo_feature: &'static str,
    },
    /// A file that the mesh refers to, such as a buffer of a glTF, cannot be read.
    #[error("refers to the file {referenced_file_name:?}, which cannot be read: {reason}")]
    UnreadableLinkedFile {
        /// The name of the referenced file, as written in the mesh.
        referenced_file_name: String,
        /// The reason why the file cannot be read, and the remedy.
        reason: String,
    },
    /// One element of a scene has a fault.
    #[error("{element}: {fault}")]
    AtElement {
        /// The element that has the fault, such as a node or a mesh.
        element: String,
        /// What is wrong with the element.
        fault: Box<MeshFault>,
    },
    /// The file has no part of the requested name or number.
    #[error("has no part {part:?}; {}", list_of_parts(.part_names))]
    NoSuchPart {
        /// The name or number that was requested.
        part: String,
        /// The names of all parts of the file, in order; `None` for a part without a name.
        part_names: Vec<Option<String>>,
    },
    /// Several parts of the file have the requested name.
    #[error("has {} parts {part:?}; give the number of one: {}", .part_numbers.len(), list_of_numbers(.part_numbers))]
    AmbiguousPart {
        /// The name that was requested.
        part: String,
        /// The numbers of the parts with this name, from 0.
        part_numbers: Vec<usize>,
    },
    /// Repeated references expand a small file to more triangles than its size allows.
    #[error(
        "repeats the same vertices and faces too often for its size, by instances or by naming them again: more than about {} triangles come of it; choose one of its parts, or split it", .limit / 3
    )]
    TooManyRepeats {
        /// The limit for a file of this size, in corners of faces.
        limit: u64,
    },
    /// The file is a Git LFS pointer, not the mesh itself.
    #[error("{LFS_ADVICE}")]
    LfsPointer,
    /// The file was read, but contains no vertices: it may be cut off, or not be a mesh.
    #[error("has no vertices; is it a mesh, and all of it?")]
    NoVertices,
    /// The mesh has no faces.
    #[error("has no faces; export it as triangles or polygons, not as points or lines")]
    NoFaces,
    /// The content does not follow the format.
    #[error("{}{problem}; mend it or export the mesh again", line_prefix(*.line))]
    Syntax {
        /// The line number, if the format is text.
        line: Option<usize>,
        /// The description of the fault: what was found, and what was expected.
        problem: String,
    },
    /// The file ends before the elements that it announces.
    #[error("ends before {missing_element} is complete; copy or export it again")]
    Truncated {
        /// The first element that is missing from the file.
        missing_element: String,
    },
    /// A coordinate is NaN or infinite.
    #[error("{}vertex {vertex} is NaN or infinite; give it finite coordinates", line_prefix(*.line))]
    NotFinite {
        /// The number of the vertex.
        vertex: usize,
        /// The line number of the vertex, if the format is text.
        line: Option<usize>,
    },
    /// A coordinate exceeds the supported range.
    #[error("{}vertex {vertex} has a coordinate beyond ±{MAX_COORDINATE:e}; use a larger unit of length", line_prefix(*.line))]
    CoordinateTooLarge {
        /// The number of the vertex.
        vertex: usize,
        /// The line number of the vertex, if the format is text.
        line: Option<usize>,
    },
    /// A face has a vertex number that does not exist.
    #[error("{}face {face} names vertex {vertex}, but there are {vertices}, numbered from {first_vertex_number}", line_prefix(*.line))]
    NoSuchVertex {
        /// The number of the face.
        face: usize,
        /// The line number of the face, if the format is text.
        line: Option<usize>,
        /// The vertex number as the file writes it. A negative number in an OBJ counts back from the face.
        vertex: i64,
        /// The number of vertices in the file.
        vertices: usize,
        /// The number that the format gives to the first vertex.
        first_vertex_number: u8,
    },
    /// A face has fewer than three corners.
    #[error("{}face {face} has {corners} corners; remove it or give it three", line_prefix(*.line))]
    TooFewCorners {
        /// The number of the face.
        face: usize,
        /// The line number of the face, if the format is text.
        line: Option<usize>,
        /// The number of corners of the face.
        corners: usize,
    },
    /// There are more elements than an index can address.
    #[error("{element_count} {element_kind} are too many; split the mesh into several")]
    TooManyElements {
        /// The kind of elements, in the plural, such as `vertices`.
        element_kind: &'static str,
        /// The number of elements in the file.
        element_count: usize,
    },
}

impl MeshFault {
    /// Creates a syntax error, with long quotes of the file truncated.
    pub(crate) fn syntax(line: Option<usize>, mut problem: String) -> Self {
        if let Some((end, _)) = problem.char_indices().nth(MAX_SYNTAX_MESSAGE_CHARS) {
            problem.truncate(end);
            problem.push('…');
        }
        MeshFault::Syntax { line, problem }
    }

    /// Creates a syntax error without a line number, for binary formats and others that are not read by lines.
    pub(crate) fn malformed_content(problem: impl Into<String>) -> Self {
        MeshFault::syntax(None, problem.into())
    }

    /// Creates the error of content that is not supported, and of what to export instead.
    pub(crate) fn unsupported_content(
        content: impl Into<String>,
        alternative: &'static str,
    ) -> Self {
        MeshFault::UnsupportedContent {
            unsupported_content: content.into(),
            alternative,
        }
    }

    /// Creates the error of a file that ends before an element is complete.
    pub(crate) fn truncated_file(missing: impl Into<String>) -> Self {
        MeshFault::Truncated {
            missing_element: missing.into(),
        }
    }

    /// Wraps the fault with the name of the element that has it.
    pub(crate) fn at_element(self, place: impl Into<String>) -> Self {
        MeshFault::AtElement {
            element: place.into(),
            fault: Box::new(self),
        }
    }
}

/// The maximum length of a syntax message, in characters.
const MAX_SYNTAX_MESSAGE_CHARS: usize = 200;

fn file_extension_advice(extension: &str) -> String {
    let problem = match extension {
        "" => "has no extension, which tells the format of a mesh".into(),
        other => format!("{other:?} is not the extension of a mesh"),
    };
    let advice = conversion_advice(extension);
    let advice = advice.unwrap_or("use .gltf, .glb, .dae, .obj, .stl, .ply or .off".into());
    format!("{problem}; {advice}")
}

/// Returns advice on converting CAD surfaces to a mesh.
fn cad_advice(extension: &str) -> String {
    format!(
        "it holds surfaces of a CAD system: export it there as .stl, or run \
         `gmsh part.{extension} -2 -o part.stl`"
    )
}

/// Returns advice on converting a file of a well-known format to a mesh.
fn conversion_advice(extension: &str) -> Option<String> {
    let advice = match extension {
        "step" | "stp" | "iges" | "igs" | "brep" => return Some(cad_advice(extension)),
        "sldprt" | "ipt" | "catpart" | "prt" | "f3d" | "fcstd" | "x_t" | "jt" | "sat" | "dwg" => {
            "it is a file of a CAD system: export it there as .stl"
        }
        "fbx" | "3ds" | "x3d" | "wrl" => {
            "it holds a scene: run `assimp export scene.fbx scene.glb`, or export it as .glb"
        }
        "blend" | "usd" | "usda" | "usdc" | "usdz" => {
            "it holds a scene: open it in Blender, and export it as .glb"
        }
        "urdf" | "xacro" | "sdf" | "srdf" | "mjcf" | "xml" => {
            "it describes links and joints: give the mesh of one link, which it names"
        }
        "vtk" | "vtu" | "msh" | "inp" | "nas" | "bdf" => {
            "it holds a mesh for simulation: run `meshio convert part.msh part.stl`"
        }
        _ => return None,
    };
    Some(advice.into())
}

/// The maximum number of part names in a message.
const MAX_NAMED_PARTS: usize = 20;

fn list_of_parts(parts: &[Option<String>]) -> String {
    let label = |(number, name): (usize, &Option<String>)| match name {
        Some(name) => format!("{number} {}", quoted(name)),
        None => number.to_string(),
    };
    let named = parts.iter().enumerate().take(MAX_NAMED_PARTS).map(label);
    let named = named.collect::<Vec<_>>().join(", ");
    match parts.len() {
        0 => "it has none".into(),
        1 if parts == [None] => "it has one, without a name: 0".into(),
        all if all > MAX_NAMED_PARTS => {
            let more = all - MAX_NAMED_PARTS;
            format!("its parts are {named} and {more} more")
        }
        _ => format!("its parts are {named}"),
    }
}

fn list_of_numbers(numbers: &[usize]) -> String {
    let named = numbers.iter().take(MAX_NAMED_PARTS).map(usize::to_string);
    let more = (numbers.len() > MAX_NAMED_PARTS).then(|| "…".into());
    named.chain(more).collect::<Vec<_>>().join(", ")
}

/// Returns a name from a file, quoted and truncated for messages.
pub(crate) fn quoted(name: &str) -> String {
    match name.char_indices().nth(MAX_QUOTED_NAME_CHARS) {
        Some((end, _)) => format!("{:?}", format!("{}…", &name[..end])),
        None => format!("{name:?}"),
    }
}

/// Returns the name of an element for messages, such as `node 2 "lid"`.
pub(crate) fn element_name(kind: &str, number: usize, name: Option<&str>) -> String {
    match name {
        Some(name) => format!("{kind} {number} {}", quoted(name)),
        None => format!("{kind} {number}"),
    }
}

/// The maximum length of a name in a message, in characters.
const MAX_QUOTED_NAME_CHARS: usize = 80;

fn line_prefix(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!("line {line}: "))
}
