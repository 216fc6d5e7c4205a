use super::*;
use crate::method::rival::tests::samples::RandomSource;
use ccd_core::order::{greater, lesser};

/// The allowed error of a comparison, due to rounding.
const ROUNDING_TOLERANCE: f64 = 1e-12;

fn random_interval_vec(samples: &mut RandomSource) -> IntervalVec {
    IntervalVec {
        middle: samples.vector(2.0),
        radius: samples.vector(1.0).abs(),
    }
}

fn random_interval_mat(samples: &mut RandomSource) -> IntervalMat {
    let [a, b, c] = [(); 3].map(|()| random_interval_vec(samples));
    IntervalMat {
        middle: DMat3::from_cols(a.middle, b.middle, c.middle),
        radius: DMat3::from_cols(a.radius, b.radius, c.radius),
    }
}

fn random_member_vec(of: IntervalVec, samples: &mut RandomSource) -> DVec3 {
    of.middle + of.radius * samples.vector(1.0)
}

fn random_member_mat(of: IntervalMat, samples: &mut RandomSource) -> DMat3 {
    let column = |k: usize| IntervalVec {
        middle: of.middle.col(k),
        radius: of.radius.col(k),
    };
    let [a, b, c] = [0, 1, 2].map(|k| random_member_vec(column(k), samples));
    DMat3::from_cols(a, b, c)
}

fn contains(interval: Interval, value: f64) -> bool {
    (interval.low() - ROUNDING_TOLERANCE..=interval.high() + ROUNDING_TOLERANCE).contains(&value)
}

fn contains_vec(interval: IntervalVec, value: DVec3) -> bool {
    let off = (value - interval.middle).abs() - interval.radius;
    off.max_element() <= ROUNDING_TOLERANCE
}

#[test]
fn results_contain_those_of_members() {
    let mut samples = RandomSource::new(1);
    for _ in 0..2000 {
        let (u, v) = (
            random_interval_vec(&mut samples),
            random_interval_vec(&mut samples),
        );
        let (m, n) = (
            random_interval_mat(&mut samples),
            random_interval_mat(&mut samples),
        );
        let p = samples.vector(3.0);
        for _ in 0..10 {
            let (x, y) = (
                random_member_vec(u, &mut samples),
                random_member_vec(v, &mut samples),
            );
            let (f, g) = (
                random_member_mat(m, &mut samples),
                random_member_mat(n, &mut samples),
            );
            assert!(contains(u.dot(v), x.dot(y)) && contains(u.dot_vector(p), x.dot(p)));
            assert!(contains(u.dot(v) + u.dot_vector(p), x.dot(y) + x.dot(p)));
            assert!(contains(u.dot(v) - u.dot_vector(p), x.dot(y) - x.dot(p)));
            assert!(
                contains_vec(u.cross(v), x.cross(y)) && contains_vec(u.cross_vector(p), x.cross(p))
            );
            assert!(contains_vec(u + v, x + y) && contains_vec(u - v, x - y));
            assert!(contains_vec(u.minus_point(p), x - p));
            assert!(contains_vec(m * p, f * p) && contains_vec(m * u, f * x));
            let (product, sum) = (m * n, m.transpose() + n);
            let both = [(product, f * g), (sum, f.transpose() + g)];
            for (interval, value) in both {
                let off = value - interval.middle;
                assert!((0..3).all(|k| {
                    (off.col(k).abs() - interval.radius.col(k)).max_element() <= ROUNDING_TOLERANCE
                }));
            }
            assert!((x.abs() - u.magnitude()).max_element() <= ROUNDING_TOLERANCE);
            assert!((u.mignitude() - x.abs()).max_element() <= ROUNDING_TOLERANCE);
        }
    }
}

#[test]
fn arcs_are_the_ranges_of_cosine_and_sine() {
    for half in [0.0, 1e-9, 0.3, 1.5, 1.6, 3.0, 3.2, 40.0] {
        let arc = SineCosineRange::new(half);
        let angles = (-20_000..=20_000).map(|k| half * f64::from(k) / 20_000.0);
        let (mut least, mut most) = (f64::INFINITY, 0.0);
        for angle in angles {
            assert!(
                contains(arc.cos, angle.cos())
                    && angle.sin().abs() <= arc.sin_radius + ROUNDING_TOLERANCE
            );
            least = lesser(least, angle.cos());
            most = greater(most, angle.sin());
        }
        assert!((arc.cos.low() - least).abs() < 1e-5 && (arc.sin_radius - most).abs() < 1e-5);
        assert!((arc.cos.high() - 1.0).abs() < ROUNDING_TOLERANCE);
    }
}

#[test]
fn zero_is_excluded_only_where_it_is_not() {
    let interval = |middle, radius| Interval { middle, radius };
    assert!(interval(1.0, 0.5).excludes_zero() && interval(-1.0, 0.5).excludes_zero());
    assert!(!interval(0.5, 0.5).excludes_zero() && !interval(f64::NAN, 0.5).excludes_zero());
}
