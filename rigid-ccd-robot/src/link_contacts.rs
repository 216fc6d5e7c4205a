//! Which pairs of links can touch at all, within the limits of all joints.

mod joint_box;
mod search;

use crate::cell::Cell;
use crate::pairs::LinkPairs;
use crate::robot::Robot;
use rigid_ccd::{Error, ParallelSolver};
use search::PairSearch;

/// The distance, in metres, at which a body holds a point of a joint's axis. Two bodies that hold it are at most twice as
/// far apart.
const AXIS_CONTACT_DISTANCE: f64 = 1e-9;

/// Whether two links touch, over all configurations within the limits of the joints.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkContactClass {
    /// The links never touch: that is proven for all configurations.
    Never,
    /// The links touch in every configuration, to within two nanometres: no joint moves one against the other, or both hold a
    /// point on the axis of the one joint between them, or two of their bodies are convex and overlap in all boxes of
    /// configurations.
    Always,
    /// The links touch in one configuration, and are apart in another.
    Sometimes {
        /// A configuration in which they touch.
        touching_configuration: Vec<f64>,
        /// A configuration in which they are apart.
        apart_configuration: Vec<f64>,
    },
    /// The limit of work was reached first.
    Undecided {
        /// The share of the configurations, by volume, for which the links are proven apart.
        proven_apart_share: f64,
        /// A configuration in which they touch, if one was found.
        touching_configuration: Option<Vec<f64>>,
        /// A configuration in which they are apart, if one was found.
        apart_configuration: Option<Vec<f64>>,
    },
}

impl Robot {
    /// Decides for each pair of links with bodies whether they never touch, always, or sometimes.
    ///
    /// Branch and bound over the joints between two links: the distance in the middle of a box of positions, against bounds of
    /// how far both links move within it. Boxes that stay open are halved, the largest first, until `max_boxes` were
    /// examined for a pair. Pairs are shared by all cores. Joints without limits turn once.
    ///
    /// # Guarantee
    /// [`LinkContactClass::Never`] and [`LinkContactClass::Always`] are proofs, in floating point. The configurations of other answers
    /// are proofs as well, up to the rounding of positions; bodies that [exceed](rigid_ccd::Body::excess) their shapes count
    /// as they are.
    ///
    /// # Errors
    /// An error of a query about a distance.
    pub fn classify_link_contacts(
        &self,
        max_boxes: usize,
    ) -> Result<Vec<([usize; 2], LinkContactClass)>, Error> {
        let link_pairs = LinkPairs::from_robot(self);
        let pairs: Vec<[usize; 2]> = link_pairs.all_pairs().collect();
        let cell = Cell::new(self.clone(), link_pairs);
        let mut solvers = ParallelSolver::new(|| PairSearch::new(&cell));
        let meetings = solvers.map(&pairs, |search, &pair| search.decide(pair, max_boxes));
        let meetings = pairs.iter().zip(meetings);
        meetings
            .map(|(&pair, meeting)| Ok((pair, meeting?)))
            .collect()
    }
}

#[cfg(test)]
mod tests;
