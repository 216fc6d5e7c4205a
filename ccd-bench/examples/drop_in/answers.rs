//! Answers to a row in one precision: this project's through parry's signatures, and parry's own.

use super::library::math::{Pose, Real, Vector};
use super::library::query::{
    self, NonlinearRigidMotion, ShapeCastHit, ShapeCastOptions, ShapeCastStatus, Unsupported,
};
use super::library::shape::SharedShape;
use super::shapes::{rigid_motion, vector};
use crate::Call;
use crate::judge::Reply;
use crate::rows::{Outline, Row};
use anyhow::Context;

/// A row in parry's types.
pub(crate) struct Question {
    shapes: [SharedShape; 2],
    motions: [NonlinearRigidMotion; 2],
    duration: Real,
    target: Real,
    stop: bool,
}

impl Question {
    /// Rounds all numbers of a row.
    pub(crate) fn new(row: &Row) -> anyhow::Result<Self> {
        Ok(Question {
            shapes: [shape(&row.shapes[0])?, shape(&row.shapes[1])?],
            motions: [rigid_motion(&row.query.a), rigid_motion(&row.query.b)],
            duration: row.query.duration as Real,
            target: row.margin as Real,
            stop: !row.leave,
        })
    }

    /// Answers it through this project.
    pub(crate) fn ours(&self, call: Call) -> Reply {
        use super::drop_in;
        reply(match call {
            Call::Nonlinear => {
                let ([m, n], [a, b]) = (&self.motions, &self.shapes);
                drop_in::cast_shapes_nonlinear(m, &**a, n, &**b, 0.0, self.duration, self.stop)
            }
            Call::Linear => {
                let ([(p, v), (q, w)], [a, b]) = (self.slides(), &self.shapes);
                drop_in::cast_shapes(&p, v, &**a, &q, w, &**b, self.options())
            }
        })
    }

    /// Answers it through parry, which may not return.
    pub(crate) fn theirs(&self, call: Call) -> Reply {
        reply(match call {
            Call::Nonlinear => {
                let ([m, n], [a, b]) = (&self.motions, &self.shapes);
                query::cast_shapes_nonlinear(m, &**a, n, &**b, 0.0, self.duration, self.stop)
            }
            Call::Linear => {
                let ([(p, v), (q, w)], [a, b]) = (self.slides(), &self.shapes);
                query::cast_shapes(&p, v, &**a, &q, w, &**b, self.options())
            }
        })
    }

    fn slides(&self) -> [(Pose, Vector); 2] {
        self.motions.map(|motion| (motion.start, motion.linvel))
    }

    fn options(&self) -> ShapeCastOptions {
        ShapeCastOptions {
            max_time_of_impact: self.duration,
            target_distance: self.target,
            stop_at_penetration: self.stop,
            compute_impact_geometry_on_penetration: true,
        }
    }
}

fn reply(answer: Result<Option<ShapeCastHit>, Unsupported>) -> Reply {
    match answer {
        Ok(None) => Reply::Free,
        Ok(Some(hit)) => Reply::Hit {
            time: f64::from(hit.time_of_impact),
            failed: matches!(
                hit.status,
                ShapeCastStatus::Failed | ShapeCastStatus::OutOfIterations
            ),
        },
        Err(Unsupported) => Reply::Unsupported,
    }
}

pub(crate) fn shape(outline: &Outline) -> anyhow::Result<SharedShape> {
    Ok(match outline {
        Outline::Ball(radius) => SharedShape::ball(*radius as Real),
        Outline::Box([x, y, z]) => SharedShape::cuboid(*x as Real, *y as Real, *z as Real),
        Outline::Capsule {
            radius,
            half_height,
        } => SharedShape::capsule_z(*half_height as Real, *radius as Real),
        Outline::Hull(vertices) => {
            let points: Vec<Vector> = vertices.iter().map(|&v| vector(v)).collect();
            SharedShape::convex_hull(&points).context("no hull")?
        }
        Outline::Mesh { vertices, faces } => {
            let corner = |k: u32| vector(vertices[k as usize]);
            match faces[..] {
                [[a, b, c]] if a == b || b == c || a == c => {
                    SharedShape::segment(corner(a), corner(if a == b { c } else { b }))
                }
                [[a, b, c]] => SharedShape::triangle(corner(a), corner(b), corner(c)),
                _ => SharedShape::trimesh(
                    vertices.iter().map(|&v| vector(v)).collect(),
                    faces.clone(),
                )?,
            }
        }
    })
}
