//! The Python class `Body`: made from arrays, files, trimesh and simple shapes, saved and pickled.

use crate::arrays::{finite_numbers, rows, triangles};
use crate::body_file::{BodyFile, parse_unit, read_adjustments, read_part};
use crate::errors::{InputError, file_error, input_error, warn, wrong_type_error};
use crate::interruptible::run_or_leave;
use crate::numbers::{read_number, read_optional_number};
use crate::pickle::{ConstructorCall, Reduced};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};
use rigid_ccd::body::{SolidOfRevolution, Solidity};
use rigid_ccd::glam::DVec3;
use rigid_ccd::mesh::{
    Adjustments, PieceChoice, StoreFault, StoredBodyContent, TriangleMesh, prepare,
};
use rigid_ccd::text::Number;
use rigid_ccd::{Body, Remark};
use std::borrow::Cow;
use std::path::PathBuf;

/// A rigid body: a mesh, a box, a ball, a capsule, a cylinder or a cone.
///
/// A mesh is solid if it is closed and consistently oriented. Otherwise it is a surface. A body inside a solid overlaps
/// it; a body inside a surface does not.
///
/// Args:
///     vertices: array of shape (n, 3), in any unit of length.
///     faces: array of shape (m, 3), indices of vertices from 0.
///     pieces: the kind of convex pieces that represent the mesh: "auto", "triangles", "patches", "hull" for a convex solid, or
///         "outer-hull", which encloses any mesh.
///     surface: whether a closed mesh is a hollow surface instead of a solid.
///
/// A mesh that is not closed gives a warning, unless `surface` is True. The warning also tells if only rounding keeps
/// the mesh open, as at the seam of a round shape. trimesh joins such vertices with `merge_vertices(merge_tex=True,
/// merge_norm=True)`.
///
/// Raises:
///     InputError: the mesh is invalid; the message names the element.
///
/// >>> from rigid_ccd import Body
/// >>> Body([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).is_solid
/// False
#[pyclass(name = "Body", module = "rigid_ccd", frozen)]
pub(crate) struct PyBody {
    pub(crate) body: Body,
    /// The largest side of the bounding box, in the body's unit of length.
    size: f64,
    pickle_data: PickleData,
    #[pyo3(get)]
    /// A description of the body: its shape and lengths, or the pieces that represent its mesh, with remarks.
    report: String,
}

/// The data from which unpickling makes the body again.
enum PickleData {
    Shape(ConstructorCall),
    Mesh(Box<StoredBodyContent>),
}

/// Extracts a `Body` from a Python argument. Errors name it as `argument_name`.
pub(crate) fn extract_body<'p>(
    argument: &'p Bound<'_, PyAny>,
    argument_name: &str,
) -> PyResult<&'p Body> {
    let needed = "a Body, as Body.from_file or Body.from_trimesh makes it,";
    match argument.cast::<PyBody>() {
        Ok(body) => Ok(&body.get().body),
        Err(_) => Err(wrong_type_error(argument_name, needed, argument)),
    }
}

