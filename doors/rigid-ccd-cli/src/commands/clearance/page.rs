//! What the page of `ccd clearance` shows beside the mechanism.

use super::report::Report;
use ccd_core::order::greater;
use ccd_view::{Animation, UnkeptRange};
use rigid_ccd::answer::ClearanceVerdict;

/// Adds the report to the animation of its path: in words, and in the plot of the distance.
pub(super) fn show_report(report: &Report<'_>, view: &mut Animation) {
    view.verdict = report.to_string();
    let Some(gap) = &mut view.gap else {
        return;
    };
    // Both bodies of a pair may be off.
    let error = 1e3 * 2.0 * report.pose_error;
    for [_, bound] in &mut gap.proven {
        *bound = greater(*bound - error, 0.0);
    }
    for point in &mut gap.points {
        point.lower = greater(point.lower - error, 0.0);
        point.upper += error;
    }
    gap.required = report.required.map(|length| 1e3 * length);
    let seconds = |time: f64| report.path.table_time_rounded_down(time) - view.start;
    let unkept = report.ranges.iter();
    let unkept = unkept.filter(|range| range.verdict != ClearanceVerdict::Kept);
    gap.unkept = unkept
        .map(|range| UnkeptRange {
            from: seconds(range.from.time()),
            to: seconds(range.to.time()),
            is_violated: range.verdict == ClearanceVerdict::Violated,
        })
        .collect();
}
