//! Triangles near a point or in a box.

use super::Bounds;
use super::slabs::{Part, Slabs};
use crate::work::Work;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::ops::ControlFlow;

/// Triangles, to be searched by distance: boxes lie as the triangles do, so that slivers are told apart.
pub(crate) struct NearestTriangles {
    all: Slabs,
}

impl NearestTriangles {
    /// O(n log n).
    pub(crate) fn new(points: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let part = |(face, corners): (u32, &[u32; 3])| Part {
            corners: corners.map(|v| points[v as usize]),
            face,
        };
        NearestTriangles {
            all: Slabs::new((0..).zip(faces).map(part).collect()),
        }
    }

    /// The triangle of least distance, by a measure that is the distance of a triangle from the point.
    ///
    /// # Guarantee
    /// No other one is nearer, but for rounding of the order of a coordinate's.
    pub(crate) fn to(
        &self,
        point: DVec3,
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
            let (parts, below) = self.all.below(at);
            for part in parts {
                let distance = measure(part.corners);
                // Written so that NaN is no distance, but for want of any.
                if best.is_none_or(|(_, known)| distance < known) {
                    best = Some((part.face, distance));
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

    /// Calls back with the triangles whose boxes meet a box, until told to stop.
    pub(crate) fn in_box(
        &self,
        [lo, hi]: [DVec3; 2],
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) {
        let region = Bounds { lo, hi };
        let is_far = |bounds: &Bounds, _: &_| !bounds.meets(&region);
        self.all.all_parts_but(is_far, &Work::unbounded(), |part| {
            !Bounds::of(part.corners).meets(&region) || visit(part.face).is_continue()
        });
    }
}

/// At most the distance of a point from a box, up to rounding.
pub(super) fn distance_to(bounds: &Bounds, point: DVec3) -> f64 {
    let beyond = (bounds.lo - point).max(point - bounds.hi).max(DVec3::ZERO);
    greater(beyond.length(), 0.0)
}
