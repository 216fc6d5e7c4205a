//! The link frames at the midpoint of an interval, and bounds of how far parts move within it.

use super::displacement::DisplacementBounds;
use crate::cell::Cell;
use crate::cell::rounding::{CoordinateBounds, pose_rounding};
use crate::path::interval::PathInterval;
use crate::path::joint_path::JointPath;
use rigid_ccd::glam::DQuat;
use rigid_ccd::oracle::Frame;
use rigid_ccd::{Body, Error, Pose};

/// The frames of all links at the midpoint of the current interval, and displacement bounds of all parts within it.
pub(crate) struct Placement {
    pub(crate) frames: Vec<Frame>,
    pub(crate) displacement_bounds: DisplacementBounds,
    /// An upper bound of the error of a point that is computed with the frames.
    pub(crate) rounding: f64,
    /// An upper bound of the error of a unit vector that is computed with the frames.
    pub(crate) rounding_of_directions: f64,
    /// Bounds of the coordinates of all parts.
    pub(crate) coordinates: CoordinateBounds,
    positions: Vec<f64>,
    max_deviation_by_joint: Vec<f64>,
}

impl Placement {
    pub(crate) fn new(cell: &Cell) -> Self {
        Placement {
            frames: Vec::new(),
            displacement_bounds: DisplacementBounds::new(cell.kinematics(), cell.parts()),
            rounding: 0.0,
            rounding_of_directions: 0.0,
            coordinates: CoordinateBounds::of_parts(cell.parts()),
            positions: Vec::new(),
            max_deviation_by_joint: Vec::new(),
        }
    }

    /// Sets the path. Must be called before its intervals are placed.
    pub(crate) fn begin(&mut self, cell: &Cell, path: &JointPath) {
        let rounding = pose_rounding(cell.kinematics(), self.coordinates, path.magnitudes());
        self.rounding = rounding.of_points;
        self.rounding_of_directions = rounding.of_directions;
    }

    /// Computes the frames at the midpoint of an interval, and the displacement bounds.
    #[inline(always)]
    pub(crate) fn place(&mut self, cell: &Cell, path: &JointPath, interval: &PathInterval) {
        self.place_frames(cell, path, interval.middle());
        path.max_joint_deviations_from_middle(
            interval,
            &self.positions,
            &mut self.max_deviation_by_joint,
        );
        self.update_displacements(cell);
    }

    /// Returns whether any joint moves in the current interval.
    pub(crate) fn moves(&self) -> bool {
        self.max_deviation_by_joint
            .iter()
            .any(|&deviation| deviation != 0.0)
    }

    /// Computes the frames after some joints at a configuration, relative to the frame `seen_from`. Computes no
    /// displacement bounds.
    pub(crate) fn place_joints(
        &mut self,
        cell: &Cell,
        (seen_from, joints): (usize, &[usize]),
        configuration: &[f64],
    ) {
        let kinematics = cell.kinematics();
        kinematics.place_joints((seen_from, joints), configuration, &mut self.frames);
    }

    #[inline(always)]
    fn update_displacements(&mut self, cell: &Cell) {
        self.displacement_bounds.update(
            cell.kinematics(),
            &cell.parts()[..cell.robot_part_count()],
            &self.frames,
            &self.max_deviation_by_joint,
            self.rounding,
        );
    }

    /// Computes the frames at a point of the path.
    #[inline(always)]
    pub(crate) fn place_frames(&mut self, cell: &Cell, path: &JointPath, at: f64) {
        path.interpolate(at, &mut self.positions);
        let positions = self.positions.iter().copied();
        cell.kinematics().place(positions, &mut self.frames);
    }

    /// Returns a body with its pose in the base. The rotation of its frame is rounded to a unit quaternion.
    pub(crate) fn body<'c>(&self, cell: &'c Cell, index: usize) -> Result<(&'c Body, Pose), Error> {
        let placed = &cell.bodies()[index];
        let frame = &self.frames[placed.frame];
        let rotation = DQuat::from_mat3(&frame.rotation).normalize();
        let pose = Pose::new(frame.translation, rotation)?;
        Ok((&placed.body, pose.compose(&placed.pose)))
    }
}
