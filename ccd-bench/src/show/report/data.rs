//! The data for the page's scripts: JSON that is safe between two tags.

use crate::run::measured::Cell;
use crate::show::chart::{Charts, Family};
use crate::show::page::json;
use serde::Serialize;

#[derive(Serialize)]
struct Measured<'a> {
    scenes: Vec<&'a str>,
    methods: Vec<MethodData<'a>>,
    cells: Vec<CellData<'a>>,
}

#[derive(Serialize)]
struct MethodData<'a> {
    name: &'a str,
    label: &'a str,
    family: &'static str,
    /// What the legend calls the family.
    group: &'static str,
    colour: String,
    r#unsafe: bool,
}

#[derive(Serialize)]
struct CellData<'a> {
    scene: &'a str,
    method: &'a str,
    tolerance: f64,
    rows: usize,
    median_us: f64,
    mean_us: f64,
    /// `None` if there is no contact.
    error: Option<f64>,
    late: usize,
    missed: usize,
    #[serde(rename = "false")]
    false_contacts: usize,
    unresolved: usize,
}

/// Serialises the table for the plane of time and error.
pub(super) fn measured(charts: &Charts<'_>) -> Result<String, serde_json::Error> {
    let compared: Vec<_> = charts
        .colours()
        .into_iter()
        .filter(|(method, _)| method.family != Family::Model)
        .collect();
    let is_shown = |cell: &&Cell| {
        charts.scenes.iter().any(|scene| scene.name == cell.scene)
            && compared
                .iter()
                .any(|(method, _)| method.name == cell.method)
    };
    let mut cells: Vec<_> = charts.cells.iter().filter(is_shown).collect();
    cells.sort_by(|a, b| b.tolerance.total_cmp(&a.tolerance));
    let measured_scene = |name: &&str| cells.iter().any(|cell| cell.scene == *name);
    json(&Measured {
        scenes: charts
            .scenes
            .iter()
            .map(|scene| scene.name)
            .filter(measured_scene)
            .collect(),
        methods: compared
            .iter()
            .map(|(method, colour)| MethodData {
                name: method.name,
                label: method.label,
                family: match method.family {
                    Family::Ours => "ours",
                    Family::Rival => "rival",
                    Family::Peer => "peer",
                    Family::Model => "model",
                },
                group: method.family.title(),
                colour: colour.clone(),
                r#unsafe: charts.is_unsafe(method.name),
            })
            .collect(),
        cells: cells.into_iter().map(cell_data).collect(),
    })
}

fn cell_data(cell: &Cell) -> CellData<'_> {
    CellData {
        scene: &cell.scene,
        method: &cell.method,
        tolerance: cell.tolerance,
        rows: cell.rows,
        median_us: cell.median_us,
        mean_us: cell.mean_us,
        error: Some(cell.mean_error).filter(|error| error.is_finite()),
        late: cell.late,
        missed: cell.missed,
        false_contacts: cell.false_contacts,
        unresolved: cell.unresolved,
    }
}
