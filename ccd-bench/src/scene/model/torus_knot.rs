//! Makes torus knots: long, thin tubes that interlock with themselves.

use super::grid::closed_grid_mesh;
use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};
use std::f64::consts::TAU;

/// The number of turns of the knot around the torus' axis.
const TURNS_AROUND_AXIS: f64 = 2.0;
/// The number of turns of the knot around the torus' tube, while it makes all its turns around the axis.
const TURNS_AROUND_TUBE: f64 = 3.0;
/// The radius of the torus on which the knot lies, and the radius of the tube of this torus.
const TORUS_RADII: (f64, f64) = (2.0 / 3.0, 1.0 / 3.0);

/// Returns the closed mesh of a tube around the (2, 3) torus knot, the trefoil, with its center at the origin. The tube
/// has `segments` rings of `sides` corners each, at least 3 of either, and so `2 · segments · sides` triangles. The
/// tube's radius is below 0.33, at which it would touch itself in the middle.
///
/// # Errors
/// If a number of parts is too small or too large for a mesh.
pub fn torus_knot([segments, sides]: [usize; 2], tube: f64) -> Result<TriangleMesh, MeshError> {
    closed_grid_mesh(segments, sides, |u, v| {
        let (on_curve, tangent, normal) = knot_frame(TAU * u);
        let (sin, cos) = (TAU * v).sin_cos();
        on_curve + tube * (cos * normal + sin * tangent.cross(normal))
    })
}

/// Returns a point of the knot, the unit tangent there, and the unit normal of the torus that it
/// lies on. The normal is perpendicular to the tangent and periodic.
fn knot_frame(t: f64) -> (DVec3, DVec3, DVec3) {
    let (sin_a, cos_a) = (TURNS_AROUND_AXIS * t).sin_cos();
    let (sin_b, cos_b) = (TURNS_AROUND_TUBE * t).sin_cos();
    let (radius, tube) = TORUS_RADII;
    let outward = DVec3::new(cos_a, sin_a, 0.0);
    let around = DVec3::new(-sin_a, cos_a, 0.0);
    let normal = cos_b * outward - sin_b * DVec3::Z;
    let velocity = TURNS_AROUND_AXIS * (radius + tube * cos_b) * around
        - TURNS_AROUND_TUBE * tube * (sin_b * outward + cos_b * DVec3::Z);
    (
        radius * outward + tube * normal,
        velocity.normalize(),
        normal,
    )
}
