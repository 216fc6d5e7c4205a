//! Searches a mesh for the triangles that may meet a region, or that are nearest to a point.
//!
//! ```text
//! element.rs ─► oriented_box.rs ─► planes.rs ─► box_tree.rs ─┬─► fans.rs ─► TriangleBoxes
//!                                  region.rs ──┘             └─► nearest.rs
//! ```

pub(crate) mod box_tree;
mod element;
mod fans;
mod nearest;
mod oriented_box;
mod planes;
pub(crate) mod region;

use crate::bounds::BoundingBoxTree;
use crate::work::WorkBudget;
use box_tree::BoxTree;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use fans::{Fan, split_into_fans};
use region::Region;

/// Trees of oriented boxes over triangles, to search by region. Boxes are oriented like the triangles, so that those
/// of adjacent slivers hardly overlap. Large fans around one vertex, where all boxes overlap, have separate trees.
pub(crate) struct TriangleBoxes {
    tree_outside_fans: BoxTree,
    fans: Vec<Fan>,
    /// The axis-aligned boxes of the fans.
    fan_box_tree: BoundingBoxTree,
}

impl TriangleBoxes {
    /// Builds the trees in O(n log n).
    pub(crate) fn new(points: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let (single, fans) = split_into_fans(points, faces);
        TriangleBoxes {
            tree_outside_fans: BoxTree::from_faces(points, faces, single),
            fan_box_tree: BoundingBoxTree::new(fans.iter().map(Fan::bounds).collect()),
            fans,
        }
    }

    /// Calls `holds` for every triangle that conservative tests do not separate from a region. Stops when `holds`
    /// returns false or the work is spent, one step for each box. Returns whether all results were true.
    ///
    /// # Guarantee
    /// An omitted triangle shares no point with the region, except perhaps a common corner.
    pub(crate) fn all_near_faces_satisfy(
        &self,
        region: &Region,
        work: &WorkBudget,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let tree = &self.tree_outside_fans;
        tree.all_near_faces_satisfy(region, work, &mut holds)
            && self
                .fan_box_tree
                .all_meeting_boxes_satisfy(&region.bounds, |fan| {
                    let fan = &self.fans[fan as usize];
                    work.spend(1) && fan.all_near_faces_satisfy(&region.shape, work, &mut holds)
                })
    }

    /// Returns an upper bound, up to rounding, of the largest distance from `point` to any point of the triangles.
    pub(crate) fn farthest_distance_bound(&self, point: DVec3) -> f64 {
        let single = self.tree_outside_fans.bounds();
        let all = self.fans.iter().map(Fan::bounds).chain(single);
        let far = all.map(|b| (point - b.lo).abs().max((b.hi - point).abs()).length());
        far.fold(0.0, greater)
    }
}

#[cfg(test)]
mod tests;
