//! Searches a path: eight intervals at once, then what they leave open pair by pair.

use super::PathSearch;
use crate::path::interval::{PathInterval, StepResult};
use crate::path::lanes::{LANES, Lanes};
use crate::solver::Goal;
use crate::solver::ball_test::{BallPair, Margins, TestedPair};
use crate::tuning::{
    MAX_DIVISIONS, MAX_SEGMENTS_AT_ONCE, MAX_TESTS_BEFORE_CONTACT, MERGED_INTERVALS,
    NEAREST_PAIR_GROWTH,
};
use ccd_core::order::lesser;
use std::ops::ControlFlow::{self, Break, Continue};
use std::ops::Range;

/// A pair that may touch in an interval of a segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenInterval {
    pub(super) pair: BallPair,
    pub(super) segment: usize,
    pub(super) from: f64,
    pub(super) to: f64,
    /// The point of the path where the pair is nearest, as far as is known.
    pub(super) nearest: f64,
    /// The least lower bound of the distance that is known.
    pub(super) gap: f32,
    /// See [`TestedPair::is_exact`].
    is_exact: bool,
}

/// Eight intervals that are still to be tested.
#[derive(Clone, Debug)]
struct UntestedIntervals {
    from: f64,
    to: f64,
    divisions: u32,
    /// How often a contact was found in them, so that the part before it is tested again.
    tests_before_contact: u32,
    /// The indices of the pairs in [`Intervals::pairs`]; `None` for all pairs.
    pairs: Option<Range<usize>>,
}

/// The intervals that are still to be searched.
#[derive(Debug, Default)]
pub(crate) struct Intervals {
    untested: Vec<UntestedIntervals>,
    /// The pairs of all untested intervals.
    pairs: Vec<TestedPair>,
    pub(super) open: Vec<OpenInterval>,
}

