//! What all pairs of nodes of a query have in common.

use crate::body::tree::up;
use crate::math::order::greater;
use crate::motion::relative::{RelativePath, Seen};
use crate::problem::{Problem, Which};
use crate::tolerance::{CLOSED_GAP, LEAST_GAP_F32};
use std::cell::OnceCell;

/// A query, with the numbers that every visit needs of it, rounded to f32 where it does.
#[derive(Debug)]
pub(crate) struct Common<'p> {
    pub(crate) problem: &'p Problem<'p>,
    /// Made at the first visit: queries of a few pieces have none. None when both bodies turn.
    relative: OnceCell<Option<RelativePath>>,
    /// The margin, rounded up.
    pub(super) margin: f32,
    /// The gap that the clocks of pairs of nodes prove, rounded up.
    pub(super) node_gap: f32,
    /// The rounding of distances in f64, rounded up.
    pub(super) rounding: f32,
    /// A gap that exceeds the slack by no more than this counts as closed.
    pub(super) closed: f32,
}

impl<'p> Common<'p> {
    pub(crate) fn new(problem: &'p Problem<'_>) -> Self {
        Common {
            problem,
            relative: OnceCell::new(),
            margin: up(problem.margin),
            node_gap: up(problem.node_gap()),
            rounding: up(problem.rounding),
            closed: greater(LEAST_GAP_F32, (CLOSED_GAP * problem.tolerance) as f32),
        }
    }

    /// Returns the other body as seen from this one.
    #[inline(always)]
    pub(super) fn seen_from(&self, body: Which, s: f64) -> Seen {
        let (a, b) = (&self.problem.a.path, &self.problem.b.path);
        let relative = self.relative.get_or_init(|| RelativePath::new(a, b));
        match (relative, body) {
            (Some(path), Which::A) => path.seen_by_a(s),
            (Some(path), Which::B) => path.seen_by_b(s),
            (None, Which::A) => Seen::at(a, b, s),
            (None, Which::B) => Seen::at(b, a, s),
        }
    }
}
