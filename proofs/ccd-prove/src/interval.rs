//! The checker's lemmas in binary64: bounds of the signed distances of tree nodes from planes, and of the distances between nodes,
//! over an interval of time.

use crate::link_motion::{LinkMotion, rotation_by};
use crate::scene::Scene;
use crate::tolerances::{MAX_ANGLE, SECOND_DERIVATIVE_FACTOR};
use crate::tree::{NodeIndex, Tree};
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::lesser;

/// The pose of a link at the middle of an interval, and its motion relative to its parent over half of the interval. The
/// coordinates of all vectors are along the axes of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkState {
    parent: usize,
    /// The position of the center of the link.
    pub(crate) center: DVec3,
    pub(crate) rotation: DMat3,
    /// The vector from the center of the parent to the center of the link.
    link_offset: DVec3,
    /// The change of the link offset over half of the interval.
    link_offset_change: DVec3,
    /// The rotation vector of the joint over half of the interval.
    rotation_vector: DVec3,
}

/// Returns the states of the world and of all links for the interval of time with this middle and half-length.
pub(crate) fn link_states(motions: &[LinkMotion], middle: f64, half: f64) -> Vec<LinkState> {
    let mut states: Vec<LinkState> = Vec::with_capacity(motions.len());
    for motion in motions {
        let (center, rotation) = states
            .get(motion.parent)
            .map_or((DVec3::ZERO, DMat3::IDENTITY), |parent| {
                (parent.center, parent.rotation)
            });
        let link_offset = rotation * (motion.link_offset + motion.velocity * middle);
        let [link_offset_change, rotation_vector] =
            [motion.velocity, motion.angular_velocity].map(|rate| rotation * (rate * half));
        let joint_rotation = rotation_by(motion.angular_velocity * middle);
        states.push(LinkState {
            parent: motion.parent,
            center: center + link_offset,
            rotation: rotation * joint_rotation * motion.rotation,
            link_offset,
            link_offset_change,
            rotation_vector,
        });
    }
    states
}

/// The motion of a link relative to another link over half of an interval.
#[derive(Default)]
struct RelativeMotion {
    /// The first-order change of the vector between the centers of both links.
    displacement: DVec3,
    /// The first-order rotation vector of the link.
    rotation_vector: DVec3,
    /// The sum of the angles of all joints on the path between both links.
    angle: f64,
    /// An upper bound of the second derivative of the vector between the centers.
    center_second_derivative: f64,
}

impl RelativeMotion {
    /// Computes the motion of the link `to` relative to the link `from`.
    fn new(links: &[LinkState], from: usize, to: usize) -> RelativeMotion {
        let mut motion = RelativeMotion::default();
        let (mut from_ancestor, mut to_ancestor, mut path_down) = (from, to, Vec::new());
        while from_ancestor != to_ancestor {
            if from_ancestor > to_ancestor {
                let link = &links[from_ancestor];
                motion.add_rotation(-link.rotation_vector);
                motion.add_offset(-link.link_offset, -link.link_offset_change);
                from_ancestor = link.parent;
            } else {
                path_down.push(to_ancestor);
                to_ancestor = links[to_ancestor].parent;
            }
        }
        for link in path_down.into_iter().rev().map(|k| &links[k]) {
            motion.add_offset(link.link_offset, link.link_offset_change);
            motion.add_rotation(link.rotation_vector);
        }
        motion
    }

    /// Returns whether both links are static relative to each other.
    fn is_static(&self) -> bool {
        self.angle == 0.0 && self.displacement == DVec3::ZERO
    }

    /// Returns whether the sum of the joint angles is so small that the lemmas apply.
    fn is_within_max_angle(&self) -> bool {
        self.angle < MAX_ANGLE
    }

    /// Returns an upper bound of the second derivative of a point on the link, at most `distance` from the link's center. Returns
    /// infinity if the sum of the joint angles is too large for the lemmas.
    fn second_derivative(&self, distance: f64) -> f64 {
        if self.is_within_max_angle() {
            self.center_second_derivative + self.angle * self.angle * distance
        } else {
            f64::INFINITY
        }
    }

