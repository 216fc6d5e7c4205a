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
        let (mut inflated_by, mut sticks_out, mut rebuilt_hulls) = (0.0, 0.0, 0);
        let mut virtual_faces = 0;
        let (kind, pieces) = match self {
            Parts::Triangles => (PiecesKind::Triangles, triangles(mesh)?),
            Parts::Patches(Decomposition { patches }) => {
                virtual_faces = patches.iter().map(Patch::virtual_facets).sum();
                let polytopes: Vec<Polytope> = patches.into_iter().map(|p| p.polytope).collect();
                (PiecesKind::Patches, Pieces::polytopes(&polytopes)?)
            }
            Parts::Hull(polytope) => (PiecesKind::Hull, Pieces::polytopes(&[*polytope])?),
            Parts::Vhacd(approximation) => {
                inflated_by = approximation.uncovered;
                rebuilt_hulls = approximation.rebuilt;
                sticks_out = approximation.sticks_out;
                let polytopes = &approximation.polytopes;
                virtual_faces = polytopes.iter().map(|p| p.facets.len()).sum();
                (PiecesKind::Vhacd, Pieces::polytopes(polytopes)?)
            }
        };
        let hierarchy = build_hierarchy(&pieces)?;
        let is_hull = kind == PiecesKind::Hull;
        let surface = is_hull.then(|| surface_of(mesh)).transpose()?;
        Ok(Model {
            report: Report {
                kind,
                why,
                triangles: mesh.faces().len(),
                pieces: pieces.len(),
                virtual_faces,
                tree_nodes: hierarchy.nodes().len(),
                inflated_by,
                sticks_out,
                rebuilt_hulls,
                volume,
                topology: Some(topology),
                repairs: mesh.repairs().clone(),
            },
            pieces,
            hierarchy,
            volume,
            hull_tree: None,
            surface,
        })
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
