//! Tests that random trajectories deviate by no more than their bounds, by adversarial sampling.

mod extremes;

use super::*;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Pose};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::io::Write;

type Rng = Pcg64;

fn random_vector(rng: &mut Rng, size: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| rng.random_range(-size..size)))
}

fn random_orientation(rng: &mut Rng) -> DQuat {
    DQuat::from_array([(); 4].map(|()| rng.random_range(-1.0..1.0))).normalize()
}

fn random_pose(rng: &mut Rng, size: f64) -> Pose {
    Pose::new(random_vector(rng, size), random_orientation(rng)).unwrap()
}

/// Returns the number of sampled deviations for each kind of trajectory: 5,000, multiplied by `CCD_TEST_CASES`.
fn draw_count() -> u64 {
    let cases = std::env::var("CCD_TEST_CASES").ok();
    5_000 * cases.map_or(1, |cases| cases.parse().unwrap())
}

/// Checks for random trajectories that the largest ratio of a deviation to its bound is at least `at_least`, and at
/// most 1.
fn check<T: Trajectory>(
    name: &str,
    at_least: f64,
    make: impl Fn(&mut Rng) -> Result<T, InputError>,
) {
    const TRAJECTORY_COUNT: u64 = 50;
    let mut rng = Rng::seed_from_u64(1);
    let mut tightest = 0.0;
    for number in 0..TRAJECTORY_COUNT {
        let trajectory = make(&mut rng).unwrap();
        let worst = worst_deviation(
            &trajectory,
            2.0,
            1.5,
            draw_count() / TRAJECTORY_COUNT,
            number,
        )
        .unwrap();
        assert!(worst.ratio <= 1.0, "{name} {number}: {worst:?}");
        tightest = ccd_core::order::greater(tightest, worst.ratio);
    }
    let draws = draw_count();
    writeln!(std::io::stderr(), "{name}: {tightest:.4} in {draws} draws").unwrap();
    assert!(tightest >= at_least, "{name}: {tightest}");
}

fn random_motion(rng: &mut Rng) -> Result<Motion, InputError> {
    let spin = random_vector(rng, 4.0);
    Motion::about(
        random_pose(rng, 3.0),
        random_vector(rng, 3.0),
        spin,
        random_vector(rng, 1.0),
    )
}

fn random_ballistic(rng: &mut Rng) -> Result<Ballistic, InputError> {
    Ballistic::new(random_motion(rng)?, random_vector(rng, 10.0))
}

fn points(rng: &mut Rng, count: usize) -> Vec<[f64; 3]> {
    (0..count)
        .map(|_| random_vector(rng, 3.0).to_array())
        .collect()
}

/// Returns random orientations with rotations of less than 1 radian from one to the next.
fn keys(rng: &mut Rng, count: usize) -> Vec<(f64, [f64; 4])> {
    let mut at = random_orientation(rng);
    let key = |k| {
        at = DQuat::from_scaled_axis(random_vector(rng, 0.5)) * at;
        (2.0 * k as f64 / (count - 1) as f64, at.to_array())
    };
    (0..count).map(key).collect()
}

/// The choice of the directions of a random chain's joint axes.
#[derive(Clone, Copy, PartialEq)]
enum AxisChoice {
    AnyDirection,
    AllParallel,
    /// The axes are along x, y or z, so that some are parallel to each other.
    AlongCoordinates,
}

fn random_chain(rng: &mut Rng, count: usize, axes: AxisChoice) -> Chain {
    let joint = |k: usize| {
        let axis = match axes {
            AxisChoice::AnyDirection => random_vector(rng, 1.0),
            AxisChoice::AllParallel => DVec3::Z,
            AxisChoice::AlongCoordinates => DVec3::AXES[rng.random_range(0..3)],
        };
        let origin = match axes {
            AxisChoice::AnyDirection => random_pose(rng, 1.0),
            AxisChoice::AllParallel | AxisChoice::AlongCoordinates => {
                Pose::at(random_vector(rng, 1.0)).unwrap()
            }
        };
        let joint = match k % 4 {
            3 => Joint::prismatic(origin, random_vector(rng, 1.0)),
            2 if axes == AxisChoice::AnyDirection => Ok(Joint::fixed(origin)),
            _ => Joint::revolute(origin, axis),
        }?;
        let is_reversed = rng.random_bool(0.5);
        Ok(if is_reversed { joint.reversed() } else { joint })
    };
    let joints: Result<_, InputError> = (0..count).map(joint).collect();
    Chain::new(Pose::IDENTITY, joints.unwrap())
}

