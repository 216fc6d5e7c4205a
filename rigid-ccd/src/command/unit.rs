//! The option `--unit`, for every subcommand that reads meshes.

use super::pieces::{NOT_GIVEN, value_name};
use ccd_decomp::Unit;
use clap::{Args, ValueEnum};

/// The unit of all lengths.
#[derive(Clone, Debug, Args)]
pub(super) struct UnitArgs {
    /// Unit of all lengths: files that state another one (glTF: metres; 3MF) are converted to it, all other numbers
    /// are taken to be in it [default: the numbers of the files]
    #[arg(long, value_name = "UNIT", value_enum, hide_possible_values = false)]
    unit: Option<UnitArg>,
}

/// The units, by their signs.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum UnitArg {
    /// Micrometre
    Um,
    /// Millimetre
    Mm,
    /// Centimetre
    Cm,
    /// Metre
    M,
    /// Inch, 25.4 mm
    In,
    /// Foot, 12 inches
    Ft,
}

impl UnitArgs {
    /// Returns the corresponding value of the library.
    pub(super) fn unit(&self) -> Option<Unit> {
        self.unit.map(|unit| match unit {
            UnitArg::Um => Unit::Micrometre,
            UnitArg::Mm => Unit::Millimetre,
            UnitArg::Cm => Unit::Centimetre,
            UnitArg::M => Unit::Metre,
            UnitArg::In => Unit::Inch,
            UnitArg::Ft => Unit::Foot,
        })
    }

    /// Returns the option with its value.
    pub(super) fn recorded(&self) -> (&'static str, String) {
        let given = self.unit.as_ref().map(value_name);
        ("--unit", given.unwrap_or_else(|| NOT_GIVEN.to_owned()))
    }
}
