//! Divides a path into ranges where all clearances are kept, ranges where one is violated, and unverified ranges.

use super::{CellSolver, Goal};
use crate::error::PathError;
use crate::path::Path;
use crate::path::interval::PathInterval;
use crate::path_point::PathPoint;
use rigid_ccd::Error;
use rigid_ccd::answer::ClearanceVerdict;

/// A range of a path, and whether all pairs keep their clearances in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearanceRange {
    /// The start of the range.
    pub from: PathPoint,
    /// The end of the range, where the next range starts.
    pub to: PathPoint,
    /// Kept if all pairs keep their clearances at every point of the range. Violated if some pair is too near at every
    /// point of the range. Unverified if neither is proven.
    pub verdict: ClearanceVerdict,
}

/// The resolution of clearance ranges, and how accurately the robot follows the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeSettings {
    /// The shortest length of a range that is examined, in segments of the path. At least 1e-9. A shorter range
    /// without a proof is unverified.
    pub resolution: f64,
    /// An upper bound of the distance from a point of a link to its position on the path: 0 if the robot follows the path
    /// exactly. If the loops of a mechanism are closed only at the configurations of the path, it is the largest error
    /// of the interpolation between them.
    pub max_pose_error: f64,
}

impl RangeSettings {
    /// A resolution of 1/4096 of a segment, and no pose error.
    pub const DEFAULT: Self = RangeSettings {
        resolution: 1.0 / 4096.0,
        max_pose_error: 0.0,
    };

    // Written so that NaN is refused.
    fn check(&self) -> Result<(), PathError> {
        let error = |name, value, allowed| {
            Err(PathError::InvalidRangeSetting {
                name,
                value,
                allowed,
            })
        };
        if !(self.resolution >= 1e-9) {
            return error("resolution", self.resolution, "at least 1e-9");
        }
        if !(self.max_pose_error >= 0.0 && self.max_pose_error.is_finite()) {
            return error("pose error", self.max_pose_error, "finite and at least 0");
        }
        Ok(())
    }
}

impl CellSolver<'_> {
    /// Divides a path into ranges where all pairs keep their clearances, ranges where a pair violates its clearance, and
    /// unverified ranges. A pair without a clearance has to keep the margin of the settings plus paddings.
    ///
    /// # Guarantee
    /// In a *kept* range all checked pairs stay farther apart than their clearances. At each configuration of a
    /// *violated* range some pair is nearer than its clearance, or overlaps if the clearance is 0. The following stays
    /// *unverified*:
    ///
    /// - about twice the resolution around each border between ranges,
    /// - intervals where the clearance is kept or violated by less than the tolerance or the pose error,
    /// - violations by less than the [excess](rigid_ccd::Body::excess) of the bodies,
    /// - overlaps of non-convex bodies, if the clearance is 0,
    /// - the rest of the path, once the deadline has passed or all searches together have used 8 budgets for each
    ///   segment.
    ///
    /// # Complexity
    /// A few searches for each halving around a border. Unverified intervals are examined in steps of the resolution.
    /// A search takes microseconds to milliseconds.
    ///
    /// # Errors
    /// [`PathError`].
    ///
    /// ```
    /// use rigid_ccd::{Body, Pose, Settings, answer::ClearanceVerdict, trajectory};
    /// use rigid_ccd_robot::{Cell, Joint, Link, LinkPairs, PositionRule, RangeSettings, Robot};
    ///
    /// let slider = Joint {
    ///     name: "slider".into(),
    ///     parent: "rail".into(),
    ///     child: "ball".into(),
    ///     geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0])?,
    ///     position_rule: PositionRule::Independent,
    /// };
    /// let ball = Link::named("ball").with_body(Body::sphere(0.5)?, Pose::IDENTITY);
    /// let robot = Robot::new(vec![Link::named("rail"), ball], vec![slider])?;
    /// let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
    /// cell.add_obstacle("wall", Body::cuboid([0.5, 2.0, 2.0])?, Pose::at([3.0, 0.0, 0.0])?)?;
    ///
    /// let settings = Settings { margin: 1.0, ..Settings::DEFAULT };
    /// let mut solver = cell.solver().with_settings(settings);
    /// // The distance is 2 - x.
    /// let ranges = solver.clearance_ranges(&[[0.0], [2.0]], RangeSettings::DEFAULT)?;
    /// let [kept, unverified, violated] = ranges[..] else { panic!("{ranges:?}") };
    /// assert_eq!(kept.verdict, ClearanceVerdict::Kept);
    /// assert_eq!(violated.verdict, ClearanceVerdict::Violated);
    /// assert!(kept.to.fraction <= 0.5 && violated.from.fraction >= 0.5);
    /// assert!(violated.from.fraction - kept.to.fraction < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn clearance_ranges<P: Path + ?Sized>(
        &mut self,
        path: &P,
        ranges: RangeSettings,
    ) -> Result<Vec<ClearanceRange>, PathError> {
        ranges.check()?;
        // Both bodies of a pair may deviate.
        self.search
            .pairs
            .set_margin_increase(2.0 * ranges.max_pose_error);
        let found = self.find_ranges(path, ranges.resolution);
        self.search.pairs.set_margin_increase(0.0);
        found
    }

    fn find_ranges<P: Path + ?Sized>(
        &mut self,
        path: &P,
        resolution: f64,
    ) -> Result<Vec<ClearanceRange>, PathError> {
        self.set_path_reporting_start(path)?;
        let (whole, mut found) = (self.search.whole_path_interval(), Vec::new());
        self.search.stop_condition.begin_searches(&whole);
        self.examine(whole, resolution, &mut found)?;
        let segments = self.search.segment_count();
        let ranges = found.iter().map(|(from, to, clearance)| ClearanceRange {
            from: PathPoint::from_path_position(*from, segments),
            to: PathPoint::from_path_position(*to, segments),
            verdict: *clearance,
        });
        Ok(ranges.collect())
    }

    /// Appends the ranges of an interval to `found`.
    fn examine(
        &mut self,
        interval: PathInterval,
        resolution: f64,
        found: &mut Vec<(f64, f64, ClearanceVerdict)>,
    ) -> Result<(), Error> {
        let goes_on = !self.search.stop_condition.is_question_over();
        let clearance = if goes_on && self.is_clearance_kept(interval)? {
            ClearanceVerdict::Kept
        } else if goes_on && self.search.is_margin_violated(&interval)? {
            ClearanceVerdict::Violated
        } else if goes_on
            && interval.to - interval.from > resolution
            && (interval.from < interval.middle() && interval.middle() < interval.to)
            && self.search.placement.moves()
        {
            for half in interval.halves() {
                self.examine(half, resolution, found)?;
            }
            return Ok(());
        } else {
            ClearanceVerdict::Unverified
        };
        match found.last_mut() {
            Some((_, to, last)) if *last == clearance => *to = interval.to,
            _ => found.push((interval.from, interval.to, clearance)),
        }
        Ok(())
    }

    fn is_clearance_kept(&mut self, interval: PathInterval) -> Result<bool, Error> {
        self.search.answer_question(Goal::AnyContact, interval)?;
        let result = &self.search.result;
        Ok(result.nearest.is_none() && result.limit_reached.is_none())
    }
}

#[cfg(test)]
mod tests;
