//! Eight pairs of nodes at once: how far apart they are, and until when that is certain.
//!
//! Everything here is relative to the origin of the group that is split, in its body's frame, in
//! f32, one array lane per child; loops over lanes are what the compiler turns into vector code.
//! The rounding of every gap and rate is covered by the slacks of [`Closing`].

mod attached;
mod axis;
mod clock;
mod shape;
mod turn;
mod vector;

pub(crate) use shape::{Children, Other, OtherBox, OtherTriangle};
pub(crate) use turn::{Straight, Turn, Turning};

use crate::tolerance::{ACROSS_F32, BEND_F32, LEAST_BEND_F32, LOOK_AGAIN, SWEPT, THICKNESS};
use crate::tree::LANES;
use axis::Axis;
use glam::Vec3;
use vector::{dot, length, max};

/// What eight pairs come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// For how long each pair is certainly farther apart than the gap that is to be kept.
    pub(crate) free: [f32; LANES],
    /// Positive when a pair is so far apart for its size that looking at it again, once its time is
    /// over, is worth more than splitting it.
    pub(crate) aloof: [f32; LANES],
    /// How thick the child is along the axis, less how thick the other node is.
    pub(crate) thicker: [f32; LANES],
    /// The gap that the free times prove to be kept.
    pub(crate) kept: f32,
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
    /// The gap that is kept for certain: the slack less what rounding may do to it.
    pub(crate) kept: f32,
    /// A gap beyond the slack that is no larger counts as none.
    pub(crate) closed: f32,
    /// What rounding may do to a rate.
    pub(crate) rate_slack: f32,
}

/// Bounds eight pairs along planes that stand still.
///
/// Two axes are tried: the one with the widest gap now, and the one along which the centres are
/// apart when they are nearest. The first serves pairs that approach, the second such that pass.
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
        kept: closing.kept,
    };
    let pairing = Pairing::new(children, other, closing);
    for lane in 0..LANES {
        let pair = pairing.lane(lane);
        let widest = axis::widest(children, other, lane, pair.way);
        let passing = axis::passing(
            children,
            other,
            lane,
            pair.way,
            pair.velocity * closing.horizon,
        );
        out.free[lane] = max(pairing.free(&pair, widest), pairing.free(&pair, passing));
        let radius = children.radius(lane);
        out.aloof[lane] = widest.gap - closing.slack - LOOK_AGAIN * (radius + other.radius());
        out.thicker[lane] = (widest.split_reach + THICKNESS * radius)
            - (widest.other_reach + THICKNESS * other.radius());
    }
    out
}

/// Bounds eight pairs along planes that turn with the body of the larger nodes, where those of
/// [`bound`] do not last as long.
#[inline(always)]
pub(crate) fn bound_attached<C: Children, P: Other, S: Turn, O: Turn>(
    children: &C,
    other: &P,
    closing: &Closing<S, O>,
    larger: Larger,
    out: &mut Bounds,
) {
    let pairing = Pairing::new(children, other, closing);
    for lane in 0..LANES {
        let pair = pairing.lane(lane);
        let widest = axis::widest(children, other, lane, pair.way);
        let past = match larger {
            Larger::Split => Past {
                attached: pairing.free_with_split(widest),
                spin: closing.split.rate(),
                arm: closing.split.arm(other.centre()),
                large: children.radius(lane),
                small: other.radius(),
                whole: children.is_piece(lane),
            },
            Larger::Other => Past {
                attached: pairing.free_with_other(&pair, widest),
                spin: closing.other.rate(),
                arm: closing.other.arm(children.centre(lane)),
                large: other.radius(),
                small: children.radius(lane),
                whole: other.is_piece(),
            },
        };
        let free = max(out.free[lane], past.attached);
        out.free[lane] = free;
        let swept = free * past.spin * past.arm - past.large * SWEPT;
        let clear = widest.gap - closing.slack - LOOK_AGAIN * past.small;
        let aloof = if past.whole { max(swept, clear) } else { swept };
        out.aloof[lane] = max(out.aloof[lane], aloof);
    }
}

/// What is past a much larger node that turns.
struct Past {
    /// For how long a plane that turns with the large one keeps it apart.
    attached: f32,
    /// How fast the large one turns, and how far from its body's centre the small one is.
    spin: f32,
    arm: f32,
    /// The radii.
    large: f32,
    small: f32,
    /// The large one cannot be split, so that only the small one's size tells whether it is far.
    whole: bool,
}

/// Which side's nodes are much larger than the other's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Larger {
    Split,
    Other,
}

/// The children of a group, each with the other node.
struct Pairing<'a, C, P, S, O> {
    children: &'a C,
    other: &'a P,
    closing: &'a Closing<S, O>,
    /// The velocity of the other node's centre due to turning.
    other_turning: Vec3,
    /// No point of the other node moves faster due to turning.
    other_speed: f32,
}

/// One child and the other node.
#[derive(Clone, Copy)]
struct Lane {
    lane: usize,
    /// From the child's centre to the other's.
    way: Vec3,
    /// Of the child's centre relative to the other's.
    velocity: Vec3,
    /// No point of the child moves faster due to turning.
    speed: f32,
}

impl<'a, C: Children, P: Other, S: Turn, O: Turn> Pairing<'a, C, P, S, O> {
    #[inline(always)]
    fn new(children: &'a C, other: &'a P, closing: &'a Closing<S, O>) -> Self {
        let other_turning = closing.other.velocity(other.centre());
        Pairing {
            children,
            other,
            closing,
            other_turning,
            // A slack on the speeds covers what rounding takes off the bends.
            other_speed: length(other_turning)
                + closing.other.rate() * other.radius()
                + closing.rate_slack,
        }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> Lane {
        let centre = self.children.centre(lane);
        let turning = self.closing.split.velocity(centre);
        Lane {
            lane,
            way: self.other.centre() - centre,
            velocity: self.closing.velocity + turning - self.other_turning,
            speed: length(turning)
                + self.closing.split.rate() * self.children.radius(lane)
                + self.closing.rate_slack,
        }
    }

    /// For how long a plane across the axis, standing still, keeps the pair apart.
    #[inline(always)]
    fn free(&self, pair: &Lane, axis: Axis) -> f32 {
        let closing = self.closing;
        // n·(v + ω×arm) of the centres, and what the points around them add.
        let mut rate = dot(axis.n, pair.velocity) + closing.rate_slack;
        let mut bend = LEAST_BEND_F32;
        if S::TURNS {
            let m = closing.split.across(axis.n);
            rate += self.children.reach(pair.lane, m);
            bend += bending(m, closing.split.rate(), pair.speed);
        }
        if O::TURNS {
            let m = closing.other.across(axis.n);
            rate += self.other.reach(m);
            bend += bending(m, closing.other.rate(), self.other_speed);
        }
        let apart = axis.gap - closing.slack;
        if S::TURNS || O::TURNS {
            clock::free_time(apart, closing.closed, rate, bend)
        } else {
            clock::straight_free_time(apart, closing.closed, rate)
        }
    }
}

/// Bounds the bending along `n` of paths that turn at a rate of `|ω|`, at `speed` at most; `m` is
/// `n × ω`.
#[inline(always)]
fn bending(m: Vec3, rate: f32, speed: f32) -> f32 {
    (length(m) * BEND_F32 + ACROSS_F32 * rate) * speed
}

#[cfg(test)]
mod tests;
