//! The heights of a moving piece's points along a fixed axis.

use crate::body::piece::Piece;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::pose::Frame;
use crate::motion::track::{AngleSinCos, HeightFunction, MotionAlongAxis, RotatingVector};
use crate::problem::BodyWithPath;
use crate::rounding::{RATE_ERROR_F64, TURNED_SUPPORT_ERROR};
use glam::DVec3;

/// The heights of a piece's points along a fixed axis while their body moves.
///
/// Few points are followed one by one. Of many points, only two are computed: the lowest one along the axis, as the
/// body then sees the axis, and the one with the least rate. Heights after some time, and rates, are products of a
/// vector with the points in the body's frame.
pub(crate) struct Heights<'a> {
    piece: &'a Piece<'a>,
    frame: &'a Frame,
    /// The center of rotation in the body's frame.
    center: DVec3,
    normal: DVec3,
    /// The unit axis about which the body turns.
    rotation_axis: DVec3,
    pub(crate) motion_along_axis: MotionAlongAxis,
    angular_speed: f64,
    /// An upper bound of the speed of any point at any time.
    pub(crate) speed_bound: f64,
    /// The magnitude of the center's acceleration.
    acceleration: f64,
    /// The least height now.
    pub(crate) least_height: f64,
    point_tracks: PointTracks,
    /// A bound of the second derivatives of all points' heights, if there are many points.
    second_derivative: f64,
    /// A bound of the error of the lowest height of a piece of many points, which is searched for; 0 for few points.
    /// Times the angular speed, it bounds the error of the least rate.
    support_error_bound: f64,
}

/// The height of one point along the axis, its rate, and a bound of the second derivative due to rotation. For many
/// points these are bounds over all of them, from below, and from above for the second derivative.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PointHeight {
    pub(crate) height: f64,
    pub(crate) rate: f64,
    pub(crate) second_derivative: f64,
}

/// The largest number of points of a piece for which all pairs of points are bounded one by one.
pub(super) const MAX_TRACKED_POINTS: usize = 3;

/// The tracks of up to three points; unused entries repeat the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointTracks([(HeightFunction, f64); MAX_TRACKED_POINTS]);

impl PointTracks {
    /// Returns the heights and rates of the points after a time `tau`, in which the body turns by `angle`.
    #[inline]
    pub(crate) fn heights_at(
        &self,
        angle: AngleSinCos,
        tau: f64,
    ) -> [PointHeight; MAX_TRACKED_POINTS] {
        self.0.map(|(track, second_derivative)| PointHeight {
            height: track.height_at(tau, angle),
            rate: track.rate_at(tau, angle),
            second_derivative,
        })
    }
}

impl<'a> Heights<'a> {
    pub(crate) fn new(
        side: &BodyWithPath<'_>,
        piece: &'a Piece<'a>,
        frame: &'a Frame,
        normal: DVec3,
        clock: f64,
    ) -> Self {
        let path = &side.path;
        let velocity = path.center_velocity_at(clock);
        let mut heights = Heights {
            piece,
            frame,
            center: path.center,
            normal,
            rotation_axis: path.axis,
            motion_along_axis: MotionAlongAxis::new(
                velocity,
                path.axis,
                path.angular_speed,
                normal,
            )
            .with_acceleration(path.acceleration.dot(normal)),
            angular_speed: path.angular_speed,
            speed_bound: length(velocity) + length(path.acceleration),
            acceleration: length(path.acceleration),
            least_height: f64::INFINITY,
            point_tracks: PointTracks([(HeightFunction::default(), 0.0); MAX_TRACKED_POINTS]),
            second_derivative: 0.0,
            support_error_bound: 0.0,
        };
        match piece.bounding_ball() {
            Some((middle, radius)) => heights.init_many_points(middle, radius),
            None => heights.init_few_points(),
        }
        heights
    }

    fn init_few_points(&mut self) {
        let (mut least_height, mut farthest, mut few) = (f64::INFINITY, 0.0, self.point_tracks);
        for (k, (track, arm)) in self.tracks_and_arms().enumerate() {
            least_height = lesser(least_height, track.height_at(0.0, AngleSinCos::ZERO));
            farthest = greater(farthest, arm.length_squared());
            if let Some(rest) = few.0.get_mut(k..) {
                rest.fill((track, track.second_derivative_bound()));
            }
        }
        (self.least_height, self.point_tracks) = (least_height, few);
        self.speed_bound += self.angular_speed * farthest.sqrt();
    }

    fn init_many_points(&mut self, middle: DVec3, radius: f64) {
        self.least_height = self
            .lowest_track(self.normal)
            .height_at(0.0, AngleSinCos::ZERO);
        if self.is_nonrotating() {
            return;
        }
        let arm = self.frame.rotation * (middle - self.center);
        let farthest = (length(arm) + radius) * (1.0 + RATE_ERROR_F64);
        self.speed_bound += self.angular_speed * farthest;
        self.second_derivative = self
            .motion_along_axis
            .second_derivative(length(self.rotation_axis.cross(arm)) + radius)
            * (1.0 + RATE_ERROR_F64);
        self.support_error_bound = TURNED_SUPPORT_ERROR * (farthest + length(middle) + radius);
    }

    pub(crate) fn is_nonrotating(&self) -> bool {
        !(self.angular_speed > 0.0)
    }

    pub(crate) fn angle_sin_cos(&self, tau: f64) -> AngleSinCos {
        if tau > 0.0 && !self.is_nonrotating() {
            AngleSinCos::new(self.angular_speed * tau)
        } else {
            AngleSinCos::ZERO
        }
    }

    pub(crate) fn tracks_if_few_points(&self) -> Option<&PointTracks> {
        (self.piece.points.len() <= MAX_TRACKED_POINTS).then_some(&self.point_tracks)
    }

