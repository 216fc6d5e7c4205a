use super::*;
use crate::mesh::TriangleMesh;
use crate::solid::crossings::faces_cross;
use crate::solid::topology::TopologyDefects;
use crate::test_meshes::{comb, merged_meshes, scaled_and_moved, tetrahedron};
use ccd_core::glam::{DQuat, dvec3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Returns a comb with teeth of the given heights, and a tetrahedron at each of the given places, all rotated by an
/// angle.
fn rotated_comb_with_tetrahedra(heights: &[f64], places: &[[i32; 4]], turn: f64) -> TriangleMesh {
    let comb = comb(heights);
    let thorn = tetrahedron();
    let thorns: Vec<_> = places
        .iter()
        .map(|&[x, y, z, scale]| {
            let place = 0.5 * dvec3(x.into(), y.into(), z.into());
            scaled_and_moved(&thorn, 0.5 * f64::from(scale), place)
        })
        .collect();
    let parts: Vec<&TriangleMesh> = [&comb].into_iter().chain(&thorns).collect();
    let all = merged_meshes(&parts);
    let turn = DQuat::from_rotation_x(turn) * DQuat::from_rotation_z(turn);
    let turned = all.vertices().iter().map(|&p| turn * p);
    crate::test_meshes::mesh(turned.collect(), all.faces())
}

/// Tests that every pair of faces that intersect is reported exactly once, against an exact test of all pairs.
#[test]
fn whoever_meets_is_reported() {
    let place = [-1..80_i32, -1..12_i32, -2..4_i32, 1..4_i32];
    let height = prop_oneof![Just(5.0), 1.5..6.0_f64];
    let turn = prop_oneof![Just(0.0), Just(0.0), 0.0..3.0_f64];
    let given = (
        prop::collection::vec(height, 18..36),
        prop::collection::vec(place, 0..6),
        turn,
    );
    let mut runner = TestRunner::deterministic();
    let (mut meeting, mut with_polygons, mut asked, mut all) = (0, 0, 0, 0);
    for _ in 0..60 {
        let (heights, places, turn) = given.new_tree(&mut runner).unwrap().current();
        let mesh = rotated_comb_with_tetrahedra(&heights, &places, turn);
        let Ok(manifold) = Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh))
        else {
            continue;
        };
        let Some(polygons) = FannedPolygons::from_manifold(&manifold) else {
            continue;
        };
        let faces = mesh.faces().len() as u32;
        let mut reported = Vec::new();
        for face in 0..faces {
            let region = Region::from_triangle(manifold.triangle(face));
            polygons.all_near_faces_satisfy(face, &region, &WorkBudget::unbounded(), |other| {
                reported.push((face.min(other), face.max(other)));
                true
            });
        }
        reported.sort_unstable();
        assert!(reported.windows(2).all(|pair| pair[0] != pair[1]));
        let on_polygon = |face: u32| polygons.polygon_of_face[face as usize] != NO_POLYGON;
        for (f, g) in (0..faces).flat_map(|f| (f + 1..faces).map(move |g| (f, g))) {
            let is_reported = reported.binary_search(&(f, g)).is_ok();
            if on_polygon(f) || on_polygon(g) {
                asked += u32::from(is_reported);
                all += 1;
            }
            if faces_cross(&manifold, f, g) {
                meeting += 1;
                with_polygons += u32::from(on_polygon(f) || on_polygon(g));
                assert!(is_reported, "{f}, {g}");
            }
        }
    }
    assert!(
        meeting > 200 && with_polygons > 100,
        "{meeting}, {with_polygons}"
    );
    assert!(asked < all / 100, "{asked} of {all}");
}

/// Tests that faces that share an edge or a corner with a polygon's boundary are separated from it without building the
/// search tree over the polygon's triangles.
#[test]
fn a_comb_is_next_to_its_polygons() {
    let mesh = comb(&[5.0; 40]);
    let manifold =
        Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh)).unwrap();
    let polygons = FannedPolygons::from_manifold(&manifold).unwrap();
    assert_eq!(polygons.polygons.len(), 2);
    assert!(
        polygons
            .polygons
            .iter()
            .all(|polygon| polygon.faces.len() == 80)
    );
    for face in 0..mesh.faces().len() as u32 {
        let region = Region::from_triangle(manifold.triangle(face));
        polygons.all_near_faces_satisfy(face, &region, &WorkBudget::unbounded(), |other| {
            assert_eq!(polygons.polygon_of_face[other as usize], NO_POLYGON);
            true
        });
    }
    assert!(
        polygons
            .polygons
            .iter()
            .all(|polygon| polygon.triangle_trees.get().is_none())
    );
}
