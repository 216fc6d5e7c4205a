//! Follows two pieces over time to a local minimum of their distance.

use super::NearestPair;
use crate::distance::oracle::DistanceOracle;
use crate::engine::meter::Meter;
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::math::order::lesser;
use crate::problem::Problem;
use crate::tuning::{FOLLOW_TOLERANCE_SHARE, MAX_FOLLOW_MEASUREMENTS, MAX_FOLLOW_ROTATION};

/// Follows the pieces of a contact to a nearby local minimum of their distance over time. Returns the nearest
/// measurement.
pub(crate) fn follow_to_minimum<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    seen: NearestPair,
) -> NearestPair {
    let mut descent = Descent {
        problem,
        oracle,
        meter,
        cache: O::Cache::default(),
        nearest_pair: seen,
    };
    if let Some([falling, other]) = descent.bracket_minimum(seen.time) {
        descent.narrow(falling, other);
    }
    descent.nearest_pair
}

struct Descent<'d, O: DistanceOracle> {
    problem: &'d Problem<'d>,
    oracle: &'d mut O,
    meter: &'d mut Meter,
    cache: O::Cache,
    nearest_pair: NearestPair,
}

/// The distance of two pieces at one clock, and its rate of change.
#[derive(Clone, Copy)]
struct DistanceAndRate {
    time: f64,
    distance: f64,
    rate: f64,
}

impl<O: DistanceOracle> Descent<'_, O> {
    /// Measures the pieces' distance and its rate at a clock, and records the distance if it is the least so far.
    /// Returns `None` if the oracle gives up, or if the least distance is within the tolerance already.
    fn measure(&mut self, clock: f64) -> Option<DistanceAndRate> {
        if self.nearest_pair.contact.separation.upper <= self.problem.tolerance {
            return None;
        }
        let pieces @ [a, b] = self.nearest_pair.pieces;
        let placed = PlacedPair::new(self.problem, [a, b], clock);
        let checked = placed.query_oracle(self.oracle, &mut self.cache, self.meter)?;
        if checked.upper < self.nearest_pair.contact.separation.upper {
            self.nearest_pair = NearestPair {
                time: clock,
                pieces,
                contact: placed.contact(pieces, &checked),
            };
        }
        let frame = &placed.frames[0];
        let [on_a, on_b] = [checked.witness_a, checked.witness_b].map(|w| frame.transform_point(w));
        let velocity = self.problem.b.path.velocity_at(on_b, clock)
            - self.problem.a.path.velocity_at(on_a, clock);
        Some(DistanceAndRate {
            time: clock,
            distance: checked.upper,
            rate: (frame.rotation * checked.axis).dot(velocity),
        })
    }

    /// Steps from a clock in the direction of time in which the distance decreases, until the distance grows again.
    /// Returns two clocks with a local minimum of the distance between them; the distance decreases from the first one
    /// on.
    fn bracket_minimum(&mut self, from: f64) -> Option<[DistanceAndRate; 2]> {
        let mut here = self.measure(from)?;
        let forward = here.rate < 0.0;
        let end = if forward { 1.0 } else { 0.0 };
        // The pieces would meet at this rate. A larger rotation may pass a valley of the distance.
        let turning = self.problem.a.path.angular_speed + self.problem.b.path.angular_speed;
        let mut step = lesser(
            (here.distance / here.rate).abs(),
            MAX_FOLLOW_ROTATION / turning,
        );
        for _ in 0..MAX_FOLLOW_MEASUREMENTS {
            let next = if forward {
                here.time + step
            } else {
                here.time - step
            };
            // Written so that NaN is beyond the end.
            let next = if (0.0..=1.0).contains(&next) {
                next
            } else {
                end
            };
            if next == here.time {
                return None;
            }
            let there = self.measure(next)?;
            let falls = (there.rate < 0.0) == forward;
            if !(falls && there.distance < here.distance) {
                return Some([here, there]);
            }
            here = there;
            step = lesser(2.0 * step, MAX_FOLLOW_ROTATION / turning);
        }
        None
    }

    /// Narrows the interval between two clocks, which contains a local minimum of the distance. The distance decreases
    /// from `falling` towards `other`.
    fn narrow(&mut self, mut falling: DistanceAndRate, mut other: DistanceAndRate) {
        for look in 0..MAX_FOLLOW_MEASUREMENTS {
            let width = other.time - falling.time;
            // Written so that NaN is narrow enough.
            if !((width * falling.rate).abs() > FOLLOW_TOLERANCE_SHARE * self.problem.tolerance) {
                return;
            }
            // The step goes to the zero of a straight line through both rates. Every other step halves the interval,
            // for rates that jump.
            let zero = falling.rate / (falling.rate - other.rate);
            let share = if look % 2 == 0 && (0.0..=1.0).contains(&zero) {
                zero
            } else {
                0.5
            };
            let Some(middle) = self.measure(falling.time + share * width) else {
                return;
            };
            let falls = (middle.rate < 0.0) == (falling.rate < 0.0);
            if falls && middle.distance < falling.distance {
                falling = middle;
            } else {
                other = middle;
            }
        }
    }
}
