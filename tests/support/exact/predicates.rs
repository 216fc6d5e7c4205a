//! Exact predicates: the side of a point relative to an edge seen along an axis, and relative to a triangle.

use super::blend::{LazyPoint, exact};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use dashu_ratio::Relaxed;
use std::cmp::Ordering;

/// The pairs of coordinate indices in the views along z, x and y.
pub(super) const PROJECTION_AXES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// The bounds on the rounding errors of determinants, in units of the power of the size of points. They are hundreds
/// of times those of the terms, which are dominated by the error of the rounded point.
const ORIENT2D_ROUNDING: f64 = 1e-12;
const ORIENT3D_ROUNDING: f64 = 1e-11;

/// Returns whether a point is left of (greater), right of (less) or on the line through an edge, in
/// a view.
pub(super) fn turn([x, y]: [usize; 2], [a, b]: [DVec3; 2], p: &LazyPoint<'_>) -> Ordering {
    // (b − a) × (p − a)
    let (u, v) = (b - a, p.near - a);
    let size = max_coordinate(&[a, b], p);
    certain_sign(u[x] * v[y] - u[y] * v[x], ORIENT2D_ROUNDING * size * size).unwrap_or_else(|| {
        let (u, v) = (exact_difference(a, b), offset_from(a, p));
        (&u[x] * &v[y]).cmp(&(&u[y] * &v[x]))
    })
}

/// Returns whether a point is above (greater), below (less) or in the plane of a triangle that is
/// counter-clockwise seen from above.
pub(super) fn side([a, b, c]: [DVec3; 3], p: &LazyPoint<'_>) -> Ordering {
    // (b − a) × (c − a) · (p − a)
    let height = (b - a).cross(c - a).dot(p.near - a);
    let size = max_coordinate(&[a, b, c], p);
    certain_sign(height, ORIENT3D_ROUNDING * size * size * size).unwrap_or_else(|| {
        let (u, v, w) = (
            exact_difference(a, b),
            exact_difference(a, c),
            offset_from(a, p),
        );
        let minor = |x: usize, y: usize| &u[x] * &v[y] - &u[y] * &v[x];
        let height = minor(1, 2) * &w[0] + minor(2, 0) * &w[1] + minor(0, 1) * &w[2];
        height.cmp(&Relaxed::ZERO)
    })
}

/// Returns the sign of a rounded number; `None` if the rounding error could change it.
fn certain_sign(x: f64, rounding: f64) -> Option<Ordering> {
    (x.abs() > rounding + f64::MIN_POSITIVE).then(|| x.total_cmp(&0.0))
}

/// Returns the largest absolute coordinate of some points and of the combined points of `p`.
fn max_coordinate(points: &[DVec3], p: &LazyPoint<'_>) -> f64 {
    let sizes = points.iter().map(|q| q.abs().max_element());
    sizes.fold(p.size, greater)
}

fn exact_difference(a: DVec3, b: DVec3) -> [Relaxed; 3] {
    [0, 1, 2].map(|k| exact(b[k]) - exact(a[k]))
}

fn offset_from(a: DVec3, p: &LazyPoint<'_>) -> [Relaxed; 3] {
    [0, 1, 2].map(|k| &p.exact()[k] - exact(a[k]))
}

/// Returns true if a closed triangle, perhaps without area, contains a point.
pub(super) fn triangle_contains(triangle: [DVec3; 3], p: &LazyPoint<'_>) -> bool {
    let [a, b, c] = triangle;
    // A triangle without area is a segment in every view, bounded by its box.
    let beyond = |axis: usize| {
        let [x, y, z] = [a[axis], b[axis], c[axis]];
        let within = |q: f64, order| compare_coordinate(q, axis, p) == order;
        within(lesser(lesser(x, y), z), Ordering::Greater)
            || within(greater(greater(x, y), z), Ordering::Less)
    };
    let out_of_view = |view: &[usize; 2]| {
        let turns = [[a, b], [b, c], [c, a]].map(|edge| turn(*view, edge, p));
        turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater)
    };
    !(0..3).any(beyond)
        && side(triangle, p) == Ordering::Equal
        && !PROJECTION_AXES.iter().any(out_of_view)
}

/// Compares a number with a coordinate of a point.
fn compare_coordinate(x: f64, axis: usize, p: &LazyPoint<'_>) -> Ordering {
    let rounding = p.rounding() + f64::EPSILON * x.abs();
    certain_sign(x - p.near[axis], rounding).unwrap_or_else(|| exact(x).cmp(&p.exact()[axis]))
}
