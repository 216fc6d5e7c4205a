//! Tests whether two moving oriented boxes stay apart over an interval of time.

use super::relative::MotionEnclosure;
use crate::method::rival::interval::cross_radius;
use crate::method::rival::obb_tree::Obb;
use ccd_core::glam::{DMat3, DVec3};

/// A bound on the rounding of cosines between the axes of two boxes. Without it the cross product of parallel axes
/// would separate anything.
const COSINE_ROUNDING_BOUND: f64 = 1e-14;

/// Returns the largest half width of the enclosure of a corner's position over an interval of time; `None` if one of
/// the 15 axes separates the boxes throughout. Both sides of every inequality are enclosed by interval arithmetic
/// \[CONTACT02\].
pub(super) fn motion_spread_unless_separated(
    a: &Obb,
    b: &Obb,
    enclosure: &MotionEnclosure,
) -> Option<f64> {
    let into = b.axes.transpose();
    let center = enclosure.rotation * a.center + enclosure.offset;
    let t = into * (center.middle - b.center);
    let t_radius = into.abs() * center.radius;
    let t_high = t.abs() + t_radius;
    let cos = into * (enclosure.rotation.middle * a.axes);
    let cos_radius = into.abs() * (enclosure.rotation.radius * a.axes.abs());
    let high = cosine_upper_bounds(cos, cos_radius);
    let (ha, hb) = (a.half_extents, b.half_extents);
    // The axes of B: the distance of the centers along them against both half widths.
    if (t.abs() - t_radius - hb - high * ha).max_element() > 0.0 {
        return None;
    }
    // The axes of A. |Σ t_i c_i| has the middle |Σ t c| and the radius Σ (|t|+r)(|c|+s) − |t||c|.
    let low = cos.abs();
    let along = cos.transpose_mul_vec3(t).abs() + low.transpose_mul_vec3(t.abs());
    let width = high.transpose_mul_vec3(t_high + hb) + ha;
    if (along - width).max_element() > 0.0 {
        return None;
    }
    // The axes `b_i × a_j`, for all i at once.
    let separates = |c: DVec3, c_high: DVec3, of_a: DVec3| {
        let gap = t.cross(c).abs() + cross_radius(t.abs(), c.abs());
        (gap - cross_radius(t_high + hb, c_high) - of_a).max_element() > 0.0
    };
    let [x, y, z] = [high.x_axis, high.y_axis, high.z_axis];
    if separates(cos.x_axis, x, ha.y * z + ha.z * y)
        || separates(cos.y_axis, y, ha.z * x + ha.x * z)
        || separates(cos.z_axis, z, ha.x * y + ha.y * x)
    {
        return None;
    }
    Some((t_radius + cos_radius * ha).max_element())
}

/// Returns upper bounds of the absolute values of cosines, each of which is known to within a radius.
fn cosine_upper_bounds(cos: DMat3, radius: DMat3) -> DMat3 {
    let upper = |c: DVec3, r: DVec3| {
        (c.abs() + r + COSINE_ROUNDING_BOUND).min(DVec3::splat(1.0 + COSINE_ROUNDING_BOUND))
    };
    DMat3::from_cols(
        upper(cos.x_axis, radius.x_axis),
        upper(cos.y_axis, radius.y_axis),
        upper(cos.z_axis, radius.z_axis),
    )
}
