//! Every pair keeps its own clock; the pair whose proof expires first is looked at next.

use super::Schedule;
use super::expand::{Expansion, Which, expand};
use super::pair::{Pair, Step};
use super::queue::{Full, Queue, Rank};
use super::start::Start;
use crate::oracle::DistanceOracle;
use crate::outcome::{Answer, Limit, Outcome, Stats};
use crate::problem::Problem;
use crate::tree::{LANES, NodeId};

/// Best-first search by time, the default.
///
/// A pair of nodes carries the time until which it is proven apart. The pair of least clock is split
/// at the pose of that time, and each of its children proven apart further, eight at once. The
/// first pair of pieces found within the tolerance is the answer: every other pair is certified
/// beyond its time. No pass over all pairs ever happens, and no distance is computed but between
/// pieces.
///
/// Keep it between queries: it owns the queue's memory.
#[derive(Debug)]
pub struct BestFirst<O: DistanceOracle> {
    queue: Queue<Item<O::Cache>>,
}

impl<O: DistanceOracle> Default for BestFirst<O> {
    fn default() -> Self {
        BestFirst {
            queue: Queue::default(),
        }
    }
}

#[derive(Debug)]
enum Item<C> {
    Group(Group),
    Pieces(Pair<C>),
}

/// Up to eight pairs that came of one split: the children of a node with one other node.
#[derive(Debug)]
struct Group {
    /// For how long after `since` each pair is certified; infinite once it is done with.
    free: FreeTimes,
    since: f64,
    /// The children's body.
    split: Which,
    first: NodeId,
    other: NodeId,
    /// Which children are thicker than the other node and are to be split next.
    thicker: u8,
    /// Which children are better looked at again than split.
    aloof: u8,
    parent: NodeId,
}

/// What to do with the pair that was looked at.
enum Found<C> {
    /// Two pieces.
    Pieces(Pair<C>),
    /// Split the node of this body against the other's; of the children only those in the mask.
    Split(Which, NodeId, NodeId, u8),
}

impl<O: DistanceOracle> Schedule<O> for BestFirst<O> {
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        self.queue.clear();
        let mut stats = Stats::default();
        let outcome = self.search(problem, oracle, &mut stats);
        stats.peak_front = self.queue.peak();
        Answer {
            outcome,
            tolerance: problem.tolerance,
            stats,
        }
    }
}

impl<O: DistanceOracle> BestFirst<O> {
    fn search(&mut self, problem: &Problem<'_>, oracle: &mut O, stats: &mut Stats) -> Outcome {
        let mut start = Start::default();
        let mut clearance = problem.gap();
        let unresolved = |s: f64, reason| Outcome::Unresolved {
            safe_until: problem.time(s),
            reason,
        };
        if self.open_roots(problem).is_err() {
            return unresolved(0.0, Limit::Budget);
        }
        while let Some((s, found)) = self.next(problem) {
            if s > 0.0
                && let Some(outcome) = start.end(problem)
            {
                return outcome;
            }
            stats.node_visits += 1;
            if stats.node_visits > problem.budget {
                return start.touching().unwrap_or(unresolved(s, Limit::Budget));
            }
            let pushed = match found {
                Found::Split(split, node, other, mask) => {
                    let expansion = expand(problem, split, node, other, s);
                    clearance = clearance.min(f64::from(expansion.bounds.kept));
                    self.push_group(problem, expansion, split, node, other, s, mask)
                }
                Found::Pieces(mut pair) => match pair.advance(problem, oracle, stats, s) {
                    Step::FreeUntil(clock) => self.push_pair(clock, pair),
                    Step::Contact(contact) if s > 0.0 => {
                        let time = problem.time(s);
                        return Outcome::Contact { time, contact };
                    }
                    Step::Contact(contact) => {
                        start.touch(contact);
                        Ok(())
                    }
                    Step::Overlap(contact) => return Start::overlapping(contact),
                    Step::Stalled => return unresolved(s, Limit::Stalled),
                    Step::GaveUp => return unresolved(s, Limit::OracleGaveUp),
                },
            };
            if pushed.is_err() {
                return unresolved(s, Limit::Budget);
            }
        }
        start.end(problem).unwrap_or(Outcome::Free {
            clearance: clearance.max(problem.margin),
        })
    }

    fn open_roots(&mut self, problem: &Problem<'_>) -> Result<(), Full> {
        let item = match (
            problem.a.body.tree().piece(0),
            problem.b.body.tree().piece(0),
        ) {
            (Some(a), Some(b)) => return self.push_pair(0.0, Pair::new(a, b)),
            (None, None) => Group::roots(smaller(problem)),
            (None, Some(_)) => Group::roots(Which::A),
            (Some(_), None) => Group::roots(Which::B),
        };
        self.queue.push(0.0, Rank::Group, Item::Group(item))
    }

    /// Takes out the pair of least clock, and lets the rest of its group wait for theirs.
    fn next(&mut self, problem: &Problem<'_>) -> Option<(f64, Found<O::Cache>)> {
        let visit = self.queue.visit()?;
        let s = visit.clock;
        let found = match visit.item {
            Item::Pieces(pair) => {
                let found = Found::Pieces(pair.clone());
                visit.remove();
                found
            }
            Item::Group(group) => {
                let lane = group.free.take_least();
                let found = group.found(problem, lane);
                match group.clock() {
                    clock if clock < 1.0 => visit.postpone(clock),
                    _ => visit.remove(),
                }
                found
            }
        };
        Some((s, found))
    }

