//! Box tests against all obstacles, eight at once.

use crate::cell::part::HullPart;
use rigid_ccd::glam::DVec3;

/// The number of boxes in a block.
const LANES: usize = 8;

/// The axis-aligned bounding boxes of all obstacles, in a layout for vector instructions.
#[derive(Clone, Debug)]
pub(crate) struct ObstacleBoxes {
    blocks: Vec<Block>,
    count: usize,
}

/// Eight boxes as a structure of arrays. Unused lanes have empty boxes.
#[derive(Clone, Copy, Debug)]
struct Block {
    min: [[f64; LANES]; 3],
    max: [[f64; LANES]; 3],
}

impl ObstacleBoxes {
    pub(crate) fn new(obstacles: &[HullPart]) -> Self {
        let blocks = obstacles.chunks(LANES).map(|parts| {
            let mut block = Block {
                min: [[f64::INFINITY; LANES]; 3],
                max: [[f64::NEG_INFINITY; LANES]; 3],
            };
            for (lane, part) in parts.iter().enumerate() {
                let (min, max) = (
                    part.center - part.half_extents,
                    part.center + part.half_extents,
                );
                for axis in 0..3 {
                    (block.min[axis][lane], block.max[axis][lane]) = (min[axis], max[axis]);
                }
            }
            block
        });
        ObstacleBoxes {
            blocks: blocks.collect(),
            count: obstacles.len(),
        }
    }

    /// Calls `each` with the index of every obstacle whose box intersects the box from `min` to `max`.
    #[inline(always)]
    pub(crate) fn for_each_meeting(&self, min: DVec3, max: DVec3, mut each: impl FnMut(usize)) {
        for (block, first) in self.blocks.iter().zip((0..self.count).step_by(LANES)) {
            let mut meets = [true; LANES];
            for axis in 0..3 {
                let (mins, maxs) = (&block.min[axis], &block.max[axis]);
                for ((meets, other_min), other_max) in meets.iter_mut().zip(mins).zip(maxs) {
                    // Written so that a box with NaN bounds intersects all others.
                    *meets &= !(*other_min > max[axis] || min[axis] > *other_max);
                }
            }
            for (lane, meets) in meets.into_iter().enumerate() {
                if meets && first + lane < self.count {
                    each(first + lane);
                }
            }
        }
    }
}
