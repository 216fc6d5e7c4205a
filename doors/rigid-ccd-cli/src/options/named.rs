//! Parses options whose values are named values of a library type.

use ccd_core::StartPolicy;
use ccd_decomp::{Axis, PatchOrder, Unit};
use ccd_tables::results::ANSWERS;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use rigid_ccd::Question;

/// The values of an option, each with its name on the command line and its help.
pub(crate) type Named<T, const COUNT: usize> = [(&'static str, T, &'static str); COUNT];

/// Returns a parser that maps the names of values to the values.
pub(crate) fn named_value_parser<T, const COUNT: usize>(
    values: Named<T, COUNT>,
) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let possible = values.map(|(name, _, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(possible).try_map(move |argument| {
        let named = values.iter().find(|(name, ..)| *name == argument);
        named
            .map(|&(_, value, _)| value)
            .ok_or("there is no such value")
    })
}

/// The coordinate axes of `--mirror`.
pub(crate) const AXES: Named<Axis, 3> = [
    ("x", Axis::X, "Change the signs of x"),
    ("y", Axis::Y, "Change the signs of y"),
    ("z", Axis::Z, "Change the signs of z"),
];

/// The units of length of `--unit`, by their symbols.
pub(crate) const UNITS: Named<Unit, 6> = [
    ("um", Unit::Micrometre, "Micrometre"),
    ("mm", Unit::Millimetre, "Millimetre"),
    ("cm", Unit::Centimetre, "Centimetre"),
    ("m", Unit::Metre, "Metre"),
    ("in", Unit::Inch, "Inch, 25.4 mm"),
    ("ft", Unit::Foot, "Foot, 12 inches"),
];

/// The orders in which patches grow, for `--order`.
pub(crate) const PATCH_ORDERS: Named<PatchOrder, 3> = [
    (
        "cresting",
        PatchOrder::Cresting,
        "From the crests of the surface outward",
    ),
    (
        "breadth-first",
        PatchOrder::BreadthFirst,
        "Breadth first, in the order of the faces of the mesh",
    ),
    (
        "depth-first",
        PatchOrder::DepthFirst,
        "Depth first, in the order of the faces of the mesh",
    ),
];

/// Returns the parser of `--question` of `ccd query`.
pub(crate) fn question_parser() -> impl TypedValueParser<Value = Question> {
    named_value_parser(ANSWERS.map(|answers| {
        let question: Question = answers.question;
        (question.name(), question, answers.words)
    }))
}

/// Returns the parser of `--start`: the treatment of bodies in contact at the start.
pub(crate) fn start_policy_parser() -> impl TypedValueParser<Value = StartPolicy> {
    named_value_parser(StartPolicy::ALL.map(|policy| {
        let help = match policy {
            StartPolicy::Report => "Report the contact at time 0",
            StartPolicy::Leave => "Ignore the contact as long as the bodies do not approach",
        };
        (policy.name(), policy, help)
    }))
}
