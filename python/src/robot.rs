//! The Python class `Robot`.

use crate::arrays::flat_numbers;
use crate::errors::{file_error, input_error};
use crate::motion::pose_matrix;
use crate::table::PyTable;
use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd_robot::{BodyElements, LinkMeeting, LinkPairs, MeshModel, Robot, Urdf};
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
        let positions = flat_numbers(configuration, "configuration")?;
        let pose = self.robot.pose(link, &positions).map_err(input_error)?;
        Ok(pose_matrix(py, &pose))
    }

    /// Decides for each pair of links with bodies whether they never touch, always, or sometimes, within the limits of all
    /// joints. "never" and "always" are proofs, and of "sometimes" there are two configurations as witnesses.
    ///
    /// Args:
    ///     max_boxes: the number of boxes of joint positions that are examined for a pair, each of about 10 microseconds.
    ///     srdf: an SRDF file to write, in which the pairs are disabled that need no check, each with the evidence.
    ///     name: the name of the robot in that file.
    ///
    /// Returns:
    ///     A table with a row for each pair: `link_a`, `link_b`, `evidence` ("never", "always", "sometimes" or
    ///     "undecided"), and `apart`, the share of the configurations for which an undecided pair is proven apart.
    #[pyo3(signature = (max_boxes = 100_000, *, srdf = None, name = "robot"))]
    fn acm(
        &self,
        py: Python<'_>,
        max_boxes: usize,
        srdf: Option<PathBuf>,
        name: &str,
    ) -> PyResult<PyTable> {
        let meetings = py.detach(|| self.robot.link_meetings(max_boxes));
        let meetings = meetings.map_err(input_error)?;
        if let Some(path) = srdf {
            let text = self.robot.srdf(name, &meetings);
            std::fs::write(&path, text).map_err(|error| file_error(&error, &path))?;
        }
        let batch = meeting_table(&self.robot, &meetings).map_err(input_error)?;
        Ok(PyTable { batch })
    }

    fn __repr__(&self) -> String {
        format!(
            "Robot({} links, joints {})",
            self.robot.links().len(),
            self.joint_names().join(", ")
        )
    }
}

fn meeting_table(
    robot: &Robot,
    meetings: &[([usize; 2], LinkMeeting)],
) -> Result<RecordBatch, ArrowError> {
    let names = |side: usize| -> ArrayRef {
        let links = meetings.iter().map(|(links, _)| links[side]);
        let names = links.map(|link| Some(robot.links()[link].name.as_str()));
        Arc::new(names.collect::<StringArray>())
    };
    let evidence = meetings.iter().map(|(_, meeting)| {
        Some(match meeting {
            LinkMeeting::Never => "never",
            LinkMeeting::Always => "always",
            LinkMeeting::Sometimes { .. } => "sometimes",
            LinkMeeting::Undecided { .. } => "undecided",
        })
    });
    let apart = meetings.iter().map(|(_, meeting)| match meeting {
        LinkMeeting::Undecided {
            proven_apart_share, ..
        } => Some(*proven_apart_share),
        _ => None,
    });
    let columns: [(&str, ArrayRef, bool); 4] = [
        ("link_a", names(0), false),
        ("link_b", names(1), false),
        (
            "evidence",
            Arc::new(evidence.collect::<StringArray>()),
            false,
        ),
        ("apart", Arc::new(apart.collect::<Float64Array>()), true),
    ];
    RecordBatch::try_from_iter_with_nullable(columns)
}

fn unknown(what: &str, given: &str, known: &str) -> PyErr {
    input_error(format!("{what}: '{given}' is not {known}"))
}
