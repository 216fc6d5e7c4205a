//! Tests that interval operations contain the exact results, computed as fractions, and are tight.

use super::super::interval::{Interval, point_interval};
use dashu_ratio::Relaxed;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// The number of random pairs of operands for each operation.
const RANDOM_PAIR_COUNT: u32 = 20_000;

/// Special floats, such as the least and the largest ones, and those whose squares are barely normal or finite.
const SPECIAL_FLOATS: [f64; 12] = [
    0.0,
    5e-324,
    1e-323,
    2.225_073_858_507_201e-308,
    f64::MIN_POSITIVE,
    1.49e-154,
    1.0,
    1.0 + f64::EPSILON,
    3.0,
    1.34e154,
    f64::MAX / 2.0,
    f64::MAX,
];

fn random_float(rng: &mut impl Rng) -> f64 {
    let size = match rng.random_range(0..5) {
        0 => SPECIAL_FLOATS[rng.random_range(0..SPECIAL_FLOATS.len())],
        1 => f64::from(rng.random_range(0_u32..9)),
        2 => rng.random_range(0.5..2.0),
        // Denormal ones, and any.
        3 => f64::from_bits(rng.random_range(0..1_u64 << 53)),
        _ => f64::from_bits(rng.random_range(0..f64::INFINITY.to_bits())),
    };
    if rng.random() { size } else { -size }
}

/// Returns a random interval: a single float, two neighbouring floats, or a wide interval.
fn random_interval(rng: &mut impl Rng) -> Interval {
    let x = random_float(rng);
    let y = match rng.random_range(0..3) {
        0 => x,
        1 if x < f64::MAX => x.next_up(),
        _ => random_float(rng),
    };
    if x <= y {
        Interval::new(x, y)
    } else {
        Interval::new(y, x)
    }
}

fn to_rational(x: f64) -> Relaxed {
    Relaxed::try_from(x).expect("a finite number")
}

/// Returns three exact numbers in an interval to test with: its bounds and its middle.
fn sample_numbers(x: Interval) -> [Relaxed; 3] {
    [x.inf(), x.midpoint(), x.sup()].map(to_rational)
}

fn is_below(x: f64, exact: &Relaxed) -> bool {
    x == f64::NEG_INFINITY || x < f64::INFINITY && to_rational(x) < *exact
}

fn is_above(x: f64, exact: &Relaxed) -> bool {
    is_below(-x, &-exact)
}

fn contains(found: Interval, exact: &Relaxed) -> bool {
    !is_above(found.inf(), exact) && !is_below(found.sup(), exact)
}

/// Asserts that an interval contains all exact results, and exceeds their range by at most two floats on each side.
fn assert_tight(found: Interval, results: &[Relaxed], context: &str) {
    for exact in results {
        assert!(
            contains(found, exact),
            "{context}: {found:?} is without {exact}"
        );
    }
    let [inf, sup] = [
        found.inf().next_up().next_up(),
        found.sup().next_down().next_down(),
    ];
    assert!(
        results.iter().any(|exact| is_above(inf, exact))
            && results.iter().any(|exact| is_below(sup, exact)),
        "{context}: {found:?} is wide"
    );
}

fn results_for_all_pairs(
    x: Interval,
    y: Interval,
    law: impl Fn(&Relaxed, &Relaxed) -> Relaxed,
) -> Vec<Relaxed> {
    let pairs = |a: &Relaxed| sample_numbers(y).map(|b| law(a, &b));
    sample_numbers(x).iter().flat_map(pairs).collect()
}

