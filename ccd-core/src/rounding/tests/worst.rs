//! Searches for the worst rounding of sums of products, against exact fractions.

use crate::math::order::greater;
use crate::math::principal::principal_axes;
use crate::math::vector::{length, unit};
use crate::rounding::{
    DETERMINANT_ERROR_F64, FRAME_ERROR_F64, HEIGHT_ERROR_F64, SQUARED_LENGTH_RANGE,
    TURN_COUNT_WIDENING, UNDERFLOW_ERROR_BOUND, UNIT_ROUNDOFF_F64, distance_rounding,
    height_rounding,
};
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::rational::{Exact3, error_of};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use glam::{DMat3, DVec3};

/// The range of binary exponents of random coordinates, from 1e-100 up to the accepted maximum of 1e12.
const COORDINATE_EXPONENTS: std::ops::RangeInclusive<i32> = -332..=39;

/// Draws points; they may be much nearer to each other than to the origin.
fn corners<const N: usize>(tape: &mut RandomCase) -> [DVec3; N] {
    let scale = tape.size(COORDINATE_EXPONENTS);
    let first = DVec3::from(tape.vector(-8..=0));
    let near = tape.size(-50..=0);
    [(); N].map(|()| match tape.index_below(4) {
        0 => DVec3::from(tape.vector(-60..=0)) * scale,
        1 => DVec3::from(first.to_array().map(|x| tape.number_near(x))) * scale,
        _ => (first + DVec3::from(tape.vector(-8..=0)) * near) * scale,
    })
}

/// Draws a unit vector, up to rounding; `None` if the drawn vector is zero.
fn axis(tape: &mut RandomCase) -> Option<DVec3> {
    unit(tape.vector(-60..=0).into())
}

fn one_norm(v: DVec3) -> f64 {
    v.abs().element_sum()
}

#[test]
fn height_f64() {
    let found = WorstCaseSearch::new("HEIGHT_F64", 40_000).search(|tape| {
        let (n, x) = (axis(tape)?, DVec3::from(tape.vector(COORDINATE_EXPONENTS)));
        let exact = Exact3::from_coordinates(n).dot(&Exact3::from_coordinates(x));
        let allowed = HEIGHT_ERROR_F64 * one_norm(n) * x.abs().max_element();
        Some(error_fraction(error_of(n.dot(x), &exact), allowed))
    });
    found.assert_tight_bound(3.0);
}

/// Tests the error bound of a corner's position along a ray, by which the sign of the position is decided.
#[test]
fn sign_f64_of_a_product() {
    let found = WorstCaseSearch::new("DETERMINANT_F64, a product", 40_000).search(|tape| {
        let ([from, corner], n) = (corners(tape), axis(tape)?);
        let way = corner - from;
        let exact = Exact3::from_coordinates(n)
            .dot(&Exact3::from_coordinates(corner).minus(&Exact3::from_coordinates(from)));
        let allowed = DETERMINANT_ERROR_F64 * one_norm(way) + f64::MIN_POSITIVE;
        Some(error_fraction(error_of(n.dot(way), &exact), allowed))
    });
    found.assert_tight_bound(12.0);
}

/// Tests the error bound of the determinant whose sign decides on which side of an edge a ray passes.
#[test]
fn sign_f64_of_a_ray_and_an_edge() {
    let found = WorstCaseSearch::new("DETERMINANT_F64, a ray and an edge", 40_000).search(|tape| {
        let ([from, p, q], n) = (corners(tape), axis(tape)?);
        let [a, b, c] = [from, p, q].map(Exact3::from_coordinates);
        let exact = Exact3::from_coordinates(n).dot(&b.minus(&a).cross(&c.minus(&a)));
        let (p, q) = (p - from, q - from);
        let allowed = DETERMINANT_ERROR_F64 * (one_norm(p) * one_norm(q)) + f64::MIN_POSITIVE;
        Some(error_fraction(error_of(n.dot(p.cross(q)), &exact), allowed))
    });
    found.assert_tight_bound(9.0);
}

