//! Reads paths from NumPy arrays, and curves from piecewise polynomials.

use crate::arrays::{flat_numbers, float64_array};
use crate::cell_solver::Paths;
use crate::errors::input_error;
use crate::robot::PyRobot;
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use rigid_ccd_robot::{JointCurve, PathPoint};

/// A path as Python gives it: configurations, or polynomials.
pub(crate) enum GivenPath {
    Configurations(PathArray),
    Curve(JointCurve),
}

impl GivenPath {
    /// Reads an array, or an object with breakpoints `x` and coefficients `c` as `scipy.interpolate.PPoly` has them.
    pub(crate) fn read(values: &Bound<'_, PyAny>) -> PyResult<Self> {
        match read_curve(values)? {
            Some(curve) => Ok(GivenPath::Curve(curve)),
            None => PathArray::read(values, "path").map(GivenPath::Configurations),
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
    pub(crate) fn read(values: &Bound<'_, PyAny>, robot: &PyRobot) -> PyResult<Self> {
        if let Some(curves) = read_curves(values)? {
            return Ok(GivenPaths::Curves(curves));
        }
        let array = PathArray::read(values, "paths")?;
        array.check_shape_of_paths(robot.robot.free_joint_names().len())?;
        Ok(GivenPaths::Array(array))
    }
}

/// Reads a list of curves; `None` for anything else.
fn read_curves(values: &Bound<'_, PyAny>) -> PyResult<Option<Vec<JointCurve>>> {
    if !(values.is_instance_of::<PyList>() || values.is_instance_of::<PyTuple>()) {
        return Ok(None);
    }
    let mut curves = Vec::new();
    for value in values.try_iter()? {
        match read_curve(&value?)? {
            Some(curve) => curves.push(curve),
            None => return Ok(None),
        }
    }
    Ok(Some(curves).filter(|curves| !curves.is_empty()))
}

/// Reads polynomials of the time with coefficients of shape (degree + 1, segments, joints), that of the highest power first;
/// `None` for an object that is no such curve.
fn read_curve(values: &Bound<'_, PyAny>) -> PyResult<Option<JointCurve>> {
    let [times, coefficients] = ["x", "c"].map(|name| values.getattr_opt(name));
    let (Some(times), Some(coefficients)) = (times?, coefficients?) else {
        return Ok(None);
    };
    let times = flat_numbers(&times, "path.x")?;
    let given = PathArray::read(&coefficients, "path.c")?;
    let [powers, segments, joints] = given.shape[..] else {
        return Err(input_error(format!(
            "path.c: coefficients of shape (degree + 1, segments, joints) are needed, not {:?}",
            given.shape
        )));
    };
    let coefficient = |power: usize, segment: usize, joint: usize| {
        given.positions[(power * segments + segment) * joints + joint]
    };
    let polynomial = |segment: usize, joint: usize| {
        let lowest_first = (0..powers).rev();
        lowest_first
            .map(|power| coefficient(power, segment, joint))
            .collect()
    };
    let of_segment = |segment| {
        (0..joints)
            .map(|joint| polynomial(segment, joint))
            .collect()
    };
    let segments: Vec<Vec<Vec<f64>>> = (0..segments).map(of_segment).collect();
    let curve = JointCurve::from_polynomials(&times, &segments);
    let curve = curve.map_err(|error| input_error(format!("path: {error}")))?;
    check_values(values, &curve)?;
    Ok(Some(curve))
}

/// The largest difference of a value to that of the object which the curve is, relative to values above 1.
const MAX_VALUE_DIFFERENCE: f64 = 1e-6;

/// Refuses an object whose values are not those of its coefficients as powers, such as a `BPoly`: two values in each segment are
/// compared. An object that cannot be called has no values.
fn check_values(given: &Bound<'_, PyAny>, curve: &JointCurve) -> PyResult<()> {
    if !given.is_callable() {
        return Ok(());
    }
    let inside = |span: &[f64]| [0.375, 0.75].map(|share| span[0] + share * (span[1] - span[0]));
    let times: Vec<f64> = curve.times().windows(2).flat_map(inside).collect();
    let array = PyArray1::from_slice(given.py(), &times);
    let values = flat_numbers(&given.call1((array,))?, "path(times)")?;
    let joints = values.len() / times.len();
    for (k, time) in times.iter().enumerate() {
        let (values, own) = (&values[k * joints..][..joints], curve.positions(*time));
        // Written so that NaN is refused.
        let is_same = |(value, own): (&f64, &f64)| {
            (value - own).abs() <= MAX_VALUE_DIFFERENCE * (1.0 + own.abs())
        };
        if values.len() != own.len() || !values.iter().zip(&own).all(is_same) {
            return Err(input_error(format!(
                "path: at {time} its values are {values:?}, and not {own:?} as its coefficients say; convert it to a \
                 scipy.interpolate.PPoly, a BPoly by PPoly.from_bernstein_basis"
            )));
        }
    }
    Ok(())
}

/// Configurations from an array, one after another.
pub(crate) struct PathArray {
    positions: Vec<f64>,
    shape: Vec<usize>,
}

impl PathArray {
    /// Reads an array of float64.
    pub(crate) fn read(values: &Bound<'_, PyAny>, what: &str) -> PyResult<Self> {
        let array = float64_array(values, what)?;
        let array = array.cast::<PyArrayDyn<f64>>()?;
        let shape = array.shape().to_vec();
        // In the order of the indices, whatever the order in memory.
        let positions = array.to_owned_array().iter().copied().collect();
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
