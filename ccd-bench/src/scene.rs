//! The paper's five scenes `[FAST06 §6.2]`, and one small enough for the slowest method.

mod fall;
mod shots;
#[cfg(test)]
mod tests;

pub use fall::Fall;
pub use shots::{Shots, drops_past_board};

use crate::engine::ScheduleKind;
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
    /// The body.
    pub body: Arc<Body>,
    /// Where its mesh comes from.
    pub origin: Origin,
    mesh: Arc<TriangleMesh>,
    patches: Arc<OnceLock<Option<Body>>>,
}

impl SceneBody {
    /// How many triangles its mesh has.
    pub fn triangles(&self) -> usize {
        self.mesh.faces().len()
    }

    /// The same body as the paper has it, made when it is first asked for: patches of the surface
    /// under a hull tree. None where the mesh bounds no solid.
    pub fn patches(&self) -> Option<&Body> {
        let make = || {
            let patches = prepare(&self.mesh, Detail::Patches(Order::Cresting)).ok()?;
            patches.with_hull_tree().ok()?.body().ok()
        };
        self.patches.get_or_init(make).as_ref()
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

    /// Both bodies as a schedule wants them; none where they cannot be had so.
    pub fn bodies_for(&self, schedule: ScheduleKind) -> Option<Bodies<'_>> {
        match schedule.uses_hull_trees() {
            true => Some(Bodies {
                a: self.a.patches()?,
                b: self.b.patches()?,
            }),
            false => Some(self.bodies()),
        }
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
        let prepared = body_from_mesh(&loaded.mesh, Detail::Auto).map_err(failed)?;
        let body = SceneBody {
            body: Arc::new(prepared.body),
            origin: loaded.origin,
            mesh: Arc::new(loaded.mesh),
            patches: Arc::default(),
        };
        self.bodies.insert(model, body.clone());
        Ok(body)
    }
}

/// A scene by what it takes to make it.
type Recipe = fn(&mut Models) -> Result<Scene, SceneError>;

/// All scenes, each made when it is called for.
pub const SCENES: [Recipe; 8] = [
    santa_and_board,
    bunnies,
    |models| knots(models, Model::Knot2880),
    |models| knots(models, Model::Knot11520),
    |models| knots(models, Model::Knot34560),
    falling_bunnies,
    falling_rings,
    small_knots,
];

/// Scene 1: Santa tries to get past a board at many heights.
fn santa_and_board(models: &mut Models) -> Result<Scene, SceneError> {
    Ok(Scene {
        name: "Santa and board".into(),
        a: models.body(Model::Santa)?,
        b: models.body(Model::Board)?,
        queries: drops_past_board(100, 1)?,
    })
}

/// Scene 2: a bunny is shot past or at a resting one.
fn bunnies(models: &mut Models) -> Result<Scene, SceneError> {
    let bunny = models.body(Model::Bunny70k)?;
    let shots = Shots {
        count: 250,
        translations: 100,
        distance: 2.6..3.2,
        aside: 1.6,
        seed: 2,
    };
    Ok(Scene {
        name: "bunny and bunny".into(),
        a: bunny.clone(),
        b: bunny,
        queries: shots.queries()?,
    })
}

/// Scene 3: a torus knot is shot past, at or through a resting one.
fn knots(models: &mut Models, model: Model) -> Result<Scene, SceneError> {
    let knot = models.body(model)?;
    let shots = Shots {
        count: 250,
        translations: 100,
        distance: 3.0..3.8,
        aside: 2.3,
        seed: 3,
    };
    Ok(Scene {
        name: "knot and knot".into(),
        a: knot.clone(),
        b: knot,
        queries: shots.queries()?,
    })
}

/// Scene 4: bunnies fall onto a resting one, tumbling, step by step until they touch it.
fn falling_bunnies(models: &mut Models) -> Result<Scene, SceneError> {
    falling(models, Model::Bunny26k, "falling bunnies", 4)
}

/// Scene 5: the same with rings.
fn falling_rings(models: &mut Models) -> Result<Scene, SceneError> {
    falling(models, Model::Ring, "falling rings", 5)
}

fn falling(models: &mut Models, model: Model, name: &str, seed: u64) -> Result<Scene, SceneError> {
    let body = models.body(model)?;
    let fall = Fall {
        drops: 24,
        height: 2.4,
        reach: 2.0,
        aside: 0.8,
        spin: 6.0,
        seed,
    };
    let bodies = Bodies {
        a: &body.body,
        b: &body.body,
    };
    Ok(Scene {
        name: name.into(),
        queries: fall.queries(bodies)?,
        a: body.clone(),
        b: body,
    })
}

/// Not the paper's: scene 3 with so few triangles that all pairs of them can be looked at.
fn small_knots(models: &mut Models) -> Result<Scene, SceneError> {
    let mut scene = knots(models, Model::Knot216)?;
    // Both kinds of motion, in the same proportion.
    scene.queries = scene.queries.into_iter().step_by(10).collect();
    Ok(scene)
}
