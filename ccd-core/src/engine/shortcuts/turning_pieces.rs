//! Free times of pairs of pieces by a plane that turns with one of the bodies.
//!
//! For a fixed plane the full speed of a turning piece's far rim counts, however small the other piece is. For a
//! plane that turns with the body it does not count: the heights of the body's own piece are constant, and only the
//! other piece sweeps towards the plane.
//!
//! A point of the other piece is at `D + r` from the turning body's center: `D` leads to a point of
//! reference that moves at `V`, and `r` turns about that point at `ω_s`. With `n' = ω×n`
//! and `Δ = ω − ω_s`, the height `f = n·(D + r)` has `f' = (ω×n)·D + n·V + (Δ×n)·r` and `|f''| ≤
//! |ω×n|(|ω||u×D| + 2|V|) + |Δ|(|ω×n| + |ω_s|)|r| + |V'|`, where `u` is the direction of `ω`.

use crate::body::piece::Piece;
use crate::math::order::lesser;
use crate::motion::free_time::FreeTime;
use crate::motion::gap::{Gap, first_possible_crossing};
use crate::motion::pose::Frame;
use crate::motion::track::{AngleSinCos, RotatingVector};
use crate::problem::BodyWithPath;
use crate::rounding::{RATE_ERROR_F64, turning_axis_rounding};
use crate::tuning::{MAX_NEWTON_STEPS, MAX_TURNING_PLANE_TIME};
use glam::DVec3;
use std::cell::Cell;

/// A piece with the pose and the motion of its body at a clock.
pub(crate) struct MovingPiece<'p> {
    pub(crate) body_with_path: &'p BodyWithPath<'p>,
    pub(crate) frame: &'p Frame,
    pub(crate) piece: Piece<'p>,
    pub(crate) time: f64,
    /// An upper bound of the speed of any point of the piece relative to the piece's first point.
    pub(crate) rotational_speed_bound: f64,
}

impl<'p> MovingPiece<'p> {
    pub(crate) fn new(
        side: &'p BodyWithPath<'p>,
        frame: &'p Frame,
        piece: Piece<'p>,
        clock: f64,
    ) -> Self {
        let relative_speed = if side.path.is_turning() {
            side.path.angular_speed * piece.max_distance_from(piece.points[0])
        } else {
            0.0
        };
        MovingPiece {
            body_with_path: side,
            frame,
            piece,
            time: clock,
            rotational_speed_bound: relative_speed,
        }
    }

    /// Returns an upper bound of the rate at which any point of the piece moves along `normal`, relative to the piece's
    /// first point. It is at most `relative_speed`, which holds for every axis.
    pub(crate) fn rotational_speed_bound_along(&self, normal: DVec3) -> f64 {
        let path = &self.body_with_path.path;
        self.rotational_speed_bound * path.spin.cross(normal).length() / path.angular_speed
    }
}

/// A piece of one body, as seen from a plane that turns with the other body.
pub(crate) struct PieceMotionToTurningPlane<'p> {
    /// The plane's normal `n`, which turns at `ω`.
    normal: RotatingVector,
    rotation_axis: DVec3,
    angular_speed: f64,
    /// The vector `D`, from the turning body's center to the reference point, at the present clock.
    reference_point_offset: DVec3,
    velocity: DVec3,
    speed: f64,
    /// The acceleration `V'` of the reference point relative to the turning body's center, which is constant.
    acceleration: DVec3,
    /// The direction of the angular velocity `ω_s` of the piece's own body.
    own_rotation_axis: DVec3,
    own_angular_speed: f64,
    /// The relative angular velocity `Δ = ω − ω_s`.
    relative_spin: DVec3,
    piece: Piece<'p>,
    frame: &'p Frame,
    /// The reference point at the end of `D`, in the frame of the piece's body.
    reference_point: DVec3,
    radius: f64,
    /// An upper bound of the distances of the piece's points from the turning body's center, at any time.
    reach: f64,
    /// A bound of the error of the points' positions by rounding, for both bodies together.
    position_error_bound: f64,
    /// The number of times that a point's height above the plane was computed; it is counted as work.
    pub(crate) evaluations: Cell<u64>,
}

/// The coefficients of a point's height above the plane, and of the rate of the height, at one time. A point with the
/// vector `arm` in its body's frame has the height `height + axis·arm` and the rate `rate + rate_axis·arm`.
struct HeightTerms {
    height: f64,
    axis: DVec3,
    rate: f64,
    rate_axis: DVec3,
}

impl<'p> PieceMotionToTurningPlane<'p> {
    /// Creates the description of the piece `other` relative to a plane that turns with the body of `holder`. The
    /// `normal` points from that body to the piece, and `rounding` is the problem's.
    pub(crate) fn new(
        holder: &MovingPiece<'_>,
        other: &MovingPiece<'p>,
        normal: DVec3,
        rounding: f64,
    ) -> Self {
        let (path, own) = (&holder.body_with_path.path, &other.body_with_path.path);
        // All points of a body that does not turn move alike, and one of the piece's own points is nearest.
        let reference = if own.is_turning() {
            own.center
        } else {
            other.piece.points[0]
        };
        let offset =
            other.frame.transform_point(reference) - holder.frame.transform_point(path.center);
        let velocity = own.center_velocity_at(other.time) - path.center_velocity_at(other.time);
        let acceleration = own.acceleration - path.acceleration;
        let speed = velocity.length() + acceleration.length();
        let radius = other.piece.max_distance_from(reference);
        PieceMotionToTurningPlane {
            normal: RotatingVector::new(path.axis, normal),
            rotation_axis: path.axis,
            angular_speed: path.angular_speed,
            reference_point_offset: offset,
            velocity,
            speed,
            acceleration,
            own_rotation_axis: own.axis,
            own_angular_speed: own.angular_speed,
            relative_spin: path.spin - own.spin,
            piece: other.piece,
            frame: other.frame,
            reference_point: reference,
            radius,
            reach: offset.length() + speed + radius,
            position_error_bound: rounding,
            evaluations: Cell::new(0),
        }
    }

