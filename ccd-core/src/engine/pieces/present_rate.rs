//! How long a fixed plane keeps two pieces apart at the present rate, in closed form. For most pairs this is shorter by
//! a few percent than the time for which points are followed, and takes a tenth of the instructions.

use super::heights::MAX_TRACKED_POINTS;
use super::placed_pair::PlacedPair;
use super::planes::SeparatingPlane;
use crate::body::piece::Piece;
use crate::math::order::greater;
use crate::math::vector::length;
use crate::motion::free_time::FreeTime;
use crate::motion::gap::Gap;
use crate::motion::pose::Frame;
use crate::problem::BodyWithPath;
use crate::rounding::RATE_ERROR_F64;
use crate::tuning::MIN_CLOSED_BY_RATE_SHARE;
use glam::DVec3;

/// Bounds of the speeds at which the points of a piece rise along a fixed axis, with allowances for rounding.
struct RiseBound {
    /// An upper bound of the present rates of the points' heights.
    rate: f64,
    /// An upper bound of the second derivatives of the points' heights, at all times.
    second_derivative: f64,
}

impl PlacedPair<'_> {
    /// Returns a time for which the gap along a plane's fixed normal certainly stays above the required gap. `None` says
    /// that following the points is worth it: the time is short because the rate may change, or a piece has too many points.
    ///
    /// From rates `n·v + (n×ω)·arm` and second derivatives of at most `|n×ω| |ω| |arm|`, with the arms of all points.
    pub(crate) fn free_time_at_present_rate(&self, plane: &SeparatingPlane) -> Option<FreeTime> {
        let pieces = [&self.pieces.a, &self.pieces.b];
        if pieces
            .iter()
            .any(|piece| piece.points.len() > MAX_TRACKED_POINTS)
        {
            return None;
        }
        let ([piece_a, piece_b], [frame_a, frame_b]) = (pieces, &self.frames);
        let normal = plane.normal;
        let a = RiseBound::new(&self.problem.a, piece_a, frame_a, normal, self.clock);
        let b = RiseBound::new(&self.problem.b, piece_b, frame_b, -normal, self.clock);
        let gap = Gap {
            gap: plane.gap_excess,
            rate: a.rate + b.rate,
            second_derivative: a.second_derivative + b.second_derivative,
        };
        let time = gap.free_time();
        let free = FreeTime::up_to(time, self.time_left());
        (free == FreeTime::ToEnd || gap.rate * time >= MIN_CLOSED_BY_RATE_SHARE * gap.gap)
            .then_some(free)
    }
}

impl RiseBound {
    #[inline]
    fn new(
        side: &BodyWithPath<'_>,
        piece: &Piece<'_>,
        frame: &Frame,
        normal: DVec3,
        clock: f64,
    ) -> Self {
        let path = &side.path;
        let velocity = path.center_velocity_at(clock);
        let acceleration = length(path.acceleration);
        let linear = RiseBound {
            rate: normal.dot(velocity) + RATE_ERROR_F64 * (length(velocity) + acceleration),
            second_derivative: normal.dot(path.acceleration) + RATE_ERROR_F64 * acceleration,
        };
        if !path.is_turning() {
            return linear;
        }
        let omega = path.angular_speed;
        let across = normal.cross(path.spin);
        let in_body = frame.inverse_transform_vector(across);
        let arms = piece.points.iter().map(|&x| x - path.center);
        let (rate, square) = arms.fold((f64::NEG_INFINITY, 0.0), |(rate, square), arm| {
            (
                greater(rate, in_body.dot(arm)),
                greater(square, arm.length_squared()),
            )
        });
        let speed = omega * square.sqrt();
        RiseBound {
            rate: linear.rate + rate + RATE_ERROR_F64 * speed,
            // For a normal along the axis, the product with it is nothing but rounding.
            second_derivative: linear.second_derivative
                + (length(across) + RATE_ERROR_F64 * omega) * speed * (1.0 + RATE_ERROR_F64),
        }
    }
}

#[cfg(test)]
mod tests;