/// Warns if the tolerance is large relative to the smaller of two bodies.
pub(crate) fn warn_of_large_tolerance(
    bodies: [&Bound<'_, PyAny>; 2],
    tolerance: f64,
    calls_up: i32,
) -> PyResult<()> {
    let size = |body: &Bound<'_, PyAny>| body.cast::<PyBody>().map_or(0.0, |body| body.get().size);
    let remark = Remark::remark_on_tolerance(tolerance, bodies.map(size));
    warn(bodies[0].py(), remark, calls_up)
}

#[pymethods]
impl PyBody {
    #[new]
    #[pyo3(signature = (vertices, faces, *, pieces = "auto", surface = false))]
    fn new(
        vertices: &Bound<'_, PyAny>,
        faces: &Bound<'_, PyAny>,
        pieces: &str,
        surface: bool,
    ) -> PyResult<Self> {
        let py = vertices.py();
        let points: Vec<DVec3> = rows::<3>(vertices, "vertices")?
            .into_iter()
            .map(DVec3::from)
            .collect();
        let faces = triangles(faces)?;
        let choice = piece_choice(pieces, surface)?;
        let bytes = size_of_val(&*faces) as u64;
        let result = run_or_leave(py, bytes, move || {
            let mesh = TriangleMesh::new(points, &faces).map_err(input_error)?;
            let model = prepare(&mesh, choice).map_err(input_error)?;
            let remark = Remark::remark_on_mesh(choice, &mesh, &model.report);
            Ok::<_, PyErr>((PyBody::from_model(model)?, remark))
        });
        let (body, remark) = result??;
        warn(py, remark, 1)?;
        Ok(body)
    }

    /// Reads a mesh file (.gltf, .glb, .dae, .obj, .stl, .ply, .off), or a prepared body (.ccd).
    ///
    /// Coordinates keep the unit that a COLLADA or glTF file states, unless `unit` converts them. A unit other than the
    /// metre gives a warning if you pass none of `unit`, `file_unit` and `scale`.
    ///
    /// Args:
    ///     path: the file.
    ///     part: the name or the index of a part of a scene; None for the whole scene.
    ///     unit: the unit to convert coordinates to: "um", "mm", "cm", "m", "in" or "ft". The unit of the file must be
    ///         known: by the format, for glTF and COLLADA, or by `file_unit`.
    ///     pieces: as for `Body`.
    ///     file_unit: the unit of the file's coordinates; it overrides the one that the file states.
    ///     scale: a factor on all coordinates.
    ///     mirror: "x", "y" or "z" changes the sign of that coordinate, and reverses the orientation of triangles.
    ///     surface: as for `Body`.
    ///
    /// Raises:
    ///     InputError: the file is not a valid mesh. A file that cannot be read raises OSError.
    #[classmethod]
    #[pyo3(signature = (
        path, *, part = None, unit = None, pieces = "auto", file_unit = None, scale = None, mirror = None, surface = false
    ))]
    // The keyword arguments of Python.
    #[allow(clippy::too_many_arguments)]
    fn from_file(
        class: &Bound<'_, PyType>,
        path: PathBuf,
        #[pyo3(from_py_with = read_part)] part: Option<String>,
        unit: Option<&str>,
        pieces: &str,
        file_unit: Option<&str>,
        #[pyo3(from_py_with = read_optional_number)] scale: Option<f64>,
        mirror: Option<&str>,
        surface: bool,
    ) -> PyResult<Self> {
        let adjustments = read_adjustments(file_unit, scale, mirror)?;
        let file = BodyFile {
            may_be_prepared: adjustments == Adjustments::NONE && !surface,
            keeps_numbers: unit.is_none() && file_unit.is_none() && scale.is_none(),
            adjustments: match parse_unit("unit", unit)? {
                Some(unit) => adjustments.with_target_unit(unit),
                None => adjustments,
            },
            path,
            part,
            choice: piece_choice(pieces, surface)?,
        };
        // If the file cannot be read, the reader reports it later.
        let file_bytes = std::fs::metadata(&file.path).map_or(0, |file| file.len());
        let read = move || {
            let (model, remarks) = file.read()?;
            Ok::<_, PyErr>((PyBody::from_model(model)?, remarks))
        };
        let (body, remarks) = run_or_leave(class.py(), file_bytes, read)??;
        warn(class.py(), remarks, 1)?;
        Ok(body)
    }

    /// Makes a body from a trimesh mesh, or from any object with `vertices` and `faces`.
    #[classmethod]
    #[pyo3(signature = (mesh, *, pieces = "auto", surface = false))]
    fn from_trimesh(
        _class: &Bound<'_, PyType>,
        mesh: &Bound<'_, PyAny>,
        pieces: &str,
        surface: bool,
    ) -> PyResult<Self> {
        let part = |name: &str| match mesh.getattr_opt(name)? {
            Some(values) => Ok(values),
            None if mesh.hasattr("to_mesh")? => Err(wrong_type_error(
                "mesh",
                "a mesh, such as scene.to_mesh(),",
                mesh,
            )),
            None => Err(wrong_type_error(
                "mesh",
                "an object with vertices and faces",
                mesh,
            )),
        };
        PyBody::new(&part("vertices")?, &part("faces")?, pieces, surface)
    }

    /// Makes a box about its origin.
    ///
    /// Args:
    ///     x, y, z: half extents.
    ///     size: full extents, in place of half extents, as in URDF, trimesh, Coal and Drake.
    #[classmethod]
    #[pyo3(signature = (x = None, y = None, z = None, *, size = None))]
    fn r#box(
        class: &Bound<'_, PyType>,
        #[pyo3(from_py_with = read_optional_number)] x: Option<f64>,
        #[pyo3(from_py_with = read_optional_number)] y: Option<f64>,
        #[pyo3(from_py_with = read_optional_number)] z: Option<f64>,
        size: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let [x, y, z] = match ([x, y, z], size) {
            ([Some(x), Some(y), Some(z)], None) => [x, y, z],
            ([None, None, None], Some(size)) => {
                finite_numbers(size, "size")?.map(|side| 0.5 * side)
            }
            _ => {
                let text = "box: half extents x, y and z are needed, or size alone";
                return Err(input_error(text));
            }
        };
        let report = {
            let [x, y, z] = [x, y, z].map(Number);
            format!("box of half extents {x}, {y}, {z}")
        };
        let recipe = ConstructorCall::new(class.py(), Some("box"), (x, y, z))?;
        PyBody::from_shape(Body::cuboid([x, y, z]), recipe, report)
    }

    /// Makes a ball about its origin.
    #[classmethod]
    fn sphere(
        class: &Bound<'_, PyType>,
        #[pyo3(from_py_with = read_number)] radius: f64,
    ) -> PyResult<Self> {
        let report = format!("ball of radius {}", Number(radius));
        let recipe = ConstructorCall::new(class.py(), Some("sphere"), (radius,))?;
        PyBody::from_shape(Body::sphere(radius), recipe, report)
    }

    /// Makes a capsule along z. `half_height` is the distance from its center to the center of either cap.
    #[classmethod]
    fn capsule(
        class: &Bound<'_, PyType>,
        #[pyo3(from_py_with = read_number)] radius: f64,
        #[pyo3(from_py_with = read_number)] half_height: f64,
    ) -> PyResult<Self> {
        let report = solid_report("capsule", radius, half_height);
        let recipe = ConstructorCall::new(class.py(), Some("capsule"), (radius, half_height))?;
        PyBody::from_shape(Body::capsule(radius, half_height), recipe, report)
    }

    /// Makes a cylinder along z. It is represented by an enclosing polytope, which extends beyond it by at most
    /// `excess`.
    ///
    /// Args:
    ///     radius: its radius.
    ///     half_height: half its length.
    ///     excess: the largest distance by which the polytope may extend beyond the cylinder, at least 1.9e-8 of the
    ///         radius; None for 1/4096 of the radius.
    #[classmethod]
    #[pyo3(signature = (radius, half_height, excess = None))]
    fn cylinder(
        class: &Bound<'_, PyType>,
        #[pyo3(from_py_with = read_number)] radius: f64,
        #[pyo3(from_py_with = read_number)] half_height: f64,
        #[pyo3(from_py_with = read_optional_number)] excess: Option<f64>,
    ) -> PyResult<Self> {
        let solid = SolidOfRevolution::cylinder(radius, half_height).map_err(input_error)?;
        PyBody::solid_of_revolution(
            class.py(),
            "cylinder",
            &solid,
            [radius, half_height],
            excess,
        )
    }

    /// Makes a cone along z with its apex up. It is represented by an enclosing polytope, like `Body.cylinder`.
    ///
    /// Args:
    ///     radius: the radius of its base.
    ///     half_height: half its length.
    ///     excess: as for `Body.cylinder`.
    #[classmethod]
    #[pyo3(signature = (radius, half_height, excess = None))]
    fn cone(
        class: &Bound<'_, PyType>,
        #[pyo3(from_py_with = read_number)] radius: f64,
        #[pyo3(from_py_with = read_number)] half_height: f64,
        #[pyo3(from_py_with = read_optional_number)] excess: Option<f64>,
    ) -> PyResult<Self> {
        let solid = SolidOfRevolution::cone(radius, half_height).map_err(input_error)?;
        PyBody::solid_of_revolution(class.py(), "cone", &solid, [radius, half_height], excess)
    }

    /// Whether the body is solid: another body inside it overlaps it.
    #[getter]
    fn is_solid(&self) -> bool {
        self.body.solidity() == Solidity::Solid
    }

    /// The largest distance by which the body may extend beyond the shape that it represents; 0 for exact bodies.
    /// Contacts may be early because of it, but never late. Upper bounds of distances include it.
    #[getter]
    fn excess(&self) -> f64 {
        self.body.excess()
    }

    /// The number of convex pieces of the body.
    #[getter]
    fn piece_count(&self) -> usize {
        self.body.pieces().len()
    }

    /// Writes the prepared body to a file. `Body.from_file` reads it much faster than a mesh.
    ///
    /// Args:
    ///     path: the file, which ends in .ccd by convention.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| {
            self.model()?
                .save(&path)
                .map_err(|error| match error.fault {
                    StoreFault::Unwritable(error) => file_error(&error, &path),
                    _ => input_error(error),
                })
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        match &slf.get().pickle_data {
            PickleData::Shape(recipe) => recipe.reduce_tuple(slf.get_type()),
            PickleData::Mesh(model) => {
                let (py, mut bytes) = (slf.py(), Vec::new());
                py.detach(|| model.write(&mut bytes)).map_err(input_error)?;
                ConstructorCall::new(py, Some("_from_bytes"), (PyBytes::new(py, &bytes),))?
                    .reduce_tuple(slf.get_type())
            }
        }
    }

    /// Makes a body from its pickled form.
    #[classmethod]
    fn _from_bytes(class: &Bound<'_, PyType>, stored: Vec<u8>) -> PyResult<Self> {
        let bytes = stored.len() as u64;
        let read = move || {
            let model = StoredBodyContent::read(stored.as_slice()).map_err(input_error)?;
            PyBody::from_model(model)
        };
        run_or_leave(class.py(), bytes, read)?
    }

    fn __repr__(&self) -> String {
        format!("Body({})", self.report)
    }
}