/// Tests that the motions of a body in free fall deviate from its trajectory by rounding alone, within their bound.
#[test]
fn thrown() {
    check("ballistic", 0.0, random_ballistic);
}

#[test]
fn poses() {
    check("poses", 0.3, |rng| {
        let count = rng.random_range(2..12);
        let mut time = -0.5;
        let stops = (0..count).map(|_| {
            time += rng.random_range(0.01..0.5);
            (time, random_pose(rng, 3.0))
        });
        PosePath::new(stops.collect())?.about(random_vector(rng, 1.0))
    });
}

/// Tests that a path deviates within its bounds if the given angular velocities miss the next orientation by up to a
/// quarter turn.
#[test]
fn poses_of_many_turns() {
    check("poses, many turns", 0.3, |rng| {
        let (mut time, mut turned) = (-0.5, random_orientation(rng));
        let (mut stops, mut spins) = (Vec::new(), Vec::new());
        for _ in 0..rng.random_range(2..6) {
            stops.push((time, Pose::new(random_vector(rng, 3.0), turned)?));
            let (duration, left) = (rng.random_range(0.1..1.5), random_vector(rng, 0.9));
            let size = [0.1, 3.0, 30.0][rng.random_range(0..3)];
            let spin = random_vector(rng, size);
            spins.push(spin.to_array());
            time += duration;
            let share = [0.0, 1e-6, 1.0][rng.random_range(0..3)];
            turned = DQuat::from_scaled_axis(left * share)
                * DQuat::from_scaled_axis(spin * duration)
                * turned;
        }
        stops.push((time, Pose::new(random_vector(rng, 3.0), turned)?));
        PosePath::new(stops)?
            .with_angular_velocities(spins)?
            .about(random_vector(rng, 1.0))
    });
}

/// Tests that a given angular velocity determines the number of turns between two equal orientations.
#[test]
fn angular_velocities_tell_the_number_of_turns() {
    let still = vec![(0.0, Pose::IDENTITY), (2.0, Pose::IDENTITY)];
    let path = PosePath::new(still).unwrap();
    let turns = std::f64::consts::TAU * 7.0;
    let turning = path
        .clone()
        .with_angular_velocities(vec![[0.0, 0.0, 0.5 * turns]])
        .unwrap();
    for time in [0.1, 0.5, 1.3, 2.0] {
        let exact = DQuat::from_rotation_z(0.5 * turns * time);
        let found = turning.pose(time).unwrap().rotation();
        assert!(found.dot(exact).abs() > 1.0 - 1e-14, "{time}");
    }
    // The leftover to the next pose is always the same: a twentieth of a turn.
    let nearly = path
        .clone()
        .with_angular_velocities(vec![[0.0, 0.0, 0.5 * (turns + 0.3)]])
        .unwrap();
    let stretch = nearly.stretch_between(0.0, 2.0).unwrap();
    assert!(
        (stretch.motion.angular_velocity().z * 2.0 - turns).abs() < 1e-12,
        "{stretch:?}"
    );
    let zero = path
        .clone()
        .with_angular_velocities(vec![[0.0; 3]])
        .unwrap();
    assert_eq!(
        zero.stretch_between(0.0, 2.0)
            .unwrap()
            .motion
            .angular_velocity(),
        DVec3::ZERO
    );
    for bad in [
        vec![],
        vec![[0.0, 0.0, 1.0]],
        vec![[f64::NAN, 0.0, 0.0]],
        vec![[0.0; 3]; 2],
    ] {
        assert!(
            path.clone().with_angular_velocities(bad.clone()).is_err(),
            "{bad:?}"
        );
    }
}

/// Tests that a path deviates within its bounds if the rotations between its poses are half turns, up to rounding.
#[test]
fn poses_of_half_turns() {
    check("poses, half turns", 0.3, |rng| {
        let start = random_orientation(rng);
        let turned = |k: usize, rng: &mut Rng| {
            let axis = random_vector(rng, 1.0).normalize();
            match k % 2 {
                0 => start,
                _ => DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0) * start,
            }
        };
        let stops = (0..4).map(|k| {
            Ok((
                k as f64,
                Pose::new(random_vector(rng, 3.0), turned(k, rng))?,
            ))
        });
        PosePath::new(stops.collect::<Result<_, InputError>>()?)
    });
}

