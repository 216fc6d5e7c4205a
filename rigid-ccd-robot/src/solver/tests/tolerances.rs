//! Tests that answers meet the tolerance that they report: on curves with cancelling coefficients, far from the base,
//! and after thousands of turns.

use super::*;
use crate::joint_curve::JointCurve;
use ccd_core::double_double::DoubleDouble;
use rigid_ccd::glam::DQuat;
use std::f64::consts::TAU;

/// A chain of links, each with one ball beside its joint's axis.
pub(super) struct BallArm {
    pub(super) cell: Cell,
    pub(super) joints: Vec<BallJoint>,
    post: DVec3,
    radii: f64,
}

/// A joint along or about an axis of the base's frame, at an offset from the previous joint.
#[derive(Clone, Copy)]
pub(super) struct BallJoint {
    pub(super) offset: DVec3,
    pub(super) axis: DVec3,
    pub(super) turns: bool,
}

const RADIUS: f64 = 0.1;

impl BallArm {
    /// Creates a robot with a ball on its last link only, and a post with a second ball.
    pub(super) fn new(joints: Vec<BallJoint>, post: DVec3) -> Self {
        let name = |k: usize| format!("link{k}");
        let mut links: Vec<Link> = (0..=joints.len()).map(|k| Link::named(name(k))).collect();
        let last = links.pop().unwrap();
        links.push(last.with_body(Body::sphere(RADIUS).unwrap(), Pose::IDENTITY));
        let made = joints.iter().enumerate().map(|(k, joint)| {
            let (origin, axis) = (Pose::at(joint.offset).unwrap(), joint.axis.to_array());
            let made = if joint.turns {
                trajectory::Joint::revolute(origin, axis)
            } else {
                trajectory::Joint::prismatic(origin, axis)
            };
            Joint {
                name: format!("joint{k}"),
                parent: name(k),
                child: name(k + 1),
                geometry: made.unwrap(),
                position_rule: PositionRule::Independent,
            }
        });
        let robot = Robot::new(links, made.collect()).unwrap();
        let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
        let ball = Body::sphere(RADIUS).unwrap();
        cell.add_obstacle("post", ball, Pose::at(post).unwrap())
            .unwrap();
        BallArm {
            cell,
            joints,
            post,
            radii: 2.0 * RADIUS,
        }
    }

    /// Returns the center of the ball at given joint positions.
    pub(super) fn ball(&self, positions: &[f64]) -> DVec3 {
        let steps = self.joints.iter().zip(positions).rev();
        steps.fold(DVec3::ZERO, |at, (joint, &position)| {
            joint.offset
                + if joint.turns {
                    DQuat::from_axis_angle(joint.axis, position) * at
                } else {
                    at + position * joint.axis
                }
        })
    }

    pub(super) fn distance(&self, positions: &[f64]) -> f64 {
        (self.ball(positions) - self.post).length() - self.radii
    }
}

fn slide() -> BallJoint {
    BallJoint {
        offset: DVec3::ZERO,
        axis: DVec3::X,
        turns: false,
    }
}

fn settings(margin: f64, tolerance: f64) -> Settings {
    Settings {
        margin,
        tolerance,
        ..Settings::DEFAULT
    }
}

/// Returns the integer coefficients of a Chebyshev polynomial on [0, 1].
fn chebyshev(degree: usize) -> Vec<f64> {
    let mut last = [vec![1.0], vec![-1.0, 2.0]];
    for _ in 1..degree {
        let [before, now] = &last;
        let mut next = vec![0.0; now.len() + 1];
        for (power, coefficient) in now.iter().enumerate() {
            next[power] -= 2.0 * coefficient;
            next[power + 1] += 4.0 * coefficient;
        }
        for (power, coefficient) in before.iter().enumerate() {
            next[power] -= coefficient;
        }
        last = [now.clone(), next];
    }
    let [first, second] = last;
    if degree == 0 { first } else { second }
}

/// Tests a joint that swings between -1 and 1 with a ball 0.3 away from the post. With a slightly smaller margin there
/// is no contact, although the absolute values of the coefficients add up to 4 million.
#[test]
fn a_curve_whose_coefficients_cancel_keeps_the_tolerance() {
    let arm = BallArm::new(vec![slide()], 1.5 * DVec3::X);
    let curve = JointCurve::from_polynomials(&[0.0, 1.0], &[vec![chebyshev(9)]]).unwrap();
    let mut solver = arm.cell.solver().with_settings(settings(0.3 - 3e-7, 1e-8));
    assert_eq!(
        solver.first_contact(&curve).unwrap().outcome,
        PathOutcome::Free
    );
    assert_eq!(solver.met_tolerance(), 1e-8);
    let closest = solver.closest_approach(&curve).unwrap().outcome;
    assert!(
        closest.lower() <= 0.3 && 0.3 <= closest.upper(),
        "{closest:?}"
    );
    assert!(closest.upper() - closest.lower() <= 1.001e-8, "{closest:?}");
    assert_eq!(solver.met_tolerance(), 1e-8);
}

