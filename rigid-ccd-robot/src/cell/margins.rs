//! The distances at which pairs of bodies count as touching.

use super::compared::ordered_pair;
use super::{Cell, Item};
use crate::error::RobotError;
use ccd_core::order::greater;
use rigid_ccd::InputError;
use std::collections::BTreeMap;

/// The distances that some bodies are to keep, besides the margin of the settings.
#[derive(Clone, Debug, Default)]
pub(crate) struct Margins {
    /// For each body, the distance that obstacles have to keep in addition; an obstacle has none.
    padding_per_body: Vec<f64>,
    /// The distance of a pair of bodies, the lower number first.
    clearance_per_pair: BTreeMap<[usize; 2], f64>,
}

impl Cell {
    /// Grows a link as obstacles see it: they are to stay away by this distance in addition to the margin. The robot's own
    /// links, and bodies attached to the link, are not affected. On a link that no joint moves it has no effect, since that link is
    /// not compared with obstacles.
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

    /// Sets the distance at which a pair counts as touching, instead of the margin and the padding. A pair of links that is not
    /// checked, such as neighbours, is checked from then on, and so is a pair that was allowed to touch.
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`], [`RobotError::NoSuchAttachedBody`] or [`RobotError::NoSuchObstacle`], [`RobotError::NeverCompared`], and
    /// [`RobotError::Input`] for a distance that is not from 0 to 1e12.
    pub fn set_clearance(&mut self, pair: [Item<'_>; 2], distance: f64) -> Result<(), RobotError> {
        for item in pair {
            self.check_item(item)?;
        }
        check_distance("clearance", distance)?;
        self.forbid_contact(pair)?;
        let [one, other] = pair.map(|item| self.bodies_of(item));
        for &a in &one {
            for &b in &other {
                self.margins
                    .clearance_per_pair
                    .insert(ordered_pair([a, b]), distance);
            }
        }
        Ok(())
    }

    /// Removes all paddings and clearances, so that all pairs have the margin of the settings. What a clearance checks stays checked.
    /// Returns whether there were any.
    pub fn remove_paddings_and_clearances(&mut self) -> bool {
        let Margins {
            padding_per_body: paddings,
            clearance_per_pair: clearances,
        } = &mut self.margins;
        // Written so that NaN counts.
        let had_any = !clearances.is_empty() || paddings.iter().any(|&own| own != 0.0);
        clearances.clear();
        paddings.fill(0.0);
        had_any
    }

    /// Returns the distance at which a pair of bodies counts as touching.
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

    /// Returns a bound of the distance at which an obstacle counts as touching.
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
    /// Makes place for a body.
    pub(super) fn insert_body(&mut self, number: usize) {
        self.padding_per_body.insert(number, 0.0);
        self.reindex(|body| Some(if body < number { body } else { body + 1 }));
    }

    /// Removes a body, and gives the others the numbers that a function returns.
    pub(super) fn remove_body(&mut self, number: usize, others: impl Fn(usize) -> Option<usize>) {
        self.padding_per_body.remove(number);
        self.reindex(others);
    }

    fn reindex(&mut self, number: impl Fn(usize) -> Option<usize>) {
        let clearances = std::mem::take(&mut self.clearance_per_pair).into_iter();
        let kept = clearances
            .filter_map(|([a, b], clearance)| Some(([number(a)?, number(b)?], clearance)));
        self.clearance_per_pair = kept.collect();
    }
}

/// Refuses a distance that no query takes as its margin.
fn check_distance(quantity: &'static str, distance: f64) -> Result<(), InputError> {
    if (0.0..=1e12).contains(&distance) {
        return Ok(());
    }
    let allowed = if distance < 0.0 {
        "at least 0 and at most 1e12; a pair that may touch is allowed to, and one in contact at the start may part under the \
         start policy `leave`"
    } else {
        "at least 0 and at most 1e12"
    };
    Err(InputError::OutOfRange {
        quantity,
        value: distance,
        allowed,
    })
}
