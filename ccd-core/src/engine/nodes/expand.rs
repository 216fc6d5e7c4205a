//! Splits one node of a pair: bounds its children against the other node, with both bodies placed at the time of the
//! pair's clock.

use super::bounds::{EightPairFreeTimes, bound_eight_pairs};
use super::common::{NodeContext, QueryMotion};
use super::eight_pairs::{BodyRotation, LargerBody, RelativeMotionF32};
use super::shape::{Children, OtherBox, OtherNode, OtherTriangle};
use super::siblings::Siblings;
use super::split::Split;
use crate::body::tree::{
    GroupHeader, LANES, Node, NodeChildren, NodeOrTriangle, is_thin_triangle, round_up_to_f32,
    unit_normal,
};
use crate::math::order::greater;
use crate::math::simd::{PackedMatrix, PackedVector, as_vec3};
use crate::motion::kind::{
    AnyMotion, BothTurn, MotionKind, OtherBodyTurns, SplitBodyTurns, StandStill, Straight,
};
use crate::motion::relative::{RelativePath, RelativeState};
use crate::problem::BodyWithPath;
use crate::rounding::{GAP_ERROR_PER_DISTANCE_F32, GAP_ERROR_PER_RADIUS_F32, UNIT_ROUNDOFF_F32};
use crate::vectorize;
use fearless_simd::{Simd, f32x4};
use glam::{DVec3, Vec3};
use std::marker::PhantomData;

/// Computes for how long each child of a node stays apart from the other node, from clock `s` on, by the kernel for
/// what moves in the query.
///
/// # Panics
/// When the node is a single piece.
#[inline]
pub(crate) fn expand(common: &NodeContext<'_>, split: &Split, s: f64) -> Siblings {
    match common.motion {
        QueryMotion::OneTurns(body) if body == split.body => {
            bound_children_of_kind::<SplitBodyTurns>(common, split, s)
        }
        QueryMotion::OneTurns(_) => bound_children_of_kind::<OtherBodyTurns>(common, split, s),
        QueryMotion::NeitherTurns => bound_children_of_kind::<Straight>(common, split, s),
        QueryMotion::BothTurn => bound_children_of_kind::<BothTurn>(common, split, s),
        QueryMotion::Accelerates => bound_children_of_kind::<AnyMotion>(common, split, s),
    }
}

/// Computes lower bounds of the distances of the children from the other node at clock `s`. They are returned as free
/// times.
///
/// # Panics
/// When the node is a single piece.
pub(crate) fn bound_child_distances(common: &NodeContext<'_>, split: &Split, s: f64) -> Siblings {
    bound_children_of_kind::<StandStill>(common, split, s).with_free_times_as_distances()
}

/// Computes the free times with the best vector instructions. This function alone contains the kernels, compiled once
/// for each set of instructions and kind of motion.
#[inline(never)]
fn bound_children_of_kind<K: MotionKind>(
    common: &NodeContext<'_>,
    split: &Split,
    s: f64,
) -> Siblings {
    vectorize!(common.problem.simd_level, level => bound_children_at_level::<_, K>(level, common, split, s))
}

#[inline(always)]
fn bound_children_at_level<L: Simd, K: MotionKind>(
    level: L,
    common: &NodeContext<'_>,
    split: &Split,
    s: f64,
) -> Siblings {
    let motion = RelativeMotion::<L, K>::new(level, common, split, s);
    let body = motion.split_body.body;
    let tree = body.tree();
    let NodeOrTriangle::Node(node) = tree.get(split.node) else {
        unreachable!("a triangle is a single piece");
    };
    let (bounds, first) = match node.children {
        NodeChildren::Boxes(group) => {
            let group = tree.box_group(group);
            let members = &group.header;
            (motion.bound_group(group, members), members.first_child)
        }
        NodeChildren::Triangles(group) => {
            let group = &tree.triangle_group(level, group, body.pieces());
            let members = &group.header;
            (motion.bound_group(group, members), members.first_child)
        }
        NodeChildren::Piece(_) => unreachable!("a single piece has no children"),
    };
    Siblings::new(&bounds, first, *split, s)
}

/// The relative motion of the two bodies at a clock, in the frame of the body whose node is split.
struct RelativeMotion<'p, L: Simd, K> {
    simd_level: L,
    node_context: &'p NodeContext<'p>,
    split: &'p Split,
    split_body: &'p BodyWithPath<'p>,
    other_body: &'p BodyWithPath<'p>,
    /// The other body's present pose and motion in the split body's frame.
    relative_state: RelativeState<L>,
    relative_path: &'p RelativePath,
    /// The time left to the end of the duration.
    horizon: f32,
    kind: PhantomData<K>,
}

