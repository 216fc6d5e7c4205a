//! Searches segments: eight intervals at once, then what they leave open pair by pair.

use super::PathSearch;
use crate::path::interval::{PathInterval, StepResult};
use crate::solver::Goal;
use crate::solver::ball_test::{BallPair, LANES, TestedPair};
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
        self.goal != Goal::LeastDistance && self.path.segment_count() > 0 && self.periods.is_empty()
    }

    /// Searches an interval of a path for contacts, segment by segment.
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
        let step = self.find_open_intervals(segment, &part)?;
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
        let start = segment as f64;
        let among = tested.pairs.clone();
        self.ball_test.test(
            (&self.path, segment),
            [tested.from - start, tested.to - start],
            &self.pairs,
            among.map(|range| &self.intervals.pairs[range]),
        );
        let pair_count = self.ball_test.tested_pair_count();
        self.stop_condition
            .add_work(1 + pair_count as u64 / LANES as u64);
        let boundary = |lane: usize| match lane {
            LANES => tested.to,
            _ => tested.from + (tested.to - tested.from) * (lane as f64 / LANES as f64),
        };
        let middle = |lane: usize| 0.5 * (boundary(lane) + boundary(lane + 1));
        if let Some(touching) = self.ball_test.touching() {
            let pair = self.ball_test.part_pair(&self.pairs, touching.pair);
            self.record_contact(&pair, middle(touching.lane), 0.0)?;
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
                    nearest: middle(if lanes >> pair.nearest & 1 == 1 {
                        usize::from(pair.nearest)
                    } else {
                        lane
                    }),
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
