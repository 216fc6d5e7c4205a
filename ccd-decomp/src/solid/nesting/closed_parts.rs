//! The shells of a closed mesh: its smallest closed parts.

use crate::disjoint_sets::DisjointSets;
use crate::exact::predicates::{Projection, side, too_fine};
use crate::half_edges::{self, Edges};
use crate::mesh::TriangleMesh;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Returns the part of each face.
///
/// Parts are connected over edges of two faces. At an edge of more faces, open parts are connected across the material
/// between them, so that solids that share a face stay separate.
pub(super) fn closed_parts(mesh: &TriangleMesh, edges: &Edges) -> Vec<u32> {
    let mut parts = DisjointSets::new(mesh.faces().len());
    let mut is_manifold = true;
    for (_, uses) in edges.iter() {
        match *uses {
            [one, other] => parts.join(one.half_edge() / 3, other.half_edge() / 3),
            _ => is_manifold = false,
        }
    }
    if !is_manifold {
        for (ends, uses) in edges.iter().filter(|(_, uses)| uses.len() > 2) {
            let edge: Vec<Use> = uses.iter().map(|&of| Use::new(ends, of)).collect();
            let open = open_at(&edge, &mut parts);
            for (one, other) in across_material(mesh, &open) {
                parts.join(one, other);
            }
        }
    }
    parts.numbers()
}

/// The use of an edge by a face.
#[derive(Clone, Copy, Debug)]
struct Use {
    /// The welded end vertices, the smaller first.
    ends: [u32; 2],
    face: u32,
    /// 1 if the face runs from the first end to the second, else −1.
    direction: i32,
}

impl Use {
    fn new(ends: [u32; 2], of: half_edges::Use) -> Self {
        Use {
            ends,
            face: of.half_edge() / 3,
            direction: if of.is_backward() { -1 } else { 1 },
        }
    }
}

/// Returns the faces at an edge of parts that are open there: with more uses in one direction than in the other.
fn open_at(edge: &[Use], parts: &mut DisjointSets) -> Vec<Use> {
    let mut of_parts: Vec<(u32, Use)> = edge.iter().map(|&u| (parts.root(u.face), u)).collect();
    of_parts.sort_by_key(|of| of.0);
    of_parts
        .chunk_by(|one, next| one.0 == next.0)
        .filter(|part| part.iter().map(|of| of.1.direction).sum::<i32>() != 0)
        .flatten()
        .map(|of| of.1)
        .collect()
}

/// Pairs the faces at an edge that bound the same wedge of material. If the faces cannot be ordered, all are paired.
fn across_material(mesh: &TriangleMesh, edge: &[Use]) -> Vec<(u32, u32)> {
    let Some(around) = AngularOrder::new(mesh, edge) else {
        let pairs = edge.windows(2);
        return pairs.map(|pair| (pair[0].face, pair[1].face)).collect();
    };
    let mut order = edge.to_vec();
    // Among faces at one angle, those that end a wedge come first.
    order.sort_by(|one, other| {
        around
            .order(one, other)
            .then(other.direction.cmp(&one.direction))
    });
    let (mut begun, mut pairs) = (Vec::new(), Vec::new());
    // A wedge that begins before the first face ends in the second round; paired faces are removed.
    for _ in 0..2 {
        order.retain(|one| match one.direction {
            1 => match begun.pop() {
                Some(other) => {
                    pairs.push((one.face, other));
                    false
                }
                None => true,
            },
            _ => {
                begun.push(one.face);
                false
            }
        });
    }
    pairs
}

/// The angular order of faces around an edge, starting at one of them: counter-clockwise, with the edge pointing at the
/// viewer.
struct AngularOrder<'m> {
    mesh: &'m TriangleMesh,
    ends: [DVec3; 2],
    first: DVec3,
    /// The projection of the first face's plane.
    projection: Projection,
}

impl<'m> AngularOrder<'m> {
    /// Starts at the first face. Returns `None` if a face is degenerate or a coordinate is too near to 0 for exact
    /// predicates.
    fn new(mesh: &'m TriangleMesh, edge: &[Use]) -> Option<Self> {
        let [v, w] = edge.first()?.ends.map(|v| mesh.vertices()[v as usize]);
        let apexes: Vec<DVec3> = edge.iter().map(|one| apex(mesh, one)).collect();
        let is_fine = too_fine(&[v, w]).or(too_fine(&apexes)).is_some();
        let flat = |&p: &DVec3| Projection::new([v, w, p]).is_none();
        if is_fine || apexes.iter().any(flat) {
            return None;
        }
        Some(AngularOrder {
            mesh,
            ends: [v, w],
            first: apexes[0],
            projection: Projection::new([v, w, apexes[0]])?,
        })
    }

    fn order(&self, one: &Use, other: &Use) -> Ordering {
        let [v, w] = self.ends;
        let [one, other] = [one, other].map(|of| apex(self.mesh, of));
        let by_turn = || side([v, w, other], one);
        self.quarter(one)
            .cmp(&self.quarter(other))
            .then_with(by_turn)
    }

    /// Returns the angular class of a point: at the first face (0), before half a turn (1), at half a turn (2), or
    /// after (3).
    fn quarter(&self, point: DVec3) -> u32 {
        let [v, w] = self.ends;
        let is_near = || self.projection.turn(v, w, point) == Ordering::Greater;
        match side([v, w, self.first], point) {
            Ordering::Equal if is_near() => 0,
            Ordering::Greater => 1,
            Ordering::Equal => 2,
            Ordering::Less => 3,
        }
    }
}

/// Returns the corner of a face opposite to an edge.
fn apex(mesh: &TriangleMesh, of: &Use) -> DVec3 {
    let mut at = mesh
        .welded_face(of.face)
        .into_iter()
        .zip(mesh.triangle(of.face));
    let off = at.find(|(v, _)| !of.ends.contains(v));
    // A face with two corners at one point has no other corner.
    off.map_or(mesh.vertices()[of.ends[0] as usize], |(_, p)| p)
}
