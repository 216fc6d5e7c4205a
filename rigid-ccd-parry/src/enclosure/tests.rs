use super::*;
use crate::order::length;

fn round(kind: Kind, half_height: f64, radius: f64) -> Round {
    Round {
        kind,
        half_height,
        radius,
    }
}

/// Returns how far the points of a polytope are above all points of the round shape along a direction.
fn above(about: &Enclosure, round: &Round, direction: DVec3) -> f64 {
    let reach = about
        .points
        .iter()
        .map(|p| p.dot(direction))
        .fold(f64::NEG_INFINITY, greater);
    let aside = round.radius * direction.x.hypot(direction.z);
    let up = round.half_height * direction.y;
    let theirs = match round.kind {
        Kind::Cylinder => aside + up.abs(),
        Kind::Cone => greater(up, aside - up),
    };
    reach - theirs
}

fn directions() -> impl Iterator<Item = DVec3> {
    (0..4000).map(|k| {
        let (turn, tilt) = (0.7 * f64::from(k), (f64::from(k) * 0.37).sin());
        DVec3::new(
            turn.cos() * (1.0 - tilt * tilt).sqrt(),
            tilt,
            turn.sin() * (1.0 - tilt * tilt).sqrt(),
        )
    })
}

#[test]
fn polytopes_hold_their_shapes_within_the_excess() {
    for kind in [Kind::Cylinder, Kind::Cone] {
        for (half_height, radius) in [(1.0, 1.0), (0.01, 3.0), (5.0, 0.02)] {
            let round = round(kind, half_height, radius);
            for excess in [
                Excess::Fine,
                Excess::Length(0.3),
                Excess::Length(1e-3),
                Excess::Length(1e-6),
            ] {
                let about = Enclosure::of(&round, excess).expect("it can be had");
                let allowed = match excess {
                    Excess::Length(length) => length,
                    _ => radius / 4096.0,
                };
                assert!(
                    about.excess <= allowed,
                    "{round:?} {excess:?}: {}",
                    about.excess
                );
                let mut most = 0.0;
                for direction in directions() {
                    let more = above(&about, &round, direction);
                    assert!(
                        more >= -1e-16 * (half_height + radius),
                        "{round:?} {excess:?}: {more:e}"
                    );
                    assert!(
                        more <= about.excess,
                        "{round:?} {excess:?}: {more:e} > {:e}",
                        about.excess
                    );
                    most = greater(most, more);
                }
                // What is stated is no more than what there is, unless rounding is most of it.
                assert!(
                    most > 0.5 * about.excess || about.excess < 1e-5,
                    "{round:?} {excess:?}: {most:e}"
                );
            }
        }
    }
}

#[test]
fn polytopes_touch_their_shapes_along_the_axes() {
    let round = round(Kind::Cylinder, 2.0, 1.0);
    let about = Enclosure::of(&round, Excess::Fine).expect("it can be had");
    for axis in [
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        DVec3::NEG_X,
        DVec3::NEG_Y,
        DVec3::NEG_Z,
    ] {
        let more = above(&about, &round, axis);
        assert!((0.0..1e-14).contains(&more), "{axis}: {more:e}");
    }
}

#[test]
fn facets_close_the_polytope_and_point_outward() {
    for kind in [Kind::Cylinder, Kind::Cone] {
        let about =
            Enclosure::of(&round(kind, 1.0, 2.0), Excess::Length(0.1)).expect("it can be had");
        let (triangles, numbers) = about.triangles();
        assert_eq!(crate::closed::open_edge(&about.points, &triangles), None);
        assert_eq!(numbers.len(), triangles.len());
        assert_eq!(numbers.iter().max(), Some(&(about.loops.len() as u32 - 1)));
        for triangle in triangles {
            let [a, b, c] = triangle.map(|k| about.points[k as usize]);
            let normal = (b - a).cross(c - a);
            assert!(normal.dot(a) > 0.0 && length(normal) > 0.0, "{kind:?}");
            // No point is above the facet's plane, but for rounding.
            let high = about
                .points
                .iter()
                .map(|p| (*p - a).dot(normal))
                .fold(0.0, greater);
            assert!(high <= 1e-15, "{kind:?}: {high:e}");
        }
    }
}

#[test]
fn too_fine_polytopes_are_refused_with_the_least_excess() {
    let cylinder = round(Kind::Cylinder, 1.0, 2.0);
    for asked in [0.0, 1e-12, 1e-8] {
        let Err(ShapeError::Excess { least, .. }) = Enclosure::of(&cylinder, Excess::Length(asked))
        else {
            panic!("{asked} is too fine");
        };
        assert!(least < 1e-7, "{least:e}");
        assert!(Enclosure::of(&cylinder, Excess::Length(least)).is_ok());
    }
    for asked in [-1.0, f64::NAN] {
        let refused = Enclosure::of(&cylinder, Excess::Length(asked));
        assert!(
            matches!(refused, Err(ShapeError::Size { what: "excess", .. })),
            "{refused:?}"
        );
    }
}

#[test]
fn shapes_without_size_have_polytopes() {
    for (half_height, radius) in [(0.0, 1.0), (1.0, 0.0), (0.0, 0.0), (1e-300, 1e-300)] {
        let round = round(Kind::Cone, half_height, radius);
        let about = Enclosure::of(&round, Excess::Fine).expect("it can be had");
        assert!(about.points.iter().all(|p| p.is_finite()));
    }
}
