//! What all pairs of nodes of a query have in common.

use crate::body::tree::up;
use crate::math::order::greater;
use crate::motion::relative::View;
use crate::problem::{Problem, Which};
use crate::tolerance::{CLOSED_GAP, LEAST_GAP_F32};
use glam::Vec3;
use std::cell::OnceCell;

/// A query, with the numbers that every visit needs of it, rounded to f32 where it does.
#[derive(Debug)]
pub(crate) struct Common<'p> {
    pub(crate) problem: &'p Problem<'p>,
    /// B as A sees it, and A as B does. Each is made at the first split of its body: queries of a few
    /// pieces have none.
    views: [OnceCell<View>; 2],
    /// The spins of A and of B along their own axes, and the angular speeds, rounded up; none of a
    /// body that does not turn.
    spins: [Option<(Vec3, f32)>; 2],
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
            views: [const { OnceCell::new() }; 2],
            spins: [&problem.a.path, &problem.b.path].map(|path| {
                path.turns()
                    .then(|| (path.spin_local.as_vec3(), up(path.rate)))
            }),
            margin: up(problem.margin),
            node_gap: up(problem.node_gap()),
            rounding: up(problem.rounding),
            closed: greater(LEAST_GAP_F32, (CLOSED_GAP * problem.tolerance) as f32),
        }
    }

    /// Returns the other body as seen from this one.
    #[inline(always)]
    pub(super) fn view_from(&self, body: Which) -> &View {
        let path = |body: Which| &body.of(self.problem).path;
        self.views[body as usize].get_or_init(|| View::new(path(body), path(body.other())))
    }

    /// Returns the spin of a body along its own axes, and its angular speed, rounded up; none if it
    /// does not turn.
    #[inline(always)]
    pub(super) fn spin(&self, body: Which) -> Option<(Vec3, f32)> {
        self.spins[body as usize]
    }
}
