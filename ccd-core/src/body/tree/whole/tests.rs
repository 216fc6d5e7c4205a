//! Tests that a body's box contains all of the body's points, up to its `slack`.

use super::*;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{RngExt, random_direction, random_power_of_ten, random_rotation, rng};
use crate::tests::worst::{WorstCaseSearch, error_fraction};

/// Measures how much of a box's slack is needed for the exact heights of all points, without a rounding radius.
#[test]
fn worst_slack() {
    let mut sample = PointSample::EMPTY;
    let found = WorstCaseSearch::new("Whole::slack", 20_000).search(|tape| {
        let [u, v, w, middle] = [(); 4].map(|()| DVec3::from(tape.vector(-20..=0)));
        let points = [(); 6].map(|()| {
            let at = u * tape.any_number(-8..=0)
                + v * tape.any_number(-8..=0)
                + w * tape.any_number(-8..=0);
            middle + at
        });
        let node_points = NodePoints {
            points: &points,
            rounding_radius: 0.0,
            are_triangles: tape.index_below(2) == 0,
        };
        let whole = BodyBox::fit_to(&node_points, &mut sample);
        // An axis of the box, or nearly, or any direction.
        let axis = whole.axes.col(tape.index_below(3));
        let n = match tape.index_below(3) {
            0 => axis,
            1 => axis.map(|x| tape.number_near(x)),
            _ => DVec3::from(tape.vector(-20..=0)),
        };
        let n = DoubleDouble3::from(n);
        let length = n.dot(n).sqrt().get();
        let along = |axis: DVec3| {
            let part = n.dot(DoubleDouble3::from(axis));
            part.max(-part)
        };
        let half = whole.half_extents.to_array();
        let reach = (0..3)
            .map(|k| along(whole.axes.col(k)) * DoubleDouble::from(half[k]))
            .fold(DoubleDouble::ZERO, |sum, part| sum + part);
        let over = |&point: &DVec3| {
            let way = DoubleDouble3::from(point) - DoubleDouble3::from(whole.center);
            (n.dot(way) - reach).get()
        };
        let over = points.iter().map(over).fold(f64::NEG_INFINITY, greater);
        (length > 0.0 && whole.radius > 0.0).then(|| error_fraction(over, whole.slack * length))
    });
    found.assert_tight_bound(30.0);
}

#[test]
fn no_point_reaches_out_of_the_box_and_flat_faces_are_known_to_rounding() {
    let mut rng = rng(5);
    let mut sample = PointSample::EMPTY;
    for _ in 0..300 {
        let size = random_power_of_ten(&mut rng, -9.0, 9.0);
        let turn = random_rotation(&mut rng);
        let count = rng.random_range(1..200);
        // The points are on the faces of a box, which is rotated and away from the origin.
        let middle = 10.0 * size * random_direction(&mut rng);
        let points: Vec<DVec3> = (0..3 * count)
            .map(|k| {
                let mut at = random_direction(&mut rng);
                at[k % 3] = at[k % 3].signum();
                middle + turn * (size * at)
            })
            .collect();
        let node_points = NodePoints {
            points: &points,
            rounding_radius: 0.0,
            are_triangles: rng.random_bool(0.5),
        };
        let whole = BodyBox::fit_to(&node_points, &mut sample);
        assert!(
            whole.slack <= 1e-13 * size * 2.0,
            "{} of {size}",
            whole.slack
        );
        for _ in 0..20 {
            let n = random_direction(&mut rng);
            let along = (whole.axes.transpose() * n).abs();
            let reach = along.dot(whole.half_extents) + whole.slack;
            for &point in &points {
                let height = n.dot(point - whole.center);
                assert!(height <= reach, "{height} {reach}");
            }
        }
    }
}
