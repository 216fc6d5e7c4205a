//! The pairs of one split wait together, and are taken out one by one.

use super::expand::{Expansion, Split};
use crate::body::tree::{LANES, NodeId};
use crate::math::order::greater;
use crate::problem::Problem;
use crate::problem::Which;

/// Up to eight pairs: the children of a node, each with one node of the other body.
#[derive(Debug)]
pub(crate) struct Siblings {
    /// The time after `since` for which each pair is certified; infinite once the pair is finished.
    free: FreeTimes,
    since: f64,
    /// The split that created the pairs.
    split: Split,
    first: NodeId,
    /// The children that are thicker than the other node and will be split next.
    thicker: u8,
    /// The children for which a second look is better than a split.
    waits: u8,
}

/// The next step for a pair whose clock has run out.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Next {
    /// Ask the oracle about two pieces, of A and of B.
    Ask(u32, u32),
    /// Split one of the two nodes.
    Split(Split),
}

impl Next {
    /// Creates the pair of both roots. Of two nodes that can be split, the smaller one is: a large
    /// one is best kept whole until it matters.
    pub(crate) fn roots(problem: &Problem<'_>) -> Self {
        let (a, b) = (problem.a.body.tree(), problem.b.body.tree());
        let body = match (a.piece(0), b.piece(0)) {
            (Some(a), Some(b)) => return Next::Ask(a, b),
            (None, None) if !(b.radius() < a.radius()) => Which::A,
            (None, Some(_)) => Which::A,
            _ => Which::B,
        };
        Next::Split(Split::all(body, 0, 0))
    }
}

impl Siblings {
    /// Creates the pair of both roots; the given body's root is to be split.
    pub(crate) fn roots(body: Which) -> Self {
        Siblings {
            free: FreeTimes::new(&[0.0; LANES], 1),
            since: 0.0,
            split: Split::all(body, 0, 0),
            first: 0,
            thicker: 1,
            waits: 0,
        }
    }

    /// Creates the pairs of a split at a clock.
    pub(crate) fn new(problem: &Problem<'_>, expansion: &Expansion, split: Split, s: f64) -> Self {
        let bounds = &expansion.bounds;
        let (mut thicker, mut waits) = (0, 0);
        for lane in 0..LANES {
            thicker |= u8::from(bounds.thicker[lane] > 0.0) << lane;
            waits |= u8::from(bounds.waits[lane] > 0.0) << lane;
        }
        let other_tree = split.body.other().of(problem).body.tree();
        if other_tree.piece(split.other).is_some() {
            thicker = u8::MAX;
        }
        let used = split.lanes & lanes_below(expansion.count);
        Siblings {
            free: FreeTimes::new(&bounds.free, used),
            since: s,
            split,
            first: expansion.first,
            thicker: thicker & !expansion.leaves,
            waits,
        }
    }

    /// Returns the least clock among the pairs, never later than certified; infinite when all are
    /// finished.
    #[inline]
    pub(crate) fn clock(&self) -> f64 {
        let free = self.free.least();
        if free > 0.0 {
            // One step down undoes the rounding of the sum.
            greater(self.since, (self.since + f64::from(free)).next_down())
        } else {
            self.since
        }
    }

    /// Takes out the pair of least clock.
    #[inline]
    pub(crate) fn take_least(&mut self, problem: &Problem<'_>) -> Next {
        let advanced = self.clock() > self.since;
        let lane = self.free.take_least();
        let Split {
            body, node, other, ..
        } = self.split;
        let child = self.first + lane as NodeId;
        // A second look at the same instant would give the same result.
        if advanced && self.waits >> lane & 1 == 1 {
            return Next::Split(Split {
                lanes: 1 << lane,
                ..Split::all(body, node, other)
            });
        }
        if self.thicker >> lane & 1 == 1 {
            return Next::Split(Split::all(body, child, other));
        }
        let child_piece = body.of(problem).body.tree().piece(child);
        let other_piece = body.other().of(problem).body.tree().piece(other);
        match (child_piece, other_piece, body) {
            (Some(a), Some(b), Which::A) | (Some(b), Some(a), Which::B) => Next::Ask(a, b),
            _ => Next::Split(Split::all(body.other(), other, child)),
        }
    }
}

/// Returns a mask of the first `count` lanes.
fn lanes_below(count: u32) -> u8 {
    u8::MAX >> (LANES as u32 - count)
}

/// The free times of eight pairs. Each is rounded down to bits that end in the pair's lane. Bits of
/// non-negative numbers order as the numbers do, so the least of them also names its lane.
#[derive(Clone, Copy, Debug)]
struct FreeTimes([u32; LANES]);

const LANE_BITS: u32 = LANES as u32 - 1;

impl FreeTimes {
    /// Lanes that are not used count as finished.
    fn new(free: &[f32; LANES], used: u8) -> Self {
        let mut bits = [0; LANES];
        for (lane, bits) in bits.iter_mut().enumerate() {
            let time = match used >> lane & 1 {
                1 => free[lane],
                _ => f32::INFINITY,
            };
            *bits = time.to_bits() & !LANE_BITS | lane as u32;
        }
        FreeTimes(bits)
    }

    /// Returns the least of the times.
    #[inline]
    fn least(&self) -> f32 {
        f32::from_bits(self.least_bits() & !LANE_BITS)
    }

    /// Finishes the pair of least time, and returns its lane.
    #[inline]
    fn take_least(&mut self) -> usize {
        let least = self.least_bits();
        // All lanes are written at once: the next read need not wait for a single store.
        self.0 = self.0.map(|bits| match bits == least {
            true => f32::INFINITY.to_bits() | LANE_BITS,
            false => bits,
        });
        (least & LANE_BITS) as usize
    }

    #[inline]
    fn least_bits(&self) -> u32 {
        self.0.iter().fold(u32::MAX, |least, &bits| least.min(bits))
    }
}