    /// Returns a time for which the pieces certainly keep the required gap along the plane's normal, up to `horizon`.
    /// `slack` is the present excess over that gap.
    pub(crate) fn free_time(&self, slack: f64, horizon: f64) -> FreeTime {
        let (height, rate) = self.rounding_allowances();
        let apart = slack - height - self.least_start_height();
        first_possible_crossing(horizon, MAX_NEWTON_STEPS, |tau| {
            self.evaluations
                .set(self.evaluations.get() + self.piece.evaluations_per_search());
            let turned = self.height_terms_after(tau);
            let second_derivative = self.second_derivative(tau);
            let free = |axis: f64, closing: f64| {
                let gap = Gap {
                    gap: apart + (turned.height + axis),
                    rate: rate - (turned.rate + closing),
                    second_derivative,
                };
                gap.free_time()
            };
            let least = match self.piece.bounding_ball() {
                Some(_) => free(
                    self.least_height_along(turned.axis),
                    self.least_height_along(turned.rate_axis),
                ),
                None => self
                    .arms()
                    .map(|arm| free(turned.axis.dot(arm), turned.rate_axis.dot(arm)))
                    .fold(f64::INFINITY, lesser),
            };
            // The bound of the second derivative holds for that long only.
            lesser(f64::from(MAX_TURNING_PLANE_TIME), least)
        })
    }

    /// Returns a bound of the rounding of changes of height, and a bound of the rounding of their rates.
    fn rounding_allowances(&self) -> (f64, f64) {
        let turns = self.angular_speed + self.own_angular_speed;
        let rounding = turning_axis_rounding(turns);
        let fastest =
            self.angular_speed * self.reach + self.speed + self.own_angular_speed * self.radius;
        (
            2.0 * self.position_error_bound + rounding * self.reach,
            turns * self.position_error_bound + rounding * fastest,
        )
    }

    /// Returns the least height of the piece's points along the plane's normal at the start of the step.
    fn least_start_height(&self) -> f64 {
        let HeightTerms { height, axis, .. } = self.height_terms_after(0.0);
        height + self.least_height_along(axis)
    }

    /// Returns the least height of the piece's points along a direction, measured from the reference point.
    fn least_height_along(&self, direction: DVec3) -> f64 {
        if self.piece.bounding_ball().is_some() {
            let lowest = self.piece.points[self.piece.extremal_point(-direction) as usize];
            return direction.dot(lowest - self.reference_point);
        }
        let heights = self.arms().map(|arm| direction.dot(arm));
        heights.fold(f64::INFINITY, lesser)
    }

    /// Returns the vectors from the reference point to the piece's points, in the body's frame.
    fn arms(&self) -> impl Iterator<Item = DVec3> {
        let reference = self.reference_point;
        self.piece.points.iter().map(move |&y| y - reference)
    }

    fn height_terms_after(&self, tau: f64) -> HeightTerms {
        let angle = AngleSinCos::new(self.angular_speed * tau);
        let own = AngleSinCos::new(self.own_angular_speed * tau);
        let axis = self.normal.vector_at(angle);
        let (offset, velocity) = self.relative_position_and_velocity_after(tau);
        let turning = self.normal.derivative_at_angle(angle) * self.angular_speed;
        // The vectors that multiply the arms are rotated backwards, rather than every arm.
        let back = |v| {
            let turned = RotatingVector::new(-self.own_rotation_axis, v).vector_at(own);
            self.frame.inverse_transform_vector(turned)
        };
        HeightTerms {
            height: axis.dot(offset),
            axis: back(axis),
            rate: turning.dot(offset) + axis.dot(velocity),
            rate_axis: back(self.relative_spin.cross(axis)),
        }
    }

    /// Returns the offset `D` and the velocity `V` of the reference point from the turning body's center, at the time
    /// `tau` after the present clock.
    fn relative_position_and_velocity_after(&self, tau: f64) -> (DVec3, DVec3) {
        let velocity = self.velocity + self.acceleration * (0.5 * tau);
        (
            self.reference_point_offset + velocity * tau,
            self.velocity + self.acceleration * tau,
        )
    }

    /// Returns a bound of the second derivative of the points' heights, which holds for a time
    /// [`MAX_TURNING_PLANE_TIME`] from `tau` on.
    fn second_derivative(&self, tau: f64) -> f64 {
        let (offset, _) = self.relative_position_and_velocity_after(tau);
        let arm = self.rotation_axis.cross(offset).length()
            + self.speed * f64::from(MAX_TURNING_PLANE_TIME);
        let across = self.angular_speed * (self.normal.derivative_length() + RATE_ERROR_F64);
        let relative = self.relative_spin.length()
            + RATE_ERROR_F64 * (self.angular_speed + self.own_angular_speed);
        let second_derivative = across
            * (self.angular_speed * (arm + RATE_ERROR_F64 * self.reach) + 2.0 * self.speed)
            + relative * (across + self.own_angular_speed) * self.radius
            + self.acceleration.length();
        second_derivative * (1.0 + RATE_ERROR_F64)
    }
}

#[cfg(test)]
mod tests;
