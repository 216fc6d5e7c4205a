//! Tests the bodies for intersection at equal steps in time, the usual practice without continuous collision detection.

use super::RivalMotion;
use super::obb_tree::{ObbTree, trees_intersect};
use super::resolution::resolution;
use crate::method::solver::{ContactClaim, Reply, Solver};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;

/// The maximum number of samples of one query, which take some seconds.
const MAX_SAMPLES: u64 = 1 << 20;

/// A solver by static intersection tests at equal steps in time.
///
/// # Guarantee
/// None. The steps are so short that no point moves by more than the tolerance from one to the
/// next. A contact is reported up to a step late, and one that begins and ends between two steps is
/// missed. After 2²⁰ steps the rest is unresolved.
///
/// # Source
/// Boxes and their tests: \[OBBTREE96\].
#[derive(Clone, Debug)]
pub struct FixedTimeSteps {
    trees: [ObbTree; 2],
    intersection_stack: Vec<(u32, u32)>,
}

impl FixedTimeSteps {
    /// Builds the trees of both meshes.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Self {
        FixedTimeSteps {
            trees: [a, b].map(ObbTree::new),
            intersection_stack: Vec::new(),
        }
    }

    fn bodies_cross(&mut self, courses: &[RivalMotion; 2], time: f64) -> bool {
        let placement = courses[0].placement_relative_to(&courses[1], time);
        let [a, b] = &self.trees;
        trees_intersect(a, b, &placement, &mut self.intersection_stack)
    }
}

impl Solver for FixedTimeSteps {
    /// Answers a query; the reply counts samples as steps, from the start of the motions to their end.
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply {
        let courses = [RivalMotion::new(&query.a), RivalMotion::new(&query.b)];
        let step = resolution(&courses, &self.trees, tolerance);
        // Bodies at rest are tested twice. The cast saturates, and turns NaN into zero.
        let steps = ((query.duration / step).ceil() as u64).max(1);
        let mut before = 0.0;
        for k in 0..=steps.min(MAX_SAMPLES - 1) {
            let time = query.duration * (k as f64 / steps as f64);
            if self.bodies_cross(&courses, time) {
                let claim = ContactClaim::Contact { time };
                return Reply::new(claim, k + 1);
            }
            before = time;
        }
        let (claim, steps) = if steps < MAX_SAMPLES {
            (ContactClaim::NoContact, steps + 1)
        } else {
            (ContactClaim::Unresolved { safe_until: before }, MAX_SAMPLES)
        };
        Reply::new(claim, steps)
    }
}

#[cfg(test)]
mod tests;
