//! A trajectory through given poses at given times.

mod segment;

pub(crate) use segment::{MAX_RESIDUAL_ROTATION, residual_rotation};

use super::U;
use super::checks::{check_finite_vector, check_time_is_later};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::vector::length;
use ccd_core::{DeviationBound, InputError, Motion, Pose, Stretch, Trajectory, check};
use segment::Segment;

/// A path through poses at given times, for example from a planner or a simulator's log.
///
/// From one pose to the next, a point of the body moves straight, and the body turns about it the shortest way,
/// both at constant rates ([`Motion::between`]); or by any number of turns, at about a [given](PosePath::with_angular_velocities) angular
/// velocity. The body rests before the first time and after the last.
///
/// A stretch between two poses is exact, up to rounding. A longer one is a single motion from its first to its
/// last pose. The center is farthest from it at a pose in between. Between two poses the orientation strays at
/// most as far as both ends do, and by half the angle of the difference of both turns.
///
/// ```
/// use rigid_ccd::trajectory::{PosePath, Trajectory};
/// use rigid_ccd::Pose;
/// let stops = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
/// let timed = stops.iter().zip([0.0, 1.0, 3.0]);
/// let poses = timed.map(|(&at, time)| Ok((time, Pose::at(at)?)));
/// let path = PosePath::new(poses.collect::<Result<_, rigid_ccd::InputError>>()?)?;
/// assert_eq!(path.pose(2.0)?.translation().y, 0.5);
/// assert_eq!(path.velocity_jump_time(0.0, 3.0), Some(1.0));
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PosePath {
    poses: Vec<(f64, Pose)>,
    /// The given angular velocity from each pose to the next; empty if every rotation is the shortest one.
    spins: Vec<DVec3>,
    center: DVec3,
}

impl PosePath {
    /// Creates a path through poses at increasing times. The body's origin moves straight.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for no pose, and for times that do not increase.
    pub fn new(poses: Vec<(f64, Pose)>) -> Result<Self, InputError> {
        check("number of poses", 0.0, !poses.is_empty(), "at least 1")?;
        let mut before = None;
        for &(time, _) in &poses {
            check_time_is_later("time of a pose", time, before.replace(time))?;
        }
        Ok(PosePath {
            poses,
            spins: Vec::new(),
            center: DVec3::ZERO,
        })
    }

