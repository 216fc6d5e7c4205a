//! Integers with a radius: numbers that are known to within it.

/// A number from `mid - rad` to `mid + rad`, in a unit that the context names.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ball {
    pub(crate) mid: i128,
    pub(crate) rad: i128,
}

/// Fractions, such as the entries of a rotation, are multiples of 2⁻⁵⁰.
pub(crate) const FRACTION_BITS: u32 = 50;
pub(crate) const ONE: i128 = 1 << FRACTION_BITS;

impl Ball {
    pub(crate) const ZERO: Ball = Ball { mid: 0, rad: 0 };

    pub(crate) fn exact(mid: i128) -> Ball {
        Ball { mid, rad: 0 }
    }

    pub(crate) fn add(self, other: Ball) -> Ball {
        Ball {
            mid: self.mid + other.mid,
            rad: self.rad + other.rad,
        }
    }

    pub(crate) fn neg(self) -> Ball {
        Ball {
            mid: -self.mid,
            rad: self.rad,
        }
    }

    pub(crate) fn sub(self, other: Ball) -> Ball {
        self.add(other.neg())
    }

    /// Returns the product divided by 2 to the power of `bits`. The shift drops less than 1 of each of two numbers.
    pub(crate) fn mul(self, other: Ball, bits: u32) -> Ball {
        let rad = self.mid.abs() * other.rad + self.rad * (other.mid.abs() + other.rad);
        Ball {
            mid: (self.mid * other.mid) >> bits,
            rad: (rad >> bits) + 2,
        }
    }

    /// Returns the quotient by a small positive integer.
    pub(crate) fn div(self, divisor: i128) -> Ball {
        Ball {
            mid: self.mid.div_euclid(divisor),
            rad: self.rad / divisor + 2,
        }
    }

    /// Returns an upper bound of the absolute value.
    pub(crate) fn size(self) -> i128 {
        self.mid.abs() + self.rad
    }
}

pub(crate) type Vector = [Ball; 3];

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k].add(b[k]))
}

/// Returns `a` + `sign` · `b`.
pub(crate) fn add_signed(a: Vector, b: Vector, sign: Sign) -> Vector {
    match sign {
        Sign::Plus => add(a, b),
        Sign::Minus => add(a, b.map(Ball::neg)),
    }
}

pub(crate) fn scale(v: Vector, by: Ball, bits: u32) -> Vector {
    v.map(|x| x.mul(by, bits))
}

pub(crate) fn dot(a: Vector, b: Vector, bits: u32) -> Ball {
    let [x, y, z] = [0, 1, 2].map(|k| a[k].mul(b[k], bits));
    x.add(y).add(z)
}

pub(crate) fn cross(a: Vector, b: Vector, bits: u32) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].mul(b[j], bits).sub(a[j].mul(b[i], bits)))
}

/// Returns an upper bound of the length of a vector, at most 16 % above: the largest coordinate and half of the others.
///
/// With a ≥ b ≥ c ≥ 0, (a + (b + c)/2)² ≥ a² + a(b + c) ≥ a² + b² + c².
pub(crate) fn length(v: [i128; 3]) -> i128 {
    let [a, b, c] = v.map(i128::abs);
    let largest = a.max(b).max(c);
    largest + (a + b + c - largest) / 2 + 1
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Sign {
    Plus,
    Minus,
}
