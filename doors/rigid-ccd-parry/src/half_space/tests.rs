use super::*;
use ccd_core::{Motion, Pose};

fn motion_with_extent(
    place: [f64; 3],
    velocity: [f64; 3],
    spin: [f64; 3],
    reach: f64,
) -> MotionWithExtent {
    let pose = Pose::at(place).expect("a pose");
    MotionWithExtent {
        motion: Motion::new(pose, velocity, spin).expect("a motion"),
        about: DVec3::ZERO,
        max_radius: reach,
    }
}

#[test]
fn the_box_is_above_the_plane_by_a_hair_and_as_wide_as_the_reach() {
    for normal in [
        DVec3::Y,
        DVec3::new(1.0, 2.0, -3.0),
        DVec3::new(-1e-9, 1.0, 1e-20),
        DVec3::new(3.0, 4e200, 0.0),
    ] {
        let plane = HalfSpace::new(normal).expect("a normal");
        for about in [
            DVec3::ZERO,
            DVec3::new(5.0, 70.0, -3.0),
            DVec3::new(0.0, -2.0, 1e6),
        ] {
            let side = MotionWithExtent {
                about,
                ..motion_with_extent([0.0; 3], [0.0; 3], [0.0; 3], 0.0)
            };
            let reach = 30.0;
            let body = plane.covering_box(side, reach).expect("a box");
            let points = body.body().pieces().points();
            let unit = plane.normal;
            // The normals of the facets: the box contains the ball's part of the half-space along each.
            let high = points
                .iter()
                .map(|p| p.dot(unit))
                .fold(f64::NEG_INFINITY, greater);
            let low = points
                .iter()
                .map(|p| p.dot(unit))
                .fold(f64::INFINITY, lesser);
            assert!(
                high > 0.0 && high < 1e-6 && high <= body.excess(),
                "{high:e}"
            );
            assert!(low < lesser(0.0, about.dot(unit) - reach));
            for across in [points[1] - points[0], points[2] - points[0]] {
                let across = across.normalize();
                let heights = points.iter().map(|p| (*p - about).dot(across));
                let [low, high] = heights.fold([0.0; 2], |[low, high], h| {
                    [lesser(low, h), greater(high, h)]
                });
                assert!(low <= -reach && high >= reach, "{low} {high}");
            }
        }
    }
}

#[test]
fn normals_without_direction_are_refused() {
    for normal in [DVec3::ZERO, DVec3::NAN, DVec3::new(f64::INFINITY, 0.0, 0.0)] {
        assert!(matches!(
            HalfSpace::new(normal),
            Err(ShapeError::InvalidSize { what: "normal", .. })
        ));
    }
}

#[test]
fn the_horizon_ends_when_bodies_are_inside_or_away() {
    let plane = HalfSpace::new(DVec3::Y).expect("a normal");
    let ground = motion_with_extent([0.0; 3], [0.0; 3], [0.0; 3], 0.0);
    let horizon = |body| plane.query_duration(ground, body, 0.25, f64::INFINITY);
    let QueryDuration::WholeCast(falls) = horizon(motion_with_extent(
        [0.0, 3.0, 0.0],
        [5.0, -2.0, 0.0],
        [0.0; 3],
        1.0,
    )) else {
        panic!("it falls through");
    };
    assert!((2.125..2.126).contains(&falls), "{falls}");
    let QueryDuration::WholeCast(rises) = horizon(motion_with_extent(
        [0.0, -3.0, 0.0],
        [5.0, 2.0, 0.0],
        [1.0; 3],
        1.0,
    )) else {
        panic!("it comes out");
    };
    assert!((2.125..2.126).contains(&rises), "{rises}");
    let away = horizon(motion_with_extent(
        [0.0, 3.0, 0.0],
        [5.0, 2.0, 0.0],
        [1.0; 3],
        1.0,
    ));
    assert_eq!(away, QueryDuration::WholeCast(0.0));
    let slides = horizon(motion_with_extent(
        [0.0, 3.0, 0.0],
        [5.0, 0.0, 0.0],
        [1.0; 3],
        1.0,
    ));
    let QueryDuration::WholeCast(turn) = slides else {
        panic!("it repeats itself");
    };
    assert!(turn > 3.6 && turn < 3.7, "{turn}");
    assert_eq!(
        horizon(motion_with_extent(
            [0.0, 3.0, 0.0],
            [5.0, 0.0, 0.0],
            [0.0; 3],
            1.0
        )),
        QueryDuration::WholeCast(0.0)
    );
}

#[test]
fn a_motion_that_may_be_along_a_tilted_plane_has_a_long_horizon() {
    let plane = HalfSpace::new(DVec3::new(1.0, 1.0, 1.0)).expect("a normal");
    let ground = motion_with_extent([0.0; 3], [0.0; 3], [0.0; 3], 0.0);
    // Rounding hides whether the body comes down.
    let along = motion_with_extent([3.0, 3.0, 3.0], [5.0, -2.0, -3.0], [0.0; 3], 1.0);
    let horizon = plane.query_duration(ground, along, 0.25, f64::INFINITY);
    assert!(
        matches!(horizon, QueryDuration::PartOfCast(duration) if duration > 1e6),
        "{horizon:?}"
    );
    assert_eq!(
        plane.query_duration(ground, along, 0.25, 1e3),
        QueryDuration::WholeCast(1e3)
    );
}
