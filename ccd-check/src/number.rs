//! Integers with a radius: numbers and vectors that are known to within it.

use core::ops::{Add, Neg, Sub};

/// Numbers, each from `mid - rad` to `mid + rad`, in a unit that the context names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball<const N: usize> {
    pub(crate) mid: [i128; N],
    pub(crate) rad: i128,
}

pub(crate) type Number = Ball<1>;
pub(crate) type Vector = Ball<3>;

/// Fractions, such as the entries of a rotation, are multiples of 2⁻⁵⁰.
pub(crate) const FRACTION: u32 = 50;
pub(crate) const ONE: Number = Ball::exact([1 << FRACTION]);

impl<const N: usize> Ball<N> {
    pub(crate) const fn exact(mid: [i128; N]) -> Self {
        Ball { mid, rad: 0 }
    }

    /// Returns an upper bound of all absolute values.
    pub(crate) fn size(self) -> i128 {
        self.mid.map(i128::abs).into_iter().fold(0, i128::max) + self.rad
    }

    /// Returns the product with a number, divided by 2 to the power of `bits`.
    pub(crate) fn times(self, other: Number, bits: u32) -> Self {
        let mid = self.mid.map(|x| (x * other.mid[0]) >> bits);
        let rad = rounded_radius(self, other, 1, bits);
        Ball { mid, rad }
    }

    /// Returns the sum of the products, divided by 2 to the power of `bits`.
    pub(crate) fn dot(self, other: Self, bits: u32) -> Number {
        let sum: i128 = (0..N).map(|k| self.mid[k] * other.mid[k]).sum();
        let rad = rounded_radius(self, other, N as i128, bits);
        Ball {
            mid: [sum >> bits],
            rad,
        }
    }

    /// Returns the quotient by a small positive integer.
    pub(crate) fn over(self, divisor: i128) -> Self {
        let mid = self.mid.map(|x| x.div_euclid(divisor));
        Ball {
            mid,
            rad: self.rad / divisor + 2,
        }
    }
}

impl Vector {
    pub(crate) fn cross(self, other: Vector, bits: u32) -> Vector {
        let (a, b) = (self.mid, other.mid);
        let mid = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| (a[i] * b[j] - a[j] * b[i]) >> bits);
        Ball {
            mid,
            rad: rounded_radius(self, other, 2, bits),
        }
    }

    /// Returns an upper bound of the length, at most 23 % above.
    pub(crate) fn length(self) -> i128 {
        length(self.mid) + 2 * self.rad
    }
}

/// Returns the radius of a sum of products that is shifted once. The shift of the sum drops less than 1, and so does that of the
/// radius.
fn rounded_radius<const N: usize, const M: usize>(
    a: Ball<N>,
    b: Ball<M>,
    terms: i128,
    bits: u32,
) -> i128 {
    ((terms * (a.size() * b.rad + a.rad * b.size())) >> bits) + 2
}

/// Returns an upper bound of the length of a vector: the largest coordinate and half of the others.
///
/// With a ≥ b ≥ c ≥ 0, (a + (b + c)/2)² ≥ a² + a(b + c) ≥ a² + b² + c².
pub(crate) fn length(v: [i128; 3]) -> i128 {
    let [a, b, c] = v.map(i128::abs);
    let largest = a.max(b).max(c);
    largest + (a + b + c - largest) / 2 + 1
}

impl<const N: usize> Add for Ball<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mid = core::array::from_fn(|k| self.mid[k] + other.mid[k]);
        Ball {
            mid,
            rad: self.rad + other.rad,
        }
    }
}

impl<const N: usize> Neg for Ball<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Ball {
            mid: self.mid.map(i128::neg),
            rad: self.rad,
        }
    }
}

impl<const N: usize> Sub for Ball<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}
