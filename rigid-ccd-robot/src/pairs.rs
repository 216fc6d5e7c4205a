//! The pairs of links that are checked for collision: the allowed collision matrix of a robot, with a reason for each
//! skipped pair.

use crate::remark::CellRemark;
use crate::robot::Robot;
use crate::skip_reason::{LeftOutPairs, SkipReason};
use std::collections::BTreeMap;
use std::ops::Range;

/// The pairs of a robot's links that are checked for collision, and the reason for each pair that is not. Links are
/// identified by their indices in [`Robot::links`].
///
/// Initially all pairs of links with bodies are checked, except adjacent links and links that do not move relative to
/// each other.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkPairs {
    skip_reasons: BTreeMap<[usize; 2], SkipReason>,
    /// The indices of the links with bodies.
    links_with_bodies: Vec<usize>,
    /// Remarks on the file from which the pairs were read.
    file_remarks: Vec<CellRemark>,
}

impl LinkPairs {
    /// Creates the pairs of a robot. Adjacent links, and links that do not move relative to each other, are not
    /// checked.
    pub fn from_robot(robot: &Robot) -> Self {
        let has_bodies = |&link: &usize| robot.links()[link].has_shapes();
        let links: Vec<usize> = (0..robot.links().len()).filter(has_bodies).collect();
        let mut pairs = LinkPairs {
            skip_reasons: BTreeMap::new(),
            links_with_bodies: links,
            file_remarks: Vec::new(),
        };
        for [one, other] in pairs.all_pairs().collect::<Vec<_>>() {
            let reason = if robot.are_neighbours(one, other) {
                Some(SkipReason::Adjacent)
            } else {
                let is_rigid = robot.are_rigidly_connected(one, other);
                is_rigid.then_some(SkipReason::NoMotion)
            };
            pairs
                .skip_reasons
                .extend(reason.map(|reason| ([one, other], reason)));
        }
        pairs
    }

    /// Returns the remarks on the file from which the pairs were read.
    pub fn file_remarks(&self) -> &[CellRemark] {
        &self.file_remarks
    }

    pub(crate) fn add_file_remarks(&mut self, remarks: impl IntoIterator<Item = CellRemark>) {
        self.file_remarks.extend(remarks);
    }

    /// Excludes a pair, for a reason. If the pair is already excluded, its old reason stays.
    pub fn skip(&mut self, one: usize, other: usize, reason: SkipReason) {
        self.skip_reasons
            .entry(ordered_pair([one, other]))
            .or_insert(reason);
    }

    /// Includes a pair that was excluded.
    pub fn include(&mut self, one: usize, other: usize) {
        self.skip_reasons.remove(&ordered_pair([one, other]));
    }

    /// Returns whether a pair of different links is checked.
    pub fn is_checked(&self, one: usize, other: usize) -> bool {
        one != other
            && [one, other]
                .iter()
                .all(|link| self.links_with_bodies.contains(link))
            && self.skip_reason(one, other).is_none()
    }

    /// Iterates over the checked pairs, the lower index first.
    pub fn checked_pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        self.all_pairs()
            .filter(|pair| !self.skip_reasons.contains_key(pair))
    }

    /// Returns the reason why a pair is not checked; `None` if it is checked.
    pub fn skip_reason(&self, one: usize, other: usize) -> Option<&SkipReason> {
        self.skip_reasons.get(&ordered_pair([one, other]))
    }

    /// Iterates over the pairs of links with bodies that are not checked, each with its reason.
    pub fn skipped_pairs(&self) -> impl Iterator<Item = ([usize; 2], &SkipReason)> {
        self.all_pairs()
            .filter_map(|pair| Some((pair, self.skip_reasons.get(&pair)?)))
    }

    /// Returns the pairs of links with bodies that are not checked, grouped by reason.
    pub(crate) fn left_out_pairs(&self, robot: &Robot) -> Vec<LeftOutPairs> {
        let mut groups: Vec<LeftOutPairs> = Vec::new();
        for (pair, reason) in self.skipped_pairs() {
            let names = pair.map(|link| robot.links()[link].name.clone());
            match groups.iter_mut().find(|group| group.reason == *reason) {
                Some(group) => group.pairs.push(names),
                None => groups.push(LeftOutPairs {
                    reason: reason.clone(),
                    pairs: vec![names],
                }),
            }
        }
        groups
    }

    /// Replaces the skipped pairs within one robot of a combined robot by `pairs_of_robot`. The links of the robot have
    /// the indices `links` in the combined robot. Returns whether the pairs fit the robot: whether they have the same
    /// links with bodies. Otherwise changes nothing.
    #[must_use]
    pub(crate) fn replace_within(
        &mut self,
        links: Range<usize>,
        pairs_of_robot: &LinkPairs,
    ) -> bool {
        let combined_index = |link: &usize| links.start + link;
        let with_bodies = self.links_with_bodies.iter().copied();
        let with_bodies = with_bodies.filter(|link| links.contains(link));
        let expected = pairs_of_robot.links_with_bodies.iter().map(combined_index);
        let mut skipped_links = pairs_of_robot.skip_reasons.keys().flatten();
        let has_links = skipped_links.all(|&link| link < links.len());
        if !has_links || !with_bodies.eq(expected) {
            return false;
        }
        let is_within_robot = |pair: &[usize; 2]| pair.iter().all(|link| links.contains(link));
        self.skip_reasons.retain(|pair, _| !is_within_robot(pair));
        let skipped = pairs_of_robot.skip_reasons.iter();
        let reindexed =
            skipped.map(|(pair, reason)| (pair.map(|link| links.start + link), reason.clone()));
        self.skip_reasons.extend(reindexed);
        true
    }

    /// Iterates over all pairs of links with bodies.
    pub(crate) fn all_pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        let links = self.links_with_bodies.iter().enumerate();
        links.flat_map(|(k, &one)| {
            self.links_with_bodies[k + 1..]
                .iter()
                .map(move |&other| [one, other])
        })
    }
}

/// Returns two indices in ascending order.
#[inline]
pub(crate) fn ordered_pair([one, other]: [usize; 2]) -> [usize; 2] {
    if one <= other {
        [one, other]
    } else {
        [other, one]
    }
}

#[cfg(test)]
mod tests;
