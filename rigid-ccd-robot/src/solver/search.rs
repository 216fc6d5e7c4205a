//! Searches a path: for any contact, the first contact or the least distance.
//!
//! | step | file |
//! |---|---|
//! | balls about all links, in eight intervals at once | `ball_test.rs` |
//! | the intervals in which a pair may still touch | `search/open_intervals.rs` |
//! | such an interval: steps from the pair's distance forwards and backwards | `search/advance.rs` |
//! | what the steps leave, by bodies: halving | `search/undecided.rs`, `search.rs` |
//! | what a few halvings leave: the engine, pair by pair | `engine_candidates.rs` |
//!
//! Halving: at the midpoint of an interval the search computes the frames of all links, a displacement bound of each
//! part, and the distance of each candidate pair. If the distance exceeds the displacements, the pair is free over the
//! whole interval. The interval is halved for the remaining candidates. Candidates that a few halvings do not decide
//! are left to the engine.

mod advance;
mod open_intervals;
mod start;
mod undecided;

use super::Goal;
use super::ball_test::BallTest;
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
use ccd_core::schedule::VectorInstructions;
use ccd_core::vectorize;
use open_intervals::Intervals;
use rigid_ccd::answer::Limit;
use rigid_ccd::{Error, Settings, Solver};
use start::StartContact;
use std::ops::ControlFlow::{self, Break, Continue};
use std::ops::Range;
use undecided::Undecided;

/// Searches paths, and reuses its memory from search to search.
pub(crate) struct PathSearch<'c> {
    pub(super) cell: &'c Cell,
    /// An error if no pair of the cell is checked.
    compares_any: Result<(), NothingCompared>,
    pub(super) pairs: PartPairs<'c>,
    pub(super) exact_chains: PairChains<'c>,
    pub(super) path: JointPath,
    pub(super) placement: Placement,
    pub(super) periods: Periods,
    /// The first test of a segment, and the intervals that it leaves open.
    pub(super) ball_test: BallTest<'c>,
    intervals: Intervals,
    /// For the open interval of a pair: the joints between both parts, the positions and rates of all joints, and the
    /// intervals that are not searched yet, the latest first.
    joints_between: [Vec<usize>; 2],
    positions: Vec<f64>,
    rates: Vec<f64>,
    unsearched: Vec<[f64; 2]>,
    undecided: Undecided,
    /// The point of the path up to which all pairs are searched, while intervals are searched pair by pair; infinity
    /// otherwise.
    searched_until: f64,
    /// A stack of candidate pairs: the candidates of the whole path, then of its current half, and so on down to the
    /// current interval.
    pub(super) candidates: Vec<PartPair>,
    /// Candidates with non-convex bodies whose hulls are near each other at the current midpoint, or nearer than the
    /// least distance so far.
    pub(super) nonconvex_candidates: Vec<PartPair>,
    /// For the current question, the pairs in contact at the start that are ignored while they separate.
    pub(super) start_contacts: Vec<StartContact>,
    /// The candidates that are left to the engine.
    pub(super) engine_candidates: EngineCandidates,
    pub(super) solver: Solver,
    pub(super) settings: Settings,
    /// The tolerance for the current path: the tolerance of the settings, or a larger one if rounding errors require it.
    pub(super) tolerance: f64,
    // For the current question:
    pub(super) goal: Goal,
    /// The start of the question's interval.
    search_start: f64,
    pub(super) stop_condition: StopCondition,
    pub(crate) result: PathSearchResult,
}

/// The results of a search so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathSearchResult {
    /// The nearest pair and its point of the path. For a question about contacts, the pair in contact.
    pub(crate) nearest: Option<(f64, PartPair)>,
    /// An upper bound of that pair's distance. Used for questions about the distance.
    pub(crate) distance_upper_bound: f64,
    /// The search may ignore everything beyond this point. For the first contact, it is the earliest contact so far.
    pub(crate) end: f64,
    /// The limit that ended the search, and a point of the path: for the first contact, the point up to which the path is
    /// proven free; otherwise 0 or the end of the searched part.
    pub(crate) limit_reached: Option<(Limit, f64)>,
    /// A lower bound of the distances that the engine measured, or 0 after a limit.
    pub(crate) lower: f64,
    /// An upper bound of the contact's distance beyond its margin; 0 if it is within the tolerance.
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

/// The first period of a pair in a segment. It represents all later ones.
#[derive(Clone, Copy)]
struct SearchedPeriod {
    /// The point of the path where the period ends, rounded up.
    end: f64,
    drift: f64,
}

fn drift(period: Option<SearchedPeriod>) -> f64 {
    period.map_or(0.0, |period| period.drift)
}

