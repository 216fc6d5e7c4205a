//! The Python class `Robot`.

use crate::arrays::float64_array;
use crate::errors::input_error;
use crate::motion::pose_matrix;
use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd_robot::{BodyElements, LinkPairs, MeshModel, Robot, Urdf};
use std::path::PathBuf;
use std::sync::Arc;

/// A robot: a tree of links and joints, and the pairs of links that are checked.
///
/// A configuration has one position for each of `joint_names`, in that order: radians, or metres for joints that slide.
#[pyclass(name = "Robot", module = "rigid_ccd", frozen)]
pub(crate) struct PyRobot {
    pub(crate) robot: Arc<Robot>,
    pub(crate) pairs: LinkPairs,
}

#[pymethods]
impl PyRobot {
    /// Reads a robot from a URDF file and the mesh files that it names.
    ///
    /// Args:
    ///     path: the URDF file.
    ///     srdf: an SRDF file that names pairs of links which are not checked.
    ///     packages: folders that are searched first for `package://` names, before ROS_PACKAGE_PATH, AMENT_PREFIX_PATH
    ///         and the folders above the file.
    ///     geometry: "collision" or "visual", the elements of links that become bodies.
    ///     meshes: "exact", or "hull" for the convex hull of each mesh, which encloses it.
    ///
    /// Raises:
    ///     InputError: the file is no robot, or a mesh is missing; the message names the link or the joint.
    #[classmethod]
    #[pyo3(signature = (path, srdf = None, packages = None, *, geometry = "collision", meshes = "exact"))]
    fn from_urdf(
        class: &Bound<'_, PyType>,
        path: PathBuf,
        srdf: Option<PathBuf>,
        packages: Option<Vec<PathBuf>>,
        geometry: &str,
        meshes: &str,
    ) -> PyResult<Self> {
        let geometry = match geometry {
            "collision" => BodyElements::Collision,
            "visual" => BodyElements::Visual,
            _ => return Err(unknown("geometry", geometry, "collision or visual")),
        };
        let meshes = match meshes {
            "exact" => MeshModel::Exact,
            "hull" => MeshModel::OuterHull,
            _ => return Err(unknown("meshes", meshes, "exact or hull")),
        };
        let mut urdf = Urdf::at(path)
            .with_body_elements(geometry)
            .with_mesh_model(meshes);
        // The first folder is searched first.
        for folder in packages.into_iter().flatten().rev() {
            urdf = urdf.with_package_folder(folder);
        }
        class.py().detach(|| {
            let robot = urdf.read().map_err(input_error)?;
            let pairs = urdf.link_pairs(&robot, srdf.as_deref());
            Ok(PyRobot {
                pairs: pairs.map_err(input_error)?,
                robot: Arc::new(robot),
            })
        })
    }

    /// The names of the joints that have a position of their own, in the order of a configuration.
    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        self.robot.free_joint_names().collect()
    }

    /// The names of the links.
    #[getter]
    fn link_names(&self) -> Vec<&str> {
        let links = self.robot.links().iter();
        links.map(|link| link.name.as_str()).collect()
    }

    /// The limits of the positions, as an array of shape (joints, 2).
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let limits: Vec<f64> = self.robot.limits().flatten().collect();
        let array = numpy::PyArray1::from_vec(py, limits);
        Ok(array.reshape([self.robot.limits().len(), 2])?.into_any())
    }

    /// The pairs of links that are checked, by their names.
    #[getter]
    fn checked_pairs(&self) -> Vec<(&str, &str)> {
        let name = |link: usize| self.robot.links()[link].name.as_str();
        let pairs = self.pairs.checked_pairs();
        pairs.map(|[a, b]| (name(a), name(b))).collect()
    }

    /// Returns the pose of a link in the frame of the base, as a matrix of shape (4, 4).
    fn pose<'py>(
        &self,
        link: &str,
        configuration: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let py = configuration.py();
        let positions = float64_array(configuration, "configuration")?;
        let positions: Vec<f64> = positions.call_method0("ravel")?.extract()?;
        let pose = self.robot.pose(link, &positions).map_err(input_error)?;
        Ok(pose_matrix(py, &pose))
    }

    fn __repr__(&self) -> String {
        format!(
            "Robot({} links, joints {})",
            self.robot.links().len(),
            self.joint_names().join(", ")
        )
    }
}

fn unknown(what: &str, given: &str, known: &str) -> PyErr {
    input_error(format!("{what}: '{given}' is not {known}"))
}
