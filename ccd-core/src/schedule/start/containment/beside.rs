//! Points of a flat piece on either side of another piece's edges on it.

use crate::body::piece::Piece;
use crate::math::order::{greater, lesser};
use crate::math::vector::across;
use crate::math::vector::unit_or_any;
use crate::tolerance::BESIDE_EDGE;
use glam::DVec3;

/// For every edge of `other` that is on a flat piece, returns points of the piece on either side of
/// the middle of their common part. An edge counts as on the piece if it leaves its plane by at
/// most `reach`.
///
/// A surface that passes through a piece's inside, without any of its faces intersecting it, does
/// so along such edges. For a part that is entirely in the plane, the faces beyond its edges
/// decide.
pub(super) fn beside_edges(
    piece: &Piece<'_>,
    other: &Piece<'_>,
    place: impl Fn(DVec3) -> DVec3,
    reach: f64,
) -> Vec<DVec3> {
    let corners: Vec<DVec3> = match piece.facets.iter().next() {
        Some(corners) => corners.iter().map(|&k| piece.points[k as usize]).collect(),
        None => piece.points.to_vec(),
    };
    let [a, b, c, ..] = corners[..] else {
        return Vec::new();
    };
    let normal = unit_or_any(across(b - a, c - a));
    let placed: Vec<DVec3> = other.points.iter().map(|&p| place(p)).collect();
    let is_level = |k: &u32| normal.dot(placed[*k as usize] - a).abs() <= reach;
    if (0..placed.len() as u32).all(|k| is_level(&k)) {
        return Vec::new();
    }
    // For each side of the piece: a point on it, and the inward direction.
    let sides: Vec<(DVec3, DVec3)> = (0..corners.len())
        .map(|k| (corners[k], corners[(k + 1) % corners.len()]))
        .map(|(from, to)| (from, normal.cross(to - from)))
        .collect();
    let on_piece = |p: &DVec3| {
        sides
            .iter()
            .all(|(from, inward)| inward.dot(*p - from) > 0.0)
    };
    let mut found = Vec::new();
    for [from, to] in edges(other) {
        if !(is_level(&from) && is_level(&to)) {
            continue;
        }
        let (from, way) = {
            let [from, to] = [from, to].map(|k| placed[k as usize]);
            (from, to - from)
        };
        let (mut enter, mut leave) = (0.0, 1.0);
        for (side, inward) in &sides {
            let (depth, speed) = (inward.dot(from - side), inward.dot(way));
            match () {
                () if speed > 0.0 => enter = greater(enter, -depth / speed),
                () if speed < 0.0 => leave = lesser(leave, -depth / speed),
                () if depth < 0.0 => leave = f64::NEG_INFINITY,
                () => {}
            }
        }
        if leave > enter {
            let middle = from + way * (0.5 * (enter + leave));
            let beside = normal.cross(way) * (BESIDE_EDGE * (leave - enter));
            found.extend(
                [middle + beside, middle - beside]
                    .iter()
                    .filter(|p| on_piece(p)),
            );
        }
    }
    found
}

/// Returns the edges of a piece, by its points, each at least once.
fn edges(piece: &Piece<'_>) -> Vec<[u32; 2]> {
    let around = |corners: &[u32]| -> Vec<[u32; 2]> {
        let ends = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
        (0..corners.len()).map(ends).collect()
    };
    match piece.facets.is_empty() {
        true => around(&(0..piece.points.len() as u32).collect::<Vec<_>>()),
        false => {
            let all = piece.facets.iter().flat_map(around);
            all.filter(|[from, to]| from < to).collect()
        }
    }
}
