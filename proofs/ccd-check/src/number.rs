//! Vectors and rotations in fixed-point integers.
//!
//! A fraction, such as a coordinate of a quaternion, is a multiple of 2⁻⁶⁰. Shifts round down, and divisions round towards 0. The
//! README bounds the rounding errors.

/// A point or a vector.
pub(crate) type Vector = [i64; 3];

/// A unit quaternion: its vector part and its scalar part.
pub(crate) type Rotation = (Vector, i64);

/// The number of bits of a fraction after the binary point.
pub(crate) const FRACTION_BITS: u32 = 60;
/// The fraction 1.
pub(crate) const ONE: i64 = 1 << FRACTION_BITS;
pub(crate) const ZERO: Vector = [0; 3];
pub(crate) const IDENTITY: Rotation = (ZERO, ONE);

/// The number of bits of a rotation vector, in radians, after the binary point.
pub(crate) const ROTATION_BITS: u32 = 53;

/// The maximum number of bits of a length, in the unit of length.
pub(crate) const LENGTH_BITS: u32 = 53;

pub(crate) fn product(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

pub(crate) fn dot<const N: usize>(a: [i64; N], b: [i64; N]) -> i128 {
    (0..N).map(|k| product(a[k], b[k])).sum()
}

/// Returns the product of a fraction and a number, both non-negative, rounded up.
pub(crate) fn mul_up(fraction: i128, number: i128) -> i128 {
    (fraction * number + i128::from(ONE) - 1) >> FRACTION_BITS
}

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns a − b.
pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns `v` times `factor`, divided by 2 to the power of `bits`, rounded down.
pub(crate) fn scaled(v: Vector, factor: i64, bits: u32) -> Vector {
    v.map(|x| (product(x, factor) >> bits) as i64)
}

/// Returns the cross product of two vectors, one of which has fractions as coordinates.
pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    let minor = |i: usize, j: usize| ((product(a[i], b[j]) - product(a[j], b[i])) >> FRACTION_BITS) as i64;
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Returns an upper bound of the length of a vector.
pub(crate) fn length_bound(v: Vector) -> i128 {
    dot(v, v).isqrt() + 1
}

/// Rotates v by the quaternion with vector u and scalar w: v + 2 w u×v + 2 u×(u×v).
pub(crate) fn rotated((u, w): Rotation, v: Vector) -> Vector {
    let twice = cross(u.map(|x| 2 * x), v);
    add(v, add(scaled(twice, w, FRACTION_BITS), cross(u, twice)))
}

/// Rotates v by the inverse rotation.
pub(crate) fn rotated_back((u, w): Rotation, v: Vector) -> Vector {
    rotated((sub(ZERO, u), w), v)
}

/// Returns the product of two unit quaternions: the second rotation followed by the first one.
pub(crate) fn compose((u, s): Rotation, (v, t): Rotation) -> Rotation {
    let vector = add(cross(u, v), add(scaled(u, t, FRACTION_BITS), scaled(v, s, FRACTION_BITS)));
    (vector, ((product(s, t) - dot(u, v)) >> FRACTION_BITS) as i64)
}

/// Returns the rotation of a rotation vector, whose length is the angle in radians.
pub(crate) fn exp(rotation_vector: Vector) -> Rotation {
    // Divides the vector by 2ⁿ so that its length is at most 1, and squares the quaternion of the quotient n times.
    let size: u64 = rotation_vector.iter().map(|x| x.unsigned_abs()).sum();
    let squarings = 64 - (size >> ROTATION_BITS).leading_zeros();
    let half = rotation_vector.map(|x| ((i128::from(x) << (FRACTION_BITS - ROTATION_BITS)) >> (squarings + 1)) as i64);
    let square = (dot(half, half) >> FRACTION_BITS) as i64;
    // Taylor polynomials: cos x is 1 − x²/(1·2) (1 − x²/(3·4) (1 − …)), and sin x / x is 1 − x²/(2·3) (1 − x²/(4·5) (1 − …)).
    let [cosine, sine] = [0, 1].map(|k| {
        let step = |sum, n: i64| ONE - (product(sum, square) >> FRACTION_BITS) as i64 / ((n + k) * (n + k + 1));
        [17, 15, 13, 11, 9, 7, 5, 3, 1].into_iter().fold(ONE, step)
    });
    (0..squarings).fold((scaled(half, sine, FRACTION_BITS), cosine), |quaternion, _| compose(quaternion, quaternion))
}
