//! The paper's five scenes `[FAST06 §6.2]`, and one small enough for the slowest method.

mod listing;
pub mod model;
#[cfg(test)]
pub(crate) mod tests;

pub use listing::{Listing, listings};

use crate::scene::model::Model;
use anyhow::{Context, Result};
use ccd_core::Body;
use ccd_decomp::{Detail, Order, PrepareError, TriangleMesh, body_from_mesh, prepare};
use rigid_ccd::batch::Bodies;
use rigid_ccd::table::motions::Motions;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// Two bodies, and many motions of them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name.
    pub name: String,
    /// Body A.
    pub a: SceneBody,
    /// Body B.
    pub b: SceneBody,
    /// Their motions.
    pub queries: Vec<Motions>,
}

/// A body of a scene, shared between scenes.
#[derive(Clone, Debug)]
pub struct SceneBody {
    /// The body, made of the fewest exact pieces.
    pub body: Arc<Body>,
    mesh: Arc<TriangleMesh>,
    /// The same body made of other pieces, each made on first use; `None` if it cannot be made.
    others: Arc<[OnceLock<Option<Body>>; Pieces::ALL.len()]>,
}

/// The kind of pieces of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Pieces {
    /// The fewest exact pieces.
    #[default]
    Least,
    /// One piece per triangle.
    Triangles,
    /// Patches of the surface under a hull tree, as in the paper.
    Patches,
    /// Convex hulls of parts, which may extend beyond the body.
    ApproximateHulls,
}

/// The largest number of approximate hulls of a body.
const HULLS: u32 = 32;

impl SceneBody {
    /// Returns the mesh.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Returns the number of triangles of the mesh.
    pub fn triangles(&self) -> usize {
        self.mesh.faces().len()
    }

    /// Returns the same body made of the given pieces, which are made on first use, or `None` if
    /// the mesh does not allow them.
    pub fn body_of(&self, pieces: Pieces) -> Option<&Body> {
        if pieces == Pieces::Least {
            return Some(&self.body);
        }
        let made = &self.others[pieces as usize];
        made.get_or_init(|| pieces.body_of(&self.mesh).ok())
            .as_ref()
    }
}

impl Pieces {
    /// All kinds.
    pub const ALL: [Pieces; 4] = [
        Pieces::Least,
        Pieces::Triangles,
        Pieces::Patches,
        Pieces::ApproximateHulls,
    ];

    /// Makes the body of a mesh.
    ///
    /// # Errors
    /// If the mesh does not allow such pieces.
    pub fn body_of(self, mesh: &TriangleMesh) -> Result<Body, PrepareError> {
        let detail = match self {
            Pieces::Least => Detail::Auto,
            Pieces::Triangles => Detail::Triangles,
            Pieces::Patches => Detail::Patches(Order::Cresting),
            Pieces::ApproximateHulls => Detail::Vhacd { hulls: HULLS },
        };
        let model = prepare(mesh, detail)?;
        match self {
            Pieces::Patches => model.with_hull_tree()?.body(),
            Pieces::Least | Pieces::Triangles | Pieces::ApproximateHulls => model.body(),
        }
    }
}

/// The bodies of models, each made once.
#[derive(Debug, Default)]
pub struct Models {
    directory: Option<PathBuf>,
    bodies: HashMap<Model, SceneBody>,
}

impl Scene {
    /// Returns both bodies.
    pub fn bodies(&self) -> Bodies<'_> {
        Bodies {
            a: &self.a.body,
            b: &self.b.body,
        }
    }

    /// Returns both bodies made of the given pieces, or `None` if a mesh does not allow them.
    pub fn bodies_of(&self, pieces: Pieces) -> Option<Bodies<'_>> {
        Some(Bodies {
            a: self.a.body_of(pieces)?,
            b: self.b.body_of(pieces)?,
        })
    }

    /// Returns the number of pairs of pieces, all of which a schedule without a tree processes.
    pub fn pairs(&self) -> u64 {
        self.a.body.pieces().len() as u64 * self.b.body.pieces().len() as u64
    }
}

impl Models {
    /// Uses models made by code, except those that have a file in the directory.
    pub fn new(directory: Option<PathBuf>) -> Self {
        Models {
            directory,
            bodies: HashMap::new(),
        }
    }

    /// Returns the body of a model.
    ///
    /// # Errors
    /// If the model's file is no mesh that a body can be made of.
    pub fn body(&mut self, model: Model) -> Result<SceneBody> {
        if let Some(body) = self.bodies.get(&model) {
            return Ok(body.clone());
        }
        let of_model = || format!("model {}", model.name());
        let mesh = model.load(self.directory.as_deref());
        let mesh = mesh.with_context(of_model)?;
        let prepared = body_from_mesh(&mesh, Detail::Auto).with_context(of_model)?;
        let body = SceneBody {
            body: Arc::new(prepared.body),
            mesh: Arc::new(mesh),
            others: Arc::default(),
        };
        self.bodies.insert(model, body.clone());
        Ok(body)
    }
}
