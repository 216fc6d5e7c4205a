//! Tests the preparation of pieces for marching, and which pieces are refused.

use super::{NO_FACE, Polytope};
use crate::tests::setting::prepared_polytope;
use crate::tests::shape::{
    self, Pcg64, SeedableRng, Shape, random_direction, random_magnitude, random_vector,
};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{GiveUpReason, Piece};
use rstest::rstest;

/// Returns how many corners, edges and faces a polytope has.
fn feature_counts(polytope: &Polytope) -> [usize; 3] {
    [
        polytope.vertices.len(),
        polytope.edges.len(),
        polytope.faces.len(),
    ]
}

/// Asserts that a polytope is convex, that its vertices, edges and sides agree, and that Euler's formula holds.
fn assert_valid_polytope(polytope: &Polytope) {
    let slack = 1e-14 * polytope.reach;
    for (v, vertex) in (0..).zip(&polytope.vertices) {
        for spoke in polytope.outgoing_edges_of(v) {
            let offset = polytope.vertex(spoke.end_vertex).point - vertex.point;
            assert!((offset - offset.length() * spoke.edge_direction).length() <= slack);
            assert!(polytope.edge(spoke.edge).ends.contains(&v));
        }
    }
    for (e, edge) in (0..).zip(&polytope.edges) {
        let [start, end] = edge.ends.map(|v| polytope.vertex(v).point);
        assert_eq!(start, edge.start);
        assert!((start + edge.length * edge.direction - end).length() <= slack);
        for (&f, &inward) in edge.faces.iter().zip(&edge.inward_directions) {
            if f == NO_FACE {
                assert_eq!(inward, DVec3::ZERO);
                continue;
            }
            let side = polytope.sides_of(f).iter().find(|side| side.edge == e);
            let side = side.expect("the face has the edge");
            assert_eq!((side.start, side.inward_direction), (edge.start, inward));
            assert!((inward.length() - 1.0).abs() < 1e-15);
        }
    }
    for (f, face) in (0..).zip(&polytope.faces) {
        assert!((face.normal.length() - 1.0).abs() < 1e-15);
        let sides = polytope.sides_of(f);
        let base = polytope.vertex(sides[0].vertex).point;
        for vertex in &polytope.vertices {
            assert!(face.normal.dot(vertex.point - base) <= slack);
        }
        for (k, side) in sides.iter().enumerate() {
            let next = sides[(k + 1) % sides.len()].vertex;
            let ends = polytope.edge(side.edge).ends;
            assert!(ends == [side.vertex, next] || ends == [next, side.vertex]);
        }
    }
    if polytope.faces.len() > 2 {
        let [v, e, f] = feature_counts(polytope);
        assert_eq!(v + f, e + 2);
    }
}

#[rstest]
#[case(shape::cuboid(DVec3::ONE), [8, 12, 6])]
#[case(shape::cuboid(DVec3::ONE).triangulated(), [8, 12, 6])]
#[case(shape::prism(100).triangulated(), [200, 300, 102])]
#[case(shape::antiprism(7), [14, 28, 16])]
#[case(shape::uv_sphere(9, 16).triangulated(), [146, 304, 160])]
#[case(shape::cyclic_polytope(20), [20, 54, 36])]
#[case(shape::polygon(12), [12, 12, 2])]
#[case(shape::polygon(12).triangulated(), [12, 12, 2])]
#[case(shape::shape_of_points(&[DVec3::X]), [1, 0, 0])]
#[case(shape::shape_of_points(&[DVec3::X, DVec3::Y]), [2, 1, 0])]
#[case(shape::shape_of_points(&[DVec3::X, DVec3::Y, DVec3::Z]), [3, 3, 2])]
// Pieces of lower dimension than their number of points suggests.
#[case(shape::shape_of_points(&[DVec3::X, DVec3::X]), [1, 0, 0])]
#[case(shape::shape_of_points(&[DVec3::X, DVec3::Y, DVec3::X]), [2, 1, 0])]
#[case(shape::shape_of_points(&[DVec3::X, 2.0 * DVec3::X, 5.0 * DVec3::X]), [2, 1, 0])]
#[case(shape::shape_of_points(&[DVec3::X; 9]), [1, 0, 0])]
#[case(shape::shape_of_points(&[DVec3::X, 2.0 * DVec3::X, 3.0 * DVec3::X, DVec3::ZERO]), [2, 1, 0])]
fn features_follow_from_points_and_facets(#[case] shape: Shape, #[case] expected: [usize; 3]) {
    let polytope = prepared_polytope(&shape);
    assert_eq!(feature_counts(&polytope), expected);
    assert_valid_polytope(&polytope);
}

