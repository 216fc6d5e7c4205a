//! Reads curves from the piecewise polynomials of SciPy.

use crate::arrays::{Elements, flat_numbers};
use crate::configurations::read_configurations;
use crate::errors::input_error;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use rigid_ccd_robot::{JointCurve, Robot};

/// Reads a list of curves. Returns `None` for anything else.
pub(crate) fn read_curves(
    values: &Bound<'_, PyAny>,
    robot: &Robot,
) -> PyResult<Option<Vec<JointCurve>>> {
    if !(values.is_instance_of::<PyList>() || values.is_instance_of::<PyTuple>()) {
        return Ok(None);
    }
    let mut curves = Vec::new();
    for value in values.try_iter()? {
        match read_curve(&value?, robot)? {
            Some(curve) => curves.push(curve),
            None => return Ok(None),
        }
    }
    Ok(Some(curves).filter(|curves| !curves.is_empty()))
}

/// Reads a curve: an object with the attributes of `scipy.interpolate.PPoly` or `BSpline`. Returns `None` for other
/// objects.
pub(crate) fn read_curve(values: &Bound<'_, PyAny>, robot: &Robot) -> PyResult<Option<JointCurve>> {
    // A data frame may have columns of these names.
    if values.hasattr("__array__")? {
        return Ok(None);
    }
    let attribute = |name: &str| values.getattr_opt(name);
    let curve = match (attribute("x")?, attribute("t")?, attribute("c")?) {
        (Some(times), _, Some(coefficients)) => Polynomials {
            times: flat_numbers(&times, "path.x")?,
            coefficients: read_configurations(&coefficients, robot, "path.c")?,
        }
        .curve()?,
        (None, Some(knots), Some(coefficients)) => {
            curve_of_spline(values, &knots, &coefficients, robot)?
        }
        _ => return Ok(None),
    };
    check_values(values, &curve, robot)?;
    Ok(Some(curve))
}

/// Polynomials in the time since the start of each segment.
struct Polynomials {
    /// The start times of the segments, and the end of the last segment.
    times: Vec<f64>,
    /// The coefficients, of shape (degree + 1, segments, joints), highest power first.
    coefficients: Elements<f64>,
}

impl Polynomials {
    fn curve(&self) -> PyResult<JointCurve> {
        let Elements { values, shape } = &self.coefficients;
        let [powers, segments, joints] = shape[..] else {
            return Err(input_error(format!(
                "path: coefficients of shape (degree + 1, segments, joints) are needed, not {shape:?}"
            )));
        };
        let polynomial = |segment: usize, joint: usize| {
            let lowest_first = (0..powers).rev();
            let value = |power| values[(power * segments + segment) * joints + joint];
            lowest_first.map(value).collect()
        };
        let segment_polynomials = |segment| {
            let joints = 0..joints;
            joints.map(|joint| polynomial(segment, joint)).collect()
        };
        let segments: Vec<Vec<Vec<f64>>> = (0..segments).map(segment_polynomials).collect();
        let curve = JointCurve::from_polynomials(&self.times, &segments);
        curve.map_err(|error| input_error(format!("path: {error}")))
    }
}

/// Reads a B-spline. SciPy allows more coefficients than basis functions; the extra coefficients are last, and have no
/// effect.
fn curve_of_spline(
    spline: &Bound<'_, PyAny>,
    knots: &Bound<'_, PyAny>,
    coefficients: &Bound<'_, PyAny>,
    robot: &Robot,
) -> PyResult<JointCurve> {
    let knots = flat_numbers(knots, "path.t")?;
    let Some(degree) = spline.getattr_opt("k")? else {
        return Err(input_error("path: knots `t` without a degree `k`"));
    };
    let degree: usize = degree.extract()?;
    let Elements { values, shape } = read_configurations(coefficients, robot, "path.c")?;
    let [coefficient_count, joints] = shape[..] else {
        return Err(input_error(format!(
            "path: coefficients of shape (coefficients, joints) are needed, not {shape:?}"
        )));
    };
    let bases = knots
        .len()
        .saturating_sub(degree + 1)
        .min(coefficient_count);
    let joint_coefficients = |joint: usize| {
        (0..bases)
            .map(|basis| values[basis * joints + joint])
            .collect()
    };
    let joints: Vec<Vec<f64>> = (0..joints).map(joint_coefficients).collect();
    let curve = JointCurve::from_b_spline(degree, &knots, &joints);
    curve.map_err(|error| input_error(format!("path: {error}")))
}

/// The largest accepted difference between a value of the curve and the value that the Python object returns; relative for
/// values above 1.
const MAX_VALUE_DIFFERENCE: f64 = 1e-6;

/// Returns an error for an object whose coefficients do not belong to powers of time, such as a `BPoly`. Compares two values in each
/// segment. An object that cannot be called is not checked.
fn check_values(object: &Bound<'_, PyAny>, curve: &JointCurve, robot: &Robot) -> PyResult<()> {
    if !object.is_callable() {
        return Ok(());
    }
    let inside =
        |span: &[f64]| [0.375, 0.75].map(|fraction| span[0] + fraction * (span[1] - span[0]));
    let times: Vec<f64> = curve.times().windows(2).flat_map(inside).collect();
    let array = PyArray1::from_slice(object.py(), &times);
    let values = read_configurations(&object.call1((array,))?, robot, "path(times)")?.values;
    let joints = values.len() / times.len();
    for (k, time) in times.iter().enumerate() {
        let (values, curve_values) = (&values[k * joints..][..joints], curve.positions(*time));
        // The comparison is written so that NaN is refused.
        let is_same = |(value, curve_value): (&f64, &f64)| {
            (value - curve_value).abs() <= MAX_VALUE_DIFFERENCE * (1.0 + curve_value.abs())
        };
        if values.len() != curve_values.len() || !values.iter().zip(&curve_values).all(is_same) {
            return Err(input_error(format!(
                "path: at {time} its values are {values:?}, but its coefficients give {curve_values:?}; convert it to a \
                 scipy.interpolate.PPoly, a BPoly by PPoly.from_bernstein_basis"
            )));
        }
    }
    Ok(())
}