impl PyBody {
    fn with_pickle_data(body: Body, pickle_data: PickleData, report: String) -> Self {
        let size = Remark::body_size(&body);
        PyBody {
            body,
            size,
            pickle_data,
            report,
        }
    }

    fn from_model(model: StoredBodyContent) -> PyResult<Self> {
        let (body, report) = (model.body().map_err(input_error)?, model.report.to_string());
        let pickle_data = PickleData::Mesh(Box::new(model));
        Ok(PyBody::with_pickle_data(body, pickle_data, report))
    }

    fn from_shape(
        body: Result<Body, rigid_ccd::InputError>,
        recipe: ConstructorCall,
        report: String,
    ) -> PyResult<Self> {
        let body = body.map_err(input_error)?;
        Ok(PyBody::with_pickle_data(
            body,
            PickleData::Shape(recipe),
            report,
        ))
    }

    fn solid_of_revolution(
        py: Python<'_>,
        name: &'static str,
        solid: &SolidOfRevolution,
        [radius, half_height]: [f64; 2],
        excess: Option<f64>,
    ) -> PyResult<Self> {
        let enclosure = solid.enclosing_polytope(excess.unwrap_or(solid.default_excess()));
        let body = enclosure.and_then(|enclosure| enclosure.body());
        let body = body.map_err(input_error)?;
        let report = format!(
            "{}, exceeded by up to {:.3e}",
            solid_report(name, radius, half_height),
            body.excess()
        );
        let recipe = ConstructorCall::new(py, Some(name), (radius, half_height, excess))?;
        PyBody::from_shape(Ok(body), recipe, report)
    }

