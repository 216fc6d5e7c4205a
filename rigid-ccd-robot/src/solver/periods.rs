//! Finds periods of segments in which joints make many turns.
//!
//! In a segment at constant rates, let a joint turn by the angle `Δ`. After the fraction `p` of the segment, the joint
//! has its former angle again, except for `ε = |p Δ − 2π n|`, where `n` is the nearest integer. After `k` such periods
//! the difference is `k ε`. Apply this to all joints between two links. Relative to one link, a point of the other link
//! is then at most `Σ k ε ρ` away from its former position, where `ρ` is the largest distance of the point from a
//! joint's axis. This is the *drift*. Distances in later periods differ from distances in the first one by at most the
//! drift. So the search examines only one period of the pair and skips the rest of the segment.

use crate::cell::rounding::U;
use crate::kinematics::Kinematics;
use crate::path::joint_path::JointPath;
use crate::tuning::MAX_TURNS_IN_PERIOD;
use ccd_core::order::lesser;
use std::f64::consts::TAU;

/// The number of turns of a joint in a segment from which periods are searched.
const LEAST_TURNS: f64 = 2.0;

/// A period of the relative motion of two frames in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Period {
    /// The length as a fraction of the segment, rounded up.
    pub(crate) length: f64,
    /// An upper bound of the difference between the distances at the same phase of two periods.
    pub(crate) drift: f64,
}

/// The periods of all pairs of frames, for segments in which joints make many turns.
#[derive(Debug, Default)]
pub(crate) struct Periods {
    frame_count: usize,
    /// For each segment, the index of its first period; `None` for a segment without periods. Empty if no segment has
    /// periods.
    first_by_segment: Vec<Option<usize>>,
    /// For each such segment and each pair of frames, their period if there is one.
    periods: Vec<Option<Period>>,
}

/// Inputs of the drift of a period, and its limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DriftLimit {
    /// An upper bound of the distance of any point from any joint axis.
    pub(crate) largest_arm: f64,
    /// The rounding error of points. Each of two phases has one.
    pub(crate) rounding: f64,
    /// The largest acceptable drift.
    pub(crate) max_drift: f64,
}

impl Periods {
    /// Finds the periods of a path, and replaces the previous ones.
    pub(crate) fn set_path(
        &mut self,
        kinematics: &Kinematics,
        path: &JointPath,
        limit: impl Fn() -> DriftLimit,
    ) {
        self.first_by_segment.clear();
        self.periods.clear();
        self.frame_count = kinematics.joints().len() + 1;
        if !path.has_constant_rates() {
            return;
        }
        for segment in 0..path.segment_count() {
            let (_, changes) = path.starts_and_changes(segment);
            if !turns_often(kinematics, changes) {
                continue;
            }
            self.first_by_segment.resize(path.segment_count(), None);
            self.first_by_segment[segment] = Some(self.periods.len());
            let (limit, frames) = (limit(), 0..self.frame_count);
            for a in frames.clone() {
                let pairs = frames.clone().map(|b| [a, b]);
                self.periods
                    .extend(pairs.map(|pair| period(kinematics, changes, pair, limit)));
            }
        }
    }

    /// Returns whether no segment has a period.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.first_by_segment.is_empty()
    }

    /// Returns the period of two frames in a segment; `None` if there is none.
    pub(crate) fn period(&self, segment: usize, [a, b]: [usize; 2]) -> Option<Period> {
        let first = (*self.first_by_segment.get(segment)?)?;
        self.periods[first + a * self.frame_count + b]
    }
}

fn turns_often(kinematics: &Kinematics, changes: &[f64]) -> bool {
    let mut joints = kinematics.joints().iter().zip(changes);
    joints.any(|(joint, change)| !joint.is_prismatic && change.abs() >= LEAST_TURNS * TAU)
}

/// Returns the shortest period of two frames whose drift is within the limit, and that fits into the segment twice.
fn period(
    kinematics: &Kinematics,
    changes: &[f64],
    frames: [usize; 2],
    limit: DriftLimit,
) -> Option<Period> {
    let mut slowest = f64::INFINITY;
    for joint in kinematics.joints_between(frames) {
        let change = changes[joint].abs();
        if change == 0.0 {
            continue;
        }
        if kinematics.joints()[joint].is_prismatic {
            return None;
        }
        slowest = lesser(slowest, change);
    }
    let turns = 1..=MAX_TURNS_IN_PERIOD;
    let lengths = turns.map(|turns| f64::from(turns) * TAU / slowest);
    // Written so that NaN is not a length. Frames that do not move have a length of 0.
    let lengths = lengths.take_while(|&length| length > 0.0 && length <= 0.5);
    let with_drift = |length: f64| {
        let joints = kinematics.joints_between(frames);
        let drift: f64 = joints
            .map(|joint| phase_drift(length * changes[joint]))
            .sum();
        let count = length.recip().ceil();
        Period {
            length: length * (1.0 + 4.0 * f64::EPSILON),
            drift: count * drift * limit.largest_arm * (1.0 + 1e-12) + 4.0 * limit.rounding,
        }
    };
    let mut periods = lengths.map(with_drift);
    periods.find(|period| period.drift <= limit.max_drift)
}

/// Bounds the distance of an angle from a whole number of turns. The angle is the product of a change and a fraction;
/// the angle and the multiple of 2π have three rounding errors each.
fn phase_drift(angle: f64) -> f64 {
    (angle - TAU * (angle / TAU).round()).abs() + 8.0 * U * angle.abs()
}

#[cfg(test)]
mod tests;
