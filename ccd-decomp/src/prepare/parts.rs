//! Builds the content of a stored body (pieces, hierarchy, report) from the pieces chosen for a mesh.

use super::error::PrepareError;
use super::model::StoredBodyContent;
use super::report::{PieceReason, PiecesKind, Report};
use crate::mesh::TriangleMesh;
use crate::pieces::outer_hull::OuterHull;
use crate::pieces::patches::{Decomposition, Patch};
use crate::solid::topology::TopologyDefects;
use crate::tree::hierarchy::build_hierarchy;
use ccd_core::{Hierarchy, Pieces, Polytope, Solidity};

/// The pieces that were made of a mesh. Each variant is one kind of pieces.
pub(super) enum PiecesOfOneKind {
    Triangles,
    Patches(Decomposition),
    Hull(Box<Polytope>),
    OuterHull(Box<OuterHull>),
}

/// The kind of pieces chosen for a mesh, with the pieces and the mesh's topology.
pub(super) struct ChosenPieces {
    pub(super) solidity: Solidity,
    pub(super) pieces: PiecesOfOneKind,
    pub(super) choice_reason: PieceReason,
    pub(super) topology: TopologyDefects,
    /// A copy of the mesh with wrongly oriented shells reversed, if there are any.
    pub(super) reoriented_mesh: Option<TriangleMesh>,
}

/// The pieces of a body, and a hierarchy over them.
type PieceTree = (Pieces, Hierarchy);

impl ChosenPieces {
    /// Creates the content from the chosen pieces. `triangles` are those of the mesh before any shell is reversed, if
    /// computed.
    pub(super) fn into_model(
        self,
        mesh: &TriangleMesh,
        triangles: Option<PieceTree>,
    ) -> Result<StoredBodyContent, PrepareError> {
        let volume = self.solidity;
        let mut report = Report::new(PiecesKind::Triangles, self.choice_reason, volume);
        let triangles = || match (triangles, &self.reoriented_mesh) {
            (Some(triangles), None) => Ok(triangles),
            (_, turned) => triangle_tree(turned.as_ref().unwrap_or(mesh)),
        };
        let ((pieces, hierarchy), surface) = match self.pieces {
            PiecesOfOneKind::Triangles => (triangles()?, None),
            PiecesOfOneKind::Patches(Decomposition { patches }) => {
                report.kind = PiecesKind::Patches;
                report.virtual_facets = patches.iter().map(Patch::virtual_facet_count).sum();
                let polytopes: Vec<Polytope> = patches.into_iter().map(|p| p.polytope).collect();
                (polytope_tree(&polytopes)?, None)
            }
            PiecesOfOneKind::Hull(polytope) => {
                report.kind = PiecesKind::Hull;
                (polytope_tree(&[*polytope])?, Some(triangles()?))
            }
            PiecesOfOneKind::OuterHull(hull) => {
                report.kind = PiecesKind::OuterHull;
                report.excess = hull.excess_bound;
                report.virtual_facets = hull.polytope.facets.len();
                (polytope_tree(&[hull.polytope])?, None)
            }
        };
        report.triangles = mesh.faces().len();
        report.pieces = pieces.len();
        report.tree_nodes = hierarchy.nodes().len();
        report.topology = Some(self.topology);
        report.repairs = mesh.repairs().clone();
        Ok(StoredBodyContent {
            pieces,
            hierarchy,
            solidity: volume,
            hull_tree: None,
            surface,
            report,
        })
    }
}

/// Creates one piece for each triangle of a mesh, and their hierarchy.
pub(super) fn triangle_tree(mesh: &TriangleMesh) -> Result<PieceTree, PrepareError> {
    let faces = mesh.welded_faces();
    piece_tree(Pieces::from_triangles(
        mesh.vertices(),
        &faces,
        mesh.face_ids(),
    )?)
}

fn polytope_tree(polytopes: &[Polytope]) -> Result<PieceTree, PrepareError> {
    piece_tree(Pieces::from_polytopes(polytopes)?)
}

fn piece_tree(pieces: Pieces) -> Result<PieceTree, PrepareError> {
    let hierarchy = build_hierarchy(&pieces)?;
    Ok((pieces, hierarchy))
}
