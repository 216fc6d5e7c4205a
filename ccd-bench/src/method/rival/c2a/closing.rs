//! Bounds the closing speed of nodes of two moving bodies along a direction.

use crate::method::rival::swept_spheres::{GapBound, RssNodePair, RssTree, RssTreePair};
use crate::method::rival::{Placement, RivalMotion};
use ccd_core::glam::{DMat3, DVec3};

/// The motions of both bodies in the frame of body A at one time, from which the closing speed of nodes is bounded.
#[derive(Clone, Debug)]
pub(super) struct ClosingSpeedBounder {
    a: BodyRotation,
    b: BodyRotation,
    /// The velocity of A's center relative to B's, in the world frame.
    relative_velocity_world: DVec3,
    /// The velocity of A's center relative to B's, in A's frame.
    relative_velocity_in_a: DVec3,
    /// B's axis of rotation in the world frame.
    axis_b_world: DVec3,
    /// B's axis of rotation in A's frame.
    axis_b_in_a: DVec3,
}

/// The rotation of a body, and the distances of its nodes from the axis.
#[derive(Clone, Debug)]
struct BodyRotation {
    rotation_center: DVec3,
    /// The unit axis of rotation in the body's frame, where it is fixed.
    axis: DVec3,
    angular_speed: f64,
    /// A cache with one entry per node: the number of the motion, and the greatest distance of the node's points from
    /// that motion's axis.
    axis_distance_cache: Vec<(u64, f64)>,
    axis_version: u64,
}

impl ClosingSpeedBounder {
    pub(super) fn new(trees: &RssTreePair) -> Self {
        ClosingSpeedBounder {
            a: BodyRotation::new(&trees.a),
            b: BodyRotation::new(&trees.b),
            relative_velocity_world: DVec3::ZERO,
            relative_velocity_in_a: DVec3::ZERO,
            axis_b_world: DVec3::Z,
            axis_b_in_a: DVec3::Z,
        }
    }

    /// Sets the motions of both bodies in a query.
    pub(super) fn set_motions(&mut self, a: &RivalMotion, b: &RivalMotion) {
        self.a.set_motion(a);
        self.b.set_motion(b);
        self.relative_velocity_world = a.velocity - b.velocity;
        self.axis_b_world = b.axis;
    }

    /// Sets the placement of body A at the current time, and converts the motions to A's frame.
    pub(super) fn set_placement_a(&mut self, frame_a: &Placement) {
        let to_a: DMat3 = frame_a.rotation.transpose();
        self.relative_velocity_in_a = to_a * self.relative_velocity_world;
        self.axis_b_in_a = to_a * self.axis_b_world;
    }

    /// Returns a time during which two nodes, and the triangles in them, do not touch. It is the time to close their
    /// gap along its direction, which is fixed, at the speed
    ///
    /// `v·n + |n × ω_A| l_A + |n × ω_B| l_B`
    ///
    /// of the centers and of points at the ends of both levers \[C2A09 §4\]. It holds for turns of
    /// any size, since the distance of a point from the axis does not change.
    #[inline]
    pub(super) fn safe_step(
        &mut self,
        trees: &RssTreePair,
        pair: &RssNodePair,
        gap: &GapBound,
    ) -> f64 {
        if !(gap.distance_bound > 0.0) {
            return 0.0;
        }
        let n = gap.gap_direction;
        let speed = self.relative_velocity_in_a.dot(n)
            + self
                .a
                .rotational_speed_bound(&trees.a, pair.a, n.cross(self.a.axis))
            + self
                .b
                .rotational_speed_bound(&trees.b, pair.b, n.cross(self.axis_b_in_a));
        if speed <= 0.0 {
            f64::INFINITY
        } else {
            gap.distance_bound / speed
        }
    }
}

impl BodyRotation {
    fn new(tree: &RssTree) -> Self {
        BodyRotation {
            rotation_center: DVec3::ZERO,
            axis: DVec3::Z,
            angular_speed: 0.0,
            axis_distance_cache: vec![(0, 0.0); tree.node_count()],
            axis_version: 0,
        }
    }

    fn set_motion(&mut self, course: &RivalMotion) {
        let axis = course.start_orientation.transpose() * course.axis;
        self.angular_speed = course.angular_speed;
        if self.axis_version == 0 || axis != self.axis || course.center != self.rotation_center {
            self.axis = axis;
            self.rotation_center = course.center;
            self.axis_version += 1;
        }
    }

    /// Returns an upper bound of the speed of a node's points along a direction, due to rotation. `across` is the cross
    /// product of the direction with the axis.
    #[inline]
    fn rotational_speed_bound(&mut self, tree: &RssTree, node: u32, across: DVec3) -> f64 {
        if self.angular_speed == 0.0 {
            return 0.0;
        }
        let lever = &mut self.axis_distance_cache[node as usize];
        if lever.0 != self.axis_version {
            *lever = (
                self.axis_version,
                tree.axis_distance_bound(node, self.rotation_center, self.axis),
            );
        }
        self.angular_speed * across.length() * lever.1
    }
}
