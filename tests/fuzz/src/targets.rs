//! The fuzz targets: functions of bytes that panic, hang or use too much memory only if the product has a fault.

mod bodies;
mod mesh;
mod motions;
mod paths;
mod query;
mod stored;

use ccd_decomp::Format;
pub use query::encode;

/// A fuzz target: a function of bytes, and the name of its corpus and its program.
#[derive(Clone, Copy)]
pub struct Target {
    pub name: &'static str,
    pub run: fn(&[u8]),
}

/// All fuzz targets.
pub const ALL: [Target; 9] = [QUERY, STORED_BODY, OBJ, STL, PLY, OFF, GLTF, MOTIONS, PATHS];

/// Decodes a query, answers it by several methods, and judges the answers by the referee.
pub const QUERY: Target = Target {
    name: "query",
    run: query::run,
};

/// Loads a stored body, as it is and with a repaired header and checksum, and runs a few queries on it.
pub const STORED_BODY: Target = Target {
    name: "stored",
    run: stored::run,
};

/// Reads a mesh as OBJ, and makes bodies of it.
pub const OBJ: Target = Target {
    name: "obj",
    run: |bytes| mesh::run(Format::Obj, bytes),
};

/// Reads a mesh as STL, and makes bodies of it.
pub const STL: Target = Target {
    name: "stl",
    run: |bytes| mesh::run(Format::Stl, bytes),
};

/// Reads a mesh as PLY, and makes bodies of it.
pub const PLY: Target = Target {
    name: "ply",
    run: |bytes| mesh::run(Format::Ply, bytes),
};

/// Reads a mesh as OFF, and makes bodies of it.
pub const OFF: Target = Target {
    name: "off",
    run: |bytes| mesh::run(Format::Off, bytes),
};

/// Reads a mesh as glTF, with its parts, and makes bodies of it.
pub const GLTF: Target = Target {
    name: "gltf",
    run: |bytes| mesh::run_scene(Format::Gltf, bytes),
};

/// Reads a table of motions, and checks that its rows can be skipped and written back.
pub const MOTIONS: Target = Target {
    name: "motions",
    run: motions::run,
};

/// Reads a table of paths, and checks that its rows can be skipped.
pub const PATHS: Target = Target {
    name: "paths",
    run: paths::run,
};
