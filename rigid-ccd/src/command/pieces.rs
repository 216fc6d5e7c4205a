//! The options `--pieces` and `--hulls`, shared by the subcommands.

use anyhow::{Result, bail};
use ccd_decomp::{Detail, PatchOrder};
use clap::{Args, ValueEnum};

/// The options that choose the convex pieces of a mesh.
#[derive(Clone, Debug, Args)]
pub(super) struct PiecesArgs {
    /// Convex pieces to split a mesh into; a prepared body (.ccd) keeps its pieces
    #[arg(long, value_enum, default_value_t)]
    pieces: PiecesArg,
    /// Maximum number of hulls of --pieces vhacd; more hulls fit the mesh more closely [default: 32]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MAX_HULLS))]
    hulls: Option<u32>,
}

const DEFAULT_HULLS: u32 = 32;
const MAX_HULLS: i64 = 4096;

/// The values of `--pieces`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum PiecesArg {
    /// The fewest pieces that are exact: hull, patches or triangles
    #[default]
    Auto,
    /// One piece for each triangle: exact for any mesh
    Triangles,
    /// Convex patches of the surface: exact, only for meshes that bound a solid
    Patches,
    /// One convex hull: exact, only for convex meshes
    Hull,
    /// Approximate convex decomposition (V-HACD): contacts may be reported early
    Vhacd,
}

impl PiecesArgs {
    /// Returns the options as the library's description of the wanted pieces.
    pub(super) fn detail(&self) -> Result<Detail> {
        if self.hulls.is_some() && self.pieces != PiecesArg::Vhacd {
            bail!("--hulls needs --pieces vhacd");
        }
        Ok(match self.pieces {
            PiecesArg::Auto => Detail::Auto,
            PiecesArg::Triangles => Detail::Triangles,
            PiecesArg::Patches => Detail::Patches(PatchOrder::default()),
            PiecesArg::Hull => Detail::Hull,
            PiecesArg::Vhacd => Detail::Vhacd {
                hulls: self.hulls.unwrap_or(DEFAULT_HULLS),
            },
        })
    }
}
