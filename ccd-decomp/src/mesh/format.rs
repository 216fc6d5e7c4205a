//! Mesh file formats. Each reader turns bytes into a mesh without access to files.

#[cfg(feature = "collada")]
mod collada;
#[cfg(feature = "gltf")]
mod gltf;
mod obj;
mod off;
mod ply;
mod stl;
mod text;

use super::content::Content;
use super::error::MeshFault;
use crate::messages::{is_html, is_lfs_pointer};
use std::collections::BTreeMap;
use std::path::Path;

/// A format of mesh files that can be read. Texts are in UTF-8, or in UTF-16 with a byte order mark; any line ending is
/// accepted. [`Remarks`](crate::Remarks) list skipped content that may matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ: statements `v` and `f`, in f64. Normals, texture coordinates, colours and materials are skipped;
    /// lines, points, curves and unknown statements are skipped with a remark. A fourth number of a vertex divides the
    /// others, with a remark unless it is 1. Free-form surfaces and calls of other files are errors.
    ///
    /// Its parts are its objects (`o`) or, in a file without any, its groups (`g`).
    Obj,
    /// STL, binary or text, in f32. Corners at exactly the same point become one vertex, numbered in order of
    /// appearance; normals are passed over.
    Stl,
    /// PLY, binary or text: the elements `vertex`, `face` and `tristrips`. The last are strips of triangles, separated
    /// by −1. Other elements are passed over with a remark.
    Ply,
    /// Object File Format, as text. Normals and colours are passed over.
    Off,
    /// glTF 2.0, text (`.gltf`) or binary (`.glb`), in metres; it is read only with the Cargo feature `gltf`.
    ///
    /// Numbers are read in f64, and rotations are normalized. Transforms of nested nodes are multiplied in f64 before
    /// they are applied: each product rounds as [`AffineMap::apply`](crate::AffineMap::apply) does.
    ///
    /// Parts are the nodes with a mesh, of the default scene or, in a file without scenes, of all nodes. A node without
    /// a name has that of its mesh. Primitives of triangles, strips and fans are read, with or without indices, from
    /// floats, quantized integers or sparse accessors. Materials and animations are skipped; points, lines, skins and
    /// morph targets are skipped with a remark, so that meshes are in their rest pose. A node scaled to zero along all
    /// axes is hidden with its descendants, as specified. Instances make about ten million triangles at most.
    /// Compression by Draco or meshopt, required extensions that change the shape, and keys that glTF does not have, are errors.
    Gltf,
    /// COLLADA 1.4 and 1.5 (`.dae`), in f64; it is read only with the Cargo feature `collada`.
    ///
    /// Coordinates are in the document's unit, and stay as they are: the direction that counts as up is passed over, as rviz and
    /// MoveIt do. Parts are the geometries that the nodes of the scene place, with the name of their node. Triangles, strips,
    /// fans and polygons are read. Lines are skipped with a remark, and geometries with a skin or morphs are taken at rest, with
    /// a remark. Polygons with holes, `lookat`, `skew`, units of single elements, and elements that nodes do not have are
    /// errors.
    Collada,
}

/// The contents of the files that a mesh refers to, by file name.
pub(crate) type LinkedFiles = BTreeMap<String, Vec<u8>>;

/// The files that a mesh refers to, such as the buffers of a glTF: for each path relative to the mesh, as written in the
/// mesh, the number of bytes of the file that the mesh needs.
pub(crate) type FileReferences = BTreeMap<String, u64>;

impl Format {
    /// Returns the format of a file by its extension, case-insensitively.
    ///
    /// # Errors
    /// [`MeshFault::UnknownExtension`] for any other extension.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, MeshFault> {
        let extension = path.as_ref().extension().unwrap_or_default();
        let extension = extension.to_string_lossy().to_ascii_lowercase();
        match extension.as_str() {
            "obj" => Ok(Format::Obj),
            "stl" => Ok(Format::Stl),
            "ply" => Ok(Format::Ply),
            "off" => Ok(Format::Off),
            "gltf" | "glb" => Ok(Format::Gltf),
            "dae" => Ok(Format::Collada),
            _ => Err(MeshFault::UnknownExtension { extension }),
        }
    }

    /// Returns whether a file of this format may refer to other files.
    pub(crate) fn may_refer_to_files(self) -> bool {
        self == Format::Gltf
    }

    /// Returns the references in a mesh to other files, whose contents [`Format::parse`] needs.
    pub(crate) fn file_references(self, bytes: &[u8]) -> Result<FileReferences, MeshFault> {
        match (self, bytes) {
            #[cfg(feature = "gltf")]
            (Format::Gltf, bytes)
                if !is_lfs_pointer(bytes)
                    && !is_step_file(&text::to_utf8(bytes))
                    && !is_html(bytes) =>
            {
                gltf::file_references(bytes)
            }
            _ => Ok(FileReferences::new()),
        }
    }

    /// Parses a file's content in this format; Git LFS pointers and STEP files are recognised by their content and
    /// refused, and pages of HTML. `linked` holds the contents of the files that it refers to.
    pub(crate) fn parse(self, bytes: &[u8], linked: &LinkedFiles) -> Result<Content, MeshFault> {
        let unmarked = text::to_utf8(bytes);
        if is_lfs_pointer(&unmarked) {
            return Err(MeshFault::LfsPointer);
        }
        if is_step_file(&unmarked) {
            return Err(MeshFault::StepFile);
        }
        if is_html(&unmarked) {
            return Err(MeshFault::Html);
        }
        match self {
            Format::Obj => obj::parse(&text::to_utf8_with_lf(bytes)),
            Format::Stl => stl::parse(bytes).map(Content::from),
            Format::Ply => ply::parse(&unmarked).map(Content::from),
            Format::Off => off::parse(&text::to_utf8_with_lf(bytes)).map(Content::from),
            #[cfg(feature = "gltf")]
            Format::Gltf => gltf::parse(&unmarked, linked),
            #[cfg(not(feature = "gltf"))]
            Format::Gltf => Err(missing_gltf_feature(linked)),
            #[cfg(feature = "collada")]
            Format::Collada => collada::parse(&unmarked),
            #[cfg(not(feature = "collada"))]
            Format::Collada => Err(MeshFault::MissingFeature {
                format: "COLLADA",
                cargo_feature: "collada",
            }),
        }
    }
}

/// Returns whether the bytes begin with the signature of a STEP file.
fn is_step_file(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"ISO-10303-21")
}

#[cfg(not(feature = "gltf"))]
fn missing_gltf_feature(_: &LinkedFiles) -> MeshFault {
    MeshFault::MissingFeature {
        format: "glTF",
        cargo_feature: "gltf",
    }
}

#[cfg(test)]
mod tests;