impl<'c> PathSearch<'c> {
    pub(crate) fn new(cell: &'c Cell) -> Self {
        let placement = Placement::new(cell);
        let pairs = PartPairs::new(cell, &placement.displacement_bounds);
        PathSearch {
            ball_test: BallTest::new(cell, &pairs),
            intervals: Intervals::default(),
            joints_between: Default::default(),
            positions: Vec::new(),
            rates: Vec::new(),
            unsearched: Vec::new(),
            undecided: Undecided::default(),
            searched_until: f64::INFINITY,
            cell,
            compares_any: cell.check_any_compared(),
            pairs,
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

    /// Allocates memory and creates joint chains in advance, for more pairs than most questions need.
    pub(crate) fn prepare(&mut self) {
        let pairs = self.pairs.count().min(MAX_PREPARED_PAIRS);
        self.nonconvex_candidates.reserve(pairs);
        self.candidates.reserve(PREPARED_HALVINGS * pairs);
        self.engine_candidates.reserve(pairs);
        self.exact_chains.prepare();
    }

    /// Sets the settings of all following questions.
    pub(crate) fn set_settings(&mut self, settings: Settings) {
        self.pairs.set_margin(settings.margin);
        self.settings = settings;
    }

    pub(crate) fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns bounds of the least distance after a search for it.
    pub(crate) fn distance_bounds(&self) -> (f64, f64) {
        let PathSearchResult {
            distance_upper_bound: upper,
            lower,
            ..
        } = self.result;
        // The search drops pairs that stay farther apart than the upper bound minus the tolerance.
        let least = upper - self.tolerance - 4.0 * self.placement.rounding;
        (greater(lesser(least, lower), 0.0), upper)
    }

    /// Returns the tolerance that the last answer meets.
    pub(crate) fn met_tolerance(&self) -> f64 {
        let result = &self.result;
        let achieved = match self.goal {
            Goal::AnyContact | Goal::FirstContact => result.distance_beyond_margin,
            Goal::LeastDistance if result.limit_reached.is_some() => 0.0,
            Goal::LeastDistance => {
                let (lower, upper) = self.distance_bounds();
                let excess = |pair: PartPair| {
                    let parts = [pair.a, pair.b].map(|part| &self.cell.parts()[part as usize]);
                    parts[0].excess_over_shape + parts[1].excess_over_shape
                };
                // If no pair was measured, there is no upper bound.
                result
                    .nearest
                    .map_or(0.0, |(_, pair)| upper - lower - excess(pair))
            }
        };
        if achieved > self.tolerance * (1.0 + UNREPORTED_TOLERANCE_SHARE) {
            achieved
        } else {
            self.tolerance
        }
    }

    /// Enlarges the bound of a contact's distance, because the contact is reported at a point that is rounded down.
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

    /// Sets the path of the following questions. The time of the deadline starts now.
    pub(crate) fn begin<P: Path + ?Sized>(&mut self, path: &P) -> Result<(), PathError> {
        self.stop_condition = StopCondition::starting_now(&self.settings);
        path.write_to(self.cell, &mut self.path)?;
        self.compares_any.clone()?;
        self.cell.check_plane_reach(self.path.magnitudes())?;
        self.placement.begin(self.cell, &self.path);
        let (kinematics, coordinates) = (self.cell.kinematics(), self.placement.coordinates);
        let longest_arm = largest_arm(kinematics, coordinates, self.path.magnitudes());
        self.ball_test
            .set_path(longest_arm, self.placement.rounding);
        // One half is added to margins. The other half bounds the errors of measured distances.
        let rounding = 4.0 * self.placement.rounding;
        self.tolerance = greater(self.settings.tolerance, rounding);
        let limit = || DriftLimit {
            largest_arm: longest_arm,
            rounding: self.placement.rounding,
            max_drift: MAX_DRIFT_SHARE * self.tolerance,
        };
        self.periods.set_path(kinematics, &self.path, limit);
        Ok(())
    }

    /// Answers a question about an interval of the path. The answer is in `result`.
    pub(crate) fn answer_question(
        &mut self,
        goal: Goal,
        interval: PathInterval,
    ) -> Result<(), Error> {
        self.begin_question(goal, &interval);
        match self.search_all_pairs(interval)? {
            Break(()) => Ok(()),
            Continue(()) => self.decide_engine_candidates(),
        }
    }

    /// Searches an interval for all pairs, except for those in contact at the start. Leaves some to the engine.
    pub(super) fn search_all_pairs(&mut self, interval: PathInterval) -> StepResult {
        if self.uses_ball_test() {
            self.search_stretches(interval)
        } else {
            self.candidates.clear();
            self.search(interval, None)
        }
    }

    pub(super) fn begin_question(&mut self, goal: Goal, interval: &PathInterval) {
        self.goal = goal;
        self.search_start = interval.from;
        self.searched_until = f64::INFINITY;
        self.stop_condition.begin_search(interval);
        self.result = PathSearchResult::NOTHING_FOUND;
        self.start_contacts.clear();
        self.pairs.ignored.clear();
        self.candidates.clear();
        self.engine_candidates.clear();
    }

    /// Returns the interval of the whole path.
    pub(crate) fn whole_path_interval(&self) -> PathInterval {
        PathInterval::whole_path(self.path.segment_count())
    }

    /// Computes the frames of all links at a point of the path, and returns them.
    pub(crate) fn place_frames(&mut self, at: f64) -> &Placement {
        self.placement.place_frames(self.cell, &self.path, at);
        &self.placement
    }

    /// Searches an interval for the candidates with the indices `among`, or for all candidates if it is `None`. Leaves
    /// candidates that stay undecided to the engine.
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
        let simd_level = VectorInstructions::Best.simd_level();
        let Continue(first) =
            vectorize!(simd_level, _token => self.measure_candidates(interval, among))
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
                // The start of a planner's edge is usually free.
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

    /// Ends the search if a limit is reached. Everything before the interval and before the engine's candidates has
    /// been searched.
    pub(super) fn check_limit(&mut self, interval: &PathInterval) -> ControlFlow<()> {
        self.check_limit_before(interval.from)
    }

    /// Ends the search if a limit is reached. Everything before `from`, before the current stretch or open interval, and
    /// before the engine's candidates has been searched.
    pub(super) fn check_limit_before(&mut self, from: f64) -> ControlFlow<()> {
        let Some(limit) = self.stop_condition.reached_limit() else {
            return Continue(());
        };
        let searched_until = lesser(from, self.searched_until);
        let searched_until = lesser(searched_until, self.engine_candidates.earliest_start());
        self.result.limit_reached = Some((limit, searched_until));
        self.result.lower = 0.0;
        Break(())
    }

    /// Tests the candidates at the midpoint of an interval, and appends the undecided ones to the stack. Returns the
    /// index of the first appended candidate.
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
        // One unit for the interval, and one for each pair.
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

    /// Returns the searched period of a pair in an interval, if joints make many turns in its segment.
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

    /// Bounds the difference between a candidate's distances in its searched period and in later periods.
    pub(super) fn drift(&self, candidate: &EngineCandidate) -> f64 {
        if self.periods.is_empty() {
            return 0.0;
        }
        drift(self.searched_period(candidate.from, &candidate.pair))
    }

    /// Returns the thresholds of a pair. `drift` bounds how much nearer the pair may be in later periods.
    #[inline(always)]
    pub(super) fn thresholds(&self, pair: &PartPair, drift: f64) -> Thresholds {
        let tolerance = self.tolerance;
        match self.goal {
            Goal::AnyContact | Goal::FirstContact => Thresholds {
                free_distance_threshold: pair.margin + drift,
                near_distance: pair.margin + tolerance,
            },
            // Touching hulls end the search. Other distances have to be measured exactly.
            Goal::LeastDistance => Thresholds {
                free_distance_threshold: self.result.distance_upper_bound - tolerance + drift,
                near_distance: 0.0,
            },
        }
    }

    /// Returns whether a pair is left to the engine if the test over this interval does not decide it.
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

    /// Appends all pairs that may come near each other in the current interval.
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
        if self.goal == Goal::LeastDistance {
            // The nearest pairs come first. Their distances then exclude others by bounding volumes alone.
            for pair in &mut self.candidates[first..] {
                pair.distance_to_proof_ratio =
                    bounding_volume_gap(self.cell, &self.placement, pair);
            }
            sort_by_proof_distance(&mut self.candidates[first..]);
        }
    }

    /// Returns whether an upper bound is the least so far, in a search for the least distance.
    #[inline(always)]
    pub(super) fn is_nearest(&self, upper: f64) -> bool {
        self.goal == Goal::LeastDistance && upper < self.result.distance_upper_bound
    }

    /// Records a pair as the nearest so far, with an upper bound of its distance.
    pub(super) fn record_nearest(&mut self, pair: &PartPair, at: f64, upper: f64) {
        self.result.distance_upper_bound = upper;
        self.result.nearest = Some((at, *pair));
    }

    /// Records a contact of a pair, unless an earlier contact is known. The pair's distance is at most margin + tolerance
    /// or margin + `distance_beyond_margin`, whichever is larger. Ends the search, unless the goal is the first contact.
    pub(super) fn record_contact(
        &mut self,
        pair: &PartPair,
        at: f64,
        distance_beyond_margin: f64,
    ) -> ControlFlow<()> {
        // A pair in contact at the start may have touched earlier, at a point that is no midpoint.
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
