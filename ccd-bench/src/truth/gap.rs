//! Bounds the distance of two surfaces at one time.

use super::DistanceBounds;
use super::rounding::FORTY_ROUNDINGS_ERROR;
use super::search::{OpenedPair, Search};
use super::snapshot::{LinearizedMotions, TimeSpan};
use super::surface::{Node, Triangle};
use super::triangle::{gap_along, nearest_or_common_points, separating_axis_candidates};
use ccd_core::order::{greater, lesser};

/// Returns bounds on the least distance between the surfaces at a time. The nearer part comes first, and parts farther
/// than the nearest points known are left out.
pub(super) fn distance_bounds(mut search: Search<'_>, time: f64) -> DistanceBounds {
    let mut bracket = DistanceBounds {
        distance_lower_bound: f64::INFINITY,
        upper_distance: f64::INFINITY,
    };
    let Some(roots) = search.root_pair() else {
        return bracket;
    };
    let snapshot = search.linearize_motions(TimeSpan::span_of_instant(time));
    let mut stack = vec![(f64::NEG_INFINITY, roots)];
    while let Some((bound, pair)) = stack.pop() {
        if bound >= bracket.upper_distance {
            continue;
        }
        if search.remaining_budget == 0 {
            // The remaining pairs may be nearer.
            return DistanceBounds {
                distance_lower_bound: 0.0,
                ..bracket
            };
        }
        search.remaining_budget -= 1;
        match search.expand_larger_node(pair) {
            OpenedPair::Children(_, pairs) => {
                let bound = |[a, b]: [&Node; 2]| snapshot.box_distance_lower_bound(a, b);
                let mut parts = pairs.map(|part| (bound(search.node_pair(part)), part));
                // The last one is examined first.
                if parts[0].0 < parts[1].0 {
                    parts.swap(0, 1);
                }
                stack.extend(parts);
            }
            OpenedPair::Triangles(triangles) => {
                let found = triangle_distance_bounds(&snapshot, triangles);
                bracket.distance_lower_bound = lesser(
                    bracket.distance_lower_bound,
                    greater(found.distance_lower_bound, bound),
                );
                bracket.upper_distance = lesser(bracket.upper_distance, found.upper_distance);
            }
        }
    }
    // Every pair that was left out is at least `upper` apart.
    bracket.distance_lower_bound = greater(
        0.0,
        lesser(bracket.distance_lower_bound, bracket.upper_distance),
    );
    bracket
}

/// Returns bounds on the distance of two triangles: any two points bound it from above, and the gap along any direction
/// from below.
fn triangle_distance_bounds(
    snapshot: &LinearizedMotions,
    [a, b]: [&Triangle; 2],
) -> DistanceBounds {
    let placed = snapshot.triangle_of_a_at_middle(a);
    let (p, q) = nearest_or_common_points(&placed, b);
    let directions = separating_axis_candidates(&placed, b).chain([(p - q).normalize()]);
    let gaps = directions
        .filter(|n| n.is_finite())
        .map(|n| gap_along(n, &placed, b));
    DistanceBounds {
        distance_lower_bound: gaps.fold(0.0, greater) * (1.0 - FORTY_ROUNDINGS_ERROR)
            - snapshot.gap_error_bound,
        upper_distance: (p - q).length() + snapshot.gap_error_bound,
    }
}
