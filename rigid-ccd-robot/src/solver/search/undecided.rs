//! Intervals of pairs that steps do not decide: they are searched by halving, all parts of two bodies together.

use super::PathSearch;
use crate::path::interval::{PathInterval, StepResult};
use crate::solver::Goal;
use crate::solver::part_pairs::PartPair;
use ccd_core::order::{greater, lesser};
use std::ops::ControlFlow::Continue;
use std::ops::Range;

/// All intervals that steps have left undecided.
#[derive(Debug, Default)]
pub(super) struct Undecided {
    intervals: Vec<UndecidedInterval>,
    groups: Vec<Group>,
}

/// An interval of a segment in which a pair may touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct UndecidedInterval {
    pub(super) segment: usize,
    pub(super) bodies: [usize; 2],
    pub(super) pair: PartPair,
    pub(super) from: f64,
    pub(super) to: f64,
    /// The least lower bound of the distance that is known.
    pub(super) gap: f32,
}

/// The intervals of two bodies in a segment.
#[derive(Clone, Debug)]
struct Group {
    /// The indices of its intervals.
    intervals: Range<usize>,
    from: f64,
    to: f64,
    gap: f32,
}

impl Undecided {
    pub(super) fn clear(&mut self) {
        self.intervals.clear();
    }

    /// Adds intervals. Returns where the earliest of them begins; infinity if there is none.
    pub(super) fn extend(&mut self, intervals: impl Iterator<Item = UndecidedInterval>) -> f64 {
        let mut earliest = f64::INFINITY;
        for interval in intervals {
            earliest = lesser(earliest, interval.from);
            self.intervals.push(interval);
        }
        earliest
    }

    /// Returns whether there is an interval of two bodies in a segment.
    pub(super) fn contains(&self, segment: usize, bodies: [usize; 2]) -> bool {
        let mut known = self.intervals.iter();
        known.any(|known| known.segment == segment && known.bodies == bodies)
    }

    /// Puts the intervals of the same two bodies in the same segment together.
    fn group(&mut self) {
        let key = |interval: &UndecidedInterval| (interval.segment, interval.bodies);
        self.intervals.sort_unstable_by_key(key);
        self.groups.clear();
        let mut first = 0;
        for same in self.intervals.chunk_by(|a, b| key(a) == key(b)) {
            let mut group = Group {
                intervals: first..first + same.len(),
                from: same[0].from,
                to: same[0].to,
                gap: same[0].gap,
            };
            for interval in same {
                group.from = lesser(group.from, interval.from);
                group.to = greater(group.to, interval.to);
                if interval.gap < group.gap {
                    group.gap = interval.gap;
                }
            }
            first = group.intervals.end;
            self.groups.push(group);
        }
    }
}

impl PathSearch<'_> {
    /// Searches all undecided intervals: the earliest first for the first contact, otherwise the nearest.
    pub(super) fn search_undecided(&mut self) -> StepResult {
        self.undecided.group();
        let mut groups = std::mem::take(&mut self.undecided.groups);
        let goal = self.goal;
        groups.sort_unstable_by(|a, b| match goal {
            Goal::FirstContact => a.from.total_cmp(&b.from),
            Goal::AnyContact | Goal::LeastDistance => a.gap.total_cmp(&b.gap),
        });
        let mut step = Ok(Continue(()));
        for group in &groups {
            if self.goal == Goal::FirstContact {
                self.searched_until = group.from;
            }
            step = self.search_group(group);
            if !matches!(step, Ok(Continue(()))) {
                break;
            }
        }
        self.undecided.groups = groups;
        step
    }

    fn search_group(&mut self, group: &Group) -> StepResult {
        self.candidates.clear();
        for UndecidedInterval { pair, .. } in &self.undecided.intervals[group.intervals.clone()] {
            let is_other = |known: &PartPair| [known.a, known.b] != [pair.a, pair.b];
            if self.candidates.iter().all(is_other) {
                self.candidates.push(*pair);
            }
        }
        let (from, to) = (group.from, group.to);
        let interval = PathInterval::within_segment(from, to, self.segment_count());
        let all = 0..self.candidates.len();
        self.search(interval, Some(all))
    }
}
