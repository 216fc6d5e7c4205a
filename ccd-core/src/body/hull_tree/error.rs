//! The reasons why nodes are refused as a hull tree.

use crate::error::InputError;
use std::fmt;

/// The reason why nodes are refused as a hull tree, with the invalid node.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum HullTreeError {
    /// The nodes form no hierarchy over the pieces, or there are too many nodes.
    Input(InputError),
    /// One of the input nodes is invalid.
    Node {
        /// The index of the invalid node in the list of input nodes.
        node: u32,
        /// What is wrong with the node.
        fault: HullFault,
    },
}

/// What is wrong with a node of a hull tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HullFault {
    /// A corner of the hull is not a point of either child.
    ForeignPoint {
        /// The index of the corner in the hull's list of points.
        point: u32,
    },
    /// A facet has fewer than three corners, or refers to a point that the hull does not have.
    BadFacet {
        /// The index of the invalid facet in the hull's list of facets.
        facet: u32,
    },
    /// The facets do not close a surface: an edge does not occur exactly once in reverse in another facet.
    OpenSurface {
        /// The index of the facet with the unmatched or repeated edge.
        facet: u32,
    },
    /// A point of a child is outside of the hull, or the hull's facets do not prove that it is inside.
    ChildOutside {
        /// The index of the child's node.
        child: u32,
        /// The index of the point in the child's hull.
        point: u32,
    },
    /// A point has a coordinate too close to 0 for exact predicates.
    CoordinateTooSmall {
        /// The index of the point among the points of the node's hull.
        point: u32,
    },
    /// The leaf is not one of the body's pieces, or another leaf is already that piece.
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

impl From<InputError> for HullTreeError {
    fn from(error: InputError) -> Self {
        HullTreeError::Input(error)
    }
}

impl fmt::Display for HullTreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Node { node, fault } => write!(f, "node {node} of the hull tree: {fault}"),
        }
    }
}

impl fmt::Display for HullFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ForeignPoint { point } => write!(f, "point {point} is none of its children's"),
            Self::BadFacet { facet } => write!(f, "facet {facet} names a missing corner"),
            Self::OpenSurface { facet } => write!(f, "facet {facet} has an edge that is open"),
            Self::ChildOutside { child, point } => {
                write!(f, "point {point} of its child {child} is outside")
            }
            Self::CoordinateTooSmall { point } => {
                write!(f, "point {point} has a coordinate too near to 0")
            }
            Self::NotAPiece => write!(f, "it is a leaf, but none of the body's pieces"),
        }
    }
}

impl std::error::Error for HullTreeError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Input(error) => Some(error),
            Self::Node { .. } => None,
        }
    }
}
