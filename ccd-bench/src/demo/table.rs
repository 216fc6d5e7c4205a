//! The demo's table and what has to be said about it.

use super::{MOST_FOR_NAIVE, Measurement};
use crate::model::Origin;
use crate::results::Status;
use crate::scene::Scene;
use crate::text::grouped;
use ccd_core::tolerance::DEFAULT_TOLERANCE;
use comfy_table::presets::UTF8_BORDERS_ONLY;
use comfy_table::{CellAlignment, Table};
use std::io;
use std::sync::Arc;

const HEADER: [&str; 12] = [
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
    "disagree",
];
/// Columns that read as words.
const WORDS: [usize; 3] = [0, 3, 4];

/// One line per scene and method.
pub(super) fn table(measured: &[(&Scene, Vec<Measurement>)]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_BORDERS_ONLY).set_header(HEADER);
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
        triangles(scene),
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
        match measurement.disagreements {
            Some(count) => count.to_string(),
            None => "-".to_owned(),
        },
    ]
}

/// Of both meshes, or of the one that both bodies share.
fn triangles(scene: &Scene) -> String {
    let (a, b) = (scene.a.triangles(), scene.b.triangles());
    match Arc::ptr_eq(&scene.a.body, &scene.b.body) {
        true => grouped(a),
        false => format!("{} × {}", grouped(a), grouped(b)),
    }
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
        "Each row is one query, answered once, on one thread; tolerance \
         {DEFAULT_TOLERANCE:e}. Answers that contradict the first method's of their scene: \
         {contradictions}."
    )?;
    writeln!(
        output,
        "`fast` and `hull-first` work on convex patches under hull trees, the others on what serves \
         best. `naive` looks at every pair of pieces in every step: it is run only where pairs times \
         rows are at most {MOST_FOR_NAIVE}."
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
