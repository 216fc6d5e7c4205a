//! The shapes of nodes, as seen from the split group.

use super::vector_f32::{TINY, choose, dot, fused, length, max, min};
use crate::body::tree::{BoxGroup, LANES, TriangleGroup};
use glam::Vec3;

/// The children of a group.
pub(crate) trait Children {
    fn centre(&self, lane: usize) -> Vec3;
    /// Returns a unit vector that is likely to separate the child from others, or zero.
    fn normal(&self, lane: usize) -> Vec3;
    /// Returns an upper bound of its points' distances from its centre.
    fn radius(&self, lane: usize) -> f32;
    /// Returns `max n·(x − centre)` over the child's points.
    fn reach(&self, lane: usize, n: Vec3) -> f32;
    /// Returns a point of the child from which to look towards `to`.
    fn near(&self, lane: usize, to: Vec3) -> Vec3;
    /// Returns whether the child cannot be split.
    fn is_piece(&self, lane: usize) -> bool;
}

/// The node that all children of a group are paired with.
pub(crate) trait OtherNode {
    fn centre(&self) -> Vec3;
    /// Returns a unit vector that is likely to separate the node from others, or zero.
    fn normal(&self) -> Vec3;
    /// Returns an upper bound of its points' distances from its centre.
    fn radius(&self) -> f32;
    /// Returns `max n·(centre − y)` over the node's points: its reach towards −n.
    fn reach(&self, n: Vec3) -> f32;
    /// Returns a point of the node to look at from `from`.
    fn near(&self, from: Vec3) -> Vec3;
    /// Returns whether the node cannot be split.
    fn is_piece(&self) -> bool;
}

/// Returns `min(Σ hₖ |n·uₖ| + r |n|, R |n|)`: the reach of a box grown by its pieces' rounding r,
/// and of a ball.
#[inline(always)]
fn box_reach(n: Vec3, axes: [Vec3; 3], half: [f32; 3], [rounding, radius]: [f32; 2]) -> f32 {
    let x = half[0] * dot(n, axes[0]).abs();
    let xy = fused(half[1], dot(n, axes[1]).abs(), x);
    let boxed = fused(half[2], dot(n, axes[2]).abs(), xy);
    let length = length(n);
    min(fused(rounding, length, boxed), radius * length)
}

#[inline(always)]
fn at(rows: &[[f32; LANES]; 3], lane: usize) -> Vec3 {
    Vec3::new(rows[0][lane], rows[1][lane], rows[2][lane])
}

impl Children for BoxGroup {
    #[inline(always)]
    fn centre(&self, lane: usize) -> Vec3 {
        at(&self.centre, lane)
    }
    #[inline(always)]
    fn normal(&self, lane: usize) -> Vec3 {
        at(&self.axes[2], lane)
    }
    #[inline(always)]
    fn radius(&self, lane: usize) -> f32 {
        self.radius[lane]
    }
    #[inline(always)]
    fn near(&self, lane: usize, _: Vec3) -> Vec3 {
        self.centre(lane)
    }
    #[inline(always)]
    fn reach(&self, lane: usize, n: Vec3) -> f32 {
        let axes = [
            at(&self.axes[0], lane),
            at(&self.axes[1], lane),
            at(&self.axes[2], lane),
        ];
        let half = [self.half[0][lane], self.half[1][lane], self.half[2][lane]];
        box_reach(n, axes, half, [self.rounding[lane], self.radius[lane]])
    }
    #[inline(always)]
    fn is_piece(&self, lane: usize) -> bool {
        self.leaves >> lane & 1 == 1
    }
}

