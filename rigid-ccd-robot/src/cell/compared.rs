//! Selects the pairs of bodies that are checked for collision, and stores the allowed contacts.

use super::{Cell, Item};
use crate::error::{NothingCompared, RobotError};
use crate::pairs::ordered_pair;
use crate::skip_reason::SkipReason;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// The pairs of bodies that may touch, by body index, the lower one first. Unchecked pairs of links are not in it.
#[derive(Clone, Debug, Default)]
pub(crate) struct AllowedPairs(BTreeSet<[usize; 2]>);

impl AllowedPairs {
    pub(crate) fn contains(&self, pair: [usize; 2]) -> bool {
        !self.0.is_empty() && self.0.contains(&ordered_pair(pair))
    }

    /// Replaces each body index by the index that `new_index` returns for it. Removes the pairs of a body for which it
    /// returns `None`.
    pub(super) fn reindex(&mut self, new_index: impl Fn(usize) -> Option<usize>) {
        let pairs = std::mem::take(&mut self.0).into_iter();
        self.0 = pairs
            .filter_map(|[a, b]| Some([new_index(a)?, new_index(b)?]))
            .collect();
    }
}

impl Cell {
    /// Allows two items to touch: their pair is no longer checked.
    ///
    /// [`Cell::forbid_contact`] and [`Cell::set_clearance`] check the pair again. Only the last of these calls has an
    /// effect.
    /// Removing an item removes its allowed contacts. A clearance of the pair stays stored, and applies again after
    /// [`Cell::forbid_contact`].
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`], [`RobotError::NoSuchAttachedBody`] or [`RobotError::NoSuchObstacle`], and
    /// [`RobotError::NeverCompared`].
    ///
    /// ```
    /// use rigid_ccd::{Body, Pose, trajectory};
    /// use rigid_ccd_robot::{Cell, Item, Joint, Link, LinkPairs, PositionRule, Robot};
    ///
    /// let lift = Joint {
    ///     name: "lift".into(),
    ///     parent: "base".into(),
    ///     child: "fork".into(),
    ///     geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [0.0, 0.0, 1.0])?,
    ///     position_rule: PositionRule::Independent,
    /// };
    /// let robot = Robot::new(vec![Link::named("base"), Link::named("fork")], vec![lift])?;
    /// let pairs = LinkPairs::from_robot(&robot);
    /// let mut cell = Cell::new(robot, pairs);
    /// let at = |z| Pose::at([0.0, 0.0, z]);
    /// cell.add_obstacle("table", Body::cuboid([1.0, 1.0, 0.1])?, at(-0.1)?)?;
    /// cell.attach("crate", Body::cuboid([0.2, 0.2, 0.2])?, ("fork", at(0.2)?), &[])?;
    /// let lifted = [[0.0], [0.5]];
    /// assert!(!cell.solver().is_free(&lifted)?);
    /// cell.add_obstacle("shelf", Body::cuboid([1.0, 1.0, 0.1])?, at(2.0)?)?;
    /// cell.allow_contact([Item::Attached("crate"), Item::Obstacle("table")])?;
    /// assert!(cell.solver().is_free(&lifted)?);
    /// assert!(!cell.solver().is_free(&[[0.0], [1.6]])?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn allow_contact(&mut self, pair: [Item<'_>; 2]) -> Result<(), RobotError> {
        self.forget_ball_model_of(pair);
        match self.checked_links_of(pair)? {
            Some([a, b]) if a != b => {
                if self.pairs.is_checked(a, b) {
                    let reason = SkipReason::Disabled("contact allowed".to_owned());
                    self.pairs.skip(a, b, reason);
                }
            }
            _ => {
                let bodies = self.bodies_of_pair(pair)?;
                self.allowed.0.extend(bodies);
            }
        }
        Ok(())
    }

    /// Checks a pair again that was allowed to touch. A pair of links that was unchecked for another reason, for
    /// example because they are adjacent, is also checked from then on.
    ///
    /// # Errors
    /// The same as [`Cell::allow_contact`].
    pub fn forbid_contact(&mut self, pair: [Item<'_>; 2]) -> Result<(), RobotError> {
        self.forget_ball_model_of(pair);
        let bodies = self.bodies_of_pair(pair)?;
        match self.checked_links_of(pair)? {
            Some([a, b]) => self.pairs.include(a, b),
            None => self.allowed.0.retain(|allowed| !bodies.contains(allowed)),
        }
        Ok(())
    }

    /// Returns the pairs of items that are allowed to touch, except pairs of two links: those are skipped pairs of
    /// [`Cell::link_pairs`].
    pub fn allowed_contacts(&self) -> Vec<[Item<'_>; 2]> {
        let pairs = self.allowed.0.iter();
        let items = pairs.map(|pair| pair.map(|body| self.item_of_body(body)));
        items.collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// Allows the last attached body to touch the given items.
    pub(super) fn allow_contacts_of_attached(&mut self, body: usize, may_touch: &[Item<'_>]) {
        for &item in may_touch {
            let others = self.bodies_of(item).into_iter();
            let pairs = others.map(|other| ordered_pair([body, other]));
            self.allowed.0.extend(pairs);
        }
    }

    /// Checks that at least one pair of bodies is checked. Otherwise every path would count as free.
    ///
    /// # Errors
    /// [`NothingCompared`], with a summary of the unchecked pairs.
    pub fn check_any_compared(&self) -> Result<(), NothingCompared> {
        match self.compared_pairs(0.0).next() {
            Some(_) => Ok(()),
            None => Err(NothingCompared {
                checked: self.check_summary().to_string(),
            }),
        }
    }

    /// Returns the pairs of bodies that are checked, by their indices in [`Cell::carried_bodies`]. Each pair has the
    /// distance at which it counts as touching, for settings with this margin.
    pub fn compared_pairs(&self, margin: f64) -> impl Iterator<Item = ([usize; 2], f64)> {
        let pairs = (0..self.bodies.len()).flat_map(|a| (0..a).map(move |b| [b, a]));
        let checked_pairs = pairs.filter(|&[a, b]| self.is_compared(a, b));
        checked_pairs.map(move |pair| (pair, self.margin(pair, margin)))
    }

    /// Iterates over the checked pairs of the robot's own parts.
    pub(crate) fn checked_robot_part_pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        let parts = || self.parts[..self.robot_part_count].iter().enumerate();
        parts().flat_map(move |(a, part_a)| {
            let earlier = parts().take(a);
            let checked =
                earlier.filter(move |(_, part_b)| self.is_compared(part_a.owner, part_b.owner));
            checked.map(move |(b, _)| [a, b])
        })
    }

    /// Discards the tables of distances if the pair is of the robot's own bodies, so that they are computed again for
    /// the checked pairs.
    fn forget_ball_model_of(&mut self, pair: [Item<'_>; 2]) {
        if !pair.iter().any(|item| matches!(item, Item::Obstacle(_))) {
            self.ball_model = OnceLock::new();
        }
    }

    /// Returns whether a pair of bodies is allowed to touch. Unchecked pairs of links are not considered.
    #[inline(always)]
    pub(crate) fn is_allowed(&self, pair: [usize; 2]) -> bool {
        self.allowed.contains(pair)
    }

    /// Returns whether a pair of bodies is checked.
    fn is_compared(&self, a: usize, b: usize) -> bool {
        self.are_comparable(a, b) && !self.allowed.contains([a, b])
    }

    /// Returns whether a pair is checked unless it is allowed to touch: two bodies of the robot whose links are
    /// checked, or a moving body and an obstacle.
    fn are_comparable(&self, a: usize, b: usize) -> bool {
        let count = self.robot_body_count();
        match (a < count, b < count) {
            (true, true) => self.is_checked(a, b),
            (true, false) => self.moves(a),
            (false, true) => self.moves(b),
            (false, false) => false,
        }
    }

    /// Returns whether any joint moves a body of the robot.
    pub(super) fn moves(&self, body: usize) -> bool {
        self.kinematics.link_frame_and_pose(self.link_of(body)).0 > 0
    }

    /// Returns whether two bodies of the robot are checked unless they are allowed to touch.
    fn is_checked(&self, a: usize, b: usize) -> bool {
        let [a, b] = [
            &self.robot_body_placements[a],
            &self.robot_body_placements[b],
        ];
        if a.attached_name.is_none() && b.attached_name.is_none() {
            self.pairs.is_checked(a.link, b.link)
        } else {
            !self.robot.are_rigidly_connected(a.link, b.link)
        }
    }

    /// Returns the indices of two links; `None` if one of the items is not a link.
    fn checked_links_of(&self, pair: [Item<'_>; 2]) -> Result<Option<[usize; 2]>, RobotError> {
        let [Item::Link(a), Item::Link(b)] = pair else {
            return Ok(None);
        };
        Ok(Some([
            self.robot.link_number(a)?,
            self.robot.link_number(b)?,
        ]))
    }

    /// Returns the pairs of bodies of two items. The items may be two links whose pair is not checked.
    ///
    /// # Errors
    /// If an item does not exist, or if no pair of their bodies could ever be checked.
    fn bodies_of_pair(&self, pair: [Item<'_>; 2]) -> Result<Vec<[usize; 2]>, RobotError> {
        for item in pair {
            self.check_item(item)?;
        }
        let never_compared = || {
            let [a, b] = pair.map(|item| item.name().to_owned());
            RobotError::NeverCompared { a, b }
        };
        if pair[0] == pair[1] {
            return Err(never_compared());
        }
        let [bodies_a, bodies_b] = pair.map(|item| self.bodies_of(item));
        let pairs_with = |&a: &usize| bodies_b.iter().map(move |&b| ordered_pair([a, b]));
        let all: Vec<[usize; 2]> = bodies_a.iter().flat_map(pairs_with).collect();
        let is_possible = match self.checked_links_of(pair)? {
            Some([a, b]) => !all.is_empty() && !self.robot.are_rigidly_connected(a, b),
            None => all.iter().any(|&[a, b]| self.are_comparable(a, b)),
        };
        if is_possible {
            Ok(all)
        } else {
            Err(never_compared())
        }
    }

    /// Checks that an item exists in the cell.
    pub(super) fn check_item(&self, item: Item<'_>) -> Result<(), RobotError> {
        match item {
            Item::Link(name) => self.robot.link_number(name)?,
            Item::Attached(name) => self.attached_body_index(name)?,
            Item::Obstacle(name) => self.obstacle_index(name)?,
        };
        Ok(())
    }

    /// Returns the indices of the bodies of an item.
    pub(super) fn bodies_of(&self, item: Item<'_>) -> Vec<usize> {
        let all = 0..self.bodies.len();
        all.filter(|&body| self.item_of_body(body) == item)
            .collect()
    }
}

#[cfg(test)]
mod tests;
