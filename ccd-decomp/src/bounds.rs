//! Axis-aligned boxes.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;

/// An axis-aligned box; touching counts as meeting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) lo: DVec3,
    pub(crate) hi: DVec3,
}

impl Bounds {
    /// Returns the bounding box of some points.
    pub(crate) fn enclosing(points: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Bounds {
            lo: DVec3::INFINITY,
            hi: DVec3::NEG_INFINITY,
        };
        points.into_iter().fold(empty, |b, p| Bounds {
            lo: b.lo.min(p),
            hi: b.hi.max(p),
        })
    }

    /// Returns the bounding box of two boxes.
    pub(crate) fn union(self, other: Self) -> Self {
        Bounds {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// Returns whether two boxes have a point in common.
    pub(crate) fn meets(&self, other: &Bounds) -> bool {
        (self.lo.cmple(other.hi) & other.lo.cmple(self.hi)).all()
    }

    pub(crate) fn as_aabb(self) -> Aabb {
        let vector = |p: DVec3| Vector::new(p.x, p.y, p.z);
        Aabb::new(vector(self.lo), vector(self.hi))
    }

    /// Returns the distance of a point from the box, up to rounding; 0 inside.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        let beyond = (self.lo - point).max(point - self.hi).max(DVec3::ZERO);
        greater(beyond.length(), 0.0)
    }
}
