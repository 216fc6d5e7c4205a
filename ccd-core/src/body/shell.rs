//! Finds the connected parts of a body, and their extreme points.

use super::disjoint_sets::DisjointSets;
use super::pieces::Pieces;
use crate::math::vector::position_bits;
use glam::DVec3;
use std::collections::HashMap;

/// The six extreme points of a connected part, along x, y, z, −x, −y and −z.
pub(crate) type ExtremePoints = [DVec3; 6];

/// Returns for each piece the number of the connected part that it belongs to; pieces that share a point are connected. Parts are
/// numbered in the order of their first pieces.
///
/// # Complexity
/// Approximately linear in the number of points.
pub fn connected_part_numbers(pieces: &Pieces) -> Vec<u32> {
    let (mut parts, _) = connected_points(pieces);
    let mut number_of_root = HashMap::new();
    let numbers = (0..pieces.len()).map(|piece| {
        let root = parts.root(pieces.point_range(piece).start as u32);
        let next = number_of_root.len() as u32;
        *number_of_root.entry(root).or_insert(next)
    });
    numbers.collect()
}

/// Returns the six extreme points of every connected part of a body; pieces that share a point are connected.
///
/// # Complexity
/// Approximately linear in the number of points.
pub(crate) fn part_extreme_points(pieces: &Pieces) -> Vec<ExtremePoints> {
    let points = pieces.points();
    let (mut parts, distinct) = connected_points(pieces);
    let mut shell_of = vec![u32::MAX; points.len()];
    let mut shells: Vec<ExtremePoints> = Vec::new();
    for k in distinct {
        let point = points[k as usize];
        let shell = &mut shell_of[parts.root(k) as usize];
        if *shell == u32::MAX {
            *shell = shells.len() as u32;
            shells.push([point; 6]);
        }
        for (side, extreme) in shells[*shell as usize].iter_mut().enumerate() {
            let sign = if side < 3 { 1.0 } else { -1.0 };
            if sign * (point[side % 3] - extreme[side % 3]) > 0.0 {
                *extreme = point;
            }
        }
    }
    shells
}

/// Joins points that have the same vertex number and the same position. Returns the sets, and the index of the first
/// point of each set.
///
/// The points of a mesh's vertex have its number, so that hardly any equal points remain. The result does not rely on
/// numbers: points count as equal by their coordinates.
fn join_equal_points_of_equal_number(pieces: &Pieces) -> (DisjointSets, Vec<u32>) {
    let (points, numbers) = (pieces.points(), pieces.all_vertex_ids());
    let range = numbers
        .iter()
        .max()
        .map_or(0, |&last| (last as usize).saturating_add(1));
    // Numbers may be arbitrary: a table of them must not be larger than the points.
    let range = if range <= 2 * points.len() { range } else { 0 };
    let mut first = vec![u32::MAX; range];
    let (mut parts, mut distinct) = (Vec::with_capacity(points.len()), Vec::new());
    for ((k, point), &number) in (0u32..).zip(points).zip(numbers) {
        let known = first.get_mut(number as usize).map_or(k, |known| {
            *known = (*known).min(k);
            *known
        });
        if known != k && points[known as usize] == *point {
            parts.push(known);
        } else {
            parts.push(k);
            distinct.push(k);
        }
    }
    (DisjointSets::from_roots(parts), distinct)
}

/// Joins the sets of points at the same position, whatever their vertex numbers.
fn join_coincident_points(points: &[DVec3], distinct: &[u32], parts: &mut DisjointSets) {
    let mut known = HashMap::with_capacity(distinct.len());
    for &k in distinct {
        let first = *known.entry(position_bits(points[k as usize])).or_insert(k);
        parts.join(first, k);
    }
}

/// Joins the points of each piece, and points at the same place. Returns the sets, and one point of each that was joined at first.
fn connected_points(pieces: &Pieces) -> (DisjointSets, Vec<u32>) {
    let points = pieces.points();
    let (mut parts, distinct) = join_equal_points_of_equal_number(pieces);
    let mut count = distinct.len();
    for piece in 0..pieces.len() {
        let range = pieces.point_range(piece);
        for k in range.start as u32 + 1..range.end as u32 {
            count -= usize::from(parts.join(k - 1, k));
        }
    }
    // A single part needs no further joining.
    if count > 1 {
        join_coincident_points(points, &distinct, &mut parts);
    }
    (parts, distinct)
}

#[cfg(test)]
mod tests;
