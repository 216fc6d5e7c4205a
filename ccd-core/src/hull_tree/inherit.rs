//! What an inner hull's surface has of its children's.
//!
//! A child's hull meets the plane of a facet of its parent in at most one facet of its own. So a facet
//! of the parent is a child's, or is tiled by one of either child, or is a bridge.

use super::assemble::edges_of;
use super::inside::{is_collinear, is_coplanar, spanning};
use super::{FacetClass, Hull};
use crate::piece::{Face, Origin, Polytope};
use crate::point_tree::PointTree;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// What is known of one facet.
#[derive(Clone, Debug)]
pub(super) struct Skin {
    pub(super) origin: Origin,
    pub(super) class: FacetClass,
    /// The triangles of the mesh that lie in it, unless it is one face by itself.
    pub(super) faces: Vec<Face>,
}

impl Skin {
    const BRIDGE: Skin = Skin {
        origin: Origin::Virtual,
        class: FacetClass::Free,
        faces: Vec::new(),
    };

    /// Of a piece's facets.
    pub(super) fn of_piece(piece: &Polytope) -> Vec<Skin> {
        let mut skins = Vec::with_capacity(piece.facets.len());
        let starts: Vec<DVec3> = piece.faces.iter().map(|face| face.corners[0]).collect();
        let tree = PointTree::new(&starts);
        for facet in &piece.facets {
            let corners: Vec<DVec3> = points_of(piece, &facet.corners);
            let mut near = Vec::new();
            if let Some(plane) = spanning(&corners) {
                tree.for_each_not_behind(plane, |k| near.push(k));
            }
            near.sort_unstable();
            let near = near.iter().map(|&k| piece.faces[k as usize]);
            let within = |face: &Face| is_coplanar(&corners, face.corners);
            skins.push(Skin {
                origin: facet.origin,
                class: match facet.origin {
                    Origin::Face(_) | Origin::Faces => FacetClass::Original,
                    Origin::Virtual => FacetClass::Contained,
                },
                faces: near.filter(within).collect(),
            });
        }
        skins
    }

    /// Of a facet that two others tile.
    fn joined(parts: [&Part<'_>; 2]) -> Skin {
        let class = parts[0].skin.class.max(parts[1].skin.class);
        Skin {
            origin: match class {
                FacetClass::Original => Origin::Faces,
                FacetClass::Contained | FacetClass::Free => Origin::Virtual,
            },
            class,
            faces: parts.iter().flat_map(|part| part.mesh_faces()).collect(),
        }
    }
}

/// A child whose points are numbered together with those of its parent, which come first.
#[derive(Clone, Copy)]
pub(super) struct Child<'a> {
    pub(super) hull: &'a Polytope,
    pub(super) skins: &'a [Skin],
    /// The numbers of its points.
    pub(super) ids: &'a [u32],
}

/// What the facets of a hull are, given its children and where all their points are.
pub(super) fn inherit(hull: &Hull, places: &[DVec3], children: [Child<'_>; 2]) -> Vec<Skin> {
    let triangles = children.map(|child| lone_triangle(&child));
    let sides = [0, 1].map(|k| Side::new(&children[k], &triangles[k]));
    let skin = |corners: &Vec<u32>| {
        let parts = sides.each_ref().map(|side| side.sharing_an_edge(corners));
        match parts {
            [Some(part), _] | [_, Some(part)] if same_loop(&part.corners, corners) => {
                part.skin.clone()
            }
            [Some(one), Some(other)] if tile(places, corners, [one, other]) => {
                Skin::joined([one, other])
            }
            _ => Skin::BRIDGE,
        }
    };
    hull.facets.iter().map(skin).collect()
}

/// A facet of a child, by the common numbers.
struct Part<'a> {
    corners: Vec<u32>,
    places: Vec<DVec3>,
    /// The corners' numbers in the mesh.
    vertices: Vec<u32>,
    skin: &'a Skin,
}

impl Part<'_> {
    fn mesh_faces(&self) -> Vec<Face> {
        match self.skin.origin {
            Origin::Face(id) => (1..self.places.len() - 1)
                .map(|k| Face {
                    id,
                    vertices: [0, k, k + 1].map(|k| self.vertices[k]),
                    corners: [0, k, k + 1].map(|k| self.places[k]),
                })
                .collect(),
            Origin::Faces | Origin::Virtual => self.skin.faces.clone(),
        }
    }
}

