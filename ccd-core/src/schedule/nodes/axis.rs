//! Separating axes of two nodes.

use super::shape::{Children, OtherNode};
use super::vector_f32::{TINY, choose, dot, max, min, unit};
use glam::Vec3;

/// An axis, the gap along it, and each side's reach towards the other.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    pub(super) n: Vec3,
    pub(super) gap: f32,
    pub(super) split_reach: f32,
    pub(super) other_reach: f32,
}

/// Returns the best of three axes: the one between the centres, or the edges of triangles, and the
/// two nodes' own normals.
///
/// Homogeneous in the axis: a zero vector gives no gap, and any other length gives a sound one.
#[inline(always)]
pub(super) fn widest<C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    lane: usize,
    way: Vec3,
) -> Axis {
    let ahead = other.near(children.centre(lane));
    let between = unit(ahead - children.near(lane, ahead));
    let between = along(children, other, lane, way, between);
    let own = towards(children.normal(lane), way);
    let others = towards(other.normal(), way);
    better(
        better(between, along(children, other, lane, way, own)),
        along(children, other, lane, way, others),
    )
}

/// Returns the axis between the centres when they are nearest, if they move on by at most `travel`.
#[inline(always)]
pub(super) fn passing<C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    lane: usize,
    way: Vec3,
    travel: Vec3,
) -> Axis {
    let nearest = dot(way, travel) / max(dot(travel, travel), TINY);
    let nearest = max(min(nearest, 1.0), 0.0);
    along(children, other, lane, way, unit(way - travel * nearest))
}

#[inline(always)]
fn along<C: Children, P: OtherNode>(
    children: &C,
    other: &P,
    lane: usize,
    way: Vec3,
    n: Vec3,
) -> Axis {
    let split_reach = children.reach(lane, n);
    let other_reach = other.reach(n);
    Axis {
        n,
        gap: dot(n, way) - split_reach - other_reach,
        split_reach,
        other_reach,
    }
}

/// Returns `n` or `−n`, whichever points along `way`.
#[inline(always)]
fn towards(n: Vec3, way: Vec3) -> Vec3 {
    let sign = if dot(n, way) < 0.0 { -1.0 } else { 1.0 };
    n * sign
}

#[inline(always)]
fn better(a: Axis, b: Axis) -> Axis {
    let pick = b.gap > a.gap;
    Axis {
        n: Vec3::new(
            choose(pick, b.n.x, a.n.x),
            choose(pick, b.n.y, a.n.y),
            choose(pick, b.n.z, a.n.z),
        ),
        gap: choose(pick, b.gap, a.gap),
        split_reach: choose(pick, b.split_reach, a.split_reach),
        other_reach: choose(pick, b.other_reach, a.other_reach),
    }
}
