//! Exact predicates: on which side of a projected edge or of a triangle a point is.

use super::blend::{LazyPoint, exact_fraction};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use dashu_ratio::Relaxed;
use std::cmp::Ordering;

/// The pairs of coordinate indices that remain in the projections along z, x and y.
pub(super) const PROJECTION_AXES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// A bound on the rounding error of a 2×2 determinant, in units of the square of the points' size. It is hundreds of
/// times that of the terms, which are dominated by the error of the rounded point.
const ORIENT2D_ROUNDING: f64 = 1e-12;
/// A bound on the rounding error of a 3×3 determinant, in units of the cube of the points' size.
const ORIENT3D_ROUNDING: f64 = 1e-11;

/// Returns the exact side of the line through an edge on which a point is in a projection: left (greater), right (less)
/// or on the line.
pub(super) fn turn([x, y]: [usize; 2], [a, b]: [DVec3; 2], p: &LazyPoint<'_>) -> Ordering {
    // (b − a) × (p − a)
    let (u, v) = (b - a, p.rounded_point - a);
    let size = max_absolute_coordinate(&[a, b], p);
    certain_sign(u[x] * v[y] - u[y] * v[x], ORIENT2D_ROUNDING * size * size).unwrap_or_else(|| {
        let (u, v) = (exact_edge_vector(a, b), offset_from(a, p));
        (&u[x] * &v[y]).cmp(&(&u[y] * &v[x]))
    })
}

/// Returns the exact side of a triangle on which a point is: above (greater), below (less) or in its plane. The
/// triangle is counter-clockwise seen from above.
pub(super) fn side([a, b, c]: [DVec3; 3], p: &LazyPoint<'_>) -> Ordering {
    // (b − a) × (c − a) · (p − a)
    let height = (b - a).cross(c - a).dot(p.rounded_point - a);
    let size = max_absolute_coordinate(&[a, b, c], p);
    certain_sign(height, ORIENT3D_ROUNDING * size * size * size).unwrap_or_else(|| {
        let (u, v, w) = (
            exact_edge_vector(a, b),
            exact_edge_vector(a, c),
            offset_from(a, p),
        );
        let minor = |x: usize, y: usize| &u[x] * &v[y] - &u[y] * &v[x];
        let height = minor(1, 2) * &w[0] + minor(2, 0) * &w[1] + minor(0, 1) * &w[2];
        height.cmp(&Relaxed::ZERO)
    })
}

/// Returns the sign of a rounded number; `None` if the rounding error may have changed it.
fn certain_sign(x: f64, rounding: f64) -> Option<Ordering> {
    (x.abs() > rounding + f64::MIN_POSITIVE).then(|| x.total_cmp(&0.0))
}

/// Returns the largest absolute coordinate of `points` and of the points that `p` combines.
fn max_absolute_coordinate(points: &[DVec3], p: &LazyPoint<'_>) -> f64 {
    let sizes = points.iter().map(|q| q.abs().max_element());
    sizes.fold(p.max_coordinate, greater)
}

fn exact_edge_vector(a: DVec3, b: DVec3) -> [Relaxed; 3] {
    [0, 1, 2].map(|k| exact_fraction(b[k]) - exact_fraction(a[k]))
}

fn offset_from(a: DVec3, p: &LazyPoint<'_>) -> [Relaxed; 3] {
    [0, 1, 2].map(|k| &p.exact_coordinates()[k] - exact_fraction(a[k]))
}

/// Returns true, by exact arithmetic, if a triangle with its boundary contains a point; the triangle may have no area.
pub(super) fn triangle_contains_lazy_point(triangle: [DVec3; 3], p: &LazyPoint<'_>) -> bool {
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

/// Compares a number with a coordinate of a point, exactly.
fn compare_coordinate(x: f64, axis: usize, p: &LazyPoint<'_>) -> Ordering {
    let rounding = p.rounding() + f64::EPSILON * x.abs();
    certain_sign(x - p.rounded_point[axis], rounding)
        .unwrap_or_else(|| exact_fraction(x).cmp(&p.exact_coordinates()[axis]))
}
