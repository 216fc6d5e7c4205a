//! Reads curves from the piecewise polynomials of SciPy.

use crate::arrays::{Elements, flat_numbers};
use crate::errors::input_error;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use rigid_ccd_robot::JointCurve;

/// Reads a list of curves; `None` for anything else.
pub(crate) fn read_curves(values: &Bound<'_, PyAny>) -> PyResult<Option<Vec<JointCurve>>> {
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

/// Reads an object with the attributes of `scipy.interpolate.PPoly` or `BSpline`; `None` for an object that is no such curve.
pub(crate) fn read_curve(values: &Bound<'_, PyAny>) -> PyResult<Option<JointCurve>> {
    // A data frame may have columns of these names.
    if values.hasattr("__array__")? {
        return Ok(None);
    }
    let attribute = |name: &str| values.getattr_opt(name);
    let polynomials = match (attribute("x")?, attribute("t")?, attribute("c")?) {
        (Some(times), _, Some(coefficients)) => Polynomials {
            times: flat_numbers(&times, "path.x")?,
            coefficients: Elements::<f64>::read(&coefficients, "path.c")?,
        },
        (None, Some(knots), Some(_)) => Polynomials::of_spline(values, &knots)?,
        _ => return Ok(None),
    };
    let curve = polynomials.curve()?;
    check_values(values, &curve)?;
    Ok(Some(curve))
}

/// Polynomials of the time since the start of each segment.
struct Polynomials {
    /// The times at which segments begin, and the end of the last one.
    times: Vec<f64>,
    /// Of shape (degree + 1, segments, joints), those of the highest power first.
    coefficients: Elements<f64>,
}

impl Polynomials {
    /// Expands a B-spline about the start of each segment of its base interval: the derivatives there are its coefficients.
    fn of_spline(spline: &Bound<'_, PyAny>, knots: &Bound<'_, PyAny>) -> PyResult<Self> {
        let knots = flat_numbers(knots, "path.t")?;
        let Some(degree) = spline.getattr_opt("k")? else {
            return Err(input_error("path: knots `t` without a degree `k`"));
        };
        let degree: usize = degree.extract()?;
        let bases = knots.len().saturating_sub(degree);
        let mut times = knots.get(degree..bases).unwrap_or_default().to_vec();
        times.dedup();
        let starts = PyArray1::from_slice(spline.py(), &times[..times.len().saturating_sub(1)]);
        let (mut values, mut shape) = (Vec::new(), Vec::new());
        // Beyond it a curve has no polynomial that fits; one of a higher degree is refused by its number of coefficients.
        for power in (0..=degree.min(MAX_POWERS)).rev() {
            let how = PyDict::new(spline.py());
            how.set_item("nu", power)?;
            let derivatives = spline.call((&starts,), Some(&how))?;
            let derivatives = Elements::<f64>::read(&derivatives, "path(times, nu)")?;
            let factorial: f64 = (1..=power).map(|factor| factor as f64).product();
            values.extend(derivatives.values.iter().map(|value| value / factorial));
            shape = derivatives.shape;
        }
        shape.insert(0, degree.min(MAX_POWERS) + 1);
        Ok(Polynomials {
            times,
            coefficients: Elements { values, shape },
        })
    }

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
        let of_segment = |segment| {
            let joints = 0..joints;
            joints.map(|joint| polynomial(segment, joint)).collect()
        };
        let segments: Vec<Vec<Vec<f64>>> = (0..segments).map(of_segment).collect();
        let curve = JointCurve::from_polynomials(&self.times, &segments);
        curve.map_err(|error| input_error(format!("path: {error}")))
    }
}

/// The largest power of a B-spline that is read, above the largest degree of a curve.
const MAX_POWERS: usize = 20;

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
