//! Compares rates and second derivatives of two triangles with double-double arithmetic.

use crate::engine::shortcuts::placed::{ApproachRateBounds, PlacedNode};
use crate::math::vector::{length, unit};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::RATE_ERROR_F64;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{body, random_rotation};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use glam::DVec3;

/// Draws a motion of any speed and rotation, about a center near the body or far from it.
fn motion(tape: &mut RandomCase) -> Option<Motion> {
    let start = Pose::new(tape.vector(-20..=4), random_rotation(tape)).ok()?;
    let [velocity, spin, center] = [-20..=6, -20..=6, -20..=10].map(|range| tape.vector(range));
    Motion::about(start, velocity, spin, center).ok()
}

/// The exact rate of approach and its derivative, and the terms of the engine's bounds on both, summed over both
/// bodies.
struct ApproachRateTerms {
    rate: DoubleDouble,
    second_derivative: DoubleDouble,
    speed: f64,
    size: f64,
    second_derivative_without_allowance: f64,
}

impl ApproachRateTerms {
    fn new() -> Self {
        let zero = DoubleDouble::ZERO;
        ApproachRateTerms {
            rate: zero,
            second_derivative: zero,
            speed: 0.0,
            size: 0.0,
            second_derivative_without_allowance: 0.0,
        }
    }

    fn add(
        &mut self,
        side: &BodyWithPath<'_>,
        motion: &Motion,
        node: &PlacedNode,
        n: DVec3,
        s: f64,
    ) {
        let path = &side.path;
        let frame = path.frame(s);
        let center = DoubleDouble3::from(path.center_at(s));
        let spin = DoubleDouble3::from(motion.angular_velocity());
        let axis = DoubleDouble3::from(n);
        let arms = side.body.pieces().triangle(0);
        // The corners are in their rounded positions, relative to the node's center.
        let placed = arms.map(|x| DoubleDouble3::from(frame.transform_point(x) - node.center));
        let arms = placed.map(|x| x + DoubleDouble3::from(node.center) - center);
        let speeds = arms.map(|arm| axis.dot(spin.cross(arm)));
        let fastest = speeds
            .into_iter()
            .reduce(DoubleDouble::max)
            .expect("three corners");
        let velocity = DoubleDouble3::from(motion.velocity());
        let velocity =
            velocity + DoubleDouble3::from(path.acceleration).scale(DoubleDouble::from(s));
        self.rate = self.rate + axis.dot(velocity) + fastest;
        let turning = arms.map(|arm| spin.cross(arm).length());
        let farthest = turning
            .into_iter()
            .reduce(DoubleDouble::max)
            .expect("three corners");
        self.second_derivative = self.second_derivative + axis.cross(spin).length() * farthest;
        self.second_derivative =
            self.second_derivative + axis.dot(DoubleDouble3::from(path.acceleration));
        let arm = node.center - path.center_at(s);
        self.speed +=
            path.speed_bound() + path.angular_speed * (length(arm) + node.bounding_radius);
        self.size += path.angular_speed * node.bounding_radius;
        let from_axis = length(path.axis.cross(arm)) + node.bounding_radius;
        self.second_derivative_without_allowance +=
            length(n.cross(path.spin)) * path.angular_speed * from_axis;
        self.second_derivative_without_allowance += n.dot(path.acceleration);
    }
}

/// Returns the errors of the rate and the second derivative of two triangles, as shares of their allowances.
fn error_shares(tape: &mut RandomCase) -> Option<[f64; 2]> {
    let triangles = [(); 2].map(|()| [(); 3].map(|()| DVec3::from(tape.vector(-20..=4))));
    let bodies = triangles.map(|triangle| body(&[triangle]));
    let motions = [motion(tape)?, motion(tape)?];
    let [a, b] = [0, 1].map(|k| (&bodies[k], motions[k]));
    let pulls = [(); 2].map(|()| match tape.index_below(2) {
        0 => DVec3::ZERO,
        _ => DVec3::from(tape.vector(-20..=6)),
    });
    let bodies = [a, b];
    let problem =
        Problem::with_accelerations(bodies, pulls, 1.0, &Settings::DEFAULT.to_query_settings())
            .ok()?;
    let (n, s) = (unit(tape.vector(-40..=0).into())?, tape.next_fraction());
    let sides = [&problem.a, &problem.b];
    let nodes = sides.map(|side| PlacedNode::new(side, side.body.tree().node_count() as u32, s));
    let [at, bt] = &nodes;
    let found = ApproachRateBounds::approach_rate_bounds_along_axis(&problem, [at, bt], n, s);
    let mut sums = ApproachRateTerms::new();
    for (k, n) in [(0, n), (1, -n)] {
        sums.add(sides[k], &motions[k], &nodes[k], n, s);
    }
    let allowed = RATE_ERROR_F64 * (2.0 * sums.speed + sums.size);
    let rate = DoubleDouble::from(found.rate_bound) - DoubleDouble::from(allowed);
    let rate = error_fraction((sums.rate - rate).get(), allowed);
    let allowed = found.second_derivative - sums.second_derivative_without_allowance;
    let second_derivative = error_fraction(
        (sums.second_derivative - DoubleDouble::from(sums.second_derivative_without_allowance))
            .get(),
        allowed,
    );
    Some([rate, second_derivative])
}

#[test]
fn worst_rate() {
    let found = WorstCaseSearch::new("RATE_F64, rates of nodes", 20_000)
        .search(|tape| Some(error_shares(tape)?[0]));
    found.assert_tight_bound(40.0);
}

#[test]
fn worst_bend() {
    let found = WorstCaseSearch::new("RATE_F64, bends of nodes", 20_000)
        .search(|tape| Some(error_shares(tape)?[1]));
    found.assert_tight_bound(40.0);
}
