//! Planes: half-spaces, each represented by a large box.
//!
//! A body above the plane has the same distance from the half-space as from a box below the plane, if the box is wide
//! and deep enough. The size of the box sets how far from the base moving bodies may get.

use super::Cell;
use super::part::PlacedBody;
use crate::cell::rounding::{CoordinateBounds, largest_arm};
use crate::error::{PathError, RobotError};
use crate::kinematics::magnitude::Magnitude;
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::order::{greater, lesser};
use ccd_core::{Body, Facet, FacetOrigin, Polytope};
use rigid_ccd::Pose;
use rigid_ccd::glam::DVec3;
use std::sync::Arc;

/// The reach of planes if prismatic joints have no limits, as a multiple of the length of the stretched arm. This is
/// also the smallest reach.
const FREE_TRAVEL: f64 = 1024.0;

impl Cell {
    /// Adds an obstacle that is a half-space: all points below the plane `z = 0` of a frame at `pose`, in the frame of
    /// the robot's base.
    ///
    /// A finite box represents the half-space. Answers are the same as for the infinite half-space: a path on which a
    /// moving body may get too far from the base is refused with [`PathError::BeyondPlane`]. With finite joint limits
    /// this never happens. If a prismatic joint has no limits, bodies may get at least as far as 1024 times the length
    /// of the stretched arm, and at least 1024.
    ///
    /// # Errors
    /// [`RobotError::NameTaken`], [`RobotError::TooFar`].
    ///
    /// ```
    /// use rigid_ccd::{Body, Pose, trajectory};
    /// use rigid_ccd_robot::{Cell, CompoundKind, Link, LinkPairs, PlacedRobot, Robot};
    ///
    /// let ball = Robot::new(vec![Link::named("ball").with_body(Body::sphere(0.1)?, Pose::IDENTITY)], vec![])?;
    /// let (flying, pairs) = Robot::combine(&[PlacedRobot {
    ///     name: "",
    ///     robot: &ball,
    ///     pairs: &LinkPairs::from_robot(&ball),
    ///     carrier: None,
    ///     pose: Pose::IDENTITY,
    ///     base_motion: Some(CompoundKind::Floating),
    /// }])?;
    /// let mut cell = Cell::new(flying, pairs);
    /// cell.add_plane("floor", Pose::IDENTITY)?;
    /// let high_above = [300.0, -200.0, 0.11, 0.0, 0.0, 0.0];
    /// assert!(cell.solver().is_free(&[high_above])?);
    /// let deep_below = [300.0, -200.0, -99.0, 0.0, 0.0, 0.0];
    /// assert!(!cell.solver().is_free(&[deep_below])?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_plane(&mut self, name: impl Into<String>, pose: Pose) -> Result<(), RobotError> {
        let name = name.into();
        self.check_new_name(&name)?;
        RobotError::check_pose("plane", &name, &pose)?;
        self.obstacle_names.push(name);
        let placed = PlacedBody::for_plane(pose, self.plane_reach());
        self.insert(self.bodies.len(), placed);
        Ok(())
    }

    /// Returns whether the body with this index in [`Cell::carried_bodies`] is the box of a plane.
    pub fn is_plane(&self, body: usize) -> bool {
        self.bodies[body].plane_reach.is_some()
    }

    /// Resizes the boxes of all planes to the current reach of the robot and its attached bodies.
    pub(super) fn fit_planes(&mut self) {
        let reach = self.plane_reach();
        for index in 0..self.bodies.len() {
            let placed = &self.bodies[index];
            if placed.plane_reach.is_some() {
                let placed = PlacedBody::for_plane(placed.pose, reach);
                self.replace(index, placed);
            }
        }
    }

    /// Checks that all moving bodies stay within the distance from the base for which the planes' boxes are valid.
    pub(crate) fn check_plane_reach(
        &self,
        magnitudes: impl Iterator<Item = Magnitude>,
    ) -> Result<(), PathError> {
        let planes = self.bodies.iter().filter_map(|placed| placed.plane_reach);
        let Some(reach) = planes.reduce(lesser) else {
            return Ok(());
        };
        let distance = self.max_reach(magnitudes);
        // Written so that NaN is refused.
        if distance <= reach {
            Ok(())
        } else {
            Err(PathError::BeyondPlane { distance, reach })
        }
    }

    /// Returns the distance from the base for which planes must be valid: twice the largest distance of a moving body.
    pub(super) fn plane_reach(&self) -> f64 {
        let limits = self.robot.limits();
        let largest_positions = limits.map(|[low, high]| greater(low.abs(), high.abs()));
        let largest_positions: Vec<f64> = largest_positions.collect();
        let reach_without_limits = FREE_TRAVEL * greater(1.0, self.max_reach(std::iter::empty()));
        let reach_within_limits = self.max_reach(self.kinematics.magnitudes(&largest_positions));
        lesser(2.0 * reach_within_limits, reach_without_limits)
    }

    /// Returns an upper bound of the distance from the base of any point of a moving body.
    fn max_reach(&self, magnitudes: impl Iterator<Item = Magnitude>) -> f64 {
        let coordinates = CoordinateBounds::of_parts(&self.parts);
        largest_arm(&self.kinematics, coordinates, magnitudes)
    }
}

impl PlacedBody {
    /// Creates the box for the half-space below the plane `z = 0` of a frame at `pose`. It is valid up to the distance
    /// `reach` from the base.
    pub(super) fn for_plane(pose: Pose, reach: f64) -> Self {
        let base = pose.inverse().transform_point(DVec3::ZERO);
        let max_reach = 0.125 * MAX_COORDINATE;
        // If the plane is too far away, its box does not reach the base, and all paths are refused.
        let center = base.clamp(
            DVec3::splat(-4.0 * max_reach),
            DVec3::splat(4.0 * max_reach),
        );
        let reach = lesser(reach, max_reach);
        // The factor of two leaves room for rounding.
        let half_width = 2.0 * reach;
        let depth = half_width + greater(0.0, -center.z);
        let mut placed = PlacedBody::new(
            Arc::new(box_below_plane(center, half_width, depth)),
            pose,
            0,
            1,
        );
        placed.plane_reach = Some(reach - center.distance(base));
        placed
    }
}

/// Returns a box directly below `z = 0`. Its top is a square around the projection of `center`.
fn box_below_plane(center: DVec3, half_width: f64, depth: f64) -> Body {
    // Bit 0, 1, 2 of `k` selects the upper end of x, y, z.
    let corner = |k: u32| {
        let sign = |bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let z = if k >> 2 & 1 == 1 { 0.0 } else { -depth };
        let offset = half_width * DVec3::new(sign(0), sign(1), 0.0);
        (center + offset).with_z(z)
    };
    let faces: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let facets = faces.iter().enumerate().map(|(id, corners)| Facet {
        origin: FacetOrigin::Face(id as u32),
        corners: corners.to_vec(),
    });
    let polytope = Polytope {
        points: (0..8).map(corner).collect(),
        facets: facets.collect(),
        ..Polytope::default()
    };
    Body::polytope(polytope).expect("the corners of a box are in range")
}

#[cfg(test)]
mod tests;
