//! The shapes of nodes, as seen from the group that is split.

use super::vector::{dot, fused, length, max, min};
use crate::tree::{BoxGroup, LANES, TriangleGroup};
use glam::Vec3;

/// The children of a group.
pub(crate) trait Children {
    fn centre(&self, lane: usize) -> Vec3;
    /// A unit vector that is likely to separate the child from others, or zero.
    fn normal(&self, lane: usize) -> Vec3;
    /// No point of the child is farther from its centre.
    fn radius(&self, lane: usize) -> f32;
    /// `max n·(x − centre)` over the child's points.
    fn reach(&self, lane: usize, n: Vec3) -> f32;
}

/// The node that all children of a group are paired with.
pub(crate) trait Other {
    fn centre(&self) -> Vec3;
    /// A unit vector that is likely to separate the node from others, or zero.
    fn normal(&self) -> Vec3;
    /// No point of the node is farther from its centre.
    fn radius(&self) -> f32;
    /// `max n·(centre − y)` over the node's points: how far it comes towards −n.
    fn reach(&self, n: Vec3) -> f32;
}

/// `min(Σ hₖ |n·uₖ|, R |n|)`
#[inline(always)]
fn box_reach(n: Vec3, axes: [Vec3; 3], half: [f32; 3], radius: f32) -> f32 {
    let x = half[0] * dot(n, axes[0]).abs();
    let xy = fused(half[1], dot(n, axes[1]).abs(), x);
    let boxed = fused(half[2], dot(n, axes[2]).abs(), xy);
    min(boxed, radius * length(n))
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
    fn reach(&self, lane: usize, n: Vec3) -> f32 {
        let axes = [
            at(&self.axes[0], lane),
            at(&self.axes[1], lane),
            at(&self.axes[2], lane),
        ];
        let half = [self.half[0][lane], self.half[1][lane], self.half[2][lane]];
        box_reach(n, axes, half, self.radius[lane])
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
    fn reach(&self, lane: usize, n: Vec3) -> f32 {
        let centre = self.centre(lane);
        let a = dot(n, at(&self.corners[0], lane));
        let b = dot(n, at(&self.corners[1], lane));
        let c = dot(n, at(&self.corners[2], lane));
        max(max(a, b), c) - dot(n, centre)
    }
}

/// A node's box and ball.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherBox {
    pub(crate) centre: Vec3,
    pub(crate) axes: [Vec3; 3],
    pub(crate) half: [f32; 3],
    pub(crate) radius: f32,
}

impl Other for OtherBox {
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
    fn reach(&self, n: Vec3) -> f32 {
        box_reach(n, self.axes, self.half, self.radius)
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

impl Other for OtherTriangle {
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
    fn reach(&self, n: Vec3) -> f32 {
        let a = dot(n, self.corners[0]);
        let b = dot(n, self.corners[1]);
        let c = dot(n, self.corners[2]);
        -min(min(a, b), c)
    }
}
