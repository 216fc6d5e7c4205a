//! Periods of straight segments in which joints turn many times.
//!
//! Between two configurations a joint turns at a constant rate `Δ`, by the share of the segment. After a share `p` it has its
//! former angle, but for `ε = |p Δ − 2π n|` with the nearest whole number of turns `n`; after `k` such shares, but for `k ε`. If
//! that is so for all joints between two links, no point of one link is displaced by more than `Σ k ε ρ`, as the other one sees
//! it, with `ρ` its largest distance from a joint's axis. What a pair keeps in one period, less this drift, it keeps in all of them.
//! One period of the pair is searched then, and the rest of the segment is left out.

use crate::cell::rounding::U;
use crate::kinematics::Kinematics;
use crate::path::joint_path::JointPath;
use crate::tuning::MAX_TURNS_IN_PERIOD;
use ccd_core::order::lesser;
use std::f64::consts::TAU;

/// The number of turns in a segment from which on its periods are computed.
const LEAST_TURNS: f64 = 2.0;

/// A period of a pair of frames in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Period {
    /// The length as a share of the segment, rounded up.
    pub(crate) length: f64,
    /// A bound of how much distances of one period differ from those at the same phase of another one.
    pub(crate) drift: f64,
}

/// The periods of all pairs of frames, in the segments of a path in which joints turn many times.
#[derive(Debug, Default)]
pub(crate) struct Periods {
    frame_count: usize,
    /// For each segment the index of its first period; `None` for a segment without periods. Empty for a path without periods.
    first_by_segment: Vec<Option<usize>>,
    /// For each pair of frames in such a segment its period, if it has one.
    periods: Vec<Option<Period>>,
}

/// What the drift of a period is made of, and how much of it is allowed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DriftLimit {
    /// A bound of the distance of any point from any joint's axis.
    pub(crate) largest_arm: f64,
    /// The error of positions, of which two phases have one each.
    pub(crate) rounding: f64,
    /// The largest drift of a period that is of use.
    pub(crate) max_drift: f64,
}

impl Periods {
    /// Replaces the periods by those of a path.
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
            let changes = path.changes(segment);
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

    /// Returns the period of two frames in a segment, if there is one.
    pub(crate) fn period(&self, segment: usize, [a, b]: [usize; 2]) -> Option<Period> {
        let first = (*self.first_by_segment.get(segment)?)?;
        self.periods[first + a * self.frame_count + b]
    }
}

fn turns_often(kinematics: &Kinematics, changes: &[f64]) -> bool {
    let mut joints = kinematics.joints().iter().zip(changes);
    joints.any(|(joint, change)| !joint.is_prismatic && change.abs() >= LEAST_TURNS * TAU)
}

/// Returns the shortest period of two frames that drifts by no more than the limit, and fits twice into the segment.
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
    // Written so that NaN is no period. Frames that do not move have the length 0.
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

/// Bounds how far an angle is from a whole number of turns. The angle is a product of a change and a share; it and the whole
/// number times 2π are rounded thrice each.
fn phase_drift(angle: f64) -> f64 {
    (angle - TAU * (angle / TAU).round()).abs() + 8.0 * U * angle.abs()
}

#[cfg(test)]
mod tests;