/// Tests the error bound of the determinant whose sign decides on which side of a triangle a ray starts.
#[test]
fn sign_f64_of_three_corners() {
    let found = WorstCaseSearch::new("DETERMINANT_F64, three corners", 30_000).search(|tape| {
        let [from, of @ ..]: [DVec3; 4] = corners(tape);
        let start = Exact3::from_coordinates(from);
        let [a, b, c] = of.map(|p| Exact3::from_coordinates(p).minus(&start));
        let exact = a.dot(&b.cross(&c));
        let [a, b, c] = of.map(|p| p - from);
        let allowed =
            DETERMINANT_ERROR_F64 * (one_norm(a) * one_norm(b) * one_norm(c)) + f64::MIN_POSITIVE;
        Some(error_fraction(error_of(a.dot(b.cross(c)), &exact), allowed))
    });
    found.assert_tight_bound(9.0);
}

/// Tests the error bound of a point's height above a plane, as the point tree and hulls compute it.
#[test]
fn height_rounding_of_points() {
    let found = WorstCaseSearch::new("height_rounding, a point", 30_000).search(|tape| {
        let [a, b, c, x, base] = corners(tape);
        let [u, v] = [b - a, c - a];
        let normal = u.cross(v);
        let (point, foot) = (x - base, a - base);
        let reach = greater(point.abs().max_element(), foot.abs().max_element());
        let [a, b, c, x] = [a, b, c, x].map(Exact3::from_coordinates);
        let exact = b.minus(&a).cross(&c.minus(&a)).dot(&x.minus(&a));
        let height = normal.dot(point) - normal.dot(foot);
        Some(error_fraction(
            error_of(height, &exact),
            height_rounding([u, v], reach),
        ))
    });
    found.assert_tight_bound(30.0);
}

/// Tests that the computed height of a box falls below the exact height of a point in it by at most the error bound.
#[test]
fn height_rounding_of_boxes() {
    let found = WorstCaseSearch::new("height_rounding, a box", 30_000).search(|tape| {
        let [a, b, c, x, y, base] = corners(tape);
        let [u, v] = [b - a, c - a];
        let normal = u.cross(v);
        let (lo, hi) = ((x - base).min(y - base), (x - base).max(y - base));
        let (middle, half) = ((lo + hi) / 2.0, (hi - lo) / 2.0);
        let half = half + (lo.abs().max(hi.abs())) * f64::EPSILON;
        let foot = a - base;
        let reach = greater(
            (middle.abs() + half).max_element(),
            foot.abs().max_element(),
        );
        let height = normal.dot(middle) + normal.abs().dot(half) - normal.dot(foot);
        let [a, b, c] = [a, b, c].map(Exact3::from_coordinates);
        let exact = b.minus(&a).cross(&c.minus(&a));
        let lacks = |p: DVec3| {
            let truth = exact.dot(&Exact3::from_coordinates(p).minus(&a));
            (truth - crate::tests::rational::exact_fraction(height))
                .to_f64()
                .value()
        };
        Some(error_fraction(
            greater(lacks(x), lacks(y)),
            height_rounding([u, v], reach),
        ))
    });
    found.assert_tight_bound(40.0);
}

/// Tests that computed principal axes deviate from unit length and right angles by at most the error bound.
#[test]
fn frame_f64() {
    let found = WorstCaseSearch::new("FRAME_F64", 20_000).search(|tape| {
        let points: [DVec3; 4] = [(); 4].map(|()| tape.vector(-40..=0).into());
        let frame = principal_axes(|| points.iter().map(|&p| (p, 1.0)));
        Some(error_fraction(
            orthonormality_error(&frame),
            FRAME_ERROR_F64,
        ))
    });
    found.assert_tight_bound(200.0);
}

fn orthonormality_error(frame: &DMat3) -> f64 {
    let columns = [0, 1, 2].map(|k| DoubleDouble3::from(frame.col(k)));
    let one = |same: bool| DoubleDouble::from(f64::from(u8::from(same)));
    let pairs = (0..9).map(|k| (k / 3, k % 3));
    let off = pairs.map(|(i, j)| (columns[i].dot(columns[j]) - one(i == j)).get().abs());
    off.fold(0.0, greater)
}

