//! The paper's five scenes `[FAST06 §6.2]`, and one small enough for the slowest method.

mod listing;
mod shots;
#[cfg(test)]
mod tests;

pub use listing::{Listing, listings};
pub use shots::{Shots, drops_past_board};

use crate::model::{Model, Origin};
use crate::motions::Query;
use crate::query::Bodies;
use ccd_core::{Body, InputError};
use ccd_decomp::{BodyError, Detail, Order, TriangleMesh, body_from_mesh, prepare};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// Two bodies, and many motions of them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What it is called.
    pub name: String,
    /// The figure of the paper that shows it.
    pub figure: Option<u8>,
    /// Body A.
    pub a: SceneBody,
    /// Body B.
    pub b: SceneBody,
    /// Their motions.
    pub queries: Vec<Query>,
}

/// A body of a scene, shared with others.
#[derive(Clone, Debug)]
pub struct SceneBody {
    /// The body, of the least pieces that are exact.
    pub body: Arc<Body>,
    /// Where its mesh comes from.
    pub origin: Origin,
    mesh: Arc<TriangleMesh>,
    others: Arc<Others>,
}

/// The same body of other pieces, each made when it is first asked for; none where it cannot be.
#[derive(Debug, Default)]
struct Others {
    triangles: OnceLock<Option<Body>>,
    patches: OnceLock<Option<Body>>,
    hulls: OnceLock<Option<Body>>,
}

/// What pieces a body of a scene is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Pieces {
    /// The least that is exact.
    #[default]
    Least,
    /// A piece per triangle.
    Triangles,
    /// Patches of the surface under a hull tree, as the paper has them.
    Patches,
    /// Hulls that stick out of it.
    ApproximateHulls,
}

/// How many approximate hulls a body becomes at most.
const HULLS: u32 = 32;

impl SceneBody {
    /// Its mesh.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// How many triangles its mesh has.
    pub fn triangles(&self) -> usize {
        self.mesh.faces().len()
    }

    /// The same body made of such pieces, when it is first asked for; none where the mesh does not
    /// allow them.
    pub fn of(&self, pieces: Pieces) -> Option<&Body> {
        let make = |detail| body_from_mesh(&self.mesh, detail).ok().map(|p| p.body);
        let patches = || {
            let patches = prepare(&self.mesh, Detail::Patches(Order::Cresting)).ok()?;
            patches.with_hull_tree().ok()?.body().ok()
        };
        let others = &self.others;
        match pieces {
            Pieces::Least => return Some(&self.body),
            Pieces::Triangles => others.triangles.get_or_init(|| make(Detail::Triangles)),
            Pieces::Patches => others.patches.get_or_init(patches),
            Pieces::ApproximateHulls => others
                .hulls
                .get_or_init(|| make(Detail::Vhacd { hulls: HULLS })),
        }
        .as_ref()
    }
}

/// Why a scene cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A model is no body.
    #[error("model {name}: {source}")]
    Model {
        /// Its name.
        name: &'static str,
        /// Why.
        source: BodyError,
    },
    /// A motion is none.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The data of the scenes is not as it has to be.
    #[error("{what}: {problem}")]
    Data {
        /// Which part of it.
        what: String,
        /// Why.
        problem: String,
    },
}

/// Models made into bodies, each once.
#[derive(Debug, Default)]
pub struct Models {
    directory: Option<PathBuf>,
    bodies: HashMap<Model, SceneBody>,
}

impl Scene {
    /// Both bodies.
    pub fn bodies(&self) -> Bodies<'_> {
        Bodies {
            a: &self.a.body,
            b: &self.b.body,
        }
    }

    /// Both bodies made of such pieces; none where they cannot be had so.
    pub fn bodies_of(&self, pieces: Pieces) -> Option<Bodies<'_>> {
        Some(Bodies {
            a: self.a.of(pieces)?,
            b: self.b.of(pieces)?,
        })
    }

    /// How many pairs of pieces there are: what a schedule without a tree has to look at.
    pub fn pairs(&self) -> u64 {
        self.a.body.pieces().len() as u64 * self.b.body.pieces().len() as u64
    }
}

impl Models {
    /// Models made by code, but for those that have a file in the directory.
    pub fn new(directory: Option<PathBuf>) -> Self {
        Models {
            directory,
            bodies: HashMap::new(),
        }
    }

    /// The body of a model.
    ///
    /// # Errors
    /// When its file is none that a body can be made of.
    pub fn body(&mut self, model: Model) -> Result<SceneBody, SceneError> {
        if let Some(body) = self.bodies.get(&model) {
            return Ok(body.clone());
        }
        let name = model.name();
        let failed = |source| SceneError::Model { name, source };
        let loaded = model
            .load(self.directory.as_deref())
            .map_err(|error| failed(error.into()))?;
        let prepared =
            body_from_mesh(&loaded.mesh, Detail::Auto).map_err(|error| failed(error.into()))?;
        let body = SceneBody {
            body: Arc::new(prepared.body),
            origin: loaded.origin,
            mesh: Arc::new(loaded.mesh),
            others: Arc::default(),
        };
        self.bodies.insert(model, body.clone());
        Ok(body)
    }
}
