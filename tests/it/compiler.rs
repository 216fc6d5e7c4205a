//! Whether this build is one of those in which loops over nested arrays come out wrong.

use ccd_core::glam::DVec3;
use ccd_tests::referee::{edge_edge_squared, point_triangle, triangles_squared};
use std::hint::black_box;

type Triangle = [DVec3; 3];

fn edges(t: Triangle) -> [[DVec3; 2]; 3] {
    [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]
}

/// What [`triangles_squared`] computes for triangles that do not intersect, with nothing that could
/// be put side by side.
fn one_by_one(a: Triangle, b: Triangle) -> f64 {
    let corner_face = |p: DVec3, t: Triangle| {
        let foot = black_box(point_triangle as fn(DVec3, Triangle) -> DVec3);
        foot(p, black_box(t)).distance_squared(p)
    };
    let edge_edge = black_box(edge_edge_squared as fn([DVec3; 2], [DVec3; 2]) -> f64);
    let mut best = f64::INFINITY;
    for k in 0..3 {
        best = best.min(corner_face(a[k], b)).min(corner_face(b[k], a));
        for l in 0..3 {
            best = best.min(edge_edge(edges(a)[k], black_box(edges(b)[l])));
        }
    }
    best
}

#[test]
fn loops_over_nested_arrays_are_compiled_right() {
    let mut state = 12345u64;
    let mut coordinate = || {
        let (factor, term) = (6364136223846793005, 1442695040888963407);
        state = state.wrapping_mul(factor).wrapping_add(term);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut triangle = || [(); 3].map(|()| DVec3::from_array([(); 3].map(|()| coordinate())));
    for _ in 0..20_000 {
        let (a, b) = (triangle(), triangle().map(|p| p + 4.0 * DVec3::X));
        let (fast, slow) = (triangles_squared(a, b), one_by_one(a, b));
        assert!(
            (fast - slow).abs() <= 1e-12 * slow,
            "{fast} for {slow}: no answer of this build is to be trusted; \
             build with `-C target-cpu=x86-64-v3`"
        );
    }
}
