//! Compares the sizes of bodies, to detect different units of length.

use crate::console::print_error;
use ccd_core::Body;
use rigid_ccd::Remark;
use rigid_ccd::text::RoundedToFourDigits;

/// The ratio of sizes above which the command warns; millimetres and metres differ by 1000.
const MAX_USUAL_SIZE_RATIO: f64 = 100.0;

/// Returns the side lengths of a body's axis-aligned bounding box as text.
pub(crate) fn sides_text(body: &Body) -> String {
    let [x, y, z] = Remark::sides(body).map(RoundedToFourDigits);
    format!("{x} × {y} × {z}")
}

/// Warns if two bodies may have different units of length.
pub(crate) fn warn_of_different_units(a: &Body, b: &Body) {
    let [size_a, size_b] = [a, b].map(Remark::body_size);
    let (large, small, ratio) = if size_a > size_b {
        ("--a", "--b", size_a / size_b)
    } else {
        ("--b", "--a", size_b / size_a)
    };
    if ratio > MAX_USUAL_SIZE_RATIO && ratio.is_finite() {
        print_error(&format!(
            "{large} is {} times as large as {small} ({} and {}): check that both use the same unit of length",
            RoundedToFourDigits(ratio),
            sides_text(a),
            sides_text(b)
        ));
    }
}