#[test]
fn sums_products_and_quotients_hold_the_exact_ones_tightly() {
    let mut rng = Pcg64::seed_from_u64(11);
    let mut quotients = 0;
    for _ in 0..RANDOM_PAIR_COUNT {
        let [x, y] = [(); 2].map(|()| random_interval(&mut rng));
        let named = |operation: &str| format!("{x:?} {operation} {y:?}");
        assert_tight(
            x + y,
            &results_for_all_pairs(x, y, |a, b| a + b),
            &named("+"),
        );
        assert_tight(
            x - y,
            &results_for_all_pairs(x, y, |a, b| a - b),
            &named("-"),
        );
        assert_tight(
            x * y,
            &results_for_all_pairs(x, y, |a, b| a * b),
            &named("*"),
        );
        if contains(y, &Relaxed::ZERO) {
            assert_eq!(x / y, Interval::ALL_REALS);
        } else {
            quotients += 1;
            assert_tight(
                x / y,
                &results_for_all_pairs(x, y, |a, b| a / b),
                &named("/"),
            );
        }
    }
    assert!(quotients > RANDOM_PAIR_COUNT / 3, "{quotients}");
}

#[test]
fn squares_and_roots_hold_the_exact_ones_tightly_and_are_not_negative() {
    let mut rng = Pcg64::seed_from_u64(12);
    let mut roots = 0;
    for _ in 0..RANDOM_PAIR_COUNT {
        let x = random_interval(&mut rng);
        let straddles = contains(x, &Relaxed::ZERO);
        let mut squares = sample_numbers(x).map(|a| &a * &a).to_vec();
        let mut sizes = [x.inf(), x.sup()].map(f64::abs).to_vec();
        if straddles {
            squares.push(Relaxed::ZERO);
            sizes.push(0.0);
        }
        assert_tight(x.sqr(), &squares, &format!("the square of {x:?}"));
        assert!(x.sqr().inf() >= 0.0);
        sizes.sort_by(f64::total_cmp);
        let (least, most) = (sizes[0], sizes[sizes.len() - 1]);
        assert_eq!(x.abs(), Interval::new(least, most));
        assert_eq!(x.magnitude(), most);
        if x.sup() < 0.0 {
            assert_eq!(x.sqrt(), Interval::ALL_REALS);
            continue;
        }
        roots += 1;
        // A root lies between two numbers as its square does between theirs.
        let [inf, sup] = [x.sqrt().inf(), x.sqrt().sup()];
        let [low, high] = [if straddles { 0.0 } else { x.inf() }, x.sup()].map(to_rational);
        let square = |root: f64| to_rational(root) * to_rational(root);
        assert!(
            inf >= 0.0 && square(inf) <= low && high <= square(sup),
            "{x:?}"
        );
        assert!(low < square(inf.next_up().next_up()), "{x:?}");
        assert!(
            sup == 0.0 || square(sup.next_down().next_down()) < high,
            "{x:?}"
        );
    }
    assert!(roots > RANDOM_PAIR_COUNT / 3, "{roots}");
}

#[test]
fn middles_and_radii_reach_both_bounds() {
    let mut rng = Pcg64::seed_from_u64(13);
    for _ in 0..RANDOM_PAIR_COUNT {
        let x = random_interval(&mut rng);
        let (mid, rad) = (x.midpoint(), x.radius());
        assert!(x.inf() <= mid && mid <= x.sup(), "{x:?}");
        let reached = [
            to_rational(mid) - to_rational(x.inf()),
            to_rational(x.sup()) - to_rational(mid),
        ];
        assert!(
            reached.iter().all(|reach| !is_below(rad, reach)),
            "{x:?} {rad}"
        );
        assert!(
            reached.iter().any(|reach| is_below(rad.next_down(), reach)) || rad == 0.0,
            "{x:?} {rad}"
        );
    }
    for x in [Interval::ALL_REALS, Interval::new(1.0, f64::INFINITY)] {
        assert_eq!([x.midpoint(), x.radius()], [0.0, f64::INFINITY]);
    }
}

