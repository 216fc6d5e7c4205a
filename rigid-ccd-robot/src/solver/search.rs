//! The search along a path: whether anything touches, when first, or how near anything comes.
//!
//! The middle of an interval comes first: the frames of all links there, and a bound of how far each part moves from there
//! within the interval. A pair whose distance in the middle exceeds that is free over the whole interval. For the others the
//! interval is halved. What is still open after a few halvings goes to the engine, pair by pair.

mod start;

use super::Goal;
use super::engine_candidates::{EngineCandidate, EngineCandidates};
use super::exact::PairChains;
use super::limits::StopCondition;
use super::measure::{DistanceVerdict, Thresholds, bounding_volume_gap, measure};
use super::part_pairs::{PartPair, PartPairs, sort_by_proof_distance};
use super::periods::{DriftLimit, Period, Periods};
use super::placement::Placement;
use crate::cell::Cell;
use crate::cell::rounding::{UNREPORTED_TOLERANCE_SHARE, largest_arm};
use crate::error::{NothingCompared, PathError};
use crate::path::Path;
use crate::path::interval::{PathInterval, StepResult};
use crate::path::joint_path::JointPath;
use crate::path_point::PathPoint;
use crate::tuning::{
    MAX_APPROACH_INTERVAL_LENGTH, MAX_DRIFT_SHARE, MAX_ENGINE_DISPLACEMENT,
    MAX_ENGINE_INTERVAL_LENGTH, MAX_PREPARED_PAIRS, MIN_ENGINE_HALVINGS, PAIRS_BETWEEN_CLOCK_READS,
    PREPARED_HALVINGS,
};
use ccd_core::order::{greater, lesser};
use ccd_core::vectorize;
use rigid_ccd::answer::Limit;
use rigid_ccd::{Error, Settings, Solver};
use start::StartContact;
use std::ops::ControlFlow::{self, Break, Continue};
use std::ops::Range;

/// Memory for searches along paths, which is kept from one to the next.
pub(crate) struct PathSearch<'c> {
    pub(super) cell: &'c Cell,
    /// Whether any pair of the cell is compared; an error for a question if none is.
    compares_any: Result<(), NothingCompared>,
    pub(super) pairs: PartPairs<'c>,
    pub(super) exact_chains: PairChains<'c>,
    pub(super) path: JointPath,
    pub(super) placement: Placement,
    pub(super) periods: Periods,
    /// Pairs that may touch in the intervals from the whole path down to the current one.
    pub(super) candidates: Vec<PartPair>,
    /// Pairs of bodies that are not convex, whose hulls are near each other in the middle of the interval, or nearer than
    /// what was found.
    pub(super) nonconvex_candidates: Vec<PartPair>,
    /// Pairs in contact at the start of the path that are let go, of the current question.
    pub(super) start_contacts: Vec<StartContact>,
    /// What the engine is to decide.
    pub(super) engine_candidates: EngineCandidates,
    pub(super) solver: Solver,
    pub(super) settings: Settings,
    /// The tolerance of the current path: that of the settings, or what the rounding of positions costs.
    pub(super) tolerance: f64,
    // Of the current question.
    pub(super) goal: Goal,
    /// The start of the interval that the question is about.
    search_start: f64,
    pub(super) stop_condition: StopCondition,
    pub(crate) result: PathSearchResult,
}

/// What a search has found so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathSearchResult {
    /// The nearest pair and where it is nearest; for a question about contacts a pair in contact.
    pub(crate) nearest: Option<(f64, PartPair)>,
    /// An upper bound of the distance of that pair there, for a question about the distance.
    pub(crate) distance_upper_bound: f64,
    /// Nothing beyond this point matters: for the first contact the point of the earliest one.
    pub(crate) end: f64,
    /// The limit that ended the search, and the point up to which everything was searched.
    pub(crate) limit_reached: Option<(Limit, f64)>,
    /// A lower bound of the distance of what the engine measured, and of what a limit left open.
    pub(crate) lower: f64,
    /// How far beyond its margin the pair in contact may be, if that is more than the tolerance.
    pub(crate) distance_beyond_margin: f64,
}

