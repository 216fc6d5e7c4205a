//! Vectors, matrices and rotations whose entries are intervals.

use super::interval::{Interval, point_interval};
use ccd_core::glam::{DQuat, DVec3};
use std::ops::{Add, Mul, Neg, Sub};

/// A vector whose coordinates are known to within intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalVector(pub(super) [Interval; 3]);

/// A matrix as three rows of entries that are known to within intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalMatrix(pub(super) [[Interval; 3]; 3]);

const ZERO: Interval = point_interval(0.0);
const ONE: Interval = point_interval(1.0);
const TWO: Interval = point_interval(2.0);
/// The interval from −1 to 1, which contains every sine and cosine.
const SINE_RANGE: Interval = Interval::new(-1.0, 1.0);

impl IntervalVector {
    pub(super) fn midpoint(&self) -> DVec3 {
        DVec3::from_array(self.0.map(Interval::midpoint))
    }

    pub(super) fn scaled(&self, by: Interval) -> Self {
        IntervalVector(self.0.map(|x| x * by))
    }

    pub(super) fn dot(&self, other: &Self) -> Interval {
        let [x, y, z] = self.0;
        let [u, v, w] = other.0;
        x * u + y * v + z * w
    }

    pub(super) fn cross(&self, other: &Self) -> Self {
        let [x, y, z] = self.0;
        let [u, v, w] = other.0;
        IntervalVector([y * w - z * v, z * u - x * w, x * v - y * u])
    }

    /// Returns the matrix M such that M w = v × w, where v is this vector.
    pub(super) fn cross_matrix(&self) -> IntervalMatrix {
        let [x, y, z] = self.0;
        IntervalMatrix([[ZERO, -z, y], [z, ZERO, -x], [-y, x, ZERO]])
    }
}

impl From<DVec3> for IntervalVector {
    fn from(v: DVec3) -> Self {
        IntervalVector(v.to_array().map(point_interval))
    }
}

impl IntervalMatrix {
    pub(super) fn transpose(&self) -> Self {
        let m = &self.0;
        IntervalMatrix([0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]]))
    }

    /// Returns the rotation matrix of a quaternion of about unit length, which is normalised first.
    pub(super) fn from_quaternion(q: DQuat) -> Self {
        let [x, y, z, w] = q.to_array().map(point_interval);
        let [xx, yy, zz, ww] = [x.sqr(), y.sqr(), z.sqr(), w.sqr()];
        let [xy, yz, zx] = [TWO * x * y, TWO * y * z, TWO * z * x];
        let [wx, wy, wz] = [TWO * w * x, TWO * w * y, TWO * w * z];
        let rows = [
            [ww + xx - yy - zz, xy - wz, zx + wy],
            [xy + wz, ww - xx + yy - zz, yz - wx],
            [zx - wy, yz + wx, ww - xx - yy + zz],
        ];
        let square = xx + yy + zz + ww;
        IntervalMatrix(rows.map(|row| row.map(|entry| entry / square)))
    }

    /// Returns the rotation matrix of a constant angular velocity after a time, for any number of turns.
    ///
    /// With θ = |ω|t: R = cos θ I + (sin θ / |ω|) \[ω\]× + (2 sin²(θ/2) / |ω|²) ω ωᵀ.
    pub(super) fn rotation_after(spin: DVec3, time: f64) -> Self {
        let omega = IntervalVector::from(spin);
        let square = omega.0[0].sqr() + omega.0[1].sqr() + omega.0[2].sqr();
        let rate = square.sqrt();
        let angle = rate * point_interval(time);
        if !(square.inf() > MIN_SQUARED_ANGULAR_SPEED) {
            // The bound |R − I| ≤ θ is all that remains if the squares underflow.
            let off = SINE_RANGE * angle;
            return IntervalMatrix(
                [0, 1, 2].map(|i| [0, 1, 2].map(|j| kronecker_delta(i, j) + off)),
            );
        }
        let (sine, cosine) = sin_cos(angle);
        let (half_sine, _) = sin_cos(angle / TWO);
        let across = omega.scaled(sine / rate).cross_matrix();
        let along = TWO * half_sine.sqr() / square;
        IntervalMatrix([0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                kronecker_delta(i, j) * cosine + across.0[i][j] + along * omega.0[i] * omega.0[j]
            })
        }))
    }
}

