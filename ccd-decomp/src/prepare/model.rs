//! Models, which can be stored in a file, and the bodies built from them.

use super::error::PrepareError;
use super::report::{PieceReason, PiecesKind, Report};
use crate::mesh::unit::Unit;
use crate::tree::hierarchy::build_hierarchy;
use crate::tree::hull_tree::build_hull_tree;
use ccd_core::{Body, Hierarchy, HullTree, InputError, Pieces, SolidOfRevolution, Solidity};

/// The pieces of a body and a hierarchy over them, from which the body is built. A `.ccd` file stores a model.
#[derive(Clone, Debug)]
pub struct StoredBodyContent {
    /// The convex pieces that the body is made of.
    pub pieces: Pieces,
    /// The binary hierarchy over the pieces.
    pub hierarchy: Hierarchy,
    /// Whether the body is solid. A solid is in contact with bodies inside it.
    pub solidity: Solidity,
    /// The hull tree over the pieces, for the schedules that use a hull tree; `None` if it was not built.
    pub hull_tree: Option<HullTree>,
    /// The triangles of a convex solid and a hierarchy over them. Queries use them against bodies of many triangles.
    pub surface: Option<(Pieces, Hierarchy)>,
    /// The report on the kind of the pieces, and the reason for it.
    pub report: Report,
}

/// A body that is ready for queries, and the report on its preparation.
#[derive(Clone, Debug)]
pub struct PreparedBody {
    /// The body, which any number of queries can share.
    pub body: Body,
    /// The report on the kind of the pieces, and the reason for it.
    pub report: Report,
    /// The unit of the body's coordinates, if stated by the file or requested.
    pub unit: Option<Unit>,
}

impl StoredBodyContent {
    /// Builds the body from the pieces and the hierarchy, in O(n log n) in the number of pieces.
    ///
    /// Its [excess](Body::excess) is [`Report::excess`].
    ///
    /// # Errors
    /// [`PrepareError::Input`] and [`PrepareError::HullTree`] if the parts of the model do not match.
    pub fn body(&self) -> Result<Body, PrepareError> {
        let mut body = Body::with_hierarchy(&self.pieces, &self.hierarchy, self.solidity)?;
        if let Some((pieces, hierarchy)) = &self.surface {
            let surface = Body::with_hierarchy(pieces, hierarchy, Solidity::Solid)?;
            body = body.with_surface_triangles(surface)?;
        }
        let body = body.with_excess(self.report.excess)?;
        Ok(match &self.hull_tree {
            Some(tree) => body.with_hull_tree(tree.clone())?,
            None => body,
        })
    }

    /// Creates a model from the pieces of a body, to store it.
    ///
    /// The model has the same pieces, the same volume and the same [excess](Body::excess), so that answers are the
    /// same. Its tree is rebuilt, without hulls and without the surface of a convex solid.
    ///
    /// # Errors
    /// [`PrepareError::Input`] when there are too many pieces for a hierarchy.
    pub fn from_body(body: &Body) -> Result<Self, PrepareError> {
        let pieces = body.pieces().clone();
        let hierarchy = build_hierarchy(&pieces)?;
        let report = Report {
            pieces: pieces.len(),
            excess: body.excess(),
            ..Report::new(
                PiecesKind::Primitive,
                PieceReason::Requested,
                body.solidity(),
            )
        };
        Ok(StoredBodyContent {
            pieces,
            hierarchy,
            solidity: body.solidity(),
            hull_tree: None,
            surface: None,
            report,
        })
    }

    /// Adds a hull tree over the pieces.
    ///
    /// # Errors
    /// [`PrepareError::BuildHullTree`] when a hull cannot be computed exactly.
    pub fn with_hull_tree(mut self) -> Result<Self, PrepareError> {
        self.hull_tree = Some(build_hull_tree(&self.pieces)?);
        Ok(self)
    }

    /// Builds the body, and returns it with the report.
    ///
    /// # Errors
    /// [`PrepareError::Input`] and [`PrepareError::HullTree`] if the parts of the model do not match.
    pub fn into_prepared_body(self) -> Result<PreparedBody, PrepareError> {
        Ok(PreparedBody {
            body: self.body()?,
            report: self.report,
            unit: None,
        })
    }
}

impl PreparedBody {
    /// Wraps a body that was not made from a mesh.
    pub(crate) fn from_primitive(body: Body) -> Self {
        PreparedBody {
            report: Report::new(
                PiecesKind::Primitive,
                PieceReason::Requested,
                body.solidity(),
            ),
            body,
            unit: None,
        }
    }

    /// Creates a body that encloses a cylinder or a cone. `excess` is the upper bound on how far its polytope extends
    /// beyond the shape.
    pub(crate) fn from_solid_of_revolution(
        round: &SolidOfRevolution,
        excess: Option<f64>,
    ) -> Result<Self, InputError> {
        let enclosure = round.enclosing_polytope(excess.unwrap_or(round.default_excess()))?;
        let mut prepared = PreparedBody::from_primitive(enclosure.body()?);
        prepared.report.excess = enclosure.excess();
        Ok(prepared)
    }
}
