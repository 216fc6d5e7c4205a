//! Finds separating axes of eight pairs of nodes at once.

use super::shape::{Children, OtherNode};
use crate::math::simd::{LEAST_DIVISOR, Vec3x8, select_vectors, splat};
use crate::tuning::LEAST_CLOSING_RATE;
use fearless_simd::{Simd, f32x8, mask32x8, prelude::*};

/// Unit axes of eight pairs, and the gaps along them.
#[derive(Clone, Copy)]
pub(crate) struct AxesX8<L: Simd> {
    pub(crate) n: Vec3x8<L>,
    pub(crate) across: GapAndExtents<L>,
}

/// Gaps between eight pairs along their axes, and the extents of both nodes towards each other.
#[derive(Clone, Copy)]
pub(crate) struct GapAndExtents<L: Simd> {
    pub(crate) gap: f32x8<L>,
    pub(crate) child_extent: f32x8<L>,
    pub(crate) other_extent: f32x8<L>,
}

impl<L: Simd> GapAndExtents<L> {
    /// Creates the gaps of nodes with these extents, whose centers are `offset` apart along their axes.
    #[inline(always)]
    fn new(offset: f32x8<L>, child_extent: f32x8<L>, other_extent: f32x8<L>) -> Self {
        GapAndExtents {
            gap: offset - child_extent - other_extent,
            child_extent,
            other_extent,
        }
    }

    /// Selects values of `self` where the mask is set, and values of `other` elsewhere.
    #[inline(always)]
    fn select(self, mask: mask32x8<L>, other: Self) -> Self {
        GapAndExtents {
            gap: mask.select(self.gap, other.gap),
            child_extent: mask.select(self.child_extent, other.child_extent),
            other_extent: mask.select(self.other_extent, other.other_extent),
        }
    }
}

impl<L: Simd> AxesX8<L> {
    /// Selects axes of `self` where the mask is set, and axes of `other` elsewhere.
    #[inline(always)]
    fn select(self, mask: mask32x8<L>, other: Self) -> Self {
        AxesX8 {
            n: select_vectors(mask, self.n, other.n),
            across: self.across.select(mask, other.across),
        }
    }
}

/// Returns for each of eight pairs the axis along which the gap takes longest to close to the required gap, if it closes
/// at the rate of the centers' velocities. There are three: the normals of the two nodes, and the vector between their
/// centers or nearest edges.
///
/// Each is homogeneous: a zero vector gives no gap, and any other length than 1 gives a sound one.
#[cfg_attr(inline_kernels, inline(always))]
pub(crate) fn slowest_closing_axis<L: Simd, C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    offset: Vec3x8<L>,
    velocity: Vec3x8<L>,
    required_gap: f32,
) -> AxesX8<L> {
    let level = offset.simd_level();
    // Each axis is compared before the next one is computed, so that few values wait in registers.
    let own = OrientedAxes::new(children.likely_separating_axis(level), offset);
    let own = own.with_extents(
        children.extent_along_normal(own.n),
        other.extent_along_unit(own.n),
    );
    let own_time = closing_time(&own, velocity, required_gap);
    let others = Vec3x8::splat(level, other.likely_separating_axis());
    let others = OrientedAxes::new(others, offset);
    let others = others.with_extents(
        children.extent_along_unit(others.n),
        other.extent_along_normal(others.n),
    );
    let others_time = closing_time(&others, velocity, required_gap);
    let pick = others_time.simd_gt(own_time);
    let (slower, slower_time) = (others.select(pick, own), pick.select(others_time, own_time));
    let between = other.offset_to_nearest_point(offset, children.max_distance_from_origin());
    let between = children.offset_from_nearest_point(between, other.radius());
    let between = unit_axes_and_gaps(children, other, offset, between);
    let between_time = closing_time(&between, velocity, required_gap);
    between.select(between_time.simd_gt(slower_time), slower)
}

/// Returns the times in which the gaps along axes close at the rate of the centers' velocities. Of gaps that open, the
/// wider one gets the longer time.
#[inline(always)]
fn closing_time<L: Simd>(axis: &AxesX8<L>, velocity: Vec3x8<L>, required_gap: f32) -> f32x8<L> {
    (axis.across.gap - required_gap) / axis.n.dot(velocity).max(LEAST_CLOSING_RATE)
}

/// Returns the axis between the centers at their time of nearest approach within `remaining_time`, for straight paths.
#[cfg_attr(inline_kernels, inline(always))]
pub(crate) fn closest_approach_axis<L: Simd, C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    offset: Vec3x8<L>,
    velocity: Vec3x8<L>,
    remaining_time: f32,
) -> AxesX8<L> {
    let nearest = offset.dot(velocity) / velocity.dot(velocity).max(LEAST_DIVISOR);
    let nearest = nearest.min(remaining_time).max(0.0);
    unit_axes_and_gaps(children, other, offset, offset - velocity * nearest)
}

/// Returns the axes along given vectors of any length, with the gaps along them.
///
/// The gaps are measured before the vectors are made unit vectors: a root and a quotient take as long as the
/// measurement.
#[cfg_attr(inline_kernels, inline(always))]
pub(crate) fn unit_axes_and_gaps<L: Simd, C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    offset: Vec3x8<L>,
    v: Vec3x8<L>,
) -> AxesX8<L> {
    let across = GapAndExtents::new(
        v.dot(offset),
        children.extent_along(v),
        other.extent_along(v),
    );
    let unit = v.reciprocal_length();
    AxesX8 {
        n: v * unit,
        across: GapAndExtents {
            gap: across.gap * unit,
            child_extent: across.child_extent * unit,
            other_extent: across.other_extent * unit,
        },
    }
}

/// Axes that point along the offset between two nodes, and the offset along them.
#[derive(Clone, Copy)]
pub(crate) struct OrientedAxes<L: Simd> {
    pub(crate) n: Vec3x8<L>,
    offset_along_axis: f32x8<L>,
}

impl<L: Simd> OrientedAxes<L> {
    /// Takes `n` or `−n`, whichever points along `offset`.
    #[inline(always)]
    pub(crate) fn new(n: Vec3x8<L>, offset: Vec3x8<L>) -> Self {
        let level = n.simd_level();
        let along = n.dot(offset);
        let sign = along
            .simd_lt(0.0)
            .select(splat(level, -1.0), splat(level, 1.0));
        OrientedAxes {
            n: n * sign,
            // To the bit, this is also the product with the oriented axis.
            offset_along_axis: along * sign,
        }
    }

    #[inline(always)]
    fn with_extents(self, child_extent: f32x8<L>, other_extent: f32x8<L>) -> AxesX8<L> {
        AxesX8 {
            n: self.n,
            across: GapAndExtents::new(self.offset_along_axis, child_extent, other_extent),
        }
    }
}
