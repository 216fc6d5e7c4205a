//! Tests whether two meshes at rest cross.

use super::{Obb, ObbTree};
use crate::method::rival::Placement;
use crate::method::rival::interval::cross_radius;
use crate::method::rival::tree::{OpenedPair, open_pair};
use crate::method::rival::triangles_cross::triangles_cross;
use ccd_core::glam::DVec3;

/// A bound on the rounding of cosines between the axes of two boxes, so that the cross product of parallel axes
/// separates nothing \[OBBTREE96 §5\].
const COSINE_ROUNDING_BOUND: f64 = 1e-14;

/// Returns true if any triangles of two trees touch or cross, with A placed in B's frame.
///
/// `stack` is scratch space of the caller, which avoids allocations.
///
/// # Complexity
/// Linear in the pairs of boxes that overlap, at most all pairs of nodes.
pub(in crate::method::rival) fn trees_intersect(
    a: &ObbTree,
    b: &ObbTree,
    placement: &Placement,
    stack: &mut Vec<(u32, u32)>,
) -> bool {
    let between_origins = Placement {
        rotation: placement.rotation,
        translation: placement.apply(a.origin) - b.origin,
    };
    stack.clear();
    stack.push((0, 0));
    while let Some((i, j)) = stack.pop() {
        let (node_a, node_b) = (a.node(i), b.node(j));
        if node_a
            .bounds
            .is_separated_from(&node_b.bounds, &between_origins)
        {
            continue;
        }
        let nodes = [node_a, node_b];
        let sizes = nodes.map(|node| node.bounds.half_extents.max_element());
        match open_pair(nodes.map(|node| node.content), sizes) {
            OpenedPair::Triangles([p, q]) => {
                let p = a.triangle(p).map(|x| between_origins.apply(x));
                if triangles_cross(&p, b.triangle(q)) {
                    return true;
                }
            }
            OpenedPair::ChildrenOfA([left, right]) => stack.extend([(right, j), (left, j)]),
            OpenedPair::ChildrenOfB([left, right]) => stack.extend([(i, right), (i, left)]),
        }
    }
    false
}

impl Obb {
    /// Returns true if one of the 15 axes separates this box, placed in the frame of `other`, from that box \[OBBTREE96
    /// §5\].
    fn is_separated_from(&self, other: &Obb, placement: &Placement) -> bool {
        let into = other.axes.transpose();
        let t = into * (placement.apply(self.center) - other.center);
        let cos = into * (placement.rotation * self.axes);
        let mut abs = cos.abs();
        abs.x_axis += COSINE_ROUNDING_BOUND;
        abs.y_axis += COSINE_ROUNDING_BOUND;
        abs.z_axis += COSINE_ROUNDING_BOUND;
        let (ha, hb) = (self.half_extents, other.half_extents);
        if (t.abs() - hb - abs * ha).max_element() > 0.0 {
            return true;
        }
        let along_a = cos.transpose_mul_vec3(t).abs() - ha - abs.transpose_mul_vec3(hb);
        if along_a.max_element() > 0.0 {
            return true;
        }
        // The axes `b_i × a_j`, for all i at once.
        let separates = |c: DVec3, abs_c: DVec3, of_a: DVec3| {
            (t.cross(c).abs() - cross_radius(hb, abs_c) - of_a).max_element() > 0.0
        };
        let [x, y, z] = [abs.x_axis, abs.y_axis, abs.z_axis];
        separates(cos.x_axis, x, ha.y * z + ha.z * y)
            || separates(cos.y_axis, y, ha.z * x + ha.x * z)
            || separates(cos.z_axis, z, ha.x * y + ha.y * x)
    }
}
