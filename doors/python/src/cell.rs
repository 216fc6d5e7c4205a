//! The Python class `Cell`.

use crate::cell_contents::{CellContents, Contact};
use crate::cell_remarks::{remark_texts, warn_of, warning_text};
use crate::cell_state::{CellState, read_body};
use crate::errors::wrong_type_error;
use crate::motion::{GivenPose, read_given_pose};
use crate::numbers::read_number;
use crate::path_answers::{approach_object, check_resolved, contact_object};
use crate::path_array::GivenPaths;
use crate::path_questions::{answer_path, path_ranges};
use crate::path_tables::{GivenQuestion, answer_paths};
use crate::proofs::prove_path;
use crate::robot::PyRobot;
use crate::settings::{REPORTING_START, names, read};
use crate::table::PyTable;
use ccd_tables::path_rows::PathRow;
use ccd_tables::results::Status;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use rigid_ccd::{Body, Question};
use rigid_ccd_robot::{Cell, CellRemark, RangeSettings};

/// A cell (planning scene): a robot among obstacles that are static in the frame of its base.
///
/// A path is an array of shape (n, joints): a sequence of configurations, between which all joints move at constant
/// rates. An array of shape (joints,) is a single configuration. In a data frame, columns have the names of joints,
/// with the suffix `_deg` for degrees.
///
/// A path may also be a curve of up to degree 9, in one of two forms. The first is a `scipy.interpolate.PPoly`, such as
/// `CubicSpline`, or any object with the same breakpoints `x` and coefficients `c` of shape (degree + 1, segments,
/// joints). The second is a `BSpline` on its base interval, or any object with the same knots `t`, coefficients `c` and
/// degree `k` that can be called with a time and the order of a derivative.
///
/// Args:
///     robot: the robot.
#[pyclass(name = "Cell", module = "rigid_ccd", frozen)]
pub(crate) struct PyCell {
    robot: Py<PyRobot>,
    state: CellState,
}

#[pymethods]
impl PyCell {
    #[new]
    fn new(robot: &Bound<'_, PyRobot>) -> PyResult<Self> {
        let py_robot = robot.get();
        let cell = Cell::new((*py_robot.robot).clone(), py_robot.pairs.clone());
        // Warnings about files were shown when the files were read.
        let shown: Vec<_> = py_robot.file_remarks().collect();
        let remarks = cell.remarks().into_iter();
        warn_of(
            robot.py(),
            remarks.filter(|remark| !shown.contains(&remark)),
        )?;
        Ok(PyCell {
            robot: robot.clone().unbind(),
            state: CellState::new(cell),
        })
    }

    /// The robot that the cell was made with.
    #[getter]
    fn robot(&self, py: Python<'_>) -> Py<PyRobot> {
        self.robot.clone_ref(py)
    }

    /// Adds an obstacle at a pose in the frame of the robot's base. Warns if its size is improbable for this
    /// robot.
    #[pyo3(signature = (name, body, pose = None))]
    fn add_obstacle(
        &self,
        name: &str,
        body: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let py = body.py();
        let (body, pose) = (read_body(body)?, given_pose_or_identity(pose)?);
        let remark = self.remark_on_size(name, &body.get().body);
        warn_of(py, remark)?;
        self.state.add(name, body, pose)
    }

    /// Adds a half-space as an obstacle: all points below the plane z = 0 of the frame at a pose. It is represented by
    /// a large box. If prismatic joints could reach the end of the box on a path, the question raises an InputError.
    #[pyo3(signature = (name, pose = None))]
    fn add_plane(&self, name: &str, pose: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        self.state.add_plane(name, given_pose_or_identity(pose)?)
    }

    /// Moves an obstacle to a pose in the frame of the robot's base.
    fn move_obstacle(&self, name: &str, pose: &Bound<'_, PyAny>) -> PyResult<()> {
        self.state
            .move_obstacle(name, read_given_pose(pose, "pose")?)
    }

    /// Removes an obstacle.
    fn remove_obstacle(&self, name: &str) -> PyResult<()> {
        self.state.remove(name)
    }

