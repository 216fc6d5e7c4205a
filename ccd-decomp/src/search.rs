//! The triangles of a mesh by where they are.

mod fans;
mod nearest;
mod planes;
mod slab;
mod slabs;

use crate::work::Work;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use fans::{Fan, split};
pub(crate) use nearest::NearestTriangles;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use slabs::{Part, Slabs};

/// The boxes of triangles, to be searched: boxes that lie as the triangles do, so that those of slivers
/// side by side hardly meet. The triangles of a large fan about one vertex, where all of them meet, are
/// searched by themselves.
pub(crate) struct TriangleBoxes {
    single: Slabs,
    fans: Vec<Fan>,
    /// The boxes of the fans.
    bvh: Bvh,
}

/// A box along the coordinate axes; touching counts as meeting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) lo: DVec3,
    pub(crate) hi: DVec3,
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
    /// The open inside of a hull.
    Inside(Hull),
}

/// The facets of a hull that are kept to tell what is in front of it.
const FACETS: usize = 64;

#[derive(Clone, Debug)]
struct Hull {
    corners: Vec<DVec3>,
    /// The largest ones, the larger first.
    facets: Vec<[DVec3; 3]>,
}

impl TriangleBoxes {
    /// O(n log n).
    pub(crate) fn new(points: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let (single, fans) = split(points, faces);
        let part = |face: u32| Part {
            corners: faces[face as usize].map(|v| points[v as usize]),
            face,
        };
        let boxes: Vec<Aabb> = fans.iter().map(|fan| fan.bounds().as_aabb()).collect();
        TriangleBoxes {
            single: Slabs::new(single.into_iter().map(part).collect()),
            bvh: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            fans,
        }
    }

    /// Calls back with every triangle that may meet a region, and some that do not, until the answer is
    /// no, or the work is spent: one for each box that is looked at.
    ///
    /// # Guarantee
    /// A triangle that is left out shares no point with the region, but perhaps a common corner.
    pub(crate) fn all_meeting(
        &self,
        region: &Region,
        work: &Work,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        if !self.single.all_meeting(region, work, &mut holds) {
            return false;
        }
        let aabb = region.bounds.as_aabb();
        let mut near = self.bvh.intersect_aabb(&aabb);
        near.all(|fan| {
            let fan = &self.fans[fan as usize];
            !fan.bounds().meets(&region.bounds)
                || work.spend(1) && fan.all_meeting(&region.shape, work, &mut holds)
        })
    }

    /// At least the distance of a point from any of the triangles' points, about.
    pub(crate) fn reach(&self, point: DVec3) -> f64 {
        let single = self.single.bounds();
        let all = self.fans.iter().map(Fan::bounds).chain(single);
        let far = all.map(|b| (point - b.lo).abs().max((b.hi - point).abs()).length());
        far.fold(0.0, greater)
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

    /// The box about it.
    pub(crate) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// What is in a box and inside of a hull, given by its corners and its facets.
    pub(crate) fn inside(corners: Vec<DVec3>, mut facets: Vec<[DVec3; 3]>, bounds: Bounds) -> Self {
        // What is near a hull, but not in it, is most likely in front of a large facet.
        let area = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).length_squared();
        let larger = |f: &[DVec3; 3], g: &[DVec3; 3]| area(g).total_cmp(&area(f));
        if facets.len() > FACETS {
            facets.select_nth_unstable_by(FACETS, larger);
            facets.truncate(FACETS);
        }
        facets.sort_by(larger);
        let shape = Shape::Inside(Hull { corners, facets });
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

    /// Whether two have a point in common.
    pub(crate) fn meets(&self, other: &Bounds) -> bool {
        (self.lo.cmple(other.hi) & other.lo.cmple(self.hi)).all()
    }

    pub(crate) fn as_aabb(self) -> Aabb {
        let vector = |p: DVec3| Vector::new(p.x, p.y, p.z);
        Aabb::new(vector(self.lo), vector(self.hi))
    }
}

#[cfg(test)]
mod tests;
