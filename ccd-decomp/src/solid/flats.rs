//! Merges the coplanar triangles of a mesh into convex polygons.

use super::manifold::{Dihedral, Manifold};
use crate::disjoint_sets::{DisjointSets, members_by_set};
use crate::exact::predicates::Projection;
use crate::half_edges::HalfEdge;
use crate::hull::polygons::strictly_convex_corners;
use crate::tolerance::{BINS_PER_LENGTH_DOUBLING, DIRECTION_BINS_PER_UNIT};
use ccd_core::glam::DVec3;
use ccd_core::vector::{length, unit};
use rayon::prelude::*;
use std::cmp::{Ordering, Reverse};

/// The partition of a mesh's faces into convex polygons.
pub(crate) struct ConvexPolygons {
    polygons: Vec<ConvexPolygon>,
    /// For each face, the number of its polygon.
    polygon_of_face: Vec<u32>,
}

/// A convex polygon of a mesh's surface: exactly coplanar faces without holes.
#[derive(Clone, Debug)]
pub(crate) struct ConvexPolygon {
    /// The faces that make up the polygon, in ascending order.
    pub(crate) faces: Vec<u32>,
    /// The half-edges of the polygon's boundary, counter-clockwise.
    pub(crate) rim: Vec<HalfEdge>,
    /// The boundary vertices at which the boundary is not straight, counter-clockwise.
    pub(crate) corners: Vec<u32>,
}

impl ConvexPolygons {
    /// Merges adjacent coplanar faces to convex polygons, by [`RegionMerger`].
    pub(crate) fn new(manifold: &Manifold<'_>) -> Self {
        RegionMerger::merge_all_regions(manifold).into_polygons()
    }

    pub(crate) fn len(&self) -> usize {
        self.polygons.len()
    }

    pub(crate) fn get(&self, flat: u32) -> &ConvexPolygon {
        &self.polygons[flat as usize]
    }

    /// Returns the number of the polygon that contains a face.
    #[inline]
    pub(crate) fn polygon_of_face(&self, face: u32) -> u32 {
        self.polygon_of_face[face as usize]
    }
}

/// The size of a planar part of the surface: a connected set of coplanar faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct PlanarRegionSize {
    pub(crate) triangle_count: usize,
    /// The number of convex polygons into which the part is merged. It is an upper bound of the part's number of
    /// patches.
    pub(crate) polygon_count: usize,
}

/// Coplanar regions of faces, which are merged as long as their union is convex. Two disjoint convex regions share a
/// single run of edges. Their union is convex if it is convex at both ends of the run.
pub(crate) struct RegionMerger<'a, 'm> {
    manifold: &'a Manifold<'m>,
    /// For each half-edge, the next half-edge on the boundary of its region; `previous_by_half_edge` holds the previous one.
    next_by_half_edge: Vec<HalfEdge>,
    previous_by_half_edge: Vec<HalfEdge>,
    regions: DisjointSets,
    /// The connected coplanar sets of faces, each of one or more polygons.
    coplanar_sets: DisjointSets,
}

impl<'a, 'm> RegionMerger<'a, 'm> {
    /// Merges adjacent regions while their union is convex. The longest common edge comes first, so that a diagonal
    /// is removed before an edge of the outline `[HM83]`.
    ///
    /// The mesh may intersect itself: merged polygons are on opposite sides of the removed line, so that every group
    /// covers a convex polygon once.
    pub(crate) fn merge_all_regions(manifold: &'a Manifold<'m>) -> Self {
        let mut merger = RegionMerger::new(manifold);
        let mut edges = merger.flat_edges();
        for &edge in &edges {
            merger.coplanar_sets.join(edge / 3, manifold.twin(edge) / 3);
        }
        // Each round leaves fewer edges.
        loop {
            let before = edges.len();
            edges.retain(|&edge| !merger.merge_across_edge(edge));
            if edges.len() == before {
                break;
            }
        }
        merger
    }

    /// Returns the size of the planar part with the most triangles.
    pub(crate) fn largest_planar_region_size(&mut self) -> PlanarRegionSize {
        let faces = self.manifold.faces().len();
        let mut planes = vec![PlanarRegionSize::default(); faces];
        for face in 0..faces as u32 {
            let plane = &mut planes[self.coplanar_sets.root(face) as usize];
            plane.triangle_count += 1;
            plane.polygon_count += usize::from(self.regions.root(face) == face);
        }
        planes.into_iter().max().unwrap_or_default()
    }

    fn new(manifold: &'a Manifold<'m>) -> Self {
        let faces = manifold.faces().len() as u32;
        // The half-edges of a face are numbered from a multiple of 3.
        let turn = |step: u32| (0..3 * faces).map(move |h| h - h % 3 + (h + step) % 3);
        RegionMerger {
            manifold,
            next_by_half_edge: turn(1).collect(),
            previous_by_half_edge: turn(2).collect(),
            regions: DisjointSets::new(faces as usize),
            coplanar_sets: DisjointSets::new(faces as usize),
        }
    }

