//! Tests the exact point-in-solid test, which is the reference for decompositions.

use ccd_core::Polytope;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_tests::exact::{
    ConvexCombination, Location, SampleCounts, Solid, samples, side_of, triangle_contains_point,
};
use ccd_tests::models::{Mesh, convex_solids, cuboid, hollow, l_prism, solids};
use ccd_tests::referee::{contains, nearest_on_triangle};
use ccd_tests::strategies::{direction, runner};
use proptest::prelude::*;
use std::cell::Cell;
use std::cmp::Ordering;

fn exact_point(p: DVec3) -> ConvexCombination {
    ConvexCombination::mean([p])
}

/// Returns the mesh's vertices as one polytope. Its hull extends far beyond a non-convex mesh.
fn hull(mesh: &Mesh) -> Polytope {
    Polytope {
        points: mesh.vertices.clone(),
        ..Polytope::default()
    }
}

#[test]
fn points_of_faces_edges_and_vertices_are_on_the_surface() {
    for model in solids() {
        let mesh = &model.shape.mesh;
        let solid = Solid::new(mesh);
        for k in 0..mesh.faces.len() {
            let [a, b, c] = mesh.triangle(k);
            let some = [
                exact_point(a),
                ConvexCombination::mean([a, b]),
                ConvexCombination::mean([a, b, c]),
                ConvexCombination::new([(1, a), (63, b)]),
                ConvexCombination::new([(7, a), (20, b), (37, c)]),
            ];
            for p in some {
                assert_eq!(solid.locate(&p), Location::Surface, "{}: {p:?}", model.name);
            }
        }
    }
}

/// Tests that points off the surface by one unit in the last place are located inside or outside.
#[test]
fn points_a_rounding_off_the_surface_are_not_on_it() {
    let mesh = cuboid(DVec3::ONE).mesh;
    let solid = Solid::new(&mesh);
    for axis in DVec3::AXES {
        // In the middle of a face, on its diagonal, and off it.
        for offset in [DVec3::ZERO, DVec3::splat(0.3), DVec3::new(0.1, 0.2, 0.7)] {
            let p = |x: f64| exact_point(offset - axis * offset.dot(axis) + x * axis);
            assert_eq!(solid.locate(&p(1.0)), Location::Surface);
            assert_eq!(solid.locate(&p(1.0_f64.next_down())), Location::Inside(1));
            assert_eq!(solid.locate(&p(1.0_f64.next_up())), Location::Outside);
        }
    }
}

/// Tests that the mean of three points, which is not exact in binary, is located exactly in their plane.
#[test]
fn thirds_are_exact() {
    let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::new(0.1, 1.0, 1.0)];
    let mean = ConvexCombination::mean([a, b, c]);
    assert_eq!(side_of([a, b, c], &mean), Ordering::Equal);
    assert!(triangle_contains_point([a, b, c], &mean));
    let lifted = [a, b, c.with_z(c.z.next_up())];
    assert_eq!(side_of(lifted, &mean), Ordering::Less);
    assert!(!triangle_contains_point(lifted, &mean));
}

#[test]
fn triangles_without_an_area_hold_their_segment() {
    let [a, b] = [DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)];
    let flat = [a, b, 0.5 * b];
    assert!(triangle_contains_point(
        flat,
        &ConvexCombination::new([(1, a), (2, b)])
    ));
    assert!(!triangle_contains_point(flat, &exact_point(1.25 * b)));
    assert!(!triangle_contains_point(
        flat,
        &exact_point((0.25 * b).with_x(0.25_f64.next_up()))
    ));
}

/// Tests that points are located correctly if vertical rays from them pass through edges and vertices of the mesh.
#[test]
fn rays_through_edges_and_vertices_count_once() {
    let mesh = l_prism().mesh;
    let solid = Solid::new(&mesh);
    for x in -1..=9 {
        for y in -1..=9 {
            for z in -3..=3 {
                let [x, y, z] = [x, y, z].map(|k| 0.25 * f64::from(k));
                let within = |low: f64, v: f64, high: f64| match (low < v && v < high, v) {
                    (true, _) => 2,
                    (false, v) if v == low || v == high => 1,
                    _ => 0,
                };
                // Two bars: a point is on the surface of the union if it is inside neither.
                let bars = [
                    lesser(within(0.0, x, 2.0), within(0.0, y, 1.0)),
                    lesser(within(0.0, x, 1.0), within(0.0, y, 2.0)),
                ];
                // Where the bars meet, one bar's side is in the other.
                let flat = lesser(greater(bars[0], bars[1]), within(-0.5, z, 0.5));
                let expected = [Location::Outside, Location::Surface, Location::Inside(1)][flat];
                let p = exact_point(DVec3::new(x, y, z));
                assert_eq!(solid.locate(&p), expected, "{p:?}");
            }
        }
    }
}