impl PathSearchResult {
    const NOTHING_FOUND: PathSearchResult = PathSearchResult {
        nearest: None,
        distance_upper_bound: f64::INFINITY,
        end: f64::INFINITY,
        limit_reached: None,
        lower: f64::INFINITY,
        distance_beyond_margin: 0.0,
    };
}

/// The first period of a pair in a segment, which stands for the rest of the segment.
#[derive(Clone, Copy)]
struct SearchedPeriod {
    /// The point of the path at which it ends, rounded up.
    end: f64,
    drift: f64,
}

fn drift(period: Option<SearchedPeriod>) -> f64 {
    period.map_or(0.0, |period| period.drift)
}

impl<'c> PathSearch<'c> {
    pub(crate) fn new(cell: &'c Cell) -> Self {
        let placement = Placement::new(cell);
        PathSearch {
            cell,
            compares_any: cell.check_any_compared(),
            pairs: PartPairs::new(cell, &placement.displacement_bounds),
            exact_chains: PairChains::new(cell),
            path: JointPath::default(),
            placement,
            periods: Periods::default(),
            candidates: Vec::new(),
            nonconvex_candidates: Vec::new(),
            start_contacts: Vec::new(),
            engine_candidates: EngineCandidates::default(),
            solver: Solver::new(),
            settings: Settings::DEFAULT,
            tolerance: Settings::DEFAULT.tolerance,
            goal: Goal::AnyContact,
            search_start: 0.0,
            stop_condition: StopCondition::NONE,
            result: PathSearchResult::NOTHING_FOUND,
        }
    }

    /// Makes what questions would make when they need it first, with place for more pairs than most of them leave undecided.
    pub(crate) fn prepare(&mut self) {
        let pairs = self.pairs.count().min(MAX_PREPARED_PAIRS);
        self.nonconvex_candidates.reserve(pairs);
        self.candidates.reserve(PREPARED_HALVINGS * pairs);
        self.engine_candidates.reserve(pairs);
        self.exact_chains.prepare();
    }

    /// Sets the settings of all questions that follow.
    pub(crate) fn set_settings(&mut self, settings: Settings) {
        self.pairs.set_margin(settings.margin);
        self.settings = settings;
    }

    pub(crate) fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns bounds of the least distance, after a question about it.
    pub(crate) fn distance_bounds(&self) -> (f64, f64) {
        let PathSearchResult {
            distance_upper_bound: upper,
            lower,
            ..
        } = self.result;
        // Pairs are left out that stay farther apart than the upper bound at that time, less the tolerance.
        let least = upper - self.tolerance - 4.0 * self.placement.rounding;
        (greater(lesser(least, lower), 0.0), upper)
    }

    /// Returns the tolerance that the last answer meets.
    pub(crate) fn met_tolerance(&self) -> f64 {
        let found = &self.result;
        let shown = match self.goal {
            Goal::AnyContact | Goal::FirstContact => found.distance_beyond_margin,
            Goal::LeastDistance if found.limit_reached.is_some() => 0.0,
            Goal::LeastDistance => {
                let (lower, upper) = self.distance_bounds();
                let excess = |pair: PartPair| {
                    let parts = [pair.a, pair.b].map(|part| &self.cell.parts()[part as usize]);
                    parts[0].excess_over_shape + parts[1].excess_over_shape
                };
                // Without a pair there is no upper bound.
                found
                    .nearest
                    .map_or(0.0, |(_, pair)| upper - lower - excess(pair))
            }
        };
        if shown > self.tolerance * (1.0 + UNREPORTED_TOLERANCE_SHARE) {
            shown
        } else {
            self.tolerance
        }
    }

