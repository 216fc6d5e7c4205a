//! The geometry of nodes, in the coordinates of the split group.

use crate::body::tree::{BoxGroup, TriangleGroup};
use crate::math::simd::{LEAST_DIVISOR, Vec3x8, load, select_vectors, splat};
use crate::tuning::MIN_LARGE_TRIANGLE_RATIO;
use fearless_simd::{Simd, f32x8, mask32x8, prelude::*};
use glam::Vec3;

/// The eight children of a group as geometric shapes.
pub(crate) trait Children {
    fn center<L: Simd>(&self, level: L) -> Vec3x8<L>;
    /// Returns for each child a unit vector that is likely to be a separating axis, or zero.
    fn likely_separating_axis<L: Simd>(&self, level: L) -> Vec3x8<L>;
    /// Returns upper bounds of the distances of each child's points from its center.
    fn radius<L: Simd>(&self, level: L) -> f32x8<L>;
    /// Returns `max n·(x − center)` over each child's points `x`.
    fn extent_along<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L>;
    /// Like `Children::extent_along`, for unit vectors, or zero.
    #[inline(always)]
    fn extent_along_unit<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.extent_along(n)
    }
    /// Like `Children::extent_along`, for axes that are the children's normals or their negatives.
    #[inline(always)]
    fn extent_along_normal<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.extent_along(n)
    }
    /// Returns the vectors from each child's nearest point to a target point, as likely separating axes; `to` leads
    /// from the children's centers to the target. Children that are neither thin nor much larger than `target_radius` may take
    /// their centers for the nearest points.
    fn offset_from_nearest_point<L: Simd>(&self, to: Vec3x8<L>, target_radius: f32) -> Vec3x8<L>;
    /// Returns an upper bound of the distances of the children's points from the group's origin.
    fn max_distance_from_origin(&self) -> f32;
    /// Returns which children are single pieces, and cannot be split.
    fn leaf_children_mask<L: Simd>(&self, level: L) -> mask32x8<L>;
}

/// The node with which all children of a group are paired.
pub(crate) trait OtherNode {
    fn center(&self) -> Vec3;
    /// Returns a unit vector that is likely to be a separating axis, or zero.
    fn likely_separating_axis(&self) -> Vec3;
    /// Returns an upper bound of the distances of the node's points from its center.
    fn radius(&self) -> f32;
    /// Returns `max n·(center − y)` over the node's points `y`: the node's extent along −n.
    fn extent_along<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L>;
    /// Like `OtherNode::extent_along`, for unit vectors, or zero.
    #[inline(always)]
    fn extent_along_unit<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.extent_along(n)
    }
    /// Like `OtherNode::extent_along`, for axes that are the node's normal or its negative.
    #[inline(always)]
    fn extent_along_normal<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.extent_along(n)
    }
    /// Returns the vectors from given points to the node's nearest points, as likely separating axes; `offset` leads
    /// from the given points to the node's center. A node that is neither thin nor much larger than `source_radius` may take its
    /// center for the nearest point.
    fn offset_to_nearest_point<L: Simd>(&self, offset: Vec3x8<L>, source_radius: f32) -> Vec3x8<L>;
    /// Returns whether the node is a single piece, and cannot be split.
    fn is_piece(&self) -> bool;
}

/// A box that is grown by a radius, and a ball with the same center around it.
struct GrownBox<L: Simd> {
    axes: [Vec3x8<L>; 3],
    half_extents: [f32x8<L>; 3],
    rounding_radius: f32x8<L>,
    radius: f32x8<L>,
}

impl<L: Simd> GrownBox<L> {
    /// Returns the lesser of the extents of the box and of the ball along n: `min(Σ hₖ |n·uₖ| + r |n|, R |n|)`.
    #[cfg_attr(inline_kernels, inline(always))]
    fn extent_along(&self, n: Vec3x8<L>) -> f32x8<L> {
        let length = n.length();
        (self.rounding_radius * length + self.ungrown_extent_along(n)).min(self.radius * length)
    }

    /// Like `extent_along`, for unit vectors, or zero.
    #[cfg_attr(inline_kernels, inline(always))]
    fn extent_along_unit(&self, n: Vec3x8<L>) -> f32x8<L> {
        (self.rounding_radius + self.ungrown_extent_along(n)).min(self.radius)
    }

    /// Returns the extent of the box before it is grown.
    #[cfg_attr(inline_kernels, inline(always))]
    fn ungrown_extent_along(&self, n: Vec3x8<L>) -> f32x8<L> {
        let ([u, v, w], [x, y, z]) = (self.axes, self.half_extents);
        let xy = y * n.dot(v).abs() + x * n.dot(u).abs();
        z * n.dot(w).abs() + xy
    }
}

