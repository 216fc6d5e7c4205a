use super::*;
use crate::bounds::BoundingBox;
use crate::exact::predicates::{is_degenerate, side_of_plane};
use crate::exact::rays::segment_crossing_sign;
use crate::exact::triangles::triangles_meet;
use crate::hull::exact_hull::ExactHull;
use crate::test_meshes::star_bipyramid;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::Triangle;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::cmp::Ordering;

fn near_faces(boxes: &TriangleBoxes, region: &Region) -> Vec<u32> {
    let mut found = Vec::new();
    boxes.all_near_faces_satisfy(region, &WorkBudget::unbounded(), |face| {
        found.push(face);
        true
    });
    found.sort_unstable();
    found
}

/// Tests that at most 24 triangles are reported near a triangle of a fan, for fans of up to 4,096 slivers.
#[test]
fn slivers_are_near_few_others() {
    for corners in [64, 512, 4096] {
        let mesh = star_bipyramid(corners, 0.5);
        let boxes = TriangleBoxes::new(mesh.vertices(), mesh.faces());
        let triangle = |face: usize| mesh.faces()[face].map(|v| mesh.vertices()[v as usize]);
        let most = (0..mesh.faces().len()).step_by(37).map(|face| {
            let near = near_faces(&boxes, &Region::from_triangle(triangle(face)));
            assert!(near.contains(&(face as u32)));
            near.len()
        });
        let most = most.max().unwrap();
        assert!(most <= 24, "{most} of {corners}");
    }
}

/// Tests that every triangle that meets a query triangle is reported, against an exact test of all pairs.
#[test]
fn nothing_that_meets_is_left_out() {
    let mesh = star_bipyramid(64, 0.5);
    // Rotated and moved, so that slivers of the two intersect.
    let turn = ccd_core::glam::DQuat::from_rotation_x(0.7);
    let moved = |p: DVec3| turn * p + DVec3::new(0.3, 0.2, 0.1);
    let boxes = TriangleBoxes::new(mesh.vertices(), mesh.faces());
    let mut meeting = 0;
    for face in mesh.faces() {
        let one = face.map(|v| moved(mesh.vertices()[v as usize]));
        let near = near_faces(&boxes, &Region::from_triangle(one));
        for (k, other) in (0..).zip(mesh.faces()) {
            let other = other.map(|v| mesh.vertices()[v as usize]);
            if triangles_meet([one, other]) {
                meeting += 1;
                assert!(near.contains(&k));
            }
        }
    }
    assert!(meeting > 100, "{meeting}");
}

/// Tests that a hub that only touches a triangle, inside it or on its edge, is found with its whole fan.
#[test]
fn a_hub_that_touches_is_not_left_out() {
    let mesh = star_bipyramid(64, 0.5);
    let boxes = TriangleBoxes::new(mesh.vertices(), mesh.faces());
    let [a, b] = [DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 1.0)];
    let amid = [a, DVec3::new(1.0, -1.0, 1.0), DVec3::new(0.0, 2.0, 1.0)];
    for touching in [amid, [a, b, DVec3::new(3.0, -1.0, 1.0)]] {
        assert_eq!(
            near_faces(&boxes, &Region::from_triangle(touching)).len(),
            64
        );
    }
    // Next to the tip, in the plane that touches it.
    let beside = [a, b, DVec3::new(-1.0, 4.0, 1.0)].map(|p| p + DVec3::Y);
    assert!(near_faces(&boxes, &Region::from_triangle(beside)).is_empty());
}

fn any_coordinate() -> impl Strategy<Value = f64> {
    // On a grid, with many contacts and coplanar triangles, and anywhere.
    prop_oneof![(-2i32..=2).prop_map(|x| 0.5 * f64::from(x)), -1.0..1.0f64]
}

