//! Nodes checked and put together, children before their parents.

use super::bottom_up::bottom_up;
use super::edges::check_facets;
use super::error::{HullFault, HullTreeError};
use super::identity::Identity;
use super::inherit::{Child, Skin, inherit};
use super::inside::{Container, too_fine};
use super::{FacetClass, Hull, HullNode, HullTree};
use crate::hierarchy::{Hierarchy, HierarchyNode, bounds};
use crate::order::greater;
use crate::piece::{Facet, Polytope};
use crate::pieces::Pieces;
use glam::DVec3;

pub(super) fn assemble(pieces: &Pieces, nodes: &[HullNode]) -> Result<HullTree, HullTreeError> {
    let hierarchy = hierarchy(pieces, nodes)?;
    let done = bottom_up(&hierarchy, |at, children| match (&nodes[at], children) {
        (HullNode::Leaf(piece), _) => Node::leaf(at, pieces.polytope(*piece as usize)),
        (HullNode::Inner(names, hull), [left, right]) => {
            Node::inner(at, hull, [(names[0], left), (names[1], right)])
        }
    })?;
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

/// The facets that meet in each point of all hulls, in ascending order, and where each point's end.
fn meeting(nodes: &[Node]) -> (Vec<u32>, Vec<u32>) {
    let (mut meeting, mut ends) = (Vec::new(), Vec::new());
    for Node { hull, .. } in nodes {
        let start = ends.len();
        let first = meeting.len() as u32;
        // First how many there are, then where the next one goes, which at last is where they end.
        ends.resize(start + hull.points.len(), 0);
        let next = &mut ends[start..];
        let corners = hull.facets.iter().flat_map(|facet| &facet.corners);
        corners.for_each(|&corner| next[corner as usize] += 1);
        let mut end = first;
        for next in next.iter_mut() {
            end += std::mem::replace(next, end);
        }
        meeting.resize(end as usize, 0);
        for (k, facet) in (0..).zip(&hull.facets) {
            for &corner in &facet.corners {
                meeting[next[corner as usize] as usize] = k;
                next[corner as usize] += 1;
            }
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

fn hierarchy(pieces: &Pieces, nodes: &[HullNode]) -> Result<Hierarchy, HullTreeError> {
    let plain = nodes.iter().map(|node| match *node {
        HullNode::Leaf(piece) => HierarchyNode::Leaf(piece),
        HullNode::Inner([left, right], _) => HierarchyNode::Inner(left, right),
    });
    Ok(Hierarchy::new(plain.collect(), pieces.len())?)
}

fn size(hull: &Polytope) -> f64 {
    let (lo, hi) = bounds(hull.points.iter().copied());
    0.5 * hi.distance(lo) + hull.radius
}
