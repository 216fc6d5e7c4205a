//! Scenes to view in three dimensions, on a page.

use ccd_core::{Answer, Contact, Outcome, Overlap};
use ccd_decomp::TriangleMesh;
use ccd_view::{DrawnMesh, Group, Meshes, ShownBody, ShownContact};
use rigid_ccd::picture::{COLORS, GapOverTime};
use rigid_ccd::table::motions::Motions;

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

/// A motion of a view, with its description.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The motions.
    pub query: Motions,
    /// The name.
    pub name: String,
    /// The event, in a sentence.
    pub status: String,
    /// The time to show; `None` shows the end.
    pub time: Option<f64>,
    /// The contact at that time, if it is known.
    pub contact: Option<Contact>,
    /// The gap over time, if it was measured.
    pub gap: Option<GapOverTime>,
}

impl Shot {
    /// Returns the shot of a query that was answered.
    pub fn answered(query: Motions, answer: &Answer) -> Self {
        let (kind, time, contact) = match &answer.outcome {
            Outcome::Contact { time, contact } => ("contact", Some(*time), Some(*contact)),
            Outcome::Free { .. } => ("free", None, None),
            Outcome::Touching { contact } => ("touching", Some(0.0), Some(*contact)),
            Outcome::Overlapping { overlap, .. } => match overlap {
                Overlap::Pieces(contact) => ("overlapping", Some(0.0), Some(*contact)),
                Overlap::AInsideB(_) | Overlap::BInsideA(_) => ("overlapping", Some(0.0), None),
            },
            Outcome::Unresolved(known) => ("unresolved", Some(known.safe_until), None),
            Outcome::Interval { .. } | Outcome::Measured { .. } => ("measured", None, None),
        };
        Shot {
            name: format!("{} ({kind})", query.id),
            status: status(&answer.outcome, query.duration),
            query,
            time,
            contact,
            gap: None,
        }
    }
}

/// Returns the views as JSON; equal meshes are stored once.
pub(super) fn data(views: &[View<'_>]) -> Result<String, serde_json::Error> {
    let mut meshes = Meshes::default();
    let groups: Vec<Group> = (views.iter().filter(|view| !view.shots.is_empty()))
        .map(|view| {
            let numbers = [view.a, view.b].map(|mesh| meshes.add(&drawn(mesh)));
            Group {
                name: view.scene.to_owned(),
                views: view.shots.iter().map(|shot| shown(shot, numbers)).collect(),
            }
        })
        .collect();
    ccd_view::data(&meshes, &groups)
}

fn drawn(mesh: &TriangleMesh) -> DrawnMesh {
    DrawnMesh {
        vertices: mesh.vertices().to_vec(),
        faces: mesh.faces().to_vec(),
    }
}

fn shown(shot: &Shot, meshes: [usize; 2]) -> ccd_view::View {
    let query = &shot.query;
    let time = shot.time.unwrap_or(query.duration);
    let bodies = [("A", query.a), ("B", query.b)].into_iter().zip(meshes);
    let bodies = bodies.zip(COLORS);
    let contact = shot.contact.map(|contact| ShownContact {
        time,
        words: shot.status.clone(),
        witnesses: Some([contact.separation.witness_a, contact.separation.witness_b]),
        normal: Some(contact.separation.normal),
        lit_a: Vec::new(),
        lit_b: Vec::new(),
    });
    ccd_view::View {
        time: match (&shot.time, &shot.gap) {
            (None, Some(gap)) => gap.nearest(),
            _ => time,
        },
        origin: query.b.start().translation().to_array(),
        bodies: bodies
            .map(|(((name, motion), mesh), color)| ShownBody::new(name, mesh, color, &motion))
            .collect(),
        ghosts: match &shot.gap {
            Some(gap) => gap.ghosts(query.duration),
            // The poses at the start and at the end.
            None => vec![0.0, query.duration],
        },
        gap: shot.gap.as_ref().map(|found| found.gap.clone()),
        contacts: contact.into_iter().collect(),
        ..ccd_view::View::new(&shot.name, &shot.status, query.duration)
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
        Outcome::Free { .. } => format!("No contact until {duration}."),
        Outcome::Touching { contact } => format!("In contact at the start: {}.", at(contact)),
        Outcome::Overlapping { overlap, .. } => match overlap {
            Overlap::Pieces(contact) => format!("Overlapping at the start: {}.", at(contact)),
            Overlap::AInsideB(_) => "Overlapping at the start: A inside B.".to_owned(),
            Overlap::BInsideA(_) => "Overlapping at the start: B inside A.".to_owned(),
        },
        Outcome::Unresolved(known) => {
            let until = known.safe_until;
            format!("Given up; no contact until {until:.6} of {duration}.")
        }
        Outcome::Interval { .. } | Outcome::Measured { .. } => String::new(),
    }
}
