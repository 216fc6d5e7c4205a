//! Which pairs of links can touch at all, within the limits of all joints.

mod box_motion;
mod hinge;
mod joint_box;
mod joints_between;
mod measuring;
mod search;
mod search_end;
mod witnesses;

use crate::cell::Cell;
use crate::pairs::LinkPairs;
use crate::robot::Robot;
use crate::tuning::{FIRST_ROUND_BOXES, ROUND_FACTOR};
use ccd_core::order::lesser;
use rigid_ccd::{Error, ParallelSolver};
use search::{LinkPairRecord, LinkPairSearch};
use search_end::SearchEnd;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Whether two links touch, over all configurations within the limits of the joints.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkContactClass {
    /// The links never touch: that is proven for all configurations.
    Never,
    /// The links touch in every configuration, to within two nanometres: no joint moves one against the other, or both hold a
    /// point on the axis of the one joint between them, or two of their bodies are convex and overlap in all boxes of
    /// configurations. So do the shapes that bodies [exceed](rigid_ccd::Body::excess).
    Always,
    /// The bodies touch in every configuration, as in [`LinkContactClass::Always`]; that the shapes do that they enclose is not
    /// proven. An SRDF file does not disable such a pair, unless the links are neighbours.
    AlwaysAsEnclosed,
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
        /// The share of the configurations for which nothing is proven.
        undecided_share: f64,
        /// The least distance that was found in a configuration: 0 if the links touch in one, infinite if none was measured.
        least_distance: f64,
        /// A configuration in which they touch, if one was found.
        touching_configuration: Option<Vec<f64>>,
        /// A configuration in which they are apart, if one was found.
        apart_configuration: Option<Vec<f64>>,
    },
}

impl LinkContactClass {
    /// Returns whether it is known whether the links touch.
    pub fn is_decided(&self) -> bool {
        !matches!(self, LinkContactClass::Undecided { .. })
    }
}

/// What ends a search for which links can touch. Pairs that are not decided by then are [`LinkContactClass::Undecided`].
#[derive(Clone, Debug)]
pub struct LinkContactSettings {
    /// The number of boxes of configurations that are examined, for a pair in the mean: what one pair does not need is left for the
    /// others, except those whose links touch without depth, as parts that slide on each other do. No box decides about such.
    pub max_boxes: usize,
    /// The time for all pairs together; `None` for no limit. With it, answers depend on the machine.
    pub deadline: Option<Duration>,
    /// A flag that another thread sets to stop the search; `None` if nothing stops it.
    pub stop: Option<Arc<AtomicBool>>,
}

impl LinkContactSettings {
    /// The default settings: 100,000 boxes, no deadline.
    pub const DEFAULT: LinkContactSettings = LinkContactSettings {
        max_boxes: 100_000,
        deadline: None,
        stop: None,
    };
}

impl Default for LinkContactSettings {
    fn default() -> Self {
        LinkContactSettings::DEFAULT
    }
}

impl Robot {
    /// Decides for each pair of links with bodies whether they never touch, always, or sometimes.
    ///
    /// Configurations in which two links touch, and in which they are apart, are sought at random, and by descent to lesser
    /// distances. The rest is branch and bound over the joints between the links: the distance in the middle of a box of
    /// positions, against bounds of how far both links move within it. Boxes that stay open are halved, the largest first.
    /// Rounds give more and more boxes to each pair that is still open; those of which least is open come first. Pairs are
    /// shared by all cores. Joints without limits turn once. `progress` is called again and again, from any of the threads,
    /// with the number of pairs that are decided, and of all pairs.
    ///
    /// # Guarantee
    /// [`LinkContactClass::Never`] and [`LinkContactClass::Always`] are proofs, in floating point. The configurations of other answers
    /// are proofs as well, up to the rounding of positions; bodies that [exceed](rigid_ccd::Body::excess) their shapes count
    /// as they are. Without a deadline and a stop, the same call gives the same answers on any number of threads.
    ///
    /// # Errors
    /// An error of a query about a distance.
    pub fn classify_link_contacts(
        &self,
        settings: &LinkContactSettings,
        progress: impl Fn(usize, usize) + Sync,
    ) -> Result<Vec<([usize; 2], LinkContactClass)>, Error> {
        let link_pairs = LinkPairs::from_robot(self);
        let mut records: Vec<LinkPairRecord> =
            link_pairs.all_pairs().map(LinkPairRecord::new).collect();
        let cell = Cell::new(self.clone(), link_pairs);
        let end = SearchEnd::starting_now(settings);
        let mut searches = ParallelSolver::new(|| LinkPairSearch::new(&cell, end.clone()));
        let (all, decided) = (records.len(), AtomicUsize::new(0));
        let mut left = settings.max_boxes.saturating_mul(all);
        let mut boxes = lesser(FIRST_ROUND_BOXES, settings.max_boxes);
        while left > 0 && !end.is_reached() {
            // The sort keeps the order of equal ones.
            let quota_of = |pair: usize| records[pair].quota(boxes, settings.max_boxes);
            let mut open: Vec<usize> = (0..all)
                .filter(|&pair| !records[pair].is_decided() && !records[pair].is_exhausted)
                // What was examined before is examined again.
                .filter(|&pair| quota_of(pair) > records[pair].boxes)
                .collect();
            open.sort_by(|&a, &b| {
                records[a]
                    .undecided_share
                    .total_cmp(&records[b].undecided_share)
            });
            let quotas = open.iter().map_while(|&pair| {
                let quota = lesser(quota_of(pair), left);
                left -= quota;
                (quota > records[pair].boxes).then_some((pair, quota))
            });
            let quotas: Vec<(usize, usize)> = quotas.collect();
            if quotas.is_empty() {
                break;
            }
            let found = searches.map(&quotas, |search, &(pair, quota)| {
                let mut record = records[pair].clone();
                search.search(&mut record, quota)?;
                decided.fetch_add(usize::from(record.is_decided()), Ordering::Relaxed);
                progress(decided.load(Ordering::Relaxed), all);
                Ok::<_, Error>(record)
            });
            for ((pair, quota), record) in quotas.into_iter().zip(found) {
                records[pair] = record?;
                left += quota - lesser(quota, records[pair].boxes);
            }
            boxes = boxes.saturating_mul(ROUND_FACTOR);
        }
        let classes = records
            .into_iter()
            .map(|record| (record.links, record.class(&cell)));
        Ok(classes.collect())
    }
}

#[cfg(test)]
pub(crate) mod tests;
