//! Tighter bounds in f64 for single pairs of nodes, if the bounds of eight pairs at once in f32 are too coarse.
//!
//! These bounds are computed only where splits would prove little.

use crate::engine::meter::Meter;
use crate::engine::nodes::siblings::Siblings;
use crate::engine::nodes::split::Split;
use crate::engine::shortcuts::flat_nodes;
use crate::engine::shortcuts::screw::Screw;
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::GAP_ERROR_PER_RADIUS_F32;
use crate::settings::Shortcut;
use crate::tuning::{F64_FALLBACK_THRESHOLD, MAX_NEWTON_STEPS, SPLITS_BEFORE_SCREW};

/// Computes tighter bounds for single pairs of nodes of a query, where splitting nodes would prove little.
#[derive(Debug)]
pub(crate) struct BoundTightener {
    /// Whether the rounding of gaps in f32 is too large for the gap that the largest nodes have to keep.
    is_f32_coarse: bool,
    /// The number of splits in the search so far.
    split_count: u64,
    screw: Option<Screw>,
}

impl BoundTightener {
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        let radius = |side: &BodyWithPath<'_>| f64::from(side.body.tree().radius());
        let rounding =
            f64::from(GAP_ERROR_PER_RADIUS_F32) * (radius(&problem.a) + radius(&problem.b));
        BoundTightener {
            is_f32_coarse: problem.uses_shortcut(Shortcut::FlatNodes)
                && rounding > F64_FALLBACK_THRESHOLD * problem.kept_node_gap(),
            split_count: 0,
            screw: None,
        }
    }

    /// Takes the pair with the least clock, `s`, out of its siblings if it can be proven apart for longer. Returns the
    /// later clock and the pair, which then waits alone.
    #[inline(always)]
    pub(crate) fn advance_least_pair(
        &self,
        problem: &Problem<'_>,
        siblings: &mut Siblings,
        s: f64,
    ) -> Option<(f64, Siblings)> {
        if self.is_f32_coarse && siblings.advance_count() < MAX_NEWTON_STEPS {
            advance_flat_pair(problem, siblings, s)
        } else {
            None
        }
    }

    /// Marks pairs of a new split as finished if surfaces of the screw motion prove them apart to the end.
    #[inline(always)]
    pub(crate) fn finish_proven_pairs(
        &mut self,
        problem: &Problem<'_>,
        split: &Split,
        s: f64,
        siblings: &mut Siblings,
        meter: &mut Meter,
    ) {
        if self.split_count >= SPLITS_BEFORE_SCREW {
            self.finish_pairs_along_screw(problem, split, s, siblings, meter);
        }
        self.split_count += 1;
    }

    #[cold]
    fn finish_pairs_along_screw(
        &mut self,
        problem: &Problem<'_>,
        split: &Split,
        s: f64,
        siblings: &mut Siblings,
        meter: &mut Meter,
    ) {
        if self.split_count == SPLITS_BEFORE_SCREW && problem.uses_shortcut(Shortcut::Screw) {
            self.screw =
                Screw::for_problem(problem, &mut meter.scratch_memory().screw_profile_cache);
        }
        // Repeating the test for a single pair would give the same result.
        if let Some(screw) = &self.screw
            && split.lane_mask == u8::MAX
        {
            let profiles = &mut meter.scratch_memory().screw_profile_cache;
            siblings.finish_proven_pairs(|pair| screw.free_time(problem, profiles, pair, s));
        }
    }
}

#[cold]
fn advance_flat_pair(
    problem: &Problem<'_>,
    siblings: &mut Siblings,
    s: f64,
) -> Option<(f64, Siblings)> {
    let free = flat_nodes::free_time(problem, siblings.least_pair(), s);
    // One step down undoes the rounding of the sum. Written so that NaN is no clock.
    let clock = (s + free).next_down();
    (clock > s).then(|| (clock, siblings.remove_least_pair(clock)))
}
