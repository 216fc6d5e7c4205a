//! A body: convex pieces, a tree over them, and whether they bound a solid.

use crate::error::InputError;
use crate::feature::Feature;
use crate::hierarchy::Hierarchy;
#[cfg(feature = "hull-tree")]
use crate::hull_tree::{HullTree, HullTreeError};
use crate::naming::face_under;
use crate::oracle::Combination;
use crate::pieces::Pieces;
use crate::shell::{Shell, shells};
use crate::tree::{Tree, pieces_at};

/// What moves: convex pieces in the body's own frame, ready for queries; immutable, shareable.
///
/// ```
/// use ccd_core::{glam::DVec3, Body, Pieces, Volume};
/// let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let pieces = Pieces::triangles(&triangle, &[[0, 1, 2]], &[0]).unwrap();
/// let body = Body::new(&pieces, Volume::Surface).unwrap();
/// assert_eq!(body.pieces().len(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct Body {
    pieces: Pieces,
    tree: Tree,
    volume: Volume,
    shells: Vec<Shell>,
    /// Its leaves name the pieces in the order of the tree.
    #[cfg(feature = "hull-tree")]
    hull_tree: Option<HullTree>,
}

/// Whether being inside of a body counts as touching it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Volume {
    /// The triangles, or the [mesh's triangles](crate::Piece::mesh_triangles) on the pieces, bound a solid:
    /// together they are closed. It is where they wind about a point, whichever way: of shells within each
    /// other each has to be wound the other way than what is around it. A body inside it overlaps it. A
    /// single piece is solid by itself.
    Solid,
    /// Only the pieces themselves are there to be touched.
    Surface,
}

impl Body {
    /// A body over a hierarchy of the core's own, split at medians.
    ///
    /// # Errors
    /// [`InputError::TooManyPieces`].
    pub fn new(pieces: &Pieces, volume: Volume) -> Result<Self, InputError> {
        let hierarchy = Hierarchy::median_split(pieces);
        Body::with_hierarchy(pieces, &hierarchy, volume)
    }

    /// A body over a given hierarchy. The body keeps the pieces in the hierarchy's order; features
    /// are named by the numbers that the pieces carry.
    ///
    /// # Errors
    /// [`InputError::BadHierarchy`] when it is not one over these pieces.
    pub fn with_hierarchy(
        pieces: &Pieces,
        hierarchy: &Hierarchy,
        volume: Volume,
    ) -> Result<Self, InputError> {
        let (tree, pieces) = Tree::build(pieces, hierarchy)?;
        Ok(Body {
            shells: shells(&pieces),
            pieces,
            tree,
            volume,
            #[cfg(feature = "hull-tree")]
            hull_tree: None,
        })
    }

    /// The same body with a hull tree over its pieces, for the schedules that use one.
    ///
    /// # Errors
    /// [`HullFault::NotAPiece`](crate::HullFault::NotAPiece) unless its leaves are the body's pieces,
    /// to the bit and in any order.
    #[cfg(feature = "hull-tree")]
    pub fn with_hull_tree(mut self, tree: HullTree) -> Result<Self, HullTreeError> {
        self.hull_tree = Some(tree.renumbered(&self.pieces)?);
        Ok(self)
    }

    /// The pieces, in the order of the tree.
    pub fn pieces(&self) -> &Pieces {
        &self.pieces
    }

    /// Whether it is solid.
    pub fn volume(&self) -> Volume {
        self.volume
    }

    /// The hull tree over its pieces, if it was given one; its leaves name [`Body::pieces`].
    #[cfg(feature = "hull-tree")]
    pub fn hull_tree(&self) -> Option<&HullTree> {
        self.hull_tree.as_ref()
    }

    /// Bytes held, about.
    pub fn bytes(&self) -> usize {
        #[cfg(feature = "hull-tree")]
        let hulls = self.hull_tree.as_ref().map_or(0, HullTree::bytes);
        #[cfg(not(feature = "hull-tree"))]
        let hulls = 0;
        self.pieces.bytes() + self.tree.bytes() + hulls
    }

    /// What a point of a piece is called in the mesh.
    ///
    /// A virtual facet may lie within the surface, over faces that belong to other pieces: these are
    /// asked where the piece has no name for the point.
    pub(crate) fn feature(&self, piece: u32, point: &Combination) -> Feature {
        let feature = self.pieces.feature(piece as usize, point);
        let Feature::Piece(_) = feature else {
            return feature;
        };
        let at = point.of(self.pieces.get(piece as usize).points);
        at.and_then(|at| {
            let there = pieces_at(&self.tree, at).into_iter();
            let mut faces = there.map(|k| face_under(&self.pieces.get(k as usize), at));
            faces.find_map(|face| face)
        })
        .map_or(feature, Feature::Face)
    }

    /// Whether its faces bound a solid that its pieces need not fill.
    pub(crate) fn may_be_hollow(&self) -> bool {
        self.volume == Volume::Solid && (self.pieces.all_triangles() || self.pieces.len() > 1)
    }

    /// The tree over the pieces.
    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// Some points of every connected part: inside another solid either all of a part is, or its
    /// surface crosses the solid's.
    pub(crate) fn shells(&self) -> &[Shell] {
        &self.shells
    }
}

#[cfg(test)]
mod tests;