    fn add_rotation(&mut self, rotation_vector: DVec3) {
        self.angle += rotation_vector.length();
        self.rotation_vector += rotation_vector;
    }

    fn add_offset(&mut self, offset: DVec3, offset_change: DVec3) {
        self.displacement += offset_change + self.rotation_vector.cross(offset);
        let (angle, rate) = (self.angle, offset_change.length());
        self.center_second_derivative += angle * (angle * (offset.length() + rate) + 2.0 * rate);
    }
}

/// The normal of a plane, and the frame with which it rotates.
#[derive(Clone, Copy)]
pub(crate) struct PlaneDirection {
    /// The normal, along the axes of the world at the middle of the interval. It points from A to B.
    pub(crate) normal: DVec3,
    /// The frame with which the plane rotates: 0 is the world, 1 is A, 2 is B.
    pub(crate) frame: usize,
}

/// The motion of a pair of bodies over an interval of time.
pub(crate) struct PairInterval<'a> {
    pub(crate) start: f64,
    pub(crate) end: f64,
    pub(crate) trees: [&'a Tree; 2],
    /// The center of each body's link, in the frame of that link.
    centers: [DVec3; 2],
    /// The states of both bodies' links.
    states: [LinkState; 2],
    /// The vector from the center of A's link to the center of B's link.
    pub(crate) center_offset: DVec3,
    /// The motions of A and B, relative to the world, to A, and to B.
    motions: [[RelativeMotion; 2]; 3],
}

/// The projection onto a direction that a node needs at least, at one end of the interval.
struct ProjectionBound {
    direction: DVec3,
    /// The required projection onto `direction`, minus the offset of the plane.
    min_projection: f64,
}

