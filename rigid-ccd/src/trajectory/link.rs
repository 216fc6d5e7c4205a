//! The motion of a link of a serial chain whose joints move between two positions.

mod bounds;

use super::U;
use super::chain::Chain;
use super::checks::check_duration;
use super::joint::{Direction, Joint, JointKind};
use bounds::{JointPositionBounds, LinkBounds};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::vector::length;
use ccd_core::{
    Acceleration, AccelerationBounds, DeviationBound, InputError, Motion, Pose, SmoothTrajectory,
    Trajectory, check,
};

/// The trajectory of a link of a [`Chain`], in the world or in the frame of another link.
///
/// With rates `q̇` about axes `z` and arms `r` from joint to joint: `ω = Σ q̇ z`, and the link's origin moves at
/// `v = Σ ω × r`, summed over the joints below it. An axis turns with the links below it, `ż = ω × z`, so that
/// `|ω̇| ≤ Σ |q̇| |ω × z|`; an arm has the acceleration `ω̇ × r + ω × (ω × r)`, at most `(|ω̇| + |ω|²) |r|`. A joint
/// that slides by `s` along its axis is an arm of that length, which adds `2 |ω| |ṡ|`. As another link sees
/// it, only the joints in between count.
///
/// Axes that are parallel add no `ω̇`.
///
/// The acceleration of the link's origin is known at each time. It changes at most at `(|ω̈| + 3 |ω̇| |ω| + |ω|³) |r|`
/// for each arm, and by `3 |ṡ| (|ω̇| + |ω|²)` more for one that slides, with `|ω̈| ≤ Σ |q̇| (|ω̇| + |ω| |ω × z|)`.
///
/// If only one joint moves, and it turns, the link turns about its axis: the motion's center is there, and rests.
///
/// The rates hold at all times: before time 0 and after the duration the link moves on, without regard to limits.
#[derive(Clone, Copy, Debug)]
pub struct LinkTrajectory<'c> {
    chain: &'c Chain,
    /// The link in whose frame this link is seen; `None` for the world.
    reference_link: Option<usize>,
    link: usize,
    from: &'c [f64],
    end_positions: &'c [f64],
    duration: f64,
    /// For each joint a bound of its deviation from its constant rate; empty without deviations.
    joint_deviations: &'c [f64],
}

impl Chain {
    /// Returns the pose of a link for given positions of the joints.
    ///
    /// # Errors
    /// Those of [`Chain::link`].
    pub fn pose(&self, link: usize, positions: &[f64]) -> Result<Pose, InputError> {
        let rests = self.link(link, positions, positions, 1.0)?;
        Trajectory::pose(&rests, 0.0)
    }

    /// Returns the trajectory of a link while every joint moves from its position in `from` at time 0 to its position
    /// in `to` at the time `duration`.
    ///
    /// Both are positions, not rates: a joint's rate is `(to − from) / duration`, and constant. There is a position for
    /// each joint, fixed ones included.
    ///
    /// # Errors
    /// [`InputError::NoSuchLink`], [`InputError::JointCountMismatch`] for more or fewer positions than joints,
    /// [`InputError::OutOfRange`] for a duration that is not positive, [`InputError::JointOutOfLimits`] for a position
    /// outside of its joint's limits.
    pub fn link<'c>(
        &'c self,
        link: usize,
        from: &'c [f64],
        to: &'c [f64],
        duration: f64,
    ) -> Result<LinkTrajectory<'c>, InputError> {
        let joints = self.joints();
        if link > joints.len() {
            return Err(InputError::NoSuchLink {
                link,
                joint_count: joints.len(),
            });
        }
        for positions in [from, to] {
            if positions.len() != joints.len() {
                return Err(InputError::JointCountMismatch {
                    positions: positions.len(),
                    joints: joints.len(),
                });
            }
            for (k, (joint, &position)) in joints.iter().zip(positions).enumerate() {
                joint.check_position(position, Some(k))?;
            }
        }
        check_duration(duration)?;
        Ok(LinkTrajectory {
            chain: self,
            reference_link: None,
            link,
            from,
            end_positions: to,
            duration,
            joint_deviations: &[],
        })
    }
}

impl<'c> LinkTrajectory<'c> {
    /// Returns the trajectory in the frame of the link with the number `link`, which is this link or one nearer to the
    /// base. In a query, that link is then at rest ([`Motion::STILL`]), and the motion that both links share costs
    /// nothing.
    ///
    /// # Errors
    /// [`InputError::ReferenceLinkTooFar`] if the other link is farther from the base.
    pub fn seen_from(self, link: usize) -> Result<Self, InputError> {
        if link <= self.link {
            Ok(LinkTrajectory {
                reference_link: Some(link),
                ..self
            })
        } else {
            Err(InputError::ReferenceLinkTooFar {
                from: link,
                link: self.link,
            })
        }
    }

