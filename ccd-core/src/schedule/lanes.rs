//! Eight pairs of nodes at once: how far apart they are, and until when that is certain.
//!
//! Everything here is relative to the origin of the group that is split, in its body's frame, in
//! f32, one array lane per child; loops over lanes are what the compiler turns into vector code.
//! The error of every quantity is covered by the allowances of [`Closing`].

use crate::tolerance::{BEND_F32, CLOCK_F32, LEAST_BEND_F32, LEAST_GAP_F32};
use crate::tree::{BoxGroup, LANES, TriangleGroup};
use glam::Vec3;

/// What eight pairs come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// For how long each pair is certainly farther apart than the gap that is to be kept.
    pub(crate) free: [f32; LANES],
    /// Positive when a pair is so far apart, for its size and its turn until then, that looking at it
    /// again is worth more than splitting it.
    pub(crate) aloof: [f32; LANES],
    /// How thick the child is along the axis, less how thick the other node is.
    pub(crate) thicker: [f32; LANES],
}

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
    fn normal(&self) -> Vec3;
    fn radius(&self) -> f32;
    /// `max n·(centre − y)` over the node's points: how far it comes towards −n.
    fn reach(&self, n: Vec3) -> f32;
}

/// How a body turns: nothing to compute for one that does not.
pub(crate) trait Turn: Copy {
    /// The velocity, due to turning, of the point `x`.
    fn velocity(&self, x: Vec3) -> Vec3;
    /// `n × ω`
    fn across(&self, n: Vec3) -> Vec3;
    fn rate(&self) -> f32;
    /// How far `x` is from the rotation's centre.
    fn arm(&self, x: Vec3) -> f32;
    const TURNS: bool;
}

/// A body that does not turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Straight;

/// A body that does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning {
    pub(crate) spin: Vec3,
    pub(crate) rate: f32,
    /// A point on the axis of rotation.
    pub(crate) centre: Vec3,
}

/// What all lanes share: the motion, and allowances for rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closing<S, O> {
    /// Of the split side's centre less that of the other side's.
    pub(crate) velocity: Vec3,
    pub(crate) split: S,
    pub(crate) other: O,
    /// How much time is left.
    pub(crate) horizon: f32,
    /// The gap that is to be kept, and what rounding may do to a gap.
    pub(crate) slack: f32,
    /// What rounding may do to a rate.
    pub(crate) rate_slack: f32,
}

/// Bounds eight pairs.
#[inline(always)]
pub(crate) fn bound<C: Children, P: Other, S: Turn, O: Turn>(
    children: &C,
    other: &P,
    closing: &Closing<S, O>,
) -> Bounds {
    let mut out = Bounds {
        free: [0.0; LANES],
        aloof: [0.0; LANES],
        thicker: [0.0; LANES],
    };
    let other_velocity = closing.other.velocity(other.centre());
    // The slack covers what rounding takes off a speed.
    let other_speed =
        length(other_velocity) + closing.other.rate() * other.radius() + closing.rate_slack;
    for lane in 0..LANES {
        let centre = children.centre(lane);
        let way = other.centre() - centre;
        let turning = closing.split.velocity(centre);
        let velocity = closing.velocity + turning - other_velocity;
        let shared = Pairing {
            children,
            other,
            closing,
            lane,
            way,
            velocity,
            speed: length(turning)
                + closing.split.rate() * children.radius(lane)
                + closing.rate_slack,
            other_speed,
        };
        let axis = best_axis(children, other, lane, way);
        let free = free_along(&shared, axis);
        // Where the centres pass each other, their way then separates them for longest.
        let square = dot(velocity, velocity);
        let closest = dot(way, velocity) / max(square, f32::MIN_POSITIVE);
        let closest = max(min(closest, closing.horizon), 0.0);
        let passing = way - velocity * closest;
        let length = length(passing);
        let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
        let passing = free_along(
            &shared,
            along(children, other, lane, way, passing * inverse),
        );
        out.free[lane] = max(free, passing);
        out.aloof[lane] = axis.gap - closing.slack - 0.5 * (children.radius(lane) + other.radius());
        out.thicker[lane] = axis.split_reach + 0.1 * children.radius(lane)
            - (axis.other_reach + 0.1 * other.radius());
    }
    out
}

/// One child and the other node.
struct Pairing<'a, C, P, S, O> {
    children: &'a C,
    other: &'a P,
    closing: &'a Closing<S, O>,
    lane: usize,
    way: Vec3,
    velocity: Vec3,
    speed: f32,
    other_speed: f32,
}