#[test]
fn cavities_are_outside_and_windings_add_up() {
    let (big, small) = (cuboid(DVec3::ONE), cuboid(DVec3::splat(0.5)));
    let cavity = hollow(&big, &small).mesh;
    let mut twice = big.mesh.clone();
    twice.append(&small.mesh);
    let flipped = big.mesh.clone().with_reversed_faces();
    for (mesh, p, location) in [
        (&cavity, 0.1, Location::Outside),
        (&cavity, 0.7, Location::Inside(1)),
        (&cavity, 0.5, Location::Surface),
        (&twice, 0.1, Location::Inside(2)),
        (&twice, 0.7, Location::Inside(1)),
        (&flipped, 0.7, Location::Inside(-1)),
    ] {
        assert_eq!(
            Solid::new(mesh).locate(&exact_point(DVec3::splat(p))),
            location,
            "{p}"
        );
    }
}

/// Compares exact locations with winding numbers from solid angles in floating point: both agree except next to the
/// surface.
#[test]
fn solid_angles_give_the_same_locations() {
    let mut all_outside = 0;
    for model in solids().into_iter().chain(convex_solids()) {
        let mesh = &model.shape.mesh;
        let solid = Solid::new(mesh);
        let (mut inside, mut outside) = (0, 0);
        let effort = SampleCounts {
            points_per_facet: 0,
            chord_point_count: 300,
            inner_point_count: 300,
        };
        for p in samples(&hull(mesh), effort, 1) {
            let near = p.rounded();
            if (0..mesh.faces.len()).any(|k| is_almost_on_triangle(near, mesh.triangle(k))) {
                continue;
            }
            let by_angle = contains(mesh, &mesh.vertices, near);
            match solid.locate(&p) {
                Location::Surface => panic!("{}: {p:?}", model.name),
                Location::Inside(windings) => {
                    inside += 1;
                    assert!(by_angle && windings == 1, "{}: {p:?}", model.name);
                }
                Location::Outside => {
                    outside += 1;
                    assert!(!by_angle, "{}: {p:?}", model.name);
                }
            }
        }
        assert!(inside >= 20, "{}: {inside} inside", model.name);
        let convex = convex_solids().iter().any(|it| it.name == model.name);
        assert!(!convex || outside == 0, "{}: {outside} outside", model.name);
        all_outside += outside;
    }
    assert!(all_outside > 1_000, "{all_outside}");
}

/// Returns true if a point is so near to a triangle that rounding may decide on which side it is.
fn is_almost_on_triangle(p: DVec3, triangle: [DVec3; 3]) -> bool {
    nearest_on_triangle(p, triangle).distance(p) <= 1e-9
}

/// Tests that rounded points of a slanted face are located on the side of the face's plane on which rounding puts them.
#[test]
fn rounded_points_of_a_face_are_located_by_its_plane() {
    let inputs = (direction(), 1..64u32, 1..64u32);
    let (inside, outside) = (Cell::new(0), Cell::new(0));
    runner(500)
        .run(&inputs, |(normal, u, v)| {
            let tangent = normal.any_orthogonal_vector();
            let other = normal.cross(tangent);
            // A tetrahedron whose base is seen from outside along any direction.
            let [a, b, c] = [tangent, other, -tangent - other];
            let mesh = Mesh {
                vertices: vec![a, b, c, -normal],
                faces: vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]],
            };
            let on = ConvexCombination::new([(u, a), (v, b), (32, c)]);
            let rounded = exact_point(on.rounded());
            let (expected, count) = match side_of([a, b, c], &rounded) {
                Ordering::Greater => (Location::Outside, &outside),
                Ordering::Equal => return Ok(()),
                Ordering::Less => (Location::Inside(1), &inside),
            };
            count.set(count.get() + 1);
            prop_assert_eq!(Solid::new(&mesh).locate(&on), Location::Surface);
            prop_assert_eq!(Solid::new(&mesh).locate(&rounded), expected);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(
        inside.get() > 50 && outside.get() > 50,
        "{inside:?} {outside:?}"
    );
}