impl Children for TriangleGroup {
    #[inline(always)]
    fn centre(&self, lane: usize) -> Vec3 {
        let sum = at(&self.corners[0], lane) + at(&self.corners[1], lane);
        (sum + at(&self.corners[2], lane)) * (1.0 / 3.0)
    }
    #[inline(always)]
    fn normal(&self, lane: usize) -> Vec3 {
        at(&self.normal, lane)
    }
    #[inline(always)]
    fn radius(&self, lane: usize) -> f32 {
        self.radius[lane]
    }
    #[inline(always)]
    fn near(&self, lane: usize, to: Vec3) -> Vec3 {
        let corner = |k: usize| at(&self.corners[k], lane);
        nearest_of_edges(corner(0), corner(1), corner(2), to)
    }
    #[inline(always)]
    fn reach(&self, lane: usize, n: Vec3) -> f32 {
        let centre = self.centre(lane);
        let a = dot(n, at(&self.corners[0], lane));
        let b = dot(n, at(&self.corners[1], lane));
        let c = dot(n, at(&self.corners[2], lane));
        max(max(a, b), c) - dot(n, centre)
    }
    #[inline(always)]
    fn is_piece(&self, _: usize) -> bool {
        true
    }
}

/// A node's box and ball.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherBox {
    pub(crate) centre: Vec3,
    pub(crate) axes: [Vec3; 3],
    pub(crate) half: [f32; 3],
    pub(crate) rounding: f32,
    pub(crate) radius: f32,
    /// True if it is the box of a single piece.
    pub(crate) piece: bool,
}

impl OtherNode for OtherBox {
    #[inline(always)]
    fn centre(&self) -> Vec3 {
        self.centre
    }
    #[inline(always)]
    fn normal(&self) -> Vec3 {
        self.axes[2]
    }
    #[inline(always)]
    fn radius(&self) -> f32 {
        self.radius
    }
    #[inline(always)]
    fn near(&self, from: Vec3) -> Vec3 {
        let way = from - self.centre;
        let clamp = |k: usize| {
            let along = dot(way, self.axes[k]);
            self.axes[k] * max(min(along, self.half[k]), -self.half[k])
        };
        self.centre + clamp(0) + clamp(1) + clamp(2)
    }
    #[inline(always)]
    fn reach(&self, n: Vec3) -> f32 {
        box_reach(n, self.axes, self.half, [self.rounding, self.radius])
    }
    #[inline(always)]
    fn is_piece(&self) -> bool {
        self.piece
    }
}

/// A triangle: its corners relative to its centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherTriangle {
    pub(crate) centre: Vec3,
    pub(crate) corners: [Vec3; 3],
    pub(crate) normal: Vec3,
    pub(crate) radius: f32,
}

impl OtherNode for OtherTriangle {
    #[inline(always)]
    fn centre(&self) -> Vec3 {
        self.centre
    }
    #[inline(always)]
    fn normal(&self) -> Vec3 {
        self.normal
    }
    #[inline(always)]
    fn radius(&self) -> f32 {
        self.radius
    }
    #[inline(always)]
    fn near(&self, from: Vec3) -> Vec3 {
        let [a, b, c] = self.corners;
        self.centre + nearest_of_edges(a, b, c, from - self.centre)
    }
    #[inline(always)]
    fn reach(&self, n: Vec3) -> f32 {
        let a = dot(n, self.corners[0]);
        let b = dot(n, self.corners[1]);
        let c = dot(n, self.corners[2]);
        -min(min(a, b), c)
    }
    #[inline(always)]
    fn is_piece(&self) -> bool {
        true
    }
}

/// Returns the point of a triangle's edges that is nearest to `to`. If an interior point is nearer,
/// the triangle's normal is the better axis anyway.
#[inline(always)]
fn nearest_of_edges(a: Vec3, b: Vec3, c: Vec3, to: Vec3) -> Vec3 {
    let (p, q, r) = (foot(a, b, to), foot(b, c, to), foot(c, a, to));
    let first = nearer(p, q, to);
    nearer(first, r, to)
}

/// Returns the point of a segment that is nearest to `to`.
#[inline(always)]
fn foot(a: Vec3, b: Vec3, to: Vec3) -> Vec3 {
    let edge = b - a;
    let t = dot(to - a, edge) / max(dot(edge, edge), TINY);
    a + edge * max(min(t, 1.0), 0.0)
}

#[inline(always)]
fn nearer(p: Vec3, q: Vec3, to: Vec3) -> Vec3 {
    let pick = dot(p - to, p - to) < dot(q - to, q - to);
    Vec3::new(
        choose(pick, p.x, q.x),
        choose(pick, p.y, q.y),
        choose(pick, p.z, q.z),
    )
}
