//! Compares the intervals of profiles with exact values at the corners of a triangle.

use super::{NodeScrewBounds, ScrewAxis};
use crate::engine::shortcuts::placed::PlacedNode;
use crate::math::order::greater;
use crate::math::vector::{length, unit};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::rounding::profile_rounding;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::body;
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use glam::DVec3;

/// Returns the cylindrical coordinates of a point, with the azimuth within half a turn of `near`.
fn cylindrical_coordinates(axis: &ScrewAxis, point: DoubleDouble3, near: f64) -> [DoubleDouble; 3] {
    let unit = DoubleDouble3::from(axis.direction).unit();
    let way = point - DoubleDouble3::from(axis.origin);
    let height = way.dot(unit);
    let across = way - unit.scale(height);
    let x = DoubleDouble3::from(axis.azimuth_axes[0]);
    let x = (x - unit.scale(unit.dot(x))).unit();
    let y = unit.cross(x);
    let [east, north] = [x, y].map(|of| of.dot(across));
    // One Newton step doubles the digits of the angle.
    let rough = north.get().atan2(east.get());
    let turns = ((near - rough) / std::f64::consts::TAU).round();
    let angle = DoubleDouble::from(rough);
    let (sin, cos) = angle.sin_cos();
    let radius = across.length();
    let angle = angle + (north * cos - east * sin) / radius;
    let tau = DoubleDouble::from(std::f64::consts::TAU);
    let tau = tau - tau.sin_cos().0;
    [radius, height, angle + tau * DoubleDouble::from(turns)]
}

/// Returns the largest amount by which a corner lies outside the interval of its profile, as a share of the allowance
/// for rounding.
fn worst_error_share(axis: &ScrewAxis, corners: [DVec3; 3]) -> Option<f64> {
    let still = Motion::still(Pose::IDENTITY);
    let body = body(&[corners]);
    let problem =
        Problem::of_moving_bodies((&body, still), (&body, still), 1.0, &Settings::DEFAULT).ok()?;
    let node = PlacedNode::new(&problem.a, body.tree().node_count() as u32, 0.0);
    let profile = NodeScrewBounds::new(&node, axis)?;
    let (arm, distance) = {
        let way = node.center - axis.origin;
        let height = way.dot(axis.direction);
        (length(way), length(way - height * axis.direction))
    };
    let frame = problem.a.path.frame(0.0);
    let places = corners.map(|x| {
        // The position is relative to the node's center, as in the node.
        let from_center = DoubleDouble3::from(frame.transform_point(x) - node.center);
        cylindrical_coordinates(
            axis,
            from_center + DoubleDouble3::from(node.center),
            profile.azimuth,
        )
    });
    let mut worst = f64::NEG_INFINITY;
    for (k, &n) in axis.surfaces.iter().enumerate() {
        let tilt = axis.advance / distance;
        let allowed = profile_rounding(n.abs().to_array(), [arm, node.bounding_radius], tilt);
        for [r, z, angle] in places {
            let zeta = z - DoubleDouble::from(axis.advance) * angle;
            let f = DoubleDouble::from(n.x) * r + DoubleDouble::from(n.y) * zeta;
            let high = DoubleDouble::from(profile.high[k]) - DoubleDouble::from(allowed);
            let low = DoubleDouble::from(profile.low[k]) + DoubleDouble::from(allowed);
            let lost = greater((f - high).get(), (low - f).get());
            worst = greater(worst, error_fraction(lost, allowed));
        }
    }
    Some(worst)
}

fn axis(tape: &mut RandomCase, advance: f64) -> Option<ScrewAxis> {
    let direction = unit(tape.vector(-40..=0).into())?;
    let origin = DVec3::from(tape.vector(-20..=4));
    Some(ScrewAxis::new(origin, direction, advance))
}

/// Tests the rounding of profiles of tiny triangles anywhere about the axis.
#[test]
fn worst_of_an_arm() {
    let found = WorstCaseSearch::new("profile_rounding, an arm", 20_000).search(|tape| {
        let advance = tape.any_number(-10..=6);
        let axis = axis(tape, advance)?;
        let at = DVec3::from(tape.vector(-10..=10));
        let small = tape.size(-100..=-60);
        let corners = [0; 3].map(|_| at + DVec3::from(tape.vector(-10..=0)) * small);
        worst_error_share(&axis, corners)
    });
    found.assert_tight_bound(40.0);
}

/// Tests the rounding of profiles of triangles in a plane through the axis, which are much longer than their distance
/// from the axis.
#[test]
fn worst_of_a_radius() {
    let found = WorstCaseSearch::new("profile_rounding, a radius", 20_000).search(|tape| {
        let axis = axis(tape, 0.0)?;
        let out = axis.direction.cross(tape.vector(-40..=0).into());
        let out = unit(out)?;
        let long = tape.size(0..=20);
        let corners = [-1.0, 1.0, 0.0].map(|along| {
            axis.origin
                + axis.direction * (along * long)
                + out * (1.0 + 0.25 * tape.next_fraction())
        });
        worst_error_share(&axis, corners)
    });
    found.assert_tight_bound(40.0);
}