    fn model(&self) -> PyResult<Cow<'_, StoredBodyContent>> {
        match &self.pickle_data {
            PickleData::Mesh(model) => Ok(Cow::Borrowed(model)),
            PickleData::Shape(_) => Ok(Cow::Owned(
                StoredBodyContent::from_body(&self.body).map_err(input_error)?,
            )),
        }
    }
}

fn solid_report(name: &str, radius: f64, half_height: f64) -> String {
    let [radius, half_height] = [radius, half_height].map(Number);
    format!("{name} of radius {radius} and half height {half_height}")
}

fn piece_choice(name: &str, surface: bool) -> PyResult<PieceChoice> {
    match name {
        "auto" | "triangles" if surface => Ok(PieceChoice::Surface),
        "patches" | "hull" | "outer-hull" if surface => Err(InputError::new_err(format!(
            "surface: pieces=\"{name}\" represents a solid; a hollow surface needs pieces=\"triangles\""
        ))),
        "auto" => Ok(PieceChoice::Auto),
        "triangles" => Ok(PieceChoice::Triangles),
        "patches" => Ok(PieceChoice::Patches(Default::default())),
        "hull" => Ok(PieceChoice::Hull),
        "outer-hull" => Ok(PieceChoice::OuterHull),
        _ => Err(InputError::new_err(format!(
            "pieces: {name:?} is none of \"auto\", \"triangles\", \"patches\", \"hull\", \"outer-hull\""
        ))),
    }
}
