//! Builds a model from the pieces of a mesh.

use super::error::PrepareError;
use super::model::Model;
use super::report::{PiecesKind, Report, Why};
use crate::mesh::TriangleMesh;
use crate::pieces::patches::{Decomposition, Patch};
use crate::pieces::vhacd::Approximation;
use crate::solid::topology::Topology;
use crate::tree::hierarchy::build_hierarchy;
use ccd_core::{Hierarchy, Pieces, Polytope, Volume};

/// The pieces that were made of a mesh, by kind.
pub(super) enum Parts {
    Triangles,
    Patches(Decomposition),
    Hull(Box<Polytope>),
    Vhacd(Approximation),
}

/// The kind of pieces chosen for a mesh, with the pieces and the mesh's topology.
pub(super) struct Choice {
    pub(super) volume: Volume,
    pub(super) parts: Parts,
    pub(super) why: Why,
    pub(super) topology: Topology,
    /// A copy of the mesh with wrongly oriented shells reversed, if there are any.
    pub(super) turned: Option<TriangleMesh>,
}

/// The pieces of a body, and a hierarchy over them.
pub(super) struct PieceTree {
    pieces: Pieces,
    hierarchy: Hierarchy,
}

impl Choice {
    /// Creates the model. `triangles` are those of the mesh before any shell is reversed, if computed.
    pub(super) fn into_model(
        self,
        mesh: &TriangleMesh,
        triangles: Option<PieceTree>,
    ) -> Result<Model, PrepareError> {
        let volume = self.volume;
        let mut report = Report::new(self.parts.kind(), self.why, volume);
        let triangles = || match (triangles, &self.turned) {
            (Some(triangles), None) => Ok(triangles),
            (Some(triangles), Some(turned)) => triangles.with_corners_of(turned),
            (None, turned) => PieceTree::of_triangles(turned.as_ref().unwrap_or(mesh)),
        };
        let (tree, surface) = match self.parts {
            Parts::Triangles => (triangles()?, None),
            Parts::Patches(Decomposition { patches }) => {
                report.virtual_faces = patches.iter().map(Patch::virtual_facets).sum();
                let polytopes: Vec<Polytope> = patches.into_iter().map(|p| p.polytope).collect();
                (PieceTree::of_polytopes(&polytopes)?, None)
            }
            Parts::Hull(polytope) => (PieceTree::of_polytopes(&[*polytope])?, Some(triangles()?)),
            Parts::Vhacd(approximation) => {
                report.inflated_by = approximation.uncovered;
                report.sticks_out = approximation.sticks_out;
                let polytopes = &approximation.polytopes;
                report.virtual_faces = polytopes.iter().map(|p| p.facets.len()).sum();
                (PieceTree::of_polytopes(polytopes)?, None)
            }
        };
        report.triangles = mesh.faces().len();
        report.pieces = tree.pieces.len();
        report.tree_nodes = tree.hierarchy.nodes().len();
        report.topology = Some(self.topology);
        report.repairs = mesh.repairs().clone();
        Ok(Model {
            pieces: tree.pieces,
            hierarchy: tree.hierarchy,
            volume,
            hull_tree: None,
            surface: surface.map(|tree| (tree.pieces, tree.hierarchy)),
            report,
        })
    }
}

impl PieceTree {
    /// Creates one piece for each triangle of a mesh.
    pub(super) fn of_triangles(mesh: &TriangleMesh) -> Result<Self, PrepareError> {
        PieceTree::over(triangles(mesh)?)
    }

    fn of_polytopes(polytopes: &[Polytope]) -> Result<Self, PrepareError> {
        PieceTree::over(Pieces::polytopes(polytopes)?)
    }

    fn over(pieces: Pieces) -> Result<Self, PrepareError> {
        let hierarchy = build_hierarchy(&pieces)?;
        Ok(PieceTree { pieces, hierarchy })
    }

    /// Replaces the triangles by those of a mesh that differs only in the order of corners. The hierarchy stays
    /// valid.
    fn with_corners_of(self, turned: &TriangleMesh) -> Result<Self, PrepareError> {
        let pieces = triangles(turned)?;
        Ok(PieceTree { pieces, ..self })
    }
}

impl Parts {
    fn kind(&self) -> PiecesKind {
        match self {
            Parts::Triangles => PiecesKind::Triangles,
            Parts::Patches(_) => PiecesKind::Patches,
            Parts::Hull(_) => PiecesKind::Hull,
            Parts::Vhacd(_) => PiecesKind::Vhacd,
        }
    }
}

fn triangles(mesh: &TriangleMesh) -> Result<Pieces, PrepareError> {
    let pieces = Pieces::triangles(mesh.vertices(), &mesh.welded_faces(), mesh.face_ids());
    Ok(pieces?)
}
