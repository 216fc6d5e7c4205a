//! Tests that curves interpolate the given values, and that invalid curves are refused.

use super::*;
use crate::cell::Cell;
use crate::pairs::LinkPairs;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::{Body, Pose, trajectory};

/// Returns the time derivatives of a joint's position at both ends of a segment.
fn derivatives(curve: &JointCurve, segment: usize, joint: usize) -> [[f64; 3]; 2] {
    let duration = curve.times[segment + 1] - curve.times[segment];
    [0.0, 1.0].map(|fraction| {
        let about = curve.polynomial(segment, joint).expanded_about(fraction);
        let [position, velocity, half_acceleration] =
            [0, 1, 2].map(|power| about.coefficient(power));
        [
            position,
            velocity / duration,
            2.0 * half_acceleration / duration.powi(2),
        ]
    })
}

#[test]
fn hermite_curves_have_the_derivatives_that_are_given() {
    let times = [0.5, 0.75, 2.75, 3.0];
    let positions = [[0.1, 2.0], [0.3, -1.0], [0.2, 0.5], [-0.4, 0.0]];
    let velocities = [[0.0, 0.7], [1.0, -2.0], [0.0, 0.25], [0.3, 0.0]];
    let accelerations = [[2.0, 0.0], [-1.0, 0.5], [0.0, 4.0], [1.0, 1.0]];
    let cubic = JointCurve::cubic_hermite(&times, &positions, &velocities).unwrap();
    let quintic =
        JointCurve::quintic_hermite(&times, &positions, &velocities, &accelerations).unwrap();
    for segment in 0..3 {
        for joint in 0..2 {
            let rows = [segment, segment + 1];
            let expected = rows.map(|k| {
                [
                    positions[k][joint],
                    velocities[k][joint],
                    accelerations[k][joint],
                ]
            });
            for (curve, orders) in [(&cubic, 2), (&quintic, 3)] {
                let found = derivatives(curve, segment, joint);
                for (found, expected) in found.iter().zip(&expected) {
                    for (found, expected) in found.iter().zip(expected).take(orders) {
                        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
                    }
                }
            }
        }
    }
    // The polynomials in time give the same curve.
    let polynomials: Vec<Vec<Vec<f64>>> = (0..3)
        .map(|segment| {
            let duration = times[segment + 1] - times[segment];
            let of_joint = |joint: usize| {
                let powers = (0..=3i32).map(|power| {
                    let own = cubic.coefficient(segment, power as usize, joint);
                    own.value() / duration.powi(power)
                });
                powers.collect()
            };
            (0..2).map(of_joint).collect()
        })
        .collect();
    let same = JointCurve::from_polynomials(&times, &polynomials).unwrap();
    for k in -4..=40 {
        let time = f64::from(k) / 10.0;
        let pairs = same.positions(time).into_iter().zip(cubic.positions(time));
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12));
    }
    let end = PathPoint {
        segment: 2,
        fraction: 1.0,
    };
    let last = cubic.positions(9.0);
    assert!(cubic.time(end) == 3.0 && (last[0] + 0.4).abs() < 1e-15 && last[1] == 0.0);
}

#[test]
fn wrong_curves_are_refused() {
    let line = |from: f64, rate: f64| vec![vec![from, rate]];
    let refused = |times: &[f64], segments: &[Vec<Vec<f64>>]| {
        let error = JointCurve::from_polynomials(times, segments).unwrap_err();
        error.to_string()
    };
    let two = [line(0.0, 1.0), line(1.0, 0.0)];
    assert!(JointCurve::from_polynomials(&[0.0, 1.0, 2.0], &two).is_ok());
    assert_eq!(refused(&[], &[]), "a curve needs at least two times, not 0");
    assert_eq!(
        refused(&[0.0, 1.0], &two),
        "2 segments instead of 1, at index 0"
    );
    for wrong in [
        [0.0, 1.0, 1.0],
        [0.0, f64::NAN, 1.0],
        [0.0, 1.0, f64::INFINITY],
    ] {
        let error = refused(&wrong, &two);
        assert!(
            error.contains("do not increase, or are not finite"),
            "{error}"
        );
    }
    assert_eq!(
        refused(&[0.0, 1.0, 2.0], &[line(0.0, 1.0), line(1.5, 0.0)]),
        "joint 0 jumps by 0.5 at the start of segment 1"
    );
    assert_eq!(
        refused(&[0.0, 1.0], &[line(f64::NAN, 1.0)]),
        "segment 0: a coefficient of joint 0 is not finite"
    );
    assert_eq!(
        refused(&[0.0, 1.0], &[vec![vec![1.0; 11]]]),
        "a polynomial has the degree 10; at most 9 is supported"
    );
    let uneven = [line(0.0, 1.0), vec![vec![1.0], vec![0.0]]];
    assert_eq!(
        refused(&[0.0, 1.0, 2.0], &uneven),
        "2 joints instead of 1, at index 1"
    );
}

