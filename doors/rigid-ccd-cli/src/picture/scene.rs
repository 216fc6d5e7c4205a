//! Draws a scene of many bodies as a view of a page.

use super::drawn::{drawn_mesh, feature_corners};
use super::verdict::format_rounded_down;
use ccd_core::glam::DVec3;
use ccd_core::{Body, Feature, HitKind, Motion};
use ccd_view::{Animation, Meshes, ShownBody, ShownContact};
use rigid_ccd::scene::{Impact, PairError};
use std::collections::HashMap;

/// The colour of bodies that do not move, in CSS.
pub(crate) const FIXED_COLOR: &str = "#b8b8b8";

/// Returns the colour of the body of a number, in CSS. From one number to the next the hue turns by the golden angle.
pub(crate) fn numbered_body_color(number: usize) -> String {
    const HUE_STEP_DEGREES: f64 = 137.508;
    let hue = (150.0 + HUE_STEP_DEGREES * number as f64) % 360.0;
    format!("hsl({hue:.0}, 55%, 52%)")
}

/// A body of a scene to draw, with its name in the legend.
#[derive(Clone, Debug)]
pub(crate) struct DrawnBody<'a> {
    pub(crate) name: String,
    pub(crate) body: &'a Body,
    pub(crate) motion: Motion,
}

/// Returns the view of all bodies and their contacts; the contacts are in order of time. Bodies that are the same are
/// drawn from one mesh.
pub(crate) fn scene_view(
    name: &str,
    bodies: &[DrawnBody<'_>],
    contacts: &[Result<Impact, PairError>],
    duration: f64,
) -> (Meshes, Animation) {
    let mut meshes = Meshes::default();
    let mut mesh_by_body = HashMap::new();
    let bodies_shown = bodies.iter().enumerate().map(|(k, body)| {
        let address: *const Body = body.body;
        let mesh = *mesh_by_body
            .entry(address)
            .or_insert_with(|| meshes.add(&drawn_mesh(body.body)));
        let moves = body.motion.velocity().length() + body.motion.angular_velocity().length() > 0.0;
        let color = if moves {
            numbered_body_color(k)
        } else {
            FIXED_COLOR.to_owned()
        };
        ShownBody::new(&body.name, mesh, &color, &body.motion)
    });
    let bodies_shown: Vec<ShownBody> = bodies_shown.collect();
    let hits = impacts(contacts);
    let origin = bodies
        .first()
        .zip(bodies_shown.first())
        .map_or(DVec3::ZERO, |(body, first)| {
            body.motion
                .start()
                .transform_point(meshes.middle(first.mesh))
        });
    let view = Animation {
        bodies: bodies_shown,
        contacts: hits.iter().map(|impact| contact(bodies, impact)).collect(),
        time: hits.first().map_or(0.0, |impact| impact.hit.time),
        origin: origin.to_array(),
        ..Animation::new(name, &scene_verdict(bodies, contacts, duration), duration)
    };
    (meshes, view)
}

/// Describes which bodies touch.
pub(crate) fn scene_verdict(
    bodies: &[DrawnBody<'_>],
    contacts: &[Result<Impact, PairError>],
    duration: f64,
) -> String {
    let hits = impacts(contacts);
    let body_count = match bodies.len() {
        1 => "One body".to_owned(),
        count => format!("{count} bodies"),
    };
    let end = format!("to the end at {}", format_rounded_down(duration));
    let mut text = match hits.first() {
        None if contacts.is_empty() => format!("{body_count}, no contact, {end}. Proven."),
        None => format!("{body_count}, no contact found, {end}."),
        Some(first) => {
            let [a, b] = first.bodies.map(|k| &bodies[k].name);
            format!(
                "{body_count}, {} in contact, {end}. The first at {}: {a} and {b}. Proven: no pair touches before its time.",
                pair_count_text(hits.len()),
                format_rounded_down(first.hit.time),
            )
        }
    };
    if let Some(error) = contacts.iter().find_map(|result| result.as_ref().err()) {
        let [a, b] = error.bodies.map(|k| &bodies[k].name);
        let unanswered_count = contacts.len() - hits.len();
        text += &format!(
            " {} without an answer, such as {a} and {b}: {}.",
            pair_count_text(unanswered_count),
            error.error
        );
    }
    text
}

fn impacts(contacts: &[Result<Impact, PairError>]) -> Vec<&Impact> {
    let hits = contacts.iter().filter_map(|result| result.as_ref().ok());
    hits.collect()
}

fn pair_count_text(count: usize) -> String {
    match count {
        1 => "one pair".to_owned(),
        count => format!("{count} pairs"),
    }
}

fn contact(bodies: &[DrawnBody<'_>], impact: &Impact) -> ShownContact {
    let Impact {
        bodies: [a, b],
        hit,
    } = *impact;
    let (a, b) = (&bodies[a], &bodies[b]);
    let corners_of = |body: &DrawnBody<'_>, feature: Option<Feature>, witness: DVec3| {
        let pose = body.motion.pose(hit.time);
        let feature = feature.map_or_else(String::new, |feature| feature.to_string());
        feature_corners(body.body, &pose, &feature, witness)
    };
    let when = match hit.kind {
        HitKind::Contact(_) => format_rounded_down(hit.time),
        HitKind::Touching(_) => "at the start".to_owned(),
        HitKind::Overlapping(_) => "overlapping at the start".to_owned(),
    };
    let (touching, witness_a, witness_b) = (hit.contact(), hit.witness_a(), hit.witness_b());
    ShownContact {
        time: hit.time,
        words: format!("{when}: {} and {}", a.name, b.name),
        highlight_a: corners_of(a, touching.map(|contact| contact.feature_a), witness_a),
        highlight_b: corners_of(b, touching.map(|contact| contact.feature_b), witness_b),
        witnesses: Some([witness_a, witness_b]),
        normal: touching.map(|contact| contact.separation.normal),
    }
}
