//! Approximates short intervals of a path by constant motions.

use rigid_ccd::trajectory::Trajectory;
use rigid_ccd::{Body, Error, Motion};

/// An interval of a segment, and a constant motion that approximates a body's motion in it.
pub(super) struct ConstantStep {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The constant motion. It starts at the body's pose at the start of the interval. The unit of time is a segment.
    pub(super) motion: Motion,
    /// An upper bound of the distance between a point of the body and the same point under the constant motion.
    pub(super) deviation: f64,
}

/// The number of halvings after which the search for a step gives up.
const MAX_STEP_HALVINGS: u32 = 60;

impl ConstantStep {
    /// Returns the longest step, by halving, from the start of a section with a deviation of at most `max_deviation`.
    /// The section is from `from` to `to` on the path, where the time of `link` is from 0 to 1.
    pub(super) fn longest(
        link: &dyn Trajectory,
        body: &Body,
        (from, to): (f64, f64),
        max_deviation: f64,
    ) -> Result<Option<Self>, Error> {
        let start = link.stretch_between(0.0, 0.0)?;
        let length = to - from;
        let mut fraction = 1.0;
        for _ in 0..MAX_STEP_HALVINGS {
            let near = link.stretch_between(0.0, fraction)?;
            let (motion, acceleration) = (near.motion, near.acceleration);
            let center = motion.center();
            // Uses the velocity at the midpoint. The center deviates from that motion by at most an eighth of the
            // acceleration times the squared duration.
            let velocity = motion.velocity() + 0.5 * fraction * acceleration;
            let curved = 0.125 * fraction * fraction * acceleration.length();
            let reach = body.bounding_radius() + center.length();
            // Two bounds are for the approximation over the step, one for its start at the exact pose.
            let bounds = [
                near.deviation_bound,
                near.deviation_bound,
                start.deviation_bound,
            ];
            let deviation = curved
                + bounds
                    .map(|bound| bound.at_reach(reach))
                    .iter()
                    .sum::<f64>();
            let deviation = deviation * (1.0 + 1e-12);
            // Written so that a NaN deviation is too large.
            if deviation <= max_deviation {
                let [velocity, spin] =
                    [velocity, motion.angular_velocity()].map(|rate| rate / length);
                return Ok(Some(ConstantStep {
                    from,
                    to: if fraction == 1.0 {
                        to
                    } else {
                        from + fraction * length
                    },
                    motion: Motion::about(start.motion.start(), velocity, spin, center)?,
                    deviation,
                }));
            }
            fraction *= 0.5;
        }
        Ok(None)
    }
}
