//! Randomized incremental convex hulls of many points, with a conflict graph that records which facets a point is in
//! front of `[CS89]`. Such a point *sees* the facet.

use super::local_points::{LocalPoints, Plane};
use ccd_core::glam::DVec3;

/// Computes the hull's triangles for points that are not coplanar, starting from the tetrahedron `simplex` of four of
/// the points.
///
/// Points are inserted in rounds of about half of the remaining points, chosen pseudorandomly. The expected work is O(n
/// log n) for any points, and the memory O(n). Within a round they keep the given order, which is likely coherent
/// `[ACR03]`.
pub(super) fn hull_facets(points: &[DVec3], simplex: [u32; 4]) -> Vec<[u32; 3]> {
    let hull = HullBuilder::hull_of_points(points, simplex);
    let left = hull.facets.into_iter().filter(|facet| facet.is_hull_facet);
    left.map(|facet| facet.corners).collect()
}

/// Hashes an index to a pseudorandom number, by the finalizer of MurmurHash3.
fn hash_index(v: u32) -> u32 {
    let mut h = v.wrapping_add(0x9e37_79b9);
    h = (h ^ h >> 16).wrapping_mul(0x85eb_ca6b);
    h = (h ^ h >> 13).wrapping_mul(0xc2b2_ae35);
    h ^ h >> 16
}

/// The largest capacity of a point list that is kept for reuse.
const MAX_REUSED_CAPACITY: usize = 64;

/// The index that stands for no facet and no point.
const NONE: u32 = u32::MAX;

struct Facet {
    corners: [u32; 3],
    plane: Plane,
    /// The indices of the adjacent facets. The first is across the edge from the first corner to the second.
    adjacent_facets: [u32; 3],
    /// The points that see the facet and are not inserted into the hull yet.
    conflict_points: Vec<u32>,
    is_hull_facet: bool,
    /// The last point that was tested against the facet, and whether this point sees the facet.
    last_test: (u32, bool),
}

struct HullBuilder<'a> {
    input_points: LocalPoints<'a>,
    /// Empty point lists for reuse.
    spare_lists: Vec<Vec<u32>>,
    facets: Vec<Facet>,
    /// For each point, one facet that the point sees. It is a removed facet or [`NONE`] if the point is inside the
    /// hull.
    visible_facet_by_point: Vec<u32>,
    /// For each point, the last facet that the point was tested against.
    last_facet_by_point: Vec<u32>,
    /// For each point, the new facet at the horizon edge that starts at the point.
    horizon_facet_by_start: Vec<u32>,
}

/// An edge between a facet that the inserted point sees and a facet that it does not see.
struct HorizonEdge {
    ends: [u32; 2],
    facet_hidden_from_point: u32,
    seen_facet: u32,
}

impl<'a> HullBuilder<'a> {
    fn hull_of_points(points: &'a [DVec3], simplex: [u32; 4]) -> Self {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        order.sort_unstable_by_key(|&v| (hash_index(v).leading_zeros(), v));
        order.reverse();
        let mut hull = HullBuilder::new(points, simplex, &order);
        for v in order {
            hull.insert_point(v);
        }
        hull
    }

    fn new(points: &'a [DVec3], [a, b, c, d]: [u32; 4], order: &[u32]) -> Self {
        let mut hull = HullBuilder {
            input_points: LocalPoints::new(points),
            spare_lists: Vec::new(),
            facets: Vec::with_capacity(4 * points.len()),
            visible_facet_by_point: vec![NONE; points.len()],
            last_facet_by_point: vec![NONE; points.len()],
            horizon_facet_by_start: vec![NONE; points.len()],
        };
        hull.add_facet([a, b, c], [1, 2, 3], order);
        hull.add_facet([b, a, d], [0, 3, 2], order);
        hull.add_facet([c, b, d], [0, 1, 3], order);
        hull.add_facet([a, c, d], [0, 2, 1], order);
        hull
    }

