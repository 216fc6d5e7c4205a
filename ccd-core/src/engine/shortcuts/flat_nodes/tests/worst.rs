//! Tests that the extent of a flat node bounds the extent of all points that lie in its ball and between its two
//! planes.

use super::super::PlacedFlatNode;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::rounding::RATE_ERROR_F64;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{body, random_direction, random_rotation};
use crate::tests::worst::{WorstCaseSearch, error_fraction};
use glam::DVec3;

#[test]
fn worst_reach() {
    let plate = [[0.0, 1.0, 0.3], [1.0, 0.0, 0.4], [1.0, 1.0, 0.5]];
    let triangle =
        |k: usize| [0, 1, 2].map(|j| DVec3::new(plate[j][k], plate[(j + k) % 3][(k + 1) % 3], 0.0));
    let flat = body(&[triangle(0), triangle(1)]);
    let found = WorstCaseSearch::new("RATE_F64, the reach of flat nodes", 20_000).search(|tape| {
        let still = Motion::still(Pose::new(DVec3::ZERO, random_rotation(tape)).ok()?);
        let problem =
            Problem::of_moving_bodies((&flat, still), (&flat, still), 1.0, &Settings::DEFAULT)
                .ok()?;
        let node = PlacedFlatNode::new(&problem.a, 0, 0.0)?;
        let n = (node.normal + random_direction(tape) * tape.size(-30..=4)).normalize();
        let [exact, normal] = [n, node.normal].map(DoubleDouble3::from);
        let along = exact.dot(normal).get().abs();
        let radius = node.node.bounding_radius;
        let truth = DoubleDouble::from(node.half_thickness?) * DoubleDouble::from(along)
            + DoubleDouble::from(radius) * exact.cross(normal).length();
        let allowed = RATE_ERROR_F64 * radius;
        let lost = truth - (DoubleDouble::from(node.extent_along(n)) - DoubleDouble::from(allowed));
        Some(error_fraction(lost.get(), allowed))
    });
    found.assert_tight_bound(20.0);
}
