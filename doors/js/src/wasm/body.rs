//! Bodies from shapes, arrays and files.

use super::fault::Fault;
use super::host::tell;
use rigid_ccd::body::{SolidOfRevolution, Solidity};
use rigid_ccd::mesh::{
    AffineMap, Format, MeshError, MeshFault, MeshFile, PieceChoice, TriangleMesh, Unit,
    body_from_mesh,
};
use rigid_ccd::text::Number;
use rigid_ccd::{InputError, Pose, Remark};
use std::sync::Arc;
use wasm_bindgen::prelude::wasm_bindgen;

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
pub struct Mesh {
    mesh: TriangleMesh,
    /// The unit of the coordinates: the requested one, or the one that the file states.
    unit: Option<Unit>,
}

#[wasm_bindgen]
impl Mesh {
    /// Reads a mesh file in the format that its name tells. Converts coordinates to `unit` if the file states another
    /// unit, then multiplies them by `scale`.
    ///
    /// # Errors
    /// The defect of the file, with its line or element.
    pub fn read(name: &str, bytes: &[u8], scale: f64, unit: Option<String>) -> Result<Self, Fault> {
        let in_file = |fault: MeshFault| Fault::plain(format!("{name}: {fault}"));
        let requested_unit = unit.map(|unit| unit.parse::<Unit>()).transpose()?;
        let format = Format::from_path(name).map_err(in_file)?;
        let read = || {
            let file = MeshFile::from_reader(format, bytes)?;
            let file = match requested_unit {
                Some(unit) => file.converted_to_unit(unit),
                None => file,
            };
            let (unit, mesh) = (file.unit(), file.into_mesh()?);
            let is_scaled = scale != 1.0;
            let map = AffineMap::from_scale_and_pose(scale, Pose::IDENTITY);
            let mesh = if is_scaled {
                mesh.transformed(map)?
            } else {
                mesh
            };
            // After scaling, the unit of the coordinates is known to the caller only.
            Ok(Mesh {
                mesh,
                unit: unit.filter(|_| !is_scaled),
            })
        };
        let mesh = read().map_err(|error: MeshError| in_file(error.fault))?;
        if requested_unit.is_none() {
            tell(Remark::remark_on_unit(mesh.unit));
        }
        Ok(mesh)
    }

    /// Returns the unit of the coordinates, or `None` if it is unknown.
    pub fn unit(&self) -> Option<String> {
        self.unit.map(|unit| unit.to_string())
    }

    /// Returns the vertices, three coordinates each.
    pub fn positions(&self) -> Vec<f64> {
        let vertices = self.mesh.vertices().iter();
        vertices.flat_map(|vertex| vertex.to_array()).collect()
    }

    /// Returns the triangles, three vertex indices each.
    pub fn indices(&self) -> Vec<u32> {
        self.mesh.faces().concat()
    }
}

#[wasm_bindgen]
impl Body {
    /// Makes a body from vertices, three coordinates each, and triangles, three vertex indices each.
    ///
    /// # Errors
    /// The first vertex or triangle that is not valid.
    pub fn from_mesh(
        positions: &[f64],
        indices: &[u32],
        pieces: &str,
        is_surface: bool,
    ) -> Result<Self, Fault> {
        let vertices = positions.as_chunks::<3>().0.to_vec();
        let mesh = TriangleMesh::new(vertices, indices.as_chunks::<3>().0)?;
        Body::from_triangles(&mesh, piece_choice(pieces, is_surface)?)
    }

    /// Makes a body from a mesh that was read from a file.
    ///
    /// # Errors
    /// A mesh that cannot be represented by pieces of this kind.
    pub fn from_read_mesh(mesh: &Mesh, pieces: &str, is_surface: bool) -> Result<Self, Fault> {
        Body::from_triangles(&mesh.mesh, piece_choice(pieces, is_surface)?)
    }

