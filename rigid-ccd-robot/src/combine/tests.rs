//! Tests combined robots against the single robots.

use super::*;
use crate::cell::{Cell, Item};
use crate::skip_reason::SkipReason;
use crate::solver::tests::{least_distance, random_configuration};
use crate::test_robots::{random_pose, random_robot};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::{DQuat, EulerRot};

const KINDS: [Option<CompoundKind>; 4] = [
    None,
    Some(CompoundKind::Floating),
    Some(CompoundKind::Spherical),
    Some(CompoundKind::Planar {
        normal: [0.0, 0.0, 1.0],
    }),
];

/// Returns the pose of a moving base, by the formula for its kind.
fn base_pose(placed: &PlacedRobot<'_>, positions: &[f64]) -> Pose {
    let rotation =
        |angles: &[f64]| DQuat::from_euler(EulerRot::ZYX, angles[0], angles[1], angles[2]);
    let moved = match placed.base_motion {
        None => Pose::IDENTITY,
        Some(CompoundKind::Floating) => {
            let at = [positions[0], positions[1], positions[2]];
            Pose::new(at, rotation(&positions[3..])).unwrap()
        }
        Some(CompoundKind::Spherical) => Pose::new([0.0; 3], rotation(positions)).unwrap(),
        Some(CompoundKind::Planar { .. }) => {
            let at = [positions[0], positions[1], 0.0];
            Pose::new(at, rotation(&[positions[2], 0.0, 0.0])).unwrap()
        }
    };
    placed.pose.compose(&moved)
}

/// Tests the link poses of combined robots against those of single robots on moved bases, and the distances of all
/// pairs against the solver.
#[test]
fn links_are_where_the_base_carries_them() {
    let mut random = Pcg64::seed_from_u64(51);
    let (mut within_one, mut between_both, mut carried) = (0, 0, 0);
    for _ in 0..80 {
        let robots = [(); 2].map(|()| random_robot(&mut random));
        let mut pairs = robots.each_ref().map(LinkPairs::from_robot);
        if random.random_range(0..2) == 0 {
            for pairs in &mut pairs {
                for [one, other] in pairs.checked_pairs().collect::<Vec<_>>() {
                    pairs.skip(one, other, SkipReason::Disabled("test".into()));
                }
            }
        }
        // Half of the time, a link of the left robot carries the right robot.
        let links = robots[0].links();
        let link = &links[random.random_range(0..links.len())].name;
        let carrier = format!("left/{link}");
        let is_carried = random.random_range(0..2) == 0;
        let placed = [0, 1].map(|k| PlacedRobot {
            name: ["left", "right"][k],
            robot: &robots[k],
            pairs: &pairs[k],
            carrier: (k == 1 && is_carried).then_some(&*carrier),
            pose: random_pose(&mut random, 1.5),
            base_motion: KINDS[random.random_range(0..KINDS.len())],
        });
        let (both, pairs) = Robot::combine(&placed).unwrap();
        let configuration = random_configuration(&mut random, &both);
        let mut rest = &configuration[..];
        for placed in &placed {
            let base_count = match placed.base_motion {
                None => 0,
                Some(CompoundKind::Floating) => 6,
                Some(_) => 3,
            };
            let (base, others) = rest.split_at(base_count);
            let (own, others) = others.split_at(placed.robot.independent_joint_names().len());
            rest = others;
            let mut base = base_pose(placed, base);
            if let Some(carrier) = placed.carrier {
                carried += 1;
                base = both.pose(carrier, &configuration).unwrap().compose(&base);
            }
            for link in placed.robot.links() {
                let expected = base.compose(&placed.robot.pose(&link.name, own).unwrap());
                let found = both
                    .pose(&placed.prefixed(&link.name), &configuration)
                    .unwrap();
                let off = found.translation().distance(expected.translation());
                let turned = found.rotation().angle_between(expected.rotation());
                assert!(off < 1e-12 && turned < 1e-6, "{off} {turned}");
            }
        }
        assert!(rest.is_empty());
        let cell = Cell::new(both, pairs);
        let found = cell
            .solver()
            .closest_approach(&[&configuration])
            .unwrap()
            .outcome;
        let least = least_distance(&cell, &configuration);
        assert!(
            found.lower() <= least + 1e-9 && found.upper() >= least - 1e-9,
            "{found:?} {least}"
        );
        let nearest = found.nearest().unwrap().items.map(Item::name);
        let is_between = nearest[0].starts_with("left") != nearest[1].starts_with("left");
        if is_between {
            between_both += 1;
        } else {
            within_one += 1;
        }
    }
    assert!(
        within_one > 10 && between_both > 10 && carried > 10,
        "{within_one} {between_both} {carried}"
    );
}

