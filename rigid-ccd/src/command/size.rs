//! Compares the sizes of bodies, to detect different units of length.

use super::print_error;
use crate::remark::{point_box_corners, sides};
use crate::text::Number;
use ccd_core::Body;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::fmt;

/// The side lengths of a body's axis-aligned bounding box, in the body's unit of length.
#[derive(Clone, Copy, Debug)]
pub struct Size(DVec3);

/// The ratio of sizes above which the command warns; millimetres and metres differ by 1000.
const MAX_USUAL_SIZE_RATIO: f64 = 100.0;

impl Size {
    /// Returns the side lengths of a body's bounding box.
    pub fn of(body: &Body) -> Self {
        Size(sides(point_box_corners(body)))
    }

    fn largest_side(self) -> f64 {
        self.0.to_array().into_iter().fold(0.0, greater)
    }

    /// Warns if two bodies may have different units of length.
    pub fn warn_of_different_units(a: Size, b: Size) {
        let (of_a, of_b) = (a.largest_side(), b.largest_side());
        let (large, small, ratio) = if of_a > of_b {
            ("--a", "--b", of_a / of_b)
        } else {
            ("--b", "--a", of_b / of_a)
        };
        if ratio > MAX_USUAL_SIZE_RATIO && ratio.is_finite() {
            print_error(&format!(
                "{large} is {} times as large as {small} ({a} and {b}): check that both use the same unit of length",
                RoundedToFourDigits(ratio)
            ));
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(RoundedToFourDigits);
        write!(f, "{x} × {y} × {z}")
    }
}

/// Displays a number rounded to four digits.
struct RoundedToFourDigits(f64);

impl fmt::Display for RoundedToFourDigits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded: f64 = format!("{:.3e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{}", Number(rounded))
    }
}
