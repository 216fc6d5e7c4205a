//! The parts that are thrown at each other: bodies, each with the triangles with which it is drawn.

use crate::shapes;
use rigid_ccd::mesh::{
    AffineMap, Detail, Format, MeshError, MeshFault, MeshFile, PrepareError, TriangleMesh,
    body_from_mesh,
};
use rigid_ccd::{Body, InputError, Pose};
use wasm_bindgen::prelude::{JsError, JsValue, wasm_bindgen};

/// A body, and the triangles with which it is drawn, in the same frame.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Part {
    pub(crate) body: Body,
    surface: TriangleMesh,
}

/// An error of creating a part or asking about a throw.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WebError {
    /// No part has this name.
    #[error("no part is called {0:?}; there are {names}", names = Part::NAMES.join(", "))]
    UnknownPart(String),
    /// The name of the file has no known extension.
    #[error(transparent)]
    UnknownFormat(#[from] MeshFault),
    /// The file cannot be read as a mesh.
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
    /// A throw is given by a list that has more or fewer than nine numbers.
    #[error("a throw is nine numbers, not {0}")]
    WrongNumberCount(usize),
}

impl From<WebError> for JsValue {
    fn from(error: WebError) -> Self {
        JsError::from(error).into()
    }
}

impl Part {
    /// The names of the built-in parts.
    pub const NAMES: [&str; 8] = [
        "bullet", "coin", "rod", "ball", "knot", "sheet", "slot", "post",
    ];
}

#[wasm_bindgen]
impl Part {
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

    /// Reads a mesh, in the format of its file name, and scales it to a size around its centre.
    ///
    /// # Errors
    /// [`WebError`] if the file is no mesh.
    pub fn from_file(name: &str, bytes: &[u8], size: f64) -> Result<Self, WebError> {
        let mesh = MeshFile::from_reader(Format::from_path(name)?, bytes)?.into_mesh()?;
        let [low, high] = mesh.bounding_box();
        let scale = size / (high - low).length();
        let middle = 0.5 * low + 0.5 * high;
        Part::from_mesh(mesh.transformed(AffineMap::from_scale_and_pose(
            scale,
            Pose::at(-middle * scale)?,
        ))?)
    }

    /// Returns the drawn vertices, three numbers each.
    pub fn vertices(&self) -> Vec<f32> {
        let vertices = self.surface.vertices().iter();
        vertices.flat_map(|v| v.as_vec3().to_array()).collect()
    }

    /// Returns the drawn faces, three vertex numbers each.
    pub fn faces(&self) -> Vec<u32> {
        self.surface.faces().concat()
    }

    /// Returns the greatest distance of a drawn vertex from the part's origin, in metres.
    pub fn reach(&self) -> f64 {
        let lengths = self.surface.vertices().iter().map(|v| v.length());
        lengths.max_by(f64::total_cmp).unwrap_or(0.0)
    }
}

impl Part {
    fn cuboid(half: [f64; 3]) -> Result<Self, WebError> {
        let body = Body::cuboid(half)?;
        let surface = shapes::faces(&body)?;
        Ok(Part { body, surface })
    }

    fn capsule(radius: f64, half: f64) -> Result<Self, WebError> {
        let body = if half > 0.0 {
            Body::capsule(radius, half)?
        } else {
            Body::sphere(radius)?
        };
        let surface = shapes::capsule(radius, half)?;
        Ok(Part { body, surface })
    }

    fn from_mesh(surface: TriangleMesh) -> Result<Self, WebError> {
        let body = body_from_mesh(&surface, Detail::Auto)?.body;
        Ok(Part { body, surface })
    }
}

#[cfg(test)]
mod tests;
