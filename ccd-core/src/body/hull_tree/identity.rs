//! Identifies equal points of two children and of their parent's hull.

use super::error::HullFault;
use super::hull::Hull;
use super::node::Node;
use crate::math::vector::position_bits;
use glam::DVec3;

/// Common numbers for the points of two children and of their parent's hull; equal points have the same number.
///
/// Numbers below the hull's count of points name the hull's points. The others name hidden points.
pub(super) struct PointNumbering {
    /// The common numbers of the points of each child.
    pub(super) child_point_numbers: [Vec<u32>; 2],
    /// The position of the point with each common number.
    pub(super) positions: Vec<DVec3>,
    /// The mesh's vertex number of each point of the hull.
    pub(super) vertex_ids: Vec<u32>,
}

impl PointNumbering {
    /// Numbers the points of a hull and of its two children in O(n log n); fails if a hull point is not a child's
    /// point.
    pub(super) fn new(hull: &Hull, [left, right]: [&Node<'_>; 2]) -> Result<Self, HullFault> {
        let own = hull.points.len();
        let all = [&hull.points[..], &left.points, &right.points];
        let same = representative_indices(all, own);
        let mut numbers = same.clone();
        let mut positions = hull.points.clone();
        let points = left.points.iter().chain(right.points.iter());
        for (k, point) in (own..).zip(points) {
            numbers[k] = match same[k] as usize {
                first if first == k => {
                    positions.push(*point);
                    positions.len() as u32 - 1
                }
                first => numbers[first],
            };
        }
        let mut vertex_ids = vec![None; own];
        let names = left.vertex_ids.iter().chain(&right.vertex_ids);
        for (&id, &vertex) in numbers[own..].iter().zip(names) {
            if let Some(known) = vertex_ids.get_mut(id as usize) {
                *known = Some(vertex);
            }
        }
        let vertex_id = |k: usize| {
            let point = k as u32;
            vertex_ids[same[k] as usize].ok_or(HullFault::ForeignPoint { point })
        };
        let vertex_ids = (0..own).map(vertex_id).collect::<Result<_, _>>()?;
        let middle = own + left.points.len();
        Ok(PointNumbering {
            child_point_numbers: [&numbers[own..middle], &numbers[middle..]].map(<[u32]>::to_vec),
            positions,
            vertex_ids,
        })
    }
}

/// Returns, for each point of three concatenated lists, the index of the equal point that represents it. This is the
/// last equal one among the first `own` points, or otherwise the first equal one.
fn representative_indices(lists: [&[DVec3]; 3], own: usize) -> Vec<u32> {
    let places = lists.into_iter().flatten().copied().map(position_bits);
    let mut sorted: Vec<([u64; 3], u32)> = places.zip(0..).collect();
    sorted.sort_unstable();
    let mut same = vec![0; sorted.len()];
    for group in sorted.chunk_by(|one, other| one.0 == other.0) {
        let last_own = group.iter().rev().find(|(_, k)| (*k as usize) < own);
        let first = last_own.unwrap_or(&group[0]).1;
        for &(_, k) in group {
            same[k as usize] = first;
        }
    }
    same
}

#[cfg(test)]
mod tests;
