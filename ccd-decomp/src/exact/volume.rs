//! The sign of a volume, where rounding cannot have made it.

use crate::tolerance::volume_rounding;
use ccd_core::glam::DVec3;

/// A sum of signed volumes, and of their sizes, which bounds its rounding.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SignedVolume {
    sum: f64,
    /// What rounding took from the sum.
    lost: f64,
    size: f64,
    terms: f64,
}

impl SignedVolume {
    pub(crate) fn add(&mut self, [p, q, r]: [DVec3; 3], near: DVec3) {
        let (arm, sides) = (p - near, [q - p, r - p]);
        let term = arm.dot(sides[0].cross(sides[1]));
        let sum = self.sum + term;
        // Exactly what the sum was rounded by (Knuth's two-sum).
        let added = sum - self.sum;
        self.lost += (self.sum - (sum - added)) + (term - added);
        self.sum = sum;
        self.size += arm.length() * sides[0].length() * sides[1].length();
        self.terms += 1.0;
    }

    /// None when [rounding](volume_rounding) could have made the sign.
    pub(crate) fn is_positive(&self) -> Option<bool> {
        let sum = self.sum + self.lost;
        let rounding = volume_rounding(self.size, self.terms);
        // Written so that NaN tells nothing.
        (sum.abs() > rounding).then_some(sum > 0.0)
    }
}

#[cfg(test)]
mod tests;
