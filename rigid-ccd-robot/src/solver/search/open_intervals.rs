//! Searches segments: eight intervals at once, then what they leave open pair by pair.

use super::PathSearch;
use crate::path::interval::{PathInterval, StepResult};
use crate::solver::Goal;
use crate::solver::ball_test::{BallPair, LANES, Margins, TestedPair};
use crate::tuning::{MAX_DIVISIONS, MAX_TESTS_BEFORE_CONTACT};
use ccd_core::order::{greater, lesser};
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
    gap: f32,
    /// The number of halvings of the segment that led to the interval.
    pub(super) halvings: u32,
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

/// The intervals of a segment that are still to be searched.
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

    /// Searches an interval of a path, segment by segment.
    pub(super) fn search_segments(&mut self, interval: PathInterval) -> StepResult {
        let mut from = interval.from;
        while from < interval.to && from < self.result.end {
            let segment = from as usize;
            let to = lesser(interval.to, (segment + 1) as f64);
            let part = PathInterval {
                from,
                to,
                halvings: 0,
            };
            if self.search_segment(segment, part)?.is_break() {
                return Ok(Break(()));
            }
            from = to;
        }
        Ok(Continue(()))
    }

    fn search_segment(&mut self, segment: usize, part: PathInterval) -> StepResult {
        if !self.ball_test.set_segment(&self.path, segment) {
            return self.search(part, None);
        }
        // If a limit is reached, only what is before the segment is searched.
        self.searched_until = part.from;
        let step = match self.find_nearest_pair(segment, &part)? {
            Break(()) => Break(()),
            Continue(()) => self.find_open_intervals(segment, &part)?,
        };
        self.searched_until = f64::INFINITY;
        if step.is_break() {
            return Ok(step);
        }
        let mut open = std::mem::take(&mut self.intervals.open);
        match self.goal {
            Goal::FirstContact => open.sort_unstable_by(|a, b| a.from.total_cmp(&b.from)),
            _ => open.sort_unstable_by(|a, b| a.gap.total_cmp(&b.gap)),
        }
        let mut step = Ok(Continue(()));
        for interval in &open {
            // All pairs are searched up to the earliest interval that is left.
            self.searched_until = interval.from;
            step = self.search_open_interval(interval);
            if !matches!(step, Ok(Continue(()))) {
                break;
            }
        }
        self.searched_until = f64::INFINITY;
        self.intervals.open = open;
        step
    }

    /// In a search for the least distance, measures a pair that is probably among the nearest, unless some distance is
    /// known. Pairs that stay farther apart are then soon left out.
    fn find_nearest_pair(&mut self, segment: usize, part: &PathInterval) -> StepResult {
        if self.goal != Goal::LeastDistance || self.result.distance_upper_bound < f64::INFINITY {
            return Ok(Continue(()));
        }
        if self.check_limit(part).is_break() {
            return Ok(Break(()));
        }
        self.test(segment, [part.from, part.to], None);
        if self.record_touching(part.from, part.to).is_break() {
            return Ok(Break(()));
        }
        let by_gap = |a: &&TestedPair, b: &&TestedPair| {
            let key = |pair: &TestedPair| (!pair.is_exact(), pair.least_gap);
            let ((a_is_box, a_gap), (b_is_box, b_gap)) = (key(a), key(b));
            a_is_box.cmp(&b_is_box).then(a_gap.total_cmp(&b_gap))
        };
        let Some(nearest) = self.ball_test.open_pairs().min_by(by_gap) else {
            return Ok(Continue(()));
        };
        let (lane, pair) = (usize::from(nearest.nearest), nearest.pair);
        let at = middle_of_lane(part.from, part.to, lane);
        let part_pair = self.ball_test.part_pair(&self.pairs, pair);
        if !part_pair.is_convex(self.cell.parts()) {
            let bodies = part_pair.body_indices(self.cell.parts());
            return self.check_nonconvex_candidate(&part_pair, bodies, at);
        }
        self.search_open_interval(&OpenInterval {
            pair,
            segment,
            from: at,
            to: at,
            nearest: at,
            gap: nearest.least_gap,
            halvings: 0,
        })
    }

    /// Runs the ball test over eight intervals, for the pairs `among` or for all.
    fn test(&mut self, segment: usize, [from, to]: [f64; 2], among: Option<Range<usize>>) {
        let start = segment as f64;
        let margins = match self.goal {
            Goal::AnyContact | Goal::FirstContact => Margins::OfPairs,
            Goal::LeastDistance => {
                Margins::Common(self.result.distance_upper_bound - self.tolerance)
            }
        };
        self.ball_test.test(
            (&self.path, segment),
            [from - start, to - start],
            (&self.pairs, margins),
            among.map(|range| &self.intervals.pairs[range]),
        );
        let pair_count = self.ball_test.tested_pair_count();
        self.stop_condition
            .add_work(1 + pair_count as u64 / LANES as u64);
    }

    /// Records the contact that the ball test has proven, if there is one.
    fn record_touching(&mut self, from: f64, to: f64) -> ControlFlow<()> {
        let Some(touching) = self.ball_test.touching() else {
            return Continue(());
        };
        let pair = self.ball_test.part_pair(&self.pairs, touching.pair);
        self.record_contact(&pair, middle_of_lane(from, to, touching.lane), 0.0)
    }

    /// Tests the intervals of a segment, and collects what stays open.
    fn find_open_intervals(&mut self, segment: usize, part: &PathInterval) -> StepResult {
        let Intervals {
            untested,
            pairs,
            open,
        } = &mut self.intervals;
        pairs.clear();
        open.clear();
        untested.clear();
        untested.push(UntestedIntervals {
            from: part.from,
            to: part.to,
            divisions: 0,
            tests_before_contact: 0,
            pairs: None,
        });
        while let Some(next) = self.intervals.untested.pop() {
            if self.check_limit(part).is_break() {
                return Ok(Break(()));
            }
            if next.from >= self.result.end {
                continue;
            }
            let step = if next.tests_before_contact > MAX_TESTS_BEFORE_CONTACT {
                self.candidates.clear();
                let interval = PathInterval {
                    from: next.from,
                    to: next.to,
                    halvings: 3 * next.divisions,
                };
                self.search(interval, None)?
            } else {
                self.test_intervals(segment, &next)
            };
            if step.is_break() {
                return Ok(step);
            }
        }
        Ok(Continue(()))
    }

    /// Tests eight intervals. Divides those in which a ball gets far, and collects the others that are open.
    fn test_intervals(&mut self, segment: usize, tested: &UntestedIntervals) -> ControlFlow<()> {
        self.test(segment, [tested.from, tested.to], tested.pairs.clone());
        let boundary = |lane: usize| lane_boundary(tested.from, tested.to, lane);
        if self.ball_test.touching().is_some() {
            self.record_touching(tested.from, tested.to)?;
            // Some pairs were not compared before the contact.
            return self.test_before_contact(tested);
        }
        // Shorter intervals help little against boxes around bodies.
        let divides = |pair: &&TestedPair| match tested.divisions {
            0 => true,
            divisions => divisions < MAX_DIVISIONS && pair.is_exact(),
        };
        let far_moving = self.ball_test.open_pairs().filter(divides);
        let divided = far_moving.fold(0, |lanes, pair| lanes | pair.far_moving);
        // The earliest interval is tested next.
        for lane in (0..LANES).rev() {
            let (from, to) = (boundary(lane), boundary(lane + 1));
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
                divisions: tested.divisions + 1,
                tests_before_contact: tested.tests_before_contact,
                pairs: Some(first..self.intervals.pairs.len()),
            });
        }
        for pair in self.ball_test.open_pairs() {
            let lanes = pair.open & !divided;
            for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
                let interval = OpenInterval {
                    pair: pair.pair,
                    segment,
                    from: boundary(lane),
                    to: boundary(lane + 1),
                    nearest: middle_of_lane(
                        tested.from,
                        tested.to,
                        if lanes >> pair.nearest & 1 == 1 {
                            usize::from(pair.nearest)
                        } else {
                            lane
                        },
                    ),
                    gap: pair.least_gap,
                    halvings: 3 * (tested.divisions + 1),
                };
                add_or_merge(&mut self.intervals.open, interval);
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

/// Returns where one of eight intervals begins; for the number 8, where the last one ends.
fn lane_boundary(from: f64, to: f64, lane: usize) -> f64 {
    match lane {
        LANES => to,
        _ => from + (to - from) * (lane as f64 / LANES as f64),
    }
}

fn middle_of_lane(from: f64, to: f64, lane: usize) -> f64 {
    0.5 * (lane_boundary(from, to, lane) + lane_boundary(from, to, lane + 1))
}

/// Adds an open interval. If the pair has an adjacent interval, both are merged.
fn add_or_merge(open: &mut Vec<OpenInterval>, interval: OpenInterval) {
    let mut same = open.iter_mut().filter(|known| {
        known.pair == interval.pair && known.from <= interval.to && interval.from <= known.to
    });
    match same.next() {
        Some(known) => {
            known.from = lesser(known.from, interval.from);
            known.to = greater(known.to, interval.to);
            known.halvings = known.halvings.min(interval.halvings);
            if interval.gap < known.gap {
                (known.gap, known.nearest) = (interval.gap, interval.nearest);
            }
        }
        None => open.push(interval),
    }
}
