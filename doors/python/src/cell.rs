//! The Python class `Cell`.

use crate::cell_contents::{Contact, PickledContents, UnpickledContents};
use crate::cell_remarks::{remark_texts, warn_of, warning_text};
use crate::cell_state::{CellState, read_body};
use crate::errors::wrong_type_error;
use crate::motion::{GivenPose, read_given_pose};
use crate::numbers::read_number;
use crate::path_answers::{approach_object, check_resolved, contact_object};
use crate::path_array::GivenPaths;
use crate::path_questions::{ask_path, path_ranges};
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

/// A robot among obstacles that rest in the frame of its base.
///
/// A path is an array of shape (n, joints): configurations, between two of which all joints move at constant rates. An array
/// of shape (joints,) is a configuration alone. The columns of a data frame name the joints, with the end `_deg` for degrees.
///
/// Or a path is a curve of up to degree 9: a `scipy.interpolate.PPoly` such as `CubicSpline`, or any object with its breakpoints
/// `x` and its coefficients `c` of shape (degree + 1, segments, joints); or a `BSpline` on its base interval, or any object that is
/// called with a time and the order of a derivative as it is, with its knots `t`, its coefficients `c` and its degree `k`.
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
        let given = robot.get();
        let cell = Cell::new((*given.robot).clone(), given.pairs.clone());
        // Those on files were told when they were read.
        let told: Vec<_> = given.file_remarks().collect();
        let remarks = cell.remarks().into_iter();
        warn_of(robot.py(), remarks.filter(|remark| !told.contains(&remark)))?;
        Ok(PyCell {
            robot: robot.clone().unbind(),
            state: CellState::new(cell),
        })
    }

    /// The robot, as it was given.
    #[getter]
    fn robot(&self, py: Python<'_>) -> Py<PyRobot> {
        self.robot.clone_ref(py)
    }

    /// Adds an obstacle at a pose in the frame of the robot's base. Warns if its size is unlikely beside the robot.
    #[pyo3(signature = (name, body, pose = None))]
    fn add(
        &self,
        name: &str,
        body: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (given, pose) = (read_body(body)?, given_pose_or_identity(pose)?);
        let remark = self.remark_on_size(name, &given.get().body);
        warn_of(body.py(), remark)?;
        self.state.add(name, given, pose)
    }

    /// Adds an obstacle that is a half-space: all points below the plane z = 0 of the frame at a pose, without an end. A path on which
    /// joints slide so far that this is not certain raises an InputError.
    #[pyo3(signature = (name, pose = None))]
    fn add_plane(&self, name: &str, pose: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        self.state.add_plane(name, given_pose_or_identity(pose)?)
    }

    /// Moves an obstacle to a pose.
    fn move_to(&self, name: &str, pose: &Bound<'_, PyAny>) -> PyResult<()> {
        self.state.move_to(name, read_given_pose(pose, "pose")?)
    }

    /// Removes an obstacle.
    fn remove(&self, name: &str) -> PyResult<()> {
        self.state.remove(name)
    }

    /// Attaches a body to a link, at a pose in the link's frame. It may touch that link, and the links, attached bodies and
    /// obstacles in `may_touch`. Warns if its size is unlikely beside the robot.
    #[pyo3(signature = (name, body, link, pose = None, may_touch = Vec::new()))]
    fn attach(
        &self,
        name: String,
        body: &Bound<'_, PyAny>,
        link: String,
        pose: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = read_names)] may_touch: Vec<String>,
    ) -> PyResult<()> {
        let (given, pose) = (read_body(body)?, given_pose_or_identity(pose)?);
        let remark = self.remark_on_size(&name, &given.get().body);
        warn_of(body.py(), remark)?;
        self.state.attach((name, given, link, pose, may_touch))
    }

    /// Removes a body that is attached to a link.
    fn detach(&self, name: &str) -> PyResult<()> {
        self.state.detach(name)
    }

    /// Allows two items to touch: two links, or a link, an attached body and an obstacle, also if they have a clearance. What is
    /// removed takes this away, and so do `forbid_contact` and `set_clearance`.
    fn allow_contact(&self, a: &str, b: &str) -> PyResult<()> {
        self.state.set_contact(a, b, Contact::Allowed)
    }

    /// Compares two items again that were allowed to touch, or two links that were not checked.
    fn forbid_contact(&self, a: &str, b: &str) -> PyResult<()> {
        self.state.set_contact(a, b, Contact::Forbidden)
    }

    /// What is probably a mistake, then what is not checked, as texts: the robot's remarks, obstacles and attached bodies of an
    /// unlikely size, and allowed contacts.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        remark_texts(&self.state.solvers.cell().remarks())
    }

    /// Sets the distance that obstacles have to keep from a link, in addition to the margin.
    fn set_padding(
        &self,
        link: &str,
        #[pyo3(from_py_with = read_number)] distance: f64,
    ) -> PyResult<()> {
        self.state.set_padding(link, distance)
    }

    /// Sets the distance at which a pair counts as touching, also if it was allowed to. `a` is a link or an attached body; so is `b`,
    /// or an obstacle.
    fn set_clearance(
        &self,
        a: &str,
        b: &str,
        #[pyo3(from_py_with = read_number)] distance: f64,
    ) -> PyResult<()> {
        self.state.set_clearance(a, b, distance)
    }

    /// Returns whether nothing touches on a path. That is proven for all configurations on it.
    ///
    /// With the setting `start="leave"` pairs in contact at the start may part or slide, but not come nearer: a held can is lifted
    /// from a table.
    ///
    /// Raises:
    ///     InputError: the path does not fit the robot, or no pair of the cell is compared.
    ///     Unresolved: a limit was reached first.
    #[pyo3(signature = (path, **settings))]
    fn is_free(
        &self,
        py: Python<'_>,
        path: &Bound<'_, PyAny>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<bool> {
        let answer = self.ask(py, Question::AnyContact, path, settings)?;
        check_resolved(py, &answer)?;
        Ok(answer.row.status == Status::Free)
    }

    /// Returns the first contact on a path, or None. Nothing touches before it. `start="leave"` is as of `is_free`.
    ///
    /// Raises:
    ///     Unresolved: a limit was reached first; `safe_until` is the last free point, in segments of the path, or the time on a curve.
    #[pyo3(signature = (path, **settings))]
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let answer = self.ask(py, Question::FirstContact, path, settings)?;
        check_resolved(py, &answer)?;
        contact_object(py, &answer)
    }

    /// Finds the first contact on a path of configurations, and proves the answer for each of its segments: that all pairs that
    /// the cell compares are farther apart than their margins. A proof is of the triangles: of a body inside another one it says
    /// nothing. A curve has no proofs.
    ///
    /// Args:
    ///     path: configurations; one alone is a rest there.
    ///     progress: a function of the number of segments proven and of all segments; or a bar of tqdm; or True for one.
    ///
    /// Returns:
    ///     A list of `Proof`: one for each segment, until the end or the first contact. It is never empty. A deadline is one for the
    ///     search, not for proofs.
    ///
    /// Raises:
    ///     InputError: a body has no triangles, the path is a curve, or a segment cannot be proven, such as one at whose start bodies
    ///         touch, or one is in another; its `results` has the proofs of the segments before.
    ///     Unresolved: a limit was reached first; its `results` has the proofs of what is known, and `safe_until` says until when.
    ///     Interrupted: Ctrl-C; its `results` has the proofs made by then.
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

    /// Returns bounds of the least distance on a path, with the nearest pair. With a `clearance` it also says whether that is kept.
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
        let answer = ask_path(py, &self.state.solvers, question, path, settings)?;
        approach_object(py, &answer, clearance)
    }

    /// Divides a path into ranges in which all pairs keep their distance, ranges in which one certainly does not, and the rest.
    /// The distance is the setting `margin` with the paddings, or the clearance of a pair.
    ///
    /// Args:
    ///     path: the path; for a mechanism with one joint `[[low], [high]]`.
    ///     resolution: the length of the shortest ranges that are examined, in segments of the path or of the curve.
    ///     max_pose_error: how far points of links may be from where the path places them. A closed loop of joints is a path of
    ///         configurations in which the loop is closed; between these, points differ by the error of the interpolation.
    ///
    /// Returns:
    ///     A list of `PathRange`, in the order of the path.
    ///
    /// Raises:
    ///     Interrupted: Ctrl-C; its `results` has the ranges found by then, and says "unverified" of the rest.
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
        let how = RangeSettings {
            resolution,
            max_pose_error,
        };
        path_ranges(py, &self.state.solvers, path, how, settings)
    }

    /// Answers a question about many edges, on all cores: `start` and `end` are arrays of shape (N, joints). They have no names: `start="leave"` is a
    /// setting, as of `is_free`.
    ///
    /// Args:
    ///     ask: "is-free", "first-contact" or "closest-approach".
    ///     threads: how many threads; None for one on each core.
    ///     progress: a function of the number of edges answered and of all edges, called up to fifty times a second; or a bar of
    ///         tqdm; or True for one.
    ///
    /// Returns:
    ///     A table with a row for each edge, with the columns of ``ccd edges``: `status`, `reason`, and those that the question has
    ///     of `time` from 0 to 1, `a`, `b`, `distance_lower`, `distance_upper`, the witnesses `witness_a_x` to `witness_b_z`, and
    ///     `feature_a` and `feature_b`, the parts of meshes that these are on.
    ///     With the setting `clearance` a closest approach is "kept", "violated" or "unverified".
    ///
    /// Raises:
    ///     Interrupted: Ctrl-C; its `results` has the rows answered by then, from the first on.
    #[pyo3(signature = (start, end, /, ask = "is-free", *, threads = None, progress = None, **settings))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn edges(
        &self,
        py: Python<'_>,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        ask: &str,
        threads: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyTable> {
        let given = GivenQuestion {
            ask,
            threads,
            progress,
            settings,
        };
        let edges = || GivenPaths::read_edges([start, end], &self.robot.get().robot);
        answer_paths(py, &self.state.solvers, given, edges)
    }

    /// Answers a question about many paths of equally many configurations, on all cores: an array of shape
    /// (N, n, joints). The table is that of `edges`, and so are the arguments; times are in segments: 1.5 is the middle of the
    /// second one. A list of curves has their own times.
    #[pyo3(signature = (paths, ask = "is-free", *, threads = None, progress = None, **settings))]
    fn paths(
        &self,
        py: Python<'_>,
        paths: &Bound<'_, PyAny>,
        ask: &str,
        threads: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyTable> {
        let given = GivenQuestion {
            ask,
            threads,
            progress,
            settings,
        };
        let paths = || GivenPaths::read(paths, &self.robot.get().robot);
        answer_paths(py, &self.state.solvers, given, paths)
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyType>, (Py<PyRobot>,), PickledContents) {
        let (py, cell) = (slf.py(), slf.get());
        let contents = cell.state.pickled(py);
        (slf.get_type(), (cell.robot.clone_ref(py),), contents)
    }

    fn __setstate__(&self, state: UnpickledContents<'_>) -> PyResult<()> {
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

impl PyCell {
    fn ask(
        &self,
        py: Python<'_>,
        question: Question,
        path: &Bound<'_, PyAny>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PathRow> {
        let settings = read(settings, &names(question, &[]))?;
        ask_path(py, &self.state.solvers, question, path, settings)
    }

    fn remark_on_size(&self, name: &str, body: &Body) -> Option<CellRemark> {
        self.state.solvers.cell().remark_on_size(name, body)
    }
}

fn given_pose_or_identity(given: Option<&Bound<'_, PyAny>>) -> PyResult<GivenPose> {
    given.map_or(Ok(GivenPose::IDENTITY), |pose| {
        read_given_pose(pose, "pose")
    })
}

/// Reads a list of names, which one text is not.
fn read_names(given: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let names = given.extract::<Vec<String>>();
    names.map_err(|_| wrong_type_error("may_touch", "a list of names", given))
}
