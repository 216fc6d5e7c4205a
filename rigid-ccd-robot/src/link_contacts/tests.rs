//! Tests of proofs about pairs of links against random configurations.

use super::*;
use crate::robot::{Joint, Link, PositionRule};
use crate::test_robots::{least_distance_of_links, random_robot, with_symmetric_limits};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::{Body, Pose, trajectory};

/// Tests random robots: no configuration contradicts a proof, and the configurations that are named prove what they are
/// to.
#[test]
fn no_configuration_contradicts_a_proof() {
    let mut random = Pcg64::seed_from_u64(21);
    let (mut never, mut always, mut sometimes, mut undecided) = (0, 0, 0, 0);
    for _ in 0..40 {
        let limit = [0.3, 1.2][random.random_range(0..2)];
        let robot = with_symmetric_limits(&random_robot(&mut random), limit);
        for (links, meeting) in robot.classify_link_contacts(300).unwrap() {
            let distance = |at: &[f64]| least_distance_of_links(&robot, links, at);
            let samples = (0..60).map(|_| {
                let limits = robot.limits();
                let at: Vec<f64> = limits
                    .map(|[low, high]| random.random_range(low..=high))
                    .collect();
                distance(&at)
            });
            let samples: Vec<f64> = samples.collect();
            match meeting {
                LinkContactClass::Never => {
                    never += 1;
                    assert!(samples.iter().all(|&distance| distance > 0.0), "{links:?}");
                }
                LinkContactClass::Always => {
                    always += 1;
                    assert!(
                        samples.iter().all(|&distance| distance <= 3e-9),
                        "{links:?}"
                    );
                }
                LinkContactClass::Sometimes {
                    touching_configuration: touching,
                    apart_configuration: apart,
                } => {
                    sometimes += 1;
                    assert!(
                        distance(&touching) <= 1e-9 && distance(&apart) > 0.0,
                        "{links:?}"
                    );
                }
                LinkContactClass::Undecided {
                    proven_apart_share, ..
                } => {
                    undecided += 1;
                    assert!((0.0..1.0).contains(&proven_apart_share));
                }
            }
        }
    }
    let enough = never > 20 && always > 0 && sometimes > 40 && undecided > 5;
    assert!(enough, "{never} {always} {sometimes} {undecided}");
}

/// Tests a hinge whose leaf touches the frame beyond a known angle, with limits before and beyond it.
#[test]
fn limits_decide_whether_a_hinge_meets_its_stop() {
    // The rod of half length 0.4 from 0.1 to 0.9, and a post of radius 0.1 at (0, 0.8): they meet at a right angle
    // less the angle of 0.15 at the distance 0.8.
    let meet = std::f64::consts::FRAC_PI_2 - (0.15f64 / 0.8).asin();
    let capsule = || Body::capsule(0.05, 0.35).unwrap();
    let door_with = |rod: Body, limit: f64, joint_limit: f64| {
        let lying = rigid_ccd::glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        let links = vec![
            Link::named("frame").with_body(
                Body::capsule(0.1, 0.5).unwrap(),
                Pose::at([0.0, 0.8, 0.0]).unwrap(),
            ),
            Link::named("leaf").with_body(rod, Pose::new([0.5, 0.0, 0.0], lying).unwrap()),
        ];
        let hinge = trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap();
        let joints = vec![Joint {
            name: "hinge".into(),
            parent: "frame".into(),
            child: "leaf".into(),
            axis_and_limits: hinge.with_limits(joint_limit..=limit),
            position_rule: PositionRule::Independent,
        }];
        let robot = Robot::new(links, joints).unwrap();
        robot.classify_link_contacts(10_000).unwrap().remove(0).1
    };
    let door = |limit: f64, joint_limit: f64| door_with(capsule(), limit, joint_limit);
    assert_eq!(door(meet - 1e-4, 0.0), LinkContactClass::Never);
    // A body that exceeds its shape counts as it is.
    let cylinder = Body::cylinder(0.05, 0.35).unwrap();
    assert!(cylinder.excess() > 0.0);
    assert!(matches!(
        door_with(cylinder, meet + 0.2, 0.0),
        LinkContactClass::Sometimes { .. }
    ));
    assert!(matches!(
        door(meet + 1e-2, 0.0),
        LinkContactClass::Sometimes { .. }
    ));
    // A joint that is held at one position.
    assert_eq!(door(1.0, 1.0), LinkContactClass::Never);
    // Without limits it turns once.
    let turning = door(f64::INFINITY, f64::NEG_INFINITY);
    assert!(
        matches!(turning, LinkContactClass::Sometimes { .. }),
        "{turning:?}"
    );
}

/// Tests that two links which both hold a point of the hinge between them always touch, and that links which overlap in
/// most configurations, but do not hold the hinge, are not said to.
#[test]
fn links_that_hold_their_hinge_always_touch() {
    let meeting = |offset: f64| {
        let ball = || Body::sphere(0.3).unwrap();
        let at = Pose::at([offset, 0.0, 0.7]).unwrap();
        let links = vec![
            Link::named("base").with_body(ball(), at),
            Link::named("arm").with_body(ball(), at),
        ];
        let joints = vec![Joint {
            name: "hinge".into(),
            parent: "base".into(),
            child: "arm".into(),
            axis_and_limits: trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
            position_rule: PositionRule::Independent,
        }];
        let robot = Robot::new(links, joints).unwrap();
        robot.classify_link_contacts(2_000).unwrap().remove(0).1
    };
    assert_eq!(meeting(0.29), LinkContactClass::Always);
    // Half a turn brings the balls 0.62 apart at their centres.
    assert!(matches!(meeting(0.31), LinkContactClass::Sometimes { .. }));
}
