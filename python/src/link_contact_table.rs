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
            LinkContactClass::Sometimes { .. } => "sometimes",
            LinkContactClass::Undecided { .. } => "undecided",
        })
    });
    let apart = meetings.iter().map(|(_, meeting)| match meeting {
        LinkContactClass::Undecided {
            proven_apart_share, ..
        } => Some(*proven_apart_share),
        _ => None,
    });
    let columns: [(&str, ArrayRef, bool); 4] = [
        ("link_a", names(0), false),
        ("link_b", names(1), false),
        (
            "evidence",
            Arc::new(evidence.collect::<StringArray>()),
            false,
        ),
        ("apart", Arc::new(apart.collect::<Float64Array>()), true),
    ];
    RecordBatch::try_from_iter_with_nullable(columns)
}