    /// Sets the point of the body, in the body's frame, that moves straight from each pose to the next.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn about(self, center: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        let center = check_finite_vector(center, "center")?;
        Ok(PosePath { center, ..self })
    }

    /// Sets an approximate angular velocity from each pose to the next, in the world, which determines the number of
    /// turns.
    ///
    /// The rotation that it leaves over to the next pose is added at a constant rate. Zero stands for the shortest
    /// rotation.
    ///
    /// # Errors
    /// [`InputError::NotFinite`]; [`InputError::OutOfRange`] for more or fewer than one for each pose but the last, and
    /// for one that leaves over more than a quarter turn.
    ///
    /// ```
    /// use rigid_ccd::Pose;
    /// use rigid_ccd::glam::DQuat;
    /// use rigid_ccd::trajectory::{PosePath, Trajectory};
    /// // Ten and a half turns, to where half a turn would lead as well.
    /// let turned = Pose::new([0.0; 3], [0.0, 0.0, 1.0, 0.0])?;
    /// let drill = PosePath::new(vec![(0.0, Pose::IDENTITY), (1.0, turned)])?;
    /// let drill = drill.with_angular_velocities(vec![[0.0, 0.0, 66.0]])?;
    /// let turns = 0.25 * 10.5;
    /// let quarter = DQuat::from_rotation_z(turns * std::f64::consts::TAU);
    /// assert!(drill.pose(0.25)?.rotation().angle_between(quarter) < 1e-7);
    /// # Ok::<(), rigid_ccd::InputError>(())
    /// ```
    pub fn with_angular_velocities(self, spins: Vec<[f64; 3]>) -> Result<Self, InputError> {
        check(
            "number of angular velocities",
            spins.len() as f64,
            spins.len() + 1 == self.poses.len(),
            "one for each pose but the last",
        )?;
        let spins: Vec<DVec3> = spins.into_iter().map(DVec3::from).collect();
        for (two, &spin) in self.poses.windows(2).zip(&spins) {
            let [(begin, from), (end, to)] = [two[0], two[1]];
            check_finite_vector(spin, "angular velocity")?;
            let left = length(residual_rotation([&from, &to], spin, end - begin));
            // Written so that NaN is refused.
            check(
                "angle from where an angular velocity leads to the next pose",
                left,
                spin == DVec3::ZERO || left <= MAX_RESIDUAL_ROTATION,
                "at most a quarter turn",
            )?;
        }
        Ok(PosePath { spins, ..self })
    }

    /// Returns the time of the last pose.
    pub fn end_time(&self) -> f64 {
        self.poses[self.poses.len() - 1].0
    }

    /// Returns the times of the poses, in order.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.poses.iter().map(|&(time, _)| time)
    }

    /// Returns the motion of the segment at a time, and a bound on the segment's angular acceleration. At a given pose,
    /// this is the segment before the pose if `to` is not later than `time`, else the one after it.
    fn segment_motion_at(&self, time: f64, to: f64) -> Result<(Motion, f64), InputError> {
        let next = if to > time {
            self.poses.partition_point(|&(at, _)| at <= time)
        } else {
            self.poses.partition_point(|&(at, _)| at < time)
        };
        match (next.checked_sub(1), self.poses.get(next)) {
            (Some(k), Some(&(end, pose))) => {
                let (begin, from) = self.poses[k];
                let segment = Segment::new([from, pose], self.center, end - begin, self.spin(k))?;
                Ok((
                    segment.motion_at(time - begin)?,
                    segment.angular_acceleration(),
                ))
            }
            // The body rests before the first pose and after the last.
            (_, first) => {
                let (_, pose) = first.unwrap_or(&self.poses[self.poses.len() - 1]);
                let rests = Motion::about(*pose, DVec3::ZERO, DVec3::ZERO, self.center)?;
                Ok((rests, 0.0))
            }
        }
    }

    /// Returns the point of the body that moves straight from each pose to the next.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Returns the given angular velocity from pose `k` to the next; zero stands for the shortest rotation.
    fn spin(&self, k: usize) -> DVec3 {
        self.spins.get(k).copied().unwrap_or_default()
    }

    /// Returns the approximate rotation vector from each pose to the next; zero for the last pose.
    ///
    /// # Errors
    /// [`InputError`]: a segment has no motion in range.
    pub fn rotation_vectors(&self) -> impl Iterator<Item = Result<DVec3, InputError>> {
        let ends = self.poses.windows(2).map(|two| [two[0], two[1]]);
        let turns = ends.enumerate().map(|(k, [(begin, from), (end, to)])| {
            let segment = Segment::new([from, to], self.center, end - begin, self.spin(k))?;
            Ok(segment.motion_at(0.0)?.angular_velocity() * (end - begin))
        });
        turns.chain([Ok(DVec3::ZERO)])
    }

    /// Returns the poses strictly between two times.
    fn poses_between(&self, from: f64, to: f64) -> &[(f64, Pose)] {
        let first = self.poses.partition_point(|&(at, _)| at <= from);
        let last = self.poses.partition_point(|&(at, _)| at < to);
        &self.poses[first..last.max(first)]
    }

    /// Returns one motion between the poses at two times, with a bound on the path's deviation from that motion.
    fn chord_motion(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let [begin, end] = [
            self.segment_motion_at(from, to)?.0.start(),
            self.segment_motion_at(to, to)?.0.start(),
        ];
        let motion = Motion::between(begin, end, self.center, to - from)?;
        let mut stray = DeviationBound::ZERO;
        // The rotation by which the chord deviates at a pose, and the time of that pose.
        let mut last = (from, DeviationBound::ZERO);
        for &(time, pose) in self.poses_between(from, to).iter().chain(&[(to, end)]) {
            let deviation = deviation(&motion, &pose, self.center, time - from);
            // The motion of the segment that ends at this pose.
            let (before, acceleration) = self.segment_motion_at(time, time)?;
            let since = time - last.0;
            let change = before
                .angular_velocity()
                .distance(motion.angular_velocity())
                + acceleration * since;
            let between =
                0.5 * (deviation.max_deviation_angle + last.1.max_deviation_angle + change * since);
            stray.center_deviation = greater(stray.center_deviation, deviation.center_deviation);
            stray.max_deviation_angle = greater(stray.max_deviation_angle, between);
            last = (time, deviation);
        }
        Ok(Stretch {
            deviation_bound: stray,
            ..Stretch::exact(motion)
        })
    }

    /// Bounds the rounding errors of poses between two times; each pose is computed from the last given pose before it.
    fn rounding(&self, from: f64, to: f64) -> DeviationBound {
        let first = self.poses.partition_point(|&(at, _)| at <= from);
        let last = self.poses.partition_point(|&(at, _)| at < to);
        let given = &self.poses[first.saturating_sub(1)..(last + 1).min(self.poses.len())];
        let lengths = given.iter().map(|(_, pose)| length(pose.translation()));
        // The displacement from one pose to the next is at most twice as long.
        let place = 3.0 * lengths.fold(0.0, greater) + 4.0 * length(self.center);
        let turn = |(k, two): (usize, &[(f64, Pose)])| {
            length(self.spin(first.saturating_sub(1) + k)) * (two[1].0 - two[0].0)
        };
        let turn = given.windows(2).enumerate().map(turn).fold(1.0, greater);
        DeviationBound {
            center_deviation: 64.0 * U * place,
            max_deviation_angle: 64.0 * U * turn,
        }
    }
}

impl Trajectory for PosePath {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let stretch = if self.poses_between(from, to).is_empty() {
            let (motion, acceleration) = self.segment_motion_at(from, to)?;
            let mut stretch = Stretch::exact(motion);
            // The integral of the deviation of the angular velocity is quadratic in time.
            if acceleration > 0.0 {
                stretch.deviation_bound.max_deviation_angle =
                    0.5 * acceleration * (to - from) * (to - from);
            }
            stretch
        } else {
            self.chord_motion(from, to)?
        };
        Ok(Stretch {
            deviation_bound: stretch.deviation_bound + self.rounding(from, to),
            ..stretch
        })
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let inner = self.poses_between(from, to);
        inner.get(inner.len() / 2).map(|&(time, _)| time)
    }
}

/// Returns the deviation of a motion from a pose at one time: the displacement of the center, and the angle in radians.
fn deviation(motion: &Motion, pose: &Pose, center: DVec3, time: f64) -> DeviationBound {
    let near = motion.pose(time);
    let [at, true_at] = [&near, pose].map(|pose| pose.transform_point(center));
    let turned: DQuat = near.rotation().conjugate() * pose.rotation();
    DeviationBound {
        center_deviation: at.distance(true_at),
        // The rotation angle is twice the angle of the quaternion, whose sine is the length of its vector part.
        max_deviation_angle: 2.0 * turned.xyz().length().atan2(turned.w.abs()),
    }
}
