//! The loop of every search: the next waiting pair is proven apart for longer, or split.

use super::meter::Meter;
use super::nodes::common::NodeContext;
use super::nodes::expand::expand;
use super::nodes::siblings::{NextStep, Siblings};
use super::pieces::contact_rule::PairStep;
use super::pieces::pair::Pair;
use super::queue::{QueueFull, Rank, Worklist};
use crate::answer::Limit;
use crate::distance::oracle::DistanceOracle;
use crate::engine::closer_look::BoundTightener;
use crate::motion::free_time::FreeTime;
use crate::problem::Problem;
use std::ops::ControlFlow;

/// A waiting item: the children of a split node, or a pair of pieces.
#[derive(Debug)]
pub(crate) enum WaitingItem<C> {
    Siblings(Siblings),
    Pieces(Pair<C>),
}

impl<C> WaitingItem<C> {
    fn rank(&self) -> Rank {
        match self {
            WaitingItem::Siblings(_) => Rank::Siblings,
            WaitingItem::Pieces(_) => Rank::PiecePair,
        }
    }
}

/// The question that a search answers, which decides after each step whether the search goes on.
pub(crate) trait SearchHandler<O: DistanceOracle> {
    /// The type of the result that ends a search, such as an outcome.
    type Conclusion;

    /// Decides from the clock of the next pair whether the search ends before the pair is examined.
    #[inline]
    fn stop_before_clock(
        &mut self,
        _problem: &Problem<'_>,
        _s: f64,
    ) -> ControlFlow<Self::Conclusion> {
        ControlFlow::Continue(())
    }

    /// Processes the advance of a pair of pieces: returns for how long the pair stays apart, or the result. A pair that
    /// stays apart to the end is dropped.
    fn on_advance(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        advance: AdvanceResult,
    ) -> ControlFlow<Self::Conclusion, FreeTime>;

    /// Returns the result of a search that reaches a limit at clock `s`.
    fn on_limit(&mut self, problem: &Problem<'_>, s: f64, limit: Limit) -> Self::Conclusion;

    /// Returns the result of a search whose pairs are all proven apart to the end.
    fn on_end(&mut self, problem: &Problem<'_>) -> Self::Conclusion;
}

/// The result of looking at a pair of pieces at its clock, the time until which it is proven apart.
pub(crate) struct AdvanceResult {
    /// The indices of the pieces in the problem.
    pub(crate) piece_pair: [u32; 2],
    /// The clock at which the pair was examined.
    pub(crate) clock: f64,
    /// The free time, the contact, or the failure of the pair.
    pub(crate) step_outcome: PairStep,
}

/// The state of a search: the oracle, the waiting pairs and the counters.
pub(crate) struct Search<'s, O, W> {
    worklist: &'s mut W,
    pub(crate) oracle: &'s mut O,
    pub(crate) meter: &'s mut Meter,
}

impl<'s, O: DistanceOracle, W: Worklist<WaitingItem<O::Cache>>> Search<'s, O, W> {
    #[inline]
    pub(crate) fn new(waiting: &'s mut W, oracle: &'s mut O, meter: &'s mut Meter) -> Self {
        Search {
            worklist: waiting,
            oracle,
            meter,
        }
    }

    /// Runs the search from the pair of both roots until it has a result.
    pub(crate) fn run<Q: SearchHandler<O>>(
        &mut self,
        problem: &Problem<'_>,
        question: &mut Q,
    ) -> Q::Conclusion {
        if self.push_roots(problem).is_err() {
            return question.on_limit(problem, 0.0, Limit::Budget);
        }
        self.resume(problem, &mut BoundTightener::new(problem), question)
    }

    /// Examines one waiting pair after another until the search has a result.
    pub(crate) fn resume<Q: SearchHandler<O>>(
        &mut self,
        problem: &Problem<'_>,
        look: &mut BoundTightener,
        question: &mut Q,
    ) -> Q::Conclusion {
        let common = NodeContext::new(problem);
        loop {
            if let ControlFlow::Break(found) = self.visit_next_pair(&common, look, question) {
                return found;
            }
        }
    }

