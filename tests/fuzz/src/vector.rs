//! Vectors in three dimensions over f64 and double-double numbers.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The scalar type of vectors: f64 for searching, [`Double`](crate::double::DoubleDouble) for judging.
pub trait Number:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn from_f64(x: f64) -> Self;
    fn to_f64(self) -> f64;
    fn sqrt(self) -> Self;
}

impl Number for f64 {
    #[inline]
    fn from_f64(x: f64) -> Self {
        x
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<N>(pub [N; 3]);

impl<N: Number> Vector<N> {
    #[inline]
    pub fn from_array(v: [f64; 3]) -> Self {
        Vector(v.map(N::from_f64))
    }

    #[inline]
    pub fn to_f64(self) -> Vector<f64> {
        self.map_components(N::to_f64)
    }

    /// Applies a function to each component. Unlike `map` of arrays, compilers unroll it.
    #[inline]
    fn map_components<M>(self, change: impl Fn(N) -> M) -> Vector<M> {
        let [x, y, z] = self.0;
        Vector([change(x), change(y), change(z)])
    }

    #[inline]
    pub fn dot(self, o: Self) -> N {
        self.0[0] * o.0[0] + self.0[1] * o.0[1] + self.0[2] * o.0[2]
    }

    #[inline]
    pub fn cross(self, o: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, o.0);
        Vector([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    #[inline]
    pub fn length(self) -> N {
        let size = self.max_absolute_component();
        if !(size > 1e-290) {
            return N::from_f64(size);
        }
        // A power of two, so that squares neither overflow nor underflow.
        let scale = N::from_f64(floor_to_power_of_two(size));
        let v = self * (N::from_f64(1.0) / scale);
        v.dot(v).sqrt() * scale
    }

    /// Scales the vector by a power of two, so that its largest component is about 1; zero stays zero.
    #[inline]
    pub fn scaled_to_about_one(self) -> Self {
        let size = self.max_absolute_component();
        if !(size > 0.0 && size.is_finite()) {
            self
        } else if size < 1e-290 {
            // Scale in two steps, because the reciprocal of a denormal overflows.
            let v = self * N::from_f64(2f64.powi(600));
            v * N::from_f64(1.0 / floor_to_power_of_two(v.max_absolute_component()))
        } else {
            self * N::from_f64(1.0 / floor_to_power_of_two(size))
        }
    }

    /// Returns the vector scaled to length 1; `None` for a vector without a direction.
    #[inline]
    pub fn unit(self) -> Option<Self> {
        let v = self.scaled_to_about_one();
        let length = v.dot(v).sqrt();
        (length.to_f64() > 0.1).then(|| v * (N::from_f64(1.0) / length))
    }

    /// Returns the largest absolute value of a component, rounded.
    #[inline]
    pub fn max_absolute_component(self) -> f64 {
        let Vector([x, y, z]) = self.map_components(|x| x.to_f64().abs());
        larger(larger(x, y), z)
    }
}

/// Returns the largest power of two not above a normal number, from its exponent alone.
#[inline]
fn floor_to_power_of_two(size: f64) -> f64 {
    f64::from_bits(size.to_bits() & 0x7ff0_0000_0000_0000)
}

/// Returns the larger of two numbers; `a` if either is NaN.
#[inline]
pub fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// Returns the smaller of two numbers; `a` if either is NaN.
#[inline]
pub fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

impl<N: Number> Add for Vector<N> {
    type Output = Self;

    #[inline]
    fn add(self, o: Self) -> Self {
        Vector([self.0[0] + o.0[0], self.0[1] + o.0[1], self.0[2] + o.0[2]])
    }
}

impl<N: Number> Sub for Vector<N> {
    type Output = Self;

    #[inline]
    fn sub(self, o: Self) -> Self {
        Vector([self.0[0] - o.0[0], self.0[1] - o.0[1], self.0[2] - o.0[2]])
    }
}

impl<N: Number> Neg for Vector<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.map_components(|x| -x)
    }
}

impl<N: Number> Mul<N> for Vector<N> {
    type Output = Self;

    #[inline]
    fn mul(self, s: N) -> Self {
        self.map_components(|x| x * s)
    }
}
