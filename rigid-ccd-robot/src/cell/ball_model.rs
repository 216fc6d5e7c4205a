//! What the ball test of paths needs of a robot, whatever the obstacles: covers by balls, and tables of distances.

use super::Cell;
use super::cover::Covers;
use std::sync::Arc;

/// Covers and tables of a robot. A cell computes them once, and its solvers share them.
#[derive(Debug)]
pub(crate) struct BallModel {
    /// The covers of the robot's parts.
    pub(crate) covers: Covers,
    /// For each checked pair of the robot's own parts its table; `None` if there is no table.
    pub(crate) tables: Vec<Option<DistanceTable>>,
}

/// Lower bounds of the distance of two parts in a grid of joint angles.
#[derive(Clone)]
pub(crate) struct DistanceTable {
    /// One or two axes. The first one varies fastest.
    pub(crate) axes: Vec<TableAxis>,
    /// For each cell of the grid a lower bound of the distance of both parts in that cell.
    pub(crate) distances: Vec<f32>,
}

/// A joint, and the cells into which its angles are divided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TableAxis {
    pub(crate) joint: usize,
    /// The least angle of the first cell.
    pub(crate) low: f64,
    pub(crate) cell_size: f64,
    pub(crate) cell_count: usize,
    /// An upper bound of the displacement of either part, relative to the other, for each radian.
    pub(crate) arm_length: f64,
}

impl std::fmt::Debug for DistanceTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DistanceTable")
            .field("axes", &self.axes)
            .finish_non_exhaustive()
    }
}

impl TableAxis {
    /// Returns an upper bound of the distance of an angle in a cell from the cell's center.
    pub(crate) fn half_cell(&self) -> f64 {
        0.5 * self.cell_size * (1.0 + 1e-9)
    }

    pub(crate) fn center(&self, cell: usize) -> f64 {
        self.low + (cell as f64 + 0.5) * self.cell_size
    }
}

impl Cell {
    /// Returns the model of the robot. Computes it by `compute` if the robot's bodies or checked pairs have changed.
    pub(crate) fn ball_model(&self, compute: impl FnOnce() -> BallModel) -> &Arc<BallModel> {
        self.ball_model.get_or_init(|| Arc::new(compute()))
    }
}
