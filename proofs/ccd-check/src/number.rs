//! Vectors and rotations of integers.
//!
//! Fractions, such as the numbers of a quaternion, are multiples of 2⁻⁶⁰. What is dropped is dropped downwards, or towards 0 by a
//! division. The README bounds what that loses.

/// A point or a vector.
pub(crate) type Vector = [i64; 3];

/// A unit quaternion, as its vector and its scalar.
pub(crate) type Rotation = (Vector, i64);

pub(crate) const FRACTION: u32 = 60;
pub(crate) const ONE: i64 = 1 << FRACTION;
pub(crate) const ZERO: Vector = [0; 3];
pub(crate) const IDENTITY: Rotation = (ZERO, ONE);

/// Rotation vectors are in multiples of 2⁻⁵³ radians.
pub(crate) const RADIAN: u32 = 53;

/// Lengths have so many bits.
pub(crate) const LENGTH: u32 = 53;

pub(crate) fn product(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

pub(crate) fn dot<const N: usize>(a: [i64; N], b: [i64; N]) -> i128 {
    (0..N).map(|k| product(a[k], b[k])).sum()
}

/// Returns the product of a fraction and a number that are not negative, rounded up.
pub(crate) fn up(fraction: i128, number: i128) -> i128 {
    (fraction * number + i128::from(ONE) - 1) >> FRACTION
}

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns a − b.
pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns the product with a number, divided by 2 to the power of `bits`.
pub(crate) fn scaled(v: Vector, by: i64, bits: u32) -> Vector {
    v.map(|x| (product(x, by) >> bits) as i64)
}

/// Returns the cross product. The coordinates of one of both are fractions.
pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    let minor = |i: usize, j: usize| ((product(a[i], b[j]) - product(a[j], b[i])) >> FRACTION) as i64;
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Returns an upper bound of the length of a vector.
pub(crate) fn length(v: Vector) -> i128 {
    dot(v, v).isqrt() + 1
}

/// Returns v + 2 w u×v + 2 u×(u×v) for the rotation by u and w.
pub(crate) fn turned((u, w): Rotation, v: Vector) -> Vector {
    let twice = cross(u.map(|x| 2 * x), v);
    add(v, add(scaled(twice, w, FRACTION), cross(u, twice)))
}

/// Returns the vector that is turned to v.
pub(crate) fn turned_back((u, w): Rotation, v: Vector) -> Vector {
    turned((sub(ZERO, u), w), v)
}

/// Returns the rotation by the second one, then by the first one.
pub(crate) fn times((u, s): Rotation, (v, t): Rotation) -> Rotation {
    let vector = add(cross(u, v), add(scaled(u, t, FRACTION), scaled(v, s, FRACTION)));
    (vector, ((product(s, t) - dot(u, v)) >> FRACTION) as i64)
}

/// Returns the rotation by a vector: about its direction, by its length.
pub(crate) fn exp(turn: Vector) -> Rotation {
    // With a part 2⁻ⁿ of it that is no longer than 1: the quaternion of that, squared n times.
    let size: u64 = turn.iter().map(|x| x.unsigned_abs()).sum();
    let squarings = 64 - (size >> RADIAN).leading_zeros();
    let half = turn.map(|x| ((i128::from(x) << (FRACTION - RADIAN)) >> (squarings + 1)) as i64);
    let square = (dot(half, half) >> FRACTION) as i64;
    // Taylor: cos x is 1 − x²/(1·2) (1 − x²/(3·4) (1 − …)), and sin x / x is 1 − x²/(2·3) (1 − x²/(4·5) (1 − …)).
    let [cosine, sine] = [0, 1].map(|k| {
        let step = |sum, n: i64| ONE - (product(sum, square) >> FRACTION) as i64 / ((n + k) * (n + k + 1));
        [17, 15, 13, 11, 9, 7, 5, 3, 1].into_iter().fold(ONE, step)
    });
    (0..squarings).fold((scaled(half, sine, FRACTION), cosine), |part, _| times(part, part))
}
