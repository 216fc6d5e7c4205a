//! Tests the list of all pairs of features that are in contact at the time of an answer.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::{Contact, Feature, Outcome, Settings};
use ccd_tests::analytic::scenes_with_name_prefix;
use ccd_tests::backends::Backend;
use ccd_tests::case::Case;
use ccd_tests::checks::CheckResult;
use ccd_tests::distances::distance_to_mesh_feature;
use ccd_tests::models::PieceKind;
use ccd_tests::query::{Bodies, MovingShape, Query};
use ccd_tests::strategies::{cases, check_cases, scaled_and_remote_cases};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

/// Returns the time and the upper bound of the distance of the first contact, if there is one.
fn first_contact(problem: &ccd_core::Query<'_>) -> Option<(f64, f64)> {
    match Backend::DEFAULT.solve(problem).outcome {
        Outcome::Contact { time, contact } => Some((time, contact.separation.upper)),
        Outcome::Touching { contact } => Some((0.0, contact.separation.upper)),
        _ => None,
    }
}

/// Returns the contacts of the scene with a given name, for every kind of pieces.
fn scene_contacts(name: &str) -> Vec<([PieceKind; 2], Vec<Contact>)> {
    let scenes = scenes_with_name_prefix(name);
    let query = &scenes[0].query;
    let bodies = query.bodies_of_kind_pairs();
    let of_kind = |bodies: &Bodies| {
        let problem = query.problem(bodies, &Settings::DEFAULT);
        let (time, _) = first_contact(&problem).expect("a hit");
        (
            bodies.piece_kinds,
            problem.contacts_at(time).expect("contacts"),
        )
    };
    bodies.iter().map(of_kind).collect()
}

/// Tests that each upright edge of a peg in a square hole touches both rims of one wall of the hole.
#[test]
fn t12_a_peg_touches_four_walls_at_once() {
    for (kinds, pairs) in scene_contacts("T12 ") {
        let mut rims: BTreeMap<Feature, BTreeSet<Feature>> = BTreeMap::new();
        for pair in &pairs {
            rims.entry(pair.feature_a)
                .or_default()
                .insert(pair.feature_b);
        }
        let upright = [(0, 4), (1, 5), (2, 6), (3, 7)].map(|(v, w)| Feature::Edge(v, w));
        assert!(rims.keys().eq(&upright), "{kinds:?} {rims:?}");
        assert!(
            rims.values().all(|rims| rims.len() == 2),
            "{kinds:?} {rims:?}"
        );
        assert_eq!(pairs.len(), 8, "{kinds:?}");
        let spread = pairs[7].separation.upper - pairs[0].separation.upper;
        assert!(spread < 1e-9, "four walls are as near: {spread}");
        for pair in &pairs {
            let at = pair.separation.witness_a;
            assert!((at.z.abs() - 0.25).abs() < 1e-12, "{pair:?}");
            // Each wall is one unit away from the middle, along an axis.
            let n = pair.separation.normal;
            assert!(
                n.abs().max_element() > 1.0 - 1e-12 && n.dot(at) > 0.0,
                "{pair:?}"
            );
        }
    }
}

/// Tests that the four corners of every tooth of two combs touch the other comb's base.
#[test]
fn t19_all_tips_of_two_combs_touch() {
    for (kinds, pairs) in scene_contacts("T19 combs of 4") {
        assert_eq!(pairs.len(), 2 * 4 * 4, "{kinds:?}: {pairs:?}");
        let tip = |feature| matches!(feature, Feature::Vertex(_));
        for pair in &pairs {
            assert!(tip(pair.feature_a) != tip(pair.feature_b), "{pair:?}");
            assert!(pair.separation.normal.z < -1.0 + 1e-9, "{pair:?}");
        }
    }
}

#[test]
fn t1_a_cube_rests_on_its_corners() {
    for (kinds, pairs) in scene_contacts("T1 ") {
        assert_eq!(pairs.len(), 4, "{kinds:?}: {pairs:?}");
        for pair in &pairs {
            let standing = matches!(
                (pair.feature_a, pair.feature_b),
                (Feature::Vertex(0..4), Feature::Face(_))
            );
            assert!(standing, "{kinds:?} {pair:?}");
        }
    }
}

/// Tests that two equal plates of 512 triangles, one on the other, touch at each pair of coinciding vertices.
#[test]
fn plates_meet_vertex_by_vertex() {
    for (kinds, pairs) in scene_contacts("plates") {
        assert_eq!(pairs.len(), 17 * 17, "{kinds:?}");
        for Contact {
            feature_a,
            feature_b,
            ..
        } in pairs
        {
            assert!(matches!(feature_a, Feature::Vertex(_)) && feature_a == feature_b);
        }
    }
}