/// Creates a cube with points inside its edges and faces, as in meshes: 26 points, 48 triangles.
fn subdivided_cube() -> Shape {
    let cube = shape::cuboid(DVec3::ONE);
    let mut points = Vec::new();
    let mut loops = Vec::new();
    let mut number = |p: DVec3| {
        let found = points.iter().position(|&q| q == p);
        found.unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    for l in &cube.loops {
        let corners: Vec<DVec3> = l.iter().map(|&v| cube.points[v as usize]).collect();
        let middle = corners.iter().sum::<DVec3>() / 4.0;
        for k in 0..4 {
            let (p, q) = (corners[k], corners[(k + 1) % 4]);
            let between = 0.5 * (p + q);
            loops.push([p, between, middle].map(&mut number).to_vec());
            loops.push([between, q, middle].map(&mut number).to_vec());
        }
    }
    Shape { points, loops }
}

#[test]
fn coplanar_facets_are_one_face_and_corners_within_are_none() {
    let shape = subdivided_cube();
    assert_eq!((shape.points.len(), shape.loops.len()), (26, 48));
    let polytope = prepared_polytope(&shape);
    assert_eq!(feature_counts(&polytope), [8, 12, 6]);
    assert_valid_polytope(&polytope);
    // Rounded corners are as coplanar as they come.
    let mut rng = Pcg64::seed_from_u64(1);
    for _ in 0..200 {
        let turn = DQuat::from_scaled_axis(3.0 * random_vector(&mut rng));
        let (size, shift) = (
            random_magnitude(&mut rng, -6.0, 6.0),
            random_vector(&mut rng),
        );
        let moved = subdivided_cube().with_mapped_points(|p| size * (turn * p + shift));
        let polytope = prepared_polytope(&moved);
        assert_eq!(feature_counts(&polytope), [8, 12, 6]);
        assert_valid_polytope(&polytope);
    }
}

/// Tests that duplicate points, degenerate facets along an edge, and inner points are dropped.
#[test]
fn superfluous_points_are_left_out() {
    let mut cube = shape::cuboid(DVec3::ONE);
    cube.points.push(cube.points[0]);
    cube.points.push(0.5 * DVec3::X);
    cube.loops[0][0] = 8;
    assert_eq!(feature_counts(&prepared_polytope(&cube)), [8, 12, 6]);
    // A T-junction: a vertex on an edge of only one face, with a degenerate facet that closes the gap.
    let mut cube = shape::cuboid(DVec3::ONE);
    cube.points.push(DVec3::new(-1.0, -1.0, 0.0));
    cube.loops[0] = vec![0, 8, 4, 6, 2];
    cube.loops.push(vec![0, 4, 8]);
    let polytope = prepared_polytope(&cube);
    assert_eq!(feature_counts(&polytope), [8, 12, 6]);
    assert_valid_polytope(&polytope);
}

/// Tests that hulls squeezed by factors down to 1e-12 are accepted, also after a rotation that rounds their corners.
#[test]
fn thin_polytopes_are_sound() {
    let mut rng = Pcg64::seed_from_u64(2);
    for _ in 0..300 {
        let squeeze = DVec3::new(
            1.0,
            random_magnitude(&mut rng, -12.0, 0.0),
            random_magnitude(&mut rng, -12.0, 0.0),
        );
        let points: Vec<DVec3> = (0..9)
            .map(|_| squeeze * random_direction(&mut rng))
            .collect();
        let hull = shape::hull(&points);
        let pieces = hull.pieces();
        let made = Polytope::new(&pieces.get(0));
        assert_valid_polytope(&made.unwrap_or_else(|why| panic!("{why:?}: {squeeze} {hull:?}")));
        // Turned, its corners are rounded, and its facets no more exactly convex.
        let turn = DQuat::from_scaled_axis(3.0 * random_vector(&mut rng));
        let turned = hull.with_mapped_points(|p| turn * p);
        let pieces = turned.pieces();
        assert!(Polytope::new(&pieces.get(0)).is_ok(), "{turned:?}");
    }
}

/// Tests that a plate thinner than rounding becomes a flat polytope of two faces.
#[test]
fn plates_are_flat_from_rounding_on() {
    for (thin, faces) in [(1e-12, 6), (1e-14, 6), (1e-16, 2), (0.0, 2)] {
        let plate = shape::cuboid(DVec3::new(1.0, 1.0, thin));
        let pieces = plate.pieces();
        let polytope = Polytope::new(&pieces.get(0)).expect("a plate");
        assert_eq!(polytope.faces.len(), faces, "{thin}");
    }
}

fn assert_refused(points: &[DVec3], loops: &[&[u32]]) {
    let shape = Shape {
        points: points.to_vec(),
        loops: loops.iter().map(|l| l.to_vec()).collect(),
    };
    let pieces = shape.pieces();
    let made = Polytope::new(&pieces.get(0));
    assert_eq!(made.err(), Some(GiveUpReason::BadFacets), "{shape:?}");
}

const TETRAHEDRON: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];

