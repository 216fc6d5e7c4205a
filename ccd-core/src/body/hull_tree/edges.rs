//! Checks the edges of a hull's facets, and maps directed edges to values without hashing.

use super::error::HullFault;
use super::hull::Hull;
use crate::body::adjacency::AdjacencyLists;
use crate::body::facets::edges_of;

/// Checks that the facets of a hull are polygons with valid corners, and that together they close a surface. The check
/// takes O(n log n).
pub(super) fn check_facets(hull: &Hull) -> Result<(), HullFault> {
    let exists = |&v: &u32| (v as usize) < hull.points.len();
    let good = |corners: &[u32]| corners.len() >= 3 && corners.iter().all(exists);
    let bad = hull.facets.iter().position(|corners| !good(corners));
    let facets = (0..).zip(hull.facets.iter().take(bad.unwrap_or(hull.facets.len())));
    let mut edges: Vec<((u32, u32), u32)> = facets
        .flat_map(|(facet, corners)| edges_of(corners).map(move |edge| (edge, facet)))
        .collect();
    edges.sort_unstable();
    let open = |facet: Option<u32>| match facet {
        Some(facet) => Err(HullFault::OpenSurface { facet }),
        None => Ok(()),
    };
    let loops = edges.iter().filter(|((from, to), _)| from == to);
    let repeated = edges.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let improper = loops.chain(repeated.map(|pair| &pair[1]));
    open(improper.map(|&(_, facet)| facet).min())?;
    if let Some(facet) = bad {
        let facet = facet as u32;
        return Err(HullFault::BadFacet { facet });
    }
    let reverse = |(from, to)| edges.binary_search_by_key(&(to, from), |&(edge, _)| edge);
    let unpaired = edges.iter().filter(|&&(edge, _)| reverse(edge).is_err());
    open(unpaired.map(|&(_, facet)| facet).min())
}

/// A map from directed edges to values, for points numbered from 0. For each start point it has the end points and the
/// values of its edges, sorted by end point.
pub(super) struct EdgeMap(AdjacencyLists<(u32, u32)>);

impl EdgeMap {
    /// Creates the map from edges and their values, in O(n log n). Of a repeated edge, the last value counts.
    pub(super) fn new(
        points: usize,
        edges: impl Iterator<Item = ((u32, u32), u32)> + Clone,
    ) -> Self {
        let pairs = edges.map(|((from, to), what)| (from, (to, what)));
        let mut edges = AdjacencyLists::new(points, pairs);
        edges.for_each_list(|from| from.sort_by_key(|edge| edge.0));
        EdgeMap(edges)
    }

    /// Returns the value of a directed edge; `None` if the map does not have the edge.
    pub(super) fn get(&self, (from, to): (u32, u32)) -> Option<u32> {
        let from = self.0.list(from as usize);
        let up_to = from.partition_point(|edge| edge.0 <= to);
        let last = from[..up_to].last()?;
        (last.0 == to).then_some(last.1)
    }
}

#[cfg(test)]
mod tests;
