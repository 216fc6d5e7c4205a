//! The waiting stretches of time of a search along trajectories, and the budget left for them.

use super::motions::StretchMotions;
use crate::answer::{Contact, Limit, Outcome, Stats};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::run_metered;
use crate::engine::scratch::{Scratch, SpanLists};
use crate::engine::start::search_contact_at_start;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::motion::span::Span;
use crate::motion::trajectory::Trajectory;
use crate::query::{MovingBody, Query};
use crate::settings::QuerySettings;
use crate::tuning::{
    CUT_DEVIATION_RATIO, MAX_BUDGET_PARTS, MAX_DEVIATION_SHARE, MIN_CUT_LENGTH_SHARE,
};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// A stack of the stretches of time that wait to be searched, with the work done so far.
pub(super) struct WaitingStretches<'j, 'a> {
    pub(super) query: &'j Query<'a>,
    /// The waiting stretches, in reverse order of their searches.
    pub(super) waiting_spans: Vec<Span>,
    pub(super) stats: Stats,
    spent_work_by_part: WorkByPart,
    was_start_examined: bool,
    /// The stretch that was proven last, with its deviation.
    last_proven_stretch: Option<(Span, f64)>,
    /// The time at which the query started; `None` if there is no deadline. No clock is read then.
    query_started_at: Option<Instant>,
}

impl<'j, 'a> WaitingStretches<'j, 'a> {
    /// Creates the stack with the whole duration of the query as the only stretch, in memory of an earlier query.
    pub(super) fn new(query: &'j Query<'a>, memory: SpanLists) -> Self {
        let SpanLists {
            mut waiting_spans,
            mut work_by_part,
        } = memory;
        waiting_spans.clear();
        waiting_spans.push(Span {
            from: 0.0,
            end: query.duration,
            part_index: 0,
        });
        work_by_part.clear();
        work_by_part.push(0);
        WaitingStretches {
            query,
            waiting_spans,
            stats: Stats::default(),
            spent_work_by_part: WorkByPart {
                work_by_part,
                current_part_index: 0,
                work_at_part_start: 0,
            },
            was_start_examined: false,
            last_proven_stretch: None,
            query_started_at: query.settings.deadline.map(|_| Instant::now()),
        }
    }

    /// Returns the allocated lists, for reuse by a later query.
    pub(super) fn recycle_lists(self) -> SpanLists {
        SpanLists {
            waiting_spans: self.waiting_spans,
            work_by_part: self.spent_work_by_part.work_by_part,
        }
    }

    pub(super) fn next(&mut self) -> Option<Span> {
        self.waiting_spans.pop()
    }

    /// Returns the earliest time of all waiting stretches; infinite if there are none.
    pub(super) fn earliest_time(&self) -> f64 {
        let starts = self.waiting_spans.iter().map(|span| span.from);
        starts.fold(f64::INFINITY, lesser)
    }