/// Tests that a curve is refused if a joint leaves its limits between the ends of a segment, but not if it only
/// reaches them.
#[test]
fn a_curve_stays_within_the_limits() {
    let slider = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joint = Joint {
        name: "slider".into(),
        parent: "rail".into(),
        child: "ball".into(),
        geometry: slider.with_limits(-1.0..=1.0),
        position_rule: PositionRule::Independent,
    };
    let ball = Link::named("ball").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let robot = Robot::new(vec![Link::named("rail"), ball], vec![joint]).unwrap();
    let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
    let far = Pose::at([0.0, 9.0, 0.0]).unwrap();
    cell.add_obstacle("post", Body::sphere(0.1).unwrap(), far)
        .unwrap();
    // 4 s (1 - s) h has the value h at the midpoint.
    let hump = |height: f64| {
        let segments = [vec![vec![0.0, 4.0 * height, -4.0 * height]]];
        JointCurve::from_polynomials(&[0.0, 1.0], &segments).unwrap()
    };
    for height in [0.5, 1.0, -1.0] {
        assert!(cell.solver().is_free(&hump(height)).unwrap(), "{height}");
    }
    let line = |rate: f64| {
        let segments = [vec![vec![0.0, rate]]];
        JointCurve::from_polynomials(&[0.0, 1.0], &segments).unwrap()
    };
    assert!(cell.solver().is_free(&line(1.0)).is_ok());
    assert!(cell.solver().is_free(&line(1.0 + 1e-9)).is_err());
    // Dividing by this duration and multiplying by it again does not give 1.
    let still = JointCurve::cubic_hermite(&[0.0, 49.0], &[[1.0], [1.0]], &[[0.0], [0.0]]).unwrap();
    assert!(cell.solver().is_free(&still).is_ok() && still.positions(0.0) == [1.0]);
    for height in [1.001, -2.0] {
        let error = cell.solver().is_free(&hump(height)).unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("segment 0, after 0.5 of it: joint `slider`: the joint is at"),
            "{error}"
        );
    }
    let two = JointCurve::cubic_hermite(&[0.0, 1.0], &[[0.0; 2]; 2], &[[0.0; 2]; 2]).unwrap();
    let error = cell.solver().is_free(&two).unwrap_err();
    assert!(
        error.to_string().contains("2 positions for 1 joints"),
        "{error}"
    );
}

/// Tests that constants are curves, and that times of points are rounded down, also far from 0.
#[test]
fn constants_are_curves_and_times_are_rounded_down() {
    let constant = JointCurve::from_polynomials(&[0.0, 1.0], &[vec![vec![0.5]]]).unwrap();
    assert_eq!(constant.positions(0.3), [0.5]);
    let none = JointCurve::from_polynomials(&[0.0, 1.0], &[vec![vec![]]]).unwrap_err();
    assert_eq!(none.to_string(), "0 coefficients instead of 1, at index 0");
    let start = 1e15;
    let curve = JointCurve::from_polynomials(&[start, start + 2.0], &[vec![vec![0.0, 1.0]]]);
    let curve = curve.unwrap();
    for (fraction, latest) in [(0.0, 0.0), (0.499875, 0.99975), (1.0, 2.0)] {
        let time = curve.time(PathPoint {
            segment: 0,
            fraction,
        }) - start;
        assert!((0.0..=latest).contains(&time), "{fraction}: {time}");
        let time = curve.latest_time(PathPoint {
            segment: 0,
            fraction,
        }) - start;
        assert!((latest..=2.0).contains(&time), "{fraction}: {time}");
    }
}

/// Tests that a small jump is refused if another joint follows with a large multiplier.
#[test]
fn a_jump_counts_for_the_joints_that_follow() {
    let slider = |name: &str, position_rule| Joint {
        name: name.into(),
        parent: "rail".into(),
        child: format!("{name} link"),
        geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap(),
        position_rule,
    };
    let follows = PositionRule::Follows {
        joint: "own".into(),
        multiplier: 1e6,
        offset: 0.0,
    };
    let joints = vec![
        slider("own", PositionRule::Independent),
        slider("other", follows),
    ];
    let links = ["rail", "own link", "other link"].map(Link::named).to_vec();
    let robot = Robot::new(links, joints).unwrap();
    let cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
    let steps = [vec![vec![0.0]], vec![vec![5e-10]]];
    let curve = JointCurve::from_polynomials(&[0.0, 1.0, 2.0], &steps).unwrap();
    let error = cell.solver().is_free(&curve).unwrap_err();
    assert_eq!(
        error.to_string(),
        "joint 0 jumps by 0.0005 at the start of segment 1"
    );
}

/// Tests that coefficients are scaled without rounding if a duration is not a power of two.
#[test]
fn polynomials_are_taken_as_they_are_given() {
    use crate::rational::exact_fraction;
    let given = [
        0.3, -1e5, 3e5, -2.2e6, 7e6, -1e7, 9.9e6, -5e6, 1.1e6, -1.3e5,
    ];
    let times = [0.1, 0.4];
    let curve = JointCurve::from_polynomials(&times, &[vec![given.to_vec()]]).unwrap();
    let duration = exact_fraction(times[1]) - exact_fraction(times[0]);
    for fraction in [0.25, 0.7, 1.0] {
        let time = exact_fraction(fraction) * &duration;
        let horner = |value: dashu_ratio::Relaxed, &own: &f64| value * &time + exact_fraction(own);
        let expected = given.iter().rev().fold(exact_fraction(0.0), horner);
        let found = curve.polynomial(0, 0).value(fraction);
        let error = (exact_fraction(found) - &expected).to_f64().value().abs();
        assert!(
            error <= 0.5 * f64::EPSILON * found.abs(),
            "{found}: {error}"
        );
    }
}
