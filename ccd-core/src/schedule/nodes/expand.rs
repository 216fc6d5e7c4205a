//! Splits one node of a pair and bounds its children against the other node, at the pose of the
//! pair's clock.

use super::bounds::Bounds;
use super::bounds::bound;
use super::eight_pairs::{Larger, RelativeMotionF32};
use super::shape::{Children, OtherBox, OtherNode, OtherTriangle};
use super::turn::Turning;
use super::turn::{Straight, Turn};
use crate::body::tree::{Below, LANES, Members, Named, Node, NodeId, unit_normal, up};
use crate::math::order::greater;
use crate::motion::pose::Frame;
use crate::problem::{Problem, Side, Which};
use crate::tolerance::{
    CLOSED_GAP, LEAST_GAP_F32, MUCH_LARGER, PLACES_F32, RATE_F32, REACH_F32, WAY_F32,
};
use glam::{DMat3, DVec3, Vec3};

/// The children of the split node, each paired with the other node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    pub(crate) bounds: Bounds,
    pub(crate) first: NodeId,
}

/// A node to be split, and the other body's node that its children are paired with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    /// The body of the split node.
    pub(crate) body: Which,
    pub(crate) node: NodeId,
    pub(crate) other: NodeId,
    /// The children to be paired.
    pub(crate) lanes: u8,
}

impl Split {
    /// Creates a split with all children.
    pub(crate) fn all(body: Which, node: NodeId, other: NodeId) -> Self {
        Split {
            body,
            node,
            other,
            lanes: u8::MAX,
        }
    }
}

/// Splits a node at clock `s`.
///
/// # Panics
/// When the node is a single piece.
pub(crate) fn expand(problem: &Problem<'_>, split: &Split, s: f64) -> Expansion {
    split_node::<AsTheyMove>(&RelativeMotion::new(problem, split, s), split.node)
}

/// Splits a node at the start and measures its pairs: their free times are lower bounds of their
/// distances.
///
/// # Panics
/// When the node is a single piece.
pub(crate) fn measure(problem: &Problem<'_>, split: &Split) -> Expansion {
    split_node::<UnitRate>(&RelativeMotion::new(problem, split, 0.0), split.node)
}

#[inline(always)]
fn split_node<P: Pace>(motion: &RelativeMotion<'_>, node: NodeId) -> Expansion {
    let body = motion.split_side.body;
    let tree = body.tree();
    let Named::Node(node) = tree.get(node) else {
        unreachable!("a triangle is a single piece");
    };
    let (bounds, first) = match node.below {
        Below::Boxes(group) => {
            let group = tree.box_group(group);
            let members = &group.members;
            (motion.bound::<_, P>(group, members), members.first)
        }
        Below::Triangles(group) => {
            let group = &tree.triangle_group(group, body.pieces());
            let members = &group.members;
            (motion.bound::<_, P>(group, members), members.first)
        }
        Below::Piece(_) => unreachable!("a single piece has no children"),
    };
    Expansion { bounds, first }
}

/// The relative motion of the two bodies at a clock, along the axes of the body whose node is
/// split.
struct RelativeMotion<'p> {
    problem: &'p Problem<'p>,
    split_side: &'p Side<'p>,
    other_side: &'p Side<'p>,
    /// The other body's node.
    other: NodeId,
    /// The children to be paired with it.
    lanes: u8,
    other_to_split: Frame,
    /// The velocity of the split body's centre minus that of the other one's.
    velocity: DVec3,
    /// The angular velocity of the other body.
    other_spin: DVec3,
    /// The time left.
    horizon: f32,
}

/// The rate at which gaps close.
trait Pace {
    /// Bounds the time for which members of a group keep apart from the other body's node.
    fn bound<C: Children, O: OtherNode>(view: &GroupView<'_>, group: &C, other: &O) -> Bounds;
}

/// The bodies' motion.
struct AsTheyMove;

/// A rate of one unit of length per unit of time, along every axis: the free time is the distance.
struct UnitRate;

impl Pace for AsTheyMove {
    #[inline]
    fn bound<C: Children, O: OtherNode>(view: &GroupView<'_>, group: &C, other: &O) -> Bounds {
        view.bound(group, other)
    }
}

impl Pace for UnitRate {
    fn bound<C: Children, O: OtherNode>(view: &GroupView<'_>, group: &C, other: &O) -> Bounds {
        view.distances(group, other)
    }
}

impl<'p> RelativeMotion<'p> {
    // Half of a kilobyte, made once a visit: built in place, not moved.
    #[inline(always)]
    fn new(problem: &'p Problem<'_>, split: &Split, s: f64) -> Self {
        let (split_side, other_side) = (split.body.of(problem), split.body.other().of(problem));
        let (split_frame, other_frame) = (split_side.path.frame(s), other_side.path.frame(s));
        RelativeMotion {
            problem,
            split_side,
            other_side,
            other: split.other,
            lanes: split.lanes,
            other_to_split: split_frame.from_frame(&other_frame),
            velocity: split_frame
                .inverse_vector(split_side.path.velocity - other_side.path.velocity),
            other_spin: split_frame.inverse_vector(other_side.path.spin),
            horizon: (1.0 - s) as f32,
        }
    }

