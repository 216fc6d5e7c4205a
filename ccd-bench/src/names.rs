//! Gives the names that values have on the command line and in the tables.

use clap::ValueEnum;

/// Returns the name of a value on the command line and in the tables.
pub(crate) fn name_of(value: &impl ValueEnum) -> String {
    let name = value.to_possible_value();
    name.map_or_else(String::new, |name| name.get_name().to_owned())
}
