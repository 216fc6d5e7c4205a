//! Tests the nearest points of two features, and the combinations that represent these points.

use super::{Witness, clamped_projection_weights};
use crate::feature::{Feature, Pair};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, nearest_vertex, needle, pair_with_b_moved, point,
    prepared_polytope,
};
use crate::tests::shape::{self, Pcg64, RngExt, SeedableRng, random_magnitude, random_vector};
use ccd_core::glam::DVec3;

/// Returns the nearest points of a pair, after a check that the combinations represent them.
fn witness(
    a: &shape::Shape,
    b: &shape::Shape,
    at: DVec3,
    of: impl Fn(&crate::polytope::Polytope, &crate::polytope::Polytope) -> Pair,
) -> Witness {
    let (one, other) = (prepared_polytope(a), prepared_polytope(b));
    let placed = pair_with_b_moved(&one, &other, at);
    let witness = Witness::new(&placed, of(&one, &other));
    let claim = witness.claim;
    let on_a = claim.a.position(&a.points).expect("a point of A");
    let on_b = claim.b.position(&b.points).expect("a point of B") + at;
    // The witness is relative to the middle of A.
    assert!((on_a - one.origin_in_piece).distance(witness.points[0]) < 1e-15);
    assert!((on_b - one.origin_in_piece).distance(witness.points[1]) < 1e-15);
    witness
}

#[test]
fn features_have_nearest_points() {
    let cuboid = shape::cuboid(DVec3::ONE);
    let at = DVec3::new(0.25, 3.0, 4.0);
    let single = shape::shape_of_points(&[DVec3::ZERO]);
    let corner = witness(&cuboid, &single, at, |a, _| Pair {
        a: Feature::Vertex(nearest_vertex(a, DVec3::ONE)),
        b: Feature::Vertex(0),
    });
    assert_eq!(corner.claim.axis, at - DVec3::ONE);
    let side = witness(&cuboid, &single, at, |a, _| Pair {
        a: Feature::Edge(edge_with_nearest_middle(a, DVec3::Y + DVec3::Z)),
        b: Feature::Vertex(0),
    });
    assert_eq!(side.separation_vector(), DVec3::new(0.0, 2.0, 3.0));
    assert_eq!(side.claim.axis, side.separation_vector());
    let top = witness(&cuboid, &single, DVec3::new(0.25, -0.5, 4.0), |a, _| Pair {
        a: Feature::Face(face_along(a, DVec3::Z)),
        b: Feature::Vertex(0),
    });
    assert_eq!(
        (top.separation_vector(), top.claim.axis),
        (3.0 * DVec3::Z, DVec3::Z)
    );
    let back = witness(&single, &cuboid, DVec3::new(0.25, -0.5, -4.0), |_, b| {
        Pair {
            a: Feature::Vertex(0),
            b: Feature::Face(face_along(b, DVec3::Z)),
        }
    });
    assert_eq!(
        (back.separation_vector(), back.claim.axis),
        (-3.0 * DVec3::Z, -DVec3::Z)
    );
    let across = shape::shape_of_points(&[-DVec3::Y, DVec3::Y]);
    let crossed = witness(
        &shape::shape_of_points(&[-DVec3::X, DVec3::X]),
        &across,
        2.0 * DVec3::Z,
        |_, _| Pair {
            a: Feature::Edge(0),
            b: Feature::Edge(0),
        },
    );
    assert_eq!(
        (crossed.separation_vector(), crossed.claim.axis.normalize()),
        (2.0 * DVec3::Z, DVec3::Z)
    );
}