    /// Bounds a group of the split body against the other body's node.
    #[inline]
    fn bound<C: Children, P: Pace>(&self, group: &C, members: &Members) -> Bounds {
        let mut other_to_split = self.other_to_split;
        other_to_split.translation -= members.origin;
        let view = GroupView {
            turn: columns(&other_to_split.rotation),
            other_to_split,
            motion: self,
            members,
        };
        match self.other_side.body.tree().get(self.other) {
            Named::Node(node) => P::bound(&view, group, &view.node(node)),
            Named::Triangle(piece) => {
                let corners = self.other_side.body.pieces().triangle(piece as usize);
                P::bound(&view, group, &view.triangle(corners))
            }
        }
    }
}

/// The relative motion as seen from a group of the split body.
struct GroupView<'m> {
    motion: &'m RelativeMotion<'m>,
    members: &'m Members,
    /// Relative to the group's origin.
    other_to_split: Frame,
    /// The same rotation in f32, by columns.
    turn: [Vec3; 3],
}

impl GroupView<'_> {
    fn bound<C: Children, P: OtherNode>(&self, group: &C, other: &P) -> Bounds {
        let split_turn = || self.split_turning();
        let other_turn = || self.other_turning();
        let sides = [self.motion.split_side, self.motion.other_side];
        match sides.map(|side| side.path.turns()) {
            [false, false] => self.turning(group, other, Straight, Straight),
            [true, false] => self.turning(group, other, split_turn(), Straight),
            [false, true] => self.turning(group, other, Straight, other_turn()),
            [true, true] => self.turning(group, other, split_turn(), other_turn()),
        }
    }

    fn node(&self, node: &Node) -> OtherBox {
        OtherBox {
            centre: self.other_to_split.point(node.centre).as_vec3(),
            axes: node
                .axes
                .map(|u| self.turn[0] * u.x + self.turn[1] * u.y + self.turn[2] * u.z),
            half: node.half,
            rounding: node.rounding,
            radius: node.radius,
            piece: matches!(node.below, Below::Piece(_)),
        }
    }

    fn triangle(&self, corners: [DVec3; 3]) -> OtherTriangle {
        let corners = corners.map(|p| self.other_to_split.point(p));
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let arms = corners.map(|p| p - centre);
        let farthest = arms.map(|arm| arm.length_squared());
        OtherTriangle {
            centre: centre.as_vec3(),
            corners: arms.map(DVec3::as_vec3),
            normal: unit_normal(corners),
            radius: up(farthest.into_iter().fold(0.0, greater).sqrt()).next_up(),
        }
    }

    fn split_turning(&self) -> Turning {
        let path = &self.motion.split_side.path;
        Turning {
            spin: path.spin_local.as_vec3(),
            rate: up(path.rate),
            centre: (path.centre - self.members.origin).as_vec3(),
        }
    }

    fn other_turning(&self) -> Turning {
        let path = &self.motion.other_side.path;
        Turning {
            spin: self.motion.other_spin.as_vec3(),
            rate: up(path.rate),
            centre: self.other_to_split.point(path.centre).as_vec3(),
        }
    }

    fn turning<C: Children, P: OtherNode, S: Turn, O: Turn>(
        &self,
        group: &C,
        other: &P,
        split_turn: S,
        other_turn: O,
    ) -> Bounds {
        let velocity = self.motion.velocity.as_vec3();
        let reach = self.members.reach;
        // An arm is the difference of two positions, each rounded in its place.
        let places = other.centre().length() + other_turn.arm(Vec3::ZERO);
        let speed = velocity.length()
            + split_turn.rate() * (reach + split_turn.arm(Vec3::ZERO))
            + other_turn.rate()
                * (other.radius() + other_turn.arm(other.centre()) + PLACES_F32 * places);
        let problem = self.motion.problem;
        let rounding = self.rounding(other);
        let slack = greater(
            (up(problem.margin) + rounding).next_up(),
            up(problem.node_gap()),
        );
        let closed = (CLOSED_GAP * problem.tolerance) as f32;
        let motion = RelativeMotionF32 {
            velocity,
            split: split_turn,
            other: other_turn,
            horizon: self.motion.horizon,
            slack,
            kept: (slack - rounding).next_down(),
            closed: greater(LEAST_GAP_F32, closed),
            rate_slack: RATE_F32 * speed,
            larger: if reach > MUCH_LARGER * other.radius() {
                Some(Larger::Split)
            } else if other.radius() > MUCH_LARGER * reach {
                Some(Larger::Other)
            } else {
                None
            },
        };
        bound(problem.level, group, other, &motion, self.lanes())
    }

    /// Returns the lanes of children that are to be paired.
    fn lanes(&self) -> u8 {
        self.motion.lanes & u8::MAX >> (LANES as u32 - self.members.count)
    }

    /// Returns lower bounds of distances: the times for which pairs keep apart at a closing rate of
    /// 1.
    fn distances<C: Children, P: OtherNode>(&self, group: &C, other: &P) -> Bounds {
        let rounding = self.rounding(other);
        let motion = RelativeMotionF32 {
            velocity: Vec3::ZERO,
            split: Straight,
            other: Straight,
            horizon: 0.0,
            slack: rounding,
            kept: 0.0,
            closed: 0.0,
            rate_slack: 1.0,
            larger: None,
        };
        Bounds {
            // A second look would give the same result.
            waits: 0,
            ..bound(
                self.motion.problem.level,
                group,
                other,
                &motion,
                self.lanes(),
            )
        }
    }

    /// Bounds the rounding of a gap.
    fn rounding<P: OtherNode>(&self, other: &P) -> f32 {
        let [x, y, z] = other.centre().abs().to_array();
        let rounding = WAY_F32 * (x + y + z) + REACH_F32 * (other.radius() + self.members.reach);
        (rounding + up(self.motion.problem.rounding)).next_up()
    }
}

fn columns(matrix: &DMat3) -> [Vec3; 3] {
    [
        matrix.x_axis.as_vec3(),
        matrix.y_axis.as_vec3(),
        matrix.z_axis.as_vec3(),
    ]
}

#[cfg(test)]
mod tests;
