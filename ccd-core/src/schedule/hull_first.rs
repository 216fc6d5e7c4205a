//! Best first by clock, over pairs of nodes of two hull trees.

use super::Schedule;
use super::best_first::BestFirst;
use super::hulls::{Below, HullPair, Near};
use super::meter::Meter;
use super::moment::Moment;
use super::pair::Pair;
use super::queue::{Full, Queue, Rank};
use super::start::{self, Proven};
use crate::oracle::DistanceOracle;
use crate::order::greater;
use crate::outcome::{Answer, Limit, Outcome};
use crate::problem::Problem;
use crate::tolerance::HULL_PROGRESS;
use std::ops::ControlFlow;

/// Best-first search by time over [hull trees](crate::HullTree): what the paper's trees can do when every
/// pair keeps its own clock.
///
/// As with [`BestFirst`], the pair of least clock is looked at next, until a pair of pieces is within
/// the tolerance. But nodes are convex hulls, so that the oracle is asked about pairs of inner nodes,
/// too, and a pair of nodes advances along the axis that the oracle claims, just as pieces do. A pair
/// is split where it hardly advances; unless its nearest features both belong to pieces
/// ([`FacetClass`](crate::FacetClass)): then its distance is already that of the pieces below, and no
/// split would make it larger.
///
/// Bodies of one piece need no tree. If another body has [none](crate::Body::hull_tree), the query is
/// answered by [`BestFirst`].
///
/// # Guarantee
/// As [`Schedule::solve`]: hulls hold what is below them, whatever the classes of their facets; these
/// only decide what is looked at next.
#[derive(Debug)]
pub struct HullFirst<O: DistanceOracle> {
    queue: Queue<Item<O::Cache>>,
    without_trees: BestFirst<O>,
}

impl<O: DistanceOracle> Default for HullFirst<O> {
    fn default() -> Self {
        HullFirst {
            queue: Queue::default(),
            without_trees: BestFirst::default(),
        }
    }
}

#[derive(Clone, Debug)]
enum Item<C> {
    Nodes(Nodes<C>),
    Pieces(Pair<C>),
}

/// A pair of nodes of which at least one is an inner one.
#[derive(Clone, Debug)]
struct Nodes<C> {
    pair: [u32; 2],
    /// What the oracle left for its next call.
    cache: C,
}

impl<O: DistanceOracle> Schedule<O> for HullFirst<O> {
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let Some(hulls) = HullPair::of(problem) else {
            return self.without_trees.solve(problem, oracle);
        };
        start::answer(problem, oracle, |problem, oracle, meter| {
            let mut search = Search {
                problem,
                hulls,
                queue: &mut self.queue,
                meter,
            };
            let outcome = search.first_contact(oracle);
            let stats = &mut meter.stats;
            stats.peak_front = stats.peak_front.max(self.queue.peak());
            outcome
        })
    }
}

struct Search<'p, C> {
    problem: &'p Problem<'p>,
    hulls: HullPair<'p>,
    queue: &'p mut Queue<Item<C>>,
    meter: &'p mut Meter,
}

impl<C: Clone + Default> Search<'_, C> {
    fn first_contact<O: DistanceOracle<Cache = C>>(&mut self, oracle: &mut O) -> Outcome {
        let problem = self.problem;
        let unresolved = |s: f64, reason| Outcome::Unresolved {
            safe_until: problem.time(s),
            reason,
        };
        let mut proven = Proven::default();
        self.queue.clear();
        if self.push(0.0, [0, 0]).is_err() {
            return unresolved(0.0, Limit::Budget);
        }
        while let Some((s, item)) = self.next() {
            if s > 0.0
                && let Some(outcome) = proven.past_start(problem)
            {
                return outcome;
            }
            if let Err(limit) = self.meter.visit() {
                return unresolved(s, limit);
            }
            let pushed = match item {
                Item::Nodes(nodes) => self.advance(oracle, nodes, s),
                Item::Pieces(mut pair) => {
                    let step = pair.advance(problem, oracle, self.meter, s);
                    match proven.settle(problem, oracle, self.meter, step, s) {
                        ControlFlow::Continue(clock) => self.push_item(clock, Item::Pieces(pair)),
                        ControlFlow::Break(outcome) => return outcome,
                    }
                }
            };
            if pushed.is_err() {
                return unresolved(s, Limit::Budget);
            }
        }
        proven.end(problem)
    }

    /// Looks at a pair of nodes at clock `s`, certifies it further, and lets it wait, or the pairs
    /// below it.
    fn advance<O: DistanceOracle<Cache = C>>(
        &mut self,
        oracle: &mut O,
        mut nodes: Nodes<C>,
        s: f64,
    ) -> Result<(), Full> {
        let problem = self.problem;
        let moment = Moment::of(problem, self.hulls.hulls(nodes.pair), s);
        let Some(checked) = moment.ask(oracle, &mut nodes.cache, self.meter) else {
            // Smaller hulls may be easier.
            return self.split(s, Near::Bridges, &nodes);
        };
        let near = self.hulls.near(nodes.pair, &checked.claim);
        let contact = problem.contact_distance();
        // What is in contact at the start is known there, or not at all.
        let reach = if s > 0.0 { problem.gap() } else { contact };
        // Written so that NaN splits.
        if !(checked.lower > reach) {
            return self.split(s, near, &nodes);
        }
        let free = moment.free_time(&checked, problem.gap());
        self.meter.stats.point_looks += moment.looks();
        let Some(free) = free else {
            return Ok(());
        };
        let clock = greater(s, (s + free).next_down());
        let settled = near == Near::Pieces && checked.upper > contact;
        let worthwhile = settled || free >= HULL_PROGRESS * (1.0 - s);
        match clock > s && worthwhile {
            true => self.push_item(clock, Item::Nodes(nodes)),
            false => self.split(clock, near, &nodes),
        }
    }

    /// Lets the pairs below wait.
    fn split(&mut self, clock: f64, near: Near, nodes: &Nodes<C>) -> Result<(), Full> {
        match self.hulls.below(nodes.pair, near) {
            Below::Pieces(_) => self.push(clock, nodes.pair),
            Below::Pairs(pairs) => pairs
                .into_iter()
                .try_for_each(|pair| self.push(clock, pair)),
        }
    }

    fn push(&mut self, clock: f64, pair: [u32; 2]) -> Result<(), Full> {
        let item = match self.hulls.below(pair, Near::Bridges) {
            Below::Pieces([a, b]) => Item::Pieces(Pair::new(a, b)),
            Below::Pairs(_) => Item::Nodes(Nodes {
                pair,
                cache: C::default(),
            }),
        };
        self.push_item(clock, item)
    }

    fn push_item(&mut self, clock: f64, item: Item<C>) -> Result<(), Full> {
        let rank = match item {
            Item::Nodes(_) => Rank::Group,
            Item::Pieces(_) => Rank::PiecePair,
        };
        match clock < 1.0 {
            true => self.queue.push(clock, rank, item),
            false => Ok(()),
        }
    }

    fn next(&mut self) -> Option<(f64, Item<C>)> {
        let visit = self.queue.visit()?;
        let (clock, item) = (visit.clock, visit.item.clone());
        visit.remove();
        Some((clock, item))
    }
}