/// Tests that the axis of two edges that almost touch is perpendicular to both, undisturbed by rounding.
#[test]
fn axes_are_those_of_the_features() {
    let (one, other) = (
        needle(DVec3::new(0.3, 0.9, 0.1)),
        needle(DVec3::new(-0.7, 0.2, 0.4)),
    );
    let normal = DVec3::new(0.3, 0.9, 0.1)
        .cross(DVec3::new(-0.7, 0.2, 0.4))
        .normalize();
    for gap in [1e-3, 1e-9, 1e-15] {
        for side in [normal, -normal] {
            let placed = pair_with_b_moved(&one, &other, gap * side);
            let pair = Pair {
                a: Feature::Edge(0),
                b: Feature::Edge(0),
            };
            let axis = Witness::new(&placed, pair).claim.axis.normalize();
            assert!(axis.distance(side) < 1e-15, "{gap}: {axis} {side}");
        }
    }
}

#[test]
fn pairs_that_are_never_a_stop_have_points() {
    let (cube, point) = (cube(), point());
    let placed = pair_with_b_moved(&cube, &cube, 4.0 * DVec3::X);
    let pair = Pair {
        a: Feature::Face(0),
        b: Feature::Face(1),
    };
    assert!(Witness::new(&placed, pair).distance() >= 2.0);
    assert_eq!(point.reach, 0.0);
}

/// Tests that projections onto triangles of any shape are accurate up to the rounding of the triangle's size.
#[test]
fn feet_are_right_on_needles() {
    let mut rng = Pcg64::seed_from_u64(4);
    for _ in 0..20_000 {
        let thin = random_magnitude(&mut rng, -12.0, 0.0);
        let corners = [(); 3].map(|()| {
            let v = random_vector(&mut rng);
            DVec3::new(v.x, thin * v.y, 0.0)
        });
        let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).z;
        let triangle = if area > 0.0 {
            corners
        } else {
            [corners[0], corners[2], corners[1]]
        };
        let (s, t): (f64, f64) = (rng.random_range(0.0..0.5), rng.random_range(0.0..0.5));
        let below = triangle[0] + s * (triangle[1] - triangle[0]) + t * (triangle[2] - triangle[0]);
        let weights = clamped_projection_weights(
            below + rng.random_range(0.0..2.0) * DVec3::Z,
            triangle,
            DVec3::Z,
        );
        let named: DVec3 = (0..3).map(|k| weights[k] * triangle[k]).sum();
        assert!(
            named.distance(below) < 2e-15,
            "{triangle:?}: {named} {below}"
        );
        assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)));
    }
}

#[test]
fn feet_outside_of_the_triangle_are_clamped_into_it() {
    let triangle = [DVec3::ZERO, 2.0 * DVec3::X, DVec3::Y];
    for (x, y) in [
        (9.0, 9.0),
        (-1.0, -1.0),
        (5.0, -1.0),
        (0.5, 7.0),
        (f64::NAN, 0.0),
    ] {
        let weights = clamped_projection_weights(DVec3::new(x, y, 1.0), triangle, DVec3::Z);
        assert!(
            weights.iter().all(|w| (0.0..=1.0).contains(w)),
            "{weights:?}"
        );
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }
}

/// Tests that the support gap along the axis certifies the distance of needles that cross at any angle. Rounding of the
/// axis along them would cost a hundred times the rounding of their positions.
#[test]
fn axes_certify_edges_that_cross_at_any_angle() {
    let mut rng = Pcg64::seed_from_u64(9);
    for _ in 0..5_000 {
        let (angle, gap) = (
            random_magnitude(&mut rng, -9.0, 0.0),
            random_magnitude(&mut rng, -9.0, 0.0),
        );
        let offset = shape::random_direction(&mut rng);
        let normal = offset.any_orthonormal_vector();
        let other = ccd_core::glam::DQuat::from_axis_angle(normal, angle) * offset;
        let (one, other) = (needle(0.9 * offset), needle(0.8 * other));
        let placed = pair_with_b_moved(&one, &other, gap * normal + 0.1 * offset);
        let pair = Pair {
            a: Feature::Edge(0),
            b: Feature::Edge(0),
        };
        let witness = Witness::new(&placed, pair);
        let gap = crate::certificate::gap(&placed, witness.claim.axis.normalize());
        let short = witness.distance() - gap;
        assert!(short <= 2e-15, "{short:e} at {angle:e}, {gap:e}");
    }
}