    /// Makes a box about its origin. The arguments are half extents.
    ///
    /// # Errors
    /// An extent that is not positive and finite.
    pub fn cuboid(x: f64, y: f64, z: f64) -> Result<Self, Fault> {
        let body = rigid_ccd::Body::cuboid([x, y, z]);
        let [x, y, z] = [x, y, z].map(Number);
        Body::from_shape(body, format!("box of half extents {x}, {y}, {z}"))
    }

    /// Makes a ball about its origin.
    ///
    /// # Errors
    /// A radius that is not positive and finite.
    pub fn sphere(radius: f64) -> Result<Self, Fault> {
        Body::from_shape(
            rigid_ccd::Body::sphere(radius),
            format!("ball of radius {}", Number(radius)),
        )
    }

    /// Makes a capsule along z.
    ///
    /// # Errors
    /// A length that is not positive and finite.
    pub fn capsule(radius: f64, half_height: f64) -> Result<Self, Fault> {
        let report = solid_report("capsule", [radius, half_height]);
        Body::from_shape(rigid_ccd::Body::capsule(radius, half_height), report)
    }

    /// Makes a cylinder along z. The body is a polytope that encloses it.
    ///
    /// # Errors
    /// A length that is not positive and finite, or an excess out of range.
    pub fn cylinder(radius: f64, half_height: f64, excess: Option<f64>) -> Result<Self, Fault> {
        let shape = SolidOfRevolution::cylinder(radius, half_height)?;
        Body::solid_of_revolution("cylinder", &shape, [radius, half_height], excess)
    }

    /// Makes a cone along z with its apex up. The body is a polytope that encloses it.
    ///
    /// # Errors
    /// A length that is not positive and finite, or an excess out of range.
    pub fn cone(radius: f64, half_height: f64, excess: Option<f64>) -> Result<Self, Fault> {
        let shape = SolidOfRevolution::cone(radius, half_height)?;
        Body::solid_of_revolution("cone", &shape, [radius, half_height], excess)
    }

    /// Returns whether the body is solid.
    pub fn is_solid(&self) -> bool {
        self.body.solidity() == Solidity::Solid
    }

    /// Returns an upper bound of how far the body extends beyond its shape.
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
    fn from_triangles(mesh: &TriangleMesh, choice: PieceChoice) -> Result<Self, Fault> {
        let prepared = body_from_mesh(mesh, choice)?;
        tell(Remark::remark_on_mesh(choice, mesh, &prepared.report));
        let report = prepared.report.to_string();
        Ok(Body::new(prepared.body, report))
    }

    fn from_shape(
        body: Result<rigid_ccd::Body, InputError>,
        report: String,
    ) -> Result<Self, Fault> {
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
    ) -> Result<Self, Fault> {
        let polytope = shape.enclosing_polytope(excess.unwrap_or(shape.default_excess()))?;
        let excess = polytope.excess();
        let description = solid_report(name, [radius, half_height]);
        let report = format!("{description}, exceeded by up to {excess:.3e}");
        Body::from_shape(polytope.body(), report)
    }
}

fn solid_report(name: &str, lengths: [f64; 2]) -> String {
    let [radius, half_height] = lengths.map(Number);
    format!("{name} of radius {radius} and half height {half_height}")
}

fn piece_choice(pieces: &str, is_surface: bool) -> Result<PieceChoice, Fault> {
    match pieces {
        "auto" | "triangles" if is_surface => Ok(PieceChoice::Surface),
        "patches" | "hull" | "outer-hull" if is_surface => Err(Fault::plain(format!(
            "surface: pieces \"{pieces}\" represent a solid; a hollow surface needs \"triangles\""
        ))),
        "auto" => Ok(PieceChoice::Auto),
        "triangles" => Ok(PieceChoice::Triangles),
        "patches" => Ok(PieceChoice::Patches(Default::default())),
        "hull" => Ok(PieceChoice::Hull),
        "outer-hull" => Ok(PieceChoice::OuterHull),
        // `doors/js/module/body.js` refuses unknown names earlier.
        _ => Err(Fault::plain(format!("pieces: {pieces:?}"))),
    }
}