impl Children for BoxGroup {
    #[inline(always)]
    fn center<L: Simd>(&self, level: L) -> Vec3x8<L> {
        Vec3x8::load(level, &self.center)
    }
    #[inline(always)]
    fn likely_separating_axis<L: Simd>(&self, level: L) -> Vec3x8<L> {
        Vec3x8::load(level, &self.axes[2])
    }
    #[inline(always)]
    fn radius<L: Simd>(&self, level: L) -> f32x8<L> {
        load(level, &self.radius)
    }
    #[inline(always)]
    fn offset_from_nearest_point<L: Simd>(&self, to: Vec3x8<L>, _: f32) -> Vec3x8<L> {
        to
    }
    #[inline(always)]
    fn max_distance_from_origin(&self) -> f32 {
        self.header.max_distance_from_origin
    }
    #[inline(always)]
    fn extent_along<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.boxes(n.simd_level()).extent_along(n)
    }
    #[inline(always)]
    fn extent_along_unit<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.boxes(n.simd_level()).extent_along_unit(n)
    }
    #[inline(always)]
    fn extent_along_normal<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        // The half size was measured in the same way.
        load(n.simd_level(), &self.half_extents[2]) + load(n.simd_level(), &self.rounding_radius)
    }
    #[inline(always)]
    fn leaf_children_mask<L: Simd>(&self, level: L) -> mask32x8<L> {
        mask32x8::from_bitmask(level, self.leaf_mask.into())
    }
}

impl BoxGroup {
    #[inline(always)]
    fn boxes<L: Simd>(&self, level: L) -> GrownBox<L> {
        let ([u, v, w], [x, y, z]) = (&self.axes, &self.half_extents);
        GrownBox {
            axes: [
                Vec3x8::load(level, u),
                Vec3x8::load(level, v),
                Vec3x8::load(level, w),
            ],
            half_extents: [load(level, x), load(level, y), load(level, z)],
            rounding_radius: load(level, &self.rounding_radius),
            radius: load(level, &self.radius),
        }
    }
}

impl Children for TriangleGroup {
    #[inline(always)]
    fn center<L: Simd>(&self, level: L) -> Vec3x8<L> {
        let [a, b, c] = self.triangle_corners(level);
        (a + b + c) * splat(level, 1.0 / 3.0)
    }
    #[inline(always)]
    fn likely_separating_axis<L: Simd>(&self, level: L) -> Vec3x8<L> {
        // The products are relative to the radius: the square of a small area would be lost in f32.
        let scale = splat(level, 1.0) / self.radius(level).max(LEAST_DIVISOR);
        let [a, b, c] = self.triangle_corners(level);
        ((b - a) * scale).cross((c - a) * scale).unit()
    }
    #[inline(always)]
    fn radius<L: Simd>(&self, level: L) -> f32x8<L> {
        load(level, &self.radius)
    }
    #[inline(always)]
    fn offset_from_nearest_point<L: Simd>(&self, to: Vec3x8<L>, target_radius: f32) -> Vec3x8<L> {
        if !self.has_thin_triangles
            && self.header.max_distance_from_origin <= MIN_LARGE_TRIANGLE_RATIO * target_radius
        {
            return to;
        }
        let level = to.simd_level();
        offset_from_edges(self.triangle_corners(level), self.center(level) + to)
    }
    #[inline(always)]
    fn max_distance_from_origin(&self) -> f32 {
        self.header.max_distance_from_origin
    }
    #[cfg_attr(inline_kernels, inline(always))]
    fn extent_along<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        let level = n.simd_level();
        let [a, b, c] = self.triangle_corners(level);
        let highest = n.dot(a).max(n.dot(b)).max(n.dot(c));
        highest - n.dot(self.center(level))
    }
    #[inline(always)]
    fn leaf_children_mask<L: Simd>(&self, level: L) -> mask32x8<L> {
        mask32x8::splat(level, true)
    }
}

impl TriangleGroup {
    #[inline(always)]
    fn triangle_corners<L: Simd>(&self, level: L) -> [Vec3x8<L>; 3] {
        let [a, b, c] = &self.corners;
        [
            Vec3x8::load(level, a),
            Vec3x8::load(level, b),
            Vec3x8::load(level, c),
        ]
    }
}

/// The box and the ball of the other node, in the group's coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherBox {
    pub(crate) center: Vec3,
    pub(crate) axes: [Vec3; 3],
    pub(crate) half_extents: [f32; 3],
    pub(crate) rounding_radius: f32,
    pub(crate) radius: f32,
    /// True if the node is a single piece.
    pub(crate) is_piece: bool,
}

