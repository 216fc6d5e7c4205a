//! The common normals of two surfaces: the directions along which they are apart at two of their points.

use crate::math::vector::{across, length, unit};
use crate::rounding::LEAST_SHARE;
use glam::DVec3;

/// The common normals of surfaces A and B at a point of each: the unit vectors `n` from A to B in the normal cone of A,
/// with `−n` in that of B `[ROCKAFELLAR70]`. Along them neither surface comes nearer around the two points.
/// Each surface is given by its offsets: vectors from its point to the corners of the faces around that point. `n` is a
/// common normal if no offset of A rises along it, and none of B falls, by more than a slack.
#[derive(Debug, Default)]
pub(crate) struct CommonNormals {
    /// The offsets of A reversed, and those of B: none of them falls along a common normal.
    ways: Vec<DVec3>,
    /// The height by which an offset may fall.
    slack: f64,
}

impl CommonNormals {
    /// Removes all offsets, and sets the slack.
    pub(crate) fn begin(&mut self, slack: f64) {
        self.ways.clear();
        self.ways.shrink_to(MOST_KEPT);
        self.slack = slack;
    }

    /// Adds an offset of A.
    pub(crate) fn add_a(&mut self, way: DVec3) {
        self.ways.push(-way);
    }

    /// Adds an offset of B.
    pub(crate) fn add_b(&mut self, way: DVec3) {
        self.ways.push(way);
    }

    /// Sorts the offsets after the last one was added. The longest ones are the most exact, and come first.
    pub(crate) fn sort(&mut self) {
        let length = |way: &DVec3| way.length_squared();
        self.ways
            .sort_unstable_by(|one, other| length(other).total_cmp(&length(one)));
    }

    /// Returns the common normal that is nearest to a direction, or one near it if there are several; `None` if there
    /// is no common normal.
    pub(crate) fn near(&self, towards: DVec3) -> Option<DVec3> {
        let [x, y, z] = DVec3::AXES;
        // If there is only one common normal, one of these axes is less than 55 degrees from it.
        let axes = [x, y, z, -x, -y, -z];
        let nearer = |one: DVec3, other: DVec3| {
            if other.dot(towards) > one.dot(towards) {
                other
            } else {
                one
            }
        };
        let others = || {
            axes.into_iter()
                .filter_map(|axis| self.nearest(axis))
                .reduce(nearer)
        };
        self.nearest(towards).or_else(others)
    }

    /// Like [`CommonNormals::near`], if the vector between the two points is along the normal, up to the slack.
    pub(crate) fn along(&self, towards: DVec3, between: DVec3) -> Option<DVec3> {
        let n = self.near(towards)?;
        let ahead = n.dot(between);
        let aside = length(between - n * ahead);
        // Written so that NaN is not along the normal.
        (ahead >= -self.slack && aside <= self.slack).then_some(n)
    }

    /// Returns the unit vector along the projection of a direction on the cone. The offsets that fall along the vector
    /// are made level one by one, as in linear programs of few unknowns `[SEIDEL91]`. Returns `None` if the direction
    /// is not distinctly less than a right angle from the cone.
    fn nearest(&self, towards: DVec3) -> Option<DVec3> {
        let towards = unit(towards)?;
        let mut best = towards;
        for (k, way) in self.ways.iter().copied().enumerate() {
            if self.falls(best, way) {
                best = self.nearest_across(towards, way, k)?;
            }
        }
        Some(best)
    }

    /// Like [`CommonNormals::nearest`], perpendicular to an offset, and for the first `count` of the other ones only.
    fn nearest_across(&self, towards: DVec3, level: DVec3, count: usize) -> Option<DVec3> {
        let level = unit(level)?;
        let mut best = distinct(towards - level * level.dot(towards))?;
        let before = || self.ways.iter().copied().take(count);
        for (k, way) in before().enumerate() {
            if self.falls(best, way) {
                let line = unit(across(level, way))?;
                best = distinct(line * line.dot(towards))?;
                if before().take(k).any(|way| self.falls(best, way)) {
                    return None;
                }
            }
        }
        Some(best)
    }

    fn falls(&self, n: DVec3, way: DVec3) -> bool {
        // Written so that NaN counts as a fall.
        !(n.dot(way) >= -self.slack)
    }
}

/// The most offsets for which the memory is kept.
const MOST_KEPT: usize = 1 << 20;

/// Returns the unit vector along a part of a unit vector, if that part is more than rounding.
fn distinct(part: DVec3) -> Option<DVec3> {
    (length(part) > LEAST_SHARE).then(|| unit(part))?
}

#[cfg(test)]
mod tests;
