//! The motion in eight intervals: positions and rates of all joints, bounds of accelerations, and errors.
//!
//! In an interval within a segment, the path itself is followed. In an interval of several segments it is followed by its
//! chord, a motion at constant rates from the first configuration to the last. A bound of how far each joint deviates
//! from the chord is added to displacements.

use super::BallTest;
use super::error::{ENLARGED, ErrorSources, LaneErrors};
use super::sine::MAX_ANGLE;
use crate::kinematics::MovingJoint;
use crate::kinematics::joint_arms::JointMotion;
use crate::path::joint_path::JointPath;
use crate::path::lanes::{LANES, Lanes};
use crate::tuning::{MAX_BALL_TEST_ERROR, MIN_BALL_TEST_RADIUS};
use ccd_core::order::greater;
use std::f64::consts::TAU;

/// The rounding error of a deviation from a chord, in units of roundoff of the largest position.
const CHORD_ERROR: f64 = 16.0;

impl BallTest<'_> {
    /// Sets the path. `longest_arm` bounds the distance of any point of a moving part from the base and from any joint
    /// axis, `pose_rounding` the error of poses in f64.
    pub(crate) fn set_path(&mut self, longest_arm: f64, pose_rounding: f64) {
        self.segment = None;
        self.longest_arm = greater(longest_arm, self.balls.static_reach);
        self.pose_rounding = pose_rounding;
    }

    /// Sets eight intervals. Returns whether the test can be used for them: not if a joint turns very often, and not if
    /// rounding errors in f32 are large.
    #[inline(always)]
    pub(super) fn set_intervals(&mut self, path: &JointPath, lanes: &Lanes) -> bool {
        match lanes.only_segment() {
            Some(segment) if self.segment == Some(segment) || self.set_segment(path, segment) => {
                self.set_parts_of_segment(path, segment, lanes);
                true
            }
            Some(_) => false,
            None => self.set_chords(path, lanes),
        }
    }

    fn set_segment(&mut self, path: &JointPath, segment: usize) -> bool {
        let joints = 0..self.joints.len();
        self.motions.clear();
        self.motions
            .extend(joints.map(|joint| path.joint_motion(segment, joint)));
        self.deviations.clear();
        self.deviations.resize(self.joints.len(), 0.0);
        self.exact_lanes = u8::MAX;
        if path.has_constant_rates() {
            let (_, changes) = path.starts_and_changes(segment);
            for (rates, &change) in self.rates.iter_mut().zip(changes) {
                *rates = [change as f32; LANES];
            }
        }
        let is_usable = self.set_bounds();
        self.segment = is_usable.then_some(segment);
        is_usable
    }

    /// Computes what follows from the motions and deviations of all joints. Returns whether the test can be used.
    fn set_bounds(&mut self) -> bool {
        let kinematics = self.cell.kinematics();
        let motions = &self.motions;
        self.errors = LaneErrors::new(
            kinematics,
            &ErrorSources {
                longest_arm: self.longest_arm,
                pose_rounding: self.pose_rounding,
                motions,
            },
        );
        let mut joints = kinematics.joints().iter().zip(motions);
        let is_slow =
            joints.all(|(joint, motion)| joint.is_prismatic || motion.rate < MAX_ANGLE - TAU);
        let largest_radius = self.balls.largest_radius;
        // Written so that NaN is refused.
        let is_accurate = self.errors.position < MAX_BALL_TEST_ERROR * largest_radius
            && largest_radius > MIN_BALL_TEST_RADIUS;
        if !(is_slow && is_accurate) {
            return false;
        }
        let (reach, position_error) = (self.longest_arm, self.errors.position);
        let errors = self.obstacles.all.iter().map(|obstacle| {
            let error = obstacle.error(reach);
            [error, obstacle.touching_error(error + position_error)]
        });
        self.obstacle_errors.clear();
        self.obstacle_errors.extend(errors);
        let deviations = &self.deviations;
        let strays = deviations.iter().any(|&deviation| deviation > 0.0);
        let bounds = self.arms[..self.tested_arms].iter().map(|arms| {
            let acceleration = arms.acceleration_bound(|joint| motions[joint]);
            let displacement = if strays {
                arms.displacement_bound(deviations, motions)
            } else {
                0.0
            };
            [acceleration, displacement]
        });
        self.motion_bounds.clear();
        self.motion_bounds.extend(bounds);
        true
    }

    /// Computes the positions of all joints at the midpoints of intervals of equal length.
    #[inline(always)]
    fn set_parts_of_segment(&mut self, path: &JointPath, segment: usize, lanes: &Lanes) {
        let [from, to] = [0, LANES].map(|lane| lanes.boundary(lane) - segment as f64);
        // The ends of an interval are rounded: by a few units of the segment's number.
        let rounding = 4.0 * f64::EPSILON * (1 + segment) as f64;
        self.half_length = (to - from) / (2 * LANES) as f64 * ENLARGED + rounding;
        let (middle, step) = (0.5 * (from + to), (to - from) / (2 * LANES) as f64);
        let offset = |lane: usize| step * ((2 * lane) as f64 - (LANES - 1) as f64);
        if !path.has_constant_rates() {
            return self.set_parts_of_curve(path, segment, |lane| middle + offset(lane));
        }
        let (starts, changes) = path.starts_and_changes(segment);
        for (k, joint) in self.cell.kinematics().joints().iter().enumerate() {
            let center = near_zero(joint, starts[k] + middle * changes[k]);
            for (lane, position) in self.positions[k].iter_mut().enumerate() {
                *position = (center + changes[k] * offset(lane)) as f32;
            }
        }
    }

    /// Computes the positions and rates of all joints at the midpoints of eight intervals of a curve.
    #[inline(never)]
    fn set_parts_of_curve(
        &mut self,
        path: &JointPath,
        segment: usize,
        midpoint: impl Fn(usize) -> f64,
    ) {
        for (k, joint) in self.cell.kinematics().joints().iter().enumerate() {
            for lane in 0..LANES {
                let [position, rate] = path.position_and_rate(segment, midpoint(lane), k);
                self.positions[k][lane] = near_zero(joint, position) as f32;
                self.rates[k][lane] = rate as f32;
            }
        }
    }

    /// Computes the chords of intervals in several segments at constant rates. Rates are per interval.
    #[inline(never)]
    fn set_chords(&mut self, path: &JointPath, lanes: &Lanes) -> bool {
        self.segment = None;
        self.half_length = 0.5 * ENLARGED;
        for boundary in 0..=LANES {
            path.interpolate(lanes.boundary(boundary), &mut self.configuration);
            for (ends, &position) in self.ends.iter_mut().zip(&self.configuration) {
                ends[boundary] = position;
            }
        }
        self.motions.clear();
        let joints = self.cell.kinematics().joints().iter();
        for (k, (joint, magnitude)) in joints.zip(path.magnitudes()).enumerate() {
            let mut largest_rate = 0.0;
            for (lane, ends) in self.ends[k].windows(2).enumerate() {
                let (middle, rate) = (0.5 * (ends[0] + ends[1]), ends[1] - ends[0]);
                self.positions[k][lane] = near_zero(joint, middle) as f32;
                self.rates[k][lane] = rate as f32;
                largest_rate = greater(largest_rate, rate.abs());
            }
            self.motions.push(JointMotion {
                position: magnitude.position,
                rate: largest_rate,
                acceleration: 0.0,
            });
        }
        self.set_deviations(path, lanes);
        self.set_bounds()
    }

    /// Bounds how far each joint deviates from the chords. Between two configurations both move at constant rates, so
    /// the largest deviation is at a configuration. A curve may jump a little between two segments.
    fn set_deviations(&mut self, path: &JointPath, lanes: &Lanes) {
        let rounding = |motion: &JointMotion| CHORD_ERROR * f64::EPSILON * motion.position;
        self.deviations.clear();
        self.deviations.extend(self.motions.iter().map(rounding));
        self.exact_lanes = 0;
        for lane in 0..LANES {
            let [from, to] = lanes.ends(lane);
            self.exact_lanes |= u8::from(lanes.segment(lane).is_some()) << lane;
            let mut waypoint = from.floor() + 1.0;
            while waypoint <= to {
                let fraction = (waypoint - from) / (to - from);
                let (starts, changes) = path.starts_and_changes(waypoint as usize - 1);
                let next = (waypoint < to).then(|| path.starts_and_changes(waypoint as usize).0);
                for (k, ends) in self.ends.iter().enumerate() {
                    let chord = ends[lane] + fraction * (ends[lane + 1] - ends[lane]);
                    let mut deviation = (starts[k] + changes[k] - chord).abs();
                    match next {
                        Some(next) => deviation = greater(deviation, (next[k] - chord).abs()),
                        // The interval ends with a jump, so that its chord is not a part of the path.
                        None if !(deviation <= rounding(&self.motions[k])) => {
                            self.exact_lanes &= !(1 << lane);
                        }
                        None => {}
                    }
                    self.deviations[k] = greater(self.deviations[k], deviation);
                }
                waypoint += 1.0;
            }
        }
    }
}

/// Returns the position of a joint, reduced by whole turns if it is an angle.
#[inline(always)]
fn near_zero(joint: &MovingJoint, position: f64) -> f64 {
    if joint.is_prismatic {
        position
    } else {
        position - TAU * (position / TAU).round()
    }
}
