//! How large the positions of a joint are, to which their rounding is proportional.

use ccd_core::order::greater;

/// The sizes of a joint's positions on a path, or in a range.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Magnitude {
    /// The largest absolute value of the position.
    pub(crate) position: f64,
    /// The magnitude to which the rounding error of the position is proportional.
    pub(crate) rounding: f64,
}

impl Magnitude {
    /// Returns the larger of both values each.
    pub(crate) fn or_larger(self, other: Magnitude) -> Self {
        Magnitude {
            position: greater(self.position, other.position),
            rounding: greater(self.rounding, other.rounding),
        }
    }
}
