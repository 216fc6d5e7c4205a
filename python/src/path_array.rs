//! Reads paths and edges from NumPy arrays.

use crate::arrays::Elements;
use crate::cell_solver::Paths;
use crate::curve::{read_curve, read_curves};
use crate::errors::input_error;
use pyo3::prelude::*;
use rigid_ccd_robot::{JointCurve, PathPoint, Robot};

/// A path as Python gives it: configurations, or polynomials.
pub(crate) enum GivenPath {
    Configurations(PathArray),
    Curve(JointCurve),
}

impl GivenPath {
    /// Reads a curve, or an array of configurations; one of one dimension is one configuration.
    pub(crate) fn read(values: &Bound<'_, PyAny>, robot: &Robot) -> PyResult<Self> {
        if let Some(curve) = read_curve(values)? {
            return Ok(GivenPath::Curve(curve));
        }
        check_joint_order(values, robot, "path")?;
        let path = PathArray::read(values, "path")?;
        match path.shape.len() {
            1 | 2 => Ok(GivenPath::Configurations(path)),
            _ => Err(input_error(format!(
                "path: an array of shape (configurations, joints) is needed, not {:?}",
                path.shape
            ))),
        }
    }

    /// Returns the time of a point: that of the curve, rounded down, or segments of one unit of time each.
    pub(crate) fn time(&self, at: PathPoint) -> f64 {
        match self {
            GivenPath::Configurations(_) => at.time(),
            GivenPath::Curve(curve) => curve.time(at),
        }
    }

    /// Returns the time of a point, rounded up.
    pub(crate) fn latest_time(&self, at: PathPoint) -> f64 {
        match self {
            GivenPath::Configurations(_) => at.time(),
            GivenPath::Curve(curve) => curve.latest_time(at),
        }
    }

    /// Returns the time at which the path starts.
    pub(crate) fn start_time(&self) -> f64 {
        match self {
            GivenPath::Configurations(_) => 0.0,
            GivenPath::Curve(curve) => curve.times()[0],
        }
    }
}

/// Many paths as Python gives them.
pub(crate) enum GivenPaths {
    /// Paths of equally many configurations.
    Array(PathArray),
    Curves(Vec<JointCurve>),
}

impl GivenPaths {
    /// Reads an array of shape (paths, configurations, joints), or a list of curves.
    pub(crate) fn read(values: &Bound<'_, PyAny>, robot: &Robot) -> PyResult<Self> {
        if let Some(curves) = read_curves(values)? {
            return Ok(GivenPaths::Curves(curves));
        }
        let array = PathArray::read(values, "paths")?;
        array.check_shape_of_paths(robot.free_joint_names().len())?;
        Ok(GivenPaths::Array(array))
    }

    /// Returns the number of paths.
    pub(crate) fn count(&self) -> usize {
        match self {
            GivenPaths::Array(array) => array.shape[0],
            GivenPaths::Curves(curves) => curves.len(),
        }
    }

    /// Reads edges from two arrays of shape (edges, joints).
    pub(crate) fn read_edges(
        [start, end]: [&Bound<'_, PyAny>; 2],
        robot: &Robot,
    ) -> PyResult<Self> {
        let joints = robot.free_joint_names().len();
        check_joint_order(start, robot, "start")?;
        check_joint_order(end, robot, "end")?;
        let start = Elements::<f64>::read(start, "start")?;
        let end = Elements::<f64>::read(end, "end")?;
        let count = match (&start.shape[..], &end.shape[..]) {
            (&[count, columns], &[other, others])
                if count == other && [columns, others] == [joints; 2] =>
            {
                count
            }
            (start, end) => {
                return Err(input_error(format!(
                    "start, end: two arrays of one shape (edges, {joints}) are needed, not {start:?} and {end:?}"
                )));
            }
        };
        let rows = |edge: usize| [&start, &end].map(|ends| &ends.values[edge * joints..][..joints]);
        let positions = (0..count).flat_map(rows).flatten().copied().collect();
        let shape = vec![count, 2, joints];
        PathArray::new(positions, shape, "start, end").map(GivenPaths::Array)
    }
}

/// Refuses a data frame, or a series of one, whose columns name joints of the robot in another order than its configurations.
pub(crate) fn check_joint_order(
    values: &Bound<'_, PyAny>,
    robot: &Robot,
    what: &str,
) -> PyResult<()> {
    let columns = match values.getattr_opt("column_names")? {
        Some(names) => Some(names),
        None => values.getattr_opt("columns")?,
    };
    let names = match columns {
        Some(names) => Some(names),
        // The index of a series; that of a list is a method.
        None => values
            .getattr_opt("index")?
            .filter(|index| !index.is_callable()),
    };
    let names: Option<Vec<String>> =
        names
            .and_then(|names| names.try_iter().ok())
            .and_then(|names| {
                let names = names.map(|name| name?.extract());
                names.collect::<PyResult<_>>().ok()
            });
    let Some(names) = names else {
        return Ok(());
    };
    let joints: Vec<&str> = robot.free_joint_names().collect();
    let names_a_joint = names.iter().any(|name| joints.contains(&name.as_str()));
    if !names_a_joint || names == joints {
        return Ok(());
    }
    Err(input_error(format!(
        "{what}: the columns are {}, and the joints of a configuration {}: take the columns robot.joint_names",
        names.join(", "),
        joints.join(", ")
    )))
}

/// Configurations from an array, one after another.
pub(crate) struct PathArray {
    positions: Vec<f64>,
    shape: Vec<usize>,
}

impl PathArray {
    /// Reads an array of numbers.
    pub(crate) fn read(values: &Bound<'_, PyAny>, what: &str) -> PyResult<Self> {
        let given = Elements::<f64>::read(values, what)?;
        PathArray::new(given.values, given.shape, what)
    }

    fn new(positions: Vec<f64>, shape: Vec<usize>, what: &str) -> PyResult<Self> {
        // There may be no paths, but each has configurations.
        let is_too_short = |shape: &[usize]| shape[shape.len().saturating_sub(2)..].contains(&0);
        if shape.is_empty() || shape.len() > 3 || is_too_short(&shape) {
            return Err(input_error(format!(
                "{what}: configurations are needed, not an array of shape {shape:?}"
            )));
        }
        Ok(PathArray { positions, shape })
    }

    /// Returns the configurations of one path; an array of one dimension is one configuration.
    pub(crate) fn configurations(&self) -> Vec<&[f64]> {
        self.positions.chunks_exact(self.joint_count()).collect()
    }

    /// Refuses an array of another shape than (paths, configurations, `joints`).
    pub(crate) fn check_shape_of_paths(&self, joints: usize) -> PyResult<()> {
        if self.shape.len() == 3 && self.joint_count() == joints {
            return Ok(());
        }
        Err(input_error(format!(
            "paths: an array of shape (paths, configurations, {joints}) is needed, not {:?}",
            self.shape
        )))
    }

    /// Returns all paths of an array of three dimensions.
    pub(crate) fn paths(&self) -> Paths<'_> {
        Paths {
            positions: &self.positions,
            configuration_count: self.shape[1],
            joint_count: self.joint_count(),
        }
    }

    fn joint_count(&self) -> usize {
        self.shape[self.shape.len() - 1]
    }
}