#[test]
fn hinges_on_curves_whose_coefficients_cancel_keep_the_tolerance() {
    let hinge = BallJoint {
        offset: 0.3 * DVec3::X,
        axis: DVec3::Z,
        turns: true,
    };
    let mut joints = vec![hinge; 7];
    joints.push(BallJoint {
        offset: 0.3 * DVec3::X,
        ..slide()
    });
    let arm = BallArm::new(joints, DVec3::new(2.6, 1.2, 0.0));
    let swing: Vec<f64> = chebyshev(9).iter().map(|own| 0.25 * own).collect();
    let mut all = vec![swing; 7];
    all.push(vec![0.0]);
    let curve = JointCurve::from_polynomials(&[0.0, 1.0], &[all]).unwrap();
    let mut solver = arm.cell.solver().with_settings(settings(0.0, 1e-6));
    let closest = solver.closest_approach(&curve).unwrap().outcome;
    assert!(closest.limit().is_none() && closest.upper() > 0.0);
    assert!(closest.upper() - closest.lower() <= 1.001e-6, "{closest:?}");
    assert_eq!(solver.met_tolerance(), 1e-6);
}

/// Tests straight edges whose rounding exceeds the tolerance: answers report a larger tolerance and meet it.
#[test]
fn edges_state_the_tolerance_that_they_meet() {
    let far = |distance: f64| {
        let offset = BallJoint {
            offset: distance * DVec3::X,
            ..slide()
        };
        let arm = BallArm::new(vec![offset], (distance + 1.5) * DVec3::X);
        (arm, vec![vec![0.0], vec![3.0]])
    };
    let turning = |turns: f64| {
        let hinge = BallJoint {
            axis: DVec3::Z,
            turns: true,
            ..slide()
        };
        let arm = BallJoint {
            offset: DVec3::X,
            ..slide()
        };
        let arm = BallArm::new(vec![hinge, arm], DVec3::new(1.0, 0.7, 0.4));
        (arm, vec![vec![0.0, 0.0], vec![turns * TAU, 0.2]])
    };
    for ((arm, path), tolerance, is_raised) in [
        (far(1.0), 1e-8, false),
        (far(1e5), 1e-6, false),
        (far(1e5), 1e-9, true),
        (turning(3.0), 1e-9, false),
        (turning(5000.0), 1e-10, true),
    ] {
        let mut solver = arm.cell.solver().with_settings(settings(0.25, tolerance));
        let PathOutcome::Contact(contact) = solver.first_contact(&path).unwrap().outcome else {
            panic!("the ball passes the post");
        };
        let met = solver.met_tolerance();
        let at = configuration_between(&path[0], &path[1], contact.at.fraction);
        let distance = arm.distance(&at);
        assert!(distance <= 0.25 + met, "{distance} {met}");
        let closest = solver.closest_approach(&path).unwrap().outcome;
        let width = closest.upper() - closest.lower();
        assert!(width <= 1.001 * solver.met_tolerance(), "{closest:?}");
        for met in [met, solver.met_tolerance()] {
            assert_eq!(met > tolerance, is_raised, "{met} instead of {tolerance}");
            assert!(met < 1e3 * tolerance, "{met}");
        }
        assert!(!solver.is_free(&path).unwrap() && solver.met_tolerance() >= tolerance);
    }
}

