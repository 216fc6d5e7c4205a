//! Nodes checked and put together, children before their parents.

use super::error::{HullFault, HullTreeError};
use super::inherit::{Child, Skin, inherit};
use super::inside::{Container, too_fine};
use super::{FacetClass, Hull, HullNode, HullTree};
use crate::hierarchy::{Hierarchy, HierarchyNode, bounds};
use crate::order::greater;
use crate::piece::{Facet, Polytope};
use crate::pieces::Pieces;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

pub(super) fn assemble(pieces: &Pieces, nodes: &[HullNode]) -> Result<HullTree, HullTreeError> {
    let hierarchy = hierarchy(pieces, nodes)?;
    let mut done: Vec<Node> = nodes.iter().map(|_| Node::default()).collect();
    for at in children_first(&hierarchy) {
        done[at] = match &nodes[at] {
            HullNode::Leaf(piece) => Node::leaf(at, pieces.polytope(*piece as usize))?,
            HullNode::Inner(children, hull) => Node::inner(
                at,
                hull,
                children.map(|child| (child, &done[child as usize])),
            )?,
        };
    }
    let mut classes = Vec::new();
    let mut class_ends = Vec::with_capacity(done.len());
    for node in &done {
        // A bridge between thick and thin pieces is level with neither.
        classes.extend(node.skins.iter().map(|skin| match node.evenly_rounded {
            true => skin.class,
            false => FacetClass::Free,
        }));
        class_ends.push(classes.len() as u32);
    }
    let (meeting, meeting_ends) = meeting(&done);
    Ok(HullTree {
        hierarchy,
        meeting,
        meeting_ends,
        classes,
        class_ends,
        evenly_rounded: done.iter().map(|node| node.evenly_rounded).collect(),
        sizes: done.iter().map(|node| node.size).collect(),
        hulls: Pieces::polytopes(&done.into_iter().map(|node| node.hull).collect::<Vec<_>>())?,
    })
}

/// The facets that meet in each point of all hulls, and where each point's end.
fn meeting(nodes: &[Node]) -> (Vec<u32>, Vec<u32>) {
    let (mut meeting, mut ends) = (Vec::new(), Vec::new());
    for node in nodes {
        let facets = (0u32..).zip(&node.hull.facets);
        let of_facet = |(k, facet): (u32, &Facet)| -> Vec<(u32, u32)> {
            facet.corners.iter().map(|&corner| (corner, k)).collect()
        };
        let mut pairs: Vec<(u32, u32)> = facets.flat_map(of_facet).collect();
        pairs.sort_unstable();
        let mut pairs = pairs.into_iter().peekable();
        for point in 0..node.hull.points.len() as u32 {
            while let Some((_, facet)) = pairs.next_if(|&(corner, _)| corner == point) {
                meeting.push(facet);
            }
            ends.push(meeting.len() as u32);
        }
    }
    (meeting, ends)
}

/// A node that is checked.
#[derive(Debug, Default)]
struct Node {
    hull: Polytope,
    /// Of its facets.
    skins: Vec<Skin>,
    evenly_rounded: bool,
    size: f64,
}

impl Node {
    fn leaf(at: usize, hull: Polytope) -> Result<Self, HullTreeError> {
        if let Some(point) = too_fine(&hull.points) {
            let point = point as u32;
            return Err(HullFault::TooFine { point }.at(at));
        }
        Ok(Node {
            skins: Skin::of_piece(&hull),
            evenly_rounded: true,
            size: size(&hull),
            hull,
        })
    }

    fn inner(at: usize, hull: &Hull, children: [(u32, &Node); 2]) -> Result<Self, HullTreeError> {
        check_facets(hull).map_err(|fault| fault.at(at))?;
        let identity = Identity::new(hull, children.map(|(_, child)| &child.hull))
            .map_err(|fault| fault.at(at))?;
        check_inside(hull, &identity, &children).map_err(|fault| fault.at(at))?;

        let [left, right] = children.map(|(_, child)| child);
        let even = |child: &Node| child.evenly_rounded && child.hull.radius == left.hull.radius;
        let evenly_rounded = even(left) && even(right);
        let children = [
            left.as_child(&identity.of_left),
            right.as_child(&identity.of_right),
        ];
        let skins = inherit(hull, &identity.places, children);
        let facets = hull.facets.iter().zip(&skins);
        let facet = |(corners, skin): (&Vec<u32>, &Skin)| Facet {
            origin: skin.origin,
            corners: corners.clone(),
        };
        let hull = Polytope {
            points: hull.points.clone(),
            facets: facets.map(facet).collect(),
            faces: skins.iter().flat_map(|skin| skin.faces.clone()).collect(),
            radius: greater(left.hull.radius, right.hull.radius),
            vertex_ids: identity.vertex_ids,
        };
        Ok(Node {
            skins,
            evenly_rounded,
            size: size(&hull),
            hull,
        })
    }

