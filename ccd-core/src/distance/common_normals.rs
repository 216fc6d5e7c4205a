//! Finds a common normal of two surfaces at a pair of nearest points.

use crate::math::vector::{length, unit, vector_perpendicular_to_both};
use crate::rounding::LEAST_PERPENDICULAR_LENGTH;
use glam::DVec3;

/// The common normals of two surfaces A and B at a pair of points, one on each surface. They are the unit vectors `n`
/// from A to B in the normal cone of A, with `−n` in that of B `[ROCKAFELLAR70]`. Along them neither surface comes
/// nearer around the two points. Each surface is given by its offsets: vectors from its point to the corners of the
/// faces around that point. `n` is a common normal if no offset of A rises along it, and none of B falls, by more than
/// a slack.
#[derive(Debug, Default)]
pub(crate) struct CommonNormals {
    /// The offsets of B, and the negated offsets of A. Along a common normal none of them falls by more than `slack`.
    constraint_vectors: Vec<DVec3>,
    /// How far an offset may fall along a direction that still counts as a common normal, as a length.
    slack: f64,
}

impl CommonNormals {
    /// Removes all offsets, and sets the slack.
    pub(crate) fn reset(&mut self, slack: f64) {
        self.constraint_vectors.clear();
        self.constraint_vectors.shrink_to(MAX_RETAINED_CAPACITY);
        self.slack = slack;
    }

    /// Adds a vector from A's point to a point of A's surface around it.
    pub(crate) fn add_constraint_of_a(&mut self, offset: DVec3) {
        self.constraint_vectors.push(-offset);
    }

    /// Adds a constraint: the vector from B's point to another point of B's surface.
    pub(crate) fn add_constraint_of_b(&mut self, offset: DVec3) {
        self.constraint_vectors.push(offset);
    }

    /// Sorts the offsets, the longest first. It is to be called after the last offset is added. The longest ones are
    /// the most exact.
    pub(crate) fn sort_constraints(&mut self) {
        let length = |offset: &DVec3| offset.length_squared();
        self.constraint_vectors
            .sort_unstable_by(|one, other| length(other).total_cmp(&length(one)));
    }

    /// Returns the common normal that is nearest to a direction, or one close to the nearest; `None` if there is no
    /// common normal.
    pub(crate) fn nearest_normal(&self, towards: DVec3) -> Option<DVec3> {
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
                .filter_map(|axis| self.project_onto_cone(axis))
                .reduce(nearer)
        };
        self.project_onto_cone(towards).or_else(others)
    }

    /// Like [`CommonNormals::nearest_normal`], but returns `None` unless the vector `between` the two points is along
    /// the normal, up to the slack.
    pub(crate) fn nearest_normal_parallel_to(
        &self,
        towards: DVec3,
        between: DVec3,
    ) -> Option<DVec3> {
        let n = self.nearest_normal(towards)?;
        let ahead = n.dot(between);
        let aside = length(between - n * ahead);
        // Written so that NaN is not along the normal.
        (ahead >= -self.slack && aside <= self.slack).then_some(n)
    }

    /// Projects a direction onto the cone of common normals, and returns the unit vector along the projection. The
    /// offsets that fall along the vector are made level one by one, as in linear programs of few unknowns
    /// `[SEIDEL91]`. Returns `None` if the direction is not distinctly less than a right angle from the cone.
    fn project_onto_cone(&self, towards: DVec3) -> Option<DVec3> {
        let towards = unit(towards)?;
        let mut best = towards;
        for (k, offset) in self.constraint_vectors.iter().copied().enumerate() {
            if self.is_constraint_violated(best, offset) {
                best = self.project_onto_cone_in_plane(towards, offset, k)?;
            }
        }
        Some(best)
    }

    /// Like [`CommonNormals::project_onto_cone`], for the first `count` offsets only; the result is perpendicular to
    /// `level`.
    fn project_onto_cone_in_plane(
        &self,
        towards: DVec3,
        level: DVec3,
        count: usize,
    ) -> Option<DVec3> {
        let level = unit(level)?;
        let mut best = unit_if_not_negligible(towards - level * level.dot(towards))?;
        let before = || self.constraint_vectors.iter().copied().take(count);
        for (k, offset) in before().enumerate() {
            if self.is_constraint_violated(best, offset) {
                let line = unit(vector_perpendicular_to_both(level, offset))?;
                best = unit_if_not_negligible(line * line.dot(towards))?;
                if before()
                    .take(k)
                    .any(|offset| self.is_constraint_violated(best, offset))
                {
                    return None;
                }
            }
        }
        Some(best)
    }

    fn is_constraint_violated(&self, n: DVec3, offset: DVec3) -> bool {
        // Written so that NaN counts as a violation.
        !(n.dot(offset) >= -self.slack)
    }
}

/// The largest number of offsets for which memory is kept between uses.
const MAX_RETAINED_CAPACITY: usize = 1 << 20;

/// Returns the unit vector along a component of a unit vector; `None` if the component is so short that it may be mere
/// rounding.
fn unit_if_not_negligible(part: DVec3) -> Option<DVec3> {
    (length(part) > LEAST_PERPENDICULAR_LENGTH).then(|| unit(part))?
}

#[cfg(test)]
mod tests;
