//! Axis-aligned boxes, and trees of them.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::vector::bounding_box;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

/// An axis-aligned box, including its boundary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundingBox {
    pub(crate) lo: DVec3,
    pub(crate) hi: DVec3,
}

impl BoundingBox {
    /// Returns the bounding box of some points.
    pub(crate) fn enclosing(points: impl IntoIterator<Item = DVec3>) -> Self {
        let (lo, hi) = bounding_box(points.into_iter());
        BoundingBox { lo, hi }
    }

    /// Returns the smallest box that contains two boxes.
    pub(crate) fn union(self, other: Self) -> Self {
        BoundingBox {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// Returns whether two boxes have a point in common.
    pub(crate) fn meets(&self, other: &BoundingBox) -> bool {
        (self.lo.cmple(other.hi) & other.lo.cmple(self.hi)).all()
    }

    /// Returns the distance of a point from the box, up to rounding; 0 inside.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        let beyond = (self.lo - point).max(point - self.hi).max(DVec3::ZERO);
        greater(beyond.length(), 0.0)
    }
}

/// A search tree over axis-aligned boxes, which finds the boxes that meet a given box.
pub(crate) struct BoundingBoxTree {
    bounds: Vec<BoundingBox>,
    bvh: Bvh,
}

impl BoundingBoxTree {
    /// Builds the tree in O(n log n).
    pub(crate) fn new(bounds: Vec<BoundingBox>) -> Self {
        let boxes: Vec<Aabb> = bounds.iter().map(to_parry_aabb).collect();
        let bvh = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        BoundingBoxTree { bounds, bvh }
    }

    /// Returns a box by its index.
    pub(crate) fn get(&self, index: u32) -> &BoundingBox {
        &self.bounds[index as usize]
    }

    /// Returns whether `holds` is true for the index of every box that meets the given box. It calls `holds` until the
    /// first false result.
    pub(crate) fn all_meeting_boxes_satisfy(
        &self,
        bounds: &BoundingBox,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let aabb = to_parry_aabb(bounds);
        let mut near = self.bvh.intersect_aabb(&aabb);
        near.all(|index| !self.get(index).meets(bounds) || holds(index))
    }
}

fn to_parry_aabb(bounds: &BoundingBox) -> Aabb {
    Aabb::new(to_parry_vector(bounds.lo), to_parry_vector(bounds.hi))
}

/// Converts a vector to one of the version of `glam` that `parry3d` uses.
pub(crate) fn to_parry_vector(p: DVec3) -> Vector {
    Vector::new(p.x, p.y, p.z)
}

#[cfg(test)]
mod tests;
