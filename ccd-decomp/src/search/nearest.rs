//! Triangles near a point or in a box.

use super::box_tree::BoxTree;
use super::element::Element;
use super::region::Region;
use crate::bounds::Bounds;
use crate::work::Work;
use ccd_core::glam::DVec3;

/// Triangles, to be searched by distance: boxes lie as the triangles do, so that slivers are told apart.
pub(crate) struct NearestTriangles {
    all: BoxTree,
}

/// What looking at a node by distance takes, in nodes looked at for whether they meet a region.
const NODE: usize = 4;

impl NearestTriangles {
    /// O(n log n).
    pub(crate) fn new(points: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let element = |(face, corners): (u32, &[u32; 3])| Element {
            corners: corners.map(|v| points[v as usize]),
            face,
        };
        NearestTriangles {
            all: BoxTree::new((0..).zip(faces).map(element).collect()),
        }
    }

    /// The triangle of least distance, by a measure that is the distance of a triangle from the point.
    ///
    /// # Guarantee
    /// No other one is nearer, but for rounding of the order of a coordinate's.
    pub(crate) fn to(
        &self,
        point: DVec3,
        work: &Work,
        mut measure: impl FnMut([DVec3; 3]) -> f64,
    ) -> Option<(u32, f64)> {
        let mut best: Option<(u32, f64)> = None;
        let mut stack = vec![(0.0, 0)];
        // Every node is put there once, by the one above.
        while let Some((least, at)) = stack.pop() {
            let is_farther = best.is_some_and(|(_, distance)| least >= distance);
            if is_farther {
                continue;
            }
            work.spend(NODE);
            let (elements, below) = self.all.below(at);
            for element in elements {
                let distance = measure(element.corners);
                // Written so that NaN is no distance, but for want of any.
                if best.is_none_or(|(_, known)| distance < known) {
                    best = Some((element.face, distance));
                }
            }
            if let Some(children) = below {
                let [one, other] = children.map(|child| (self.all.distance(child, point), child));
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

    /// Calls back with the triangles whose boxes meet a box, until the answer is no, or the work is spent.
    pub(crate) fn all_in(
        &self,
        bounds: &Bounds,
        work: &Work,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let is_far = |other: &Bounds, _: &_| !other.meets(bounds);
        self.all.all_elements_but(is_far, work, |element| {
            !Bounds::of(element.corners).meets(bounds) || holds(element.face)
        })
    }

    /// As [`TriangleBoxes::all_meeting`](super::TriangleBoxes::all_meeting).
    pub(crate) fn all_meeting(
        &self,
        region: &Region,
        work: &Work,
        holds: impl FnMut(u32) -> bool,
    ) -> bool {
        self.all.all_meeting(region, work, holds)
    }
}
