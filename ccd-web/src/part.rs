//! The parts that are thrown at each other: bodies, each with the triangles with which it is drawn.

use crate::shapes;
use rigid_ccd::mesh::{Detail, MeshError, PrepareError, TriangleMesh, body_from_mesh};
use rigid_ccd::{Body, InputError};
use serde_json::{Value, json};

/// A body, and the triangles with which it is drawn, in the same frame.
#[derive(Debug)]
pub struct Part {
    pub(crate) body: Body,
    surface: TriangleMesh,
    shape: Shape,
}

/// What a part is made of.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Cuboid([f64; 3]),
    Sphere(f64),
    Capsule(f64, f64),
    /// The triangles with which it is drawn.
    Mesh,
}

/// An error of creating a part or asking about a throw.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WebError {
    /// No part has this name.
    #[error("no part is called {0:?}; there are {names}", names = Part::NAMES.join(", "))]
    UnknownPart(String),
    /// The triangles of a part are no mesh.
    #[error(transparent)]
    BadMesh(#[from] MeshError),
    /// No body can be made of the mesh.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// A number of the part or the throw is out of range.
    #[error(transparent)]
    BadInput(#[from] InputError),
    /// The engine refuses the query that the throw makes.
    #[error(transparent)]
    RefusedQuery(#[from] rigid_ccd::Error),
}

impl Part {
    /// The names of the built-in parts.
    pub const NAMES: [&str; 8] = [
        "bullet", "coin", "rod", "ball", "knot", "sheet", "slot", "post",
    ];

    /// Creates a built-in part by its name, with lengths in metres.
    ///
    /// # Errors
    /// [`WebError::UnknownPart`].
    pub fn from_name(name: &str) -> Result<Self, WebError> {
        match name {
            "bullet" => Part::capsule(0.025, 0.035),
            "coin" => Part::cuboid([0.1, 0.1, 0.006]),
            "rod" => Part::capsule(0.02, 0.3),
            "ball" => Part::capsule(0.12, 0.0),
            "knot" => Part::from_mesh(shapes::knot(0.3, 0.05)?),
            "sheet" => Part::cuboid([0.001, 0.4, 0.4]),
            "slot" => Part::from_mesh(shapes::slotted_plate([0.02, 0.4, 0.45], [0.06, 0.36])?),
            "post" => Part::capsule(0.015, 0.45),
            _ => Err(WebError::UnknownPart(name.to_owned())),
        }
    }

    /// Returns the shape, and the vertices and faces with which it is drawn, as the page reads them.
    pub fn to_json(&self) -> Value {
        let shape = match self.shape {
            Shape::Cuboid(half) => json!(["box", half]),
            Shape::Sphere(radius) => json!(["sphere", radius]),
            Shape::Capsule(radius, half) => json!(["capsule", radius, half]),
            Shape::Mesh => json!(["mesh"]),
        };
        let vertices = self.surface.vertices().iter();
        let vertices: Vec<[f32; 3]> = vertices.map(|v| v.as_vec3().to_array()).collect();
        json!({ "shape": shape, "vertices": vertices.concat(), "faces": self.surface.faces().concat() })
    }
}

impl Part {
    fn cuboid(half: [f64; 3]) -> Result<Self, WebError> {
        let body = Body::cuboid(half)?;
        let surface = shapes::faces(&body)?;
        let shape = Shape::Cuboid(half);
        Ok(Part {
            body,
            surface,
            shape,
        })
    }

    fn capsule(radius: f64, half: f64) -> Result<Self, WebError> {
        let (body, shape) = if half > 0.0 {
            (Body::capsule(radius, half)?, Shape::Capsule(radius, half))
        } else {
            (Body::sphere(radius)?, Shape::Sphere(radius))
        };
        let surface = shapes::capsule(radius, half)?;
        Ok(Part {
            body,
            surface,
            shape,
        })
    }

    fn from_mesh(surface: TriangleMesh) -> Result<Self, WebError> {
        let body = body_from_mesh(&surface, Detail::Auto)?.body;
        Ok(Part {
            body,
            surface,
            shape: Shape::Mesh,
        })
    }
}

#[cfg(test)]
mod tests;
