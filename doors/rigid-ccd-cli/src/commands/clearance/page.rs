//! Adds the report of `ccd clearance` to the page that shows the mechanism.

use super::report::Report;
use ccd_core::order::greater;
use ccd_view::{Animation, FailingRange};
use rigid_ccd::answer::ClearanceVerdict;

/// Adds the report to the animation of its path: as text, and in the plot of the distance.
pub(super) fn show_report(report: &Report<'_>, view: &mut Animation) {
    view.verdict = report.to_string();
    let Some(gap) = &mut view.gap else {
        return;
    };
    // Both bodies of a pair may deviate by the pose error.
    let distance_error_mm = 1e3 * 2.0 * report.pose_error;
    for [_, bound] in &mut gap.proven {
        *bound = greater(*bound - distance_error_mm, 0.0);
    }
    for point in &mut gap.points {
        point.lower = greater(point.lower - distance_error_mm, 0.0);
        point.upper += distance_error_mm;
    }
    gap.required = report.required.map(|length| 1e3 * length);
    let time_on_page = |time: f64| report.path.table_time_rounded_down(time) - view.start;
    let failing_ranges = report.ranges.iter();
    let failing_ranges = failing_ranges.filter(|range| range.verdict != ClearanceVerdict::Kept);
    gap.failing_ranges = failing_ranges
        .map(|range| FailingRange {
            from: time_on_page(range.from.time()),
            to: time_on_page(range.to.time()),
            is_violated: range.verdict == ClearanceVerdict::Violated,
        })
        .collect();
}