/// Tests the error bound `4u` of lengths and unit vectors, for vectors whose squared lengths are within [`SQUARED_LENGTH_RANGE`] or
/// below.
#[test]
fn units_and_lengths() {
    for (name, exponents, looseness) in [
        ("unit and length: 4u", -300..=300, 3.0),
        (
            "SQUARES and EXTREME_VECTOR_SCALE: 4u of lengths",
            -520..=-320,
            3.0,
        ),
    ] {
        let found = WorstCaseSearch::new(name, 40_000).search(|tape| {
            let v = DVec3::from(tape.vector(exponents.clone()));
            let n = unit(v)?;
            // The vector is scaled by a power of two: the digits of double-double do not reach below 1e-290.
            let up = 2f64.powi(*exponents.start() / -2);
            let scaled = DoubleDouble3::from(v * up);
            let exact = scaled.length().get();
            let off = DoubleDouble::from(length(v) * up) - scaled.length();
            let of_unit = DoubleDouble3::from(n).length() - DoubleDouble::from(1.0);
            let error = greater(off.get().abs() / exact, of_unit.get().abs());
            Some(error_fraction(error, 4.0 * UNIT_ROUNDOFF_F64))
        });
        found.assert_tight_bound(looseness);
    }
}

/// Tests the error bound of distances for coordinates so small that all their squares underflow to 0. A bound without a
/// constant would vanish too.
#[test]
fn least_rounding() {
    let found = WorstCaseSearch::new("LEAST_ROUNDING", 10_000).search(|tape| {
        let v = DVec3::from(tape.vector(-1074..=-1000));
        let bound = distance_rounding([length(v), 0.0], [0.0; 2], 0.0);
        assert!(
            bound >= UNDERFLOW_ERROR_BOUND && length(v).powi(2) < *SQUARED_LENGTH_RANGE.start()
        );
        // A third of a vector occurs in a mean of corners.
        let third = v / 3.0;
        let exact = Exact3::from_coordinates(v);
        let off = [0, 1, 2].map(|k| {
            let truth = &exact.0[k] / dashu_ratio::Relaxed::from(3);
            // The unit is 2⁻¹⁰⁰⁰, so that a part of the least number is representable.
            let error = crate::tests::rational::exact_fraction(third[k]) - truth;
            let unit = crate::tests::rational::exact_fraction(2f64.powi(-500));
            (error / &unit / &unit).to_f64().value().abs()
        });
        let worst = off.into_iter().fold(0.0, greater);
        Some(error_fraction(
            worst,
            bound * 2f64.powi(500) * 2f64.powi(500),
        ))
    });
    // The allowance is far above the error, as its derivation says.
    found.assert_tight_bound(f64::INFINITY);
}

/// Tests the error bound of numbers of turns, which are quotients of angles.
#[test]
fn turns_f64() {
    // This is 2π to 107 bits: sine and cosine of the rounded angle correct it.
    let tau = {
        let rough = DoubleDouble::from(std::f64::consts::TAU);
        rough - rough.sin_cos().0
    };
    let found = WorstCaseSearch::new("TURN_COUNT_WIDENING", 20_000).search(|tape| {
        let [from, width, ahead] = [0; 3].map(|_| tape.any_number(-20..=20));
        let turns = (from - width - ahead) / std::f64::consts::TAU;
        let exact =
            (DoubleDouble::from(from) - DoubleDouble::from(width) - DoubleDouble::from(ahead))
                / tau;
        let off = (DoubleDouble::from(turns) - exact).get().abs();
        // Angles that cancel are off by the last digits of their terms.
        let most = [from, width, ahead].map(f64::abs).into_iter();
        let allowed = TURN_COUNT_WIDENING * (1.0 + most.fold(turns.abs(), greater));
        Some(error_fraction(off, allowed))
    });
    found.assert_tight_bound(1e8);
}
