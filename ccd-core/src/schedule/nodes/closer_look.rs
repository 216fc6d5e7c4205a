//! Looks at pairs of nodes in f64 that are closer than the bounds of eight in f32.
//!
//! They are taken only where splits would prove little.

use super::expand::Split;
use super::flat_pair;
use super::screw::Screw;
use super::siblings::Siblings;
use crate::body::tree::NodeId;
use crate::problem::{Problem, Side};
use crate::tolerance::{COARSE_F32, REACH_F32, SCREW_AFTER};

/// The looks that a query has use for.
#[derive(Debug)]
pub(crate) struct CloserLook {
    /// True if the gaps of the largest nodes are rounded by more than they have to be known.
    fine: bool,
    /// The visits left until it is asked whether the motion is a screw.
    left: u64,
    screw: Option<Screw>,
}

impl CloserLook {
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        let radius = |side: &Side<'_>| f64::from(side.body.tree().radius());
        let rounding = f64::from(REACH_F32) * (radius(&problem.a) + radius(&problem.b));
        CloserLook {
            fine: rounding > COARSE_F32 * problem.node_gap(),
            left: SCREW_AFTER,
            screw: None,
        }
    }

    /// Returns a later clock for two nodes, of A and of B, whose clock `s` has run out, if there is
    /// one.
    #[inline]
    pub(crate) fn clock(&self, problem: &Problem<'_>, nodes: [NodeId; 2], s: f64) -> Option<f64> {
        match self.fine {
            true => flat_clock(problem, nodes, s),
            false => None,
        }
    }

    /// Finishes those pairs of a new split that stay apart for good.
    #[inline]
    pub(crate) fn finish(
        &mut self,
        problem: &Problem<'_>,
        split: &Split,
        s: f64,
        siblings: &mut Siblings,
    ) {
        if self.left > 0 {
            self.left -= 1;
            if self.left == 0 {
                self.screw = Screw::of(problem);
            }
        }
        // A second look at a single pair would give the same result.
        if let Some(screw) = &mut self.screw
            && split.lanes == u8::MAX
        {
            siblings.finish(|pair| screw.keeps_apart(problem, pair, s));
        }
    }
}

fn flat_clock(problem: &Problem<'_>, nodes: [NodeId; 2], s: f64) -> Option<f64> {
    // One step down undoes the rounding of the sum. Written so that NaN is no clock.
    let clock = (s + flat_pair::free_time(problem, nodes, s)).next_down();
    (clock > s).then_some(clock)
}
