//! The checker's lemmas in floating point: bounds of the heights and distances of parts over an interval of time.

use crate::link_motion::{LinkMotion, rotation_by};
use crate::scene::Scene;
use crate::tolerances::{MAX_TURN, SECOND_DERIVATIVE_FACTOR};
use crate::tree::{Part, Tree};
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::lesser;

/// The pose of a link at the middle of an interval, and its motion on its parent over half of the interval. All vectors are
/// along the axes of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkState {
    parent: usize,
    /// The position of the center of the link.
    pub(crate) center: DVec3,
    pub(crate) rotation: DMat3,
    /// The vector from the center of the parent to the center of the link.
    arm: DVec3,
    /// The change of the arm on the parent over half of the interval.
    arm_change: DVec3,
    /// The rotation vector of the joint over half of the interval.
    turn: DVec3,
}

/// Returns the states of the world and all links for the interval of time with this middle and half-length.
pub(crate) fn link_states(motions: &[LinkMotion], middle: f64, half: f64) -> Vec<LinkState> {
    let mut states: Vec<LinkState> = Vec::with_capacity(motions.len());
    for motion in motions {
        let (center, rotation) = states
            .get(motion.parent)
            .map_or((DVec3::ZERO, DMat3::IDENTITY), |parent| {
                (parent.center, parent.rotation)
            });
        let arm = rotation * (motion.arm + motion.velocity * middle);
        let [arm_change, turn] =
            [motion.velocity, motion.angular_velocity].map(|rate| rotation * (rate * half));
        let joint_rotation = rotation_by(motion.angular_velocity * middle);
        states.push(LinkState {
            parent: motion.parent,
            center: center + arm,
            rotation: rotation * joint_rotation * motion.rotation,
            arm,
            arm_change,
            turn,
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
    turn: DVec3,
    /// The sum of the angles of all joints on the path between both links.
    angle: f64,
    /// An upper bound of the second derivative of the vector between the centers.
    center_second_derivative: f64,
}

impl RelativeMotion {
    /// Computes the motion of the link `to` relative to the link `from`.
    fn new(links: &[LinkState], from: usize, to: usize) -> RelativeMotion {
        let mut motion = RelativeMotion::default();
        let (mut left, mut entered, mut path) = (from, to, Vec::new());
        while left != entered {
            if left > entered {
                let link = &links[left];
                motion.add_turn(-link.turn);
                motion.add_arm(-link.arm, -link.arm_change);
                left = link.parent;
            } else {
                path.push(entered);
                entered = links[entered].parent;
            }
        }
        for link in path.into_iter().rev().map(|k| &links[k]) {
            motion.add_arm(link.arm, link.arm_change);
            motion.add_turn(link.turn);
        }
        motion
    }

    /// Returns whether both links are static relative to each other.
    fn is_static(&self) -> bool {
        self.angle == 0.0 && self.displacement == DVec3::ZERO
    }

    /// Returns whether the joints turn so little that the lemmas apply.
    fn is_within_max_turn(&self) -> bool {
        self.angle < MAX_TURN
    }

    /// Returns an upper bound of the second derivative of a point that the link carries at a distance of `reach` from its center.
    /// Returns infinity if the joints turn too far for the lemmas.
    fn second_derivative(&self, reach: f64) -> f64 {
        if self.is_within_max_turn() {
            self.center_second_derivative + self.angle * self.angle * reach
        } else {
            f64::INFINITY
        }
    }

    fn add_turn(&mut self, turn: DVec3) {
        self.angle += turn.length();
        self.turn += turn;
    }

    fn add_arm(&mut self, arm: DVec3, arm_change: DVec3) {
        self.displacement += arm_change + self.turn.cross(arm);
        let (angle, rate) = (self.angle, arm_change.length());
        self.center_second_derivative += angle * (angle * (arm.length() + rate) + 2.0 * rate);
    }
}

/// A plane through the center of its frame, moved by an offset that is given elsewhere.
#[derive(Clone, Copy)]
pub(crate) struct PlaneDirection {
    /// The normal, along the axes of the world at the middle of the interval. It points from A to B.
    pub(crate) normal: DVec3,
    /// The frame with which the plane turns: 0 is the world, 1 is A, 2 is B.
    pub(crate) frame: usize,
}

/// A pair of bodies over an interval of time.
pub(crate) struct PairInterval<'a> {
    pub(crate) start: f64,
    pub(crate) end: f64,
    pub(crate) trees: [&'a Tree; 2],
    /// The center of each body's link, in the frame of that link.
    centers: [DVec3; 2],
    /// The states of both bodies' links.
    states: [LinkState; 2],
    /// The vector from the center of A's link to the center of B's link.
    pub(crate) offset: DVec3,
    /// The motions of A and B, relative to the world, to A, and to B.
    motions: [[RelativeMotion; 2]; 3],
}

/// A lower bound that one end of the interval requires of the heights of a part.
struct HeightBound {
    direction: DVec3,
    /// The height along `direction` that the part has to have above the offset of the plane.
    required_height: f64,
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
            centers: [a, b].map(|link| link_motions[link].screw.center),
            states: pair_states,
            offset: pair_states[1].center - pair_states[0].center,
            motions: [0, a, b].map(|from| [a, b].map(|to| RelativeMotion::new(states, from, to))),
        }
    }

    /// Returns the least and the greatest offset of a plane that separates two parts over the interval, with at least
    /// `required_gap` on either side. The offset is relative to the center of the plane's frame. No plane separates the parts if
    /// the least offset is above the greatest.
    pub(crate) fn offset_range(
        &self,
        parts: [Part; 2],
        plane: PlaneDirection,
        required_gap: f64,
    ) -> [f64; 2] {
        let [below, above] = [-1.0, 1.0].map(|side| {
            let k = usize::from(side > 0.0);
            let bounds = self.height_bounds((k, parts[k]), (side, plane), required_gap);
            let offsets = bounds.map(|bound| {
                self.trees[k].least_height(parts[k], bound.direction) - bound.required_height
            });
            offsets.fold(f64::INFINITY, lesser)
        });
        [-below, above]
    }

    /// Returns the number of boxes and triangles that the checker visits to confirm that a plane separates the parts.
    pub(crate) fn plane_visits(
        &self,
        parts: [Part; 2],
        plane: PlaneDirection,
        required_gap: f64,
        offset: f64,
    ) -> usize {
        let sides = [-1.0, 1.0].into_iter().zip(0..2);
        sides
            .flat_map(|(side, k)| {
                let bounds = self.height_bounds((k, parts[k]), (side, plane), required_gap);
                bounds.map(move |bound| {
                    let limit = side * offset + bound.required_height;
                    self.trees[k].visits_above(parts[k], bound.direction, limit)
                })
            })
            .sum()
    }

    /// Returns the number of boxes that the checker visits to confirm that the part of the other body stays farther than `gap`
    /// from the bounding ball of the part of body `k`. Returns `None` if the checker cannot confirm it.
    pub(crate) fn ball_visits(&self, parts: [Part; 2], k: usize, gap: f64) -> Option<usize> {
        let other = 1 - k;
        let motion = &self.motions[1 + other][k];
        let (middle, radius) = self.trees[k].ball(parts[k]);
        let arm = self.states[k].rotation * (middle - self.centers[k]);
        let travel = (motion.displacement + motion.turn.cross(arm)).length()
            + 0.5 * motion.second_derivative(arm.length());
        let from_other = self.states[k].center - self.states[other].center + arm;
        let ball_center =
            self.states[other].rotation.transpose() * from_other + self.centers[other];
        let limit = radius + travel * SECOND_DERIVATIVE_FACTOR + gap;
        motion
            .is_within_max_turn()
            .then(|| self.trees[other].visits_beyond(parts[other], ball_center, limit))?
    }

    /// Returns the bounds that the ends of the interval require of the heights of a part, on one side of a plane. A part that has
    /// these heights stays farther than `required_gap` from the plane.
    fn height_bounds(
        &self,
        (k, part): (usize, Part),
        (side, PlaneDirection { normal, frame }): (f64, PlaneDirection),
        required_gap: f64,
    ) -> impl Iterator<Item = HeightBound> {
        let normal = side * normal;
        let (motion, state) = (&self.motions[frame][k], &self.states[k]);
        let second_derivative =
            motion.second_derivative(self.trees[k].reach(part, self.centers[k]));
        let frame_center = [DVec3::ZERO, self.states[0].center, self.states[1].center][frame];
        let at_middle = required_gap + 0.5 * second_derivative * SECOND_DERIVATIVE_FACTOR
            - normal.dot(state.center - frame_center);
        let ends: &[f64] = if motion.is_static() {
            &[0.0]
        } else {
            &[-1.0, 1.0]
        };
        ends.iter().map(move |&end| {
            let tilted = normal + end * normal.cross(motion.turn);
            let direction = state.rotation.transpose() * tilted;
            let required_height =
                at_middle + direction.dot(self.centers[k]) - end * normal.dot(motion.displacement);
            HeightBound {
                direction,
                required_height,
            }
        })
    }

    /// Returns whether the joints turn so little that the lemmas apply in at least one frame.
    pub(crate) fn is_within_max_turn(&self) -> bool {
        let mut motions = self.motions.iter();
        motions.any(|[a, b]| a.is_within_max_turn() && b.is_within_max_turn())
    }

    /// Returns whether body `k` is static in the world.
    pub(crate) fn is_static(&self, k: usize) -> bool {
        self.motions[0][k].is_static()
    }

    /// Returns the support point of the part of body `k` at the middle of the interval: the lowest vertex along `direction`,
    /// relative to the center of A's link, and its index.
    pub(crate) fn lowest_vertex(&self, k: usize, part: Part, direction: DVec3) -> (u32, DVec3) {
        let rotation = self.states[k].rotation;
        let (index, corner) = self.trees[k].lowest_corner(part, rotation.transpose() * direction);
        let arm = rotation * (corner - self.centers[k]);
        (index, if k == 0 { arm } else { self.offset + arm })
    }

    /// Estimates the relative displacement of two parts over half of the interval.
    pub(crate) fn relative_displacement(&self, parts: [Part; 2]) -> f64 {
        let [a, b] = &self.motions[0];
        let reach = |k: usize| self.trees[k].reach(parts[k], self.centers[k]);
        (b.displacement - a.displacement).length()
            + a.turn.length() * reach(0)
            + b.turn.length() * reach(1)
    }
}