#[test]
fn results_that_are_floats_stay_exact_where_nothing_is_multiplied() {
    let x = Interval::new(-3.0, 5.0);
    assert_eq!(x + point_interval(0.25), Interval::new(-2.75, 5.25));
    assert_eq!(x - point_interval(5.0), Interval::new(-8.0, 0.0));
    assert_eq!(-x, Interval::new(-5.0, 3.0));
    assert_eq!(x * point_interval(0.0), point_interval(0.0));
    assert_eq!(
        point_interval(0.0) / point_interval(7.0),
        point_interval(0.0)
    );
    assert_eq!(
        [point_interval(0.0).sqr(), point_interval(0.0).sqrt()],
        [point_interval(0.0); 2]
    );
    assert_eq!(
        x.intersection(Interval::new(-9.0, 2.0)),
        Interval::new(-3.0, 2.0)
    );
    // 1/3 is not a float: both are neighbours of it.
    let third = point_interval(1.0) / point_interval(3.0);
    assert!(third.inf() < third.sup() && third.radius() < 1e-16);
}

#[test]
fn half_of_pi_is_between_its_bounds() {
    // 37 decimals; the next ones are 98.
    let digits = Relaxed::from(15_707_963_267_948_966_192_313_216_916_397_514_420_u128);
    let half_pi = digits / Relaxed::from(10_u128.pow(37));
    assert_tight(Interval::FRAC_PI_2, &[half_pi], "π/2");
}

#[test]
fn undefined_results_are_the_whole_line() {
    let infinity = f64::INFINITY;
    for x in [f64::NAN, infinity, -infinity] {
        assert_eq!(point_interval(x), Interval::ALL_REALS);
    }
    for (inf, sup) in [(2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::NAN)] {
        assert_eq!(Interval::new(inf, sup), Interval::ALL_REALS);
    }
    let half_line = Interval::new(1.0, infinity);
    let doubtful = [
        point_interval(0.0) * half_line,
        point_interval(0.0) * Interval::ALL_REALS,
        half_line / point_interval(0.0),
        point_interval(1.0) / point_interval(0.0),
        point_interval(1.0) / point_interval(-0.0),
        point_interval(1.0) / Interval::new(0.0, 1.0),
        point_interval(-1.0).sqrt(),
        point_interval(1.0).intersection(point_interval(2.0)),
        Interval::ALL_REALS + point_interval(1.0),
        Interval::ALL_REALS - Interval::ALL_REALS,
        half_line - half_line,
    ];
    assert_eq!(doubtful, [Interval::ALL_REALS; 11]);
}

#[test]
fn half_lines_hold_what_is_beyond_every_float() {
    let half_line = Interval::new(1.0, f64::INFINITY);
    let overflow = point_interval(f64::MAX) + point_interval(f64::MAX);
    assert_eq!(overflow, Interval::new(f64::MAX, f64::INFINITY));
    assert_eq!(point_interval(f64::MAX) * point_interval(-2.0), -overflow);
    assert_eq!((half_line + half_line).sup(), f64::INFINITY);
    assert_eq!((half_line * point_interval(-2.0)).inf(), f64::NEG_INFINITY);
    assert!((half_line * point_interval(-2.0)).sup() >= -2.0);
    assert_eq!(half_line.sqr().sup(), f64::INFINITY);
    assert_eq!(half_line.sqrt().sup(), f64::INFINITY);
    assert_eq!(Interval::ALL_REALS.sqr(), Interval::new(0.0, f64::INFINITY));
    assert_eq!(
        Interval::ALL_REALS.sqrt(),
        Interval::new(0.0, f64::INFINITY)
    );
    assert_eq!(Interval::ALL_REALS.abs(), Interval::new(0.0, f64::INFINITY));
    // The quotients by ever larger numbers come near 0.
    let small = point_interval(1.0) / half_line;
    assert!(small.inf() <= 0.0 && 1.0 <= small.sup() && small.sup() < 1.1);
    for quotient in [half_line / half_line, -half_line / -half_line] {
        assert!(quotient.inf() <= 0.0 && quotient.sup() == f64::INFINITY);
    }
    let straddling = Interval::new(-1.0, 2.0);
    assert_eq!(straddling * half_line, Interval::ALL_REALS);
    assert_eq!(straddling * Interval::ALL_REALS, Interval::ALL_REALS);
    assert_eq!(Interval::ALL_REALS / half_line, Interval::ALL_REALS);
    assert!((Interval::new(0.0, 1.0) * half_line).inf() >= 0.0);
}
