//! Distance tests of two parts at the midpoint of an interval, which may prove something about the whole interval.

use super::part_pairs::PartPair;
use super::placement::Placement;
use crate::cell::Cell;
use crate::cell::part::HullPart;
use crate::tuning::{MIN_BOX_TEST_DISPLACEMENT, MIN_SQUARED_OFFSET};
use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;

/// The distances with which the distance of a pair at the midpoint of an interval is compared.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Thresholds {
    /// The pair is free if it stays farther apart than this over the whole interval.
    pub(crate) free_distance_threshold: f64,
    /// The pair is near if its distance at the midpoint is at most this.
    pub(crate) near_distance: f64,
}

/// What a distance test proves about a pair.
pub(crate) enum DistanceVerdict {
    /// The pair stays farther apart than the threshold over the whole interval.
    Free,
    /// The hulls are near at the midpoint.
    Near,
    /// Neither is proven. Holds an upper bound of the distance at the midpoint.
    Undecided(f64),
}

/// Measures a pair as accurately as the thresholds require. If `skips_far` is set, a pair with a large displacement is
/// not measured if its bounding boxes are farther apart than `near_distance`.
#[inline(always)]
pub(crate) fn measure(
    cell: &Cell,
    placement: &Placement,
    pair: &mut PartPair,
    thresholds: Thresholds,
    skips_far: bool,
) -> DistanceVerdict {
    let parts = cell.parts();
    let (a, b) = (&parts[pair.a as usize], &parts[pair.b as usize]);
    let frames = [a, b].map(|part| placement.frames[part.frame]);
    let displacement = pair.displacement(placement);
    let rounding = 2.0 * placement.rounding;
    let centers = [
        frames[0].transform_point(a.center),
        frames[1].transform_point(b.center),
    ];
    let gap = volume_gap_at_centers([a, b], &frames[0], centers);
    let required = displacement + thresholds.free_distance_threshold + rounding;
    if gap > required {
        return DistanceVerdict::Free;
    }
    if skips_far && displacement > MIN_BOX_TEST_DISPLACEMENT && gap > thresholds.near_distance {
        pair.distance_to_proof_ratio = 1.0;
        return DistanceVerdict::Undecided(f64::INFINITY);
    }
    let radii = a.radius + b.radius;
    let until = TerminationBounds {
        sufficient_lower_bound: required + radii,
        sufficient_upper_bound: thresholds.near_distance - rounding + radii,
    };
    let bounds = match &b.plane {
        Some(plane) => plane.distance_bounds(a, &frames[0]),
        None => bound_distance(
            #[inline(always)]
            |direction: DVec3| minkowski_support_vertex([a, b], &frames, direction),
            if pair.axis != DVec3::ZERO {
                pair.axis
            } else {
                initial_direction(b, centers)
            },
            #[inline(always)]
            |bounds| until.are_met_by(bounds),
        ),
    };
    if bounds.lower > until.sufficient_lower_bound {
        return DistanceVerdict::Free;
    }
    pair.axis = bounds.axis;
    pair.distance_to_proof_ratio = (bounds.lower - radii) / required;
    // The shapes may be farther apart than the bodies that enclose them.
    let upper = bounds.upper - radii + rounding + a.excess_over_shape + b.excess_over_shape;
    if bounds.upper <= until.sufficient_upper_bound {
        DistanceVerdict::Near
    } else {
        DistanceVerdict::Undecided(upper)
    }
}

/// Returns a lower bound of the distance of a pair at the midpoint, from bounding volumes.
pub(crate) fn bounding_volume_gap(cell: &Cell, placement: &Placement, pair: &PartPair) -> f64 {
    let parts = [pair.a, pair.b].map(|part| &cell.parts()[part as usize]);
    let centers = parts.map(|part| placement.frames[part.frame].transform_point(part.center));
    volume_gap_at_centers(parts, &placement.frames[parts[0].frame], centers)
}

/// Returns a lower bound of the distance from bounding volumes: from boxes if the second part is static, from the
/// first part's box if the second part is a plane, and from balls if both move.
#[inline(always)]
fn volume_gap_at_centers([a, b]: [&HullPart; 2], frame_a: &Frame, centers: [DVec3; 2]) -> f64 {
    if let Some(plane) = &b.plane {
        return plane.height_of(a, frame_a, centers[0]);
    }
    let offset = centers[1] - centers[0];
    if b.frame == 0 {
        let extents = a.box_half_extents(frame_a) + b.half_extents;
        (offset.abs() - extents).max_element()
    } else {
        offset.length() - a.ball_radius - b.ball_radius
    }
}

/// Returns the initial direction of a distance query: to the nearest point of the second part's box if that part is
/// static, otherwise between the centers.
#[inline(always)]
pub(crate) fn initial_direction(b: &HullPart, [center_a, center_b]: [DVec3; 2]) -> DVec3 {
    if b.frame == 0 {
        let nearest = center_a.clamp(center_b - b.half_extents, center_b + b.half_extents);
        let axis = nearest - center_a;
        if axis.length_squared() > MIN_SQUARED_OFFSET {
            return axis;
        }
    }
    center_b - center_a
}

/// Returns the vertex of the Minkowski difference `b - a` that is lowest along a direction.
#[inline(always)]
pub(crate) fn minkowski_support_vertex(
    [a, b]: [&HullPart; 2],
    frames: &[Frame; 2],
    direction: DVec3,
) -> Vertex {
    let in_a = frames[0].inverse_transform_vector(direction);
    let in_b = -frames[1].inverse_transform_vector(direction);
    let (index_a, corner_a) = a.extremal_corner(in_a);
    let (index_b, corner_b) = b.extremal_corner(in_b);
    let (point_a, point_b) = (
        frames[0].transform_point(corner_a),
        frames[1].transform_point(corner_b),
    );
    Vertex {
        point: point_b - point_a,
        a: index_a,
        b: index_b,
    }
}