    /// Returns lower bounds of the heights and rates of all points after `tau`.
    pub(crate) fn bound_all_points(&self, tau: f64) -> PointHeight {
        let start = PointHeight {
            height: f64::INFINITY,
            rate: f64::INFINITY,
            second_derivative: 0.0,
        };
        match self.piece.bounding_ball() {
            Some(_) => self.bound_many_points(self.angle_sin_cos(tau), tau),
            None => self
                .point_heights_at(tau)
                .fold(start, |bound, point| PointHeight {
                    height: lesser(bound.height, point.height),
                    rate: lesser(bound.rate, point.rate),
                    second_derivative: greater(bound.second_derivative, point.second_derivative),
                }),
        }
    }

    /// Returns an upper bound of how far rotation alone moves any point below [`Heights::least_height`] until
    /// `horizon`; `None` for a piece of many points.
    pub(crate) fn max_rotational_descent_until(&self, horizon: f64) -> Option<f64> {
        if self.piece.bounding_ball().is_some() {
            return None;
        }
        let end = self.angle_sin_cos(horizon);
        let least_height = self
            .tracks_and_arms()
            .map(|(track, _)| track.least_rotational_height(horizon, end))
            .fold(f64::INFINITY, lesser);
        Some(self.least_height - least_height)
    }

    /// Returns a lower bound of the second derivative of the points' heights without rotation.
    pub(crate) fn linear_acceleration_lower_bound(&self) -> f64 {
        self.motion_along_axis.linear_acceleration - RATE_ERROR_F64 * self.acceleration
    }

    /// Returns a lower bound of the least value of a function over all points after `tau`. The function is evaluated
    /// for each point if there are few, and for their bound if there are many. It must decrease with heights and rates.
    pub(crate) fn min_over_points_lower_bound(
        &self,
        tau: f64,
        of: impl Fn(&PointHeight) -> f64,
    ) -> f64 {
        match self.piece.bounding_ball() {
            Some(_) => of(&self.bound_all_points(tau)),
            None => self
                .point_heights_at(tau)
                .map(|point| of(&point))
                .fold(f64::INFINITY, lesser),
        }
    }

    fn point_heights_at(&self, tau: f64) -> impl Iterator<Item = PointHeight> {
        let angle = self.angle_sin_cos(tau);
        self.tracks_and_arms().map(move |(track, _)| PointHeight {
            height: track.height_at(tau, angle),
            rate: track.rate_at(tau, angle),
            second_derivative: track.second_derivative_bound(),
        })
    }

    fn bound_many_points(&self, angle: AngleSinCos, tau: f64) -> PointHeight {
        if self.is_nonrotating() {
            return PointHeight {
                height: self.least_height + self.motion_along_axis.linear_displacement(tau),
                rate: self.motion_along_axis.linear_rate
                    + self.motion_along_axis.linear_acceleration * tau,
                second_derivative: 0.0,
            };
        }
        // The normal, as seen from the turning body.
        let seen = RotatingVector::new(-self.rotation_axis, self.normal);
        let (axis, derivative_length) = (seen.vector_at(angle), seen.derivative_at_angle(angle));
        PointHeight {
            height: self.lowest_track(axis).height_at(tau, angle) - self.support_error_bound,
            rate: self.lowest_track(derivative_length).rate_at(tau, angle)
                - self.angular_speed * self.support_error_bound,
            second_derivative: self.second_derivative,
        }
    }

    /// Returns the height over time of the point that is lowest along a direction in the body's current pose.
    fn lowest_track(&self, direction: DVec3) -> HeightFunction {
        let index = self
            .piece
            .extremal_point(self.frame.inverse_transform_vector(-direction));
        self.track_and_arm(self.piece.points[index as usize]).0
    }

    /// Returns for each point its track and its arm from the center of rotation.
    fn tracks_and_arms(&self) -> impl Iterator<Item = (HeightFunction, DVec3)> {
        self.piece.points.iter().map(|&x| self.track_and_arm(x))
    }

    #[inline]
    fn track_and_arm(&self, point: DVec3) -> (HeightFunction, DVec3) {
        let arm = self.frame.rotation * (point - self.center);
        (
            self.motion_along_axis
                .height_function_of_point(self.normal.dot(arm), arm),
            arm,
        )
    }
}

/// Returns the least free time over all pairs of a point of `above` and a point of `below`.
#[inline]
pub(crate) fn least_free_time(
    above: &[PointHeight],
    below: &[PointHeight],
    free: impl Fn(&PointHeight, &PointHeight) -> f64,
) -> f64 {
    let free = &free;
    let times = below
        .iter()
        .flat_map(|x| above.iter().map(move |y| free(y, x)));
    times.fold(f64::INFINITY, lesser)
}

/// Returns a lower bound of the least free time over all pairs of points. The points of one body, each by itself, are
/// paired with a bound of the other body's. The lowest point and the one with the least rate may differ, and a bound of
/// both bodies would treat them as one. A body that does not turn loses nothing by its bound.
pub(crate) fn least_free_time_of_many_points(
    above: &Heights<'_>,
    below: &Heights<'_>,
    tau: f64,
    free: impl Fn(&PointHeight, &PointHeight) -> f64,
) -> f64 {
    let of_below = || {
        let bound = above.bound_all_points(tau);
        below.min_over_points_lower_bound(tau, |x| free(&bound, x))
    };
    let of_above = || {
        let bound = below.bound_all_points(tau);
        above.min_over_points_lower_bound(tau, |y| free(y, &bound))
    };
    match (above.is_nonrotating(), below.is_nonrotating()) {
        (true, _) => of_below(),
        (false, true) => of_above(),
        (false, false) => greater(of_below(), of_above()),
    }
}

#[cfg(test)]
mod tests;
