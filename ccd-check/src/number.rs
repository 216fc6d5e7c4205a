//! Integers with a radius: numbers, vectors and rotations that are known to within it.

use core::ops::{Add, Sub};

/// A number, or a vector, that is no farther than `rad` from `mid`, in a unit that the context names. If the radius is
/// [`UNKNOWN`], it may be anything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball<const N: usize> {
    pub(crate) mid: [i64; N],
    pub(crate) rad: i64,
}

pub(crate) type Number = Ball<1>;
pub(crate) type Vector = Ball<3>;
pub(crate) type Point = [i64; 3];

/// Coordinates and radii are below this.
const UNKNOWN: i64 = 1 << 60;

/// Fractions, such as the entries of a rotation, are multiples of 2⁻⁵⁰.
pub(crate) const FRACTION: u32 = 50;
pub(crate) const ONE: Number = Ball::exact([1 << FRACTION]);
pub(crate) const ZERO: Vector = Ball::exact([0; 3]);

pub(crate) fn product(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

pub(crate) fn dot<const N: usize>(a: [i64; N], b: [i64; N]) -> i128 {
    (0..N).map(|k| product(a[k], b[k])).sum()
}

/// Returns a number if it is known, and what is not if not.
fn known(x: i128) -> i64 {
    x.clamp(-i128::from(UNKNOWN), i128::from(UNKNOWN)) as i64
}

pub(crate) fn cross(a: Point, b: Point) -> [i128; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| product(a[i], b[j]) - product(a[j], b[i]))
}

/// Returns the product of a fraction and a number that are not negative, rounded up.
pub(crate) fn up(fraction: i128, number: i128) -> i128 {
    (fraction * number + (1 << FRACTION) - 1) >> FRACTION
}

impl<const N: usize> Ball<N> {
    pub(crate) const fn exact(mid: [i64; N]) -> Self {
        Ball { mid, rad: 0 }
    }

    fn new(mid: [i64; N], rad: i64) -> Self {
        let is_known = rad < UNKNOWN && mid.iter().all(|x| x.unsigned_abs() < UNKNOWN as u64);
        if is_known { Ball { mid, rad } } else { Ball { mid: [0; N], rad: UNKNOWN } }
    }

    pub(crate) fn is_known(self) -> bool {
        self.rad < UNKNOWN
    }

    /// Returns the sum or the difference.
    fn with(self, other: Self, op: fn(i64, i64) -> i64) -> Self {
        Ball::new(core::array::from_fn(|k| op(self.mid[k], other.mid[k])), self.rad + other.rad)
    }

    /// Returns a product, divided by 2 to the power of `bits`. Each of a b, a·b and a×b is at most |a| |b|. The shift drops less
    /// than 1 of each coordinate, so less than 2 in all, and of the radius. The product with an unknown factor is unknown.
    fn of_product<const A: usize, const B: usize>(mid: [i128; N], a: Ball<A>, b: Ball<B>, bits: u32) -> Self {
        let rad = (product(a.size(), b.rad) + product(a.rad, b.size())) >> bits;
        Ball::new(mid.map(|x| known(x >> bits)), known(rad) + 3 + ((a.rad | b.rad) & UNKNOWN))
    }

    /// Returns an upper bound of the length.
    pub(crate) fn size(self) -> i64 {
        self.mid.iter().map(|x| x.abs()).sum::<i64>() + self.rad
    }

    /// Returns the product with a number, divided by 2 to the power of `bits`.
    pub(crate) fn times(self, other: Number, bits: u32) -> Self {
        Ball::of_product(self.mid.map(|x| product(x, other.mid[0])), self, other, bits)
    }
}

impl Vector {
    /// Returns the vector of three numbers. Its radius is at most √3 times the largest of theirs.
    pub(crate) fn of([x, y, z]: [Number; 3]) -> Vector {
        Ball::new([x.mid[0], y.mid[0], z.mid[0]], 2 * x.rad.max(y.rad).max(z.rad))
    }

    /// Returns the sum of the products of the coordinates, which are fractions in one factor at least.
    pub(crate) fn dot(self, other: Self) -> Number {
        Ball::of_product([dot(self.mid, other.mid)], self, other, FRACTION)
    }

