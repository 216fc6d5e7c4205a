//! Reads paths and edges from NumPy arrays.

use crate::cell_solver::Paths;
use crate::configurations::{check_same_rows, read_configurations};
use crate::curve::{read_curve, read_curves};
use crate::errors::input_error;
use pyo3::prelude::*;
use rigid_ccd_robot::{JointCurve, PathPoint, Robot};

/// A path that Python passed: configurations or a curve.
pub(crate) enum GivenPath {
    Configurations(PathArray),
    Curve(JointCurve),
}

impl GivenPath {
    /// Reads a curve, or an array of configurations. An array of one dimension is a single configuration.
    pub(crate) fn read(values: &Bound<'_, PyAny>, robot: &Robot) -> PyResult<Self> {
        if let Some(curve) = read_curve(values, robot)? {
            return Ok(GivenPath::Curve(curve));
        }
        let path = PathArray::read(values, robot, "path")?;
        match path.shape.len() {
            1 | 2 => Ok(GivenPath::Configurations(path)),
            _ => Err(input_error(format!(
                "path: an array of shape (configurations, joints) is needed, not {:?}",
                path.shape
            ))),
        }
    }

    /// Returns the first result of `find` among the configurations; for a curve, among those at its breakpoints.
    pub(crate) fn find_configuration<T>(&self, find: impl Fn(&[f64]) -> Option<T>) -> Option<T> {
        match self {
            GivenPath::Configurations(array) => array.configurations().into_iter().find_map(find),
            GivenPath::Curve(curve) => find_on_curve(curve, find),
        }
    }

    /// Returns the time of a point: the time on a curve, rounded down, or a number of segments on other paths.
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

/// Many paths that Python passed.
pub(crate) enum GivenPaths {
    /// Paths of equally many configurations.
    Array(PathArray),
    Curves(Vec<JointCurve>),
}

impl GivenPaths {
    /// Reads an array of shape (paths, configurations, joints), or a list of curves.
    pub(crate) fn read(values: &Bound<'_, PyAny>, robot: &Robot) -> PyResult<Self> {
        if let Some(curves) = read_curves(values, robot)? {
            return Ok(GivenPaths::Curves(curves));
        }
        let array = PathArray::read(values, robot, "paths")?;
        array.check_shape_of_paths(robot.independent_joint_names().len())?;
        Ok(GivenPaths::Array(array))
    }

    /// Returns the first result of `find` among the configurations; for curves, among those at their breakpoints.
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
        let joints = robot.independent_joint_names().len();
        check_same_rows([start, end])?;
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
    fn read(values: &Bound<'_, PyAny>, robot: &Robot, argument_name: &str) -> PyResult<Self> {
        let array = read_configurations(values, robot, argument_name)?;
        PathArray::new(array.values, array.shape, argument_name)
    }

    fn new(positions: Vec<f64>, shape: Vec<usize>, argument_name: &str) -> PyResult<Self> {
        // There may be no paths, but each path needs a configuration.
        let is_too_short = |shape: &[usize]| shape[shape.len().saturating_sub(2)..].contains(&0);
        if shape.is_empty() || shape.len() > 3 || is_too_short(&shape) {
            return Err(input_error(format!(
                "{argument_name}: configurations are needed, not an array of shape {shape:?}"
            )));
        }
        Ok(PathArray { positions, shape })
    }

    /// Returns the configurations of one path. An array of one dimension is a single configuration.
    pub(crate) fn configurations(&self) -> Vec<&[f64]> {
        self.positions.chunks_exact(self.joint_count()).collect()
    }

    /// Refuses an array whose shape is not (paths, configurations, `joints`).
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
