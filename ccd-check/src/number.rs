//! Integers with a radius: numbers, vectors and rotations that are known to within it.

use core::ops::{Add, Sub};

/// A number, or a vector, that is no farther than `rad` from `mid`, in a unit that the context names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball<const N: usize> {
    pub(crate) mid: [i64; N],
    pub(crate) rad: i64,
}

pub(crate) type Number = Ball<1>;
pub(crate) type Vector = Ball<3>;

/// Fractions, such as the entries of a rotation, are multiples of 2⁻⁵⁰.
pub(crate) const FRACTION: u32 = 50;
pub(crate) const ONE: Number = Ball::exact([1 << FRACTION]);
pub(crate) const ZERO: Vector = Ball::exact([0; 3]);

pub(crate) type Point = [i64; 3];

/// The coordinate axes, as fractions.
pub(crate) const AXES: [Point; 3] = [
    [1 << FRACTION, 0, 0],
    [0, 1 << FRACTION, 0],
    [0, 0, 1 << FRACTION],
];

pub(crate) fn product(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

pub(crate) fn dot(a: Point, b: Point) -> i128 {
    product(a[0], b[0]) + product(a[1], b[1]) + product(a[2], b[2])
}

/// Returns the cross product, rounded down. The coordinates are fractions in one factor at least.
pub(crate) fn cross(a: Point, b: Point) -> Point {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| ((product(a[i], b[j]) - product(a[j], b[i])) >> FRACTION) as i64)
}

pub(crate) fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns the product of a fraction and a number that are not negative, rounded up.
pub(crate) fn up(fraction: i128, number: i128) -> i128 {
    (fraction * number + (1 << FRACTION) - 1) >> FRACTION
}

impl<const N: usize> Ball<N> {
    pub(crate) const fn exact(mid: [i64; N]) -> Self {
        Ball { mid, rad: 0 }
    }

    /// Returns the sum or the difference.
    fn with(self, other: Self, op: fn(i64, i64) -> i64) -> Self {
        Ball {
            mid: core::array::from_fn(|k| op(self.mid[k], other.mid[k])),
            rad: self.rad + other.rad,
        }
    }

    /// Returns an upper bound of the length.
    pub(crate) fn size(self) -> i64 {
        self.mid.iter().map(|x| x.abs()).sum::<i64>() + self.rad
    }

    /// Returns the product with a number, divided by 2 to the power of `bits`.
    pub(crate) fn times(self, other: Number, bits: u32) -> Self {
        let mid = self.mid.map(|x| product(x, other.mid[0]) >> bits);
        Ball::product(mid, self, other, bits)
    }

    /// Returns a product of two factors, whose middle is shifted by `bits` already. Each of a b, a·b and a×b is at most |a| |b|. A
    /// shift drops less than 1 of each coordinate, so less than 2 in all, and of the radius.
    fn product<const A: usize, const B: usize>(
        mid: [i128; N],
        a: Ball<A>,
        b: Ball<B>,
        bits: u32,
    ) -> Self {
        let rad = product(a.size(), b.rad) + product(a.rad, b.size());
        Ball {
            mid: mid.map(|x| x as i64),
            rad: (rad >> bits) as i64 + 3,
        }
    }

    /// Returns the quotient by a small positive integer.
    pub(crate) fn over(self, divisor: i64) -> Self {
        Ball {
            mid: self.mid.map(|x| x.div_euclid(divisor)),
            rad: self.rad / divisor + 3,
        }
    }
}

impl Vector {
    /// Returns the vector of three numbers. Its radius is at most √3 times the largest of theirs.
    pub(crate) fn of([x, y, z]: [Number; 3]) -> Vector {
        Ball {
            mid: [x.mid[0], y.mid[0], z.mid[0]],
            rad: 2 * x.rad.max(y.rad).max(z.rad),
        }
    }

    /// Returns the sum of the products of the coordinates, which are fractions in one factor at least.
    pub(crate) fn dot(self, other: Self) -> Number {
        let mid = [dot(self.mid, other.mid) >> FRACTION];
        Ball::product(mid, self, other, FRACTION)
    }

    /// Returns the cross product. The coordinates are fractions in one factor at least.
    pub(crate) fn cross(self, other: Vector) -> Vector {
        let mid = cross(self.mid, other.mid).map(i128::from);
        Ball::product(mid, self, other, FRACTION)
    }

    /// Returns an upper bound of the length, a closer one.
    pub(crate) fn length(self) -> i128 {
        // Rounded up to numbers of 30 bits, so that the sum of their squares has 62.
        let bits = (64 - self.size().leading_zeros()).saturating_sub(30);
        let rounded = self.mid.map(|x| (x.unsigned_abs() >> bits) + 1);
        let squares: u64 = rounded.iter().map(|x| x * x).sum();
        i128::from((squares.isqrt() + 1) << bits) + i128::from(self.rad)
    }
}

/// A rotation, as columns of fractions: the matrix is off by a matrix whose norm is at most `rad`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matrix {
    columns: [Point; 3],
    pub(crate) rad: i64,
}

impl Matrix {
    pub(crate) const IDENTITY: Matrix = Matrix {
        columns: AXES,
        rad: 0,
    };

    /// Returns the matrix of columns. The norm of what they are off by is at most √3 times the largest radius.
    pub(crate) fn of(columns: [Vector; 3]) -> Matrix {
        Matrix {
            columns: columns.map(|column| column.mid),
            rad: 2 * columns.iter().fold(0, |most, column| most.max(column.rad)),
        }
    }

    pub(crate) fn apply(self, v: Vector) -> Vector {
        Ball {
            mid: self.apply_to_middle(v.mid),
            rad: v.rad + (product(self.rad, v.size()) >> FRACTION) as i64 + 3,
        }
    }

    fn apply_to_middle(self, v: Point) -> Point {
        let [x, y, z] = self.columns;
        [0, 1, 2].map(|k| (dot([x[k], y[k], z[k]], v) >> FRACTION) as i64)
    }

    /// Returns the product: R S is off by (R + E)(S + F) − R S, whose norm is at most |E| + |F| + |E| |F|. The shifts of nine
    /// entries drop less than 3 in all, that of the radius 1.
    pub(crate) fn times(self, other: Matrix) -> Matrix {
        let both = (product(self.rad, other.rad) >> FRACTION) as i64;
        Matrix {
            columns: other.columns.map(|column| self.apply_to_middle(column)),
            rad: self.rad + other.rad + both + 4,
        }
    }

    /// Returns the product of the transposed matrix with a vector, rounded down.
    pub(crate) fn turn_back(&self, v: Point) -> Point {
        self.columns
            .map(|column| (dot(column, v) >> FRACTION) as i64)
    }
}

impl<const N: usize> Add for Ball<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(other, i64::add)
    }
}

impl<const N: usize> Sub for Ball<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(other, i64::sub)
    }
}
