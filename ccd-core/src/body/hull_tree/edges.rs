//! The edges of polygons, and maps keyed by edges without hashing.

use super::error::HullFault;
use super::hull::Hull;
use std::collections::HashSet;

/// Returns the directed edges of a loop of corners.
pub(super) fn edges_of(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> + Clone {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

/// Checks that the facets are polygons that close a surface. The check takes O(n log n).
pub(super) fn check_facets(hull: &Hull) -> Result<(), HullFault> {
    if is_closed(hull) {
        Ok(())
    } else {
        find_fault(hull)
    }
}

/// Returns whether every edge of the facets occurs exactly once in each direction.
fn is_closed(hull: &Hull) -> bool {
    let exists = |&v: &u32| (v as usize) < hull.points.len();
    let mut edges: Vec<u64> = Vec::with_capacity(hull.facets.corners().len());
    for corners in hull.facets.iter() {
        if corners.len() < 3 || !corners.iter().all(exists) {
            return false;
        }
        edges.extend(edges_of(corners).map(|(from, to)| {
            let (low, high) = (from.min(to), from.max(to));
            // The lowest bit is the direction, since the highest corner leaves no other bit.
            u64::from(low) << 33 | u64::from(high) << 1 | u64::from(from > to)
        }));
    }
    edges.sort_unstable();
    let pairs = edges.chunks(2);
    let is_pair = |pair: &[u64]| matches!(*pair, [one, other] if one & 1 == 0 && other == one + 1);
    let once = edges.windows(2).all(|edges| edges[0] != edges[1]);
    let proper = |edge: &u64| edge >> 33 != edge << 31 >> 32;
    hull.points.len() <= 1 << 31
        && once
        && pairs.into_iter().all(is_pair)
        && edges.iter().all(proper)
}

/// Finds the first fault of facets that do not close a surface.
fn find_fault(hull: &Hull) -> Result<(), HullFault> {
    let exists = |&v: &u32| (v as usize) < hull.points.len();
    let mut edges = HashSet::new();
    for (facet, corners) in (0..).zip(hull.facets.iter()) {
        if corners.len() < 3 || !corners.iter().all(exists) {
            return Err(HullFault::BadFacet { facet });
        }
        for (from, to) in edges_of(corners) {
            if from == to || !edges.insert((from, to)) {
                return Err(HullFault::OpenSurface { facet });
            }
        }
    }
    for (facet, corners) in (0..).zip(hull.facets.iter()) {
        if edges_of(corners).any(|(from, to)| !edges.contains(&(to, from))) {
            return Err(HullFault::OpenSurface { facet });
        }
    }
    Ok(())
}

/// A map from directed edges to values, for points numbered from 0.
pub(super) struct EdgeMap {
    /// The start of each point's edges in `edges`; the last entry is the end.
    starts: Vec<u32>,
    /// The end point and the value of each edge; sorted by end point if the start has many edges.
    edges: Vec<(u32, u32)>,
}

/// The number of edges from one point above which they are sorted.
const SORT_THRESHOLD: usize = 8;

impl EdgeMap {
    /// Creates the map in O(n log n). Of repeated edges the last one counts.
    pub(super) fn new(
        points: usize,
        edges: impl Iterator<Item = ((u32, u32), u32)> + Clone,
    ) -> Self {
        let mut starts = vec![0; points + 1];
        for ((from, _), _) in edges.clone() {
            starts[from as usize + 1] += 1;
        }
        for k in 0..points {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut sorted = vec![(0, 0); starts[points] as usize];
        for ((from, to), what) in edges {
            let at = &mut next[from as usize];
            sorted[*at as usize] = (to, what);
            *at += 1;
        }
        for range in starts.windows(2) {
            let from = &mut sorted[range[0] as usize..range[1] as usize];
            if from.len() > SORT_THRESHOLD {
                from.sort_by_key(|edge| edge.0);
            }
        }
        let edges = sorted;
        EdgeMap { starts, edges }
    }

    /// Returns the value of an edge.
    pub(super) fn get(&self, (from, to): (u32, u32)) -> Option<u32> {
        let [start, end] = [from, from + 1].map(|k| self.starts[k as usize] as usize);
        let from = &self.edges[start..end];
        let up_to = if from.len() > SORT_THRESHOLD {
            from.partition_point(|edge| edge.0 <= to)
        } else {
            from.len()
        };
        let mut found = from[..up_to].iter().rev();
        if from.len() > SORT_THRESHOLD {
            found.next().filter(|edge| edge.0 == to)
        } else {
            found.find(|edge| edge.0 == to)
        }
        .map(|edge| edge.1)
    }
}

#[cfg(test)]
mod tests;
