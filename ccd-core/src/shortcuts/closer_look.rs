//! Tighter f64 bounds for single pairs of nodes, beside the bounds for eight pairs in f32.
//!
//! These bounds are computed only where splits would prove little.

use super::screw::Screw;
use super::{Shortcut, flat_pair};
use crate::engine::meter::Meter;
use crate::engine::nodes::expand::Split;
use crate::engine::nodes::siblings::Siblings;
use crate::problem::{Problem, Side};
use crate::rounding::REACH_F32;
use crate::tuning::{AXIS_ROUNDS, COARSE_F32, SCREW_AFTER};

/// The tighter bounds that are useful for a query.
#[derive(Debug)]
pub(crate) struct CloserLook {
    /// True if the rounding of gaps between the largest nodes, in f32, is too coarse for the gap to be kept.
    fine: bool,
    /// The number of splits so far.
    splits: u64,
    screw: Option<Screw>,
}

impl CloserLook {
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        let radius = |side: &Side<'_>| f64::from(side.body.tree().radius());
        let rounding = f64::from(REACH_F32) * (radius(&problem.a) + radius(&problem.b));
        CloserLook {
            fine: problem.takes(Shortcut::FlatNodes) && rounding > COARSE_F32 * problem.node_gap(),
            splits: 0,
            screw: None,
        }
    }

    /// Removes the pair of least clock, which is `s`, from its siblings, if a later clock is proven for it. Returns
    /// that clock and the pair, which then waits alone.
    #[inline(always)]
    pub(crate) fn part(
        &self,
        problem: &Problem<'_>,
        siblings: &mut Siblings,
        s: f64,
    ) -> Option<(f64, Siblings)> {
        if self.fine && siblings.parted() < AXIS_ROUNDS {
            part_flat(problem, siblings, s)
        } else {
            None
        }
    }

    /// Finishes the pairs of a new split that stay apart for good.
    #[inline(always)]
    pub(crate) fn finish(
        &mut self,
        problem: &Problem<'_>,
        split: &Split,
        s: f64,
        siblings: &mut Siblings,
        meter: &mut Meter,
    ) {
        if self.splits >= SCREW_AFTER {
            self.finish_along_screw(problem, split, s, siblings, meter);
        }
        self.splits += 1;
    }

    #[cold]
    fn finish_along_screw(
        &mut self,
        problem: &Problem<'_>,
        split: &Split,
        s: f64,
        siblings: &mut Siblings,
        meter: &mut Meter,
    ) {
        if self.splits == SCREW_AFTER && problem.takes(Shortcut::Screw) {
            self.screw = Screw::of(problem, &mut meter.memory().profiles);
        }
        // Repeating the test for a single pair would give the same result.
        if let Some(screw) = &self.screw
            && split.lanes == u8::MAX
        {
            let profiles = &mut meter.memory().profiles;
            siblings.finish(|pair| screw.keeps_apart(problem, profiles, pair, s));
        }
    }
}

#[cold]
fn part_flat(problem: &Problem<'_>, siblings: &mut Siblings, s: f64) -> Option<(f64, Siblings)> {
    let free = flat_pair::free_time(problem, siblings.least_pair(), s);
    // One step down undoes the rounding of the sum. Written so that NaN is no clock.
    let clock = (s + free).next_down();
    (clock > s).then(|| (clock, siblings.part_least(clock)))
}
