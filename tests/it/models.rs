//! Tests that the models have the properties that other tests rely on, such as closed surfaces and convex parts.

use ccd_core::glam::DVec3;
use ccd_tests::models::{Shape, convex_solids, divided_l_prism, gear, l_prism, solids};
use std::collections::HashMap;

fn closed_models() -> impl Iterator<Item = (String, Shape)> {
    let all = solids().into_iter().chain(convex_solids());
    all.map(|model| (model.name, model.shape))
}

#[test]
fn every_edge_of_a_closed_model_has_two_faces_that_run_along_it_either_way() {
    for (name, shape) in closed_models() {
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for face in &shape.mesh.faces {
            for k in 0..3 {
                let (v, w) = (face[k], face[(k + 1) % 3]);
                *edges.entry((v.min(w), v.max(w))).or_default() += if v < w { 1 } else { 10 };
            }
        }
        assert!(
            edges.values().all(|&count| count == 11),
            "{name} is not closed"
        );
    }
}

#[test]
fn closed_models_are_not_inside_out() {
    for (name, shape) in closed_models() {
        let volume = shape.mesh.signed_volume();
        assert!(volume > 0.0, "{name}: {volume}");
    }
    assert!((l_prism().mesh.signed_volume() - 3.0).abs() < 1e-12);
    assert!((divided_l_prism(5).mesh.signed_volume() - 3.0).abs() < 1e-12);
}

#[test]
fn parts_have_their_points_below_their_facets() {
    for (name, shape) in closed_models() {
        for part in &shape.parts {
            for facet in &part.facets {
                let corner = |k: usize| part.points[facet.corners[k] as usize];
                let normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
                let height = |p: &DVec3| normal.dot(*p - corner(0));
                assert!(
                    part.points.iter().all(|p| height(p) <= 1e-12),
                    "{name}: {facet:?}"
                );
            }
        }
    }
}

/// Tests that the Euler characteristic of a gear, a closed surface with six holes, is 2 − 2 · 6.
#[test]
fn gears_have_a_bore_and_holes() {
    let mesh = gear(5).mesh;
    let characteristic = mesh.vertices.len() as i64 - mesh.faces.len() as i64 / 2;
    assert_eq!(characteristic, 2 - 2 * 6);
}
