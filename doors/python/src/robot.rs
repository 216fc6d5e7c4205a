//! The Python class `Robot`.

use crate::cell_remarks::{remark_texts, warn_of, warning_text};
use crate::configurations::read_configurations;
use crate::errors::input_error;
use crate::joint::PyJoint;
use crate::link_contacts::{LinkContactQuestion, read_max_boxes};
use crate::link_motion::PyLinkTrajectory;
use crate::motion::pose_matrix;
use crate::numbers::read_number;
use crate::pickle::{ConstructorCall, Reduced};
use crate::robot_base::RobotBase;
use crate::robot_file::{check_path, check_text, read_folders, read_robot, with_options};
use crate::robot_links::read_links;
use crate::table::PyTable;
use ccd_tables::joint_columns::{AngleUnit, joint_column};
use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyType};
use rigid_ccd::text::RoundedToFourDigits;
use rigid_ccd_robot::{CellRemark, Joint, LinkPairs, PlacedRobot, Robot, RobotFile, SkipReason};
use std::path::PathBuf;
use std::sync::Arc;

/// A robot: a tree of links and joints, and the pairs of links that are checked.
///
/// A configuration has one position for each of `joint_names`, in that order: radians for revolute joints, metres for
/// prismatic ones. Make a robot from a file with `Robot.from_urdf` or `Robot.from_mjcf`, or from its joints:
///
/// Args:
///     joints: the joints, in the order of positions in configurations.
///     bodies: a dict from names of links to the bodies fixed to them. Each value is a Body, or a list of pairs of a
///         Body and its pose in the link's frame.
///     may_touch: pairs of links that are not checked. Links that are connected by a joint are never checked.
///
/// >>> from rigid_ccd import Body, Joint, Robot, first_contact
/// >>> shoulder = Joint.revolute("shoulder", "base", "upper arm")
/// >>> elbow = Joint.revolute("elbow", "upper arm", "forearm", ([1, 0, 0], [0, 0, 0, 1]))
/// >>> arm = Robot([shoulder, elbow], {"forearm": Body.sphere(0.1)})
/// >>> turns = arm.link_trajectory("forearm", [0.3, 0.5], [1.3, -1.5])
/// >>> bool((turns.pose(1) == arm.pose("forearm", [1.3, -1.5])).all())
/// True
/// >>> first_contact(Body.sphere(0.1), Body.box(0.1, 0.1, 1), turns) is None
/// True
#[pyclass(name = "Robot", module = "rigid_ccd", frozen)]
pub(crate) struct PyRobot {
    pub(crate) robot: Arc<Robot>,
    pub(crate) pairs: LinkPairs,
    constructor_call: ConstructorCall,
}

#[pymethods]
impl PyRobot {
    #[new]
    #[pyo3(signature = (joints, bodies = None, may_touch = Vec::new()))]
    fn new(
        py: Python<'_>,
        joints: &Bound<'_, PyAny>,
        bodies: Option<Bound<'_, PyMapping>>,
        may_touch: Vec<(String, String)>,
    ) -> PyResult<Self> {
        // Collects one by one, because an object may report a wrong length.
        let py_joints = joints
            .try_iter()?
            .map(|joint| Ok(joint?.cast_into::<PyJoint>()?.unbind()));
        let py_joints: Vec<Py<PyJoint>> = py_joints.collect::<PyResult<_>>()?;
        let joints: Vec<Joint> = py_joints
            .iter()
            .map(|joint| joint.get().joint.clone())
            .collect();
        let (links, link_bodies) = read_links(py, &joints, bodies.as_ref())?;
        let robot = Robot::new(links, joints).map_err(input_error)?;
        let mut pairs = LinkPairs::from_robot(&robot);
        for (a, b) in &may_touch {
            let [a, b] = [a, b].map(|name| robot.link_number(name).map_err(input_error));
            pairs.skip(a?, b?, SkipReason::Disabled("may touch".into()));
        }
        Ok(PyRobot {
            robot: Arc::new(robot),
            pairs,
            constructor_call: ConstructorCall::new(py, None, (py_joints, link_bodies, may_touch))?,
        })
    }