    /// Lets each joint deviate from its position at a constant rate, at any time, by at most so much: a number for each joint of
    /// the chain, in radians or as a length.
    ///
    /// Joints that follow a curve are near constant rates for a short time. A [`Trajectory`] of theirs has stretches of such
    /// links.
    ///
    /// # Errors
    /// [`InputError::JointCountMismatch`] for more or fewer numbers than joints, [`InputError::OutOfRange`] for one that is not
    /// finite and at least 0.
    pub fn with_joint_deviations(self, deviations: &'c [f64]) -> Result<Self, InputError> {
        let joints = self.chain.joints().len();
        if deviations.len() != joints {
            return Err(InputError::JointCountMismatch {
                positions: deviations.len(),
                joints,
            });
        }
        // Written so that NaN is refused.
        for &deviation in deviations {
            let is_bound = (0.0..f64::INFINITY).contains(&deviation);
            check(
                "deviation of a joint",
                deviation,
                is_bound,
                "finite and at least 0",
            )?;
        }
        Ok(LinkTrajectory {
            joint_deviations: deviations,
            ..self
        })
    }

    /// Bounds how far the link is from its pose at constant rates, for arms of at most this length together.
    ///
    /// The angles between the orientations of links add up. An arm turns by at most as much, and one that slides changes by
    /// its joint's deviation.
    fn bound_of_joint_deviations(&self, arm_length_sum: f64) -> DeviationBound {
        let (mut turn, mut slide) = (0.0, 0.0);
        let range = self.reference_link.unwrap_or(0)..self.link;
        let joints = range.zip(
            self.joint_deviations
                .iter()
                .skip(self.reference_link.unwrap_or(0)),
        );
        for (k, deviation) in joints {
            match self.chain.joints()[k].kind() {
                JointKind::Fixed => {}
                JointKind::Revolute(_) => turn += deviation,
                JointKind::Prismatic(_) => slide += deviation,
            }
        }
        // A few sums and products.
        let rounded_up = 1.0 + 1e-12;
        DeviationBound {
            center_deviation: (slide + turn * arm_length_sum) * rounded_up,
            max_deviation_angle: turn * rounded_up,
        }
    }

    /// Returns the joints from the link of the reference frame to this link, each with its position at a time and its
    /// rate.
    fn joints(&self, time: f64) -> impl Iterator<Item = (&'c Joint, f64, f64)> {
        let share = time / self.duration;
        let (from, to, duration) = (self.from, self.end_positions, self.duration);
        let range = self.reference_link.unwrap_or(0)..self.link;
        range.map(move |k| {
            let joint = &self.chain.joints()[k];
            let change = if joint.is_fixed() {
                0.0
            } else {
                to[k] - from[k]
            };
            (joint, from[k] + change * share, change / duration)
        })
    }

    /// Returns whether one joint moves this link in its frame, and it turns.
    fn turns_about_one_axis(&self) -> bool {
        let mut moving = self.joints(0.0).filter(|(_, _, rate)| *rate != 0.0);
        let (first, second) = (moving.next(), moving.next());
        second.is_none()
            && first.is_some_and(|(joint, ..)| matches!(joint.kind(), JointKind::Revolute(_)))
    }

    /// Returns the pose, the velocities and the accelerations of the link at a time.
    fn state(&self, time: f64) -> Result<LinkState, InputError> {
        let mut state = LinkState::state_at_rest(match self.reference_link {
            Some(_) => Pose::IDENTITY,
            None => self.chain.base(),
        });
        let turns_about_one_axis = self.turns_about_one_axis();
        for (joint, position, rate) in self.joints(time) {
            let before = state.pose;
            state.move_past_joint(joint, position, rate)?;
            if turns_about_one_axis && rate != 0.0 {
                state.pivot = Some(match joint.direction() {
                    Direction::Forward => before.transform_point(joint.origin().translation()),
                    Direction::Backward => before.translation(),
                });
            }
        }
        Ok(state)
    }

    /// Bounds the link's velocities and accelerations between two times.
    fn link_bounds(&self, from: f64, to: f64) -> LinkBounds {
        let mut moved = LinkBounds::default();
        let starts = self.joints(0.0);
        for ((joint, start, rate), (first, last)) in starts.zip(self.joint_positions(from, to)) {
            let largest = greater(first.abs(), last.abs());
            let positions = JointPositionBounds {
                max_abs_position: largest,
                max_abs_with_start: greater(largest, start.abs()),
                first_position: first,
                joint_speed: rate.abs(),
            };
            moved.move_past_joint(joint, &positions);
        }
        moved
    }

