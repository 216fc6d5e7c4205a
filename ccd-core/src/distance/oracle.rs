//! The interface of backends that compute the distance of two pieces.

use crate::answer::Effort;
use crate::body::Body;
use crate::body::piece::{ConvexCombination, Piece};
use crate::motion::pose::Frame;
use glam::DVec3;

/// A backend that computes the nearest points of two convex pieces.
///
/// # Contract
/// For pieces P and Q, given in frame A (Q through [`PiecePair::b_to_a`]), radii ignored:
/// 1. The [`Claim::axis`] points from P to Q. The better it is, the closer the support gap along it
///    comes to the distance. It need not be a unit vector, nor finite.
/// 2. The [`Claim::a`] and [`Claim::b`] name points of P and Q as convex combinations of their
///    points; the nearer they are to the closest pair, the better.
/// 3. When the pieces intersect, both combinations name (nearly) the same point.
/// 4. It ends, after a bounded number of steps, on every input. If it has no answer, it [gives
///    up](GiveUpReason).
/// 5. A cache that belongs to another pair, or to none, changes the time a call takes, not the
///    quality of its answer.
///
/// # Guarantee
/// The engine checks every claim: along any axis n, `min_Q n·y − max_P n·x` bounds the distance
/// from below, and any two points of P and Q bound it from above, no matter what the oracle did
/// ([`Separation`](crate::Separation)). A poor claim makes a query slow or
/// [unresolved](crate::Outcome::Unresolved), never late.
pub trait DistanceOracle {
    /// What a call remembers for the next call on the same pair, such as the last simplex. The default value remembers
    /// nothing.
    type Cache: Clone + Default;

    /// Computes a separating axis and the nearest points of a pair of pieces.
    ///
    /// Returns a [`GiveUpReason`] with the reason if the oracle has no answer; the caller may ask another
    /// one ([`OrElse`]).
    fn separation(
        &mut self,
        pair: &PiecePair<'_>,
        cache: &mut Self::Cache,
    ) -> Result<Claim, GiveUpReason>;

    /// Returns the counters of all calls so far; they are 0 for an oracle that does not count.
    fn effort(&self) -> Effort {
        Effort::default()
    }

    /// Precomputes values for a body, so that its first queries are not slower than later ones.
    ///
    /// # Guarantee
    /// Answers are the same bits with and without this call. An oracle that stores nothing about pieces does nothing
    /// here.
    fn prepare(_body: &Body)
    where
        Self: Sized,
    {
    }

    /// Returns an oracle that calls `other` if this oracle gives up.
    fn or_else<O: DistanceOracle>(self, other: O) -> OrElse<Self, O>
    where
        Self: Sized,
    {
        OrElse {
            first_oracle: self,
            fallback_oracle: other,
            fallbacks: 0,
        }
    }
}

/// Two pieces, each in its own body's frame, and the transform between the frames.
#[derive(Clone, Copy, Debug)]
pub struct PiecePair<'a> {
    /// The piece of body A, in A's frame, which is also the frame of claims. Claims are in A's frame.
    pub a: Piece<'a>,
    /// The piece of body B, in B's frame.
    pub b: Piece<'a>,
    /// The transform from B's frame to A's.
    pub b_to_a: Frame,
}

impl PiecePair<'_> {
    /// Returns the number of points that a search for an extremal point evaluates, summed over both pieces.
    pub(crate) fn points_per_support_search(&self) -> u64 {
        self.a.evaluations_per_search() + self.b.evaluations_per_search()
    }
}

/// An oracle's unchecked result for a pair of pieces, in A's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// The claimed separating axis: a vector of any length that points from A's piece to B's piece.
    pub axis: DVec3,
    /// The claimed point of A's piece that is nearest to B's.
    pub a: ConvexCombination,
    /// The claimed point of B's piece that is nearest to A's.
    pub b: ConvexCombination,
}

/// The reason why an oracle has no result for a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GiveUpReason {
    /// A piece has more points than the oracle supports.
    TooManyPoints,
    /// The oracle needs facets that enclose the pieces' hulls, and a piece has no such facets.
    BadFacets,
    /// The search reached its limit of steps.
    StepCap,
    /// The search returned to an earlier state.
    Cycle,
    /// The oracle could not prove its result, wherever it started its search.
    Uncertified,
}

/// An oracle with a fallback: the second oracle is called if the first gives up. [`DistanceOracle::or_else`] creates
/// it.
#[derive(Clone, Debug, Default)]
pub struct OrElse<First, Second> {
    first_oracle: First,
    fallback_oracle: Second,
    fallbacks: u64,
}

impl<First, Second> OrElse<First, Second> {
    /// Returns how often the second oracle was called.
    pub fn fallbacks(&self) -> u64 {
        self.fallbacks
    }
}

impl<First: DistanceOracle, Second: DistanceOracle> DistanceOracle for OrElse<First, Second> {
    /// The caches of both oracles; the second one is created at the second oracle's first call.
    type Cache = (First::Cache, Option<Second::Cache>);

    fn separation(
        &mut self,
        pair: &PiecePair<'_>,
        cache: &mut Self::Cache,
    ) -> Result<Claim, GiveUpReason> {
        self.first_oracle
            .separation(pair, &mut cache.0)
            .or_else(|_| {
                self.fallbacks += 1;
                self.fallback_oracle
                    .separation(pair, cache.1.get_or_insert_default())
            })
    }

    fn prepare(body: &Body) {
        First::prepare(body);
        Second::prepare(body);
    }

    fn effort(&self) -> Effort {
        let own = Effort {
            fallbacks: self.fallbacks,
            ..Effort::default()
        };
        own + self.first_oracle.effort() + self.fallback_oracle.effort()
    }
}

#[cfg(test)]
mod tests;
