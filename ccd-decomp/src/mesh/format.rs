//! File formats: bytes to polygons, without access to files.

mod obj;
mod off;
mod ply;
mod stl;

use super::error::MeshFault;
use super::polygons::Polygons;
use crate::messages::is_lfs_pointer;
use std::path::Path;

/// A format that a mesh can be read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ: statements `v` and `f`, in f64. Lines, points, curves, normals, texture
    /// coordinates, colours, groups and materials are passed over.
    Obj,
    /// STL, binary or text, in f32. Corners at exactly the same point become one vertex, numbered in
    /// the order they appear; the normals are passed over.
    Stl,
    /// PLY, binary or text: elements `vertex` and `face`; others are passed over.
    Ply,
    /// Object File Format, text, with or without normals and colours, which are passed over.
    Off,
}

impl Format {
    /// Finds the format of a file by its extension, in capitals or not.
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
            _ => Err(MeshFault::UnknownExtension { extension }),
        }
    }

    /// Reads the vertices and faces of a file's content.
    pub(crate) fn parse(self, bytes: &[u8]) -> Result<Polygons, MeshFault> {
        // Some editors put a byte order mark before a text; the first keyword would be lost in it.
        let unmarked = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
        if is_lfs_pointer(unmarked) {
            return Err(MeshFault::LfsPointer);
        }
        match self {
            Format::Obj => obj::parse(unmarked),
            Format::Stl => stl::parse(bytes),
            Format::Ply => ply::parse(unmarked),
            Format::Off => off::parse(unmarked),
        }
    }
}

#[cfg(test)]
mod tests;
