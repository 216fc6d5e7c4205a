//! The reasons why nodes are refused as a hull tree.

use crate::error::InputError;

/// The reason why nodes are refused as a hull tree, with the invalid node.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HullTreeError {
    /// The nodes form no hierarchy over the pieces, or there are too many nodes.
    #[error("{0}")]
    Input(#[from] InputError),
    /// One of the input nodes is invalid.
    #[error("node {node} of the hull tree: {fault}")]
    Node {
        /// The index of the invalid node in the list of input nodes.
        node: u32,
        /// What is wrong with the node.
        fault: HullFault,
    },
}

/// What is wrong with a node of a hull tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HullFault {
    /// A corner of the hull is not a point of either child.
    #[error("point {point} is none of its children's")]
    ForeignPoint {
        /// The index of the corner in the hull's list of points.
        point: u32,
    },
    /// A facet has fewer than three corners, or refers to a point that the hull does not have.
    #[error("facet {facet} names a missing corner")]
    BadFacet {
        /// The index of the invalid facet in the hull's list of facets.
        facet: u32,
    },
    /// The facets do not close a surface: an edge does not occur exactly once in reverse in another facet.
    #[error("facet {facet} has an edge that is open")]
    OpenSurface {
        /// The index of the facet with the unmatched or repeated edge.
        facet: u32,
    },
    /// A point of a child is outside of the hull, or the hull's facets do not prove that it is inside.
    #[error("point {point} of its child {child} is outside")]
    ChildOutside {
        /// The index of the child's node.
        child: u32,
        /// The index of the point in the child's hull.
        point: u32,
    },
    /// A point has a coordinate too close to 0 for exact predicates.
    #[error("point {point} has a coordinate too near to 0")]
    CoordinateTooSmall {
        /// The index of the point among the points of the node's hull.
        point: u32,
    },
    /// The leaf is not one of the body's pieces, or another leaf is already that piece.
    #[error("it is a leaf, but none of the body's pieces")]
    NotAPiece,
}

impl HullFault {
    pub(crate) fn at_node(self, node: usize) -> HullTreeError {
        HullTreeError::Node {
            node: node as u32,
            fault: self,
        }
    }
}
