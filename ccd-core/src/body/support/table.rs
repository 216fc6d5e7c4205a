//! Finds extremal corners of a polytope by climbing along its edges, from a start that a table of directions gives.

use super::directions::{self, TABLE_DIRECTION_COUNT};
use super::tree::bounding_ball;
use crate::body::adjacency::AdjacencyLists;
use crate::body::facets::{Facets, edges_of};
use crate::math::order::greater;
use crate::rounding::HEIGHT_ERROR_F64;
use crate::tuning::MAX_PLATEAU_POINTS;
use glam::DVec3;

/// A search for extremal corners of a convex polytope: the corners, their edges, and the extremal corners along 114
/// directions.
///
/// # Memory
/// About 70 bytes for each corner, and half a kilobyte.
#[derive(Clone, Debug)]
pub struct SupportTable {
    points: Vec<DVec3>,
    /// The largest absolute value of the corners' coordinates.
    max_abs_coordinate: f64,
    /// The center and radius of a ball around the points.
    pub(super) bounding_ball: (DVec3, f64),
    neighbours: AdjacencyLists<u32>,
    start_corners: [u32; TABLE_DIRECTION_COUNT],
}

impl SupportTable {
    /// Builds the table for points and the facets of their hull; `None` if no facets are known.
    pub fn new(points: &[DVec3], facets: Facets<'_>) -> Option<Self> {
        let first = *facets.iter().next()?.first()?;
        let edges = facets.iter().flat_map(edges_of);
        // Each of the two facets that meet in an edge contains one of its directions. Both directions are added, so
        // that neither is lost if the facets are wrong.
        let mut edges: Vec<(u32, u32)> = edges.flat_map(|(v, w)| [(v, w), (w, v)]).collect();
        edges.sort_unstable();
        edges.dedup();
        let reach = |p: &DVec3| p.abs().max_element();
        let mut table = SupportTable {
            points: points.to_vec(),
            max_abs_coordinate: points.iter().map(reach).fold(0.0, greater),
            bounding_ball: bounding_ball(points),
            neighbours: AdjacencyLists::new(points.len(), edges.into_iter()),
            start_corners: [first; TABLE_DIRECTION_COUNT],
        };
        let mut at = first;
        for (number, direction) in directions::table_directions().enumerate() {
            at = table.hill_climb(at, direction);
            table.start_corners[number] = at;
        }
        Some(table)
    }

    /// Returns the index of a point that is farthest along a direction.
    ///
    /// # Guarantee
    /// The guarantee of [`SupportMap::extremal_point`](crate::SupportMap::extremal_point), provided that the facets are those of
    /// the hull.
    #[inline]
    pub fn extremal_point(&self, direction: DVec3) -> u32 {
        self.hill_climb(
            self.start_corners[directions::nearest_direction_index(direction)],
            direction,
        )
    }

    /// Like `SupportTable::extremal_point`, but starts at a given corner, such as the last answer. If that corner is on no
    /// facet, the start is taken from the table.
    #[inline]
    pub fn extremal_point_from(&self, start: u32, direction: DVec3) -> u32 {
        match self.neighbours(start) {
            [] => self.extremal_point(direction),
            _ => self.hill_climb(start, direction),
        }
    }

    /// Returns the corners that share an edge with a corner; empty for a point on no facet.
    #[inline]
    pub fn neighbours(&self, corner: u32) -> &[u32] {
        self.neighbours.list(corner as usize)
    }

    /// Moves to the highest neighbour until no neighbour is higher.
    ///
    /// In exact arithmetic, edges lead upward from every corner to the highest one: a corner without a higher
    /// neighbour is the highest. Heights are rounded: on such a path a corner may seem lower than an earlier one, by
    /// at most twice the rounding. The search therefore visits all corners connected by corners no lower than that.
    /// One of them is the highest, or higher than the current one.
    fn hill_climb(&self, start: u32, direction: DVec3) -> u32 {
        let slack =
            2.0 * HEIGHT_ERROR_F64 * self.max_abs_coordinate * direction.abs().element_sum();
        let (mut at, mut height) = (start, self.height(start, direction));
        // Each round ends higher than the last one.
        for _ in 0..self.points.len() {
            let (mut next, mut highest) = (at, f64::NEG_INFINITY);
            for &neighbour in self.neighbours(at) {
                let here = self.height(neighbour, direction);
                if here > highest {
                    (next, highest) = (neighbour, here);
                }
            }
            if !(highest > height) {
                if !(highest >= height - slack) {
                    return at;
                }
                match self.find_higher_across_plateau(at, height, slack, direction) {
                    Some(higher) => (next, highest) = higher,
                    None => return at,
                }
            }
            (at, height) = (next, highest);
        }
        at
    }

    /// Returns a corner higher than `at` that can be reached across corners as high as `at` up to rounding; `None` if
    /// there is no higher one.
    fn find_higher_across_plateau(
        &self,
        at: u32,
        height: f64,
        slack: f64,
        direction: DVec3,
    ) -> Option<(u32, f64)> {
        let mut level = [at; MAX_PLATEAU_POINTS];
        let (mut next, mut count) = (0, 1);
        while next < count {
            let from = level[next];
            next += 1;
            for &neighbour in self.neighbours(from) {
                let here = self.height(neighbour, direction);
                if here > height {
                    return Some((neighbour, here));
                }
                if !(here >= height - slack) || level[..count].contains(&neighbour) {
                    continue;
                }
                let Some(place) = level.get_mut(count) else {
                    return self
                        .highest_corner(direction)
                        .filter(|&(_, here)| here > height);
                };
                *place = neighbour;
                count += 1;
            }
        }
        None
    }

    fn highest_corner(&self, direction: DVec3) -> Option<(u32, f64)> {
        let all = (0..).zip(&self.points).map(|(k, p)| (k, direction.dot(*p)));
        all.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    #[inline]
    fn height(&self, corner: u32, direction: DVec3) -> f64 {
        direction.dot(self.points[corner as usize])
    }
}