#[test]
fn open_surfaces_are_refused() {
    assert_refused(&TETRAHEDRON, &[]);
    assert_refused(&TETRAHEDRON, &[&[0, 2, 1], &[0, 1, 3], &[0, 3, 2]]);
    assert_refused(
        &TETRAHEDRON,
        &[&[0, 2, 1], &[0, 1, 3], &[0, 3, 2], &[1, 3, 2]],
    );
    assert_refused(
        &TETRAHEDRON,
        &[&[0, 2, 1], &[0, 2, 1], &[0, 1, 3], &[0, 3, 2], &[1, 2, 3]],
    );
    // A corner twice in a loop.
    assert_refused(
        &TETRAHEDRON,
        &[&[0, 2, 1, 2], &[0, 1, 3], &[0, 3, 2], &[1, 2, 3]],
    );
}

#[test]
fn surfaces_that_are_not_convex_are_refused() {
    // Inside out.
    assert_refused(
        &TETRAHEDRON,
        &[&[0, 1, 2], &[0, 3, 1], &[0, 2, 3], &[1, 3, 2]],
    );
    // A cube with a dent, and with a corner off its faces' planes.
    let cube = shape::cuboid(DVec3::ONE);
    let loops: Vec<&[u32]> = cube.loops.iter().map(|l| &l[..]).collect();
    for off in [0.1, -0.1, 1e-6] {
        let mut points = cube.points.clone();
        points[7] += off * DVec3::new(1.0, 0.3, -0.2);
        assert_refused(&points, &loops);
    }
    let mut dented = subdivided_cube();
    let top = dented
        .points
        .iter()
        .position(|&p| p == DVec3::Z)
        .expect("the middle of the top");
    dented.points[top] = 0.9 * DVec3::Z;
    let loops: Vec<&[u32]> = dented.loops.iter().map(|l| &l[..]).collect();
    assert_refused(&dented.points, &loops);
    // A flat polygon that is not convex, and one that goes around twice.
    let arrow = [
        DVec3::ZERO,
        DVec3::new(2.0, 2.0, 0.0),
        0.5 * DVec3::Y,
        DVec3::new(-2.0, 2.0, 0.0),
    ];
    assert_refused(&arrow, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]);
    let star = shape::polygon(5).points;
    assert_refused(&star, &[&[0, 2, 4, 1, 3], &[3, 1, 4, 2, 0]]);
}

#[test]
fn surfaces_that_wind_twice_are_refused() {
    // Two tetrahedra in one place.
    let mut points = TETRAHEDRON.to_vec();
    points.extend(TETRAHEDRON.map(|p| 0.5 * p + DVec3::splat(0.05)));
    let own: [&[u32]; 4] = [&[0, 2, 1], &[0, 1, 3], &[0, 3, 2], &[1, 2, 3]];
    let other: [&[u32]; 4] = [&[4, 6, 5], &[4, 5, 7], &[4, 7, 6], &[5, 6, 7]];
    assert_refused(&points, &[own, other].concat());
    // The great icosahedron: every edge convex, every facet a triangle, closed, and seven layers.
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::new();
    for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        corners.push(DVec3::new(0.0, s, t * golden));
        corners.push(DVec3::new(s, t * golden, 0.0));
        corners.push(DVec3::new(t * golden, 0.0, s));
    }
    let far = |v: usize, w: usize| (corners[v].distance(corners[w]) - 2.0 * golden).abs() < 1e-9;
    let mut loops = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if far(i, j) && far(j, k) && far(i, k) {
                    let [a, b, c] = [i, j, k].map(|v| corners[v]);
                    let outward = (b - a).cross(c - a).dot(a) > 0.0;
                    let [i, j, k] = [i as u32, j as u32, k as u32];
                    loops.push(if outward { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    assert_eq!(loops.len(), 20);
    assert_refused(&corners, &loops.iter().map(|l| &l[..]).collect::<Vec<_>>());
}

#[test]
fn loose_pieces_need_no_facets_up_to_three_points() {
    for count in 1..=3 {
        assert!(Polytope::new(&Piece::from_points(&TETRAHEDRON[..count])).is_ok());
    }
    for points in [
        &TETRAHEDRON[..],
        &[],
        &[DVec3::NAN],
        &[DVec3::INFINITY, DVec3::X],
    ] {
        let made = Polytope::new(&Piece::from_points(points));
        assert_eq!(made.err(), Some(GiveUpReason::BadFacets));
    }
}