    /// Attaches a body to a link, at a pose in the link's frame. The body may touch that link, and the items in
    /// `may_touch`: links, attached bodies and obstacles. Warns if its size is improbable for this robot.
    #[pyo3(signature = (name, body, link, pose = None, may_touch = Vec::new()))]
    fn attach(
        &self,
        name: String,
        body: &Bound<'_, PyAny>,
        link: String,
        pose: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = read_names)] may_touch: Vec<String>,
    ) -> PyResult<()> {
        let py = body.py();
        let (body, pose) = (read_body(body)?, given_pose_or_identity(pose)?);
        let remark = self.remark_on_size(&name, &body.get().body);
        warn_of(py, remark)?;
        self.state.attach((name, body, link, pose, may_touch))
    }

    /// Detaches a body from its link, and removes it.
    fn detach(&self, name: &str) -> PyResult<()> {
        self.state.detach(name)
    }

    /// Allows two items to touch, even if they have a clearance. An item is a link, an attached body or an obstacle.
    /// The permission lasts until one of them is removed, or until `forbid_contact` or `set_clearance` is called for them.
    fn allow_contact(&self, a: &str, b: &str) -> PyResult<()> {
        self.state.set_contact(a, b, Contact::Allowed)
    }

    /// Revokes the permission of two items to touch. For two links that are not checked, adds them to the checked pairs.
    fn forbid_contact(&self, a: &str, b: &str) -> PyResult<()> {
        self.state.set_contact(a, b, Contact::Forbidden)
    }

    /// Remarks as texts: first on probable mistakes, then on links and pairs that are not checked. They include the remarks
    /// on the robot, on obstacles and attached bodies of an improbable size, and on allowed contacts.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        remark_texts(&self.state.solvers.cell().remarks())
    }

    /// Sets the padding of a link: a distance that obstacles must keep from it, in addition to the margin.
    fn set_padding(
        &self,
        link: &str,
        #[pyo3(from_py_with = read_number)] distance: f64,
    ) -> PyResult<()> {
        self.state.set_padding(link, distance)
    }

    /// Sets the distance at which a pair counts as touching, even if the pair was allowed to touch. `a` is a link or an
    /// attached body. `b` is a link, an attached body or an obstacle.
    fn set_clearance(
        &self,
        a: &str,
        b: &str,
        #[pyo3(from_py_with = read_number)] distance: f64,
    ) -> PyResult<()> {
        self.state.set_clearance(a, b, distance)
    }

    /// Returns whether a path is free of contact. True is proven for every configuration on the path.
    ///
    /// With the setting `start="leave"`, pairs in contact at the start may separate or slide, but not come nearer. Use
    /// it to lift a held object from a table.
    ///
    /// Raises:
    ///     InputError: the path does not fit the robot, or the cell has no pair to check.
    ///     UnresolvedError: a limit was reached first.
    #[pyo3(signature = (path, **settings))]
    fn is_free(
        &self,
        py: Python<'_>,
        path: &Bound<'_, PyAny>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<bool> {
        let answer = self.ask(py, Question::AnyContact, path, settings)?;
        check_resolved(&answer)?;
        Ok(answer.row.status == Status::Free)
    }

    /// Returns the first contact on a path, or None. Nothing touches before it. `start="leave"` is as for `is_free`.
    ///
    /// Raises:
    ///     UnresolvedError: a limit was reached first. The path is free until `safe_until`, a number of segments of the path
    ///         or a time on the curve.
    #[pyo3(signature = (path, **settings))]
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let answer = self.ask(py, Question::FirstContact, path, settings)?;
        check_resolved(&answer)?;
        contact_object(py, &answer)
    }

    /// Finds the first contact on a path of configurations, and proves the answer for each segment. A proof states that
    /// all checked pairs are farther apart than their margins. It is about triangles only: it does not prove that no
    /// body is inside another one. Curves have no proofs.
    ///
    /// Args:
    ///     path: configurations. A path of one configuration is a static robot.
    ///     progress: a function, called with the number of segments proven and the number of all segments; a bar of
    ///         tqdm; or True for a new bar.
    ///
    /// Returns:
    ///     A list of `Proof`: one for each segment, until the end or the first contact. It is never empty. A deadline
    ///     limits the search, but not the writing of proofs.
    ///
    /// Raises:
    ///     InputError: a body has no triangles, the path is a curve, or a segment cannot be proven, for instance
    ///         because bodies touch at its start, or one is inside another. `results` has the proofs of the segments
    ///         before.
    ///     UnresolvedError: a limit was reached first. `results` has the proofs until `safe_until`.
    ///     InterruptError: Ctrl-C was pressed. `results` has the proofs so far.
    #[pyo3(signature = (path, *, progress = None, **settings))]
    fn prove<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        progress: Option<&Bound<'py, PyAny>>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let settings = read(settings, &names(Question::FirstContact, REPORTING_START))?;
        prove_path(py, &self.state.solvers.cell(), path, progress, settings)
    }

    /// Returns bounds of the least distance on a path, with the nearest pair. With a `clearance`, the answer also tells
    /// whether it is kept.
    #[pyo3(signature = (path, **settings))]
    fn closest_approach<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let question = Question::ClosestApproach;
        let settings = read(settings, &names(question, &[]))?;
        let clearance = settings.clearance;
        let answer = answer_path(py, &self.state.solvers, question, path, settings)?;
        approach_object(py, &answer, clearance)
    }

    /// Divides a path into ranges. In each range, either all pairs keep their required distance, or some pair certainly does
    /// not, or neither is proven. The required distance is the setting `margin` plus paddings, or the clearance of a pair.
    ///
    /// Args:
    ///     path: the path, such as `[[low], [high]]` for a mechanism with one joint.
    ///     resolution: the length of the shortest ranges that are examined, in segments of the path or of the curve.
    ///     max_pose_error: an upper bound of the distance between a point of a link and its position on the path. Use it for
    ///         a closed loop of joints: the loop is closed in the configurations of the path, and between them the path
    ///         differs from the mechanism by the error of the interpolation.
    ///
    /// Returns:
    ///     A list of `PathRange`, in the order of the path.
    ///
    /// Raises:
    ///     InterruptError: Ctrl-C was pressed. `results` has the ranges found so far, and "unverified" for the rest of the
    ///         path.
    #[pyo3(signature = (path, *, resolution = RangeSettings::DEFAULT.resolution, max_pose_error = 0.0, **settings))]
    fn clearance_ranges<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        #[pyo3(from_py_with = read_number)] resolution: f64,
        #[pyo3(from_py_with = read_number)] max_pose_error: f64,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let settings = read(settings, &names(Question::FirstContact, REPORTING_START))?;
        let range_settings = RangeSettings {
            resolution,
            max_pose_error,
        };
        path_ranges(py, &self.state.solvers, path, range_settings, settings)
    }

    /// Answers a question about many edges, on all cores. The first two arguments are arrays of shape (N, joints): the
    /// start and the end of each edge. They are positional only, because the keyword `start` is the setting of
    /// `is_free`.
    ///
    /// Args:
    ///     question: "is-free", "first-contact" or "closest-approach".
    ///     threads: the number of threads; None for one on each core.
    ///     progress: a function, called up to fifty times a second with the number of edges answered and the number of
    ///         all edges; a bar of tqdm; or True for a new bar.
    ///
    /// Returns:
    ///     A table with a row for each edge, with the columns of ``ccd edges``. Every question has `status` and `reason`.
    ///     The other columns depend on the question: `time` from 0 to 1, `a`, `b`, `distance_lower`, `distance_upper`, the
    ///     witness points `witness_a_x` to `witness_b_z`, and their features `feature_a` and `feature_b`. With the setting
    ///     `clearance`, the status of a closest approach is "kept", "violated" or "unverified".
    ///
    /// Raises:
    ///     InterruptError: Ctrl-C was pressed. `results` has the rows answered so far, from the first on.
    #[pyo3(signature = (start, end, /, question = "is-free", *, threads = None, progress = None, **settings))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn answer_edges(
        &self,
        py: Python<'_>,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        question: &str,
        threads: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyTable> {
        let question = GivenQuestion {
            question,
            threads,
            progress,
            settings,
        };
        let edges = || GivenPaths::read_edges([start, end], &self.robot.get().robot);
        answer_paths(py, &self.state.solvers, question, edges)
    }

    /// Answers a question about many paths, on all cores. `paths` is an array of shape (N, n, joints), or a list of
    /// curves. The other arguments and the table are as for `answer_edges`. Times are in segments: 1.5 is the middle of the
    /// second segment. On a curve, they are times of the curve.
    #[pyo3(signature = (paths, question = "is-free", *, threads = None, progress = None, **settings))]
    fn answer_paths(
        &self,
        py: Python<'_>,
        paths: &Bound<'_, PyAny>,
        question: &str,
        threads: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyTable> {
        let question = GivenQuestion {
            question,
            threads,
            progress,
            settings,
        };
        let paths = || GivenPaths::read(paths, &self.robot.get().robot);
        answer_paths(py, &self.state.solvers, question, paths)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<PickledCell<'py>> {
        let (py, cell) = (slf.py(), slf.get());
        let contents = cell.state.pickled(py)?;
        Ok((slf.get_type(), (cell.robot.clone_ref(py),), contents))
    }

    fn __setstate__(&self, state: CellContents) -> PyResult<()> {
        self.state.restore(state)
    }

    fn __repr__(&self) -> String {
        let cell = self.state.solvers.cell();
        let obstacles: Vec<&str> = cell.obstacle_names().collect();
        format!(
            "Cell({}: {}; sizes: {}{})",
            cell.check_summary(),
            obstacles.join(", "),
            cell.sizes_text(),
            warning_text(&cell.remarks())
        )
    }
}

/// The class, the robot and the contents of a cell, as `__reduce__` returns them.
type PickledCell<'py> = (Bound<'py, PyType>, (Py<PyRobot>,), Bound<'py, PyDict>);

impl PyCell {
    fn ask(
        &self,
        py: Python<'_>,
        question: Question,
        path: &Bound<'_, PyAny>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PathRow> {
        let settings = read(settings, &names(question, &[]))?;
        answer_path(py, &self.state.solvers, question, path, settings)
    }

    fn remark_on_size(&self, name: &str, body: &Body) -> Option<CellRemark> {
        self.state.solvers.cell().remark_on_size(name, body)
    }
}

fn given_pose_or_identity(pose: Option<&Bound<'_, PyAny>>) -> PyResult<GivenPose> {
    pose.map_or(Ok(GivenPose::IDENTITY), |pose| {
        read_given_pose(pose, "pose")
    })
}

/// Reads a list of names. Refuses a single text.
fn read_names(names: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let texts = names.extract::<Vec<String>>();
    texts.map_err(|_| wrong_type_error("may_touch", "a list of names", names))
}
