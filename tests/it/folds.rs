//! Tests that a fold with `lesser` or `greater` loses no element, whatever the compiler makes of it.
//!
//! Some compilers lose the last elements of a fold with `f64::min`: those that are left over when the
//! loop is cut into vectors and its length is known and small. These are two affected loops: one over
//! consecutive numbers (AVX2 is enough), one over corners of edges (by gathers, with AVX-512).

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use std::hint::black_box;

/// Tests folds over arrays of up to 16 elements, in which each element in turn is the least or the greatest.
#[test]
fn no_element_is_lost() {
    macro_rules! at_lengths {
        ($($n:literal)*) => {
            [$(lost_positions::<$n>(loses_number::<$n>), lost_positions::<$n>(loses_edge::<$n>)),*].concat()
        };
    }
    let lost = at_lengths![1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16];
    assert!(lost.is_empty(), "lost, as (length, position): {lost:?}");
}

/// Returns the array lengths and positions at which the fold lost an element.
fn lost_positions<const N: usize>(lost: impl Fn(usize) -> bool) -> Vec<(usize, usize)> {
    (0..N).filter(|&at| lost(at)).map(|at| (N, at)).collect()
}

fn loses_number<const N: usize>(at: usize) -> bool {
    let (mut low, mut high) = ([2.0; N], [1.0; N]);
    (low[at], high[at]) = (1.0, 2.0);
    let least = fold_numbers(&black_box(low), f64::INFINITY, lesser);
    let most = fold_numbers(&black_box(high), f64::NEG_INFINITY, greater);
    least != long_computation(1.0) || most != long_computation(2.0)
}

fn loses_edge<const N: usize>(at: usize) -> bool {
    let edge = |height: f64| [DVec3::new(-1.0, height, 0.0), DVec3::new(1.0, height, 0.0)];
    let (mut low, mut high) = ([edge(2.0); N], [edge(1.0); N]);
    (low[at], high[at]) = (edge(1.0), edge(2.0));
    let points = [DVec3::ZERO; 2];
    let least =
        fold_squared_edge_distances(black_box(points), &black_box(low), f64::INFINITY, lesser);
    let most = fold_squared_edge_distances(
        black_box(points),
        &black_box(high),
        f64::NEG_INFINITY,
        greater,
    );
    least != 1.0 || most != 4.0
}

#[inline(never)]
fn fold_numbers<const N: usize>(
    numbers: &[f64; N],
    start: f64,
    better: impl Fn(f64, f64) -> f64,
) -> f64 {
    numbers
        .iter()
        .fold(start, |best, &x| better(best, long_computation(x)))
}

/// Computes a value with so many instructions that the compiler does not unroll the loop around it.
#[inline(always)]
fn long_computation(x: f64) -> f64 {
    let root = |x: f64| x.sqrt().sqrt().sqrt().sqrt();
    root(root(root(root(x))))
}

#[inline(never)]
fn fold_squared_edge_distances<const N: usize>(
    points: [DVec3; 2],
    edges: &[[DVec3; 2]; N],
    start: f64,
    better: impl Fn(f64, f64) -> f64,
) -> f64 {
    let mut best = start;
    for &edge in edges {
        let mut of_edge = start;
        for point in points {
            of_edge = better(of_edge, squared_distance(point, edge));
        }
        best = better(best, of_edge);
    }
    best
}

#[inline(always)]
fn squared_distance(point: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let fraction = (point - a).dot(along) / along.dot(along);
    let foot = if fraction > 0.0 {
        a + lesser(fraction, 1.0) * along
    } else {
        a
    };
    foot.distance_squared(point)
}