    fn push_group(
        &mut self,
        problem: &Problem<'_>,
        expansion: Expansion,
        split: Which,
        node: NodeId,
        other: NodeId,
        s: f64,
        mask: u8,
    ) -> Result<(), Full> {
        let group = Group::new(problem, &expansion, split, node, other, s, mask);
        let clock = group.clock();
        if clock < 1.0 {
            self.queue.push(clock, Rank::Group, Item::Group(group))?;
        }
        Ok(())
    }

    fn push_pair(&mut self, clock: f64, pair: Pair<O::Cache>) -> Result<(), Full> {
        if clock < 1.0 {
            self.queue
                .push(clock, Rank::PiecePair, Item::Pieces(pair))?;
        }
        Ok(())
    }
}

/// The free times of eight pairs, rounded down to bits that end in the pair's lane: bits of numbers
/// that are not negative order as the numbers do, so that the least of them tells its lane too.
#[derive(Clone, Copy, Debug)]
struct FreeTimes([u32; LANES]);

const LANE_BITS: u32 = LANES as u32 - 1;

impl FreeTimes {
    /// Lanes from `count` on are done with.
    fn new(free: &[f32; LANES], count: u32, mask: u8) -> Self {
        let mut bits = [0; LANES];
        for (lane, bits) in bits.iter_mut().enumerate() {
            let used = (lane as u32) < count && mask >> lane & 1 == 1;
            let time = if used { free[lane] } else { f32::INFINITY };
            *bits = time.to_bits() & !LANE_BITS | lane as u32;
        }
        FreeTimes(bits)
    }

    /// The least of the times, with its lane in its last bits.
    #[inline]
    fn least(&self) -> u32 {
        self.0.iter().fold(u32::MAX, |least, &bits| least.min(bits))
    }

    /// Ends the pair of least time; which one it was.
    #[inline]
    fn take_least(&mut self) -> usize {
        let least = self.least();
        // All lanes are written at once: the next look at them need not wait for a single one.
        self.0 = self.0.map(|bits| match bits == least {
            true => f32::INFINITY.to_bits() | LANE_BITS,
            false => bits,
        });
        (least & LANE_BITS) as usize
    }
}

/// The body whose root is smaller: a large one is best kept whole until it matters.
fn smaller(problem: &Problem<'_>) -> Which {
    let radius = |which: Which| which.of(problem).body.tree().radius();
    match radius(Which::B) < radius(Which::A) {
        true => Which::B,
        false => Which::A,
    }
}

impl Group {
    /// The pair of both roots, of which the given body's is to be split.
    fn roots(split: Which) -> Self {
        Group {
            free: FreeTimes::new(&[0.0; LANES], 1, 1),
            since: 0.0,
            split,
            first: 0,
            other: 0,
            thicker: 1,
            aloof: 0,
            parent: 0,
        }
    }

    fn new(
        problem: &Problem<'_>,
        expansion: &Expansion,
        split: Which,
        parent: NodeId,
        other: NodeId,
        s: f64,
        mask: u8,
    ) -> Self {
        let bounds = &expansion.bounds;
        let other_is_piece = split.other().of(problem).body.tree().piece(other).is_some();
        let mut thicker = 0;
        let mut aloof = 0;
        for lane in 0..LANES {
            thicker |= u8::from(bounds.thicker[lane] > 0.0) << lane;
            aloof |= u8::from(bounds.aloof[lane] > 0.0) << lane;
        }
        if other_is_piece {
            thicker = u8::MAX;
        }
        thicker &= !expansion.leaves;
        Group {
            free: FreeTimes::new(&bounds.free, expansion.count, mask),
            parent,
            aloof,
            since: s,
            split,
            first: expansion.first,
            other,
            thicker,
        }
    }

    /// The least clock among the pairs, never later than what is certified.
    #[inline]
    fn clock(&self) -> f64 {
        let free = f32::from_bits(self.free.least() & !LANE_BITS);
        if free > 0.0 {
            // One step down undoes the rounding of the sum.
            (self.since + f64::from(free)).next_down().max(self.since)
        } else {
            self.since
        }
    }

    fn found<C: Default + Clone>(&self, problem: &Problem<'_>, lane: usize) -> Found<C> {
        let child = self.first + lane as NodeId;
        let (child_tree, other_tree) = (
            self.split.of(problem).body.tree(),
            self.split.other().of(problem).body.tree(),
        );
        if self.aloof >> lane & 1 == 1 {
            return Found::Split(self.split, self.parent, self.other, 1 << lane);
        }
        if self.thicker >> lane & 1 == 1 {
            return Found::Split(self.split, child, self.other, u8::MAX);
        }
        match (child_tree.piece(child), other_tree.piece(self.other)) {
            (Some(child), Some(other)) => Found::Pieces(match self.split {
                Which::A => Pair::new(child, other),
                Which::B => Pair::new(other, child),
            }),
            _ => Found::Split(self.split.other(), self.other, child, u8::MAX),
        }
    }
}
