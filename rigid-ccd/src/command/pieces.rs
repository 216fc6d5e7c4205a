//! What a mesh is to be made into, as every command is told it.

use anyhow::{Result, bail};
use ccd_decomp::{Detail, Order};
use clap::{Args, ValueEnum};

/// What a mesh is to be made into.
#[derive(Clone, Debug, Args)]
pub(super) struct PiecesArgs {
    /// What pieces a mesh is made into; bodies stored as .ccd keep theirs
    #[arg(long, value_enum, default_value_t)]
    pieces: PiecesArg,
    /// How many hulls --pieces vhacd may make [default: 32]; more of them are closer to the mesh
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_HULLS))]
    hulls: Option<u32>,
}

/// What stands for the value of an option that has none.
pub(super) const NOT_GIVEN: &str = "not given";

const DEFAULT_HULLS: u32 = 32;
const MOST_HULLS: i64 = 4096;

/// The kinds of pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum PiecesArg {
    /// The least that is exact for the body
    #[default]
    Auto,
    /// Its triangles: exact for any mesh
    Triangles,
    /// Convex parts of its surface: exact, for closed meshes
    Patches,
    /// The solid itself: exact for convex meshes, refused for others
    Hull,
    /// A few hulls about its parts: approximate, contacts may be reported early
    Vhacd,
}

/// What the command line calls a value.
pub(super) fn word(value: &impl ValueEnum) -> String {
    let value = value.to_possible_value();
    value.map_or_else(String::new, |value| value.get_name().to_owned())
}

impl PiecesArgs {
    /// The options as they are in force.
    pub(super) fn asked(&self) -> [(&'static str, String); 2] {
        let hulls = match self.pieces {
            PiecesArg::Vhacd => self.hulls.unwrap_or(DEFAULT_HULLS).to_string(),
            _ => NOT_GIVEN.to_owned(),
        };
        [("--pieces", word(&self.pieces)), ("--hulls", hulls)]
    }

    /// The library's word for it.
    pub(super) fn detail(&self) -> Result<Detail> {
        if self.hulls.is_some() && self.pieces != PiecesArg::Vhacd {
            bail!("--hulls says how many hulls --pieces vhacd makes; give both or neither");
        }
        Ok(match self.pieces {
            PiecesArg::Auto => Detail::Auto,
            PiecesArg::Triangles => Detail::Triangles,
            PiecesArg::Patches => Detail::Patches(Order::default()),
            PiecesArg::Hull => Detail::Hull,
            PiecesArg::Vhacd => Detail::Vhacd {
                hulls: self.hulls.unwrap_or(DEFAULT_HULLS),
            },
        })
    }
}