impl<'p, L: Simd, K: MotionKind> RelativeMotion<'p, L, K> {
    // The struct is half a kilobyte, made once a visit. It is built in place, not moved.
    #[inline(always)]
    fn new(level: L, common: &'p NodeContext<'_>, split: &'p Split, s: f64) -> Self {
        let view = common.relative_path_from(split.body);
        RelativeMotion {
            simd_level: level,
            node_context: common,
            split,
            split_body: split.body.body_in_problem(common.problem),
            other_body: split.body.other().body_in_problem(common.problem),
            relative_state: view.state_at::<L, K>(level, s),
            relative_path: view,
            horizon: (1.0 - s) as f32,
            kind: PhantomData,
        }
    }

    /// Computes the free times of the children in a group against the other body's node.
    #[inline(always)]
    fn bound_group<C: Children>(&self, group: &C, members: &GroupHeader) -> EightPairFreeTimes {
        let RelativeState {
            rotation, offset, ..
        } = self.relative_state;
        let center = self.relative_path.rotation_center(self.simd_level)
            - PackedVector::new(self.simd_level, members.origin);
        let other_center = center + offset;
        let group_view = GroupMotion {
            rotation,
            rotation_f32: rotation.narrow(),
            rotation_center: center.as_vec3(),
            other_rotation_center: other_center,
            motion: self,
            header: members,
        };
        match self.other_body.body.tree().get(self.split.other_node) {
            NodeOrTriangle::Node(node) => group_view.bound(group, &group_view.other_box(node)),
            NodeOrTriangle::Triangle(piece) => {
                let corners = self.other_body.body.pieces().triangle(piece as usize);
                group_view.bound(group, &group_view.other_triangle(corners))
            }
        }
    }
}

/// The relative motion in coordinates about the origin of a group.
struct GroupMotion<'m, L: Simd, K> {
    motion: &'m RelativeMotion<'m, L, K>,
    header: &'m GroupHeader,
    /// The rotation from the other body's frame to the split body's frame.
    rotation: PackedMatrix<L>,
    /// The same rotation in f32, by columns.
    rotation_f32: [f32x4<L>; 3],
    /// The center of rotation of the split body, relative to the group's origin.
    rotation_center: Vec3,
    other_rotation_center: PackedVector<L>,
}