    /// Returns the query's settings with the remaining budget and the remaining time to the deadline, or the limit that
    /// is reached.
    pub(super) fn remaining_settings(&self) -> Result<QuerySettings<'a>, Limit> {
        let terms = &self.query.settings;
        if terms.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            return Err(Limit::Stopped);
        }
        let spent = self
            .spent_work_by_part
            .work_spent_on_current_part(self.stats.budgeted_work());
        let budget = terms.budget.checked_sub(spent);
        let left = |(deadline, begun): (Duration, Instant)| {
            let left = deadline.checked_sub(begun.elapsed());
            left.ok_or(Limit::Deadline)
        };
        let deadline = terms
            .deadline
            .zip(self.query_started_at)
            .map(left)
            .transpose()?;
        Ok(QuerySettings {
            budget: budget.filter(|&left| left > 0).ok_or(Limit::Budget)?,
            deadline,
            ..*terms
        })
    }

    /// Adds the work of one stretch's search to the total, and one iteration for the stretch.
    pub(super) fn add(&mut self, stats: &Stats) {
        // Each stretch counts as one visit, even if its search made none.
        self.stats.iterations += 1;
        self.stats.add(stats);
    }

    /// Adds work on the whole query to the total, without counting it towards the budget of any part.
    pub(super) fn add_uncharged_work(&mut self, stats: &Stats) {
        self.stats.add(stats);
        self.spent_work_by_part.work_at_part_start += stats.budgeted_work();
    }

    /// Returns the approximate motions in a stretch and the remaining settings, or the limit that is reached. The
    /// stretch is cut until the deviations are in the range of a query's lengths.
    pub(super) fn motions_and_settings(
        &mut self,
        mut span: Span,
        accelerations: bool,
    ) -> Result<Result<(StretchMotions, QuerySettings<'a>), Limit>, InputError> {
        loop {
            // All later work counts towards the budget of the part that contains the stretch.
            self.spent_work_by_part
                .switch_to_part(span.part_index, self.stats.budgeted_work());
            let terms = match self.remaining_settings() {
                Ok(terms) => terms,
                Err(reason) => return Ok(Err(reason)),
            };
            let motions = StretchMotions::new(self.query, span)?;
            let motions = if accelerations {
                motions
            } else {
                motions.without_accelerations()
            };
            if motions.is_in_coordinate_range(self.query) || !self.cut(span, 0.5 * span.length()) {
                return Ok(Ok((motions, terms)));
            }
            self.stats.iterations += 1;
            span = self.waiting_spans.pop().unwrap_or(span);
        }
    }

    /// Returns whether a contact of a stretch's motions counts as a contact of the bodies: the deviations are a small
    /// share of the tolerance, or a cut would not reduce them.
    pub(super) fn accepts_contact(&self, motions: &StretchMotions) -> Result<bool, InputError> {
        Ok(
            motions.total_deviation_bound <= MAX_DEVIATION_SHARE * self.query.settings.tolerance
                || self.is_limited_by_rounding(motions)?,
        )
    }

    /// Returns whether the deviations are at most twice those of a stretch of length 0, so that they are mostly
    /// rounding and a cut does not help.
    fn is_limited_by_rounding(&self, motions: &StretchMotions) -> Result<bool, InputError> {
        let least = StretchMotions::new(self.query, motions.span.empty_span_at_start())?;
        Ok(motions.total_deviation_bound <= 2.0 * least.total_deviation_bound)
    }

    /// Returns whether the motions of a stretch start at the poses of the bodies at time 0, up to rounding.
    pub(super) fn starts_at_initial_poses(
        &self,
        motions: &StretchMotions,
    ) -> Result<bool, InputError> {
        Ok(motions.span.from == 0.0
            && (motions.total_deviation_bound == 0.0 || self.is_limited_by_rounding(motions)?))
    }

    /// Schedules a search of the pose at time 0, and after it the stretch again. An overlap of the stretch's motions at
    /// time 0 need not be one of the bodies. Returns false if the start was examined already, and for stretches that
    /// begin later.
    pub(super) fn schedule_start_examination(
        &mut self,
        motions: &StretchMotions,
    ) -> Result<bool, InputError> {
        if motions.span.from > 0.0
            || self.was_start_examined
            || self.starts_at_initial_poses(motions)?
        {
            return Ok(false);
        }
        self.was_start_examined = true;
        self.waiting_spans
            .extend([motions.span, motions.span.empty_span_at_start()]);
        Ok(true)
    }

    /// Records a stretch as the last one in which the bodies are proven apart, with its deviation.
    pub(super) fn record_proven_stretch(&mut self, motions: &StretchMotions) {
        self.last_proven_stretch = Some((motions.span, motions.total_deviation_bound));
    }

    /// Returns the time at which a stretch adjoins the last proven stretch, if its deviations are much larger than
    /// those of that stretch. The stretch is then probably too long.
    pub(super) fn cut_time_if_too_long(&mut self, motions: &StretchMotions) -> Option<f64> {
        let (proven, deviation_bound) = self.last_proven_stretch.take()?;
        let Span { from, end: to, .. } = motions.span;
        let beside = [(from, proven.end), (to, proven.from)];
        let (time, _) = beside.into_iter().find(|(time, other)| time == other)?;
        (motions.total_deviation_bound > CUT_DEVIATION_RATIO * deviation_bound).then_some(time)
    }

    /// Returns the poses of both bodies at a time and the remaining settings, or the limit that is reached.
    pub(super) fn motions_and_settings_at(
        &self,
        time: f64,
    ) -> Result<Result<(StretchMotions, QuerySettings<'a>), Limit>, InputError> {
        let terms = match self.remaining_settings() {
            Ok(terms) => terms,
            Err(reason) => return Ok(Err(reason)),
        };
        let span = Span {
            from: time,
            end: time,
            part_index: self.spent_work_by_part.current_part_index,
        };
        Ok(Ok((StretchMotions::new(self.query, span)?, terms)))
    }

    /// Measures the distance of the bodies at a time, up to rounding. Returns the nearest points and the rate at which
    /// the bodies approach; `None` if they overlap, or a limit is reached.
    pub(super) fn measure_distance_at<O: DistanceOracle>(
        &mut self,
        time: f64,
        oracle: &mut O,
        scratch: &mut Scratch,
    ) -> Result<Option<(Contact, f64)>, InputError> {
        let Ok((motions, terms)) = self.motions_and_settings_at(time)? else {
            return Ok(None);
        };
        let problem = motions.problem(self.query, &terms)?.for_distances();
        let answer = run_metered(&problem, oracle, scratch, |oracle, meter| {
            (
                search_contact_at_start(&problem, f64::INFINITY, oracle, meter),
                0.0,
            )
        });
        self.stats.add(&answer.stats);
        Ok(match answer.result {
            Some(Outcome::Touching { contact }) => {
                Some((contact, motions.approach_rate(0.0, &contact)))
            }
            _ => None,
        })
    }

    /// Removes and returns the waiting stretch that begins or ends at a time; `None` if there is none.
    pub(super) fn take_adjacent_stretch(&mut self, time: f64) -> Option<Span> {
        let is_beside = |span: &Span| span.from == time || span.end == time;
        let index = self.waiting_spans.iter().rposition(is_beside)?;
        Some(self.waiting_spans.remove(index))
    }

    /// Adds a stretch, which is searched next.
    pub(super) fn push(&mut self, span: Span) {
        self.waiting_spans.push(span);
    }

    /// Cuts a stretch in two, at a corner of a trajectory or else after about `length`; the earlier part is searched
    /// next. Returns whether the stretch could be cut.
    pub(super) fn cut(&mut self, span: Span, length: f64) -> bool {
        let Some([early, late]) = self.split_span(span, length) else {
            return false;
        };
        self.waiting_spans.extend([late, early]);
        true
    }

    /// Cuts out of a stretch a part of about `length` around a time; this part is searched next. At a corner it is the
    /// part that contains the time. Returns whether the stretch could be cut.
    pub(super) fn cut_out_around(&mut self, span: Span, time: f64, length: f64) -> bool {
        let whole = span.length();
        let Some([early, late]) = self.split_span(span, 0.5 * whole) else {
            return false;
        };
        let half = 0.5 * greater(length, MIN_CUT_LENGTH_SHARE * whole);
        let [first, last] = [time - half, time + half];
        // Written so that NaN, or a length lost to rounding, gives a half of the stretch.
        let is_part = length < 0.5 * whole && first < time && last > time;
        if !is_part || early.end != span.middle_time() {
            if time < late.from {
                self.waiting_spans.extend([late, early]);
            } else {
                self.waiting_spans.extend([early, late]);
            }
            return true;
        }
        let mut middle = span;
        // The rest beside it would be hardly longer.
        if last + half < span.end {
            self.waiting_spans.push(Span { from: last, ..span });
            middle.end = last;
        }
        if first - half > span.from {
            self.waiting_spans.push(Span { end: first, ..span });
            middle.from = first;
        }
        self.waiting_spans.push(middle);
        true
    }

    pub(super) fn split_span(&mut self, span: Span, length: f64) -> Option<[Span; 2]> {
        let is_within = |&at: &f64| at > span.from && at < span.end;
        let corner = |body: &MovingBody<'_>| {
            let corner = body.movement.velocity_jump_time(span.from, span.end);
            corner.filter(is_within)
        };
        let whole = span.length();
        let length = greater(MIN_CUT_LENGTH_SHARE * whole, lesser(length, 0.5 * whole));
        let corner = corner(&self.query.a).or_else(|| corner(&self.query.b));
        let at = Some(corner.unwrap_or(span.from + length)).filter(is_within)?;
        let (mut before, mut after) = (Span { end: at, ..span }, Span { from: at, ..span });
        if corner.is_some() {
            before.part_index = self.spent_work_by_part.add_part(span.part_index);
            after.part_index = self.spent_work_by_part.add_part(span.part_index);
        }
        Some([before, after])
    }
}

/// The work spent on each part of a query. Each part between two corners has its own budget.
struct WorkByPart {
    work_by_part: Vec<u64>,
    /// The index of the part to whose budget work counts at present.
    current_part_index: usize,
    /// The total work of all parts at the time when work began to count towards the present part.
    work_at_part_start: u64,
}

impl WorkByPart {
    /// Returns the work spent on the present part; `work` is the total of all parts.
    fn work_spent_on_current_part(&self, work: u64) -> u64 {
        self.work_by_part[self.current_part_index] + (work - self.work_at_part_start)
    }

    /// Makes all later work count towards the budget of the part of index `part`; `work` is the total of all parts.
    fn switch_to_part(&mut self, part: usize, work: u64) {
        self.work_by_part[self.current_part_index] = self.work_spent_on_current_part(work);
        (self.current_part_index, self.work_at_part_start) = (part, work);
    }

    /// Adds a part with a budget of its own and returns its index, or returns `part` if there are too many parts
    /// already.
    fn add_part(&mut self, part: usize) -> usize {
        if self.work_by_part.len() >= MAX_BUDGET_PARTS {
            return part;
        }
        self.work_by_part.push(0);
        self.work_by_part.len() - 1
    }
}
