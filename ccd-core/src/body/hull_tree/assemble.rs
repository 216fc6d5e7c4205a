//! Checks the input nodes of a hull tree and assembles the tree, children before parents.

use super::bottom_up::compute_bottom_up;
use super::edges::check_facets;
use super::error::{HullFault, HullTreeError};
use super::hull::{FacetClass, Hull, HullNode};
use super::identity::PointNumbering;
use super::inherit::{NumberedChild, inherit_facet_data};
use super::inside::PreparedHull;
use super::node::{FacetData, Node};
use super::{HullTree, Hulls};
use crate::body::adjacency::AdjacencyLists;
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::pieces::Pieces;
use crate::body::pieces::builder::{PiecesBuilder, PolytopeParts};
use crate::body::polytope::Polytope;
use crate::error::InputError;
use crate::math::exact::first_underflow_prone_point_index;
use crate::math::order::greater;
use crate::math::vector::bounding_box;
use glam::DVec3;
use std::borrow::Cow;
use std::sync::Arc;

impl HullTree {
    /// Builds a hull tree over pieces from nodes, the root first.
    ///
    /// # Errors
    /// [`HullTreeError`] names the node, and the part of the [guarantee](HullTree) that fails
    /// there.
    ///
    /// # Complexity
    /// O(n log n) in all points and facets, if few of the points hidden by a hull are near each of its facets.
    pub fn new(pieces: &Pieces, nodes: &[HullNode]) -> Result<Self, HullTreeError> {
        let hierarchy = hierarchy(pieces, nodes)?;
        let done = compute_bottom_up(&hierarchy, |at, children| match (&nodes[at], children) {
            (HullNode::Leaf(piece), _) => {
                check_and_make_leaf_node(at, pieces.polytope(*piece as usize))
            }
            (HullNode::Inner(names, hull), [left, right]) => {
                check_and_make_inner_node(at, hull, [(names[0], left), (names[1], right)])
            }
        })?;
        let mut classes = Vec::new();
        let mut class_ends = Vec::with_capacity(done.len());
        for node in &done {
            // A bridge between thick and thin pieces is level with neither.
            classes.extend(node.facet_data.iter().map(|facet| {
                if node.has_uniform_radius {
                    facet.class
                } else {
                    FacetClass::Bridge
                }
            }));
            class_ends.push(classes.len() as u32);
        }
        let hulls = Hulls {
            facets_by_point: facets_by_point(&done),
            facet_classes: classes,
            facet_class_ends: class_ends,
            has_uniform_radius_by_node: done.iter().map(|node| node.has_uniform_radius).collect(),
            half_diagonals: done.iter().map(|node| node.half_diagonal).collect(),
            pieces: flatten_hulls(done)?,
        };
        Ok(HullTree {
            hierarchy,
            hulls: Arc::new(hulls),
        })
    }
}

/// Copies the hulls of all nodes to one list of pieces, and frees each node once its hull is copied.
fn flatten_hulls(nodes: Vec<Node<'_>>) -> Result<Pieces, InputError> {
    let mut builder = PiecesBuilder::default();
    for node in nodes {
        builder.push(PolytopeParts {
            points: &node.points,
            vertex_ids: &node.vertex_ids,
            facets: node
                .facets
                .iter()
                .zip(node.facet_data.iter().map(|facet| facet.provenance)),
            faces: node.faces().copied(),
            radius: node.rounding_radius,
        });
    }
    builder.into_pieces()
}

/// Returns, for each point of all hulls, the indices of the facets that meet there, in ascending order.
fn facets_by_point(nodes: &[Node<'_>]) -> AdjacencyLists<u32> {
    let mut count = 0;
    let mut starts = Vec::with_capacity(nodes.len());
    for node in nodes {
        starts.push(count as u32);
        count += node.points.len();
    }
    let pairs = nodes.iter().zip(starts).flat_map(|(node, start)| {
        let facets = node.facets.iter().zip(0..);
        facets.flat_map(move |(corners, k)| corners.iter().map(move |&v| (start + v, k)))
    });
    AdjacencyLists::new(count, pairs)
}

/// Creates the leaf node for a piece, whose hull is the piece itself.
fn check_and_make_leaf_node(at: usize, piece: Polytope) -> Result<Node<'static>, HullTreeError> {
    if let Some(point) = first_underflow_prone_point_index(&piece.points) {
        let point = point as u32;
        return Err(HullFault::CoordinateTooSmall { point }.at_node(at));
    }
    let facet_data = FacetData::facet_data_of_piece(&piece);
    let loops = piece.facets.into_iter().map(|facet| facet.corners);
    Ok(Node {
        facet_data,
        has_uniform_radius: true,
        half_diagonal: half_diagonal(&piece.points, piece.radius),
        facets: Cow::Owned(loops.collect()),
        points: Cow::Owned(piece.points),
        vertex_ids: piece.vertex_ids,
        leaf_faces: Some(piece.faces),
        rounding_radius: piece.radius,
    })
}

/// Checks the hull of an inner node against its two children, and creates the node.
fn check_and_make_inner_node<'a>(
    at: usize,
    hull: &'a Hull,
    children: [(u32, &Node<'_>); 2],
) -> Result<Node<'a>, HullTreeError> {
    let [left, right] = children.map(|(_, child)| child);
    let at_node = |fault: HullFault| fault.at_node(at);
    check_facets(hull).map_err(at_node)?;
    let identity = PointNumbering::new(hull, [left, right]).map_err(at_node)?;
    check_children_inside(hull, &identity, &children).map_err(at_node)?;

    let even = |child: &Node<'_>| {
        child.has_uniform_radius && child.rounding_radius == left.rounding_radius
    };
    let has_uniform_radius = even(left) && even(right);
    let numbered = [0, 1].map(|k| NumberedChild {
        node: children[k].1,
        point_numbers: &identity.child_point_numbers[k],
    });
    let radius = greater(left.rounding_radius, right.rounding_radius);
    Ok(Node {
        facet_data: inherit_facet_data(hull, &identity.positions, numbered),
        has_uniform_radius,
        half_diagonal: half_diagonal(&hull.points, radius),
        facets: Cow::Borrowed(&hull.facets),
        points: Cow::Borrowed(&hull.points),
        vertex_ids: identity.vertex_ids,
        leaf_faces: None,
        rounding_radius: radius,
    })
}

/// Checks that the hull of a node contains all points of its children.
fn check_children_inside(
    hull: &Hull,
    identity: &PointNumbering,
    children: &[(u32, &Node<'_>); 2],
) -> Result<(), HullFault> {
    let container = PreparedHull::new(&hull.points, &hull.facets);
    for (&(child, node), ids) in children.iter().zip(&identity.child_point_numbers) {
        let is_hidden = |&k: &u32| ids[k as usize] as usize >= hull.points.len();
        let hidden: Vec<u32> = (0..ids.len() as u32).filter(is_hidden).collect();
        let positions: Vec<DVec3> = hidden.iter().map(|&k| node.points[k as usize]).collect();
        if let Some(k) = container.first_point_outside(&positions) {
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

fn half_diagonal(points: &[DVec3], radius: f64) -> f64 {
    let (lo, hi) = bounding_box(points.iter().copied());
    0.5 * hi.distance(lo) + radius
}
