//! The pieces of a mesh, and the model that is made of them.

use super::error::PrepareError;
use super::model::Model;
use super::report::{PiecesKind, Report, Why};
use crate::mesh::TriangleMesh;
use crate::pieces::patches::{Decomposition, Patch};
use crate::pieces::vhacd::Approximation;
use crate::solid::topology::Topology;
use crate::tree::hierarchy::build_hierarchy;
use ccd_core::{Hierarchy, Pieces, Polytope, Volume};

/// The pieces of a mesh, by kind.
pub(super) enum Parts {
    Triangles,
    Patches(Decomposition),
    Hull(Box<Polytope>),
    Vhacd(Approximation),
}

impl Parts {
    pub(super) fn into_model(
        self,
        mesh: &TriangleMesh,
        topology: Topology,
        why: Why,
    ) -> Result<Model, PrepareError> {
        let volume = match topology.is_solid() {
            true => Volume::Solid,
            false => Volume::Surface,
        };
        let mut report = Report::new(self.kind(), why, volume);
        let pieces = match self {
            Parts::Triangles => triangles(mesh)?,
            Parts::Patches(Decomposition { patches }) => {
                report.virtual_faces = patches.iter().map(Patch::virtual_facets).sum();
                let polytopes: Vec<Polytope> = patches.into_iter().map(|p| p.polytope).collect();
                Pieces::polytopes(&polytopes)?
            }
            Parts::Hull(polytope) => Pieces::polytopes(&[*polytope])?,
            Parts::Vhacd(approximation) => {
                report.inflated_by = approximation.uncovered;
                report.rebuilt_hulls = approximation.rebuilt;
                report.sticks_out = approximation.sticks_out;
                let polytopes = &approximation.polytopes;
                report.virtual_faces = polytopes.iter().map(|p| p.facets.len()).sum();
                Pieces::polytopes(polytopes)?
            }
        };
        let hierarchy = build_hierarchy(&pieces)?;
        let is_hull = report.kind == PiecesKind::Hull;
        let surface = is_hull.then(|| surface_of(mesh)).transpose()?;
        report.triangles = mesh.faces().len();
        report.pieces = pieces.len();
        report.tree_nodes = hierarchy.nodes().len();
        report.topology = Some(topology);
        report.repairs = mesh.repairs().clone();
        Ok(Model {
            pieces,
            hierarchy,
            volume,
            hull_tree: None,
            surface,
            report,
        })
    }

    fn kind(&self) -> PiecesKind {
        match self {
            Parts::Triangles => PiecesKind::Triangles,
            Parts::Patches(_) => PiecesKind::Patches,
            Parts::Hull(_) => PiecesKind::Hull,
            Parts::Vhacd(_) => PiecesKind::Vhacd,
        }
    }
}

/// Makes one piece of every triangle, and a hierarchy over them.
fn surface_of(mesh: &TriangleMesh) -> Result<(Pieces, Hierarchy), PrepareError> {
    let pieces = triangles(mesh)?;
    let hierarchy = build_hierarchy(&pieces)?;
    Ok((pieces, hierarchy))
}

fn triangles(mesh: &TriangleMesh) -> Result<Pieces, PrepareError> {
    let pieces = Pieces::triangles(mesh.vertices(), &mesh.welded_faces(), mesh.face_ids());
    Ok(pieces?)
}
