//! Scenes to view in three dimensions, on a page.

use super::page::json;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::{Answer, Contact, InputError, Motion, Outcome, Overlap, Pose};
use ccd_decomp::TriangleMesh;
use rigid_ccd::table::motions::Query;
use serde::Serialize;

/// What shows the scenes, and the script that does it.
pub(super) const CONTROLS: &str = include_str!("view/controls.html");
pub(super) const SCRIPT: &str = include_str!("view/view.js");

/// A scene to view.
#[derive(Clone, Debug)]
pub struct View<'a> {
    /// The scene's name.
    pub scene: &'a str,
    /// The mesh of body A.
    pub a: &'a TriangleMesh,
    /// The mesh of body B; equal meshes are stored once, for all views.
    pub b: &'a TriangleMesh,
    /// The motions of both bodies.
    pub shots: Vec<Shot>,
}

/// A motion of a view, and what is said about it.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The motions.
    pub query: Query,
    /// The name.
    pub name: String,
    /// What happens, in a sentence.
    pub status: String,
    /// The time to show; `None` shows the end.
    pub time: Option<f64>,
    /// The contact at that time, if it is known.
    pub contact: Option<Contact>,
}

impl Shot {
    /// Returns the shot of a query that was answered.
    pub fn answered(query: Query, answer: &Answer) -> Self {
        let (kind, time, contact) = match &answer.outcome {
            Outcome::Contact { time, contact } => ("contact", Some(*time), Some(*contact)),
            Outcome::Free { .. } => ("free", None, None),
            Outcome::Touching { contact } => ("touching", Some(0.0), Some(*contact)),
            Outcome::Overlapping { overlap } => match overlap {
                Overlap::Pieces(contact) => ("overlapping", Some(0.0), Some(*contact)),
                Overlap::AInsideB(_) | Overlap::BInsideA(_) => ("overlapping", Some(0.0), None),
            },
            Outcome::Unresolved { safe_until, .. } => ("unresolved", Some(*safe_until), None),
        };
        Shot {
            name: format!("{} ({kind})", query.id),
            status: status(&answer.outcome, query.duration),
            query,
            time,
            contact,
        }
    }
}

/// Moves a query's world, so that body B starts at its origin: pictures are drawn in single precision.
///
/// # Errors
/// If the numbers overflow.
pub fn near_origin(query: &Query) -> Result<Query, InputError> {
    let origin = query.b.start().translation();
    let moved = |motion: &Motion| -> Result<Motion, InputError> {
        let start = motion.start();
        let place: DVec3 = start.translation() - origin;
        let pose = Pose::new(place, start.rotation())?;
        Motion::about(pose, motion.velocity(), motion.spin(), motion.centre())
    };
    Ok(Query {
        a: moved(&query.a)?,
        b: moved(&query.b)?,
        ..query.clone()
    })
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
    shots: Vec<ShotData<'a>>,
}

#[derive(Serialize)]
struct ShotData<'a> {
    name: &'a str,
    status: &'a str,
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

/// Serialises the meshes, motions and answers of the views; equal meshes once.
pub(super) fn data(views: &[View<'_>]) -> Result<String, serde_json::Error> {
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

fn shot_data(shot: &Shot) -> ShotData<'_> {
    let query = &shot.query;
    ShotData {
        name: &shot.name,
        status: &shot.status,
        duration: query.duration,
        time: shot.time,
        contact: shot.contact.as_ref().map(contact_data),
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
