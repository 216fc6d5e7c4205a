//! The table of which links can touch.

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use rigid_ccd_robot::{LinkContactClass, Robot};
use std::sync::Arc;

/// Makes a table with a row for each pair of links.
pub(crate) fn link_contact_table(
    robot: &Robot,
    meetings: &[([usize; 2], LinkContactClass)],
) -> Result<RecordBatch, ArrowError> {
    let names = |side: usize| -> ArrayRef {
        let links = meetings.iter().map(|(links, _)| links[side]);
        let names = links.map(|link| Some(robot.links()[link].name.as_str()));
        Arc::new(names.collect::<StringArray>())
    };
    let evidence = meetings.iter().map(|(_, meeting)| {
        Some(match meeting {
            LinkContactClass::Never => "never",
            LinkContactClass::Always => "always",
            LinkContactClass::AlwaysAsEnclosed => "always-as-enclosed",
            LinkContactClass::Sometimes { .. } => "sometimes",
            LinkContactClass::Undecided { .. } => "undecided",
        })
    });
    let numbers = |number: usize| -> ArrayRef {
        let found = meetings.iter().map(|(_, meeting)| match meeting {
            LinkContactClass::Undecided {
                proven_apart_share,
                undecided_share,
                least_distance,
                ..
            } => Some([*proven_apart_share, *undecided_share, *least_distance][number]),
            _ => None,
        });
        Arc::new(found.collect::<Float64Array>())
    };
    let columns: [(&str, ArrayRef, bool); 6] = [
        ("link_a", names(0), false),
        ("link_b", names(1), false),
        (
            "evidence",
            Arc::new(evidence.collect::<StringArray>()),
            false,
        ),
        ("apart", numbers(0), true),
        ("undecided", numbers(1), true),
        ("least_distance", numbers(2), true),
    ];
    RecordBatch::try_from_iter_with_nullable(columns)
}