fn corner() -> impl Strategy<Value = DVec3> {
    (any_coordinate(), any_coordinate(), any_coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Generates triangles around a common vertex, and other triangles; in some cases many triangles are coplanar.
fn soup() -> impl Strategy<Value = (Vec<DVec3>, Vec<[u32; 3]>)> {
    let corners = prop::collection::vec(corner(), 50..120);
    (corners, any::<bool>(), 0..100u32).prop_map(|(mut points, flat, fan)| {
        if flat {
            points[..40].iter_mut().for_each(|p| p.z = 0.0);
        }
        let n = points.len() as u32;
        let about = (1..fan.min(n - 1)).map(|k| [0, k, k + 1]);
        let others = (0..n - 2).map(|k| [k, k + 1, (7 * k + 3) % n]);
        let faces: Vec<[u32; 3]> = about.chain(others).collect();
        (points, faces)
    })
}

/// Tests that all triangles that meet a query shape are found: a triangle, a segment or the interior of a
/// tetrahedron. The comparison is exact and with every triangle.
#[test]
fn skipped_triangles_meet_nothing() {
    let probes = prop::collection::vec([corner(), corner(), corner(), corner()], 20);
    let given = (soup(), probes);
    let mut runner = TestRunner::deterministic();
    let mut met = [0, 0, 0];
    let (mut asked, mut near) = (0, 0);
    for _ in 0..60 {
        let ((points, faces), probes) = given.new_tree(&mut runner).unwrap().current();
        let boxes = TriangleBoxes::new(&points, &faces);
        let at = |face: &[u32; 3]| face.map(|v| points[v as usize]);
        let own = faces.iter().step_by(5).map(|face| {
            let [a, b, c] = at(face);
            [a, b, c, 0.5 * (a + b) + DVec3::Z]
        });
        for probe in probes.into_iter().chain(own) {
            let [a, b, c, _] = probe;
            if is_degenerate([a, b, c]) {
                continue;
            }
            let facets = ExactHull::facets_of(&probe).unwrap_or_default().into_iter();
            let facets: Vec<[DVec3; 3]> = facets.map(|f| f.map(|v| probe[v as usize])).collect();
            let inside = Region::from_box_and_hull(
                probe.to_vec(),
                facets.clone(),
                BoundingBox::enclosing(probe),
            );
            let regions = [
                Region::from_triangle([a, b, c]),
                Region::segment([a, b]),
                inside,
            ];
            let found = regions.map(|region| near_faces(&boxes, &region));
            asked += faces.len();
            near += found[0].len();
            for (k, face) in (0..).zip(&faces) {
                let corners = at(face);
                if is_degenerate(corners) {
                    continue;
                }
                let is_inside = |p: &DVec3| {
                    let behind = |&facet: &[DVec3; 3]| side_of_plane(facet, *p) == Ordering::Less;
                    !facets.is_empty() && facets.iter().all(behind)
                };
                // A common corner alone need not be found.
                let shares = [a, b, c].iter().any(|p| corners.contains(p));
                let meets = [
                    !shares && triangles_meet([[a, b, c], corners]),
                    matches!(segment_crossing_sign([a, b], corners), Some(1 | -1)),
                    corners.iter().any(is_inside)
                        || is_inside(&(corners.iter().sum::<DVec3>() / 3.0)),
                ];
                for l in 0..3 {
                    met[l] += u32::from(meets[l]);
                    assert!(!meets[l] || found[l].binary_search(&k).is_ok());
                }
            }
        }
    }
    assert!(met.iter().all(|&count| count > 100), "{met:?}");
    assert!(near < asked / 10 * 9, "{near} of {asked}");
}

/// Tests that a search finds the nearest triangle, and the triangles whose boxes meet a box, as a scan of every
/// triangle does.
#[test]
fn the_nearest_triangle_is_found() {
    let given = (soup(), prop::collection::vec([corner(), corner()], 40));
    let mut runner = TestRunner::deterministic();
    let (mut met, mut missed) = (0, 0);
    for _ in 0..40 {
        let ((points, faces), probes) = given.new_tree(&mut runner).unwrap().current();
        let search = BoxTree::from_faces(&points, &faces, 0..faces.len() as u32);
        let at = |face: &[u32; 3]| face.map(|v| points[v as usize]);
        for [p, q] in probes {
            let point = 2.0 * p;
            let distance = |corners: [DVec3; 3]| {
                let [a, b, c] = corners.map(|p| Vector::new(p.x, p.y, p.z));
                let query = Vector::new(point.x, point.y, point.z);
                Triangle::new(a, b, c).distance_to_local_point(query, false)
            };
            let all = faces.iter().map(|face| distance(at(face)));
            let least = all.fold(f64::INFINITY, ccd_core::order::lesser);
            let (face, found) = search
                .nearest_face(point, &WorkBudget::unbounded(), distance)
                .unwrap();
            assert_eq!(distance(at(&faces[face as usize])), found);
            assert!(found <= least + 1e-12, "{found} {least}");
            let bounds = BoundingBox::enclosing([p, q]);
            let mut within = Vec::new();
            let all = search.all_triangles_meeting_box_satisfy(
                &bounds,
                &WorkBudget::unbounded(),
                |face| {
                    within.push(face);
                    true
                },
            );
            assert!(all);
            within.sort_unstable();
            let meets = |face: &[u32; 3]| BoundingBox::enclosing(at(face)).meets(&bounds);
            let twin: Vec<u32> = (0..)
                .zip(&faces)
                .filter(|(_, f)| meets(f))
                .map(|(k, _)| k)
                .collect();
            met += twin.len();
            missed += faces.len() - twin.len();
            assert_eq!(within, twin);
        }
    }
    assert!(met > 1000 && missed > 1000, "{met}, {missed}");
}
