//! Fits the oriented bounding box and the bounding ball of a node.

mod sample;

use super::group::{Node, NodeChildren, round_up_to_f32};
use crate::math::order::greater;
use crate::math::principal::principal_axes;
use crate::math::vector::{bounding_box, length, unit};
use crate::rounding::{FRAME_ERROR_F64, UNIT_ROUNDOFF_F64};
use glam::{DMat3, DVec3, Vec3};
pub(crate) use sample::PointSample;

/// The points of all pieces below a node, to which a box is fitted.
pub(crate) struct NodePoints<'a> {
    pub(crate) points: &'a [DVec3],
    /// The largest rounding radius of the pieces.
    pub(crate) rounding_radius: f64,
    /// True if every three consecutive points are the corners of a triangle.
    pub(crate) are_triangles: bool,
}

/// The sines and cosines of the angles by which trial frames are turned about the mean normal: 0 to 75 degrees in steps
/// of 15.
const TRIAL_ROTATION_SINES_COSINES: [(f64, f64); 6] = [
    (0.0, 1.0),
    (0.258_819_045_102_520_74, 0.965_925_826_289_068_3),
    (0.5, 0.866_025_403_784_438_6),
    (
        std::f64::consts::FRAC_1_SQRT_2,
        std::f64::consts::FRAC_1_SQRT_2,
    ),
    (0.866_025_403_784_438_6, 0.5),
    (0.965_925_826_289_068_3, 0.258_819_045_102_520_74),
];

/// Creates a node with a box and a ball fitted to all points. Several frames are tried on a sample of the points, and
/// the frame whose box has the least surface is taken. The node has the box's axes rounded to f32, with that of the
/// largest extent first; the sizes are measured along the rounded axes.
///
/// # Guarantee
/// The box and the ball contain all points: the sample only chooses the frame.
pub(crate) fn fit_node(
    node_points: &NodePoints<'_>,
    children: NodeChildren,
    sample: &mut PointSample,
) -> Node {
    sample.fill_from(node_points);
    let frame = best_frame(sample, node_points.are_triangles);
    let turned = frame.transpose();
    let (low, high) = bounding_box(node_points.points.iter().map(|&p| turned * p));
    let size = high - low;
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| size[j].total_cmp(&size[i]));
    let center = frame * (0.5 * (low + high));
    let axes: [Vec3; 3] = order.map(|k| frame.col(k).as_vec3());
    let along = axes.map(Vec3::as_dvec3);
    let (mut half, mut square) = ([0.0f64; 3], 0.0f64);
    for &point in node_points.points {
        let way = point - center;
        for (half, axis) in half.iter_mut().zip(along) {
            *half = greater(*half, way.dot(axis).abs());
        }
        square = greater(square, way.length_squared());
    }
    // A product that cancels is off by this much, which `round_up_to_f32` does not cover in a flat box.
    let rounding = 8.0 * UNIT_ROUNDOFF_F64 * square.sqrt();
    let outward = |x: f64| round_up_to_f32(x + rounding).next_up();
    Node {
        center,
        axes,
        half_extents: half.map(outward),
        radius: outward(square.sqrt() + node_points.rounding_radius),
        rounding_radius: round_up_to_f32(node_points.rounding_radius),
        children,
    }
}

/// Returns the frame whose box around the sample has the least surface area. The frames tried are along the
/// coordinates, along principal axes of the points, and, for triangles, along principal axes by area or about the mean
/// normal.
pub(super) fn best_frame(sample: &PointSample, of_triangles: bool) -> DMat3 {
    let mut best = DMat3::IDENTITY;
    let mut least = sample.half_surface_area(&best);
    let mut consider = |frame: DMat3| {
        let surface = sample.half_surface_area(&frame);
        // A dropped frame only makes the box less tight. A frame that is not orthonormal would make it too small.
        // Written so that a frame with NaN is dropped.
        if surface < least && is_orthonormal(&frame) {
            (best, least) = (frame, surface);
        }
    };
    consider(principal_axes(|| sample.points().iter().map(|&p| (p, 1.0))));
    if !of_triangles {
        return best;
    }
    let triangles = || sample.points().as_chunks().0.iter().copied();
    let across = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
    consider(principal_axes(|| {
        triangles().map(|t| ((t[0] + t[1] + t[2]) / 3.0, length(across(t))))
    }));
    if let Some(normal) = unit(triangles().map(across).sum()) {
        let (x, y) = normal.any_orthonormal_pair();
        for (sin, cos) in TRIAL_ROTATION_SINES_COSINES {
            let turned = [x * cos + y * sin, y * cos - x * sin];
            consider(DMat3::from_cols(turned[0], turned[1], normal));
        }
    }
    best
}

/// Returns whether the columns of a matrix are orthonormal up to rounding. Otherwise the box may not contain its
/// points.
fn is_orthonormal(frame: &DMat3) -> bool {
    let off = frame.transpose() * *frame - DMat3::IDENTITY;
    // Written so that NaN is rejected.
    let within = |v: DVec3| v.abs().cmple(DVec3::splat(FRAME_ERROR_F64)).all();
    within(off.x_axis) && within(off.y_axis) && within(off.z_axis)
}

#[cfg(test)]
mod tests;