impl OtherNode for OtherBox {
    #[inline(always)]
    fn center(&self) -> Vec3 {
        self.center
    }
    #[inline(always)]
    fn likely_separating_axis(&self) -> Vec3 {
        self.axes[2]
    }
    #[inline(always)]
    fn radius(&self) -> f32 {
        self.radius
    }
    #[inline(always)]
    fn offset_to_nearest_point<L: Simd>(&self, offset: Vec3x8<L>, _: f32) -> Vec3x8<L> {
        let [u, v, w] = splat_vectors(offset.simd_level(), self.axes);
        let [half_x, half_y, half_z] = self.half_extents;
        let x = offset.dot(u).min(half_x).max(-half_x);
        let y = offset.dot(v).min(half_y).max(-half_y);
        let z = offset.dot(w).min(half_z).max(-half_z);
        offset - (u * x + v * y + w * z)
    }
    #[inline(always)]
    fn extent_along<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.splat(n.simd_level()).extent_along(n)
    }
    #[inline(always)]
    fn extent_along_unit<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        self.splat(n.simd_level()).extent_along_unit(n)
    }
    #[inline(always)]
    fn extent_along_normal<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        splat(n.simd_level(), self.half_extents[2] + self.rounding_radius)
    }
    #[inline(always)]
    fn is_piece(&self) -> bool {
        self.is_piece
    }
}

impl OtherBox {
    /// Copies the box to all lanes.
    #[inline(always)]
    fn splat<L: Simd>(&self, level: L) -> GrownBox<L> {
        GrownBox {
            axes: splat_vectors(level, self.axes),
            half_extents: self.half_extents.map(|half| splat(level, half)),
            rounding_radius: splat(level, self.rounding_radius),
            radius: splat(level, self.radius),
        }
    }
}

/// The other node if it is a triangle, by its corners relative to its center.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherTriangle {
    pub(crate) center: Vec3,
    pub(crate) corners: [Vec3; 3],
    pub(crate) normal: Vec3,
    pub(crate) radius: f32,
    /// Whether the triangle is a sliver.
    pub(crate) is_thin: bool,
}

impl OtherNode for OtherTriangle {
    #[inline(always)]
    fn center(&self) -> Vec3 {
        self.center
    }
    #[inline(always)]
    fn likely_separating_axis(&self) -> Vec3 {
        self.normal
    }
    #[inline(always)]
    fn radius(&self) -> f32 {
        self.radius
    }
    #[inline(always)]
    fn offset_to_nearest_point<L: Simd>(&self, offset: Vec3x8<L>, source_radius: f32) -> Vec3x8<L> {
        if !self.is_thin && self.radius <= MIN_LARGE_TRIANGLE_RATIO * source_radius {
            return offset;
        }
        let level = offset.simd_level();
        let zero = Vec3x8::splat(level, Vec3::ZERO);
        zero - offset_from_edges(splat_vectors(level, self.corners), zero - offset)
    }
    #[cfg_attr(inline_kernels, inline(always))]
    fn extent_along<L: Simd>(&self, n: Vec3x8<L>) -> f32x8<L> {
        let [a, b, c] = splat_vectors(n.simd_level(), self.corners);
        -n.dot(a).min(n.dot(b)).min(n.dot(c))
    }
    #[inline(always)]
    fn is_piece(&self) -> bool {
        true
    }
}

#[inline(always)]
fn splat_vectors<L: Simd>(level: L, [a, b, c]: [Vec3; 3]) -> [Vec3x8<L>; 3] {
    [
        Vec3x8::splat(level, a),
        Vec3x8::splat(level, b),
        Vec3x8::splat(level, c),
    ]
}

/// Returns the vectors to `to` from the nearest points of triangles' edges. If an interior point is nearer, the
/// triangle's normal is the better axis anyway.
#[cfg_attr(inline_kernels, inline(always))]
fn offset_from_edges<L: Simd>([a, b, c]: [Vec3x8<L>; 3], to: Vec3x8<L>) -> Vec3x8<L> {
    let (a, b, c) = (to - a, to - b, to - c);
    let first = shorter_vectors(offset_from_edge(a, b), offset_from_edge(b, c));
    shorter_vectors(first, offset_from_edge(c, a))
}

/// Returns the vector to a point from the nearest point of an edge, for each of eight lanes; `from_p` and `from_q` lead
/// to the point from the ends of the edge.
#[inline(always)]
fn offset_from_edge<L: Simd>(from_p: Vec3x8<L>, from_q: Vec3x8<L>) -> Vec3x8<L> {
    let edge = from_p - from_q;
    let t = from_p.dot(edge) / edge.dot(edge).max(LEAST_DIVISOR);
    from_p - edge * t.min(1.0).max(0.0)
}

#[inline(always)]
fn shorter_vectors<L: Simd>(v: Vec3x8<L>, w: Vec3x8<L>) -> Vec3x8<L> {
    select_vectors(v.dot(v).simd_lt(w.dot(w)), v, w)
}