#[test]
fn slerp_of_tiny_turns() {
    check("slerp, tiny turns", 0.0, |rng| {
        let count = 1_000;
        let spin = random_vector(rng, 1e-8);
        let key = |k: usize| {
            let turn = if k < count / 2 {
                k as f64 * spin
            } else {
                (count - k) as f64 * spin
            };
            let exact = DQuat::from_xyzw(0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z, 1.0);
            (2.0 * k as f64 / count as f64, exact.to_array())
        };
        let keys: Vec<_> = (0..=count).map(key).collect();
        Ok(Spline::new(
            Curve::bezier(&[[0.0; 3]], 2.0)?,
            OrientationCurve::piecewise_slerp(&keys)?,
        ))
    });
}

#[test]
fn bezier() {
    check("Bézier curve", 0.5, |rng| {
        let count = rng.random_range(1..7);
        Ok(Spline::new(
            Curve::bezier(&points(rng, count), 2.0)?,
            OrientationCurve::NONE,
        ))
    });
}

#[test]
fn b_spline_and_slerp() {
    check("B-spline, slerp", 0.3, |rng| {
        let curve = Curve::b_spline(&points(rng, 8), 2.0)?;
        Spline::new(curve, OrientationCurve::piecewise_slerp(&keys(rng, 5))?)
            .about(random_vector(rng, 1.0))
    });
}

/// Tests that a link deviates within its bounds if a joint at rest turns the axes before and after it out of parallel.
#[test]
fn links_behind_joints_that_are_held() {
    check("link, held joint", 0.1, |rng| {
        let joint = |axis: DVec3| Joint::revolute(Pose::at(random_vector(rng, 0.3))?, axis);
        let joints = [DVec3::Z, DVec3::X, DVec3::Z].map(joint);
        let joints: Result<Vec<_>, InputError> = joints.into_iter().collect();
        let mut angle = || rng.random_range(-2.0..2.0);
        let (first, held, last) = (angle(), angle(), angle());
        Ok(ChainOwningLink {
            chain: Chain::new(Pose::IDENTITY, joints?),
            positions: [vec![0.0, held, 0.0], vec![first, held, last]],
            link: 3,
            seen_from: None,
        })
    });
}

/// Tests that a chain followed by its reversed joints ends at its start pose, and stays there while the joints move.
#[test]
fn reversed_joints_undo_joints() {
    let mut rng = Rng::seed_from_u64(8);
    for _ in 0..200 {
        let out = random_chain(&mut rng, 4, AxisChoice::AnyDirection)
            .joints()
            .to_vec();
        let back = out.iter().rev().cloned().map(Joint::reversed);
        let there_and_back = Chain::new(Pose::IDENTITY, out.iter().cloned().chain(back).collect());
        let [first, last] = [(); 2].map(|()| -> Vec<f64> {
            let out: Vec<f64> = (0..4).map(|_| rng.random_range(-2.0..2.0)).collect();
            out.iter().chain(out.iter().rev()).copied().collect()
        });
        let link = there_and_back.link(8, &first, &last, 2.0).unwrap();
        let Stretch {
            motion,
            deviation_bound: deviation,
            ..
        } = link.stretch_between(0.7, 0.7).unwrap();
        let start = motion.start();
        assert!(start.translation().length() <= deviation.center_deviation);
        assert!(2.0 * start.rotation().xyz().length() <= deviation.max_deviation_angle);
        assert!(motion.velocity().length() < 1e-12 && motion.angular_velocity().length() < 1e-12);
    }
}

/// Tests that the motion of a joint passes through the joint's poses, also for a reversed joint.
#[test]
fn a_joint_moves_through_its_poses() {
    let mut rng = Rng::seed_from_u64(9);
    for k in 0..400 {
        let joint = random_chain(&mut rng, 4, AxisChoice::AnyDirection).joints()[k % 4].clone();
        let [first, last] = [(); 2].map(|()| rng.random_range(-2.0..2.0));
        let motion = joint.motion(first, last, 2.0).unwrap();
        let share = rng.random_range(0.0..1.0);
        let (moved, there) = (
            motion.pose(2.0 * share),
            joint.pose(first + share * (last - first)).unwrap(),
        );
        let point = random_vector(&mut rng, 1.0);
        let apart = moved
            .transform_point(point)
            .distance(there.transform_point(point));
        assert!(apart < 1e-14, "{joint:?}: {apart:e}");
    }
}

/// A link that owns its chain, so that it has no lifetime parameter.
struct ChainOwningLink {
    chain: Chain,
    positions: [Vec<f64>; 2],
    link: usize,
    seen_from: Option<usize>,
}

