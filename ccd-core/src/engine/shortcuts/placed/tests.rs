mod approach;

use super::PlacedNode;
use crate::body::Body;
use crate::body::polytope::Polytope;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::rounding::BOX_EXTENT_ERROR_F32;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{random_box_corners, random_direction};
use crate::tests::worst::{WorstCaseSearch, error_fraction};
use glam::DVec3;

/// Searches for the point of a body that lies farthest outside its placed box, as a share of the allowance for
/// rounding.
#[test]
fn worst_reach_of_a_box() {
    let still = Motion::still(Pose::IDENTITY);
    let ball = Body::sphere(0.1).unwrap();
    let found = WorstCaseSearch::new("BOX_AXES_F32", 20_000).search(|tape| {
        let points = random_box_corners(tape);
        let of = Polytope {
            points: points.clone(),
            ..Polytope::default()
        };
        let body = Body::polytope(of).ok()?;
        let problem =
            Problem::of_moving_bodies((&body, still), (&ball, still), 1.0, &Settings::DEFAULT)
                .ok()?;
        let node = PlacedNode::new(&problem.a, 0, 0.0);
        let along = points[tape.index_below(8)] - points[tape.index_below(8)];
        let n =
            (along.normalize_or_zero() + random_direction(tape) * tape.size(-30..=4)).normalize();
        let height = |&p: &DVec3| {
            let way = DoubleDouble3::from(p) - DoubleDouble3::from(node.center);
            DoubleDouble3::from(n).dot(way)
        };
        let highest = points.iter().map(height).reduce(DoubleDouble::max)?;
        let allowed = BOX_EXTENT_ERROR_F32 * node.bounding_radius;
        let reach = DoubleDouble::from(node.extent_along(n)) - DoubleDouble::from(allowed);
        Some(error_fraction((highest - reach).get(), allowed))
    });
    found.assert_tight_bound(20.0);
}