    /// Takes into account that a contact is reported at a point that is rounded to a number before it.
    pub(crate) fn add_rounding_of_contact_point(&mut self, (at, pair): (f64, PartPair)) {
        if self.segment_count() == 0 {
            return;
        }
        let interval = PathInterval {
            from: at,
            to: at.next_up().next_up(),
            halvings: 0,
        };
        self.placement.place(self.cell, &self.path, &interval);
        self.result.distance_beyond_margin += 2.0 * pair.displacement(&self.placement);
    }

    /// Returns the number of segments of the current path.
    pub(crate) fn segment_count(&self) -> usize {
        self.path.segment_count()
    }

    /// Takes a path, which the questions that follow are about. Their time starts now.
    pub(crate) fn begin<P: Path + ?Sized>(&mut self, path: &P) -> Result<(), PathError> {
        self.stop_condition = StopCondition::starting_now(&self.settings);
        path.write_to(self.cell, &mut self.path)?;
        self.compares_any.clone()?;
        self.cell.check_plane_reach(self.path.magnitudes())?;
        self.placement.begin(self.cell, &self.path);
        // A margin is raised by half of that, and distances may be off by as much.
        let rounding = 4.0 * self.placement.rounding;
        self.tolerance = greater(self.settings.tolerance, rounding);
        let (kinematics, parts) = (self.cell.kinematics(), self.cell.parts());
        let limit = || DriftLimit {
            largest_arm: largest_arm(kinematics, parts, self.path.magnitudes()),
            rounding: self.placement.rounding,
            max_drift: MAX_DRIFT_SHARE * self.tolerance,
        };
        self.periods.set_path(kinematics, &self.path, limit);
        Ok(())
    }

    /// Answers a question about an interval of the path; the answer is in `result`.
    pub(crate) fn answer_question(
        &mut self,
        goal: Goal,
        interval: PathInterval,
    ) -> Result<(), Error> {
        self.begin_question(goal, &interval);
        self.start_contacts.clear();
        match self.search(interval, None)? {
            Break(()) => Ok(()),
            Continue(()) => self.decide_engine_candidates(),
        }
    }

    pub(super) fn begin_question(&mut self, goal: Goal, interval: &PathInterval) {
        self.goal = goal;
        self.search_start = interval.from;
        self.stop_condition.begin_search(interval);
        self.result = PathSearchResult::NOTHING_FOUND;
        self.candidates.clear();
        self.engine_candidates.clear();
    }

    /// Returns the whole path as an interval.
    pub(crate) fn whole_path_interval(&self) -> PathInterval {
        PathInterval::whole_path(self.path.segment_count())
    }

    /// Places the frames of all links at a point of the path, and returns them.
    pub(crate) fn place_frames(&mut self, at: f64) -> &Placement {
        self.placement.place_frames(self.cell, &self.path, at);
        &self.placement
    }

    /// Searches an interval of the path among the given candidate pairs, or among all pairs if there are none. Pairs that
    /// stay open are left to the engine.
    pub(super) fn search(
        &mut self,
        interval: PathInterval,
        among: Option<Range<usize>>,
    ) -> StepResult {
        if interval.from >= self.result.end {
            return Ok(Continue(()));
        }
        if self.check_limit(&interval).is_break() {
            return Ok(Break(()));
        }
        let base = self.candidates.len();
        let level = self.settings.vector_instructions.simd_level();
        let Continue(first) = vectorize!(level, _token => self.measure_candidates(interval, among))
        else {
            return Ok(Break(()));
        };
        if self.check_nonconvex_candidates(&interval)?.is_break() {
            return Ok(Break(()));
        }
        let undecided = first..self.candidates.len();
        if !undecided.is_empty() {
            sort_by_proof_distance(&mut self.candidates[first..]);
            let [earlier, later] = interval.halves();
            let halves = match self.goal {
                Goal::FirstContact => [earlier, later],
                // The start of a planner's edge is free as a rule.
                Goal::AnyContact | Goal::LeastDistance => [later, earlier],
            };
            for half in halves {
                if self.search(half, Some(undecided.clone()))?.is_break() {
                    return Ok(Break(()));
                }
            }
        }
        self.candidates.truncate(base);
        Ok(Continue(()))
    }

