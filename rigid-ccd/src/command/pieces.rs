//! The option `--pieces`, shared by the subcommands.

use ccd_decomp::{Detail, PatchOrder};
use clap::{Args, ValueEnum};

/// The option that chooses the convex pieces of a mesh.
#[derive(Clone, Debug, Args)]
pub(super) struct PiecesArgs {
    /// Convex pieces to split a mesh into; a prepared body (.ccd) keeps its pieces
    #[arg(long, value_enum, default_value_t)]
    pieces: PiecesArg,
}

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
    /// The convex solid itself: exact, only for convex meshes
    Hull,
    /// The convex hull of any mesh: contacts may be reported early
    OuterHull,
}

impl PiecesArgs {
    /// Returns the value of the option as the library's type for the choice of pieces.
    pub(super) fn detail(&self) -> Detail {
        match self.pieces {
            PiecesArg::Auto => Detail::Auto,
            PiecesArg::Triangles => Detail::Triangles,
            PiecesArg::Patches => Detail::Patches(PatchOrder::default()),
            PiecesArg::Hull => Detail::Hull,
            PiecesArg::OuterHull => Detail::OuterHull,
        }
    }
}
