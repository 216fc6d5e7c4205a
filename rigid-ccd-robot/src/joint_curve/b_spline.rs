//! Converts B-splines to curves in double-double precision.

use super::{JointCurve, check_count};
use crate::error::CurveError;
use crate::polynomial::MAX_DEGREE;
use ccd_core::double_double::DoubleDouble;
use smallvec::SmallVec;

type Points = SmallVec<[DoubleDouble; MAX_DEGREE + 1]>;

impl JointCurve {
    /// Creates a curve from a B-spline with a degree and knots. `joints` lists the control values of each independent
    /// joint, one for each of the `knots.len() - degree - 1` basis functions. The curve starts at `knots[degree]`.
    ///
    /// # Errors
    /// The same as [`JointCurve::from_polynomials`], and decreasing knots.
    pub fn from_b_spline(
        degree: usize,
        knots: &[f64],
        joints: &[Vec<f64>],
    ) -> Result<Self, CurveError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(CurveError::DegreeTooHigh { degree });
        }
        let basis_count = knots.len().saturating_sub(degree + 1);
        for (number, coefficients) in joints.iter().enumerate() {
            check_count("coefficients", number, coefficients.len(), basis_count)?;
        }
        // Written so that NaN is refused.
        let in_order = |pair: &[f64]| pair[0] <= pair[1];
        if let Some(segment) = knots.windows(2).position(|pair| !in_order(pair)) {
            return Err(CurveError::TimesNotIncreasing { segment });
        }
        let mut times = knots.get(degree..=basis_count).unwrap_or_default().to_vec();
        times.dedup();
        if times.len() < 2 {
            return Err(CurveError::TooFewTimes { count: times.len() });
        }
        let mut polynomials = Vec::new();
        for basis in (degree..basis_count).filter(|&basis| knots[basis] < knots[basis + 1]) {
            let by_joint: Vec<Points> = joints
                .iter()
                .map(|control_values| powers(&bezier_points(degree, knots, control_values, basis)))
                .collect();
            for power in 0..=degree {
                polynomials.extend(by_joint.iter().map(|powers| powers[power]));
            }
        }
        JointCurve::from_coefficients(&times, (joints.len(), degree), polynomials)
    }
}

/// Returns the Bézier control points of the spline between a knot and the next one. Control point `i` is the value of
/// the blossom (polar form) at `degree - i` copies of the first knot and `i` copies of the second knot. De Boor's
/// algorithm computes it, with one of these arguments in each round `[DEBOOR01]`.
fn bezier_points(degree: usize, knots: &[f64], control_values: &[f64], basis: usize) -> Points {
    let ends = [knots[basis], knots[basis + 1]];
    let bezier_point = |second_knot_count: usize| {
        let first = basis - degree;
        let mut points: Points = control_values[first..=basis]
            .iter()
            .map(|&value| value.into())
            .collect();
        for round in 1..=degree {
            let argument = ends[usize::from(round <= second_knot_count)];
            for k in (round..=degree).rev() {
                let [low, high] = [knots[first + k], knots[first + k + degree + 1 - round]];
                let [part, whole] = [argument, high].map(|end| DoubleDouble::difference(end, low));
                let fraction = quotient(part, whole);
                points[k] = points[k - 1] + fraction * (points[k] - points[k - 1]);
            }
        }
        points[degree]
    };
    (0..=degree).map(bezier_point).collect()
}

/// Returns a quotient with a relative error of about 2⁻¹⁰⁰, by long division in three f64 steps.
fn quotient(part: DoubleDouble, whole: DoubleDouble) -> DoubleDouble {
    let [divisor, _] = whole.parts();
    let mut remainder = part;
    let mut sum = DoubleDouble::default();
    for _ in 0..3 {
        let next = DoubleDouble::from(remainder.value() / divisor);
        sum = sum + next;
        remainder = remainder - whole * next;
    }
    sum
}

/// Returns the monomial coefficients of a Bézier polynomial: `(n over k) Σ (−1)ᵏ⁻ⁱ (k over i) bᵢ`. The sums are `k`-th
/// differences of the control points.
fn powers(points: &Points) -> Points {
    let degree = points.len() - 1;
    let mut differences = points.clone();
    let mut binomial = 1.0;
    let mut powers = Points::new();
    for power in 0..=degree {
        powers.push(DoubleDouble::from(binomial) * differences[0]);
        for k in 0..degree - power {
            differences[k] = differences[k + 1] - differences[k];
        }
        binomial = binomial * (degree - power) as f64 / (power + 1) as f64;
    }
    powers
}

#[cfg(test)]
mod tests;
