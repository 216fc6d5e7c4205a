//! Searches for the triangle nearest to a point, and for the triangles that meet an axis-aligned box.

use super::box_tree::BoxTree;
use crate::bounds::BoundingBox;
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;

/// The cost of visiting one node in a search by distance, in steps. Visiting one node in a search by region is one
/// step.
const STEPS_PER_NODE: usize = 4;

impl BoxTree {
    /// Returns the face nearest to a point, and its distance. `measure` computes the distance of a triangle from the
    /// point.
    ///
    /// # Guarantee
    /// No other triangle is nearer, up to rounding of the order of a coordinate's.
    pub(crate) fn nearest_face(
        &self,
        point: DVec3,
        work: &WorkBudget,
        mut measure: impl FnMut([DVec3; 3]) -> f64,
    ) -> Option<(u32, f64)> {
        let mut best: Option<(u32, f64)> = None;
        let mut stack = vec![(0.0, 0)];
        // Every node is pushed once, by its parent.
        while let Some((least, at)) = stack.pop() {
            let is_farther = best.is_some_and(|(_, distance)| least >= distance);
            if is_farther {
                continue;
            }
            work.spend(STEPS_PER_NODE);
            let (elements, below) = self.elements_and_children(at);
            for element in elements {
                let distance = measure(element.corners);
                // Written so that NaN is a distance only if there is no other.
                if best.is_none_or(|(_, known)| distance < known) {
                    best = Some((element.face, distance));
                }
            }
            if let Some(children) = below {
                let [one, other] = children.map(|child| (self.least_distance(child, point), child));
                let (near, far) = if one.0 <= other.0 {
                    (one, other)
                } else {
                    (other, one)
                };
                stack.extend([far, near]);
            }
        }
        best
    }

    /// Calls `holds` for the triangles whose bounding boxes meet a given box. Stops when `holds` returns false or the
    /// work is spent.
    pub(crate) fn all_triangles_meeting_box_satisfy(
        &self,
        bounds: &BoundingBox,
        work: &WorkBudget,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let is_far = |other: &BoundingBox, _: &_| !other.meets(bounds);
        self.all_near_elements_satisfy(is_far, work, |element| {
            !BoundingBox::enclosing(element.corners).meets(bounds) || holds(element.face)
        })
    }
}
