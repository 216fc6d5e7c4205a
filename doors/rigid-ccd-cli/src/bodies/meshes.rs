//! The options for reading mesh files and for their pieces, shared by the subcommands.

use crate::options::named::{AXES, UNITS, named_value_parser};
use ccd_decomp::{Adjustments, Axis, PatchOrder, PieceChoice, Unit};
use clap::{Args, ValueEnum};

/// The options for reading mesh files, and for their convex pieces.
#[derive(Clone, Debug, Args)]
pub(crate) struct MeshArgs {
    /// Unit of all lengths. Files in another unit are converted to it: glTF is in metres, COLLADA names its unit, others as in
    /// part.stl@mm. All other numbers are taken to be in it [default: the numbers of the files]
    #[arg(long, value_name = "UNIT", value_parser = named_value_parser(UNITS), hide_possible_values = false)]
    unit: Option<Unit>,
    /// Multiply the coordinates of all mesh files by this factor; for one file, write part.stl@scale=0.001
    #[arg(long, value_name = "FACTOR", value_parser = parse_scale_factor, allow_hyphen_values = true)]
    scale: Option<f64>,
    /// Mirror all mesh files: change the sign of one coordinate; for one file, write part.stl@mirror=x
    #[arg(long, value_name = "AXIS", value_parser = named_value_parser(AXES))]
    mirror: Option<Axis>,
    /// Take all mesh files as hollow surfaces, even closed ones; for one file, write part.stl@surface
    #[arg(long, conflicts_with = "pieces")]
    surface: bool,
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

fn parse_scale_factor(text: &str) -> Result<f64, String> {
    let factor: f64 = text.parse().map_err(|_| "it is no number".to_owned())?;
    let scaled = Adjustments::NONE.scaled(factor);
    scaled.map(|_| factor).map_err(|error| error.to_string())
}

impl MeshArgs {
    /// Returns the options for unit, scale, mirror and surface as the library's adjustments of a mesh.
    pub(crate) fn adjustments(&self) -> Adjustments {
        let adjustments = Adjustments::NONE;
        let adjustments = self
            .unit
            .map_or(adjustments, |unit| adjustments.with_target_unit(unit));
        // The parser has refused invalid factors.
        let scaled = self.scale.and_then(|scale| adjustments.scaled(scale).ok());
        let adjustments = scaled.unwrap_or(adjustments);
        let adjustments = self
            .mirror
            .map_or(adjustments, |axis| adjustments.mirrored(axis));
        if self.surface {
            adjustments.treated_as_hollow()
        } else {
            adjustments
        }
    }

    /// Returns the value of `--pieces` as the library's type for the choice of pieces.
    pub(crate) fn choice(&self) -> PieceChoice {
        match self.pieces {
            PiecesArg::Auto => PieceChoice::Auto,
            PiecesArg::Triangles => PieceChoice::Triangles,
            PiecesArg::Patches => PieceChoice::Patches(PatchOrder::default()),
            PiecesArg::Hull => PieceChoice::Hull,
            PiecesArg::OuterHull => PieceChoice::OuterHull,
        }
    }

    /// Returns whether no option is given.
    pub(crate) fn are_default(&self) -> bool {
        self.adjustments() == Adjustments::NONE && self.pieces == PiecesArg::default()
    }

    /// Returns the unit of length that `--unit` gives; `None` without this option.
    pub(crate) fn unit(&self) -> Option<Unit> {
        self.unit
    }
}