    /// Returns a pair of positions, at the times `from` and `to`, for each joint that moves this link in its frame.
    fn joint_positions(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let at = |time| self.joints(time).map(|(_, position, _)| position);
        at(from).zip(at(to))
    }
}

impl SmoothTrajectory for LinkTrajectory<'_> {
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
        self.state(time)?.to_motion()
    }

    fn acceleration_bounds(&self, from: f64, to: f64) -> AccelerationBounds {
        if self.turns_about_one_axis() {
            return AccelerationBounds::default();
        }
        self.link_bounds(from, to).acceleration_bounds
    }

    fn osculating_motion(
        &self,
        time: f64,
        from: f64,
        to: f64,
    ) -> Result<(Motion, Option<Acceleration>), InputError> {
        let state = self.state(time)?;
        if state.pivot.is_some() {
            return Ok((state.to_motion()?, None));
        }
        let acceleration = Acceleration {
            acceleration_vector: state.acceleration,
            jerk_bound: self.link_bounds(from, to).jerk_bounds.linear_acceleration,
        };
        Ok((state.to_motion()?, Some(acceleration)))
    }

    /// Bounds the rounding errors of the link's poses: each joint adds the error of a product of two poses and the
    /// error of its angle.
    fn rounding(&self, from: f64, to: f64) -> DeviationBound {
        let LinkBounds {
            joint_count: joints,
            arm_length_sum: arms,
            max_angle_sum: angles,
            ..
        } = self.link_bounds(from, to);
        let base = length(self.chain.base().translation());
        // A center on an axis is rounded as well.
        let center = if self.turns_about_one_axis() {
            1.0
        } else {
            0.0
        };
        let turn = U * (24.0 * (joints + center) + 4.0 * angles);
        let rounding = DeviationBound {
            center_deviation: turn * arms + 8.0 * U * (base + arms),
            max_deviation_angle: turn,
        };
        rounding + self.bound_of_joint_deviations(arms)
    }
}

/// The pose, the velocities and the accelerations of a link at one time, accumulated joint by joint.
struct LinkState {
    pose: Pose,
    velocity: DVec3,
    spin: DVec3,
    acceleration: DVec3,
    /// The angular acceleration `ω̇` of the link, in radians per unit of time squared.
    angular_acceleration: DVec3,
    /// A point on the axis of the only joint that moves, if it turns.
    pivot: Option<DVec3>,
}

impl LinkState {
    /// Creates the state of a link at a pose, with zero velocities and accelerations.
    fn state_at_rest(pose: Pose) -> Self {
        LinkState {
            pose,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
            acceleration: DVec3::ZERO,
            angular_acceleration: DVec3::ZERO,
            pivot: None,
        }
    }

    fn to_motion(&self) -> Result<Motion, InputError> {
        let Some(pivot) = self.pivot else {
            return Motion::new(self.pose, self.velocity, self.spin);
        };
        let center = self.pose.rotation().conjugate() * (pivot - self.pose.translation());
        Motion::about(self.pose, DVec3::ZERO, self.spin, center)
    }

    /// Updates the state from the link before a joint to the link after it.
    fn move_past_joint(
        &mut self,
        joint: &Joint,
        position: f64,
        rate: f64,
    ) -> Result<(), InputError> {
        let before = self.pose;
        self.pose = before.compose(&joint.unchecked_pose(position)?);
        let arm = self.pose.translation() - before.translation();
        // The arm moves with the link before its freedom, or with the link after it.
        match joint.direction() {
            Direction::Forward => {
                self.add_arm_motion(arm);
                let held = before.compose(joint.origin());
                self.add_joint_motion(joint.kind(), held.rotation(), rate);
            }
            Direction::Backward => {
                self.add_joint_motion(joint.kind(), before.rotation(), -rate);
                self.add_arm_motion(arm);
            }
        }
        Ok(())
    }

    /// Adds the velocity and the acceleration due to the rotation of `arm`, a vector fixed to the link.
    fn add_arm_motion(&mut self, arm: DVec3) {
        let turning = self.spin.cross(arm);
        self.velocity += turning;
        self.acceleration += self.angular_acceleration.cross(arm) + self.spin.cross(turning);
    }

    /// Adds the motion of a joint about or along its axis; `held` rotates the axis into the frame of the state.
    fn add_joint_motion(&mut self, kind: JointKind, held: DQuat, rate: f64) {
        match kind {
            JointKind::Fixed => {}
            JointKind::Revolute(axis) => {
                let turn = held * axis * rate;
                self.angular_acceleration += self.spin.cross(turn);
                self.spin += turn;
            }
            JointKind::Prismatic(axis) => {
                let slide = held * axis * rate;
                self.acceleration += 2.0 * self.spin.cross(slide);
                self.velocity += slide;
            }
        }
    }
}