    /// Ends the search if a limit is reached: everything before the interval and before open pairs was searched.
    pub(super) fn check_limit(&mut self, interval: &PathInterval) -> ControlFlow<()> {
        let Some(limit) = self.stop_condition.reached_limit() else {
            return Continue(());
        };
        let searched_until = lesser(interval.from, self.engine_candidates.earliest_start());
        self.result.limit_reached = Some((limit, searched_until));
        self.result.lower = 0.0;
        Break(())
    }

    /// Measures the candidates in the middle of an interval, and appends those that are undecided. Returns the index of the
    /// first of these.
    #[inline(always)]
    fn measure_candidates(
        &mut self,
        interval: PathInterval,
        among: Option<Range<usize>>,
    ) -> ControlFlow<(), usize> {
        self.placement.place(self.cell, &self.path, &interval);
        let among = among.unwrap_or_else(|| {
            let first = self.candidates.len();
            self.append_candidates();
            first..self.candidates.len()
        });
        let first = self.candidates.len();
        self.nonconvex_candidates.clear();
        // The interval, and each pair.
        self.stop_condition.add_work(1 + among.len() as u64);
        for k in among {
            if k % PAIRS_BETWEEN_CLOCK_READS == 0 {
                self.check_limit(&interval)?;
            }
            let mut pair = self.candidates[k];
            let period = self.period_of(&interval, &pair);
            if period.is_some_and(|period| interval.from >= period.end) {
                continue;
            }
            let is_last = self.goes_to_engine(&interval, &pair);
            let thresholds = self.thresholds(&pair, drift(period));
            match measure(self.cell, &self.placement, &mut pair, thresholds, !is_last) {
                DistanceVerdict::Free => continue,
                DistanceVerdict::Near if !pair.is_convex(self.cell.parts()) => {
                    self.nonconvex_candidates.push(pair);
                }
                DistanceVerdict::Near => self.record_contact(&pair, interval.middle(), 0.0)?,
                DistanceVerdict::Undecided(upper) if self.is_nearest(upper) => {
                    if pair.is_convex(self.cell.parts()) {
                        self.record_nearest(&pair, interval.middle(), upper);
                    } else {
                        self.nonconvex_candidates.push(pair);
                    }
                }
                DistanceVerdict::Undecided(_) => {}
            }
            if is_last {
                let end = period.map_or(interval.to, |period| lesser(interval.to, period.end));
                let searched = PathInterval {
                    to: end,
                    ..interval
                };
                self.engine_candidates.add_or_merge(
                    pair,
                    pair.body_indices(self.cell.parts()),
                    &searched,
                );
            } else {
                self.candidates.push(pair);
            }
        }
        Continue(first)
    }

    /// Returns the period of a pair in an interval of a segment in which joints turn many times, if it has one.
    #[inline(always)]
    fn period_of(&self, interval: &PathInterval, pair: &PartPair) -> Option<SearchedPeriod> {
        if self.periods.is_empty() || !interval.is_within_segment() {
            return None;
        }
        self.searched_period(interval.from, pair)
    }

    #[cold]
    fn searched_period(&self, at: f64, pair: &PartPair) -> Option<SearchedPeriod> {
        let segment = PathPoint::from_path_position(at, self.segment_count()).segment;
        let frames = [pair.a, pair.b].map(|part| self.cell.parts()[part as usize].frame);
        let Period { length, drift } = self.periods.period(segment, frames)?;
        let start = greater(segment as f64, self.search_start);
        Some(SearchedPeriod {
            end: (start + length).next_up(),
            drift,
        })
    }

    /// Bounds how much the distances of an open pair differ from those at the same phase of other periods, for which it stands.
    pub(super) fn drift(&self, candidate: &EngineCandidate) -> f64 {
        if self.periods.is_empty() {
            return 0.0;
        }
        drift(self.searched_period(candidate.from, &candidate.pair))
    }