#[inline(always)]
fn free_along<C: Children, P: Other, S: Turn, O: Turn>(
    pair: &Pairing<'_, C, P, S, O>,
    axis: Axis,
) -> f32 {
    let n = axis.n;
    let apart = axis.gap - pair.closing.slack;
    let mut rate = dot(n, pair.velocity) + pair.closing.rate_slack;
    let mut bend = 0.0;
    if S::TURNS {
        let m = pair.closing.split.across(n);
        rate += pair.children.reach(pair.lane, m);
        bend += length(m) * pair.speed;
    }
    if O::TURNS {
        let m = pair.closing.other.across(n);
        rate += pair.other.reach(m);
        bend += length(m) * pair.other_speed;
    }
    if S::TURNS || O::TURNS {
        free_time(apart, rate, bend * BEND_F32 + LEAST_BEND_F32)
    } else {
        straight_free_time(apart, rate)
    }
}

/// An axis, the gap along it, and how far either side reaches towards the other.
#[derive(Clone, Copy)]
struct Axis {
    n: Vec3,
    gap: f32,
    split_reach: f32,
    other_reach: f32,
}

/// The best of three axes: between the centres, and the two nodes' own normals.
///
/// Homogeneous in the axis: a zero vector gives no gap, and one of any length a sound gap.
#[inline(always)]
fn best_axis<C: Children, P: Other>(children: &C, other: &P, lane: usize, way: Vec3) -> Axis {
    let length = length(way);
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    let between = along(children, other, lane, way, way * inverse);
    let own = towards(children.normal(lane), way);
    let others = towards(other.normal(), way);
    better(
        better(between, along(children, other, lane, way, own)),
        along(children, other, lane, way, others),
    )
}

#[inline(always)]
fn along<C: Children, P: Other>(
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

/// `n` or `−n`, whichever points along `way`.
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

#[inline(always)]
fn choose(first: bool, a: f32, b: f32) -> f32 {
    if first { a } else { b }
}

/// The largest τ with `apart ≥ rate τ + bend τ²/2`; 0 for a pair that is not apart, also when it
/// recedes, and for NaN.
#[inline(always)]
fn free_time(apart: f32, rate: f32, bend: f32) -> f32 {
    let root = (rate * rate + 2.0 * bend * apart).sqrt();
    let approaching = 2.0 * apart / (rate + root);
    let receding = (root - rate) / bend;
    let tau = if rate > 0.0 { approaching } else { receding };
    if apart > LEAST_GAP_F32 && tau > 0.0 {
        tau * CLOCK_F32
    } else {
        0.0
    }
}

/// The same on a straight path.
#[inline(always)]
fn straight_free_time(apart: f32, rate: f32) -> f32 {
    let tau = apart / rate;
    let tau = if rate > 0.0 { tau } else { f32::INFINITY };
    if apart > LEAST_GAP_F32 && tau > 0.0 {
        tau * CLOCK_F32
    } else {
        0.0
    }
}

#[inline(always)]
fn fused(a: f32, b: f32, c: f32) -> f32 {
    if cfg!(target_feature = "fma") {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}

#[inline(always)]
pub(crate) fn dot(a: Vec3, b: Vec3) -> f32 {
    fused(a.x, b.x, fused(a.y, b.y, a.z * b.z))
}

#[inline(always)]
fn length(a: Vec3) -> f32 {
    dot(a, a).sqrt()
}

#[inline(always)]
fn cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        fused(a.y, b.z, -(a.z * b.y)),
        fused(a.z, b.x, -(a.x * b.z)),
        fused(a.x, b.y, -(a.y * b.x)),
    )
}

#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
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

impl Turn for Straight {
    const TURNS: bool = false;
    #[inline(always)]
    fn velocity(&self, _: Vec3) -> Vec3 {
        Vec3::ZERO
    }
    #[inline(always)]
    fn across(&self, _: Vec3) -> Vec3 {
        Vec3::ZERO
    }
    #[inline(always)]
    fn rate(&self) -> f32 {
        0.0
    }
    fn arm(&self, _: Vec3) -> f32 {
        0.0
    }
}

impl Turn for Turning {
    const TURNS: bool = true;
    #[inline(always)]
    fn velocity(&self, x: Vec3) -> Vec3 {
        cross(self.spin, x - self.centre)
    }
    #[inline(always)]
    fn across(&self, n: Vec3) -> Vec3 {
        cross(n, self.spin)
    }
    #[inline(always)]
    fn rate(&self) -> f32 {
        self.rate
    }
    fn arm(&self, x: Vec3) -> f32 {
        length(x - self.centre)
    }
}
