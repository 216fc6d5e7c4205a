//! Bodies from shapes, arrays and files.

use rigid_ccd::body::{SolidOfRevolution, Solidity};
use rigid_ccd::mesh::{
    AffineMap, Detail, Format, MeshFault, MeshFile, TriangleMesh, body_from_mesh,
};
use rigid_ccd::{InputError, Pose, Remark};
use std::sync::Arc;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// A rigid body, shared with the robots and cells that hold it.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) body: Arc<rigid_ccd::Body>,
    /// The largest side of its bounding box.
    pub(crate) size: f64,
    report: String,
}

/// A mesh that was read from a file.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Mesh(TriangleMesh);

#[wasm_bindgen]
impl Mesh {
    /// Reads a mesh in the format of its file name.
    ///
    /// # Errors
    /// What is wrong with the file, with its line or element.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, JsError> {
        let in_file = |fault: MeshFault| JsError::new(&format!("{name}: {fault}"));
        let format = Format::from_path(name).map_err(in_file)?;
        let mesh = MeshFile::from_reader(format, bytes);
        let mesh = mesh.and_then(MeshFile::into_mesh);
        Ok(Mesh(mesh.map_err(|error| in_file(error.fault))?))
    }

    /// Returns the vertices, three numbers each.
    pub fn positions(&self) -> Vec<f64> {
        let vertices = self.0.vertices().iter();
        vertices.flat_map(|vertex| vertex.to_array()).collect()
    }

    /// Returns the triangles, three vertex numbers each.
    pub fn indices(&self) -> Vec<u32> {
        self.0.faces().concat()
    }
}

#[wasm_bindgen]
impl Body {
    /// Makes a body of vertices, three numbers each, and of triangles, three vertex numbers each.
    ///
    /// # Errors
    /// The first vertex or triangle that is not valid.
    pub fn from_mesh(
        positions: &[f64],
        indices: &[u32],
        pieces: &str,
        is_surface: bool,
    ) -> Result<Self, JsError> {
        let vertices = positions.as_chunks::<3>().0.to_vec();
        let mesh = TriangleMesh::new(vertices, indices.as_chunks::<3>().0)?;
        Body::from_triangles(&mesh, detail(pieces, is_surface)?)
    }

    /// Reads a mesh in the format of its file name, and multiplies its coordinates by a factor.
    ///
    /// # Errors
    /// What is wrong with the file, with its line or element.
    pub fn from_file(
        name: &str,
        bytes: &[u8],
        scale: f64,
        pieces: &str,
        is_surface: bool,
    ) -> Result<Self, JsError> {
        let detail = detail(pieces, is_surface)?;
        let Mesh(mesh) = Mesh::read(name, bytes)?;
        if scale == 1.0 {
            return Body::from_triangles(&mesh, detail);
        }
        let map = AffineMap::from_scale_and_pose(scale, Pose::IDENTITY);
        Body::from_triangles(&mesh.transformed(map)?, detail)
    }

    /// Makes a box about its origin, of half extents.
    ///
    /// # Errors
    /// An extent that is not positive and finite.
    pub fn cuboid(x: f64, y: f64, z: f64) -> Result<Self, JsError> {
        let report = format!("box of half extents {x}, {y}, {z}");
        Body::from_shape(rigid_ccd::Body::cuboid([x, y, z]), report)
    }

    /// Makes a ball about its origin.
    ///
    /// # Errors
    /// A radius that is not positive and finite.
    pub fn sphere(radius: f64) -> Result<Self, JsError> {
        Body::from_shape(
            rigid_ccd::Body::sphere(radius),
            format!("ball of radius {radius}"),
        )
    }

    /// Makes a capsule along z.
    ///
    /// # Errors
    /// A length that is not positive and finite.
    pub fn capsule(radius: f64, half_height: f64) -> Result<Self, JsError> {
        let report = format!("capsule of radius {radius} and half height {half_height}");
        Body::from_shape(rigid_ccd::Body::capsule(radius, half_height), report)
    }

    /// Makes a polytope around a cylinder along z.
    ///
    /// # Errors
    /// A length that is not positive and finite, or an excess out of range.
    pub fn cylinder(radius: f64, half_height: f64, excess: Option<f64>) -> Result<Self, JsError> {
        let shape = SolidOfRevolution::cylinder(radius, half_height)?;
        Body::solid_of_revolution("cylinder", &shape, [radius, half_height], excess)
    }

    /// Makes a polytope around a cone along z with its apex up.
    ///
    /// # Errors
    /// A length that is not positive and finite, or an excess out of range.
    pub fn cone(radius: f64, half_height: f64, excess: Option<f64>) -> Result<Self, JsError> {
        let shape = SolidOfRevolution::cone(radius, half_height)?;
        Body::solid_of_revolution("cone", &shape, [radius, half_height], excess)
    }

    /// Returns whether the body fills its inside.
    pub fn is_solid(&self) -> bool {
        self.body.solidity() == Solidity::Solid
    }

    /// Returns how far the body may exceed its shape.
    pub fn excess(&self) -> f64 {
        self.body.excess()
    }

    /// Returns the number of convex pieces.
    pub fn piece_count(&self) -> usize {
        self.body.pieces().len()
    }

    /// Returns a description in words.
    pub fn report(&self) -> String {
        self.report.clone()
    }
}

impl Body {
    fn from_triangles(mesh: &TriangleMesh, detail: Detail) -> Result<Self, JsError> {
        let prepared = body_from_mesh(mesh, detail)?;
        let report = prepared.report.to_string();
        Ok(Body::new(prepared.body, report))
    }

    fn from_shape(
        body: Result<rigid_ccd::Body, InputError>,
        report: String,
    ) -> Result<Self, JsError> {
        Ok(Body::new(body?, report))
    }

    fn new(body: rigid_ccd::Body, report: String) -> Self {
        Body {
            size: Remark::body_size(&body),
            body: Arc::new(body),
            report,
        }
    }

    fn solid_of_revolution(
        name: &str,
        shape: &SolidOfRevolution,
        [radius, half_height]: [f64; 2],
        excess: Option<f64>,
    ) -> Result<Self, JsError> {
        let polytope = shape.enclosing_polytope(excess.unwrap_or(shape.default_excess()))?;
        let excess = polytope.excess();
        let report = format!(
            "{name} of radius {radius} and half height {half_height}, exceeded by up to {excess:.3e}"
        );
        Body::from_shape(polytope.body(), report)
    }
}

fn detail(pieces: &str, is_surface: bool) -> Result<Detail, JsError> {
    match pieces {
        "auto" | "triangles" if is_surface => Ok(Detail::Surface),
        "patches" | "hull" if is_surface => Err(JsError::new(&format!(
            "surface: {pieces} fill a solid; a hollow surface has pieces: \"triangles\""
        ))),
        "auto" => Ok(Detail::Auto),
        "triangles" => Ok(Detail::Triangles),
        "patches" => Ok(Detail::Patches(Default::default())),
        "hull" => Ok(Detail::Hull),
        _ => Err(JsError::new(&format!(
            "pieces: {pieces:?} is none of \"auto\", \"triangles\", \"patches\", \"hull\""
        ))),
    }
}
