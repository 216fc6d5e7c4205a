//! Splitting one node of a pair: its children against the other node, at the pose of the pair's
//! clock.

use super::bounds::Bounds;
use super::bounds::{Larger, bound, bound_attached};
use super::eight_pairs::Closing;
use super::shape::{Children, Other, OtherBox, OtherTriangle};
use super::turn::Turning;
use super::turn::{Straight, Turn};
use crate::body::tree::{Below, LANES, Members, Named, Node, NodeId, unit_normal, up};
use crate::math::order::greater;
use crate::motion::pose::Frame;
use crate::problem::{Problem, Side};
use crate::tolerance::{
    CLOSED_GAP, LEAST_GAP_F32, MUCH_LARGER, PLACES_F32, RATE_F32, REACH_F32, WAY_F32,
};
use glam::{DMat3, DVec3, Vec3};

/// Which body a node belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Which {
    A,
    B,
}

impl Which {
    pub(crate) fn other(self) -> Which {
        match self {
            Which::A => Which::B,
            Which::B => Which::A,
        }
    }

    pub(crate) fn of<'p, 'a>(self, problem: &'p Problem<'a>) -> &'p Side<'a> {
        match self {
            Which::A => &problem.a,
            Which::B => &problem.b,
        }
    }
}

/// The children of the split node, each paired with the other node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    pub(crate) bounds: Bounds,
    pub(crate) first: NodeId,
    pub(crate) count: u32,
    /// Which children are single pieces.
    pub(crate) leaves: u8,
}

/// A node to be split, and the other body's node that its children are paired with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    /// Whose node is split.
    pub(crate) body: Which,
    pub(crate) node: NodeId,
    pub(crate) other: NodeId,
    /// Which of the children are wanted.
    pub(crate) lanes: u8,
}

impl Split {
    /// A split of which all children are wanted.
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
    split_node::<Moving>(&Meeting::new(problem, split, s), split)
}

/// Splits a node at the start, to measure: what stands for the time for which a pair keeps apart is a
/// lower bound of its distance.
///
/// # Panics
/// When the node is a single piece.
pub(crate) fn measure(problem: &Problem<'_>, split: &Split) -> Expansion {
    split_node::<Uniform>(&Meeting::new(problem, split, 0.0), split)
}

#[inline(always)]
fn split_node<P: Pace>(meeting: &Meeting<'_>, split: &Split) -> Expansion {
    let tree = meeting.near.body.tree();
    let Named::Node(node) = tree.get(split.node) else {
        unreachable!("a triangle is a single piece");
    };
    match node.below {
        Below::Boxes(group) => {
            let group = tree.box_group(group);
            Expansion {
                bounds: meeting.bound::<_, P>(group, &group.members),
                first: group.members.first,
                count: group.members.count,
                leaves: group.leaves,
            }
        }
        Below::Triangles(group) => {
            let group = tree.triangle_group(group);
            Expansion {
                bounds: meeting.bound::<_, P>(group, &group.members),
                first: group.members.first,
                count: group.members.count,
                leaves: u8::MAX,
            }
        }
        Below::Piece(_) => unreachable!("a single piece has no children"),
    }
}

/// The two bodies at a clock, along the axes of the one whose node is split.
struct Meeting<'p> {
    problem: &'p Problem<'p>,
    near: &'p Side<'p>,
    far: &'p Side<'p>,
    /// The far body's node.
    other: NodeId,
    far_to_near: Frame,
    /// Of the near centre less that of the far one.
    velocity: DVec3,
    /// The far body's.
    spin: DVec3,
    /// How much time is left.
    horizon: f32,
}

/// How fast gaps close.
trait Pace {
    /// For how long members of a group keep apart from the far body's node.
    fn bound<C: Children, O: Other>(view: &View<'_>, group: &C, other: &O) -> Bounds;
}

/// As the bodies move.
struct Moving;

/// By one unit of length in one of time, along every axis: the time that takes is the distance.
struct Uniform;

impl Pace for Moving {
    #[inline]
    fn bound<C: Children, O: Other>(view: &View<'_>, group: &C, other: &O) -> Bounds {
        view.bound(group, other)
    }
}

impl Pace for Uniform {
    fn bound<C: Children, O: Other>(view: &View<'_>, group: &C, other: &O) -> Bounds {
        view.distances(group, other)
    }
}

impl<'p> Meeting<'p> {
    // Half of a kilobyte, made once a visit: built where it is used, not moved there.
    #[inline(always)]
    fn new(problem: &'p Problem<'_>, split: &Split, s: f64) -> Self {
        let (near, far) = (split.body.of(problem), split.body.other().of(problem));
        let (near_frame, far_frame) = (near.path.frame(s), far.path.frame(s));
        Meeting {
            problem,
            near,
            far,
            other: split.other,
            far_to_near: near_frame.from_frame(&far_frame),
            velocity: near_frame.inverse_vector(near.path.velocity - far.path.velocity),
            spin: near_frame.inverse_vector(far.path.spin),
            horizon: (1.0 - s) as f32,
        }
    }