impl<'a> PairInterval<'a> {
    /// Computes the motion of a pair from the states of all links in the interval.
    pub(crate) fn new(
        (scene, link_motions): (&Scene<'a>, &[LinkMotion]),
        pair: usize,
        ([start, end], states): ([f64; 2], &[LinkState]),
    ) -> Self {
        let bodies = scene.pairs[pair].bodies.map(|body| scene.bodies[body]);
        let [a, b] = bodies.map(|body| body.link);
        let pair_states = [states[a], states[b]];
        PairInterval {
            start,
            end,
            trees: bodies.map(|body| &body.body.tree),
            centers: [a, b].map(|link| link_motions[link].encoded.center),
            states: pair_states,
            center_offset: pair_states[1].center - pair_states[0].center,
            motions: [0, a, b].map(|from| [a, b].map(|to| RelativeMotion::new(states, from, to))),
        }
    }

    /// Returns the least and the greatest offset of a plane that separates two nodes over the interval. Each node is then at least
    /// `required_gap` from the plane. The offset is relative to the center of the plane's frame. No plane separates the nodes if
    /// the least offset is above the greatest offset.
    pub(crate) fn offset_range(
        &self,
        nodes: [NodeIndex; 2],
        plane: PlaneDirection,
        required_gap: f64,
    ) -> [f64; 2] {
        let [below, above] = [-1.0, 1.0].map(|side| {
            let k = usize::from(side > 0.0);
            let bounds = self.projection_bounds((k, nodes[k]), (side, plane), required_gap);
            let offsets = bounds.map(|bound| {
                self.trees[k].min_projection(nodes[k], bound.direction) - bound.min_projection
            });
            offsets.fold(f64::INFINITY, lesser)
        });
        [-below, above]
    }

    /// Returns the number of boxes and triangles that the checker visits to confirm that a plane separates the nodes.
    pub(crate) fn plane_visits(
        &self,
        nodes: [NodeIndex; 2],
        plane: PlaneDirection,
        required_gap: f64,
        offset: f64,
    ) -> usize {
        let sides = [-1.0, 1.0].into_iter().zip(0..2);
        sides
            .flat_map(|(side, k)| {
                let bounds = self.projection_bounds((k, nodes[k]), (side, plane), required_gap);
                bounds.map(move |bound| {
                    let limit = side * offset + bound.min_projection;
                    self.trees[k].projection_visits(nodes[k], bound.direction, limit)
                })
            })
            .sum()
    }

    /// Returns the number of boxes that the checker visits to confirm a leaf with a ball: the node of the other body stays farther
    /// than `gap` from the bounding ball of the node of body `k`. Returns `None` if the checker cannot confirm the leaf.
    pub(crate) fn ball_visits(&self, nodes: [NodeIndex; 2], k: usize, gap: f64) -> Option<usize> {
        let other = 1 - k;
        let motion = &self.motions[1 + other][k];
        let (middle, radius) = self.trees[k].ball(nodes[k]);
        let ball_offset = self.states[k].rotation * (middle - self.centers[k]);
        let travel = (motion.displacement + motion.rotation_vector.cross(ball_offset)).length()
            + 0.5 * motion.second_derivative(ball_offset.length());
        let from_other_link = self.states[k].center - self.states[other].center + ball_offset;
        let ball_center =
            self.states[other].rotation.transpose() * from_other_link + self.centers[other];
        let limit = radius + travel * SECOND_DERIVATIVE_FACTOR + gap;
        motion
            .is_within_max_angle()
            .then(|| self.trees[other].distance_visits(nodes[other], ball_center, limit))?
    }

    /// Returns the projections that a node on one side of a plane needs at least, for each end of the interval. If it has them, it
    /// stays farther than `required_gap` from the plane.
    fn projection_bounds(
        &self,
        (k, node): (usize, NodeIndex),
        (side, PlaneDirection { normal, frame }): (f64, PlaneDirection),
        required_gap: f64,
    ) -> impl Iterator<Item = ProjectionBound> {
        let normal = side * normal;
        let (motion, state) = (&self.motions[frame][k], &self.states[k]);
        let second_derivative =
            motion.second_derivative(self.trees[k].max_distance(node, self.centers[k]));
        let frame_center = [DVec3::ZERO, self.states[0].center, self.states[1].center][frame];
        let at_middle = required_gap + 0.5 * second_derivative * SECOND_DERIVATIVE_FACTOR
            - normal.dot(state.center - frame_center);
        let ends: &[f64] = if motion.is_static() {
            &[0.0]
        } else {
            &[-1.0, 1.0]
        };
        ends.iter().map(move |&end| {
            let tilted = normal + end * normal.cross(motion.rotation_vector);
            let direction = state.rotation.transpose() * tilted;
            let min_projection =
                at_middle + direction.dot(self.centers[k]) - end * normal.dot(motion.displacement);
            ProjectionBound {
                direction,
                min_projection,
            }
        })
    }

    /// Returns whether the sums of the joint angles are so small that the lemmas apply in at least one frame.
    pub(crate) fn is_within_max_angle(&self) -> bool {
        let mut motions = self.motions.iter();
        motions.any(|[a, b]| a.is_within_max_angle() && b.is_within_max_angle())
    }

    /// Returns whether body `k` is static in the world.
    pub(crate) fn is_static(&self, k: usize) -> bool {
        self.motions[0][k].is_static()
    }

    /// Returns a support point of the node of body `k` at the middle of the interval: the index and the position of the vertex
    /// with the least projection onto `direction`. The position is relative to the center of A's link.
    pub(crate) fn support_vertex(
        &self,
        k: usize,
        node: NodeIndex,
        direction: DVec3,
    ) -> (u32, DVec3) {
        let rotation = self.states[k].rotation;
        let (index, corner) = self.trees[k].min_corner(node, rotation.transpose() * direction);
        let corner_offset = rotation * (corner - self.centers[k]);
        (
            index,
            if k == 0 {
                corner_offset
            } else {
                self.center_offset + corner_offset
            },
        )
    }

    /// Estimates the relative displacement of two nodes over half of the interval.
    pub(crate) fn relative_displacement(&self, nodes: [NodeIndex; 2]) -> f64 {
        let [a, b] = &self.motions[0];
        let max_distance = |k: usize| self.trees[k].max_distance(nodes[k], self.centers[k]);
        (b.displacement - a.displacement).length()
            + a.rotation_vector.length() * max_distance(0)
            + b.rotation_vector.length() * max_distance(1)
    }
}
