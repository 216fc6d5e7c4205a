//! Proves that some pair is nearer than its margin everywhere in an interval.
//!
//! The proof: at the midpoint, the distance of both bodies is less than the margin minus their displacement.

use super::Goal;
use super::measure::{initial_direction, minkowski_support_vertex};
use super::part_pairs::PartPair;
use super::placement::Placement;
use super::search::PathSearch;
use crate::cell::Cell;
use crate::path::interval::PathInterval;
use ccd_core::fan_triangles;
use ccd_core::order::{greater, lesser};
use ccd_distance_gjk::{TerminationBounds, bound_distance};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Error, Settings};

impl PathSearch<'_> {
    /// Returns whether some pair is proven to be nearer than its margin everywhere in an interval. This margin does not
    /// include `PartPairs::margin_increase`. The proof holds even if the true distance is larger than the computed
    /// distance by up to this increase.
    pub(super) fn is_margin_violated(&mut self, interval: &PathInterval) -> Result<bool, Error> {
        let parts = self.cell.parts();
        self.goal = Goal::AnyContact;
        self.stop_condition.begin_search(interval);
        self.placement.place(self.cell, &self.path, interval);
        self.candidates.clear();
        self.append_candidates();
        let mut pairs = std::mem::take(&mut self.candidates);
        pairs.sort_unstable_by_key(|pair| pair.body_indices(parts));
        let of_bodies =
            pairs.chunk_by(|one, other| one.body_indices(parts) == other.body_indices(parts));
        let mut is_violated = Ok(false);
        for near in of_bodies {
            is_violated = self.are_bodies_nearer(near);
            if !matches!(is_violated, Ok(false)) {
                break;
            }
        }
        self.candidates = pairs;
        is_violated
    }

    /// Returns whether two bodies are proven to be nearer than their margin everywhere in the interval. `near` contains
    /// their candidate pairs. Other pairs of their parts are not near each other.
    fn are_bodies_nearer(&mut self, near: &[PartPair]) -> Result<bool, Error> {
        let pair = &near[0];
        let displacements = near.iter().map(|pair| pair.displacement(&self.placement));
        let displacement = displacements.fold(0.0, greater);
        // Subtracts the increase twice, because the margin already includes it once.
        let distance = pair.margin
            - 2.0 * self.pairs.margin_increase()
            - displacement
            - 4.0 * self.placement.rounding;
        if pair.is_convex(self.cell.parts()) {
            let (cell, placement) = (self.cell, &self.placement);
            return Ok(are_convex_parts_nearer(cell, placement, pair, distance));
        }
        // Written so that NaN proves nothing.
        if !(distance > 0.0) {
            return Ok(false);
        }
        let [a, b] = pair.body_indices(self.cell.parts());
        let a = self.placement.body(self.cell, a)?;
        let b = self.placement.body(self.cell, b)?;
        self.solver.set_settings(Settings {
            budget: self.stop_condition.budget_of_query(),
            deadline: self.stop_condition.remaining(),
            ..self.settings.clone()
        });
        let answer = self.solver.distance(a, b)?;
        self.stop_condition
            .add_work(1 + answer.stats.budgeted_work());
        Ok(answer.outcome.upper() < distance)
    }
}

