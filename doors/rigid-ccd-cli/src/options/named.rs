//! Parses options whose values are named values of a library type.

use ccd_core::StartPolicy;
use ccd_decomp::{Axis, PatchOrder, Unit};
use ccd_tables::results::{ANSWERS, QuestionAnswers};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use rigid_ccd::Question;

/// The values of an option, each with its name on the command line and its help.
pub(crate) type Named<T> = [(&'static str, T, &'static str)];

/// Returns a parser that maps the names in `all` to their values.
pub(crate) fn named_value_parser<T>(all: &'static Named<T>) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let values = all
        .iter()
        .map(|&(name, _, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(values).try_map(|given| {
        let found = all.iter().find(|(name, ..)| *name == given);
        found
            .map(|&(_, value, _)| value)
            .ok_or("there is no such value")
    })
}

/// The coordinate axes of `--mirror`.
pub(crate) const AXES: &Named<Axis> = &[
    ("x", Axis::X, "Change the signs of x"),
    ("y", Axis::Y, "Change the signs of y"),
    ("z", Axis::Z, "Change the signs of z"),
];

/// The units of length of `--unit`, by their symbols.
pub(crate) const UNITS: &Named<Unit> = &[
    ("um", Unit::Micrometre, "Micrometre"),
    ("mm", Unit::Millimetre, "Millimetre"),
    ("cm", Unit::Centimetre, "Centimetre"),
    ("m", Unit::Metre, "Metre"),
    ("in", Unit::Inch, "Inch, 25.4 mm"),
    ("ft", Unit::Foot, "Foot, 12 inches"),
];

/// The orders in which patches grow, for `--order`.
pub(crate) const PATCH_ORDERS: &Named<PatchOrder> = &[
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

/// The questions of `--question`.
pub(crate) const QUESTIONS: &Named<Question> = &[
    named_question(0),
    named_question(1),
    named_question(2),
    named_question(3),
    named_question(4),
];

const fn named_question(number: usize) -> (&'static str, Question, &'static str) {
    let QuestionAnswers {
        question, words, ..
    } = ANSWERS[number];
    (question.name(), question, words)
}

/// The treatments of bodies in contact at the start, for `--start`.
pub(crate) const START_POLICIES: &Named<StartPolicy> = &[
    (
        StartPolicy::Report.name(),
        StartPolicy::Report,
        "Report the contact at time 0",
    ),
    (
        StartPolicy::Leave.name(),
        StartPolicy::Leave,
        "Ignore the contact as long as the bodies do not approach",
    ),
];