impl PathSearch<'_> {
    /// Returns whether the ball test may be used for the current path and goal.
    pub(super) fn uses_ball_test(&self) -> bool {
        self.path.segment_count() > 0 && self.periods.is_empty()
    }

    /// Searches an interval of a path: some segments at a time if they are at constant rates, otherwise one.
    pub(super) fn search_stretches(&mut self, interval: PathInterval) -> StepResult {
        let segments = if self.path.has_constant_rates() {
            MAX_SEGMENTS_AT_ONCE
        } else {
            1.0
        };
        let mut from = interval.from;
        while from < interval.to && from < self.result.end {
            let to = lesser(interval.to, from.floor() + segments);
            if self.search_stretch([from, to])?.is_break() {
                return Ok(Break(()));
            }
            from = to;
        }
        Ok(Continue(()))
    }

    fn search_stretch(&mut self, [from, to]: [f64; 2]) -> StepResult {
        // If a limit is reached, only what is before the stretch is searched.
        self.searched_until = from;
        let step = match self.find_nearest_pair([from, to])? {
            Break(()) => Break(()),
            Continue(()) => self.find_open_intervals([from, to])?,
        };
        self.searched_until = f64::INFINITY;
        if step.is_break() {
            return Ok(step);
        }
        let mut open = std::mem::take(&mut self.intervals.open);
        let goal = self.goal;
        open.sort_unstable_by(|a, b| {
            let by_gap = a.gap.total_cmp(&b.gap);
            match goal {
                Goal::FirstContact => a.from.total_cmp(&b.from),
                Goal::AnyContact => by_gap,
                // Steps decide the exact ones, and then most others are farther apart.
                Goal::LeastDistance => b.is_exact.cmp(&a.is_exact).then(by_gap),
            }
        });
        let step = self.search_open_intervals(&open, from);
        self.searched_until = f64::INFINITY;
        self.intervals.open = open;
        step
    }

    /// Searches open intervals of a stretch that begins at `start`: by steps, then what they leave.
    fn search_open_intervals(&mut self, open: &[OpenInterval], start: f64) -> StepResult {
        self.undecided.clear();
        let mut earliest_undecided = f64::INFINITY;
        for interval in open {
            // All pairs are searched up to the earliest interval that is left.
            self.searched_until = match self.goal {
                Goal::FirstContact => lesser(interval.from, earliest_undecided),
                Goal::AnyContact | Goal::LeastDistance => start,
            };
            match self.search_open_interval(interval)? {
                Continue(from) => earliest_undecided = lesser(earliest_undecided, from),
                Break(()) => return Ok(Break(())),
            }
        }
        self.search_undecided()
    }

    /// In a search for the least distance, measures a pair that is probably among the nearest, unless some distance is
    /// known. Pairs that stay farther apart are then soon left out.
    fn find_nearest_pair(&mut self, [from, to]: [f64; 2]) -> StepResult {
        if self.goal != Goal::LeastDistance || self.result.distance_upper_bound < f64::INFINITY {
            return Ok(Continue(()));
        }
        if self.check_limit_before(from).is_break() {
            return Ok(Break(()));
        }
        let lanes = Lanes::dividing(from, to);
        let mut within = self.ball_test.largest_radius();
        loop {
            if !self.test_with(Margins::Common(within), &lanes, None) {
                return Ok(Continue(()));
            }
            if self.record_touching(&lanes).is_break() {
                return Ok(Break(()));
            }
            // An infinite distance leaves no pair out. Written so that NaN ends the loop.
            if self.ball_test.open_pairs().next().is_some() || !(within < f64::INFINITY) {
                break;
            }
            within *= NEAREST_PAIR_GROWTH;
            if within > self.ball_test.reach() {
                within = f64::INFINITY;
            }
        }
        let nearest_first = |a: &&TestedPair, b: &&TestedPair| {
            let by_gap = a.least_gap.total_cmp(&b.least_gap);
            b.is_exact().cmp(&a.is_exact()).then(by_gap)
        };
        let Some(nearest) = self.ball_test.open_pairs().min_by(nearest_first) else {
            return Ok(Continue(()));
        };
        let (pair, at) = (nearest.pair, lanes.middle(usize::from(nearest.nearest)));
        let part_pair = self.ball_test.part_pair(&self.pairs, pair);
        if !part_pair.is_convex(self.cell.parts()) {
            let bodies = part_pair.body_indices(self.cell.parts());
            return self.check_nonconvex_candidate(&part_pair, bodies, at);
        }
        let step = self.search_open_interval(&OpenInterval {
            pair,
            segment: (at as usize).min(self.segment_count() - 1),
            from: at,
            to: at,
            nearest: at,
            gap: nearest.least_gap,
            is_exact: nearest.is_exact(),
        })?;
        Ok(match step {
            Continue(_) => Continue(()),
            Break(()) => Break(()),
        })
    }

    /// Runs the ball test over eight intervals, for the pairs `among` or for all. Returns whether it can be used.
    fn test(&mut self, lanes: &Lanes, among: Option<Range<usize>>) -> bool {
        let margins = match self.goal {
            Goal::AnyContact | Goal::FirstContact => Margins::OfPairs,
            Goal::LeastDistance => {
                Margins::Common(self.result.distance_upper_bound - self.tolerance)
            }
        };
        self.test_with(margins, lanes, among)
    }

    fn test_with(&mut self, margins: Margins, lanes: &Lanes, among: Option<Range<usize>>) -> bool {
        let is_usable = self.ball_test.test(
            (&self.path, lanes),
            (&self.pairs, margins),
            among.map(|range| &self.intervals.pairs[range]),
        );
        let pair_count = self.ball_test.tested_pair_count();
        self.stop_condition
            .add_work(1 + pair_count as u64 / LANES as u64);
        is_usable
    }

    /// Records the contact that the ball test has proven, if there is one.
    fn record_touching(&mut self, lanes: &Lanes) -> ControlFlow<()> {
        let Some(touching) = self.ball_test.touching() else {
            return Continue(());
        };
        let pair = self.ball_test.part_pair(&self.pairs, touching.pair);
        self.record_contact(&pair, lanes.middle(touching.lane), 0.0)
    }

    /// Tests the intervals of a stretch, and collects what stays open.
    fn find_open_intervals(&mut self, [from, to]: [f64; 2]) -> StepResult {
        let Intervals {
            untested,
            pairs,
            open,
        } = &mut self.intervals;
        pairs.clear();
        open.clear();
        untested.clear();
        untested.push(UntestedIntervals {
            from,
            to,
            divisions: 0,
            tests_before_contact: 0,
            pairs: None,
        });
        while let Some(next) = self.intervals.untested.pop() {
            if self.check_limit_before(from).is_break() {
                return Ok(Break(()));
            }
            if next.from >= self.result.end {
                continue;
            }
            let lanes = Lanes::dividing(next.from, next.to);
            let step = if next.tests_before_contact > MAX_TESTS_BEFORE_CONTACT
                || !self.test(&lanes, next.pairs.clone())
            {
                self.search_by_halving([next.from, next.to])?
            } else {
                self.evaluate_test(&next, &lanes)
            };
            if step.is_break() {
                return Ok(step);
            }
        }
        Ok(Continue(()))
    }

    /// Searches an interval for all pairs without the ball test, segment by segment.
    fn search_by_halving(&mut self, [mut from, to]: [f64; 2]) -> StepResult {
        while from < to {
            let end = lesser(to, from.floor() + 1.0);
            self.candidates.clear();
            let interval = PathInterval::within_segment(from, end, self.segment_count());
            if self.search(interval, None)?.is_break() {
                return Ok(Break(()));
            }
            from = end;
        }
        Ok(Continue(()))
    }

    /// Divides those of the tested intervals that have parts of several segments or in which a ball gets far, and
    /// collects the others that are open.
    fn evaluate_test(&mut self, tested: &UntestedIntervals, lanes: &Lanes) -> ControlFlow<()> {
        if self.ball_test.touching().is_some() {
            self.record_touching(lanes)?;
            // Some pairs were not compared before the contact.
            return self.test_before_contact(tested);
        }
        // Shorter intervals help little against boxes around bodies.
        let divides = |pair: &TestedPair| match tested.divisions {
            0 => true,
            divisions => divisions < MAX_DIVISIONS && pair.is_exact(),
        };
        let in_several = |lane: &usize| lanes.segment(*lane).is_none();
        let long = (0..LANES).filter(in_several);
        let long = long.fold(0, |lanes, lane| lanes | 1 << lane);
        let mut divided = 0;
        for pair in self.ball_test.open_pairs() {
            divided |= pair.open & long;
            if divides(pair) {
                divided |= pair.far_moving;
            }
        }
        // The earliest interval is tested next.
        for lane in (0..LANES).rev() {
            let [from, to] = lanes.ends(lane);
            if divided >> lane & 1 == 0 || !(from < to) {
                continue;
            }
            let first = self.intervals.pairs.len();
            let open = self.ball_test.open_pairs();
            let in_lane = open.filter(|pair| pair.open >> lane & 1 == 1);
            self.intervals.pairs.extend(in_lane);
            self.intervals.untested.push(UntestedIntervals {
                from,
                to,
                divisions: tested.divisions + u32::from(lanes.only_segment().is_some()),
                tests_before_contact: tested.tests_before_contact,
                pairs: Some(first..self.intervals.pairs.len()),
            });
        }
        for pair in self.ball_test.open_pairs() {
            let is_open = |lane: usize| (pair.open & !divided) >> lane & 1 == 1;
            for lane in 0..LANES {
                let (true, Some(segment)) = (is_open(lane), lanes.segment(lane)) else {
                    continue;
                };
                let [from, to] = lanes.ends(lane);
                // An interval without length belongs to the one beside it, and may be after the last segment.
                if !(from < to) {
                    continue;
                }
                let nearest = usize::from(pair.nearest);
                let is_beside = is_open(nearest) && lanes.segment(nearest) == Some(segment);
                let nearest = lanes.middle(if is_beside { nearest } else { lane });
                // An adjacent interval of the pair is among the last ones, unless many pairs are open.
                let mut recent = self.intervals.open.iter_mut().rev().take(MERGED_INTERVALS);
                let adjacent = recent.find(|known| {
                    (known.pair, known.segment, known.to) == (pair.pair, segment, from)
                });
                if let Some(known) = adjacent {
                    known.to = to;
                    if pair.least_gap < known.gap {
                        (known.gap, known.nearest) = (pair.least_gap, nearest);
                    }
                    continue;
                }
                self.intervals.open.push(OpenInterval {
                    pair: pair.pair,
                    segment,
                    from,
                    to,
                    nearest,
                    gap: pair.least_gap,
                    is_exact: pair.is_exact(),
                });
            }
        }
        Continue(())
    }

    /// Tests the part of eight intervals before a contact that was found in them.
    fn test_before_contact(&mut self, tested: &UntestedIntervals) -> ControlFlow<()> {
        let to = lesser(tested.to, self.result.end);
        if tested.from < to {
            self.intervals.untested.push(UntestedIntervals {
                to,
                tests_before_contact: tested.tests_before_contact + 1,
                ..tested.clone()
            });
        }
        Continue(())
    }
}
