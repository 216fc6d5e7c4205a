//! Searches for the worst errors of heights along a fixed axis, against double-double arithmetic.
//!
//! The reference takes the axis and the body's rounded frame as given, and computes everything from there on exactly.
//! Earlier rounding is that of distances.

use super::super::{Heights, PointHeight};
use crate::body::Body;
use crate::body::polytope::Polytope;
use crate::math::order::greater;
use crate::math::vector::{distance, length, unit};
use crate::motion::Motion;
use crate::motion::pose::{Frame, Pose};
use crate::motion::track::{AngleSinCos, RotatingVector};
use crate::problem::Problem;
use crate::rounding::{RATE_ERROR_F64, TURNED_SUPPORT_ERROR};
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{body, random_rotation};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use glam::DVec3;

/// The rotation of a body about a center from a given frame, in double-double arithmetic.
struct ExactRotation {
    frame: Frame,
    spin: DoubleDouble3,
    center: DoubleDouble3,
}

impl ExactRotation {
    /// Returns the vector from the center to a point after a rotation by an angle.
    fn rotated_arm(&self, point: DVec3, angle: f64) -> DoubleDouble3 {
        let local = DoubleDouble3::from(point) - self.center;
        let rotation = self.frame.rotation;
        let columns = [rotation.x_axis, rotation.y_axis, rotation.z_axis].map(DoubleDouble3::from);
        let [x, y, z] = [0, 1, 2].map(|k| columns[k].scale(local.0[k]));
        (x + y + z).turned(self.spin.unit(), DoubleDouble::from(angle))
    }
}

/// Draws a motion about the body's origin or a center, over a time of 1, by up to 1e5 radians.
fn motion(tape: &mut RandomCase) -> Option<Motion> {
    let [velocity, spin, center] = [-20..=6, -20..=15, -20..=8].map(|range| tape.vector(range));
    let start = Pose::new(DVec3::ZERO, random_rotation(tape)).ok()?;
    Motion::about(start, velocity, spin, center)
        .ok()
        .filter(|motion| motion.angular_velocity() != DVec3::ZERO)
}

/// Returns the largest error of the rates of a triangle's corners, as a share of its allowance.
fn rate_error_share(tape: &mut RandomCase) -> Option<f64> {
    let body = body(&[[(); 3].map(|()| DVec3::from(tape.vector(-20..=4)))]);
    let (motion, ball) = (motion(tape)?, Body::sphere(0.1).ok()?);
    let still = Motion::still(Pose::IDENTITY);
    let problem =
        Problem::of_moving_bodies((&body, motion), (&ball, still), 1.0, &Settings::DEFAULT).ok()?;
    let (side, normal) = (&problem.a, unit(tape.vector(-40..=0).into())?);
    let [clock, tau] = [0; 2].map(|_| tape.next_fraction());
    let turning = ExactRotation {
        frame: side.path.frame(clock),
        spin: DoubleDouble3::from(motion.angular_velocity()),
        center: DoubleDouble3::from(motion.center()),
    };
    let piece = body.piece(0);
    let heights = Heights::new(side, &piece, &turning.frame, normal, clock);
    let share_of = |(point, found): (&DVec3, PointHeight)| {
        let arm = turning.rotated_arm(*point, side.path.angular_speed * tau);
        let velocity = DoubleDouble3::from(motion.velocity()) + turning.spin.cross(arm);
        let exact = DoubleDouble3::from(normal).dot(velocity);
        let off = (DoubleDouble::from(found.rate) - exact).get().abs();
        error_fraction(off, RATE_ERROR_F64 * heights.speed_bound)
    };
    let shares = piece
        .points
        .iter()
        .zip(heights.point_heights_at(tau))
        .map(share_of);
    Some(shares.fold(f64::NEG_INFINITY, greater))
}

#[test]
fn worst_rate() {
    let found = WorstCaseSearch::new("RATE_F64, rates of points", 10_000).search(rate_error_share);
    found.assert_tight_bound(10.0);
}

/// Measures the rounding error of the upper bound of the distances to all points in a ball.
#[test]
fn worst_farthest() {
    let found = WorstCaseSearch::new("RATE_F64, a sum of lengths", 40_000).search(|tape| {
        let [middle, from] = [(); 2].map(|()| DVec3::from(tape.vector(-20..=20)));
        let radius = tape.size(-20..=20);
        let exact = (DoubleDouble3::from(middle) - DoubleDouble3::from(from)).length()
            + DoubleDouble::from(radius);
        let found = DoubleDouble::from(distance(middle, from) + radius);
        Some(error_fraction(
            (exact / found - DoubleDouble::from(1.0)).get(),
            RATE_ERROR_F64,
        ))
    });
    found.assert_tight_bound(16.0);
}