    /// Returns the cross product. The coordinates are fractions in one factor at least.
    pub(crate) fn cross(self, other: Vector) -> Vector {
        Ball::of_product(cross(self.mid, other.mid), self, other, FRACTION)
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

/// A rotation, as rows of fractions: it is off by a matrix whose norm is at most `rad`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matrix {
    rows: [Point; 3],
    pub(crate) rad: i64,
}

impl Matrix {
    pub(crate) const IDENTITY: Matrix =
        Matrix { rows: [[1 << FRACTION, 0, 0], [0, 1 << FRACTION, 0], [0, 0, 1 << FRACTION]], rad: 0 };

    /// Returns the matrix of rows. The norm of a rotation is 1, so it is never off by more from the matrix of zeros.
    fn new(rows: [Point; 3], rad: i64) -> Matrix {
        if rad < ONE.mid[0] { Matrix { rows, rad } } else { Matrix { rows: [[0; 3]; 3], rad: ONE.mid[0] } }
    }

    /// Returns the rotation I + f [v]× + g [v]×². The norm of what it is off by is at most √3 times that of its columns.
    pub(crate) fn about(v: Vector, f: Number, g: Number) -> Matrix {
        let columns = Matrix::IDENTITY.rows.map(|axis| {
            let axis = Ball::exact(axis);
            let once = v.cross(axis);
            axis + once.times(f, FRACTION) + v.cross(once).times(g, FRACTION)
        });
        let rad = columns.iter().fold(0, |most, column| most.max(column.rad));
        Matrix::new(columns.map(|column| column.mid), 2 * rad).transposed()
    }

    pub(crate) fn transposed(self) -> Matrix {
        Matrix { rows: [0, 1, 2].map(|k| self.rows.map(|row| row[k])), ..self }
    }

    /// Returns the product: R S is off by (R + E)(S + F) − R S, whose norm is at most |E| + |F| + |E| |F|. The shifts of nine
    /// entries drop less than 3 in all, that of the radius 1.
    pub(crate) fn times(self, other: Matrix) -> Matrix {
        let both = (product(self.rad, other.rad) >> FRACTION) as i64;
        let columns = other.transposed().rows.map(|column| self.turned(column));
        Matrix::new(columns, self.rad + other.rad + both + 4).transposed()
    }

    /// Returns the product with a vector. The shifts drop less than 2, that of the radius 1.
    pub(crate) fn apply(self, v: Vector) -> Vector {
        let off = known(product(self.rad, v.size()) >> FRACTION);
        Ball::new(self.turned(v.mid), v.rad + off + 3)
    }

    /// Returns the product with the middle of a vector, rounded down.
    pub(crate) fn turned(self, v: Point) -> Point {
        self.rows.map(|row| known(dot(row, v) >> FRACTION))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What is not known stays so in all that is computed of it, and what is too large is not known.
    #[test]
    fn what_is_unknown_stays_unknown() {
        let large = Vector::exact([UNKNOWN - 1, 0, 0]);
        let unknown = large + Vector::exact([1, 0, 0]);
        let nothing = Vector { mid: [0; 3], rad: UNKNOWN };
        assert_eq!(unknown, nothing);
        let scaled = [large.times(ONE, FRACTION - 1), unknown.times(Number::exact([0]), FRACTION)];
        let sums = [large + large, ZERO - large - large, unknown - unknown, unknown + ZERO];
        let products = [unknown.cross(ZERO), ZERO.cross(unknown), Matrix::IDENTITY.apply(unknown)];
        for vector in scaled.into_iter().chain(sums).chain(products) {
            assert_eq!(vector, nothing);
        }
        assert_eq!(unknown.dot(ZERO).rad, UNKNOWN);
        assert!(unknown.length() >= i128::from(UNKNOWN));
    }

    /// What rotations are off by adds up along a chain, but no rotation is farther than 1 from the matrix of zeros.
    #[test]
    fn a_rotation_is_never_off_by_more_than_one() {
        let turn = Matrix::about(Vector { rad: 1 << 20, ..ZERO }, ONE, ONE);
        let mut off = 0;
        let chain = (0..64).fold(turn, |chain, _| {
            assert!(chain.rad > off || chain.rad == ONE.mid[0], "{} after {off}", chain.rad);
            off = chain.rad;
            chain.times(chain)
        });
        assert_eq!((chain.rows, chain.rad), ([[0; 3]; 3], ONE.mid[0]));
        // So a vector is off by its whole length.
        assert!(chain.apply(Vector::exact([1000, 0, 0])).rad >= 1000);
    }
}
