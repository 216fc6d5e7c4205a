use super::BoundingVolume;
use crate::body::Body;
use crate::body::polytope::Polytope;
use crate::math::order::greater;
use crate::motion::Motion;
use crate::motion::pose::{Frame, Pose};
use crate::problem::Problem;
use crate::rounding::RAY_BOX_WIDENING_F64;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{random_box_corners, random_direction};
use crate::tests::worst::{WorstCaseSearch, error_fraction};

/// Searches for the largest rounding error of a box's projection on a direction, as a share of its allowance, the
/// widening.
#[test]
fn worst_box() {
    let still = Motion::still(Pose::IDENTITY);
    let ball = Body::sphere(0.1).unwrap();
    let found = WorstCaseSearch::new("RAY_BOX_WIDENING_F64", 10_000).search(|tape| {
        let points = random_box_corners(tape);
        let of = Polytope {
            points: points.clone(),
            ..Polytope::default()
        };
        let body = Body::polytope(of).ok()?;
        let problem =
            Problem::of_moving_bodies((&body, still), (&ball, still), 1.0, &Settings::DEFAULT)
                .ok()?;
        let node = BoundingVolume::new(&problem.a, 0, &Frame::IDENTITY);
        let along = points[tape.index_below(8)] - points[tape.index_below(8)];
        let n =
            (along.normalize_or_zero() + random_direction(tape) * tape.size(-30..=4)).normalize();
        let [_, high] = node.projection_interval(n);
        let axes = node.axes.map(|axis| axis.dot(n).abs());
        let allowed = RAY_BOX_WIDENING_F64 * node.radius * (axes[0] + axes[1] + axes[2]);
        let middle = DoubleDouble3::from(n).dot(DoubleDouble3::from(node.center));
        let lost = |p| {
            let height = DoubleDouble3::from(n).dot(DoubleDouble3::from(p));
            let reach = DoubleDouble::from(high - node.center.dot(n)) - DoubleDouble::from(allowed);
            (height - middle - reach).get()
        };
        let worst = points.iter().map(|&p| lost(p));
        Some(error_fraction(
            worst.fold(f64::NEG_INFINITY, greater),
            allowed,
        ))
    });
    found.assert_tight_bound(400.0);
}