/// Returns whether two convex parts are nearer than a distance at the midpoint. A negative distance requires that they
/// overlap by this depth in every direction.
pub(crate) fn are_convex_parts_nearer(
    cell: &Cell,
    placement: &Placement,
    pair: &PartPair,
    distance: f64,
) -> bool {
    let parts = [pair.a, pair.b].map(|part| &cell.parts()[part as usize]);
    let frames = parts.map(|part| placement.frames[part.frame]);
    let [a, b] = parts;
    // The distance of the hulls' corner points that corresponds to this distance of the shapes.
    let distance = distance + a.radius + b.radius - a.excess_over_shape - b.excess_over_shape;
    let centers = [
        frames[0].transform_point(a.center),
        frames[1].transform_point(b.center),
    ];
    if let Some(plane) = &b.plane {
        return plane.lowest_corner_height(a, &frames[0]) < distance;
    }
    let axis = initial_direction(b, centers);
    let vertex = |direction: DVec3| minkowski_support_vertex(parts, &frames, direction);
    if distance > 0.0 {
        let until = TerminationBounds {
            sufficient_lower_bound: distance,
            sufficient_upper_bound: 0.5 * distance,
        };
        bound_distance(vertex, axis, |bounds| until.are_met_by(bounds)).upper < distance
    } else {
        contains_ball(|direction| vertex(direction).point, -distance)
    }
}

/// The largest number of points of the growing hull.
const MAX_HULL_POINTS: usize = 40;

/// Returns whether a convex set certainly contains a ball about the origin. `support` returns the point of the set
/// that is lowest along a direction.
///
/// Grows the hull of some points of the set. Each step adds the farthest point beyond the facet nearest to the origin,
/// until that facet is outside the ball, or no point of the set is beyond it.
fn contains_ball(support: impl Fn(DVec3) -> DVec3, radius: f64) -> bool {
    let mut points = Vec::new();
    for direction in first_directions() {
        let point = support(direction);
        // Written so that NaN proves nothing.
        if !(-point.dot(direction) > radius) {
            return false;
        }
        points.push(point);
    }
    while points.len() <= MAX_HULL_POINTS {
        let Some((normal, height)) = facet_nearest_origin(&points) else {
            return false;
        };
        if height > radius {
            return true;
        }
        let beyond = support(-normal);
        if points.contains(&beyond) || !(beyond.dot(normal) > height) {
            return false;
        }
        points.push(beyond);
    }
    false
}

/// Returns unit vectors to the faces and to the corners of a cube. The support points of a set with a volume along
/// these directions are almost never all in one plane.
fn first_directions() -> impl Iterator<Item = DVec3> {
    let signs = || [-1.0, 0.0, 1.0];
    let all = signs().into_iter().flat_map(move |x| {
        signs()
            .into_iter()
            .flat_map(move |y| signs().map(|z| DVec3::new(x, y, z)))
    });
    let is_face_or_corner = |v: &DVec3| [1.0, 3.0].contains(&v.length_squared());
    all.filter(is_face_or_corner).map(DVec3::normalize)
}

/// Returns the facet of the points' hull that is nearest to the origin, or farthest on the wrong side: its outer unit
/// normal, and a lower bound of its height above the origin. `None` if the points have no volume.
fn facet_nearest_origin(points: &[DVec3]) -> Option<(DVec3, f64)> {
    let hull = ccd_decomp::convex_hull(points).ok()?;
    if hull.facets.iter().count() < 4 {
        return None;
    }
    let lengths = hull.points.iter().map(|point| point.length());
    let size = lengths.fold(0.0, greater);
    let mut lowest = (DVec3::ZERO, f64::INFINITY);
    for facet in hull.facets.iter() {
        let at = |corner: u32| hull.points[corner as usize];
        let triangles = fan_triangles(facet).map(|corners| corners.map(at));
        let normal: DVec3 = triangles.map(|[p, q, r]| (q - p).cross(r - p)).sum();
        let heights = facet.iter().map(|&corner| normal.dot(at(corner)));
        let height = heights.fold(f64::INFINITY, lesser);
        // A normal and a height are products of two and of three lengths; each triangle adds fewer than 128 rounding
        // errors.
        let rounding = 128.0 * f64::EPSILON * facet.len() as f64 * size.powi(3);
        let length = normal.length();
        let height = (height - rounding) / length;
        if !height.is_finite() {
            return None;
        }
        if height < lowest.1 {
            lowest = (normal / length, height);
        }
    }
    Some(lowest)
}

#[cfg(test)]
mod tests;