    /// Adds a facet to the hull, and records which of the candidate points see it.
    fn add_facet(&mut self, corners: [u32; 3], adjacent: [u32; 3], candidates: &[u32]) {
        let number = self.facets.len() as u32;
        let plane = self.input_points.plane(corners);
        let mut seen_by = self.spare_lists.pop().unwrap_or_default();
        for &v in candidates {
            let is_new =
                std::mem::replace(&mut self.last_facet_by_point[v as usize], number) != number;
            if is_new && self.input_points.is_in_front(&plane, corners, v) {
                self.visible_facet_by_point[v as usize] = number;
                seen_by.push(v);
            }
        }
        // Most facets are seen by no remaining point.
        if seen_by.is_empty() {
            self.spare_lists.push(std::mem::take(&mut seen_by));
        }
        self.facets.push(Facet {
            corners,
            plane,
            adjacent_facets: adjacent,
            conflict_points: seen_by,
            is_hull_facet: true,
            last_test: (NONE, false),
        });
    }

    fn insert_point(&mut self, v: u32) {
        let first = self.visible_facet_by_point[v as usize];
        // A point that sees a new facet also saw one of the two facets at its rim edge, so that no conflict is lost.
        if first == NONE || !self.facets[first as usize].is_hull_facet {
            return;
        }
        let (removed, rim) = self.remove_visible_facets(first, v);
        let base = self.facets.len() as u32;
        for (k, edge) in (base..).zip(&rim) {
            self.horizon_facet_by_start[edge.ends[0] as usize] = k;
        }
        let mut candidates = Vec::new();
        for (k, edge) in (base..).zip(&rim) {
            let [a, b] = edge.ends;
            candidates.clear();
            for facet in [edge.seen_facet, edge.facet_hidden_from_point] {
                candidates.extend_from_slice(&self.facets[facet as usize].conflict_points);
            }
            // The previous facet is set once all are added.
            let adjacent = [
                edge.facet_hidden_from_point,
                self.horizon_facet_by_start[b as usize],
                NONE,
            ];
            self.add_facet([a, b, v], adjacent, &candidates);
            let beyond = &mut self.facets[edge.facet_hidden_from_point as usize];
            if let Some(place) = (0..3).find(|&l| beyond.corners[l] == b) {
                beyond.adjacent_facets[place] = k;
            }
        }
        for k in base..self.facets.len() as u32 {
            let after = self.facets[k as usize].adjacent_facets[1];
            self.facets[after as usize].adjacent_facets[2] = k;
        }
        for facet in removed {
            let mut seen_by = std::mem::take(&mut self.facets[facet as usize].conflict_points);
            if seen_by.capacity() <= MAX_REUSED_CAPACITY {
                seen_by.clear();
                self.spare_lists.push(seen_by);
            }
        }
    }

    /// Removes all facets that the point `v` sees, and returns them with the edges around the removed region. The
    /// search starts at the facet `first`, and crosses edges to adjacent facets that the point sees too.
    fn remove_visible_facets(&mut self, first: u32, v: u32) -> (Vec<u32>, Vec<HorizonEdge>) {
        let (mut rim, mut removed) = (Vec::new(), vec![first]);
        self.facets[first as usize].is_hull_facet = false;
        let mut at = 0;
        // Every facet is removed once.
        while let Some(&seen) = removed.get(at) {
            at += 1;
            let corners = self.facets[seen as usize].corners;
            for k in 0..3 {
                let beyond = self.facets[seen as usize].adjacent_facets[k];
                if !self.facets[beyond as usize].is_hull_facet {
                    continue;
                }
                if self.is_visible_from(beyond, v) {
                    self.facets[beyond as usize].is_hull_facet = false;
                    removed.push(beyond);
                } else {
                    let ends = [corners[k], corners[(k + 1) % 3]];
                    rim.push(HorizonEdge {
                        ends,
                        facet_hidden_from_point: beyond,
                        seen_facet: seen,
                    });
                }
            }
        }
        (removed, rim)
    }

    fn is_visible_from(&mut self, facet: u32, v: u32) -> bool {
        let Facet {
            corners,
            plane,
            last_test,
            ..
        } = &mut self.facets[facet as usize];
        if last_test.0 != v {
            *last_test = (v, self.input_points.is_in_front(plane, *corners, v));
        }
        last_test.1
    }
}

#[cfg(test)]
mod tests;