    /// Reads a robot from a URDF file and the mesh files that it names. Warns of probable mistakes in them, which
    /// `remarks` lists.
    ///
    /// Args:
    ///     path: the URDF file.
    ///     srdf: an SRDF file that lists pairs of links not to be checked.
    ///     packages: a folder or a list of folders to search for `package://` names, before ROS_PACKAGE_PATH,
    ///         AMENT_PREFIX_PATH and the folders above the file.
    ///     geometry: the elements of links that become bodies: "collision" or "visual".
    ///     meshes: "exact", or "hull" to replace each mesh by its convex hull, which encloses it.
    ///
    /// Raises:
    ///     InputError: the file is not a valid robot, or a mesh is missing; the message names the link or the joint.
    #[classmethod]
    #[pyo3(signature = (path, srdf = None, packages = None, geometry = "collision", meshes = "exact"))]
    fn from_urdf(
        class: &Bound<'_, PyType>,
        path: PathBuf,
        srdf: Option<PathBuf>,
        #[pyo3(from_py_with = read_folders)] packages: Option<Vec<PathBuf>>,
        geometry: &str,
        meshes: &str,
    ) -> PyResult<Self> {
        check_path(&path)?;
        let arguments = (&path, &srdf, &packages, geometry, meshes);
        let constructor_call = ConstructorCall::new(class.py(), Some("from_urdf"), arguments)?;
        let file = with_options(RobotFile::from_path(path), packages, geometry, meshes)?;
        PyRobot::read(class.py(), file, srdf, constructor_call)
    }

    /// Reads a robot from an MJCF file of MuJoCo and the mesh files that it names.
    ///
    /// Bodies of MuJoCo become links, and the world becomes the link "world". Checked pairs of links are the same as in
    /// MuJoCo. If an element ``equality`` makes the position of a joint a linear function of another joint's, the joint
    /// follows the other one. Joints with other constraints stay independent. Ranges of ball joints and margins are
    /// ignored. The positions of a free joint are the pose of its body in the world. Shapes fitted to a mesh, planes on
    /// moving bodies, and unknown elements are errors.
    ///
    /// Args:
    ///     path: the MJCF file.
    ///     srdf: an SRDF file that lists further pairs of links not to be checked.
    ///     geometry: "collision" for geoms that can collide, or "visual" for geoms of the groups 0 to 2.
    ///     meshes: "exact", or "hull" to replace each mesh by its convex hull, as MuJoCo does. The concavities of an
    ///         exact mesh are free; MuJoCo finds contacts there.
    ///
    /// Raises:
    ///     InputError: the file is not a valid robot, or a mesh is missing; the message names the link or the joint.
    #[classmethod]
    #[pyo3(signature = (path, srdf = None, geometry = "collision", meshes = "exact"))]
    fn from_mjcf(
        class: &Bound<'_, PyType>,
        path: PathBuf,
        srdf: Option<PathBuf>,
        geometry: &str,
        meshes: &str,
    ) -> PyResult<Self> {
        check_path(&path)?;
        let arguments = (&path, &srdf, geometry, meshes);
        let constructor_call = ConstructorCall::new(class.py(), Some("from_mjcf"), arguments)?;
        let file = with_options(RobotFile::from_path(path), None, geometry, meshes)?;
        PyRobot::read(class.py(), file, srdf, constructor_call)
    }

    /// Reads a robot from the text of a URDF file, such as the output of xacro.
    ///
    /// Args:
    ///     text: the text.
    ///     path: the path that the file would have. Relative names of meshes are resolved against it, and messages name
    ///         it.
    ///     srdf, packages, geometry, meshes: as for `from_urdf`.
    #[classmethod]
    #[pyo3(signature = (text, path = PathBuf::from("robot.urdf"), srdf = None, packages = None, geometry = "collision", meshes = "exact"))]
    fn from_urdf_text(
        class: &Bound<'_, PyType>,
        text: &str,
        path: PathBuf,
        srdf: Option<PathBuf>,
        #[pyo3(from_py_with = read_folders)] packages: Option<Vec<PathBuf>>,
        geometry: &str,
        meshes: &str,
    ) -> PyResult<Self> {
        check_text(text)?;
        let arguments = (text, &path, &srdf, &packages, geometry, meshes);
        let constructor_call = ConstructorCall::new(class.py(), Some("from_urdf_text"), arguments)?;
        let file = with_options(RobotFile::from_text(text, path), packages, geometry, meshes)?;
        PyRobot::read(class.py(), file, srdf, constructor_call)
    }

    /// Reads a robot that yourdfpy has loaded. Mesh files are those that yourdfpy has found.
    ///
    /// Args:
    ///     urdf: a yourdfpy.URDF.
    ///     srdf, geometry, meshes: as for `from_urdf`.
    #[classmethod]
    #[pyo3(signature = (urdf, srdf = None, geometry = "collision", meshes = "exact"))]
    fn from_yourdfpy(
        class: &Bound<'_, PyType>,
        urdf: &Bound<'_, PyAny>,
        srdf: Option<PathBuf>,
        geometry: &str,
        meshes: &str,
    ) -> PyResult<Self> {
        // In this text, names of mesh files are the paths that yourdfpy has found.
        let text: Vec<u8> = urdf.call_method0("write_xml_string")?.extract()?;
        let text = String::from_utf8(text).map_err(input_error)?;
        let path = PathBuf::from("robot.urdf");
        PyRobot::from_urdf_text(class, &text, path, srdf, None, geometry, meshes)
    }