/// A child's facets.
struct Side<'a> {
    parts: Vec<Part<'a>>,
    /// Which part an edge belongs to.
    by_edge: HashMap<(u32, u32), usize>,
}

impl<'a> Side<'a> {
    fn new(child: &Child<'a>, lone: &'a Option<Skin>) -> Self {
        let part = |(corners, skin): (&[u32], &'a Skin)| Part {
            corners: corners.iter().map(|&v| child.ids[v as usize]).collect(),
            places: points_of(child.hull, corners),
            vertices: corners.iter().map(|&v| vertex_of(child.hull, v)).collect(),
            skin,
        };
        let facets = child.hull.facets.iter().map(|facet| &facet.corners[..]);
        let mut parts: Vec<Part<'_>> = facets.zip(child.skins).map(part).collect();
        if let Some(skin) = lone {
            parts.extend([&[0, 1, 2], &[2, 1, 0]].map(|corners| part((corners, skin))));
        }
        let edges = |(k, part): (usize, &Part<'_>)| {
            let edges: Vec<_> = edges_of(&part.corners).map(|edge| (edge, k)).collect();
            edges
        };
        Side {
            by_edge: parts.iter().enumerate().flat_map(edges).collect(),
            parts,
        }
    }

    fn sharing_an_edge(&self, corners: &[u32]) -> Option<&Part<'a>> {
        let mut known = edges_of(corners).filter_map(|edge| self.by_edge.get(&edge));
        known.next().map(|&k| &self.parts[k])
    }
}

/// What the front and the back are of a triangle by itself, which lists no facets.
fn lone_triangle(child: &Child<'_>) -> Option<Skin> {
    let alone = child.hull.facets.is_empty() && child.hull.points.len() == 3;
    alone.then(|| Skin {
        origin: match child.hull.faces[..] {
            [face] => Origin::Face(face.id),
            _ => Origin::Virtual,
        },
        class: FacetClass::Original,
        faces: Vec::new(),
    })
}

/// The number of a point in the mesh.
fn vertex_of(polytope: &Polytope, point: u32) -> u32 {
    let known = polytope.vertex_ids.get(point as usize);
    known.copied().unwrap_or(point)
}

fn points_of(polytope: &Polytope, corners: &[u32]) -> Vec<DVec3> {
    let point = |&v: &u32| polytope.points[v as usize];
    corners.iter().map(point).collect()
}

/// Whether two loops are the same but for where they begin.
fn same_loop(one: &[u32], other: &[u32]) -> bool {
    let Some(start) = other.iter().position(|v| *v == one[0]) else {
        return false;
    };
    let (end, begin) = other.split_at(start);
    one.len() == other.len() && one.iter().eq(begin.iter().chain(end))
}

/// Whether two convex polygons together are a facet of the hull: what is left of their edges, once
/// those are gone that run both ways, is the facet's loop, but for corners within its edges.
fn tile(places: &[DVec3], corners: &[u32], parts: [&Part<'_>; 2]) -> bool {
    let edges: Vec<(u32, u32)> = parts.iter().flat_map(|p| edges_of(&p.corners)).collect();
    let all: HashSet<(u32, u32)> = edges.iter().copied().collect();
    let border = |&(from, to): &(u32, u32)| !all.contains(&(to, from));
    let left: Vec<(u32, u32)> = edges.iter().copied().filter(border).collect();
    let next: HashMap<u32, u32> = left.iter().copied().collect();
    // Edges that both have, and corners where they only touch, are no border.
    if all.len() != edges.len() || next.len() != left.len() {
        return false;
    }
    let mut used = 0;
    for (from, to) in edges_of(corners) {
        let place = |v: u32| places[v as usize];
        let between = |v: u32| is_collinear(place(from), place(to), place(v));
        let mut at = from;
        while at != to {
            match next.get(&at) {
                Some(&step) if used < next.len() && (step == to || between(step)) => at = step,
                _ => return false,
            }
            used += 1;
        }
    }
    used == next.len()
}
