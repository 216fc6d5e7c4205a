//! The targets: functions of bytes that panic, hang or use too much memory only if the product has a fault.

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

/// A query in bytes, answered by several methods and judged by the referee.
pub const QUERY: Target = Target {
    name: "query",
    run: query::run,
};

/// A stored body with a repaired frame, and a few queries on it.
pub const STORED: Target = Target {
    name: "stored",
    run: stored::run,
};

/// A mesh as OBJ, and the bodies made of it.
pub const OBJ: Target = Target {
    name: "obj",
    run: |bytes| mesh::run(Format::Obj, bytes),
};

/// A mesh as STL, and the bodies made of it.
pub const STL: Target = Target {
    name: "stl",
    run: |bytes| mesh::run(Format::Stl, bytes),
};

/// A mesh as PLY, and the bodies made of it.
pub const PLY: Target = Target {
    name: "ply",
    run: |bytes| mesh::run(Format::Ply, bytes),
};

/// A mesh as OFF, and the bodies made of it.
pub const OFF: Target = Target {
    name: "off",
    run: |bytes| mesh::run(Format::Off, bytes),
};

/// A mesh as glTF, its parts, and the bodies made of it.
pub const GLTF: Target = Target {
    name: "gltf",
    run: |bytes| mesh::scene(Format::Gltf, bytes),
};

/// A mesh as 3MF, packed or the model alone, and the bodies made of it.
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
