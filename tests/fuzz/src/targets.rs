//! The targets: functions of bytes that panic, hang or take too much memory only if the product has a fault.

mod bodies;
mod mesh;
mod motions;
mod paths;
mod query;
mod stored;

use ccd_decomp::Format;
pub use query::encode;

/// A target, with the name of its corpus and of its program.
#[derive(Clone, Copy)]
pub struct Target {
    pub name: &'static str,
    pub run: fn(&[u8]),
}

/// All targets.
pub const ALL: [Target; 10] = [
    QUERY, STORED, OBJ, STL, PLY, OFF, GLTF, THREEMF, MOTIONS, PATHS,
];

/// A query in bytes, asked of several methods and judged by the referee.
pub const QUERY: Target = Target {
    name: "query",
    run: query::run,
};

/// A stored body, whose frame is mended, and a few queries on it.
pub const STORED: Target = Target {
    name: "stored",
    run: stored::run,
};

/// A mesh as OBJ, and the bodies that are made of it.
pub const OBJ: Target = Target {
    name: "obj",
    run: |bytes| mesh::run(Format::Obj, bytes),
};

/// The same as STL.
pub const STL: Target = Target {
    name: "stl",
    run: |bytes| mesh::run(Format::Stl, bytes),
};

/// The same as PLY.
pub const PLY: Target = Target {
    name: "ply",
    run: |bytes| mesh::run(Format::Ply, bytes),
};

/// The same as OFF.
pub const OFF: Target = Target {
    name: "off",
    run: |bytes| mesh::run(Format::Off, bytes),
};

/// The same as glTF, and its parts.
pub const GLTF: Target = Target {
    name: "gltf",
    run: |bytes| mesh::scene(Format::Gltf, bytes),
};

/// The same as 3MF, packed or the model alone.
pub const THREEMF: Target = Target {
    name: "threemf",
    run: mesh::packed,
};

/// A table of motions.
pub const MOTIONS: Target = Target {
    name: "motions",
    run: motions::run,
};

/// A table of paths.
pub const PATHS: Target = Target {
    name: "paths",
    run: paths::run,
};