impl<L: Simd, K: MotionKind> GroupMotion<'_, L, K> {
    #[inline(always)]
    fn bound<C: Children, P: OtherNode>(&self, group: &C, other: &P) -> EightPairFreeTimes {
        let motion = if K::STANDS_STILL {
            self.unit_closing_rate_motion(other.center(), other.radius())
        } else {
            self.motion_in_f32(other.center(), other.radius())
        };
        let lanes = self.motion.split.lane_mask & u8::MAX >> (LANES as u32 - self.header.count);
        bound_eight_pairs(self.motion.simd_level, group, other, &motion, lanes)
    }

    #[inline(always)]
    fn other_box(&self, node: &Node) -> OtherBox {
        let [u, v, w] = node.axes;
        OtherBox {
            center: self.to_group_point(node.center).as_vec3(),
            axes: [
                self.to_group_vector(u),
                self.to_group_vector(v),
                self.to_group_vector(w),
            ],
            half_extents: node.half_extents,
            rounding_radius: node.rounding_radius,
            radius: node.radius,
            is_piece: matches!(node.children, NodeChildren::Piece(_)),
        }
    }

    /// Transforms a point of the other body to the group's coordinates.
    #[inline(always)]
    fn to_group_point(&self, point: DVec3) -> PackedVector<L> {
        let level = self.motion.simd_level;
        let arm = PackedVector::new(level, point)
            - self.motion.relative_path.other_rotation_center(level);
        self.rotation * arm + self.other_rotation_center
    }

    #[inline(always)]
    fn to_group_vector(&self, v: Vec3) -> Vec3 {
        let [x, y, z] = self.rotation_f32;
        as_vec3(x * v.x + y * v.y + z * v.z)
    }

    #[inline(always)]
    fn other_triangle(&self, [a, b, c]: [DVec3; 3]) -> OtherTriangle {
        let (a, b, c) = (
            self.to_group_point(a),
            self.to_group_point(b),
            self.to_group_point(c),
        );
        let center = (a + b + c) * (1.0 / 3.0);
        let (p, q, r) = (a - center, b - center, c - center);
        let corners = [p.to_dvec3(), q.to_dvec3(), r.to_dvec3()];
        let [from_p, from_q, from_r] = corners.map(DVec3::length_squared);
        let farthest = greater(greater(from_p, from_q), from_r);
        OtherTriangle {
            center: center.as_vec3(),
            corners: [p.as_vec3(), q.as_vec3(), r.as_vec3()],
            normal: unit_normal(corners),
            is_thin: is_thin_triangle(corners),
            radius: round_up_to_f32(farthest.sqrt()).next_up(),
        }
    }

    #[inline(always)]
    fn split_body_rotation(&self) -> BodyRotation {
        let spin = self.motion.node_context.spin(self.motion.split.body);
        if K::SPLIT_BODY.resolve(spin.is_turning()) {
            BodyRotation {
                is_turning: true,
                spin: spin.angular_velocity,
                angular_speed: spin.angular_speed,
                rotation_center: self.rotation_center,
            }
        } else {
            BodyRotation::NO_ROTATION
        }
    }

    #[inline(always)]
    fn other_rotation(&self) -> BodyRotation {
        let other = self.motion.split.body.other();
        let spin = self.motion.node_context.spin(other);
        if K::OTHER_BODY.resolve(spin.is_turning()) {
            BodyRotation {
                is_turning: true,
                spin: self.motion.relative_state.spin.as_vec3(),
                angular_speed: spin.angular_speed,
                rotation_center: self.other_rotation_center.as_vec3(),
            }
        } else {
            BodyRotation::NO_ROTATION
        }
    }

    /// Returns the relative motion in f32, with allowances for rounding against a node of this center and radius.
    #[inline(always)]
    fn motion_in_f32(&self, center: Vec3, radius: f32) -> RelativeMotionF32 {
        let (split, other) = (self.split_body_rotation(), self.other_rotation());
        let reach = self.header.max_distance_from_origin;
        let common = self.motion.node_context;
        let rounding = self.rounding(center, radius);
        // Large nodes, whose gaps have a rounding above the rest of the tolerance, keep the gap of pieces.
        let slack = greater(
            round_up_positive(common.kept_gap + rounding),
            common.guaranteed_node_gap,
        );
        RelativeMotionF32 {
            velocity: self.motion.relative_state.velocity.as_vec3(),
            acceleration: self
                .motion
                .relative_state
                .acceleration
                .map(|change| change.as_vec3()),
            split_body_rotation: split,
            other_rotation: other,
            remaining_time: self.motion.horizon,
            required_gap: slack,
            closed_gap_threshold: common.closed_gap_threshold,
            rate_allowance: common.rate_allowance,
            larger_body: if split.is_turning && reach > common.much_larger_ratio * radius {
                Some(LargerBody::BodyToSplit)
            } else if other.is_turning && radius > common.much_larger_ratio * reach {
                Some(LargerBody::OtherBody)
            } else {
                None
            },
        }
    }

    /// Returns a motion in which all gaps close at a rate of 1, so that free times are lower bounds of distances.
    #[inline(always)]
    fn unit_closing_rate_motion(&self, center: Vec3, radius: f32) -> RelativeMotionF32 {
        RelativeMotionF32 {
            velocity: Vec3::ZERO,
            acceleration: None,
            split_body_rotation: BodyRotation::NO_ROTATION,
            other_rotation: BodyRotation::NO_ROTATION,
            remaining_time: 0.0,
            required_gap: self.rounding(center, radius),
            closed_gap_threshold: 0.0,
            rate_allowance: 1.0,
            larger_body: None,
        }
    }

    /// Returns a bound of the rounding of gaps to a node with this center and radius.
    #[inline(always)]
    fn rounding(&self, center: Vec3, radius: f32) -> f32 {
        let [x, y, z] = center.abs().to_array();
        let rounding = GAP_ERROR_PER_DISTANCE_F32 * (x + y + z)
            + GAP_ERROR_PER_RADIUS_F32 * (radius + self.header.max_distance_from_origin);
        round_up_positive(rounding + self.motion.node_context.rounding)
    }
}

/// Returns the next number above `x`, or the one after it, as much as a sum rounds. `x` is positive. Of numbers so small
/// that they are returned unchanged, sums are exact. In contrast to [`f32::next_up`], this is one instruction.
#[inline(always)]
fn round_up_positive(x: f32) -> f32 {
    x * (1.0 + 2.0 * UNIT_ROUNDOFF_F32)
}

#[cfg(test)]
mod tests;
