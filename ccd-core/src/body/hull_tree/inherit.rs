//! Derives the origin, class and mesh faces of each facet of an inner node's hull from the facets of its children's
//! hulls.
//!
//! A child's hull meets the plane of a facet of its parent in at most one facet of the child. A facet of the parent
//! is therefore a facet of a child, or is tiled by one facet of each child, or is a bridge.

use super::edges::EdgeMap;
use super::hull::{FacetClass, Hull};
use super::inside::{is_coplanar_and_cooriented, projectable_corners};
use super::node::{FacetData, Node};
use crate::body::facets::{edges_of, fan_triangles};
use crate::body::polytope::{FacetOrigin, MeshFace, Polytope};
use crate::math::exact::is_degenerate;
use crate::math::point_tree::PointTree;
use glam::DVec3;

impl FacetData {
    const VIRTUAL_FACET_DATA: FacetData = FacetData {
        provenance: FacetOrigin::Virtual,
        class: FacetClass::Bridge,
        faces: Vec::new(),
    };

    /// Returns the origin, class and mesh faces of each facet of a piece.
    pub(super) fn facet_data_of_piece(piece: &Polytope) -> Vec<FacetData> {
        let mut facet_data = Vec::with_capacity(piece.facets.len());
        let starts: Vec<DVec3> = piece.faces.iter().map(|face| face.corners[0]).collect();
        let tree = PointTree::new(&starts);
        for facet in &piece.facets {
            let corners = facet.corners.iter().map(|&v| piece.points[v as usize]);
            let corners: Vec<DVec3> = corners.collect();
            let mut near = Vec::new();
            if let Some((plane, _)) = projectable_corners(&corners) {
                tree.for_each_not_behind(plane, |k| near.push(k));
            }
            near.sort_unstable();
            let near = near.iter().map(|&k| piece.faces[k as usize]);
            let within = |face: &MeshFace| is_coplanar_and_cooriented(&corners, face.corners);
            facet_data.push(FacetData {
                provenance: facet.origin,
                class: match facet.origin {
                    FacetOrigin::Face(_) | FacetOrigin::Faces => FacetClass::OnMesh,
                    FacetOrigin::Virtual => FacetClass::InsideSolid,
                },
                faces: near.filter(within).collect(),
            });
        }
        facet_data
    }

    /// Merges the data of two facets that together tile a facet of the parent's hull.
    fn merge_facet_data(parts: [&ChildFacet<'_>; 2]) -> FacetData {
        let class = parts[0].facet.class.max(parts[1].facet.class);
        FacetData {
            provenance: match class {
                FacetClass::OnMesh => FacetOrigin::Faces,
                FacetClass::InsideSolid | FacetClass::Bridge => FacetOrigin::Virtual,
            },
            class,
            faces: parts.iter().flat_map(|part| part.mesh_faces()).collect(),
        }
    }
}

/// A child of a node, with its points numbered as in [`PointNumbering`](super::identity::PointNumbering).
#[derive(Clone, Copy)]
pub(super) struct NumberedChild<'a> {
    pub(super) node: &'a Node<'a>,
    /// The common number of each of the child's points.
    pub(super) point_numbers: &'a [u32],
}

/// Returns the origin, class and mesh faces of each facet of a hull, taken from the children's facets.
pub(super) fn inherit_facet_data(
    hull: &Hull,
    positions: &[DVec3],
    children: [NumberedChild<'_>; 2],
) -> Vec<FacetData> {
    let triangles = children.map(|child| single_triangle_facet_data(&child));
    let sides =
        [0, 1].map(|k| ChildFacets::new(children[k], triangles[k].as_ref(), positions.len()));
    let facet = |corners: &[u32]| {
        let parts = sides
            .each_ref()
            .map(|side| side.facet_sharing_edge(corners));
        match parts {
            [Some(part), _] | [_, Some(part)] if is_same_loop(&part, corners) => part.facet.clone(),
            [Some(one), Some(other)] if tiles_facet(positions, corners, [&one, &other]) => {
                FacetData::merge_facet_data([&one, &other])
            }
            _ => FacetData::VIRTUAL_FACET_DATA,
        }
    };
    hull.facets.iter().map(facet).collect()
}

/// A facet of a child's hull with its corners and its data.
struct ChildFacet<'a> {
    child: NumberedChild<'a>,
    /// The corners, as indices of the child's points.
    corners: &'a [u32],
    facet: &'a FacetData,
}

impl ChildFacet<'_> {
    /// Returns the common numbers of the facet's corners.
    fn corner_numbers(&self) -> impl ExactSizeIterator<Item = u32> + Clone {
        self.corners
            .iter()
            .map(|&v| self.child.point_numbers[v as usize])
    }

    fn edges(&self) -> impl Iterator<Item = (u32, u32)> + Clone {
        self.corner_numbers()
            .zip(self.corner_numbers().cycle().skip(1))
    }

    fn mesh_faces(&self) -> Vec<MeshFace> {
        let node = self.child.node;
        match self.facet.provenance {
            FacetOrigin::Face(id) => fan_triangles(self.corners)
                .map(|corners| MeshFace {
                    id,
                    vertices: corners.map(|v| vertex_id_of(node, v)),
                    corners: corners.map(|v| node.points[v as usize]),
                })
                .collect(),
            FacetOrigin::Faces | FacetOrigin::Virtual => self.facet.faces.clone(),
        }
    }
}