/// Tests that the listed contacts of random cases include one as near as the first contact, and name the same features
/// for all kinds of pieces.
#[test]
fn contacts_of_random_cases_hold() {
    let (reported, same, coarser) = (Cell::new(0), Cell::new(0), Cell::new(0));
    let law = |case: &Case| -> CheckResult {
        let query = case.query();
        let mut at = None;
        let mut exact: Option<BTreeSet<Names>> = None;
        for bodies in query.bodies_of_kind_pairs() {
            let settings = case.config();
            let problem = query.problem(&bodies, &settings);
            let Some((time, upper)) = at.map_or_else(|| first_contact(&problem), Some) else {
                continue;
            };
            at.get_or_insert((time, upper));
            let pairs = problem
                .contacts_at(time)
                .map_err(|error| error.to_string())?;
            let apart = case.config().margin + problem.tolerance();
            check_pairs(&query, &pairs, [time, upper, apart], bodies.piece_kinds)?;
            reported.set(reported.get() + pairs.len());
            let names = pairs.iter().map(|pair| [pair.feature_a, pair.feature_b]);
            let names: BTreeSet<Names> = names.collect();
            let exact = match &exact {
                None if bodies.piece_kinds == [PieceKind::Triangles; 2] => {
                    exact.insert(names.clone())
                }
                Some(exact) if !bodies.piece_kinds.contains(&PieceKind::ConvexParts) => exact,
                _ => continue,
            };
            let count = if *exact == names { &same } else { &coarser };
            count.set(count.get() + 1);
            if !are_equivalent_feature_names(&query, &names, exact) {
                return Err(format!("{:?}: {exact:?}, {names:?}", bodies.piece_kinds));
            }
        }
        Ok(())
    };
    check_cases(160, cases(), law);
    check_cases(80, scaled_and_remote_cases(), law);
    let (reported, same, coarser) = (reported.get(), same.get(), coarser.get());
    assert!(
        reported > 400 && same > 200 && 20 * coarser < same,
        "{reported} {same} {coarser}"
    );
}

type Names = [Feature; 2];

/// Returns whether `names` denote the same features as `exact`, the names on bodies of single triangles. A corner or an edge without a
/// number in a patch may have the name of an adjacent face.
fn are_equivalent_feature_names(
    query: &Query,
    names: &BTreeSet<Names>,
    exact: &BTreeSet<Names>,
) -> bool {
    let meshes = [&query.a, &query.b].map(|actor| &actor.shape.mesh);
    let fits = |name: &Names, exact: &Names| {
        (0..2).all(|k| {
            let corners = |face: u32| meshes[k].faces[face as usize];
            match (name[k], exact[k]) {
                (Feature::Face(face), Feature::Vertex(v)) => corners(face).contains(&v),
                (Feature::Face(face), Feature::Edge(v, w)) => {
                    corners(face).contains(&v) && corners(face).contains(&w)
                }
                (name, exact) => name == exact,
            }
        })
    };
    names
        .iter()
        .all(|name| exact.iter().any(|it| fits(name, it)))
        && exact
            .iter()
            .all(|it| names.iter().any(|name| fits(name, it)))
}

/// Checks every listed pair against the mesh, and the nearest pair against the reported contact.
fn check_pairs(
    query: &Query,
    pairs: &[Contact],
    [time, upper, apart]: [f64; 3],
    kinds: [PieceKind; 2],
) -> CheckResult {
    let rounding = query.rounding();
    let nearest = pairs
        .first()
        .ok_or_else(|| format!("{kinds:?}: no contact at {time}"))?;
    if nearest.separation.upper > upper + rounding {
        let nearest = nearest.separation.upper;
        return Err(format!("{kinds:?}: the nearest is {nearest}, not {upper}"));
    }
    for pair in pairs {
        let it = pair.separation;
        let distance = it.witness_a.distance(it.witness_b);
        let along = (it.witness_b - it.witness_a).dot(it.normal);
        let good = it.lower <= apart
            && it.lower <= along + rounding
            && (it.lower - rounding..=it.upper + rounding).contains(&distance)
            && (it.normal.length() - 1.0).abs() <= 1e-12;
        let off_a = distance_from_feature(&query.a, time, pair.feature_a, it.witness_a);
        let off_b = distance_from_feature(&query.b, time, pair.feature_b, it.witness_b);
        let parts = kinds.contains(&PieceKind::ConvexParts);
        if !good || !parts && !(greater(off_a, off_b) <= rounding) {
            return Err(format!(
                "{kinds:?}: {pair:?} at {time}: off by {off_a}, {off_b}"
            ));
        }
    }
    Ok(())
}

/// Returns the distance from a point to a feature of the mesh at a time. It is infinite if the mesh does not have the
/// feature.
fn distance_from_feature(actor: &MovingShape, time: f64, feature: Feature, point: DVec3) -> f64 {
    let (pose, mesh) = (actor.motion.pose(time), &actor.shape.mesh);
    let to_world = |p| pose.transform_point(p);
    distance_to_mesh_feature(point, feature, mesh, to_world).unwrap_or(f64::INFINITY)
}
