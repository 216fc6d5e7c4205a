//! Ellipsoids, enclosed in convex polytopes.

use crate::hull::hull;
use crate::tolerance::ELLIPSOID_ENLARGEMENT;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::{Body, Facet, FacetOrigin, Hull, InputError, Polytope, check};
use std::f64::consts::TAU;

/// The number of corners of the polytope.
const CORNER_COUNT: usize = 2048;

/// The half axes that are allowed. Determinants of their squares neither underflow nor overflow.
const HALF_AXES: std::ops::RangeInclusive<f64> = 1e-20..=1e11;

/// Creates an ellipsoid about the origin with half axes along x, y and z. The body is a polytope about it, or a ball if all are
/// equal.
///
/// # Guarantee
/// The polytope contains the ellipsoid. None of its points is farther from the ellipsoid than the body's
/// [excess](Body::excess), at most 1/400 of the longest half axis: contacts may be early by that distance, and are never late.
///
/// # Errors
/// [`InputError::OutOfRange`] for a half axis that is not from 1e-20 to 1e11.
///
/// ```
/// let egg = ccd_decomp::ellipsoid([0.02, 0.02, 0.03])?;
/// assert!(egg.excess() < 0.03 / 400.0);
/// assert!(egg.bounding_radius() >= 0.03 && egg.bounding_radius() < 0.0301);
/// # Ok::<(), ccd_core::InputError>(())
/// ```
pub fn ellipsoid(half_axes: [f64; 3]) -> Result<Body, InputError> {
    for value in half_axes {
        let is_allowed = HALF_AXES.contains(&value);
        check("half axis", value, is_allowed, "from 1e-20 to 1e11")?;
    }
    let half_axes = DVec3::from_array(half_axes);
    let longest = half_axes.max_element();
    if longest == half_axes.min_element() {
        return Body::sphere(longest);
    }
    let points = unit_vectors();
    // The polytope about a ball of radius 1 is mapped: what contains the ball contains the ellipsoid.
    let scale = ELLIPSOID_ENLARGEMENT / inner_radius(&hull_of(&points));
    let points: Vec<DVec3> = points
        .iter()
        .map(|point| scale * half_axes * *point)
        .collect();
    let Hull { points, facets } = hull_of(&points);
    let facets = facets.iter().enumerate().map(|(id, corners)| Facet {
        origin: FacetOrigin::Face(id as u32),
        corners: corners.to_vec(),
    });
    let polytope = Polytope {
        facets: facets.collect(),
        points,
        ..Polytope::default()
    };
    // A point of length `1 + e` about the ball is at most `e` times the longest half axis from the ellipsoid, once mapped.
    Body::polytope(polytope)?.with_excess(longest * (scale * ELLIPSOID_ENLARGEMENT - 1.0))
}

/// Returns unit vectors in all directions, on a spiral from pole to pole.
fn unit_vectors() -> Vec<DVec3> {
    let golden_turn = TAU * (5f64.sqrt() - 1.0) / 2.0;
    let count = CORNER_COUNT as f64;
    let points = (0..CORNER_COUNT).map(|k| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / count;
        let (sine, cosine) = (golden_turn * k as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        DVec3::new(across * cosine, across * sine, z)
    });
    points.collect()
}

/// Returns the least height of the facets of a hull over the origin.
fn inner_radius(hull: &Hull) -> f64 {
    let heights = hull.facets.iter().map(|facet| {
        let [a, b, c] = [facet[0], facet[1], facet[2]].map(|corner| hull.points[corner as usize]);
        let normal = (b - a).cross(c - a);
        normal.dot(a) / normal.length()
    });
    heights.fold(f64::INFINITY, lesser)
}

fn hull_of(points: &[DVec3]) -> Hull {
    hull(points).expect("points of an ellipsoid are in range")
}

#[cfg(test)]
mod tests;
