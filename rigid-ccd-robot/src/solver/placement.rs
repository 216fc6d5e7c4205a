//! A stretch of a path as the search sees it: the frames of all links in its middle, and how far parts move from there.

use super::displacement::Displacements;
use super::rounding::point_error;
use super::stretch::Stretch;
use super::waypoints::Waypoints;
use crate::cell::Cell;
use rigid_ccd::oracle::Frame;

/// The frames of all links in the middle of a stretch, and bounds of how far parts move within it.
pub(crate) struct Placement {
    pub(crate) frames: Vec<Frame>,
    pub(crate) displacements: Displacements,
    /// The largest error of a point that is computed with the frames.
    pub(crate) rounding: f64,
    positions: Vec<f64>,
    deviations: Vec<f64>,
}

impl Placement {
    pub(crate) fn new(cell: &Cell) -> Self {
        Placement {
            frames: Vec::new(),
            displacements: Displacements::new(cell.kinematics(), cell.parts()),
            rounding: 0.0,
            positions: Vec::new(),
            deviations: Vec::new(),
        }
    }

    /// Prepares for the stretches of a path.
    pub(crate) fn begin(&mut self, cell: &Cell, path: &Waypoints) {
        self.rounding = point_error(cell.kinematics(), cell.parts(), path.largest());
    }

    /// Computes the frames in the middle of a stretch, and the bounds of displacements.
    #[inline(always)]
    pub(crate) fn place(&mut self, cell: &Cell, path: &Waypoints, stretch: &Stretch) {
        self.place_frames(cell, path, stretch.middle());
        path.deviations(stretch, &self.positions, &mut self.deviations);
        self.displacements.update(
            cell.kinematics(),
            &cell.parts()[..cell.robot_part_count()],
            &self.frames,
            &self.deviations,
            self.rounding,
        );
    }

    /// Computes the frames at a point of the path.
    #[inline(always)]
    pub(crate) fn place_frames(&mut self, cell: &Cell, path: &Waypoints, at: f64) {
        path.interpolate(at, &mut self.positions);
        let positions = self.positions.iter().copied();
        cell.kinematics().place(positions, &mut self.frames);
    }
}
