//! Tests that contacts of patches have the feature numbers of the mesh.

use ccd_core::glam::DVec3;
use ccd_core::{Feature, Outcome, Settings};
use ccd_tests::backends::Backend;
use ccd_tests::models::PieceKind;
use ccd_tests::query::MovingShape;
use ccd_tests::referee::{nearest_on_segment, nearest_on_triangle};
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;
use std::collections::BTreeSet;

/// Tests that a contact of patches names the smallest mesh feature that contains the witness, or in a few cases an
/// adjacent face. A vertex is smaller than an edge, an edge than a face. For an edge between facets of several faces, a
/// patch names a face with it. On a virtual facet, inside the surface, no feature of the mesh is named.
#[test]
fn contacts_of_patches_name_the_mesh() {
    let counts: [Cell<u32>; 3] = Default::default();
    check_cases(250, cases(), |case| {
        let query = case.query();
        let shapes = [&query.a.shape, &query.b.shape];
        if !shapes
            .iter()
            .all(|shape| shape.can_be_made_of(PieceKind::Patches))
        {
            return Ok(());
        }
        let bodies = query.bodies([PieceKind::Patches; 2]);
        let config = Settings {
            tolerance: 1e-6,
            ..Settings::DEFAULT
        };
        let answer = Backend::DEFAULT.solve(&query.problem(&bodies, &config));
        if let Outcome::Contact { time, contact } = answer.outcome {
            let it = contact.separation;
            for (actor, witness, feature) in [
                (&query.a, it.witness_a, contact.feature_a),
                (&query.b, it.witness_b, contact.feature_b),
            ] {
                let holding = features_at(actor, time, witness, query.rounding());
                let name = classify_name(feature, &holding).ok_or_else(|| {
                    format!("{feature} at {witness} at {time}, where there are {holding:?}")
                })?;
                let count = &counts[name as usize];
                count.set(count.get() + 1);
            }
        }
        Ok(())
    });
    let [least, larger, none] = counts.map(|count| count.get());
    assert!(
        least > 50 && 2 * larger < least && 50 * none < least,
        "{least}, {larger}, {none}"
    );
}

/// The relation of a contact's feature name to the mesh features that contain the witness.
#[derive(Clone, Copy)]
enum FeatureNameMatch {
    /// The name is that of the smallest feature that contains the witness: a vertex before an edge, an edge before a
    /// face.
    SmallestFeature,
    /// The smallest feature at the witness is an edge, and the name is that of an adjacent face.
    LargerFeature,
    /// The name is no feature of the mesh, because no mesh feature contains the witness.
    None,
}

/// Returns how a feature name relates to the mesh features that contain the witness; `None` for a wrong name.
fn classify_name(feature: Feature, holding: &BTreeSet<Feature>) -> Option<FeatureNameMatch> {
    match (feature, holding.first()) {
        (Feature::Piece(_), None) => Some(FeatureNameMatch::None),
        (named, Some(&least)) if named == least => Some(FeatureNameMatch::SmallestFeature),
        (Feature::Face(_), Some(Feature::Edge(..))) => holding
            .contains(&feature)
            .then_some(FeatureNameMatch::LargerFeature),
        _ => None,
    }
}

/// Returns all features of the mesh that contain a point at a time; vertices come first, then edges.
fn features_at(actor: &MovingShape, time: f64, point: DVec3, rounding: f64) -> BTreeSet<Feature> {
    let (pose, mesh) = (actor.motion.pose(time), &actor.shape.mesh);
    let at = |v: u32| pose.transform_point(mesh.vertices[v as usize]);
    let is_on = |nearest: DVec3| nearest.distance(point) <= rounding;
    let mut out = BTreeSet::new();
    for (face, &corners) in (0..).zip(&mesh.faces) {
        if !is_on(nearest_on_triangle(point, corners.map(at))) {
            continue;
        }
        out.insert(Feature::Face(face));
        for k in 0..3 {
            let (v, w) = (corners[k], corners[(k + 1) % 3]);
            if is_on(at(v)) {
                out.insert(Feature::Vertex(v));
            }
            if is_on(nearest_on_segment(point, [at(v), at(w)])) {
                out.insert(Feature::edge(v, w));
            }
        }
    }
    out
}
