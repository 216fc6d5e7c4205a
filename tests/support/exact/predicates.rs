//! The side of a point relative to an edge seen along an axis, and to a triangle.

use super::blend::Spot;
use super::number::{Interval, Number};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use std::cmp::Ordering;

/// The pairs of coordinates in the views along z, x and y.
pub(super) const VIEWS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Returns whether a point is left of (greater), right of (less) or on the line through an edge, in
/// a view.
pub(super) fn turn(view: [usize; 2], edge: [DVec3; 2], p: &Spot<'_>) -> Ordering {
    turn_in(view, edge, &p.near)
        .or_else(|| turn_in(view, edge, p.exact()))
        .expect("fractions have a sign")
}

/// Returns whether a point is above (greater), below (less) or in the plane of a triangle that is
/// counter-clockwise seen from above.
pub(super) fn side(triangle: [DVec3; 3], p: &Spot<'_>) -> Ordering {
    side_in(triangle, &p.near)
        .or_else(|| side_in(triangle, p.exact()))
        .expect("fractions have a sign")
}

/// Returns true if a closed triangle, perhaps without area, contains a point.
pub(super) fn holds(triangle: [DVec3; 3], p: &Spot<'_>) -> bool {
    let [a, b, c] = triangle;
    // A triangle without area is a segment in every view, bounded by its box.
    let beyond = |axis: usize| {
        let [x, y, z] = [a[axis], b[axis], c[axis]];
        let within = |q: f64, order| compare(q, axis, p) == order;
        within(lesser(lesser(x, y), z), Ordering::Greater)
            || within(greater(greater(x, y), z), Ordering::Less)
    };
    let out_of_view = |view: &[usize; 2]| {
        let turns = [[a, b], [b, c], [c, a]].map(|edge| turn(*view, edge, p));
        turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater)
    };
    !(0..3).any(beyond) && side(triangle, p) == Ordering::Equal && !VIEWS.iter().any(out_of_view)
}

/// Compares a number to a coordinate of a point.
fn compare(x: f64, axis: usize, p: &Spot<'_>) -> Ordering {
    p.near[axis]
        .minus(&Interval::from_f64(x))
        .sign()
        .or_else(|| Number::sign(&p.exact()[axis].minus(&Number::from_f64(x))))
        .expect("fractions have a sign")
        .reverse()
}

fn turn_in<N: Number>([x, y]: [usize; 2], edge: [DVec3; 2], p: &[N; 3]) -> Option<Ordering> {
    let [a, b] = edge.map(N::point);
    // (b − a) × (p − a)
    let forth = b[x].minus(&a[x]).times(&p[y].minus(&a[y]));
    let back = b[y].minus(&a[y]).times(&p[x].minus(&a[x]));
    forth.minus(&back).sign()
}

fn side_in<N: Number>(triangle: [DVec3; 3], p: &[N; 3]) -> Option<Ordering> {
    let [a, b, c] = triangle.map(N::point);
    let from_a = |q: &[N; 3]| [0, 1, 2].map(|k| q[k].minus(&a[k]));
    let (u, v, w) = (from_a(&b), from_a(&c), from_a(p));
    let minor = |x: usize, y: usize| u[x].times(&v[y]).minus(&u[y].times(&v[x]));
    // (b − a) × (c − a) · (p − a)
    let [yz, zx, xy] = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let sum = yz.times(&w[0]).plus(&zx.times(&w[1]));
    sum.plus(&xy.times(&w[2])).sign()
}
