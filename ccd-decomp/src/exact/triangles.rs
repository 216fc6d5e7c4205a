//! Exact intersection tests of triangles and segments.

use super::predicates::{Projection, side_of_plane};
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Returns whether two non-degenerate triangles of a mesh have a common point other than the corners and the edge that
/// they share. Corners are given by number and by point.
pub(crate) fn meet_outside_shared_corners(
    corners: [[u32; 3]; 2],
    triangles: [[DVec3; 3]; 2],
) -> bool {
    let is_shared = |which: usize, k: usize| corners[1 - which].contains(&corners[which][k]);
    let shared = (0..3).filter(|&k| is_shared(0, k)).count();
    match shared {
        0 => triangles_meet(triangles),
        // Two edges meet the other triangle in the shared corner. If they meet it elsewhere, too, so does
        // one of the far edges.
        1 => [0, 1].into_iter().any(|which| {
            let k = (0..3).find(|&k| is_shared(which, k)).unwrap_or(0);
            let far = [(k + 1) % 3, (k + 2) % 3].map(|k| triangles[which][k]);
            segment_meets_triangle(far, triangles[1 - which])
        }),
        2 => are_folded_flat(corners, triangles),
        // One triangle, from either side.
        _ => true,
    }
}

/// Returns whether two triangles of non-zero area have a point in common.
pub(crate) fn triangles_meet(triangles: [[DVec3; 3]; 2]) -> bool {
    let beyond = |which: usize| {
        let sides = triangles[1 - which].map(|p| side_of_plane(triangles[which], p));
        sides[0] != Ordering::Equal && sides.iter().all(|&s| s == sides[0])
    };
    !beyond(0)
        && !beyond(1)
        && (0..3).any(|k| {
            let edge = |which: usize| [triangles[which][k], triangles[which][(k + 1) % 3]];
            segment_meets_triangle(edge(0), triangles[1])
                || segment_meets_triangle(edge(1), triangles[0])
        })
}

/// Returns whether two triangles that share an edge are coplanar and lie on the same side of this edge.
fn are_folded_flat(corners: [[u32; 3]; 2], [one, other]: [[DVec3; 3]; 2]) -> bool {
    let far = |which: usize| (0..3).find(|&k| !corners[1 - which].contains(&corners[which][k]));
    let (Some(k), Some(l)) = (far(0), far(1)) else {
        return true;
    };
    let Some(projection) = Projection::new(one) else {
        return true;
    };
    side_of_plane(one, other[l]) == Ordering::Equal
        && projection.turn(one[(k + 1) % 3], one[(k + 2) % 3], other[l]) == Ordering::Greater
}

/// Returns whether a segment meets a triangle; touching counts.
fn segment_meets_triangle([p, q]: [DVec3; 2], triangle: [DVec3; 3]) -> bool {
    let [a, b, c] = triangle;
    match (side_of_plane(triangle, p), side_of_plane(triangle, q)) {
        (Ordering::Equal, Ordering::Equal) => coplanar_segment_meets_triangle([p, q], triangle),
        (s, t) if s == t => false,
        _ => {
            // The tetrahedra of the segment with each edge have one orientation if it crosses inside.
            let turns = [(a, b), (b, c), (c, a)].map(|(v, w)| side_of_plane([p, q, v], w));
            !(turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater))
        }
    }
}

/// Returns whether a segment in the triangle's plane meets the triangle; touching counts.
fn coplanar_segment_meets_triangle([p, q]: [DVec3; 2], triangle: [DVec3; 3]) -> bool {
    let Some(projection) = Projection::new(triangle) else {
        return true;
    };
    let outside = |k: usize| {
        let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
        [p, q].map(|x| projection.turn(a, b, x)) == [Ordering::Less; 2]
    };
    let turns = triangle.map(|x| projection.turn(p, q, x));
    let passes = turns[0] != Ordering::Equal && turns.iter().all(|&t| t == turns[0]);
    !(passes || (0..3).any(outside))
}
