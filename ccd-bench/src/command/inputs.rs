//! The meshes and motions that several subcommands take.

use anyhow::{Context, Result};
use ccd_decomp::TriangleMesh;
use clap::Args;
use std::path::PathBuf;

/// The options that name the meshes of both bodies.
#[derive(Debug, Args)]
pub(super) struct MeshPairArgs {
    /// Body A: a mesh, .obj, .stl, .ply or .off
    #[arg(long, value_name = "MESH")]
    pub(super) a: PathBuf,
    /// Body B: a mesh, .obj, .stl, .ply or .off
    #[arg(long, value_name = "MESH")]
    pub(super) b: PathBuf,
}

/// The options that name a table of motions, and the meshes that it moves.
#[derive(Debug, Args)]
pub(super) struct QueryTableArgs {
    #[command(flatten)]
    pub(super) meshes: MeshPairArgs,
    /// The table of motions, CSV, in the format of `ccd query`; - reads standard input
    #[arg(long, value_name = "CSV")]
    pub(super) motions: PathBuf,
}

impl MeshPairArgs {
    /// Reads both meshes.
    ///
    /// # Errors
    /// If a file cannot be read, or is no mesh.
    pub(super) fn read_meshes(&self) -> Result<[TriangleMesh; 2]> {
        let read = |path, option| TriangleMesh::read(path).context(option);
        Ok([read(&self.a, "--a")?, read(&self.b, "--b")?])
    }
}
