//! Searches for the point of a piece that is farthest along a direction `[FAST06 §4.2]`.

mod directions;
mod scan;
mod table;
mod tree;

pub use directions::TABLE_DIRECTION_COUNT;
pub use scan::SupportScan;
pub use table::SupportTable;
pub use tree::SupportTree;

use super::facets::Facets;
use crate::tuning::MAX_SCANNED_POINTS;
use glam::DVec3;

/// A search structure for extremal points of one piece. If there are few, all are scanned, eight at once. For many
/// corners, a tree over them is searched, or edges are climbed from a start in a table of directions.
///
/// A [`Body`](crate::Body) stores trees for its pieces of many points; trees suit any points. Climbing takes half the
/// time, and relies on the facets.
///
/// ```
/// use ccd_core::{glam::DVec3, Facets, SupportMap};
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let support = SupportMap::new(&corners, Facets::EMPTY);
/// assert_eq!(support.extremal_point(DVec3::new(0.1, 1.0, 5.0)), 2);
/// ```
#[derive(Clone, Debug)]
pub enum SupportMap {
    /// Scans all points: computes the height of every point along the direction.
    Scan(SupportScan),
    /// Climbs along the edges of the hull to higher corners.
    Climb(Box<SupportTable>),
    /// Searches a tree over the points.
    Tree(Box<SupportTree>),
}

impl SupportMap {
    /// Builds the search structure for the points of one piece: a linear scan for few points, climbing along the hull's
    /// edges for many. If there are more than [`MAX_SCANNED_POINTS`] of them, the facets must be those of their hull.
    /// Without facets, every point is scanned.
    pub fn new(points: &[DVec3], facets: Facets<'_>) -> Self {
        let climbed = points.len() > MAX_SCANNED_POINTS;
        match climbed.then(|| SupportTable::new(points, facets)).flatten() {
            Some(table) => SupportMap::Climb(Box::new(table)),
            None => SupportMap::Scan(SupportScan::new(points)),
        }
    }

    /// Builds a tree search for points whose facets are unknown.
    pub(crate) fn from_points(points: &[DVec3]) -> Self {
        SupportMap::Tree(Box::new(SupportTree::new(points)))
    }

    /// Returns the index of a point that is farthest along a direction of any length.
    ///
    /// # Guarantee
    /// No point of the piece is farther by more than the rounding of two heights, each of which is
    /// `HEIGHT_ERROR_F64` of the direction's 1-norm and the largest
    /// coordinate. A direction that is not finite gives some point.
    #[inline]
    pub fn extremal_point(&self, direction: DVec3) -> u32 {
        match self {
            SupportMap::Scan(scan) => scan.extremal_point(direction),
            SupportMap::Climb(table) => table.extremal_point(direction),
            SupportMap::Tree(tree) => tree.extremal_point(direction),
        }
    }

    /// Like [`SupportMap::extremal_point`], but may start at `corner`, a point that is likely to be nearly extremal.
    #[inline]
    pub(crate) fn extremal_point_with_hint(&self, corner: Option<u32>, direction: DVec3) -> u32 {
        match (self, corner) {
            (SupportMap::Climb(table), Some(corner)) => {
                table.extremal_point_from(corner, direction)
            }
            _ => self.extremal_point(direction),
        }
    }

    /// Returns the center and radius of a ball around the points, if one is stored.
    #[inline]
    pub(crate) fn bounding_ball(&self) -> Option<(DVec3, f64)> {
        match self {
            SupportMap::Scan(_) => None,
            SupportMap::Climb(table) => Some(table.bounding_ball),
            SupportMap::Tree(tree) => Some(tree.bounding_ball),
        }
    }
}

#[cfg(test)]
mod tests;