/// The squared angular speed below which a rotation gets only a coarse bound, because smaller squares may lose digits.
const MIN_SQUARED_ANGULAR_SPEED: f64 = 1e-250;

fn kronecker_delta(i: usize, j: usize) -> Interval {
    if i == j { ONE } else { ZERO }
}

impl Mul for &IntervalMatrix {
    type Output = IntervalMatrix;

    fn mul(self, other: &IntervalMatrix) -> IntervalMatrix {
        let columns = other.transpose().0.map(IntervalVector);
        IntervalMatrix(
            self.0
                .map(|row| [0, 1, 2].map(|j| IntervalVector(row).dot(&columns[j]))),
        )
    }
}

impl Mul<&IntervalVector> for &IntervalMatrix {
    type Output = IntervalVector;

    fn mul(self, v: &IntervalVector) -> IntervalVector {
        IntervalVector(self.0.map(|row| IntervalVector(row).dot(v)))
    }
}

impl Add for IntervalVector {
    type Output = IntervalVector;

    fn add(self, other: IntervalVector) -> IntervalVector {
        IntervalVector([0, 1, 2].map(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for IntervalVector {
    type Output = IntervalVector;

    fn sub(self, other: IntervalVector) -> IntervalVector {
        IntervalVector([0, 1, 2].map(|i| self.0[i] - other.0[i]))
    }
}

impl Neg for IntervalVector {
    type Output = IntervalVector;

    fn neg(self) -> IntervalVector {
        IntervalVector(self.0.map(|x| -x))
    }
}

/// Returns intervals that contain the sines and the cosines of an interval; they are narrow if the interval is.
///
/// The argument is x = kπ/2 + r by interval arithmetic, which holds for any k and keeps |r| below
/// 0.79 for the nearest k. Then come Taylor's polynomials about 0, with Lagrange's remainder
/// |r|ⁿ⁺¹/(n+1)!: r²¹/21! for the sine, r²²/22! for the cosine, below 2e-22.
pub(super) fn sin_cos(x: Interval) -> (Interval, Interval) {
    let quarters = (x.midpoint() * std::f64::consts::FRAC_2_PI).round();
    let rest = x - point_interval(quarters) * Interval::FRAC_PI_2;
    // The first comparison is false for an unbounded interval.
    if !(rest.magnitude() <= LARGEST_POLYNOMIAL_ARGUMENT && quarters.abs() <= MAX_QUARTER_TURNS) {
        return (SINE_RANGE, SINE_RANGE);
    }
    let (sine, cosine) = taylor_sin_cos(rest);
    match quarters.rem_euclid(4.0) {
        1.0 => (cosine, -sine),
        2.0 => (-sine, -cosine),
        3.0 => (-cosine, sine),
        _ => (sine, cosine),
    }
}

/// The largest argument of the Taylor polynomials, in radians: a little over π/2. Reduced arguments are at most about
/// π/4.
const LARGEST_POLYNOMIAL_ARGUMENT: f64 = 1.6;
/// 2⁵⁰, the largest number of quarter turns to subtract: up to it, the number and its remainder modulo 4 are exact.
const MAX_QUARTER_TURNS: f64 = 1_125_899_906_842_624.0;
/// The factorial of 21, which is exact in f64: an odd number below 2⁵³ times 2¹⁸.
const FACTORIAL_21: Interval = point_interval(51_090_942_171_709_440_000.0);
const FACTORIAL_22_OVER_21: Interval = point_interval(22.0);

fn taylor_sin_cos(r: Interval) -> (Interval, Interval) {
    let square = r.sqr();
    let (mut sine, mut cosine) = (ONE, ONE);
    for k in (1..=10).rev() {
        let n = f64::from(2 * k);
        if k < 10 {
            // 1 − r²/(2k(2k+1)) (…)
            sine = ONE - square / point_interval(n * (n + 1.0)) * sine;
        }
        cosine = ONE - square / point_interval((n - 1.0) * n) * cosine;
    }
    let mut power = r.abs();
    for _ in 0..10 {
        power = power * square;
    }
    let sine_rest = power / FACTORIAL_21;
    let cosine_rest = sine_rest * r.abs() / FACTORIAL_22_OVER_21;
    (
        (r * sine + SINE_RANGE * sine_rest).intersection(SINE_RANGE),
        (cosine + SINE_RANGE * cosine_rest).intersection(SINE_RANGE),
    )
}
