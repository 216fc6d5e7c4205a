//! The demo's table and what has to be said about it.

use super::{MOST_PAIRS_FOR_NAIVE, Measurement};
use crate::model::Origin;
use crate::results::Status;
use crate::scene::Scene;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use std::io;

const HEADER: [&str; 13] = [
    "scene",
    "triangles",
    "rows",
    "schedule",
    "oracle",
    "contact",
    "free",
    "other",
    "median µs",
    "mean µs",
    "p95 µs",
    "visits/row",
    "disagree",
];
/// Columns that read as words.
const WORDS: [usize; 3] = [0, 3, 4];

/// One line per scene and method.
pub(super) fn table(measured: &[(&Scene, Vec<Measurement>)]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(HEADER);
    for (index, column) in table.column_iter_mut().enumerate() {
        if !WORDS.contains(&index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    for (scene, measurements) in measured {
        for (line, measurement) in measurements.iter().enumerate() {
            let mut cells = cells(scene, measurement);
            if line > 0 {
                cells[..3].fill(String::new());
            }
            table.add_row(cells);
        }
    }
    table
}

fn cells(scene: &Scene, measurement: &Measurement) -> [String; HEADER.len()] {
    let summary = &measurement.summary;
    let others = [Status::Touching, Status::Overlapping, Status::Unresolved];
    [
        scene.name.clone(),
        format!(
            "{} × {}",
            triangles(scene.a.triangles),
            triangles(scene.b.triangles)
        ),
        summary.rows().to_string(),
        measurement.method.schedule.to_string(),
        measurement.method.oracle.to_string(),
        summary.count(Status::Contact).to_string(),
        summary.count(Status::Free).to_string(),
        others
            .map(|s| summary.count(s))
            .iter()
            .sum::<usize>()
            .to_string(),
        format!("{:.1}", summary.median_micros),
        format!("{:.1}", summary.mean_micros),
        format!("{:.1}", summary.p95_micros),
        (summary.node_visits / summary.rows().max(1) as u64).to_string(),
        match measurement.disagreements {
            Some(count) => count.to_string(),
            None => "reference".to_owned(),
        },
    ]
}

/// A count with its thousands set apart.
fn triangles(count: usize) -> String {
    let digits = count.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// What the table does not show of itself.
pub(super) fn write_notes(
    measured: &[(&Scene, Vec<Measurement>)],
    output: &mut dyn io::Write,
) -> io::Result<()> {
    let stands_in = |scene: &Scene| {
        [&scene.a, &scene.b]
            .iter()
            .any(|b| b.origin == Origin::StandIn)
    };
    let all = measured.iter().flat_map(|(_, measurements)| measurements);
    let contradictions: usize = all.filter_map(|m| m.disagreements).sum();
    writeln!(
        output,
        "Each row is one query, answered once, on one thread; tolerance 1e-3. Methods that \
         contradict the first one of their scene: {contradictions} rows."
    )?;
    writeln!(
        output,
        "`naive` looks at every pair of pieces in every step: it is run only where there are at most \
         {MOST_PAIRS_FOR_NAIVE} of them."
    )?;
    if measured.iter().any(|(scene, _)| stands_in(scene)) {
        writeln!(
            output,
            "Bunnies and Santa are stand-ins made by code, with as many triangles as the scanned \
             models; `ccd demo --models DIR` takes DIR/bunny70k.obj, bunny26k.obj and santa.obj."
        )?;
    }
    Ok(())
}
