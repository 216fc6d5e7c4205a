//! Recognises star-shaped solids, whose whole surface is visible from one point.

use super::manifold::Manifold;
use crate::exact::predicates::{ray_meets_one_triangle, side_of_plane};
use ccd_core::glam::DVec3;
use ccd_core::limits::LEAST_NONZERO_COORDINATE;

/// Returns a point from which the whole surface is visible; `None` if no candidate point is such a point. A point sees
/// the surface if it is behind every face, and no face hides another.
///
/// # Guarantee
/// Exact: faces then share only vertices and edges, and the solid is behind them. From a point behind all
/// faces, every direction meets equally many faces: one, if a single direction does `[MEHLHORN96]`.
///
/// # Complexity
/// O(n).
pub(crate) fn star_center(manifold: &Manifold<'_>) -> Option<DVec3> {
    let triangles = || (0..manifold.faces().len() as u32).map(|face| manifold.triangle(face));
    let [a, b, c] = triangles().next()?;
    let target = with_tiny_coordinates_zeroed((a + b + c) / 3.0);
    candidate_centers(manifold).into_iter().find(|&middle| {
        let has_behind = |triangle| side_of_plane(triangle, middle).is_lt();
        triangles().all(has_behind) && ray_meets_one_triangle(triangles(), middle, target)
    })
}

/// Returns candidate points that are likely inside: the mean of all corners, and the center of mass.
fn candidate_centers(manifold: &Manifold<'_>) -> [DVec3; 2] {
    let faces = 0..manifold.faces().len() as u32;
    let near = manifold.triangle(0)[0];
    let (mut sum, mut moment, mut volume) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for face in faces.clone() {
        let [a, b, c] = manifold.triangle(face).map(|p| p - near);
        let six = a.dot(b.cross(c));
        sum += a + b + c;
        moment += six * (a + b + c);
        volume += six;
    }
    let mean = sum / (3 * faces.len()) as f64;
    // A non-finite point is behind no face.
    [mean, moment / (4.0 * volume)].map(|middle| with_tiny_coordinates_zeroed(near + middle))
}

/// Replaces coordinates that are too near to 0 for exact predicates by 0.
fn with_tiny_coordinates_zeroed(p: DVec3) -> DVec3 {
    DVec3::select(
        p.abs().cmplt(DVec3::splat(LEAST_NONZERO_COORDINATE)),
        DVec3::ZERO,
        p,
    )
}

#[cfg(test)]
mod tests;
