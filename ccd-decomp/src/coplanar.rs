//! Triangles of a mesh that lie in one plane, merged into convex polygons.

use crate::manifold::{Bend, HalfEdge, Manifold};
use crate::polygons::strict_corners;
use crate::predicates::Projection;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// The faces of a mesh, in groups that each are a convex polygon.
pub(crate) struct Flats {
    flats: Vec<Flat>,
    /// By face.
    flat_of: Vec<u32>,
}

/// A convex polygon of a mesh's surface: faces in exactly one plane, without a hole between them.
#[derive(Clone, Debug)]
pub(crate) struct Flat {
    /// Its faces, in ascending order.
    pub(crate) faces: Vec<u32>,
    /// The half-edges around it, counter-clockwise.
    pub(crate) rim: Vec<HalfEdge>,
    /// Where the rim turns: the polygon's corners.
    pub(crate) corners: Vec<u32>,
}

impl Flats {
    /// Merges neighbours as long as their union is convex, those with the longest common edge first:
    /// a diagonal that may be left out goes before an edge of the outline `[HM83]`.
    pub(crate) fn new(manifold: &Manifold<'_>) -> Self {
        let mut merger = Merger::new(manifold);
        let mut edges = merger.flat_edges();
        loop {
            let before = edges.len();
            edges.retain(|&edge| !merger.merge_over(edge));
            if edges.len() == before {
                break;
            }
        }
        merger.finish()
    }

    pub(crate) fn len(&self) -> usize {
        self.flats.len()
    }

    pub(crate) fn get(&self, flat: u32) -> &Flat {
        &self.flats[flat as usize]
    }

    /// The polygon that a face is part of.
    #[inline]
    pub(crate) fn of_face(&self, face: u32) -> u32 {
        self.flat_of[face as usize]
    }
}

struct Merger<'a, 'm> {
    manifold: &'a Manifold<'m>,
    /// By number; none once merged into another.
    regions: Vec<Option<Region>>,
    region_of: Vec<u32>,
}

struct Region {
    faces: Vec<u32>,
    rim: Vec<HalfEdge>,
    plane: Projection,
}

impl<'a, 'm> Merger<'a, 'm> {
    fn new(manifold: &'a Manifold<'m>) -> Self {
        let count = manifold.faces().len() as u32;
        let region = |face: u32| {
            Some(Region {
                faces: vec![face],
                rim: vec![3 * face, 3 * face + 1, 3 * face + 2],
                plane: Projection::of(manifold.triangle(face))?,
            })
        };
        Merger {
            manifold,
            regions: (0..count).map(region).collect(),
            region_of: (0..count).collect(),
        }
    }

    /// One half-edge of every edge within a plane, the longest first.
    fn flat_edges(&self) -> Vec<HalfEdge> {
        let manifold = self.manifold;
        let mut edges: Vec<(f64, HalfEdge)> = (0..3 * manifold.faces().len() as u32)
            .filter(|&h| h < manifold.twin(h) && manifold.bend(h) == Bend::Flat)
            .map(|h| {
                let [a, b] = manifold.ends(h).map(|v| manifold.point(v));
                (a.distance(b), h)
            })
            .collect();
        edges.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        edges.into_iter().map(|(_, h)| h).collect()
    }

    /// Merges the regions on either side of an edge if the union is convex. Whether the edge is dealt
    /// with: its sides are one region now.
    fn merge_over(&mut self, edge: HalfEdge) -> bool {
        let [one, other] = [edge, self.manifold.twin(edge)].map(|h| self.region_of[h as usize / 3]);
        if one == other {
            return true;
        }
        let Some(rim) = self.union(one, other) else {
            return false;
        };
        let [small, large] = match self.size(one) < self.size(other) {
            true => [one, other],
            false => [other, one],
        };
        let Some(merged) = self.regions[small as usize].take() else {
            return false;
        };
        for &face in &merged.faces {
            self.region_of[face as usize] = large;
        }
        if let Some(region) = &mut self.regions[large as usize] {
            region.faces.extend(merged.faces);
            region.rim = rim;
        }
        true
    }

    fn size(&self, region: u32) -> usize {
        let region = self.regions[region as usize].as_ref();
        region.map_or(0, |r| r.faces.len())
    }

    /// The rim of the union of two regions in one plane, if it is a convex polygon.
    fn union(&self, one: u32, other: u32) -> Option<Vec<HalfEdge>> {
        let (first, second) = (
            self.regions[one as usize].as_ref()?,
            self.regions[other as usize].as_ref()?,
        );
        let mut rim = self.open_rim(first, other)?;
        let joint = rim.len();
        rim.extend(self.open_rim(second, one)?);
        let at = |v: u32| self.manifold.point(v);
        let convex = |k: usize| {
            let before = rim[(k + rim.len() - 1) % rim.len()];
            let ([a, b], [_, c]) = (self.manifold.ends(before), self.manifold.ends(rim[k]));
            first.plane.turn(at(a), at(b), at(c)) != Ordering::Less
        };
        (convex(0) && convex(joint)).then_some(rim)
    }

    /// The part of a region's rim that is not shared with another region, if it is in one piece.
    fn open_rim(&self, region: &Region, other: u32) -> Option<Vec<HalfEdge>> {
        let rim = &region.rim;
        let shared = |h: HalfEdge| self.region_of[self.manifold.twin(h) as usize / 3] == other;
        let start = (0..rim.len()).find(|&k| {
            let before = rim[(k + rim.len() - 1) % rim.len()];
            shared(before) && !shared(rim[k])
        })?;
        let around = (0..rim.len()).map(|k| rim[(start + k) % rim.len()]);
        let open: Vec<HalfEdge> = around.clone().take_while(|&h| !shared(h)).collect();
        let rest = around.skip(open.len());
        rest.clone().all(shared).then_some(open)
    }

    fn finish(self) -> Flats {
        let points: Vec<DVec3> = self.manifold.mesh().vertices().to_vec();
        let mut flat_of = vec![0; self.region_of.len()];
        let mut flats = Vec::new();
        for mut region in self.regions.into_iter().flatten() {
            region.faces.sort_unstable();
            for &face in &region.faces {
                flat_of[face as usize] = flats.len() as u32;
            }
            let starts: Vec<u32> = region
                .rim
                .iter()
                .map(|&h| self.manifold.ends(h)[0])
                .collect();
            flats.push(Flat {
                corners: strict_corners(&points, &starts, region.plane),
                faces: region.faces,
                rim: region.rim,
            });
        }
        Flats { flats, flat_of }
    }
}

#[cfg(test)]
mod tests;
