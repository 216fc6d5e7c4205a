use super::*;
use crate::body::round::SolidOfRevolution;

#[test]
fn lengths_are_taken_and_all_else_is_refused() {
    let cube = Body::cuboid([1.0; 3]).unwrap();
    assert_eq!(cube.excess(), 0.0);
    for excess in [0.0, f64::MIN_POSITIVE, 0.5, 1e12] {
        assert_eq!(cube.clone().with_excess(excess).unwrap().excess(), excess);
    }
    for bad in [-1e-300, 1.1e12, f64::INFINITY, f64::NAN] {
        let refused = cube.clone().with_excess(bad);
        assert!(
            matches!(
                refused,
                Err(InputError::OutOfRange {
                    quantity: "excess",
                    ..
                })
            ),
            "{bad}"
        );
    }
}

#[test]
fn bodies_of_round_shapes_have_the_excess_of_their_enclosures() {
    for round in [
        SolidOfRevolution::cylinder(1.0, 2.0),
        SolidOfRevolution::cone(1.0, 2.0),
    ] {
        let about = round.unwrap().enclosing_polytope(1e-3).unwrap();
        let body = about.body().unwrap();
        assert!(body.excess() == about.excess() && body.excess() > 1e-4);
        // The triangles that replace the body represent the same shape.
        let ball = Body::sphere(1.0).unwrap();
        assert_eq!(
            ExcessSum::sum_of_bodies(&body, &ball),
            ExcessSum::sum_of_bodies(&ball, &body)
        );
    }
    assert!(Body::cylinder(1.0, 2.0).unwrap().excess() > 1e-5);
    assert_eq!(Body::cylinder(0.0, 2.0).unwrap().excess(), 0.0);
}

#[test]
fn a_sum_is_rounded_away_from_what_is_claimed() {
    let exceeding = |excess| Body::sphere(1.0).unwrap().with_excess(excess).unwrap();
    let exact = ExcessSum::sum_of_bodies(&exceeding(0.0), &exceeding(0.0));
    // Exact bodies keep their bits.
    assert_eq!(
        (
            exact.shape_distance_upper_bound(0.3),
            exact.certain_nearness_threshold(0.3)
        ),
        (0.3, 0.3)
    );
    let both = ExcessSum::sum_of_bodies(&exceeding(0.1), &exceeding(0.2));
    assert!(both.shape_distance_bound_at_overlap() > 0.1 + 0.2);
    assert!(both.shape_distance_upper_bound(0.3) > 0.3 + both.shape_distance_bound_at_overlap());
    assert!(
        both.shape_distance_upper_bound(both.certain_nearness_threshold(1.0)) >= 1.0 - 1e-15
            && both.certain_nearness_threshold(1.0) < 0.7
    );
    assert_eq!(
        both.shape_distance_upper_bound(f64::INFINITY),
        f64::INFINITY
    );
    // A surface that exceeds the shape makes its body exceed it.
    let about = SolidOfRevolution::cylinder(1.0, 1.0)
        .unwrap()
        .enclosing_polytope(0.1)
        .unwrap();
    let whole = Body::polytope(about.polytope().clone()).unwrap();
    let (triangles, numbers) = about.triangles();
    let pieces =
        crate::Pieces::from_triangles(&about.polytope().points, &triangles, &numbers).unwrap();
    let surface = Body::new(&pieces, crate::Solidity::Solid).unwrap();
    let surface = surface.with_excess(about.excess()).unwrap();
    let joined = whole.with_surface_triangles(surface).unwrap();
    assert_eq!(joined.excess(), about.excess());
}
