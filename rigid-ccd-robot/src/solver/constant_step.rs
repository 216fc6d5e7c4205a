//! Short intervals of a path in which a body moves almost as a constant motion does.

use rigid_ccd::trajectory::Trajectory;
use rigid_ccd::{Body, Error, Motion};

/// An interval of a segment in which a body moves almost as a constant motion does.
pub(super) struct ConstantStep {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The motion, which begins where the body is at the start, in segments as the unit of time.
    pub(super) motion: Motion,
    /// A bound of how far points of the body are from where the motion has them.
    pub(super) deviation: f64,
}

/// The number of halvings after which no shorter step is tried.
const MAX_STEP_HALVINGS: u32 = 60;

impl ConstantStep {
    /// Returns the longest step from the start of a section, of which the trajectory takes one unit of time.
    pub(super) fn longest(
        link: &dyn Trajectory,
        body: &Body,
        (from, to): (f64, f64),
        max_deviation: f64,
    ) -> Result<Option<Self>, Error> {
        let start = link.stretch_between(0.0, 0.0)?;
        let length = to - from;
        let mut share = 1.0;
        for _ in 0..MAX_STEP_HALVINGS {
            let near = link.stretch_between(0.0, share)?;
            let (motion, acceleration) = (near.motion, near.acceleration);
            let centre = motion.centre();
            // The velocity in the middle; the acceleration displaces the centre from that by an eighth at most.
            let velocity = motion.velocity() + 0.5 * share * acceleration;
            let curved = 0.125 * share * share * acceleration.length();
            let reach = body.bounding_radius() + centre.length();
            // Once for the motion that is near, once for its start at the pose of the body.
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
            // Written so that NaN is too much.
            if deviation <= max_deviation {
                let [velocity, spin] = [velocity, motion.spin()].map(|rate| rate / length);
                return Ok(Some(ConstantStep {
                    from,
                    to: if share == 1.0 {
                        to
                    } else {
                        from + share * length
                    },
                    motion: Motion::about(start.motion.start(), velocity, spin, centre)?,
                    deviation,
                }));
            }
            share *= 0.5;
        }
        Ok(None)
    }
}