/// The facets of a child's hull, which can be looked up by a directed edge.
struct ChildFacets<'a> {
    child: NumberedChild<'a>,
    /// The data of both sides of the triangle, if the child is a single triangle, which lists no facets.
    single_triangle_data: Option<&'a FacetData>,
    /// A map from each directed edge to the index of the facet that has it.
    facet_at_edge: EdgeMap,
}

/// The corners of the front and the back face of a hull that is a single triangle, in the order of each face.
const FRONT_AND_BACK_CORNERS: [[u32; 3]; 2] = [[0, 1, 2], [2, 1, 0]];

impl<'a> ChildFacets<'a> {
    /// Creates the lookup for a child; `positions` is the number of common numbers.
    fn new(
        child: NumberedChild<'a>,
        single_triangle: Option<&'a FacetData>,
        positions: usize,
    ) -> Self {
        let sides = FRONT_AND_BACK_CORNERS.iter().map(|corners| &corners[..]);
        let loops = child
            .node
            .facets
            .iter()
            .chain(sides.filter(|_| single_triangle.is_some()));
        let edges = loops.zip(0..).flat_map(|(corners, k)| {
            let id = |v: u32| child.point_numbers[v as usize];
            edges_of(corners).map(move |(from, to)| ((id(from), id(to)), k))
        });
        ChildFacets {
            child,
            single_triangle_data: single_triangle,
            facet_at_edge: EdgeMap::new(positions, edges),
        }
    }

    fn child_facet(&self, k: usize) -> Option<ChildFacet<'a>> {
        let node = self.child.node;
        let (corners, facet) = match node.facets.get(k) {
            Some(corners) => (corners, node.facet_data.get(k)?),
            None => (
                &FRONT_AND_BACK_CORNERS.get(k - node.facets.len())?[..],
                self.single_triangle_data?,
            ),
        };
        Some(ChildFacet {
            child: self.child,
            corners,
            facet,
        })
    }

    fn facet_sharing_edge(&self, corners: &[u32]) -> Option<ChildFacet<'a>> {
        let mut known = edges_of(corners).filter_map(|edge| self.facet_at_edge.get(edge));
        self.child_facet(known.next()? as usize)
    }
}

/// Returns the facet data of a child that is a single triangle; `None` for other children.
fn single_triangle_facet_data(child: &NumberedChild<'_>) -> Option<FacetData> {
    let alone = child.node.facets.is_empty() && child.node.points.len() == 3;
    alone.then(|| FacetData {
        provenance: match child.node.leaf_faces.as_deref().unwrap_or_default() {
            [face] => FacetOrigin::Face(face.id),
            _ => FacetOrigin::Virtual,
        },
        class: FacetClass::OnMesh,
        faces: Vec::new(),
    })
}

/// Returns the mesh's vertex number of a point of a node.
fn vertex_id_of(node: &Node<'_>, point: u32) -> u32 {
    let known = node.vertex_ids.get(point as usize);
    known.copied().unwrap_or(point)
}

/// Returns whether a child's facet has the same corners, in the same cyclic order, as a facet of the hull.
fn is_same_loop(part: &ChildFacet<'_>, other: &[u32]) -> bool {
    if part.corners.len() != other.len() {
        return false;
    }
    let first = part.corner_numbers().next();
    let Some(start) = other.iter().position(|&v| Some(v) == first) else {
        return false;
    };
    let (end, begin) = other.split_at(start);
    part.corner_numbers().eq(begin.iter().chain(end).copied())
}

/// Returns whether two convex polygons together tile a facet of the hull. Edges that run both ways are dropped. The
/// remaining edges have to be the facet's loop, except for corners within its edges.
///
/// A part has at most the facet's corners and the two ends of the cut. A part of many more is
/// skipped, as it may share an edge with each of many facets.
fn tiles_facet(positions: &[DVec3], corners: &[u32], parts: [&ChildFacet<'_>; 2]) -> bool {
    let most = 2 * corners.len() + 8;
    if parts.iter().any(|part| part.corners.len() > most) {
        return false;
    }
    let mut edges: Vec<(u32, u32)> = parts.iter().flat_map(|part| part.edges()).collect();
    edges.sort_unstable();
    let border = |&(from, to): &(u32, u32)| edges.binary_search(&(to, from)).is_err();
    let next: Vec<(u32, u32)> = edges.iter().copied().filter(border).collect();
    // Common edges, and corners at which the parts only touch, are not on the border.
    let twice = edges.windows(2).any(|e| e[0] == e[1]);
    if twice || next.windows(2).any(|e| e[0].0 == e[1].0) {
        return false;
    }
    let after = |v: u32| {
        let at = next.binary_search_by_key(&v, |edge| edge.0);
        at.ok().map(|at| next[at].1)
    };
    let mut used = 0;
    for (from, to) in edges_of(corners) {
        let place = |v: u32| positions[v as usize];
        let between = |v: u32| is_degenerate([place(from), place(to), place(v)]);
        let mut at = from;
        while at != to {
            match after(at) {
                Some(step) if used < next.len() && (step == to || between(step)) => at = step,
                _ => return false,
            }
            used += 1;
        }
    }
    used == next.len()
}
