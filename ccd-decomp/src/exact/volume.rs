//! Signed volumes with a bound on rounding.

use crate::tolerance::volume_rounding_bound;
use ccd_core::glam::DVec3;

/// A sum of signed volumes of tetrahedra, with a bound of its rounding error.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SignedVolume {
    sum: f64,
    /// The sum of the exact rounding errors of all additions, which corrects `sum`.
    addition_error_sum: f64,
    term_bound_sum: f64,
    term_count: f64,
}

impl SignedVolume {
    /// Sums six times the signed volumes of the tetrahedra that the triangles of a surface span with a point `near` the
    /// surface.
    pub(crate) fn from_triangles(triangles: impl Iterator<Item = [DVec3; 3]>, near: DVec3) -> Self {
        let mut volume = SignedVolume::default();
        triangles.for_each(|triangle| volume.add(triangle, near));
        volume
    }

    /// Adds six times the signed volume of the tetrahedron that a triangle spans with the point `near`.
    fn add(&mut self, [p, q, r]: [DVec3; 3], near: DVec3) {
        let (arm, sides) = (p - near, [q - p, r - p]);
        let term = arm.dot(sides[0].cross(sides[1]));
        let sum = self.sum + term;
        // The exact rounding error of the addition (Knuth's two-sum).
        let added = sum - self.sum;
        self.addition_error_sum += (self.sum - (sum - added)) + (term - added);
        self.sum = sum;
        self.term_bound_sum += arm.length() * sides[0].length() * sides[1].length();
        self.term_count += 1.0;
    }

    /// Returns whether the exact sum is positive; `None` if [rounding](volume_rounding_bound) leaves its sign open.
    pub(crate) fn is_positive(&self) -> Option<bool> {
        let sum = self.sum + self.addition_error_sum;
        let rounding = volume_rounding_bound(self.term_bound_sum, self.term_count);
        // Written so that NaN has no sign.
        (sum.abs() > rounding).then_some(sum > 0.0)
    }
}

#[cfg(test)]
mod tests;
