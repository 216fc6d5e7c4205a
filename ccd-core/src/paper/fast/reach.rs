//! Caches the distances of nodes from their body's axis of rotation for one query.

use crate::engine::pieces::placed_pair::PlacedPair;
use crate::problem::Problem;

#[derive(Debug, Default)]
pub(super) struct AxisDistanceCache {
    query_number: u64,
    /// The cached distances by body and node, each with the number of its query.
    cached_distances: [Vec<(u64, f64)>; 2],
}

impl AxisDistanceCache {
    /// Invalidates all cached distances.
    pub(super) fn invalidate(&mut self) {
        self.query_number += 1;
    }

    /// Returns for both nodes of a pair the largest distance of their points from the axis of rotation; `placed` has
    /// their hulls.
    pub(super) fn max_axis_distances(
        &mut self,
        problem: &Problem<'_>,
        pair: [u32; 2],
        placed: &PlacedPair<'_>,
    ) -> [f64; 2] {
        let paths = [&problem.a.path, &problem.b.path];
        let points = [placed.pieces.a.points, placed.pieces.b.points];
        [0, 1].map(|k| {
            let (known, at) = (&mut self.cached_distances[k], pair[k] as usize);
            if known.len() <= at {
                known.resize(at + 1, (0, 0.0));
            }
            let (query, reach) = &mut known[at];
            if *query != self.query_number {
                (*query, *reach) = (
                    self.query_number,
                    paths[k].max_distance_from_axis(points[k]),
                );
            }
            *reach
        })
    }
}