    /// Bounds a group of the near body against the far body's node.
    #[inline]
    fn bound<C: Children, P: Pace>(&self, group: &C, members: &Members) -> Bounds {
        let mut far_to_near = self.far_to_near;
        far_to_near.translation -= members.origin;
        let view = View {
            turn: columns(&far_to_near.rotation),
            far_to_near,
            meeting: self,
            members,
        };
        match self.far.body.tree().get(self.other) {
            Named::Node(node) => P::bound(&view, group, &view.node(node)),
            Named::Triangle(piece) => {
                let corners = self.far.body.pieces().triangle(piece as usize);
                P::bound(&view, group, &view.triangle(corners))
            }
        }
    }
}

/// The far body as a group sees it.
struct View<'m> {
    meeting: &'m Meeting<'m>,
    members: &'m Members,
    /// Relative to the group's origin.
    far_to_near: Frame,
    /// The same rotation in f32: columns.
    turn: [Vec3; 3],
}

impl View<'_> {
    fn bound<C: Children, P: Other>(&self, group: &C, other: &P) -> Bounds {
        let near = || self.near_turning();
        let far = || self.far_turning();
        let Meeting {
            near: n, far: f, ..
        } = self.meeting;
        match (n.path.turns(), f.path.turns()) {
            (false, false) => self.turning(group, other, Straight, Straight),
            (true, false) => self.turning(group, other, near(), Straight),
            (false, true) => self.turning(group, other, Straight, far()),
            (true, true) => self.turning(group, other, near(), far()),
        }
    }

    fn node(&self, node: &Node) -> OtherBox {
        OtherBox {
            centre: self.far_to_near.point(node.centre).as_vec3(),
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
        let corners = corners.map(|p| self.far_to_near.point(p));
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

    fn near_turning(&self) -> Turning {
        let path = &self.meeting.near.path;
        Turning {
            spin: path.spin_local.as_vec3(),
            rate: up(path.rate),
            centre: (path.centre - self.members.origin).as_vec3(),
        }
    }

    fn far_turning(&self) -> Turning {
        let path = &self.meeting.far.path;
        Turning {
            spin: self.meeting.spin.as_vec3(),
            rate: up(path.rate),
            centre: self.far_to_near.point(path.centre).as_vec3(),
        }
    }

    fn turning<C: Children, P: Other, S: Turn, O: Turn>(
        &self,
        group: &C,
        other: &P,
        split: S,
        far: O,
    ) -> Bounds {
        let velocity = self.meeting.velocity.as_vec3();
        let reach = self.members.reach;
        // An arm is the difference of two places, each rounded where it is.
        let places = other.centre().length() + far.arm(Vec3::ZERO);
        let speed = velocity.length()
            + split.rate() * (reach + split.arm(Vec3::ZERO))
            + far.rate() * (other.radius() + far.arm(other.centre()) + PLACES_F32 * places);
        let problem = self.meeting.problem;
        let rounding = self.rounding(other);
        let slack = greater(
            (up(problem.margin) + rounding).next_up(),
            up(problem.node_gap()),
        );
        let closed = (CLOSED_GAP * problem.tolerance) as f32;
        let closing = Closing {
            velocity,
            split,
            other: far,
            horizon: self.meeting.horizon,
            slack,
            kept: (slack - rounding).next_down(),
            closed: greater(LEAST_GAP_F32, closed),
            rate_slack: RATE_F32 * speed,
        };
        let mut bounds = bound(group, other, &closing);
        if S::TURNS && reach > MUCH_LARGER * other.radius() {
            bound_attached(group, other, &closing, Larger::Split, &mut bounds);
        } else if O::TURNS && other.radius() > MUCH_LARGER * reach {
            bound_attached(group, other, &closing, Larger::Other, &mut bounds);
        }
        bounds
    }

    /// Lower bounds of distances: for how long pairs keep apart that close in at a rate of 1.
    fn distances<C: Children, P: Other>(&self, group: &C, other: &P) -> Bounds {
        let rounding = self.rounding(other);
        let closing = Closing {
            velocity: Vec3::ZERO,
            split: Straight,
            other: Straight,
            horizon: 0.0,
            slack: rounding,
            kept: 0.0,
            closed: 0.0,
            rate_slack: 1.0,
        };
        Bounds {
            // A second look would see the same.
            aloof: [0.0; LANES],
            ..bound(group, other, &closing)
        }
    }

    /// What rounding may do to a gap.
    fn rounding<P: Other>(&self, other: &P) -> f32 {
        let [x, y, z] = other.centre().abs().to_array();
        let rounding = WAY_F32 * (x + y + z) + REACH_F32 * (other.radius() + self.members.reach);
        (rounding + up(self.meeting.problem.rounding)).next_up()
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
