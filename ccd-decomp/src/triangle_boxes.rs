//! The triangles of a mesh by where they are.

use ccd_core::glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

/// The boxes of triangles, to be searched.
pub(crate) struct TriangleBoxes {
    bvh: Bvh,
}

/// A box along the coordinate axes; touching counts as meeting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    lo: DVec3,
    hi: DVec3,
}

impl TriangleBoxes {
    /// O(n log n).
    pub(crate) fn new(triangles: impl Iterator<Item = [DVec3; 3]>) -> Self {
        let leaves: Vec<Aabb> = triangles.map(|t| Bounds::of(t).as_aabb()).collect();
        TriangleBoxes {
            bvh: Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves),
        }
    }

    /// Calls back with every triangle whose box meets another one, until the answer is no.
    pub(crate) fn all_meeting(&self, bounds: Bounds, mut holds: impl FnMut(u32) -> bool) -> bool {
        let aabb = bounds.as_aabb();
        self.bvh.intersect_aabb(&aabb).all(&mut holds)
    }
}

impl TriangleBoxes {
    /// At least the distance of a point from any of the triangles' points, about.
    pub(crate) fn reach(&self, point: DVec3) -> f64 {
        let all = self.bvh.root_aabb();
        let vector = |v: Vector| DVec3::new(v.x, v.y, v.z);
        let (lo, hi) = (vector(all.mins), vector(all.maxs));
        (point - lo).abs().max((hi - point).abs()).length()
    }
}

impl Bounds {
    /// The smallest box that holds some points.
    pub(crate) fn of(points: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Bounds {
            lo: DVec3::INFINITY,
            hi: DVec3::NEG_INFINITY,
        };
        points.into_iter().fold(empty, |b, p| Bounds {
            lo: b.lo.min(p),
            hi: b.hi.max(p),
        })
    }

    /// The smallest box that holds two.
    pub(crate) fn union(self, other: Self) -> Self {
        Bounds {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    fn as_aabb(self) -> Aabb {
        let vector = |p: DVec3| Vector::new(p.x, p.y, p.z);
        Aabb::new(vector(self.lo), vector(self.hi))
    }
}
