//! The distances at which pairs of bodies count as touching.

use super::{Cell, Item};
use crate::error::RobotError;
use crate::pairs::ordered_pair;
use ccd_core::order::greater;
use rigid_ccd::InputError;
use std::collections::BTreeMap;

/// The paddings of links, which are added to the margin of the settings, and the clearances of pairs, which replace
/// it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Margins {
    /// For each body, its padding: a distance that is added to the margin against obstacles. 0 for obstacles.
    padding_per_body: Vec<f64>,
    /// The clearance of a pair of bodies, by body index, the lower one first.
    clearance_per_pair: BTreeMap<[usize; 2], f64>,
}

impl Cell {
    /// Sets the padding of a link: a distance that is added to its margin against obstacles.
    ///
    /// The padding does not apply between the robot's own links, nor to bodies attached to the link. It has no effect
    /// on a static link, which is never checked against obstacles.
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`], and [`RobotError::Input`] for a distance that is not from 0 to 1e12.
    pub fn set_padding(&mut self, link: &str, distance: f64) -> Result<(), RobotError> {
        self.robot.link_number(link)?;
        check_distance("padding", distance)?;
        for body in self.bodies_of(Item::Link(link)) {
            self.margins.padding_per_body[body] = distance;
        }
        Ok(())
    }

    /// Sets the clearance of a pair: the distance at which the pair counts as touching, instead of margin and padding.
    /// The pair is checked from then on, even if it was allowed to touch or its links are adjacent.
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`], [`RobotError::NoSuchAttachedBody`], [`RobotError::NoSuchObstacle`],
    /// [`RobotError::NeverCompared`], and [`RobotError::Input`] for a distance that is not from 0 to 1e12.
    pub fn set_clearance(&mut self, pair: [Item<'_>; 2], distance: f64) -> Result<(), RobotError> {
        for item in pair {
            self.check_item(item)?;
        }
        check_distance("clearance", distance)?;
        self.forbid_contact(pair)?;
        let [bodies_a, bodies_b] = pair.map(|item| self.bodies_of(item));
        for &a in &bodies_a {
            for &b in &bodies_b {
                self.margins
                    .clearance_per_pair
                    .insert(ordered_pair([a, b]), distance);
            }
        }
        Ok(())
    }

    /// Removes all paddings and clearances, so that all pairs have the margin of the settings. A pair that is checked
    /// because of a clearance stays checked. Returns whether there was a padding or clearance.
    pub fn remove_paddings_and_clearances(&mut self) -> bool {
        let Margins {
            padding_per_body: paddings,
            clearance_per_pair: clearances,
        } = &mut self.margins;
        // Written so that NaN counts.
        let had_paddings_or_clearances =
            !clearances.is_empty() || paddings.iter().any(|&padding| padding != 0.0);
        clearances.clear();
        paddings.fill(0.0);
        had_paddings_or_clearances
    }

    /// Returns the distance at which a pair counts as touching, given the margin of the settings.
    #[inline]
    pub(crate) fn margin(&self, [a, b]: [usize; 2], margin: f64) -> f64 {
        let Margins {
            padding_per_body: paddings,
            clearance_per_pair: clearances,
        } = &self.margins;
        if !clearances.is_empty()
            && let Some(&clearance) = clearances.get(&ordered_pair([a, b]))
        {
            return clearance;
        }
        let count = self.robot_body_count();
        if a < count && b < count {
            margin
        } else {
            margin + paddings[a] + paddings[b]
        }
    }

    /// Returns an upper bound of the distance at which any pair with an obstacle counts as touching.
    pub(crate) fn largest_obstacle_margin(&self, margin: f64) -> f64 {
        let largest = self
            .margins
            .padding_per_body
            .iter()
            .copied()
            .fold(0.0, greater);
        let clearances = self.margins.clearance_per_pair.values().copied();
        clearances.fold(margin + largest, greater)
    }
}

impl Margins {
    /// Inserts a body without padding at a body index.
    pub(super) fn insert_body(&mut self, index: usize) {
        self.padding_per_body.insert(index, 0.0);
        self.reindex(|body| Some(if body < index { body } else { body + 1 }));
    }

    /// Removes a body. `new_index` maps the old index of another body to its new one.
    pub(super) fn remove_body(&mut self, index: usize, new_index: impl Fn(usize) -> Option<usize>) {
        self.padding_per_body.remove(index);
        self.reindex(new_index);
    }

    fn reindex(&mut self, new_index: impl Fn(usize) -> Option<usize>) {
        let clearances = std::mem::take(&mut self.clearance_per_pair).into_iter();
        let reindexed = clearances
            .filter_map(|([a, b], clearance)| Some(([new_index(a)?, new_index(b)?], clearance)));
        self.clearance_per_pair = reindexed.collect();
    }
}

/// Checks that a distance is valid as the margin of a query.
fn check_distance(quantity: &'static str, distance: f64) -> Result<(), InputError> {
    if (0.0..=1e12).contains(&distance) {
        return Ok(());
    }
    let allowed = if distance < 0.0 {
        "at least 0 and at most 1e12; use `allow_contact` for a pair that may touch, and the start policy `leave` for a \
         pair in contact at the start"
    } else {
        "at least 0 and at most 1e12"
    };
    Err(InputError::OutOfRange {
        quantity,
        value: distance,
        allowed,
    })
}