impl ChainOwningLink {
    fn draw(rng: &mut Rng, axes: AxisChoice) -> Result<Self, InputError> {
        let count = rng.random_range(1..8);
        let chain = random_chain(rng, count, axes);
        let first: Vec<f64> = (0..count).map(|_| rng.random_range(-2.0..2.0)).collect();
        // Some joints do not move.
        let last = first.iter().map(|&first| {
            if rng.random_bool(0.3) {
                first
            } else {
                rng.random_range(-2.0..2.0)
            }
        });
        let positions = [first.clone(), last.collect()];
        let link = rng.random_range(0..=count);
        Ok(ChainOwningLink {
            chain,
            positions,
            link,
            seen_from: rng.random_bool(0.3).then_some(link / 2),
        })
    }
}

impl Trajectory for ChainOwningLink {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let [first, last] = &self.positions;
        let link = self.chain.link(self.link, first, last, 2.0)?;
        match self.seen_from {
            Some(other) => link.seen_from(other)?.stretch_between(from, to),
            None => link.stretch_between(from, to),
        }
    }
}

#[test]
fn links() {
    check("link of a chain", 0.2, |rng| {
        ChainOwningLink::draw(rng, AxisChoice::AnyDirection)
    });
}

#[test]
fn links_with_parallel_axes() {
    check("link, parallel axes", 0.5, |rng| {
        ChainOwningLink::draw(rng, AxisChoice::AllParallel)
    });
}

#[test]
fn links_with_axes_across() {
    check("link, axes across", 0.5, |rng| {
        ChainOwningLink::draw(rng, AxisChoice::AlongCoordinates)
    });
}

/// Tests that the check finds a trajectory whose bound is too small.
#[test]
fn a_false_bound_is_found() {
    struct FalselyBoundedSpline(Spline);
    impl Trajectory for FalselyBoundedSpline {
        fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
            let mut stretch = self.0.stretch_between(from, to)?;
            stretch.deviation_bound.center_deviation *= 0.9;
            Ok(stretch)
        }
    }
    let mut rng = Rng::seed_from_u64(2);
    let curve = Curve::bezier(&points(&mut rng, 4), 2.0).unwrap();
    let spline = Spline::new(curve, OrientationCurve::NONE);
    let worst = worst_deviation(&FalselyBoundedSpline(spline), 2.0, 1.0, 1_000, 1).unwrap();
    assert!(worst.ratio > 1.05, "{worst:?}");
}

/// Tests that a stretch of a spline has a known acceleration if it ends at a knot, and none if a knot is inside it.
#[test]
fn stretches_between_knots_accelerate() {
    let mut rng = Rng::seed_from_u64(4);
    let curve = Curve::b_spline(&points(&mut rng, 7), 2.0).unwrap();
    let spline = Spline::new(curve, OrientationCurve::NONE);
    for [from, to] in [[0.0, 0.5], [0.25, 0.5], [0.5, 1.0], [0.5, 0.75], [1.5, 2.0]] {
        let stretch = spline.stretch_between(from, to).unwrap();
        assert!(stretch.acceleration != DVec3::ZERO, "{from} {to}");
    }
    assert_eq!(
        spline.stretch_between(0.4, 0.6).unwrap().acceleration,
        DVec3::ZERO
    );
}

#[test]
fn links_seen_from_links_are_where_they_are_in_the_world() {
    let mut rng = Rng::seed_from_u64(3);
    for _ in 0..200 {
        let owned = ChainOwningLink::draw(&mut rng, AxisChoice::AnyDirection).unwrap();
        let other = owned.link / 2;
        let [first, last] = &owned.positions;
        let of = |link| owned.chain.link(link, first, last, 2.0).unwrap();
        let time = rng.random_range(0.0..2.0);
        let [tip, base] = [owned.link, other].map(|link| of(link).pose(time).unwrap());
        let seen = of(owned.link).seen_from(other).unwrap().pose(time).unwrap();
        let x = random_vector(&mut rng, 1.0);
        let twice = base.compose(&seen).transform_point(x);
        assert!(twice.distance(tip.transform_point(x)) < 1e-13);
    }
}

