//! Searches for the worst errors of heights and rates along an axis that turns with a body.
//!
//! The reference takes the axis, the rounded frame and the offset between the bodies as given, and computes
//! everything from there on exactly. Earlier rounding is that of distances, which is counted separately.

use super::super::{HeightTerms, PieceMotionToTurningPlane};
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::math::vector::unit;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::rounding::turning_axis_rounding;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{body, random_rotation};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use crate::tuning::MAX_TURNING_PLANE_TIME;
use glam::DVec3;

/// Draws a motion over a time of 1 that turns by up to 1e5 radians, about the body's origin or another center.
fn motion(tape: &mut RandomCase) -> Option<Motion> {
    let ranges = [-20..=6, -20..=15, -20..=8, -20..=6];
    let [velocity, spin, center, at] = ranges.map(|range| tape.vector(range));
    Motion::about(
        Pose::new(at, random_rotation(tape)).ok()?,
        velocity,
        spin,
        center,
    )
    .ok()
}

/// A point of one body and a plane that turns with the other body, to compare computed heights with exact heights.
struct PointAndTurningPlane<'s> {
    sweep: &'s PieceMotionToTurningPlane<'s>,
    motions: [Motion; 2],
    normal: DVec3,
    point: DVec3,
}

impl PointAndTurningPlane<'_> {
    /// Returns the computed height of the point above the plane after a time, and the rate of the height.
    fn computed_height_and_rate(&self, tau: f64) -> [DoubleDouble; 2] {
        let HeightTerms {
            height,
            axis,
            rate,
            rate_axis: closing,
        } = self.sweep.height_terms_after(tau);
        let arm = self.point - self.sweep.reference_point;
        [height + axis.dot(arm), rate + closing.dot(arm)].map(DoubleDouble::from)
    }

    fn exact_height_and_rate(&self, tau: f64) -> [DoubleDouble; 2] {
        let [spin, own] = self
            .motions
            .map(|motion| DoubleDouble3::from(motion.angular_velocity()));
        let [away, velocity] = self
            .motions
            .map(|motion| DoubleDouble3::from(motion.velocity()));
        let turned = |v: DoubleDouble3, spin: DoubleDouble3| {
            if spin.length().get() > 0.0 {
                v.turned(spin.unit(), spin.length() * DoubleDouble::from(tau))
            } else {
                v
            }
        };
        let normal = turned(DoubleDouble3::from(self.normal), spin);
        let local =
            DoubleDouble3::from(self.point) - DoubleDouble3::from(self.sweep.reference_point);
        let rotation = self.sweep.frame.rotation;
        let columns = [rotation.x_axis, rotation.y_axis, rotation.z_axis].map(DoubleDouble3::from);
        let [x, y, z] = [0, 1, 2].map(|k| columns[k].scale(local.0[k]));
        let arm = turned(x + y + z, own);
        let passing = velocity - away;
        let way = DoubleDouble3::from(self.sweep.reference_point_offset)
            + passing.scale(DoubleDouble::from(tau))
            + arm;
        let rate = spin.cross(normal).dot(way) + normal.dot(passing + own.cross(arm));
        [normal.dot(way), rate]
    }

    /// Returns the bound of the second derivative twice: in double-double arithmetic, and in f64 without the allowances
    /// for rounding.
    fn second_derivative_bounds(&self, tau: f64) -> [DoubleDouble; 2] {
        let [spin, own] = self
            .motions
            .map(|motion| DoubleDouble3::from(motion.angular_velocity()));
        let [away, velocity] = self
            .motions
            .map(|motion| DoubleDouble3::from(motion.velocity()));
        let (passing, time) = (
            velocity - away,
            DoubleDouble::from(f64::from(MAX_TURNING_PLANE_TIME)),
        );
        let way = DoubleDouble3::from(self.sweep.reference_point_offset)
            + passing.scale(DoubleDouble::from(tau));
        let arm = spin.unit().cross(way).length() + passing.length() * time;
        let across = spin.cross(DoubleDouble3::from(self.normal)).length();
        let two = DoubleDouble::from(2.0);
        let exact = across * (spin.length() * arm + two * passing.length())
            + (spin - own).length()
                * (across + own.length())
                * DoubleDouble::from(self.sweep.radius);
        let sweep = self.sweep;
        let arm = sweep
            .rotation_axis
            .cross(sweep.reference_point_offset + sweep.velocity * tau)
            .length()
            + sweep.speed * f64::from(MAX_TURNING_PLANE_TIME);
        let across = sweep.angular_speed * sweep.normal.derivative_length();
        let plain = across * (sweep.angular_speed * arm + 2.0 * sweep.speed)
            + sweep.relative_spin.length() * (across + sweep.own_angular_speed) * sweep.radius;
        [exact, DoubleDouble::from(plain)]
    }
}

/// Returns the errors of a height change, a rate and a second derivative, as shares of their allowances.
fn error_shares(tape: &mut RandomCase) -> Option<[f64; 3]> {
    let triangles = [(); 2].map(|()| [(); 3].map(|()| DVec3::from(tape.vector(-20..=4))));
    let bodies = triangles.map(|triangle| body(&[triangle]));
    let motions = [motion(tape)?, motion(tape)?];
    let [a, b] = [0, 1].map(|k| (&bodies[k], motions[k]));
    let problem = Problem::of_moving_bodies(a, b, 1.0, &Settings::DEFAULT).ok()?;
    let placed = PlacedPair::new(&problem, [0, 0], tape.next_fraction());
    let [own, other] = placed.moving_pieces();
    let normal = unit(tape.vector(-40..=0).into())?;
    if !own.body_with_path.path.is_turning() {
        return None;
    }
    let sweep = PieceMotionToTurningPlane::new(&own, &other, normal, problem.rounding);
    let setting = PointAndTurningPlane {
        sweep: &sweep,
        motions,
        normal,
        point: other.piece.points[tape.index_below(3)],
    };
    let tau = tape.next_fraction();
    let rounding = turning_axis_rounding(sweep.angular_speed + sweep.own_angular_speed);
    let [start, end, from, to] = [
        setting.computed_height_and_rate(0.0),
        setting.computed_height_and_rate(tau),
        setting.exact_height_and_rate(0.0),
        setting.exact_height_and_rate(tau),
    ];
    let height = ((end[0] - start[0]) - (to[0] - from[0])).get().abs();
    let rate = (end[1] - to[1]).get().abs();
    let fastest =
        sweep.angular_speed * sweep.reach + sweep.speed + sweep.own_angular_speed * sweep.radius;
    let [exact, plain] = setting.second_derivative_bounds(tau);
    let allowed = (DoubleDouble::from(sweep.second_derivative(tau)) - plain).get();
    Some([
        error_fraction(height, rounding * sweep.reach),
        error_fraction(rate, rounding * fastest),
        error_fraction((exact - plain).get(), allowed),
    ])
}

#[test]
fn worst_height() {
    let found = WorstCaseSearch::new("attached_rounding, heights", 10_000)
        .search(|tape| Some(error_shares(tape)?[0]));
    found.assert_tight_bound(60.0);
}

#[test]
fn worst_rate() {
    let found = WorstCaseSearch::new("attached_rounding, rates", 10_000)
        .search(|tape| Some(error_shares(tape)?[1]));
    found.assert_tight_bound(60.0);
}

#[test]
fn worst_bend() {
    let found = WorstCaseSearch::new("RATE_F64, bends past a turning plane", 10_000)
        .search(|tape| Some(error_shares(tape)?[2]));
    found.assert_tight_bound(40.0);
}
