//! Meshes made into bodies.

mod choose;
pub(crate) mod report;

use crate::error::BodyError;
use crate::mesh::TriangleMesh;
use crate::mesh::repair::Repairs;
use crate::pieces::convex::as_polytope;
use crate::pieces::patches::{Decomposition, Order, Patch, decompose};
use crate::pieces::vhacd::{Approximation, approximate};
use crate::prepare::report::{PiecesKind, Report, Why};
use crate::solid::manifold::Manifold;
use crate::solid::topology::Topology;
use crate::tree::hierarchy::build_hierarchy;
use crate::tree::hull_tree::build_hull_tree;
use ccd_core::{Body, Hierarchy, HullTree, Pieces, Polytope, Volume};

/// Of what pieces a body is to be made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Detail {
    /// The least that is exact: one hull for a convex solid, else patches or triangles, whichever is
    /// estimated to be faster for queries.
    #[default]
    Auto,
    /// One piece per triangle: exact for any mesh or soup.
    Triangles,
    /// Convex patches of the surface: exact, for meshes that bound a solid.
    Patches(Order),
    /// The solid itself: exact, for convex ones.
    Hull,
    /// Hulls about its parts: covers any mesh, and sticks out of it.
    Vhacd {
        /// How many hulls at most.
        hulls: u32,
    },
}

/// A body before its tree is built: what is stored in a file.
#[derive(Clone, Debug)]
pub struct Model {
    /// The convex pieces.
    pub pieces: Pieces,
    /// A hierarchy over them.
    pub hierarchy: Hierarchy,
    /// Whether being inside of it counts as touching it.
    pub volume: Volume,
    /// A tree of hulls over the pieces, for the schedules that use one.
    pub hull_tree: Option<HullTree>,
    /// The triangles of a convex solid's mesh, and a hierarchy over them: what it is against bodies of
    /// many triangles.
    pub surface: Option<(Pieces, Hierarchy)>,
    /// What the pieces are, and why.
    pub report: Report,
}

/// A body, and what it was made of.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Ready for queries.
    pub body: Body,
    /// What it was made of.
    pub report: Report,
}

/// Makes a body of a mesh: [`prepare`], and [`Model::body`].
///
/// # Guarantee
/// As [`prepare`].
///
/// # Errors
/// As [`prepare`].
pub fn body_from_mesh(mesh: &TriangleMesh, detail: Detail) -> Result<Prepared, BodyError> {
    prepare(mesh, detail)?.into_prepared()
}

/// Makes the pieces of a mesh, and a hierarchy over them.
///
/// # Guarantee
/// The pieces cover the mesh; but for [`Detail::Vhacd`] they touch nothing outside of the solid that it
/// bounds. The body is solid exactly when the mesh is closed, neighbours run the same way, and of shells
/// that are within others it is [clear](Topology::unclear) what they bound; shells that are inside out are
/// turned round, and the report says so. [`Detail::Auto`] and [`Detail::Triangles`] take any mesh.
///
/// # Errors
/// [`BodyError::Decompose`] when the mesh does not bound the kind of solid that was asked for,
/// [`BodyError::Vhacd`], [`BodyError::Input`] when there are too many pieces.
pub fn prepare(mesh: &TriangleMesh, detail: Detail) -> Result<Model, BodyError> {
    let (topology, turned) = Topology::and_turned(mesh);
    let mesh = turned.as_ref().unwrap_or(mesh);
    let (parts, why) = match detail {
        Detail::Auto => choose::choose(mesh, &topology),
        Detail::Triangles => (Parts::Triangles, Why::Asked),
        Detail::Patches(order) => (Parts::Patches(decompose(mesh, order)?), Why::Asked),
        Detail::Hull => {
            let polytope = as_polytope(&Manifold::new(mesh)?)?;
            (Parts::Hull(Box::new(polytope)), Why::Asked)
        }
        Detail::Vhacd { hulls } => {
            let approximation = approximate(mesh, &topology, hulls)?;
            (Parts::Vhacd(approximation), Why::Asked)
        }
    };
    parts.into_model(mesh, topology, why)
}

/// What a mesh is made into.
pub(crate) enum Parts {
    Triangles,
    Patches(Decomposition),
    Hull(Box<Polytope>),
    Vhacd(Approximation),
}

impl Parts {
    fn into_model(
        self,
        mesh: &TriangleMesh,
        topology: Topology,
        why: Why,
    ) -> Result<Model, BodyError> {
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

/// One piece per triangle, and a hierarchy over them.
fn surface_of(mesh: &TriangleMesh) -> Result<(Pieces, Hierarchy), BodyError> {
    let pieces = triangles(mesh)?;
    let hierarchy = build_hierarchy(&pieces)?;
    Ok((pieces, hierarchy))
}

fn triangles(mesh: &TriangleMesh) -> Result<Pieces, BodyError> {
    let pieces = Pieces::triangles(mesh.vertices(), &mesh.welded_faces(), mesh.face_ids());
    Ok(pieces?)
}

impl Model {
    /// Builds the body. O(n log n) in the number of pieces.
    ///
    /// # Errors
    /// [`BodyError::Input`], [`BodyError::HullTree`] when the parts do not belong together.
    pub fn body(&self) -> Result<Body, BodyError> {
        let mut body = Body::with_hierarchy(&self.pieces, &self.hierarchy, self.volume)?;
        if let Some((pieces, hierarchy)) = &self.surface {
            let surface = Body::with_hierarchy(pieces, hierarchy, Volume::Solid)?;
            body = body.with_surface(surface)?;
        }
        Ok(match &self.hull_tree {
            Some(tree) => body.with_hull_tree(tree.clone())?,
            None => body,
        })
    }

    /// Adds a hull tree over its pieces.
    ///
    /// # Errors
    /// [`BodyError::BuildHullTree`].
    pub fn with_hull_tree(mut self) -> Result<Self, BodyError> {
        self.hull_tree = Some(build_hull_tree(&self.pieces)?);
        Ok(self)
    }

    /// Builds the body, and keeps of the rest only the report.
    ///
    /// # Errors
    /// As [`Model::body`].
    pub fn into_prepared(self) -> Result<Prepared, BodyError> {
        Ok(Prepared {
            body: self.body()?,
            report: self.report,
        })
    }
}

impl Prepared {
    /// A body that was not made of a mesh.
    pub(crate) fn primitive(body: Body) -> Self {
        Prepared {
            report: Report {
                kind: PiecesKind::Primitive,
                why: Why::Asked,
                triangles: 0,
                pieces: body.pieces().len(),
                virtual_faces: 0,
                tree_nodes: 1,
                inflated_by: 0.0,
                sticks_out: 0.0,
                rebuilt_hulls: 0,
                volume: body.volume(),
                topology: None,
                repairs: Repairs::default(),
            },
            body,
        }
    }
}

#[cfg(test)]
mod tests;