/// Tests that a gripper is checked against the arm that carries it, except for links fixed to its base, and that
/// invalid carriers are refused.
#[test]
fn a_link_carries_a_robot() {
    let ball = |name: &str| {
        let body = rigid_ccd::Body::sphere(0.1).unwrap();
        Link::named(name).with_body(body, Pose::IDENTITY)
    };
    let hinge = |parent: &str, child: &str| Joint {
        name: format!("{parent}-{child}"),
        parent: parent.into(),
        child: child.into(),
        geometry: trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    let arm = vec![ball("foot"), ball("hand")];
    let arm = Robot::new(arm, vec![hinge("foot", "hand")]).unwrap();
    let gripper = vec![ball("palm"), ball("finger")];
    let gripper = Robot::new(gripper, vec![hinge("palm", "finger")]).unwrap();
    let [of_arm, of_gripper] = [&arm, &gripper].map(LinkPairs::from_robot);
    let placed = |carriers: [Option<&'static str>; 2]| {
        let [on_arm, on_gripper] = carriers;
        let base = |name, robot, pairs, carrier| PlacedRobot {
            name,
            robot,
            pairs,
            carrier,
            pose: Pose::IDENTITY,
            base_motion: None,
        };
        Robot::combine(&[
            base("", &arm, &of_arm, on_gripper),
            base("gripper", &gripper, &of_gripper, on_arm),
        ])
    };
    let (both, pairs) = placed([Some("hand"), None]).unwrap();
    let name = |link: usize| both.links()[link].name.as_str();
    let checked: Vec<[&str; 2]> = pairs.checked_pairs().map(|pair| pair.map(name)).collect();
    let known = [
        ["foot", "gripper/palm"],
        ["foot", "gripper/finger"],
        ["hand", "gripper/finger"],
    ];
    assert_eq!(checked, known);
    assert!(placed([Some("none"), None]).is_err());
    assert!(placed([Some("hand"), Some("gripper/palm")]).is_err());
}

/// Tests that each robot keeps its own pairs, and that repeated names are refused.
#[test]
fn robots_keep_their_own_pairs() {
    let mut random = Pcg64::seed_from_u64(52);
    let robot = random_robot(&mut random);
    let mut pairs = LinkPairs::from_robot(&robot);
    let [a, b] = pairs.checked_pairs().next().unwrap();
    pairs.skip(a, b, SkipReason::Disabled("test".into()));
    let (c, d) = (
        0,
        robot
            .links()
            .iter()
            .position(|link| link.name == "link1")
            .unwrap(),
    );
    pairs.include(c, d);
    let placed = |name| PlacedRobot {
        name,
        robot: &robot,
        pairs: &pairs,
        carrier: None,
        pose: Pose::IDENTITY,
        base_motion: None,
    };
    let (both, combined) = Robot::combine(&[placed("one"), placed("two")]).unwrap();
    let count = robot.links().len();
    for first in [1, 1 + count] {
        for one in 0..count {
            for other in 0..count {
                let (own, all) = (
                    pairs.skip_reason(one, other),
                    combined.skip_reason(first + one, first + other),
                );
                assert_eq!(own, all);
            }
        }
    }
    // Both bases are fixed to the world.
    assert!(!combined.is_checked(1, 1 + count));
    assert!(combined.is_checked(2, 1 + count));
    assert_eq!(both.links()[1 + count].name, "two/link0");
    let error = Robot::combine(&[placed(""), placed("")]).unwrap_err();
    assert!(matches!(
        error,
        RobotError::JointNameTaken { .. } | RobotError::LinkNameTaken { .. }
    ));
}

/// Tests that pairs of another robot are refused, and that links and joints may have the names of generated ones.
#[test]
fn pairs_are_of_their_robot_and_names_are_free() {
    let mut random = Pcg64::seed_from_u64(53);
    let robot = random_robot(&mut random);
    let ball =
        Link::named("world").with_body(rigid_ccd::Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let joint = Joint {
        name: "base".into(),
        parent: "world".into(),
        child: "tip".into(),
        geometry: trajectory::Joint::fixed(Pose::IDENTITY),
        position_rule: PositionRule::Independent,
    };
    let small = Robot::new(vec![ball, Link::named("tip")], vec![joint]).unwrap();
    let small_pairs = LinkPairs::from_robot(&small);
    let placed = |robot, pairs| PlacedRobot {
        name: "",
        robot,
        pairs,
        carrier: None,
        pose: Pose::IDENTITY,
        base_motion: Some(CompoundKind::Floating),
    };
    let (both, _) = Robot::combine(&[placed(&small, &small_pairs)]).unwrap();
    assert_eq!(both.links()[0].name, "world_");
    assert_eq!(both.independent_joint_names().next(), Some("base_/x"));
    let error = Robot::combine(&[placed(&robot, &small_pairs)]).unwrap_err();
    assert!(
        matches!(error, RobotError::PairsOfAnotherRobot { .. }),
        "{error}"
    );
}