    /// Adds the pair of both roots to the waiting pairs.
    pub(crate) fn push_roots(&mut self, problem: &Problem<'_>) -> Result<(), QueueFull> {
        let item = match NextStep::roots(problem) {
            NextStep::MeasurePieces(a, b) => WaitingItem::Pieces(Pair::new(a, b)),
            NextStep::Split(split) => WaitingItem::Siblings(Siblings::roots(split.body)),
        };
        self.worklist.push(0.0, item.rank(), item)
    }

    /// Examines the next pair: proves it apart for longer, or splits it.
    #[inline(always)]
    pub(crate) fn visit_next_pair<Q: SearchHandler<O>>(
        &mut self,
        common: &NodeContext<'_>,
        look: &mut BoundTightener,
        question: &mut Q,
    ) -> ControlFlow<Q::Conclusion> {
        let problem = common.problem;
        let Search {
            worklist: waiting,
            oracle,
            meter,
        } = self;
        let Some((s, item)) = waiting.peek_next() else {
            return ControlFlow::Break(question.on_end(problem));
        };
        question.stop_before_clock(problem, s)?;
        if let Err(limit) = meter.count_visit_and_check_limits(problem) {
            return ControlFlow::Break(question.on_limit(problem, s, limit));
        }
        let siblings = match item {
            WaitingItem::Pieces(pair) => {
                let advance = advance(problem, *oracle, meter, pair, s);
                let free = question.on_advance(problem, *oracle, meter, advance)?;
                match free.clock_after(s) {
                    clock if clock >= 1.0 => waiting.remove_next(),
                    clock => waiting.postpone(clock),
                }
                return ControlFlow::Continue(());
            }
            WaitingItem::Siblings(siblings) => siblings,
        };
        if let Some((clock, alone)) = look.advance_least_pair(problem, siblings, s) {
            let rest = siblings.clock();
            let waits = self.requeue_rest_and_push(rest, clock, WaitingItem::Siblings(alone));
            return continue_unless_full(waits, problem, question, s);
        }
        let next = siblings.take_next_step(problem, s);
        // The remaining siblings wait for their own clocks.
        let rest = siblings.clock();
        let waits = match next {
            NextStep::Split(split) => {
                let mut siblings = expand(common, &split, s);
                look.finish_proven_pairs(problem, &split, s, &mut siblings, meter);
                let clock = siblings.clock();
                self.requeue_rest_and_push(rest, clock, WaitingItem::Siblings(siblings))
            }
            NextStep::MeasurePieces(a, b) => {
                let mut pair = Pair::new(a, b);
                let advance = advance(problem, *oracle, meter, &mut pair, s);
                let free = question.on_advance(problem, *oracle, meter, advance)?;
                let clock = free.clock_after(s);
                self.requeue_rest_and_push(rest, clock, WaitingItem::Pieces(pair))
            }
        };
        continue_unless_full(waits, problem, question, s)
    }

    /// Lets what remains of the examined item wait on, and adds the item that follows from it. Items with a clock after the
    /// end are dropped.
    #[inline(always)]
    fn requeue_rest_and_push(
        &mut self,
        rest: f64,
        clock: f64,
        item: WaitingItem<O::Cache>,
    ) -> Result<(), QueueFull> {
        let rank = item.rank();
        // Written so that NaN is not the end.
        match (rest >= 1.0, clock >= 1.0) {
            (false, false) => {
                self.worklist.postpone(rest);
                self.worklist.push(clock, rank, item)?;
            }
            (false, true) => self.worklist.postpone(rest),
            (true, false) => self.worklist.replace_next(clock, rank, item),
            (true, true) => self.worklist.remove_next(),
        }
        Ok(())
    }
}

#[inline(always)]
fn advance<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    pair: &mut Pair<O::Cache>,
    clock: f64,
) -> AdvanceResult {
    AdvanceResult {
        piece_pair: [pair.a, pair.b],
        clock,
        step_outcome: pair.advance(problem, oracle, meter, clock),
    }
}

#[inline(always)]
fn continue_unless_full<O: DistanceOracle, Q: SearchHandler<O>>(
    waits: Result<(), QueueFull>,
    problem: &Problem<'_>,
    question: &mut Q,
    s: f64,
) -> ControlFlow<Q::Conclusion> {
    match waits {
        Ok(()) => ControlFlow::Continue(()),
        Err(QueueFull) => ControlFlow::Break(question.on_limit(problem, s, Limit::Budget)),
    }
}
