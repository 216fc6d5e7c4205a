//! Decides which pairs of links can touch at all, within the joint limits.

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

/// Whether two links touch, over all configurations within the joint limits.
///
/// All variants are to be handled, so that no unproven pair passes for a proven one: the enum is exhaustive.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkContactClass {
    /// The links never touch. This is proven for all configurations.
    Never,
    /// The links touch in every configuration, to within two nanometres. The proof is one of these: no joint moves one
    /// relative to the other; both contain the same point of the axis of the only joint between them; or the shapes of
    /// two convex bodies overlap in every box of configurations. The proof is about the shapes inside the bodies, not
    /// only about the bodies that [enclose](rigid_ccd::Body::excess) them.
    Always,
    /// The bodies touch in every configuration, but the shapes that they enclose are not proven to. An SRDF file does
    /// not disable such a pair, unless the links are adjacent.
    AlwaysAsEnclosed,
    /// The links touch in one configuration and are apart in another.
    Sometimes {
        /// A configuration where they touch.
        touching_configuration: Vec<f64>,
        /// A configuration where they are apart.
        apart_configuration: Vec<f64>,
    },
    /// A limit was reached before a proof.
    Undecided {
        /// The fraction of the configuration space, by volume, where the links are proven apart.
        proven_apart_fraction: f64,
        /// The fraction of the configuration space where nothing is proven.
        undecided_fraction: f64,
        /// The least distance that was measured: 0 if the links touch, infinite if nothing was measured.
        least_distance: f64,
        /// A configuration where they touch, if one was found.
        touching_configuration: Option<Vec<f64>>,
        /// A configuration where they are apart, if one was found.
        apart_configuration: Option<Vec<f64>>,
    },
}

impl LinkContactClass {
    /// Returns whether the class is proven.
    pub fn is_decided(&self) -> bool {
        !matches!(self, LinkContactClass::Undecided { .. })
    }
}

/// The limits of a classification of link pairs. Pairs without a proof by then are [`LinkContactClass::Undecided`].
#[derive(Clone, Debug)]
pub struct LinkContactSettings {
    /// The average number of boxes of configurations that are examined for each pair. What one pair does not need is
    /// left for the others. Pairs that touch without overlapping in some configuration, such as sliding parts, get no
    /// extra boxes, because no box around such a configuration can be decided.
    pub max_boxes: usize,
    /// The time limit for all pairs together; `None` for no limit. With a limit, answers depend on the machine.
    pub deadline: Option<Duration>,
    /// A flag with which another thread can stop the search.
    pub stop: Option<Arc<AtomicBool>>,
}

impl LinkContactSettings {
    /// The default settings: 100,000 boxes for each pair, no deadline.
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
    /// Classifies each pair of links with bodies: they touch never, always or sometimes.
    ///
    /// First, witness configurations are searched at random and by descent to lower distances. Then a branch and bound
    /// search covers the positions of the joints between the links with boxes. For each box, the distance at its
    /// center is compared with a bound of how far the links move within it. Undecided boxes are halved, the largest
    /// first.
    ///
    /// The search runs in rounds, with more boxes for each pair from round to round. Pairs with the smallest undecided
    /// volume come first. All cores share the pairs. A revolute joint without limits is searched over one turn.
    /// `progress` is called from any thread with the number of decided pairs and of all pairs.
    ///
    /// # Guarantee
    /// [`LinkContactClass::Never`] and [`LinkContactClass::Always`] are proven in floating point. Witness
    /// configurations are exact up to the rounding of positions; they are about the bodies, not about the shapes that
    /// these [enclose](rigid_ccd::Body::excess). Without a deadline and a stop flag, the same call gives the same
    /// answers on any number of threads.
    ///
    /// # Errors
    /// The error of a distance query.
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
            // The sort below is stable.
            let quota_of = |pair: usize| records[pair].quota(boxes, settings.max_boxes);
            let mut open: Vec<usize> = (0..all)
                .filter(|&pair| !records[pair].is_decided() && !records[pair].is_exhausted)
                // A search starts again from the box of all positions, so only a larger quota helps.
                .filter(|&pair| quota_of(pair) > records[pair].boxes)
                .collect();
            open.sort_by(|&a, &b| {
                records[a]
                    .undecided_fraction
                    .total_cmp(&records[b].undecided_fraction)
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