/// Returns the coefficients of a random polynomial with values of about 1, in one of three forms.
fn random_values(random: &mut Pcg64) -> Vec<f64> {
    let degree = random.random_range(1..=9);
    let weights: Vec<f64> = (0..=degree)
        .map(|_| random.random_range(-1.0..1.0))
        .collect();
    let mut sum = vec![0.0; degree + 1];
    let mut add = |weight: f64, powers: &[f64]| {
        for (own, power) in sum.iter_mut().zip(powers) {
            *own += weight * power;
        }
    };
    match random.random_range(0..4) {
        0 => add(1.0, &chebyshev(degree)),
        1 => {
            for (k, weight) in weights.iter().enumerate() {
                add(*weight, &chebyshev(k)[..=k]);
            }
        }
        2 => {
            // Bernstein polynomials: Σ (n over k) (k' over i) (−1)ⁱ sᵏ⁺ⁱ, with k' = n − k.
            let binomial = |n: usize, k: usize| {
                (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
            };
            for (k, weight) in weights.iter().enumerate() {
                for i in 0..=degree - k {
                    let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
                    let mut power = vec![0.0; degree + 1];
                    power[k + i] = sign * binomial(degree, k) * binomial(degree - k, i);
                    add(*weight, &power);
                }
            }
        }
        _ => add(1.0, &weights),
    }
    sum
}

/// Returns the positions of all joints on a curve of one segment, computed in double-double precision.
fn referee_positions(curve: &JointCurve, joint_count: usize, fraction: f64) -> Vec<f64> {
    let joints = (0..joint_count).map(|joint| {
        let powers = (0..=curve.degree()).rev();
        let value = powers.fold(DoubleDouble::default(), |value, power| {
            curve.coefficient(0, power, joint) + value * DoubleDouble::from(fraction)
        });
        value.value()
    });
    joints.collect()
}

/// Tests random curves at many scales against samples: no contact is late, and each is within the margin and the
/// reported tolerance.
#[test]
fn random_curves_keep_the_tolerance_that_they_state() {
    let mut random = Pcg64::seed_from_u64(75);
    let [mut free, mut contacts, mut raised] = [0; 3];
    for number in 0..300 {
        let scale = 10f64.powf(random.random_range(-2.0..5.0));
        let count = random.random_range(1..4);
        let joints: Vec<BallJoint> = (0..count)
            .map(|k| BallJoint {
                offset: random_offset(&mut random),
                axis: random_offset(&mut random).normalize(),
                turns: k % 2 == 1,
            })
            .collect();
        let size = |joint: &BallJoint| if joint.turns { 3.0 } else { scale };
        let start = random.random_range(-1e3..1e3);
        let duration = 10f64.powf(random.random_range(-3.0..4.0));
        let polynomials: Vec<Vec<f64>> = joints
            .iter()
            .map(|joint| {
                let fractions = random_values(&mut random).into_iter().enumerate();
                let scaled =
                    fractions.map(|(power, own)| size(joint) * own / duration.powi(power as i32));
                scaled.collect()
            })
            .collect();
        let times = [start, start + duration];
        let curve = JointCurve::from_polynomials(&times, &[polynomials]).unwrap();
        let aim = random.random_range(0.0..1.0);
        let aimed = referee_positions(&curve, count, aim);
        let mut arm = BallArm::new(joints, DVec3::ZERO);
        // The post is beside a point where the ball passes.
        let beside = random_offset(&mut random).normalize() * random.random_range(0.0..0.6);
        let at = arm.ball(&aimed) + beside;
        arm = BallArm::new(arm.joints, at);

        let margin = [0.0, 0.3][number % 2];
        let tolerance = 10f64.powf(random.random_range(-10.0..-3.0));
        let mut solver = arm.cell.solver().with_settings(settings(margin, tolerance));
        let outcome = solver.first_contact(&curve).unwrap().outcome;
        let met = solver.met_tolerance();
        raised += usize::from(met > tolerance);
        let rounding = 64.0 * f64::EPSILON * (1.0 + scale) * count as f64;
        let until = match outcome {
            PathOutcome::Free => 1.0,
            PathOutcome::Contact(contact) => {
                contacts += 1;
                let there = referee_positions(&curve, count, contact.at.fraction);
                let distance = arm.distance(&there);
                assert!(
                    distance <= margin + 1.001 * met + rounding,
                    "{number}: {distance} of {met} {tolerance}"
                );
                assert!(met <= 1.001 * greater(tolerance, 1e4 * rounding), "{met}");
                contact.at.fraction
            }
            _ => panic!("{number}: {outcome:?}"),
        };
        free += usize::from(outcome == PathOutcome::Free);
        for k in 0..1000 {
            let fraction = until * f64::from(k) / 1000.0;
            if fraction == until {
                break;
            }
            let distance = arm.distance(&referee_positions(&curve, count, fraction));
            assert!(
                distance > margin - rounding,
                "{number}: {distance} at {fraction} before {until}"
            );
        }
        assert_eq!(curve.segment_count(), 1);
    }
    assert!(
        free > 40 && contacts > 100 && raised > 5,
        "{free} {contacts} {raised}"
    );
}

pub(super) fn random_offset(random: &mut Pcg64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| random.random_range(-1.0..1.0)))
}
