//! Computes the rounding errors of bounds, as shares of their allowances.

use super::{AxisValues, EightPairSample, free_times};
use crate::body::tree::LANES;
use crate::engine::nodes::shape::{Children, OtherNode};
use crate::math::order::greater;
use crate::rounding::{
    CROSS_PRODUCT_ERROR_F32, FREE_TIME_FACTOR_F32, LEAST_SECOND_DERIVATIVE_F32,
    SECOND_DERIVATIVE_FACTOR_F32,
};
use crate::settings::VectorInstructions;
use crate::tests::worst::error_fraction;

/// The gaps, second derivatives and free times of eight pairs along an axis.
pub(super) struct AxisFreeTimes {
    pub(super) gap_excess: [f32; LANES],
    pub(super) second_derivative: [f32; LANES],
    pub(super) free_times: [f32; LANES],
}

/// The errors of one pair along one axis, as shares of their allowances.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ErrorShares {
    pub(super) gap: f64,
    pub(super) rate: f64,
    pub(super) cross_product: f64,
    pub(super) clock: f64,
}

/// Returns the error of a free time as a share of the allowance in [`FREE_TIME_FACTOR_F32`].
pub(super) fn free_time_error_share(numbers: [f32; 4]) -> f64 {
    let [free, apart, rate, second_derivative] = numbers.map(f64::from);
    let root = (rate * rate + 2.0 * second_derivative * apart).sqrt();
    let exact = if rate > 0.0 {
        2.0 * apart / (rate + root)
    } else {
        (root - rate) / second_derivative
    };
    let factor = f64::from(FREE_TIME_FACTOR_F32);
    error_fraction(free / factor / exact - 1.0, 1.0 - factor)
}

impl<C: Children, P: OtherNode> EightPairSample<C, P> {
    /// Computes the free times from the gaps and rates of an axis, with exact second derivatives.
    pub(super) fn axis_free_times(&self, found: &AxisValues) -> AxisFreeTimes {
        let apart = found.gap.map(|gap| gap - self.motion.required_gap);
        let second_derivative = std::array::from_fn(|lane| {
            let n = found.normal(lane);
            (self.children[lane].second_derivative_bound(n)
                + self.other_node_solid.second_derivative_bound(n)) as f32
                + LEAST_SECOND_DERIVATIVE_F32
        });
        let closed = self.motion.closed_gap_threshold;
        let level = VectorInstructions::Best.simd_level();
        AxisFreeTimes {
            free_times: free_times(level, &apart, &found.rate, &second_derivative, closed),
            gap_excess: apart,
            second_derivative,
        }
    }

    /// Returns the rounding errors of one pair's bounds, as shares of their allowances.
    pub(super) fn error_shares(
        &self,
        found: &AxisValues,
        clocks: &AxisFreeTimes,
        lane: usize,
    ) -> ErrorShares {
        let (motion, child) = (&self.motion, &self.children[lane]);
        let (n, rate) = (found.normal(lane), found.rate[lane]);
        let exact = n.dot(self.velocity)
            + child.max_rotational_rate(n)
            + self.other_node_solid.max_rotational_rate(-n);
        let below = exact - f64::from(rate);
        let gap = -self.other_node_solid.max_height(-n, 0.0) - child.max_height(n, 0.0);
        let above = f64::from(found.gap[lane]) - gap;
        let mut shares = ErrorShares {
            gap: error_fraction(above, self.allowed_gap_error.into()),
            rate: error_fraction(below, motion.rate_allowance.into()),
            ..ErrorShares::default()
        };
        let turning = [
            (motion.split_body_rotation, child),
            (motion.other_rotation, &self.other_node_solid),
        ];
        for ((turning, body), length) in turning.iter().zip(found.cross_product_lengths) {
            let across = n.cross(body.spin).length();
            let found = length[lane] * SECOND_DERIVATIVE_FACTOR_F32;
            let of = error_fraction(
                across - f64::from(found),
                (CROSS_PRODUCT_ERROR_F32 * turning.angular_speed).into(),
            );
            shares.cross_product = greater(shares.cross_product, of);
        }
        let free = clocks.free_times[lane];
        if free > 0.0 && free < 1e30 {
            shares.clock = free_time_error_share([
                free,
                clocks.gap_excess[lane],
                rate,
                clocks.second_derivative[lane],
            ]);
        }
        shares
    }
}
