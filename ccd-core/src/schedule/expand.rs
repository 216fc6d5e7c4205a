//! Splitting one node of a pair: its children against the other node, at the pose of the pair's
//! clock.

use super::lanes::{Bounds, Children, Closing, Other, OtherBox, OtherTriangle, Straight, Turn};
use super::lanes::{Larger, Turning, bound, bound_attached};
use crate::pose::Frame;
use crate::problem::{Problem, Side};
use crate::tolerance::{
    CLOSED_GAP, LEAST_GAP_F32, MUCH_LARGER, PLACES_F32, RATE_F32, REACH_F32, WAY_F32,
};
use crate::tree::{Below, Members, Named, Node, NodeId, unit_normal, up};
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
    let (near, far) = (split.body.of(problem), split.body.other().of(problem));
    let other = split.other;
    let Named::Node(node) = near.body.tree().get(split.node) else {
        unreachable!("a triangle is a single piece");
    };
    let tree = near.body.tree();
    match node.below {
        Below::Boxes(group) => {
            let group = tree.box_group(group);
            Expansion {
                bounds: against(problem, near, far, s, group, &group.members, other),
                first: group.members.first,
                count: group.members.count,
                leaves: group.leaves,
            }
        }
        Below::Triangles(group) => {
            let group = tree.triangle_group(group);
            Expansion {
                bounds: against(problem, near, far, s, group, &group.members, other),
                first: group.members.first,
                count: group.members.count,
                leaves: u8::MAX,
            }
        }
        Below::Piece(_) => unreachable!("a single piece has no children"),
    }
}

/// The far side as the split group sees it: its frame relative to the group's origin, in the split
/// body's frame.
struct View {
    far_to_near: Frame,
    /// The same rotation in f32: columns.
    turn: [Vec3; 3],
}

fn against<C: Children>(
    problem: &Problem<'_>,
    near: &Side<'_>,
    far: &Side<'_>,
    s: f64,
    group: &C,
    members: &Members,
    other: NodeId,
) -> Bounds {
    let (near_frame, far_frame) = (near.path.frame(s), far.path.frame(s));
    let mut far_to_near = near_frame.from_frame(&far_frame);
    far_to_near.translation -= members.origin;
    let view = View {
        turn: columns(&far_to_near.rotation),
        far_to_near,
    };
    let velocity = near_frame.inverse_vector(near.path.velocity - far.path.velocity);
    let shared = Shared {
        problem,
        near,
        far,
        members,
        velocity,
        spin: near_frame.inverse_vector(far.path.spin),
        view: &view,
        horizon: (1.0 - s) as f32,
    };
    match far.body.tree().get(other) {
        Named::Node(node) => shared.bound(group, &view.node(node)),
        Named::Triangle(piece) => {
            let corners = far.body.pieces().triangle(piece as usize);
            shared.bound(group, &view.triangle(corners))
        }
    }
}

impl View {
    fn node(&self, node: &Node) -> OtherBox {
        OtherBox {
            centre: self.far_to_near.point(node.centre).as_vec3(),
            axes: node
                .axes
                .map(|u| self.turn[0] * u.x + self.turn[1] * u.y + self.turn[2] * u.z),
            half: node.half,
            radius: node.radius,
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
            radius: up(farthest.into_iter().fold(0.0, f64::max).sqrt()).next_up(),
        }
    }
}

/// What a bound needs of the two bodies, whatever the shapes of their nodes.
struct Shared<'a> {
    problem: &'a Problem<'a>,
    near: &'a Side<'a>,
    far: &'a Side<'a>,
    members: &'a Members,
    /// Of the near centre less that of the far one, along the near body's axes.
    velocity: DVec3,
    /// The far body's, along the near body's axes.
    spin: DVec3,
    view: &'a View,
    horizon: f32,
}

impl Shared<'_> {
    fn bound<C: Children, P: Other>(&self, group: &C, other: &P) -> Bounds {
        let near = || self.near_turning();
        let far = || self.far_turning();
        match (self.near.path.turns(), self.far.path.turns()) {
            (false, false) => self.turning(group, other, Straight, Straight),
            (true, false) => self.turning(group, other, near(), Straight),
            (false, true) => self.turning(group, other, Straight, far()),
            (true, true) => self.turning(group, other, near(), far()),
        }
    }

    fn near_turning(&self) -> Turning {
        let path = &self.near.path;
        Turning {
            spin: path.spin_local.as_vec3(),
            rate: up(path.rate),
            centre: (path.centre - self.members.origin).as_vec3(),
        }
    }

    fn far_turning(&self) -> Turning {
        let path = &self.far.path;
        Turning {
            spin: self.spin.as_vec3(),
            rate: up(path.rate),
            centre: self.view.far_to_near.point(path.centre).as_vec3(),
        }
    }

    fn turning<C: Children, P: Other, S: Turn, O: Turn>(
        &self,
        group: &C,
        other: &P,
        split: S,
        far: O,
    ) -> Bounds {
        let velocity = self.velocity.as_vec3();
        let reach = self.members.reach;
        let [x, y, z] = other.centre().abs().to_array();
        let rounding = WAY_F32 * (x + y + z) + REACH_F32 * (other.radius() + reach);
        // An arm is the difference of two places, each rounded where it is.
        let places = other.centre().length() + far.arm(Vec3::ZERO);
        let speed = velocity.length()
            + split.rate() * (reach + split.arm(Vec3::ZERO))
            + far.rate() * (other.radius() + far.arm(other.centre()) + PLACES_F32 * places);
        let problem = self.problem;
        let rounding = (rounding + up(problem.rounding)).next_up();
        let slack = (up(problem.margin) + rounding)
            .next_up()
            .max(up(problem.node_gap()));
        let closed = (CLOSED_GAP * problem.tolerance) as f32;
        let closing = Closing {
            velocity,
            split,
            other: far,
            horizon: self.horizon,
            slack,
            kept: (slack - rounding).next_down(),
            closed: closed.max(LEAST_GAP_F32),
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