#[test]
fn tangents_have_the_velocities_of_poses() {
    let mut rng = Rng::seed_from_u64(4);
    let step = 1e-6;
    for _ in 0..100 {
        let [first, last] = [(); 2].map(|()| [(); 5].map(|()| rng.random_range(-2.0..2.0)));
        let chain = random_chain(&mut rng, 5, AxisChoice::AnyDirection);
        let link = chain.link(5, &first, &last, 2.0).unwrap();
        let turns = OrientationCurve::piecewise_slerp(&keys(&mut rng, 6)).unwrap();
        let spline = Spline::new(Curve::b_spline(&points(&mut rng, 9), 2.0).unwrap(), turns);
        let thrown = random_ballistic(&mut rng).unwrap();
        let all: [&dyn SmoothTrajectory; 3] = [&link, &spline, &thrown];
        let time = rng.random_range(0.1..1.9);
        for (number, smooth) in all.into_iter().enumerate() {
            let tangent = smooth.tangent_motion(time).unwrap();
            let x = random_vector(&mut rng, 1.0);
            let [before, after] = [-step, step].map(|step| {
                let pose = smooth.tangent_motion(time + step).unwrap().start();
                pose.transform_point(x)
            });
            let arm = tangent.start().rotation() * (x - tangent.center());
            let velocity = tangent.velocity() + tangent.angular_velocity().cross(arm);
            let found = (after - before) / (2.0 * step);
            let size = 1.0 + velocity.length();
            assert!(
                found.distance(velocity) < 1e-5 * size,
                "{number}: {found} {velocity}"
            );
        }
    }
}

#[test]
fn positions_are_checked_up_to_rounding() {
    let joint = Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap();
    let (least, greatest) = (-3.0718, -0.0698);
    let chain = Chain::new(Pose::IDENTITY, vec![joint.with_limits(least..=greatest)]);
    let mut rng = Rng::seed_from_u64(5);
    let mut beyond = 0;
    for _ in 0..10_000 {
        // This is how planners write it.
        let (a, t) = (rng.random_range(least..greatest), 1.0);
        let position = a + t * (greatest - a);
        beyond += u32::from(position > greatest);
        assert!(chain.pose(1, &[position]).is_ok(), "{position:?}");
    }
    assert!(beyond > 100, "{beyond}");
    for wrong in [-0.06979, -3.07181, f64::NAN, f64::INFINITY] {
        let found = chain.pose(1, &[wrong]).unwrap_err();
        assert!(matches!(
            found,
            InputError::JointOutOfLimits { joint: Some(0), .. }
        ));
    }
    let message = chain.pose(1, &[3.0]).unwrap_err().to_string();
    assert_eq!(
        message,
        "joint 0 is at 3, but its limits are -3.0718 and -0.0698"
    );
}

#[test]
fn an_axis_needs_a_length() {
    let message = |axis| {
        Joint::revolute(Pose::IDENTITY, axis)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        message([0.0; 3]),
        "the length of an axis is 0, but must be positive"
    );
    assert_eq!(message([0.0, f64::NAN, 0.0]), "axis is NaN or infinite");
}

/// Tests that the check of a position refuses what the pose refuses, with the same error.
#[test]
fn the_check_of_a_position_is_that_of_the_pose() {
    let origin = Pose::at([0.1, 0.2, 0.3]).unwrap();
    let axis = [0.0, 0.6, 0.8];
    let limited = |joint: Joint| joint.with_limits(-1.0..=2.0);
    let joints = [
        Joint::fixed(origin),
        Joint::revolute(origin, axis).unwrap(),
        Joint::prismatic(origin, axis).unwrap(),
        limited(Joint::revolute(origin, axis).unwrap()),
        limited(Joint::prismatic(origin, axis).unwrap()).reversed(),
    ];
    let positions = [
        0.0,
        -1.0,
        2.0,
        2.1,
        1e-310,
        1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    let mut refused = 0;
    for joint in &joints {
        for position in positions {
            let pose = joint.pose(position).map(|_| ());
            refused += i32::from(pose.is_err());
            let as_text = |result: Result<(), InputError>| format!("{result:?}");
            assert_eq!(
                as_text(joint.check(position)),
                as_text(pose),
                "{joint:?} {position}"
            );
        }
    }
    assert!((10..40).contains(&refused), "{refused}");
}

/// Tests that the time for a point of a curve is bounded: a query reads the clock between points.
#[test]
fn bezier_curves_of_too_many_points_are_refused() {
    let curve = |count: usize| Curve::bezier(&vec![[0.0; 3]; count], 1.0);
    assert!(curve(128).is_ok());
    let error = curve(129).unwrap_err().to_string();
    assert!(error.contains("number of points is 129"), "{error}");
}