    /// Returns one half-edge of every flat edge, sorted by descending length class, then by direction. Grid cells
    /// thus merge to rows before rows merge to rectangles, for any order of the mesh.
    fn flat_edges(&self) -> Vec<HalfEdge> {
        let manifold = self.manifold;
        let rank = |h: HalfEdge| {
            let [a, b] = manifold.ends(h).map(|v| manifold.point(v));
            let offset = b - a;
            let length = (length(offset).log2() * BINS_PER_LENGTH_DOUBLING).round() as i32;
            let offset = unit(offset).unwrap_or(DVec3::ZERO) * DIRECTION_BINS_PER_UNIT;
            let offset = offset.to_array().map(|x| x.round() as i32);
            (Reverse(length), offset.max(offset.map(|x| -x)), h)
        };
        let mut edges: Vec<HalfEdge> = (0..3 * manifold.faces().len() as u32)
            .into_par_iter()
            .filter(|&h| {
                h < manifold.twin(h) && manifold.classify_dihedral(h) == Dihedral::Coplanar
            })
            .collect();
        edges.sort_by_cached_key(|&h| rank(h));
        edges
    }

    fn region_of_half_edge(&mut self, half_edge: HalfEdge) -> u32 {
        self.regions.root(half_edge / 3)
    }

    /// Merges the regions on both sides of an edge if the union is convex. Returns whether they are now one region.
    fn merge_across_edge(&mut self, edge: HalfEdge) -> bool {
        let [one, other] = [edge, self.manifold.twin(edge)].map(|h| self.region_of_half_edge(h));
        if one == other {
            return true;
        }
        // The common run of edges, seen from the first region. It is never a whole rim: it lies on one line.
        let ends = [
            self.last_half_edge_beside_region(edge, |merger| &merger.previous_by_half_edge, other),
            self.last_half_edge_beside_region(edge, |merger| &merger.next_by_half_edge, other),
        ];
        let [Some(first), Some(last)] = ends else {
            return false;
        };
        let before = |h: HalfEdge| self.previous_by_half_edge[h as usize];
        let after = |h: HalfEdge| self.next_by_half_edge[h as usize];
        let twin = |h: HalfEdge| self.manifold.twin(h);
        let joints = [
            (before(first), after(twin(first))),
            (before(twin(last)), after(last)),
        ];
        let is_proper = |&joint: &_| self.is_straight_or_left_turn(joint);
        if !joints.iter().all(is_proper) {
            return false;
        }
        for (before, after) in joints {
            self.next_by_half_edge[before as usize] = after;
            self.previous_by_half_edge[after as usize] = before;
        }
        self.regions.join(one, other);
        true
    }

    /// Follows the boundary of a region to the last half-edge that borders the region `beyond`. Returns `None` if the
    /// whole boundary borders `beyond`.
    fn last_half_edge_beside_region(
        &mut self,
        edge: HalfEdge,
        onward: impl Fn(&Self) -> &[HalfEdge],
        beyond: u32,
    ) -> Option<HalfEdge> {
        let mut last = edge;
        loop {
            let next = onward(self)[last as usize];
            if next == edge {
                return None;
            }
            if self.region_of_half_edge(self.manifold.twin(next)) != beyond {
                return Some(last);
            }
            last = next;
        }
    }

    /// Returns whether a boundary is straight or turns left from one half-edge to the next.
    fn is_straight_or_left_turn(&self, (before, after): (HalfEdge, HalfEdge)) -> bool {
        let Some(plane) = Projection::new(self.manifold.triangle(before / 3)) else {
            return false;
        };
        let ([a, b], [_, c]) = (self.manifold.ends(before), self.manifold.ends(after));
        let [a, b, c] = [a, b, c].map(|v| self.manifold.point(v));
        plane.turn(a, b, c) != Ordering::Less
    }

    /// Converts the merged regions to convex polygons.
    pub(crate) fn into_polygons(mut self) -> ConvexPolygons {
        let flat_of = self.regions.set_index_by_element();
        let flat = |(number, faces): (usize, Vec<u32>)| {
            let outer =
                |&h: &HalfEdge| flat_of[self.manifold.twin(h) as usize / 3] as usize != number;
            let mut own = faces.iter().flat_map(|&f| 3 * f..3 * f + 3);
            let start = own.find(outer);
            let onward = |&h: &HalfEdge| {
                Some(self.next_by_half_edge[h as usize]).filter(|&h| Some(h) != start)
            };
            // A convex polygon has one rim, on which each half-edge is once.
            let rim = std::iter::successors(start, onward).take(3 * faces.len());
            let rim: Vec<HalfEdge> = rim.collect();
            let starts: Vec<u32> = rim.iter().map(|&h| self.manifold.ends(h)[0]).collect();
            let corners = match Projection::new(self.manifold.triangle(faces[0])) {
                Some(plane) => {
                    strictly_convex_corners(self.manifold.mesh().vertices(), &starts, plane)
                }
                None => starts,
            };
            ConvexPolygon {
                faces,
                rim,
                corners,
            }
        };
        let flats = members_by_set(&flat_of).into_iter().enumerate().map(flat);
        ConvexPolygons {
            polygons: flats.collect(),
            polygon_of_face: flat_of,
        }
    }
}

#[cfg(test)]
mod tests;