    /// Combines several robots into one robot, whose base is a link "world". Names of links and joints get the robot's
    /// name as a prefix: the joint "elbow" of the robot "left" is "left/elbow". A configuration has the positions of
    /// the first robot, then those of the second, and so on. The robots are checked against each other.
    ///
    /// A base may move. A "planar" base adds the positions "left/base/x", "left/base/y" and "left/base/yaw" before
    /// those of the robot, and a "floating" base also "z", "pitch" and "roll". Use a robot without joints as a moving
    /// obstacle: `Robot([], {"ball": Body.sphere(1)})`.
    ///
    /// Args:
    ///     robots: a dict of robots by name. The name "" keeps the robot's own names.
    ///     poses: a dict of the poses of bases, in the frame of the world or of the link that carries the base. For a
    ///         moving base, it is the pose at positions 0.
    ///     bases: a dict with "fixed", "planar" or "floating" for each base. Bases are fixed by default.
    ///     carriers: a dict of the links that carry bases, with their names in the combined robot: {"gripper":
    ///         "arm/flange"}. By default a base is in the world.
    ///
    /// >>> from rigid_ccd import Body, Cell, Robot
    /// >>> ball = Robot([], {"body": Body.sphere(1)})
    /// >>> both = Robot.combined({"red": ball, "blue": ball}, {"blue": ([5, 0, 0], [0, 0, 0, 1])}, {"red": "planar"})
    /// >>> both.joint_names
    /// ['red/base/x', 'red/base/y', 'red/base/yaw']
    /// >>> contact = Cell(both).first_contact([[0, 0, 0], [6, 0, 0]])
    /// >>> contact.a, contact.b, round(6 * contact.fraction, 2)
    /// ('red/body', 'blue/body', 3.0)
    #[classmethod]
    #[pyo3(signature = (robots, poses = None, bases = None, carriers = None))]
    fn combined(
        class: &Bound<'_, PyType>,
        robots: &Bound<'_, PyMapping>,
        poses: Option<&Bound<'_, PyMapping>>,
        bases: Option<&Bound<'_, PyMapping>>,
        carriers: Option<&Bound<'_, PyMapping>>,
    ) -> PyResult<Self> {
        let py = class.py();
        let items = robots.items()?;
        let named_robots = items.iter().map(|item| item.extract());
        let named_robots: Vec<(String, Py<PyRobot>)> = named_robots.collect::<PyResult<_>>()?;
        let names: Vec<String> = named_robots.iter().map(|(name, _)| name.clone()).collect();
        let robot_bases = RobotBase::read_all(&names, poses, bases, carriers)?;
        // For pickle, keeps the values that were read, because the caller may change the arguments.
        let arguments = [(); 4].map(|()| PyDict::new(py));
        let mut placed = Vec::new();
        for ((name, robot), base) in named_robots.iter().zip(&robot_bases) {
            let [robots, poses, bases, carriers] = &arguments;
            robots.set_item(name, robot)?;
            poses.set_item(name, base.pose)?;
            bases.set_item(name, &base.motion_name)?;
            if let Some(link) = &base.carrier {
                carriers.set_item(name, link)?;
            }
            let robot = robot.get();
            placed.push(PlacedRobot {
                name,
                robot: &robot.robot,
                pairs: &robot.pairs,
                carrier: base.carrier.as_deref(),
                pose: base.pose.pose("poses")?,
                base_motion: base.motion()?,
            });
        }
        let (robot, pairs) = Robot::combine(&placed).map_err(input_error)?;
        let arguments: (_, _, _, _) = arguments.into();
        Ok(PyRobot {
            robot: Arc::new(robot),
            pairs,
            constructor_call: ConstructorCall::new(py, Some("combined"), arguments)?,
        })
    }

