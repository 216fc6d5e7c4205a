//! Magnitudes of joint positions, to which their rounding errors are proportional.

use ccd_core::order::greater;

/// Upper bounds of a joint's positions on a path or in a range.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Magnitude {
    /// The largest absolute value of the position.
    pub(crate) position: f64,
    /// The number to which the rounding error of the position is proportional.
    pub(crate) rounding: f64,
}

impl Magnitude {
    /// Returns the componentwise maximum.
    pub(crate) fn or_larger(self, other: Magnitude) -> Self {
        Magnitude {
            position: greater(self.position, other.position),
            rounding: greater(self.rounding, other.rounding),
        }
    }
}
