//! The triangles of a mesh by where they are.

mod fans;
mod rim;

use ccd_core::glam::DVec3;
use fans::{Fan, split};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

/// The boxes of triangles, to be searched. Those of a large fan about one vertex, which are long and
/// thin and have boxes that all meet, are one leaf together.
pub(crate) struct TriangleBoxes {
    bvh: Bvh,
    leaves: Vec<Leaf>,
}

enum Leaf {
    Face(u32),
    Fan(Fan),
}

/// A box along the coordinate axes; touching counts as meeting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    lo: DVec3,
    hi: DVec3,
}

/// A part of space in which triangles are looked for.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    bounds: Bounds,
    shape: Shape,
}

#[derive(Clone, Debug)]
enum Shape {
    Segment([DVec3; 2]),
    Triangle([DVec3; 3]),
    /// The open inside of a hull, by its facets.
    Inside(Vec<[DVec3; 3]>),
}

impl TriangleBoxes {
    /// O(n log n).
    pub(crate) fn new(points: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let (single, fans) = split(points, faces);
        let mut boxes: Vec<Aabb> = Vec::with_capacity(single.len() + fans.len());
        let mut leaves = Vec::with_capacity(single.len() + fans.len());
        for face in single {
            let triangle = faces[face as usize].map(|v| points[v as usize]);
            boxes.push(Bounds::of(triangle).as_aabb());
            leaves.push(Leaf::Face(face));
        }
        for fan in fans {
            boxes.push(fan.bounds().as_aabb());
            leaves.push(Leaf::Fan(fan));
        }
        TriangleBoxes {
            bvh: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            leaves,
        }
    }

    /// Calls back with every triangle that may meet a region, and some that do not, until the answer is
    /// no.
    ///
    /// # Guarantee
    /// A triangle that is left out shares no point with the region, but perhaps a common corner.
    pub(crate) fn all_meeting(&self, region: &Region, mut holds: impl FnMut(u32) -> bool) -> bool {
        let aabb = region.bounds.as_aabb();
        let mut near = self.bvh.intersect_aabb(&aabb);
        near.all(|leaf| match &self.leaves[leaf as usize] {
            Leaf::Face(face) => holds(*face),
            Leaf::Fan(fan) => fan.all_meeting(&region.shape, &mut holds),
        })
    }

    /// At least the distance of a point from any of the triangles' points, about.
    pub(crate) fn reach(&self, point: DVec3) -> f64 {
        let all = self.bvh.root_aabb();
        let vector = |v: Vector| DVec3::new(v.x, v.y, v.z);
        let (lo, hi) = (vector(all.mins), vector(all.maxs));
        (point - lo).abs().max((hi - point).abs()).length()
    }
}

impl Region {
    pub(crate) fn segment(ends: [DVec3; 2]) -> Self {
        Region {
            bounds: Bounds::of(ends),
            shape: Shape::Segment(ends),
        }
    }

    pub(crate) fn triangle(corners: [DVec3; 3]) -> Self {
        Region {
            bounds: Bounds::of(corners),
            shape: Shape::Triangle(corners),
        }
    }

    /// What is in a box and inside of a hull, given by its facets.
    pub(crate) fn inside(facets: Vec<[DVec3; 3]>, bounds: Bounds) -> Self {
        let shape = Shape::Inside(facets);
        Region { bounds, shape }
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

#[cfg(test)]
mod tests;