    /// The names of the independent joints, in the order of a configuration: all except fixed joints and joints that follow
    /// another one.
    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        self.robot.independent_joint_names().collect()
    }

    /// The names of the links, in the order in which they were given.
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

    /// The pairs of links that are checked, as pairs of names.
    #[getter]
    fn checked_pairs(&self) -> Vec<(&str, &str)> {
        let name = |link: usize| self.robot.links()[link].name.as_str();
        let pairs = self.pairs.checked_pairs();
        pairs.map(|[a, b]| (name(a), name(b))).collect()
    }

    /// Remarks as texts: first on probable mistakes, such as elements of files that are left out, an SRDF of another robot,
    /// or sizes and angles in another unit; then on links without bodies, and on pairs of links that are not checked.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        remark_texts(&self.pairs.remarks(&self.robot))
    }

    /// Finds the column of a joint among the names of columns: the prefix, the joint's name, and `_deg` for degrees. Returns
    /// the name of the column, and whether it is in degrees.
    fn _joint_column(
        &self,
        names: Vec<String>,
        prefix: &str,
        joint: &str,
    ) -> PyResult<Option<(String, bool)>> {
        let column = joint_column(&names, &self.robot, (prefix, joint), AngleUnit::Radian);
        let column = column.map_err(input_error)?;
        Ok(column.map(|column| {
            (
                names[column.column].clone(),
                column.unit == AngleUnit::Degree,
            )
        }))
    }

    /// Returns the pose of a link in the frame of the base, as a matrix of shape (4, 4).
    fn pose<'py>(
        &self,
        link: &str,
        configuration: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let py = configuration.py();
        let configuration = read_configurations(configuration, &self.robot, "configuration")?;
        let pose = self
            .robot
            .pose(link, &configuration.values)
            .map_err(input_error)?;
        Ok(pose_matrix(py, &pose))
    }

    /// Returns the motion of a link while each joint moves at a constant rate from its position in `start` to its
    /// position in `end`, as along an edge of a motion planner's roadmap.
    ///
    /// All queries take it in place of a `Motion`. Answers hold for the exact curve of the link, without sampled
    /// steps.
    ///
    /// Args:
    ///     link: the name of the link.
    ///     start, end: configurations.
    ///     duration: the time from `start` to `end`.
    ///     seen_from: the link that is the reference frame of the motion; None for the base. Query the motion against
    ///         that link's body as a static body. Witness points and normals are in that frame too.
    ///
    /// Raises:
    ///     InputError: a position exceeds its joint's limits, or the number of positions differs from the number of
    ///         joints.
    #[pyo3(signature = (link, start, end, duration = 1.0, seen_from = None))]
    fn link_trajectory(
        slf: &Bound<'_, Self>,
        link: String,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = read_number)] duration: f64,
        seen_from: Option<String>,
    ) -> PyResult<PyLinkTrajectory> {
        PyLinkTrajectory::new(
            slf,
            &slf.get().robot,
            link,
            [start, end],
            duration,
            seen_from,
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        slf.get().constructor_call.reduce_tuple(slf.get_type())
    }

    /// Decides for each pair of links with bodies whether the links touch never, always or sometimes, within the limits of
    /// all joints. "never" and "always" are proven. For "sometimes", there are two configurations as evidence, which
    /// `ccd acm --report` writes.
    ///
    /// Args:
    ///     max_boxes: the limit of the number of boxes of joint positions to examine, as an average over all pairs. Each
    ///         box takes some microseconds.
    ///     srdf: an SRDF file to write. It disables the pairs that need no check, with the evidence for each:
    ///         neighbours that this robot does not check, and pairs that touch never or always.
    ///     progress: a function, called repeatedly with the number of decided pairs and the number of all pairs; a bar
    ///         of tqdm; or True for a new bar.
    ///
    /// Ctrl-C raises `InterruptError`, whose `results` is the table of the pairs decided so far.
    ///
    /// Returns:
    ///     A table with a row for each pair: `link_a`, `link_b`, and `evidence`, which is "never", "always",
    ///     "always-as-enclosed", "sometimes" or "undecided". "always-as-enclosed" means that the bounding shapes always
    ///     touch, but the shapes inside may not. For undecided pairs, `apart` is the fraction of configurations that are
    ///     proven apart, `undecided` the fraction without a proof, and `least_distance` the least distance found.
    #[pyo3(signature = (max_boxes = 100_000, *, srdf = None, progress = None))]
    fn classify_link_contacts(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = read_max_boxes)] max_boxes: usize,
        srdf: Option<PathBuf>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PyTable> {
        let question = LinkContactQuestion {
            robot: &self.robot,
            pairs: &self.pairs,
            max_boxes,
            srdf,
            progress,
        };
        question.answer(py)
    }

    fn __repr__(&self) -> String {
        let size = self.robot.size().map(RoundedToFourDigits);
        format!(
            "Robot({}{}; joints {}{})",
            self.pairs.check_summary(&self.robot),
            size.map_or_else(String::new, |size| format!("; size {size}")),
            self.joint_names().join(", "),
            warning_text(&self.pairs.remarks(&self.robot))
        )
    }
}

impl PyRobot {
    fn read(
        py: Python<'_>,
        file: RobotFile,
        srdf: Option<PathBuf>,
        constructor_call: ConstructorCall,
    ) -> PyResult<Self> {
        let (robot, pairs) = read_robot(py, file, srdf)?;
        let py_robot = PyRobot {
            robot: Arc::new(robot),
            pairs,
            constructor_call,
        };
        warn_of(py, py_robot.file_remarks().cloned())?;
        Ok(py_robot)
    }

    /// Returns the remarks on the files that the robot is from.
    pub(crate) fn file_remarks(&self) -> impl Iterator<Item = &CellRemark> {
        let pair_remarks = self.pairs.file_remarks();
        self.robot.file_remarks().iter().chain(pair_remarks)
    }
}
