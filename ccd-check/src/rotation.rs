//! Rotations of quaternions and of rotation vectors, enclosed.

use crate::Stop;
use crate::number::{FRACTION, Matrix, Number, ONE, Vector};
use crate::reader::Reader;

/// Reads a quaternion x, y, z, w, and returns its rotation.
pub(crate) fn read(reader: &mut Reader<'_>) -> Result<Matrix, Stop> {
    let vector = reader.vector(-i64::from(FRACTION), FRACTION + 1)?;
    let scalar = reader.number(-i64::from(FRACTION), FRACTION + 1)?;
    let excess = vector.dot(vector) + scalar.times(scalar, FRACTION) - ONE;
    if excess.size() > ONE.mid[0] >> 20 {
        return Err(Stop::Unverifiable("a quaternion is not of unit length"));
    }
    // 1 / (1 + e) is 1 − e to within e² / (1 − |e|), which is less than 2e².
    let mut inverse = ONE - excess;
    inverse.rad += 2 * excess.times(excess, FRACTION).size();
    let twice = inverse + inverse;
    Ok(Matrix::about(vector, scalar.times(twice, FRACTION), twice))
}

/// Returns the rotation by a vector: about its direction, by its length in radians.
pub(crate) fn exp(turn: Vector) -> Matrix {
    // It is the 2ⁿth power of the rotation by a 2ⁿth part, x, that is not longer than 1.
    let halvings = 64 - (turn.size() >> FRACTION).leading_zeros();
    let part = turn.times(ONE, FRACTION + halvings);
    let square = part.dot(part);
    // Taylor, for sin x / x and (1 − cos x) / x²: what is left out is at most 1 / 21!, which is less than one unit.
    let [sine, cosine] = [1, 2].map(|first| {
        (0..10).rev().fold(Number { mid: [0], rad: 1 }, |sum, k| {
            let factorial: i64 = (1..=2 * k + first).product();
            Number { mid: [ONE.mid[0] / factorial], rad: 1 } - sum.times(square, FRACTION)
        })
    });
    let rotation = Matrix::about(part, sine, cosine);
    (0..halvings).fold(rotation, |rotation, _| rotation.times(rotation))
}