    fn as_child<'a>(&'a self, ids: &'a [u32]) -> Child<'a> {
        Child {
            hull: &self.hull,
            skins: &self.skins,
            ids,
        }
    }
}

/// Which points of the children are the same, and which of them are the hull's.
///
/// Numbers below the hull's count of points name those; the others name hidden points.
struct Identity {
    of_left: Vec<u32>,
    of_right: Vec<u32>,
    /// Where they are.
    places: Vec<DVec3>,
    /// In the mesh, of the hull's points.
    vertex_ids: Vec<u32>,
}

impl Identity {
    fn new(hull: &Hull, children: [&Polytope; 2]) -> Result<Self, HullFault> {
        // Adding zero makes −0 a 0.
        let place = |p: &DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
        let own = hull.points.iter().map(place).zip(0..);
        let mut numbers: HashMap<[u64; 3], u32> = own.collect();
        let mut places = hull.points.clone();
        let mut vertex_ids = vec![None; hull.points.len()];
        let mut number = |child: &Polytope| -> Vec<u32> {
            let points = child.points.iter().zip(&child.vertex_ids);
            let ids = points.map(|(point, &vertex)| {
                let id = *numbers.entry(place(point)).or_insert_with(|| {
                    places.push(*point);
                    places.len() as u32 - 1
                });
                if let Some(known) = vertex_ids.get_mut(id as usize) {
                    *known = Some(vertex);
                }
                id
            });
            ids.collect()
        };
        let [of_left, of_right] = children.map(&mut number);
        // Points that are twice in a hull are one, by the last one's index.
        let own = |k: usize| numbers[&place(&hull.points[k])] as usize;
        let vertex_id = |k: usize| {
            let point = k as u32;
            vertex_ids[own(k)].ok_or(HullFault::ForeignPoint { point })
        };
        Ok(Identity {
            of_left,
            of_right,
            places,
            vertex_ids: (0..hull.points.len())
                .map(vertex_id)
                .collect::<Result<_, _>>()?,
        })
    }
}

/// Whether the facets are loops of corners that close a surface.
fn check_facets(hull: &Hull) -> Result<(), HullFault> {
    let exists = |&v: &u32| (v as usize) < hull.points.len();
    let mut edges = HashSet::new();
    for (facet, corners) in (0..).zip(&hull.facets) {
        if corners.len() < 3 || !corners.iter().all(exists) {
            return Err(HullFault::BadFacet { facet });
        }
        for (from, to) in edges_of(corners) {
            if from == to || !edges.insert((from, to)) {
                return Err(HullFault::Open { facet });
            }
        }
    }
    for (facet, corners) in (0..).zip(&hull.facets) {
        if edges_of(corners).any(|(from, to)| !edges.contains(&(to, from))) {
            return Err(HullFault::Open { facet });
        }
    }
    Ok(())
}

/// Whether the hull holds all points of its children.
fn check_inside(
    hull: &Hull,
    identity: &Identity,
    children: &[(u32, &Node); 2],
) -> Result<(), HullFault> {
    let container = Container::new(&hull.points, &hull.facets);
    for (&(child, node), ids) in children.iter().zip([&identity.of_left, &identity.of_right]) {
        let is_hidden = |&k: &u32| ids[k as usize] as usize >= hull.points.len();
        let hidden: Vec<u32> = (0..ids.len() as u32).filter(is_hidden).collect();
        let places: Vec<DVec3> = hidden
            .iter()
            .map(|&k| node.hull.points[k as usize])
            .collect();
        if let Some(k) = container.left_out(&places) {
            let point = hidden[k];
            return Err(HullFault::ChildOutside { child, point });
        }
    }
    Ok(())
}

/// The edges of a loop of corners.
pub(super) fn edges_of(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

fn hierarchy(pieces: &Pieces, nodes: &[HullNode]) -> Result<Hierarchy, HullTreeError> {
    let plain = nodes.iter().map(|node| match *node {
        HullNode::Leaf(piece) => HierarchyNode::Leaf(piece),
        HullNode::Inner([left, right], _) => HierarchyNode::Inner(left, right),
    });
    Ok(Hierarchy::new(plain.collect(), pieces.len())?)
}

/// All nodes, each after its children.
fn children_first(hierarchy: &Hierarchy) -> Vec<usize> {
    let mut order = Vec::with_capacity(hierarchy.nodes().len());
    let mut stack = vec![0];
    while let Some(at) = stack.pop() {
        order.push(at as usize);
        if let HierarchyNode::Inner(left, right) = hierarchy.nodes()[at as usize] {
            stack.extend([left, right]);
        }
    }
    order.reverse();
    order
}

fn size(hull: &Polytope) -> f64 {
    let (lo, hi) = bounds(hull.points.iter().copied());
    0.5 * hi.distance(lo) + hull.radius
}