    /// Returns the distances that decide about a pair, whose distances in other periods are less by at most the drift.
    #[inline(always)]
    fn thresholds(&self, pair: &PartPair, drift: f64) -> Thresholds {
        let tolerance = self.tolerance;
        match self.goal {
            Goal::AnyContact | Goal::FirstContact => Thresholds {
                free_distance_threshold: pair.margin + drift,
                near_distance: pair.margin + tolerance,
            },
            // Touching hulls end the search; others are measured exactly.
            Goal::LeastDistance => Thresholds {
                free_distance_threshold: self.result.distance_upper_bound - tolerance + drift,
                near_distance: 0.0,
            },
        }
    }

    /// Returns whether a pair goes to the engine unless this interval decides about it.
    #[inline(always)]
    fn goes_to_engine(&self, interval: &PathInterval, pair: &PartPair) -> bool {
        if !interval.is_within_segment() {
            return false;
        }
        let length = interval.to - interval.from;
        let is_short = match self.goal {
            Goal::LeastDistance => length <= MAX_APPROACH_INTERVAL_LENGTH,
            _ => length <= MAX_ENGINE_INTERVAL_LENGTH,
        };
        is_short || {
            let displacement = pair.displacement(&self.placement);
            interval.halvings >= MIN_ENGINE_HALVINGS && displacement < MAX_ENGINE_DISPLACEMENT
        }
    }

    /// Appends all pairs that may come near each other in the interval that is placed.
    #[inline(always)]
    pub(super) fn append_candidates(&mut self) {
        let first = self.candidates.len();
        let allowance = match self.goal {
            Goal::AnyContact | Goal::FirstContact => self.tolerance,
            Goal::LeastDistance => f64::INFINITY,
        };
        let allowance = allowance + 2.0 * self.placement.rounding;
        self.pairs
            .append_candidates(&self.placement, allowance, &mut self.candidates);
        if !self.start_contacts.is_empty() {
            let mut kept = first;
            for k in first..self.candidates.len() {
                let pair = self.candidates[k];
                if !self.is_start_contact(&pair) {
                    self.candidates[kept] = pair;
                    kept += 1;
                }
            }
            self.candidates.truncate(kept);
        }
        if self.goal == Goal::LeastDistance {
            // The nearest bodies first: others are then farther apart than these by their bounding volumes.
            for pair in &mut self.candidates[first..] {
                pair.distance_to_proof_ratio =
                    bounding_volume_gap(self.cell, &self.placement, pair);
            }
            sort_by_proof_distance(&mut self.candidates[first..]);
        }
    }

    /// Returns whether a distance is of interest and the least so far.
    #[inline(always)]
    fn is_nearest(&self, upper: f64) -> bool {
        self.goal == Goal::LeastDistance && upper < self.result.distance_upper_bound
    }

    /// Keeps a pair as the nearest so far, with an upper bound of its distance.
    pub(super) fn record_nearest(&mut self, pair: &PartPair, at: f64, upper: f64) {
        self.result.distance_upper_bound = upper;
        self.result.nearest = Some((at, *pair));
    }

    /// Keeps a contact of a pair at a point, at a distance of at most the margin and the tolerance, or a distance beyond the
    /// margin, unless an earlier contact is known. The search ends unless an earlier one is looked for.
    pub(super) fn record_contact(
        &mut self,
        pair: &PartPair,
        at: f64,
        distance_beyond_margin: f64,
    ) -> ControlFlow<()> {
        // A pair that was let go may have touched earlier, at a point that is no middle of an interval.
        if at > self.result.end {
            return Continue(());
        }
        self.result.distance_beyond_margin = distance_beyond_margin;
        self.result.nearest = Some((at, *pair));
        let parts = self.cell.parts();
        self.result.distance_upper_bound =
            parts[pair.a as usize].excess_over_shape + parts[pair.b as usize].excess_over_shape;
        self.result.lower = 0.0;
        self.result.end = at;
        match self.goal {
            Goal::FirstContact => Continue(()),
            Goal::AnyContact | Goal::LeastDistance => Break(()),
        }
    }
}
