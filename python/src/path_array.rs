//! Reads paths and edges from NumPy arrays.

use crate::arrays::Elements;
use crate::cell_solver::Paths;
use crate::curve::{read_curve, read_curves};
use crate::errors::input_error;
use pyo3::prelude::*;
use rigid_ccd_robot::joint_columns::{AngleUnit, joint_column, names_joint};
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
        let given = read_configurations(values, robot, "path")?;
        let path = PathArray::new(given.values, given.shape, "path")?;
        match path.shape.len() {
            1 | 2 => Ok(GivenPath::Configurations(path)),
            _ => Err(input_error(format!(
                "path: an array of shape (configurations, joints) is needed, not {:?}",
                path.shape
            ))),
        }
    }

    /// Returns what a function finds first in the configurations, or in those of a curve at its times.
    pub(crate) fn find_configuration<T>(&self, find: impl Fn(&[f64]) -> Option<T>) -> Option<T> {
        match self {
            GivenPath::Configurations(array) => array.configurations().into_iter().find_map(find),
            GivenPath::Curve(curve) => find_on_curve(curve, find),
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

    /// Returns what a function finds first in the configurations, or in those of curves at their times.
    pub(crate) fn find_configuration<T>(&self, find: impl Fn(&[f64]) -> Option<T>) -> Option<T> {
        match self {
            GivenPaths::Array(array) => array.configurations().into_iter().find_map(find),
            GivenPaths::Curves(curves) => {
                curves.iter().find_map(|curve| find_on_curve(curve, &find))
            }
        }
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
        let start = read_configurations(start, robot, "start")?;
        let end = read_configurations(end, robot, "end")?;
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

/// Reads configurations of a robot from an array, or from a data frame or a series of one whose columns name the joints, with the
/// end `_deg` for degrees. Columns in another order than the positions of a configuration are refused.
pub(crate) fn read_configurations(
    values: &Bound<'_, PyAny>,
    robot: &Robot,
    what: &str,
) -> PyResult<Elements<f64>> {
    let units = match column_names(values)? {
        Some(names) => units_of_columns(&names, robot, what)?,
        None => Vec::new(),
    };
    let mut given = Elements::<f64>::read(values, what)?;
    if units.contains(&AngleUnit::Degree) {
        let units = units.iter().cycle();
        for (position, unit) in given.values.iter_mut().zip(units) {
            *position = unit.to_radians(*position);
        }
    }
    Ok(given)
}

/// Returns the names of the columns of a table, a data frame or a series of one; `None` if they have none.
fn column_names(values: &Bound<'_, PyAny>) -> PyResult<Option<Vec<String>>> {
    let mut columns = None;
    for attribute in ["column_names", "columns", "index"] {
        columns = match columns {
            // The index of a series; that of a list is a method.
            None => values
                .getattr_opt(attribute)?
                .filter(|names| !names.is_callable()),
            found => found,
        };
    }
    let names = columns.and_then(|names| names.try_iter().ok());
    let names = names.map(|names| names.map(|name| name?.extract()).collect::<PyResult<_>>());
    Ok(names.and_then(Result::ok))
}

/// Returns the unit of each column; none if no column names a joint.
fn units_of_columns(names: &[String], robot: &Robot, what: &str) -> PyResult<Vec<AngleUnit>> {
    if !names.iter().any(|name| names_joint(name, robot, "")) {
        return Ok(Vec::new());
    }
    let mut units = Vec::new();
    for (number, joint) in robot.free_joint_names().enumerate() {
        let found = joint_column(names, robot, ("", joint), AngleUnit::Radian);
        let found = found.map_err(|error| input_error(format!("{what}: {error}")))?;
        units.extend(found.filter(|own| own.column == number).map(|own| own.unit));
    }
    if units.len() == names.len() {
        return Ok(units);
    }
    Err(input_error(format!(
        "{what}: the columns are {}, and the joints of a configuration {}: take the columns robot.joint_names",
        names.join(", "),
        robot.free_joint_names().collect::<Vec<_>>().join(", ")
    )))
}

fn find_on_curve<T>(curve: &JointCurve, find: impl Fn(&[f64]) -> Option<T>) -> Option<T> {
    let mut times = curve.times().iter();
    times.find_map(|&time| find(&curve.positions(time)))
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
