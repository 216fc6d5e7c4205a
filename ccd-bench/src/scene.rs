//! The paper's five scenes `[FAST06 §6.2]`, and one small enough for the slowest method.

mod listing;
pub mod model;
#[cfg(test)]
pub(crate) mod tests;

pub use listing::{SceneDescription, scene_descriptions};

use crate::scene::model::Model;
use anyhow::{Context, Result};
use ccd_core::Body;
use ccd_decomp::{PatchOrder, PieceChoice, PrepareError, TriangleMesh, body_from_mesh, prepare};
use ccd_tables::batch::BodyPair;
use ccd_tables::motions::Motions;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// Two bodies, and many queries that move them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name of the scene in tables.
    pub name: String,
    /// The body that the first motion of each query moves.
    pub a: SceneBody,
    /// The body that the second motion of each query moves.
    pub b: SceneBody,
    /// The queries, each with the motions of both bodies and a duration.
    pub queries: Vec<Motions>,
}

/// A body of one or several scenes, with the mesh from which it is made.
#[derive(Clone, Debug)]
pub struct SceneBody {
    /// The body, made of the fewest exact pieces.
    pub body: Arc<Body>,
    mesh: Arc<TriangleMesh>,
    /// The same body made of other kinds of pieces, one slot for each kind, filled on first use; `None` in a slot if
    /// the mesh does not allow the kind.
    bodies_by_piece_kind: Arc<[OnceLock<Option<Body>>; PieceKind::Patches as usize + 1]>,
}

/// The kind of convex pieces that a body is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PieceKind {
    /// The fewest pieces that represent the mesh exactly.
    #[default]
    FewestPieces,
    /// One piece per triangle of the mesh.
    Triangles,
    /// Convex patches of the surface, with a hull tree over them `[FAST06 §3.3]`.
    Patches,
}

impl SceneBody {
    /// Returns the mesh from which the body is made.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Returns the same body made of the given kind of pieces; `None` if the mesh does not allow them.
    pub fn body_with_pieces(&self, pieces: PieceKind) -> Option<&Body> {
        if pieces == PieceKind::FewestPieces {
            return Some(&self.body);
        }
        let made = &self.bodies_by_piece_kind[pieces as usize];
        made.get_or_init(|| pieces.make_body(&self.mesh).ok())
            .as_ref()
    }
}

impl PieceKind {
    /// Makes a body of this kind of pieces from a mesh.
    ///
    /// # Errors
    /// If the mesh does not allow such pieces.
    pub fn make_body(self, mesh: &TriangleMesh) -> Result<Body, PrepareError> {
        let choice = match self {
            PieceKind::FewestPieces => PieceChoice::Auto,
            PieceKind::Triangles => PieceChoice::Triangles,
            PieceKind::Patches => PieceChoice::Patches(PatchOrder::Cresting),
        };
        let model = prepare(mesh, choice)?;
        match self {
            PieceKind::Patches => model.with_hull_tree()?.body(),
            PieceKind::FewestPieces | PieceKind::Triangles => model.body(),
        }
    }
}

/// A cache of the bodies of the models, each of which is made on first use.
#[derive(Debug, Default)]
pub struct ModelBodyCache {
    model_folder: Option<PathBuf>,
    body_by_model: HashMap<Model, SceneBody>,
}

impl Scene {
    /// Returns both bodies of the scene, made of the fewest exact pieces.
    pub fn bodies(&self) -> BodyPair<'_> {
        BodyPair {
            a: &self.a.body,
            b: &self.b.body,
        }
    }

    /// Returns both bodies made of the given kind of pieces; `None` if a mesh does not allow them.
    pub fn bodies_with_pieces(&self, pieces: PieceKind) -> Option<BodyPair<'_>> {
        Some(BodyPair {
            a: self.a.body_with_pieces(pieces)?,
            b: self.b.body_with_pieces(pieces)?,
        })
    }

    /// Returns the number of pairs of pieces of the two bodies, all of which the naive schedule processes.
    pub fn piece_pair_count(&self) -> u64 {
        self.a.body.pieces().len() as u64 * self.b.body.pieces().len() as u64
    }
}

impl ModelBodyCache {
    /// Creates an empty cache, which reads a model from its file in the directory if there is one.
    pub fn new(directory: Option<PathBuf>) -> Self {
        ModelBodyCache {
            model_folder: directory,
            body_by_model: HashMap::new(),
        }
    }

    /// Returns the body of a model, which is made on first use.
    ///
    /// # Errors
    /// If the model's file is no mesh that a body can be made of.
    pub fn model_body(&mut self, model: Model) -> Result<SceneBody> {
        if let Some(body) = self.body_by_model.get(&model) {
            return Ok(body.clone());
        }
        let of_model = || format!("model {}", model.name());
        let mesh = model.load_or_generate(self.model_folder.as_deref());
        let mesh = mesh.with_context(of_model)?;
        let prepared = body_from_mesh(&mesh, PieceChoice::Auto).with_context(of_model)?;
        let body = SceneBody {
            body: Arc::new(prepared.body),
            mesh: Arc::new(mesh),
            bodies_by_piece_kind: Arc::default(),
        };
        self.body_by_model.insert(model, body.clone());
        Ok(body)
    }
}
