use super::*;
use crate::tests::rational::exact_fraction;
use dashu_ratio::Relaxed;

fn cylinder_and_cone(radius: f64, half_height: f64) -> [SolidOfRevolution; 2] {
    let cylinder = SolidOfRevolution::cylinder(radius, half_height).expect("it is one");
    [
        cylinder,
        SolidOfRevolution::cone(radius, half_height).expect("it is one"),
    ]
}

/// Asserts with exact arithmetic that a polygon winds about the origin once and that no edge enters the disc.
fn assert_encloses_disc(corners: &[DVec3], radius: f64) {
    let squared = |x: f64| exact_fraction(x) * exact_fraction(x);
    let corners: Vec<[Relaxed; 2]> = corners
        .iter()
        .map(|corner| [exact_fraction(corner.x), exact_fraction(corner.y)])
        .collect();
    for k in 0..corners.len() {
        let ([ax, ay], [bx, by]) = (&corners[k], &corners[(k + 1) % corners.len()]);
        let cross = ax * by - ay * bx;
        let [dx, dy] = [bx - ax, by - ay];
        assert!(cross > exact_fraction(0.0), "corner {k} goes the wrong way");
        // The distance of the edge's line from the origin is the cross product divided by the edge's length.
        let square = &cross * &cross;
        let length = &dx * &dx + &dy * &dy;
        assert!(
            square >= squared(radius) * length,
            "edge {k} of {} about {radius:e}",
            corners.len()
        );
    }
}

#[test]
fn enclosures_hold_their_shapes_exactly() {
    let mut counts = Vec::new();
    for k in 0..40 {
        // The polygons have from four corners to two thousand, and radii of all sizes.
        let share = 2.0 * 0.7f64.powi(k);
        let radius = [1.0, 0.1, 3.7e5, 1e-90, 6.3e11, 1e-310][k as usize % 6];
        let half_height = 0.3 * f64::from(k % 5);
        for round in cylinder_and_cone(radius, half_height) {
            let about = round
                .enclosing_polytope(share * radius)
                .expect("it can be had");
            let points = &about.polytope().points;
            let (base, rest) = points.split_at(match round.kind {
                SolidKind::Cylinder => points.len() / 2,
                SolidKind::Cone => points.len() - 1,
            });
            assert_encloses_disc(base, radius);
            assert!(base.iter().all(|p| p.z == -half_height));
            match round.kind {
                SolidKind::Cylinder => {
                    assert!(base.iter().zip(rest).all(|(low, high)| {
                        high.truncate() == low.truncate() && high.z == half_height
                    }));
                }
                SolidKind::Cone => assert_eq!(rest, [half_height * DVec3::Z]),
            }
            counts.push(base.len());
        }
    }
    assert_eq!(counts.iter().min(), Some(&4));
    assert!(counts.iter().max() > Some(&1000));
}

#[test]
fn no_point_exceeds_the_shape_by_more_than_is_stated_and_asked() {
    for radius in [1.0, 0.03, 2e7] {
        for share in [2.0, 0.3, DEFAULT_RADIUS_EXCESS_SHARE, 1e-6] {
            for round in cylinder_and_cone(radius, 1.0) {
                let about = round
                    .enclosing_polytope(share * radius)
                    .expect("it can be had");
                assert!(about.excess() <= share * radius, "{round:?} {share}");
                let reach = |p: &DVec3| {
                    exact_fraction(p.x) * exact_fraction(p.x)
                        + exact_fraction(p.y) * exact_fraction(p.y)
                };
                let most = exact_fraction(radius) + exact_fraction(about.excess());
                let most = &most * &most;
                assert!(about.polytope().points.iter().all(|p| reach(p) <= most));
                // The stated excess is the actual one.
                let widest = about.polytope().points[0].truncate().length() - radius;
                assert!(
                    widest >= 0.99 * about.excess(),
                    "{widest:e} {round:?} {share}"
                );
            }
        }
    }
}

#[test]
fn enclosures_touch_their_shapes_along_the_axes() {
    for round in cylinder_and_cone(1.0, 2.0) {
        let about = round
            .enclosing_polytope(round.default_excess())
            .expect("it can be had");
        for axis in [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y] {
            let heights = about.polytope().points.iter().map(|p| p.dot(axis));
            let reach = heights.fold(0.0, greater);
            assert!((1.0..1.0 + 1e-14).contains(&reach), "{axis}: {reach}");
        }
    }
}

#[test]
fn facets_close_the_polytope_and_point_outward() {
    for round in cylinder_and_cone(2.0, 1.0) {
        let about = round.enclosing_polytope(0.1).expect("it can be had");
        let points = &about.polytope().points;
        let mut volume = 0.0;
        for corners in about.triangles().0 {
            let [a, b, c] = corners.map(|k| points[k as usize]);
            let normal = (b - a).cross(c - a);
            let above = points.iter().map(|p| (*p - a).dot(normal));
            assert!(above.fold(0.0, greater) <= 1e-14);
            volume += a.dot(normal) / 6.0;
        }
        let true_volume = PI * 4.0 * 2.0
            / if round.kind == SolidKind::Cone {
                3.0
            } else {
                1.0
            };
        assert!(
            volume > true_volume && volume < 1.1 * true_volume,
            "{volume}"
        );
        assert!(about.body().is_ok());
    }
}

#[test]
fn what_is_no_length_is_refused_by_its_name() {
    let named = |made: Result<SolidOfRevolution, InputError>, name: &str| match made {
        Err(InputError::OutOfRange { quantity: what, .. }) => assert_eq!(what, name),
        other => panic!("{other:?}"),
    };
    for bad in [-1.0, f64::NAN, f64::INFINITY, 1.1e12] {
        named(SolidOfRevolution::cylinder(bad, 1.0), "radius");
        named(SolidOfRevolution::cone(1.0, bad), "half height");
    }
    let cylinder = SolidOfRevolution::cylinder(2.0, 1.0).expect("it is one");
    for bad in [0.0, 1e-12, 1e-8, -1.0, f64::NAN] {
        let refused = cylinder.enclosing_polytope(bad);
        assert!(
            matches!(
                refused,
                Err(InputError::OutOfRange {
                    quantity: "excess",
                    ..
                })
            ),
            "{refused:?}"
        );
    }
    assert!(cylinder.enclosing_polytope(cylinder.least_excess()).is_ok());
    let widest = Body::cylinder(MAX_COORDINATE, 1.0);
    assert!(matches!(
        widest,
        Err(InputError::OutOfRange {
            quantity: "radius",
            ..
        })
    ));
}

#[test]
fn shapes_without_size_are_bodies() {
    for (radius, half_height) in [(0.0, 1.0), (1.0, 0.0), (0.0, 0.0), (1e-300, 1e-300)] {
        assert!(Body::cylinder(radius, half_height).is_ok());
        assert!(Body::cone(radius, half_height).is_ok());
    }
}
