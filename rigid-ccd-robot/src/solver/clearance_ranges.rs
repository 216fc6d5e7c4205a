//! The ranges of a path in which all pairs keep their distance, and those in which one of them certainly does not.

use super::{CellSolver, Goal};
use crate::error::PathError;
use crate::path::Path;
use crate::path::interval::PathInterval;
use crate::path_point::PathPoint;
use rigid_ccd::Error;
use rigid_ccd::answer::ClearanceVerdict;

/// A range of a path, and whether all pairs keep their distance in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearanceRange {
    /// The start of the range.
    pub from: PathPoint,
    /// The end of the range, where the next one starts.
    pub to: PathPoint,
    /// Whether all pairs keep their distance everywhere in the range, or one of them is nearer everywhere in the range, or
    /// neither is proven.
    pub verdict: ClearanceVerdict,
}

/// How finely a path is examined, and how far the robot may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeSettings {
    /// The length, in segments of the path, of the shortest ranges that are examined. What is not proven there is
    /// unverified. At least 1e-9.
    pub resolution: f64,
    /// A bound of how far points of links are from where the path places them. It is 0 for a robot that follows the path
    /// exactly. A closed loop of joints is a path of configurations in which the loop is closed; between these, points
    /// differ by the error of the interpolation.
    pub max_pose_error: f64,
}

impl RangeSettings {
    /// A resolution of 1/4096 of a segment, and no error of poses.
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
    /// Divides a path into ranges in which all pairs keep their distance, ranges in which one certainly does not, and the
    /// rest. The distance of a pair is its clearance, or the margin of the settings with paddings.
    ///
    /// # Guarantee
    /// In a range that is kept all pairs that are checked stay apart by more than their distance, at all configurations. At
    /// each configuration of a range that is violated some pair is nearer than its distance; at a distance of 0 it overlaps.
    /// Unverified remain about twice the resolution around each border, intervals where the distance is kept or violated by
    /// less than the tolerance or than the error of poses, violations by less than what bodies
    /// [exceed](rigid_ccd::Body::excess) their shapes by, and overlaps of bodies that are not convex at a distance of 0. When
    /// time runs out, or all work together has taken 8 budgets for each segment, the rest of the path is unverified.
    ///
    /// # Complexity
    /// A few searches for each halving around a border. What stays unverified is examined in steps of the resolution, each of
    /// which takes microseconds to milliseconds.
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
    ///     axis_and_limits: trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0])?,
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
    /// assert!(kept.to.share <= 0.5 && violated.from.share >= 0.5);
    /// assert!(violated.from.share - kept.to.share < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn clearance_ranges<P: Path + ?Sized>(
        &mut self,
        path: &P,
        ranges: RangeSettings,
    ) -> Result<Vec<ClearanceRange>, PathError> {
        ranges.check()?;
        // Both bodies of a pair may be away from where they are placed.
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

    /// Appends the ranges of an interval.
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
        let found = &self.search.result;
        Ok(found.nearest.is_none() && found.limit_reached.is_none())
    }
}

#[cfg(test)]
mod tests;
