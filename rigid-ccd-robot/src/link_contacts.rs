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
    /// The links touch in every configuration, to within two nanometres. There are three kinds of proof: no joint moves
    /// one link relative to the other; both contain the same point of the axis of the only joint between them; or the
    /// shapes of two convex bodies overlap in every box of configurations. The proof is about the shapes inside the
    /// bodies, not only about the bodies that [enclose](rigid_ccd::Body::excess) them.
    Always,
    /// The bodies touch in every configuration, but it is not proven that the shapes inside them touch.
    /// [`Robot::to_srdf`] does not disable such a pair, unless the links are adjacent.
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
    /// Returns the name of the class in tables, commands and other languages.
    pub const fn name(&self) -> &'static str {
        match self {
            LinkContactClass::Never => "never",
            LinkContactClass::Always => "always",
            LinkContactClass::AlwaysAsEnclosed => "always-as-enclosed",
            LinkContactClass::Sometimes { .. } => "sometimes",
            LinkContactClass::Undecided { .. } => "undecided",
        }
    }

    /// Returns whether the class is proven.
    pub fn is_decided(&self) -> bool {
        !matches!(self, LinkContactClass::Undecided { .. })
    }
}

/// The limits of a classification of link pairs. A pair that is not decided when a limit is reached is
/// [`LinkContactClass::Undecided`].
#[derive(Clone, Debug)]
pub struct LinkContactSettings {
    /// The largest average number of boxes of configurations that are examined for each pair. Boxes that one pair does
    /// not need are available to the others. A pair that touches without overlapping in some configuration, such as two
    /// sliding parts, gets no extra boxes, because no box around that configuration can be decided.
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
    /// The search starts with random configurations and descends to lower distances, to find witnesses: a configuration
    /// where the links touch, and one where they are apart. Branch and bound then covers the positions of the joints
    /// between the links with boxes. For each box, it compares the distance at the center with a bound of how far the
    /// links move within the box. It halves undecided boxes, the largest first.
    ///
    /// The search runs in rounds, with more boxes for each pair from round to round. In each round, pairs with the
    /// smallest undecided volume come first. The pairs are distributed over all cores. A revolute joint without limits
    /// is searched over one turn. `progress` is called from any thread with the number of decided pairs and the number
    /// of all pairs.
    ///
    /// # Guarantee
    /// The proofs of [`LinkContactClass::Never`] and [`LinkContactClass::Always`] include all rounding errors. Witness
    /// configurations are exact up to the rounding of positions. They are about the bodies, not about the shapes that
    /// the bodies [enclose](rigid_ccd::Body::excess). Without a deadline and a stop flag, the same call gives the same
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
        let (pair_count, decided_count) = (records.len(), AtomicUsize::new(0));
        let mut boxes_left = settings.max_boxes.saturating_mul(pair_count);
        let mut boxes_per_pair = lesser(FIRST_ROUND_BOXES, settings.max_boxes);
        while boxes_left > 0 && !end.is_reached() {
            // The sort below is stable.
            let quota_of = |pair: usize| records[pair].quota(boxes_per_pair, settings.max_boxes);
            let mut undecided_pairs: Vec<usize> = (0..pair_count)
                .filter(|&pair| !records[pair].is_decided() && !records[pair].is_exhausted)
                // A search starts again from the box of all positions, so only a larger quota helps.
                .filter(|&pair| quota_of(pair) > records[pair].boxes)
                .collect();
            undecided_pairs.sort_by(|&a, &b| {
                records[a]
                    .undecided_fraction
                    .total_cmp(&records[b].undecided_fraction)
            });
            let quotas = undecided_pairs.iter().map_while(|&pair| {
                let quota = lesser(quota_of(pair), boxes_left);
                boxes_left -= quota;
                (quota > records[pair].boxes).then_some((pair, quota))
            });
            let quotas: Vec<(usize, usize)> = quotas.collect();
            if quotas.is_empty() {
                break;
            }
            let new_records = searches.map(&quotas, |search, &(pair, quota)| {
                let mut record = records[pair].clone();
                search.search(&mut record, quota)?;
                decided_count.fetch_add(usize::from(record.is_decided()), Ordering::Relaxed);
                progress(decided_count.load(Ordering::Relaxed), pair_count);
                Ok::<_, Error>(record)
            });
            for ((pair, quota), record) in quotas.into_iter().zip(new_records) {
                records[pair] = record?;
                boxes_left += quota - lesser(quota, records[pair].boxes);
            }
            boxes_per_pair = boxes_per_pair.saturating_mul(ROUND_FACTOR);
        }
        let classes = records
            .into_iter()
            .map(|record| (record.links, record.class(&cell)));
        Ok(classes.collect())
    }
}

#[cfg(test)]
pub(crate) mod tests;
