//! Splits a closed mesh into shells, its smallest closed parts.

use crate::disjoint_sets::DisjointSets;
use crate::exact::predicates::{Projection, first_underflow_prone_point_index, side_of_plane};
use crate::half_edges::{EdgeUse, SortedHalfEdges};
use crate::mesh::TriangleMesh;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Returns for each face the number of the closed part that the face belongs to.
///
/// Parts are connected over edges of two faces. At an edge of more faces, open parts are connected across the material
/// between them, so that solids that share a face stay separate.
pub(super) fn closed_part_numbers(mesh: &TriangleMesh, edges: &SortedHalfEdges) -> Vec<u32> {
    let mut parts = DisjointSets::new(mesh.faces().len());
    let mut is_manifold = true;
    for (_, uses) in edges.iter() {
        match *uses {
            [one, other] => {
                parts.join(one.face(), other.face());
            }
            _ => is_manifold = false,
        }
    }
    if !is_manifold {
        for (ends, uses) in edges.iter().filter(|(_, uses)| uses.len() > 2) {
            let open = half_edges_of_open_parts(uses, &mut parts);
            for (one, other) in face_pairs_of_wedges(mesh, ends, &open) {
                parts.join(one, other);
            }
        }
    }
    parts.set_index_by_element()
}

/// Returns the half-edges at one edge that belong to open parts. A part is open there if it has more half-edges at the
/// edge in one direction than in the other.
fn half_edges_of_open_parts(edge: &[EdgeUse], parts: &mut DisjointSets) -> Vec<EdgeUse> {
    let mut of_parts: Vec<(u32, EdgeUse)> =
        edge.iter().map(|&u| (parts.root(u.face()), u)).collect();
    of_parts.sort_by_key(|of| of.0);
    of_parts
        .chunk_by(|one, next| one.0 == next.0)
        .filter(|part| part.iter().map(|of| of.1.direction_sign()).sum::<i32>() != 0)
        .flatten()
        .map(|of| of.1)
        .collect()
}

/// Returns the pairs of faces at an edge that bound the same wedge of material. If the faces cannot be ordered, all
/// are paired.
fn face_pairs_of_wedges(mesh: &TriangleMesh, ends: [u32; 2], edge: &[EdgeUse]) -> Vec<(u32, u32)> {
    let Some(mut order) = in_angular_order(mesh, ends, edge) else {
        let pairs = edge.windows(2);
        return pairs.map(|pair| (pair[0].face(), pair[1].face())).collect();
    };
    let (mut begun, mut pairs) = (Vec::new(), Vec::new());
    // A wedge that begins before the first face ends in the second round; paired faces are removed.
    for _ in 0..2 {
        order.retain(|one| match one.direction_sign() {
            1 => match begun.pop() {
                Some(other) => {
                    pairs.push((one.face(), other));
                    false
                }
                None => true,
            },
            _ => {
                begun.push(one.face());
                false
            }
        });
    }
    pairs
}

/// Returns the half-edges on an edge in the order of their faces by angle, counter-clockwise from the first face, with the
/// edge pointing at the viewer. Among faces at one angle, those that end a wedge come first. Returns `None` if a face is
/// degenerate or a coordinate is too near to 0 for exact predicates.
fn in_angular_order(mesh: &TriangleMesh, ends: [u32; 2], edge: &[EdgeUse]) -> Option<Vec<EdgeUse>> {
    let [v, w] = ends.map(|v| mesh.vertices()[v as usize]);
    let apexes: Vec<DVec3> = edge
        .iter()
        .map(|&one| corner_opposite_edge(mesh, ends, one))
        .collect();
    let first = *apexes.first()?;
    let is_too_fine = first_underflow_prone_point_index(&[v, w])
        .or(first_underflow_prone_point_index(&apexes))
        .is_some();
    let flat = |&p: &DVec3| Projection::new([v, w, p]).is_none();
    if is_too_fine || apexes.iter().any(flat) {
        return None;
    }
    let projection = Projection::new([v, w, first])?;
    // 0 for no angle from the first face, 1 below half a turn, 2 for half a turn, 3 above.
    let angle_class = |p: DVec3| match side_of_plane([v, w, first], p) {
        Ordering::Equal if projection.turn(v, w, p) == Ordering::Greater => 0,
        Ordering::Greater => 1,
        Ordering::Equal => 2,
        Ordering::Less => 3,
    };
    let mut order: Vec<(EdgeUse, DVec3)> = edge.iter().copied().zip(apexes).collect();
    order.sort_by(|&(one, p), &(other, q)| {
        let by_class = angle_class(p).cmp(&angle_class(q));
        let by_angle = by_class.then_with(|| side_of_plane([v, w, q], p));
        by_angle.then(other.direction_sign().cmp(&one.direction_sign()))
    });
    Some(order.into_iter().map(|(one, _)| one).collect())
}

/// Returns the corner of a face that is opposite to the edge with the given ends.
fn corner_opposite_edge(mesh: &TriangleMesh, ends: [u32; 2], of: EdgeUse) -> DVec3 {
    let face = of.face();
    let mut at = mesh.welded_face(face).into_iter().zip(mesh.triangle(face));
    let off = at.find(|(v, _)| !ends.contains(v));
    // A face with two corners at one point has no other corner.
    off.map_or(mesh.vertices()[ends[0] as usize], |(_, p)| p)
}
