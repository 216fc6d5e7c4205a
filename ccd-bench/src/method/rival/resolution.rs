//! Converts a tolerance to a resolution in time.

use super::RivalMotion;
use super::obb_tree::ObbTree;

/// Returns a time in which no point of one body moves by more than the tolerance relative to the other. It is the
/// tolerance over the relative speed of the centers plus the speeds of rotation of both bodies at their farthest
/// points.
///
/// The result is infinite for bodies at rest.
pub(super) fn resolution(courses: &[RivalMotion; 2], trees: &[ObbTree; 2], tolerance: f64) -> f64 {
    let straight = (courses[0].velocity - courses[1].velocity).length();
    let turning =
        |k: usize| courses[k].angular_speed * trees[k].radius_bound_about(courses[k].center);
    tolerance / (straight + turning(0) + turning(1))
}