/// Returns the errors of the lowest height and of the least rate of many points, as shares of [`TURNED_SUPPORT_ERROR`].
/// The points are equally low up to rounding, and far from each other.
fn support_error_shares(tape: &mut RandomCase) -> Option<[f64; 2]> {
    let (motion, tau) = (motion(tape)?, tape.next_fraction());
    let ball = Body::sphere(0.1).ok()?;
    let still = Motion::still(Pose::IDENTITY);
    let alone =
        Problem::of_moving_bodies((&ball, motion), (&ball, still), 1.0, &Settings::DEFAULT).ok()?;
    let path = alone.a.path;
    let clock = tape.next_fraction();
    let (frame, normal) = (path.frame(clock), unit(tape.vector(-40..=0).into())?);
    let turn = path.angular_speed * tau;
    let angle = (AngleSinCos::new(turn), turn);
    let seen = RotatingVector::new(-path.axis, normal);
    let along = match tape.index_below(2) {
        0 => seen.vector_at(angle.0),
        _ => seen.derivative_at_angle(angle.0),
    };
    let level = unit(frame.inverse_transform_vector(along))?;
    let (east, north) = level.any_orthonormal_pair();
    let (middle, wide) = (DVec3::from(tape.vector(-20..=4)), tape.size(-10..=4));
    let fixed = tape.index_below(4);
    let points = (0..POINT_COUNT).map(|k| {
        // A few points are drawn, and the others are between them.
        let [x, y] = if k < 4 {
            [tape.any_number(-3..=0), tape.any_number(-3..=0)]
        } else {
            [0.5 * ((k * fixed) as f64 / 64.0).sin(), 0.25]
        };
        let up = if k < 4 {
            tape.any_number(-56..=-48).abs()
        } else {
            1e-3
        };
        middle + (east * x + north * y + level * up) * wide
    });
    let polytope = Polytope {
        points: points.collect(),
        ..Polytope::default()
    };
    let body = Body::polytope(polytope).ok()?;
    let problem =
        Problem::of_moving_bodies((&body, motion), (&ball, still), 1.0, &Settings::DEFAULT).ok()?;
    let (piece, side) = (body.piece(0), &problem.a);
    let turning = ExactRotation {
        frame,
        spin: DoubleDouble3::from(motion.angular_velocity()),
        center: DoubleDouble3::from(motion.center()),
    };
    let heights = Heights::new(side, &piece, &frame, normal, clock);
    let (middle, radius) = piece.bounding_ball()?;
    let farthest = length(frame.rotation * (middle - path.center)) + radius;
    let allowed = TURNED_SUPPORT_ERROR * (farthest + length(middle) + radius);
    let n = DoubleDouble3::from(normal);
    let arms: Vec<DoubleDouble3> = piece
        .points
        .iter()
        .map(|&p| turning.rotated_arm(p, angle.1))
        .collect();
    let miss = |direction: DVec3, of: &dyn Fn(&DoubleDouble3) -> DoubleDouble| {
        let chosen = piece.extremal_point(frame.inverse_transform_vector(-direction));
        let least = arms.iter().map(of).reduce(DoubleDouble::min)?;
        Some((of(&arms[chosen as usize]) - least).get())
    };
    let height = miss(seen.vector_at(angle.0), &|arm| n.dot(*arm))?;
    let rate = miss(seen.derivative_at_angle(angle.0), &|arm| {
        n.dot(turning.spin.cross(*arm))
    })?;
    assert!(heights.support_error_bound >= allowed);
    Some([
        error_fraction(height, allowed),
        error_fraction(rate, path.angular_speed * allowed),
    ])
}

/// The number of points of each tested piece, so many that extremal points are searched and not scanned.
const POINT_COUNT: usize = 36;

#[test]
fn worst_lowest_of_many() {
    let found = WorstCaseSearch::new("TURNED_SUPPORT, heights", 6_000)
        .search(|tape| Some(support_error_shares(tape)?[0]));
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_fastest_of_many() {
    let found = WorstCaseSearch::new("TURNED_SUPPORT, rates", 6_000)
        .search(|tape| Some(support_error_shares(tape)?[1]));
    found.assert_tight_bound(100.0);
}
