//! Finds separating axes of eight pairs of nodes at once.

use super::shape::{Children, OtherNode};
use crate::math::simd::{LEAST_DIVISOR, Vec3x8, select_vectors, splat};
use fearless_simd::{Simd, f32x8, prelude::*};

/// Unit axes of eight pairs, the gaps along them, and the extents of both nodes towards each other.
#[derive(Clone, Copy)]
pub(crate) struct AxesX8<L: Simd> {
    pub(crate) n: Vec3x8<L>,
    pub(crate) gap: f32x8<L>,
    pub(crate) child_extent: f32x8<L>,
    pub(crate) other_extent: f32x8<L>,
}

/// Returns for each pair the axis with the widest gap among three: the normals of the two nodes, and the vector between
/// their centres or nearest edges.
///
/// The result is homogeneous in the axis: a zero vector gives no gap, and any other length gives a sound one.
#[inline(always)]
pub(crate) fn widest_gap_axis<L: Simd, C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    offset: Vec3x8<L>,
) -> AxesX8<L> {
    let level = offset.simd_level();
    let between = children.offset_from_nearest_point(other.offset_to_nearest_point(offset));
    let between = unit_axes_and_gaps(children, other, offset, between);
    let own = oriented_towards(children.likely_separating_axis(level), offset);
    let own = AxesX8::new(
        own,
        offset,
        children.extent_along_normal(own),
        other.extent_along(own),
    );
    let others = oriented_towards(Vec3x8::splat(level, other.likely_separating_axis()), offset);
    let reach = other.extent_along_normal(others);
    let others = AxesX8::new(others, offset, children.extent_along(others), reach);
    // The gap along the axis between the nodes is available last.
    wider_gap_axis(wider_gap_axis(own, others), between)
}

/// Returns the axis between the centres at their time of nearest approach, for a straight relative displacement
/// `travel`.
#[inline(always)]
pub(crate) fn closest_approach_axis<L: Simd, C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    offset: Vec3x8<L>,
    travel: Vec3x8<L>,
) -> AxesX8<L> {
    let nearest = offset.dot(travel) / travel.dot(travel).max(LEAST_DIVISOR);
    let nearest = nearest.min(1.0).max(0.0);
    unit_axes_and_gaps(children, other, offset, offset - travel * nearest)
}

/// Returns the axes along given vectors of any length, with the gaps along them.
///
/// The gaps are measured before the vectors are made unit vectors: a root and a quotient take as long as the
/// measurement.
#[inline(always)]
pub(crate) fn unit_axes_and_gaps<L: Simd, C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    offset: Vec3x8<L>,
    v: Vec3x8<L>,
) -> AxesX8<L> {
    let axis = AxesX8::new(v, offset, children.extent_along(v), other.extent_along(v));
    let unit = v.reciprocal_length();
    AxesX8 {
        n: v * unit,
        gap: axis.gap * unit,
        child_extent: axis.child_extent * unit,
        other_extent: axis.other_extent * unit,
    }
}

impl<L: Simd> AxesX8<L> {
    #[inline(always)]
    fn new(n: Vec3x8<L>, offset: Vec3x8<L>, split_reach: f32x8<L>, other_reach: f32x8<L>) -> Self {
        AxesX8 {
            n,
            gap: n.dot(offset) - split_reach - other_reach,
            child_extent: split_reach,
            other_extent: other_reach,
        }
    }
}

/// Returns `n` or `−n`, whichever points along `offset`.
#[inline(always)]
pub(crate) fn oriented_towards<L: Simd>(n: Vec3x8<L>, offset: Vec3x8<L>) -> Vec3x8<L> {
    let level = n.simd_level();
    let away = n.dot(offset).simd_lt(0.0);
    n * away.select(splat(level, -1.0), splat(level, 1.0))
}

#[inline(always)]
fn wider_gap_axis<L: Simd>(a: AxesX8<L>, b: AxesX8<L>) -> AxesX8<L> {
    let pick = b.gap.simd_gt(a.gap);
    AxesX8 {
        n: select_vectors(pick, b.n, a.n),
        gap: pick.select(b.gap, a.gap),
        child_extent: pick.select(b.child_extent, a.child_extent),
        other_extent: pick.select(b.other_extent, a.other_extent),
    }
}
