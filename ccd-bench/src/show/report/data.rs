//! The data for the page's scripts: JSON that is safe between two tags.

use super::{Shot, View};
use crate::run::measured::Cell;
use crate::show::chart::{Charts, Family};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::{Contact, Motion, Outcome, Overlap};
use ccd_decomp::TriangleMesh;
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

#[derive(Serialize)]
struct Views<'a> {
    meshes: Vec<MeshData>,
    views: Vec<ViewData<'a>>,
}

/// A mesh as little-endian numbers in base64.
#[derive(PartialEq, Serialize)]
struct MeshData {
    /// Three `f32` per vertex.
    vertices: String,
    /// Three `u32` per face.
    faces: String,
}

#[derive(Serialize)]
struct ViewData<'a> {
    scene: &'a str,
    a: usize,
    b: usize,
    shots: Vec<ShotData>,
}

#[derive(Serialize)]
struct ShotData {
    name: String,
    status: String,
    duration: f64,
    time: Option<f64>,
    contact: Option<ContactData>,
    a: MotionData,
    b: MotionData,
}

#[derive(Serialize)]
struct ContactData {
    witness_a: [f64; 3],
    witness_b: [f64; 3],
    normal: [f64; 3],
}

#[derive(Serialize)]
struct MotionData {
    /// The centre of rotation, in the body's frame.
    centre: [f64; 3],
    /// The centre at the start.
    from: [f64; 3],
    velocity: [f64; 3],
    spin: [f64; 3],
    /// The rotation at the start, by rows.
    rotation: [f64; 9],
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

/// Serialises the meshes, motions and answers of the views; equal meshes once.
pub(super) fn views(views: &[View<'_>]) -> Result<String, serde_json::Error> {
    let mut meshes = Vec::new();
    let mut stored = |mesh: &TriangleMesh| {
        let data = mesh_data(mesh);
        meshes
            .iter()
            .position(|known| *known == data)
            .unwrap_or_else(|| {
                meshes.push(data);
                meshes.len() - 1
            })
    };
    let views = views
        .iter()
        .filter(|view| !view.shots.is_empty())
        .map(|view| ViewData {
            scene: view.scene,
            a: stored(view.a),
            b: stored(view.b),
            shots: view.shots.iter().map(shot_data).collect(),
        })
        .collect();
    json(&Views { meshes, views })
}

fn mesh_data(mesh: &TriangleMesh) -> MeshData {
    // Single precision is finer than any screen.
    let positions = mesh.vertices().iter().flat_map(|v| v.as_vec3().to_array());
    let vertices: Vec<u8> = positions.flat_map(f32::to_le_bytes).collect();
    let corners = mesh.faces().iter().flatten();
    let faces: Vec<u8> = corners.flat_map(|corner| corner.to_le_bytes()).collect();
    MeshData {
        vertices: BASE64_STANDARD.encode(vertices),
        faces: BASE64_STANDARD.encode(faces),
    }
}

fn shot_data(shot: &Shot) -> ShotData {
    let query = &shot.query;
    let (kind, time, contact) = match &shot.answer.outcome {
        Outcome::Contact { time, contact } => ("contact", Some(*time), Some(contact)),
        Outcome::Free { .. } => ("free", None, None),
        Outcome::Touching { contact } => ("touching", Some(0.0), Some(contact)),
        Outcome::Overlapping { overlap } => match overlap {
            Overlap::Pieces(contact) => ("overlapping", Some(0.0), Some(contact)),
            Overlap::AInsideB(_) | Overlap::BInsideA(_) => ("overlapping", Some(0.0), None),
        },
        Outcome::Unresolved { safe_until, .. } => ("unresolved", Some(*safe_until), None),
    };
    ShotData {
        name: format!("{} ({kind})", query.id),
        status: status(&shot.answer.outcome, query.duration),
        duration: query.duration,
        time,
        contact: contact.map(contact_data),
        a: motion_data(&query.a),
        b: motion_data(&query.b),
    }
}

/// Describes an outcome in a sentence.
fn status(outcome: &Outcome, duration: f64) -> String {
    let at = |contact: &Contact| {
        let Contact {
            separation,
            feature_a,
            feature_b,
            ..
        } = contact;
        format!(
            "{feature_a} of A next to {feature_b} of B, distance between {:.3e} and {:.3e}",
            separation.lower, separation.upper
        )
    };
    match outcome {
        Outcome::Contact { time, contact } => {
            format!("Contact at {time:.6} of {duration}: {}.", at(contact))
        }
        Outcome::Free { proven_gap } => {
            format!("No contact until {duration}: never nearer than {proven_gap:.3e}.")
        }
        Outcome::Touching { contact } => format!("In contact at the start: {}.", at(contact)),
        Outcome::Overlapping { overlap } => match overlap {
            Overlap::Pieces(contact) => format!("Overlapping at the start: {}.", at(contact)),
            Overlap::AInsideB(_) => "Overlapping at the start: A inside B.".to_owned(),
            Overlap::BInsideA(_) => "Overlapping at the start: B inside A.".to_owned(),
        },
        Outcome::Unresolved { safe_until, .. } => {
            format!("Given up; no contact until {safe_until:.6} of {duration}.")
        }
    }
}

fn contact_data(contact: &Contact) -> ContactData {
    ContactData {
        witness_a: contact.separation.witness_a.to_array(),
        witness_b: contact.separation.witness_b.to_array(),
        normal: contact.separation.normal.to_array(),
    }
}

fn motion_data(motion: &Motion) -> MotionData {
    let from: DVec3 = motion.start().transform_point(motion.centre());
    let rotation = DMat3::from_quat(motion.start().rotation()).transpose();
    MotionData {
        centre: motion.centre().to_array(),
        from: from.to_array(),
        velocity: motion.velocity().to_array(),
        spin: motion.spin().to_array(),
        // Columns of the transpose.
        rotation: rotation.to_cols_array(),
    }
}

/// Serialises as JSON in which no tag can begin.
fn json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(serde_json::to_string(value)?.replace('<', "\\u003c"))
}
