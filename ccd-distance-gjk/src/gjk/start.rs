//! Chooses the simplex from which a search starts: the result of the last search on the pair, or a support vertex.

use super::minkowski::MinkowskiDifference;
use super::search::SearchResult;
use super::simplex::Simplex;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;

/// The result of a search, from which the next search on the same pair starts.
///
/// Its vertices are recomputed from the pieces' current positions. The end of another pair's
/// search, or an index out of range, costs steps, not accuracy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cache {
    axis: DVec3,
    pairs: [[u32; 2]; 4],
    len: u8,
}

impl Cache {
    /// Creates a cache from the result of a search.
    pub(crate) fn from_search_result(found: &SearchResult) -> Self {
        let mut cache = Cache {
            axis: found.axis,
            ..Cache::default()
        };
        for (vertex, pair) in found.simplex.vertices().iter().zip(&mut cache.pairs) {
            *pair = [vertex.a, vertex.b];
            cache.len += 1;
        }
        cache
    }

    /// Returns the simplex to start from, which is never empty.
    pub(crate) fn simplex(&self, difference: &MinkowskiDifference<'_>) -> Simplex {
        let mut simplex = Simplex::EMPTY;
        for &[a, b] in self.pairs.iter().take(usize::from(self.len)) {
            if let Some(vertex) = difference.vertex(a, b) {
                simplex.push(vertex);
            }
        }
        if simplex.vertices().is_empty() {
            let axis = unit(self.axis);
            let direction = axis.unwrap_or(difference.between);
            simplex.push(difference.lowest_vertex(direction));
        }
        simplex
    }
}
