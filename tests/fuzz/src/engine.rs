//! Runs the engine through its public interface.

use crate::case::{Case, MeshClass, Shape};
use ccd_core::glam::DVec3;
use ccd_core::schedule::{BestFirst, Fast, Naive};
use ccd_core::{Answer, Body, DistanceOracle, MovingBody, OrElse, Polytope, Schedule, Settings};
use ccd_decomp::{PieceChoice, TriangleMesh, prepare};
use ccd_distance_gjk::{Direct, Gjk};
use ccd_distance_vmarch::Vmarch;
use std::fmt;

/// The kind of pieces of both bodies. A body whose form does not allow it has triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceKind {
    Triangles,
    Patches,
    Hull,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Direct,
    Gjk,
    Vmarch,
    Naive,
    Fast,
}

/// The engine's bodies of a case, made of one kind of pieces.
pub struct Bodies {
    pub bodies: [Body; 2],
    pub kind: PieceKind,
}

impl Bodies {
    /// Makes the engine's bodies of a case, of pieces of the given kind if the shapes allow them.
    ///
    /// # Errors
    /// The reason why the engine refuses the meshes.
    pub fn new(case: &Case, kind: PieceKind, trees: HullTrees) -> Result<Self, String> {
        let body = |shape: &Shape| body(shape, kind, trees);
        let [a, b] = &case.shapes;
        Ok(Bodies {
            bodies: [body(a)?, body(b)?],
            kind,
        })
    }

    /// Builds the engine's query from a case, with these bodies as its shapes.
    ///
    /// # Errors
    /// The reason why the engine refuses the query.
    pub fn problem<'a>(
        &'a self,
        case: &Case,
        config: &'a Settings,
    ) -> Result<ccd_core::Query<'a>, String> {
        let moving = |k: usize| -> Result<MovingBody<'_>, String> {
            let motion = case.motions[k]
                .motion(case.duration)
                .map_err(|e| e.to_string())?;
            Ok(MovingBody::from((&self.bodies[k], motion)))
        };
        ccd_core::Query::new(moving(0)?, moving(1)?, case.duration, config)
            .map_err(|e| e.to_string())
    }
}

/// Whether bodies have hull trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HullTrees {
    NotBuilt,
    Built,
}

fn body(shape: &Shape, kind: PieceKind, trees: HullTrees) -> Result<Body, String> {
    let vertices = || shape.vertices.iter().map(|&v| DVec3::from(v)).collect();
    if shape.mesh_class == MeshClass::VertexHull {
        let polytope = Polytope {
            points: vertices(),
            ..Polytope::default()
        };
        return Body::polytope(polytope).map_err(|e| e.to_string());
    }
    let choice = match (kind, shape.mesh_class) {
        (PieceKind::Hull, MeshClass::Convex) => PieceChoice::Hull,
        (PieceKind::Patches, MeshClass::Convex | MeshClass::Solid) => {
            PieceChoice::Patches(Default::default())
        }
        _ => PieceChoice::Triangles,
    };
    let mesh = TriangleMesh::new(vertices(), &shape.faces).map_err(|e| e.to_string())?;
    let model = prepare(&mesh, choice)
        // Rounding may make a shape that was meant to be convex slightly concave.
        .or_else(|_| prepare(&mesh, PieceChoice::Triangles))
        .map_err(|e| e.to_string())?;
    let model = match trees {
        HullTrees::Built => model.with_hull_tree().map_err(|e| e.to_string())?,
        HullTrees::NotBuilt => model,
    };
    model.body().map_err(|e| e.to_string())
}

impl Method {
    pub fn solve(self, problem: &ccd_core::Query<'_>) -> Answer {
        fn solve_with_schedule<O: DistanceOracle + Default, S: Schedule<O>>(
            mut schedule: S,
            problem: &ccd_core::Query<'_>,
        ) -> Answer {
            schedule.first_contact(problem, &mut O::default()).unwrap()
        }
        match self {
            Method::Direct => solve_with_schedule(BestFirst::<Direct>::default(), problem),
            Method::Gjk => solve_with_schedule(BestFirst::<Gjk>::default(), problem),
            Method::Vmarch => {
                solve_with_schedule(BestFirst::<OrElse<Vmarch, Gjk>>::default(), problem)
            }
            Method::Naive => solve_with_schedule(Naive::<Direct>::default(), problem),
            Method::Fast => solve_with_schedule(Fast::<Gjk>::default(), problem),
        }
    }

    pub fn trees(self) -> HullTrees {
        match self {
            Method::Fast => HullTrees::Built,
            _ => HullTrees::NotBuilt,
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Method::Direct => "--oracle direct",
            Method::Gjk => "--oracle gjk",
            Method::Vmarch => "--oracle vmarch",
            Method::Naive => "--schedule naive",
            Method::Fast => "--schedule fast --oracle gjk",
        })
    }
}

impl fmt::Display for PieceKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            PieceKind::Triangles => "--pieces triangles",
            PieceKind::Patches => "--pieces patches",
            PieceKind::Hull => "--pieces hull",
        })
    }
}
