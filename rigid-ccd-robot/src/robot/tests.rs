use super::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::InputError;
use rigid_ccd::glam::{DMat4, DQuat, DVec3};
use rigid_ccd::trajectory::Trajectory;

fn pose(random: &mut Pcg64) -> Pose {
    let [x, y, z, a, b, c] = [(); 6].map(|()| random.random_range(-1.0..1.0));
    Pose::new([x, y, z], DQuat::from_scaled_axis(DVec3::new(a, b, c))).unwrap()
}

fn joint(name: &str, parent: &str, child: &str, joint: trajectory::Joint) -> Joint {
    Joint {
        name: name.into(),
        parent: parent.into(),
        child: child.into(),
        geometry: joint,
        position_rule: PositionRule::Independent,
    }
}

fn hinge(name: &str, parent: &str, child: &str) -> Joint {
    let at = Pose::at([1.0, 0.0, 0.0]).unwrap();
    joint(
        name,
        parent,
        child,
        trajectory::Joint::revolute(at, [0.0, 0.0, 1.0]).unwrap(),
    )
}

fn links(count: usize) -> Vec<Link> {
    (0..count)
        .map(|k| Link::named(format!("link{k}")))
        .collect()
}

/// A random robot, and the data from which the tests compute poses by matrices.
struct RandomRobot {
    robot: Robot,
    reference_joints: Vec<ReferenceJoint>,
}

struct ReferenceJoint {
    parent: usize,
    origin: Pose,
    axis: DVec3,
    kind: usize,
    /// The index of the joint that this joint follows with multiplier −2 and offset 0.5; its own index if it follows
    /// none.
    followed_joint: usize,
}

/// Draws a random robot of 8 links, in which joint `k` moves link `k + 1`.
fn draw(random: &mut Pcg64) -> RandomRobot {
    let mut twins: Vec<ReferenceJoint> = Vec::new();
    let mut joints = Vec::new();
    for k in 0..7 {
        let (origin, kind) = (pose(random), k % 3);
        let axis = DVec3::from_array([(); 3].map(|()| random.random_range(-1.0..1.0))).normalize();
        let parent = random.random_range(0..=k);
        let moved = match kind {
            0 => trajectory::Joint::revolute(origin, axis),
            1 => trajectory::Joint::prismatic(origin, axis),
            _ => Ok(trajectory::Joint::fixed(origin)),
        };
        let (child, above) = (format!("link{}", k + 1), format!("link{parent}"));
        let mut joint = joint(&format!("joint{k}"), &above, &child, moved.unwrap());
        // Joint 6 follows joint 3, which follows joint 0.
        let follows = if k == 3 || k == 6 { k - 3 } else { k };
        if follows != k {
            joint.position_rule = PositionRule::Follows {
                joint: format!("joint{follows}"),
                multiplier: -2.0,
                offset: 0.5,
            };
        }
        joints.push(joint);
        twins.push(ReferenceJoint {
            parent,
            origin,
            axis,
            kind,
            followed_joint: follows,
        });
    }
    // Joints may be given in any order.
    joints.rotate_left(3);
    let robot = Robot::new(links(8), joints).unwrap();
    RandomRobot {
        robot,
        reference_joints: twins,
    }
}

impl RandomRobot {
    fn position(&self, joint: usize, of: &dyn Fn(usize) -> f64) -> f64 {
        match self.reference_joints[joint].followed_joint {
            own if own == joint => of(joint),
            followed => 0.5 - 2.0 * self.position(followed, of),
        }
    }

    /// Computes the transform of a link in the base frame as a product of matrices.
    fn matrix(&self, link: usize, of: &dyn Fn(usize) -> f64) -> DMat4 {
        let Some(joint) = link.checked_sub(1) else {
            return DMat4::IDENTITY;
        };
        let (twin, position) = (&self.reference_joints[joint], self.position(joint, of));
        let origin =
            DMat4::from_rotation_translation(twin.origin.rotation(), twin.origin.translation());
        let moved = match twin.kind {
            0 => DMat4::from_axis_angle(twin.axis, position),
            1 => DMat4::from_translation(twin.axis * position),
            _ => DMat4::IDENTITY,
        };
        self.matrix(twin.parent, of) * origin * moved
    }
}

/// Tests the poses of links in the frames of the base and of other links against products of matrices.
#[test]
fn poses_are_products_of_matrices() {
    let mut random = Pcg64::seed_from_u64(1);
    for _ in 0..50 {
        let drawn = draw(&mut random);
        let robot = &drawn.robot;
        let names: Vec<&str> = robot.independent_joint_names().collect();
        assert_eq!(names, ["joint4", "joint0", "joint1"]);
        let given: Vec<f64> = names
            .iter()
            .map(|_| random.random_range(-2.0..2.0))
            .collect();
        let of = |joint: usize| {
            let name = format!("joint{joint}");
            names
                .iter()
                .position(|&known| known == name)
                .map_or(0.0, |k| given[k])
        };
        for one in 0..8 {
            let found = robot.pose(&format!("link{one}"), &given).unwrap();
            let expected = drawn.matrix(one, &of);
            let point = DVec3::new(0.3, -0.2, 0.9);
            let apart = found
                .transform_point(point)
                .distance(expected.transform_point3(point));
            assert!(apart < 1e-13, "link{one}: {apart:e}");
            for other in 0..8 {
                let between = robot.chain_between(other, one);
                let positions = between.positions(robot, &given).unwrap();
                let count = between.chain().joints().len();
                let found = between.chain().pose(count, &positions).unwrap();
                let expected = drawn.matrix(other, &of).inverse() * expected;
                let apart = found
                    .transform_point(point)
                    .distance(expected.transform_point3(point));
                assert!(apart < 1e-13, "link{one} from link{other}: {apart:e}");
            }
        }
    }
}

/// Tests that the approximate motion of a link in another link's frame deviates from the exact poses by at most its
/// bound.
#[test]
fn intervals_between_branches_hold() {
    let mut random = Pcg64::seed_from_u64(2);
    let mut nearest = 0.0_f64;
    for _ in 0..200 {
        let RandomRobot { robot, .. } = draw(&mut random);
        let [from, to] = [random.random_range(0..8), random.random_range(0..8)];
        let between = robot.chain_between(from, to);
        let [first, last] = [(); 2].map(|()| {
            let given: Vec<f64> = (0..3).map(|_| random.random_range(-2.0..2.0)).collect();
            between.positions(&robot, &given).unwrap()
        });
        let count = between.chain().joints().len();
        let link = between.chain().link(count, &first, &last, 1.0).unwrap();
        let interval = link.stretch_between(0.2, 0.5).unwrap();
        for _ in 0..20 {
            let time = random.random_range(0.2..0.5);
            let (near, there) = (interval.pose(time - 0.2), link.pose(time).unwrap());
            let center = interval.motion.center();
            let apart = near
                .transform_point(center)
                .distance(there.transform_point(center));
            assert!(
                apart <= interval.deviation_bound.center_deviation,
                "{apart:e}, {interval:?}"
            );
            if interval.deviation_bound.center_deviation > 1e-9 {
                let fraction = apart / interval.deviation_bound.center_deviation;
                nearest = if fraction > nearest {
                    fraction
                } else {
                    nearest
                };
            }
        }
    }
    // The bound is not much larger than the deviation.
    assert!(nearest > 0.2, "{nearest}");
}

#[test]
fn what_is_no_tree_is_refused() {
    let refused = |count, joints| Robot::new(links(count), joints).unwrap_err();
    assert_eq!(refused(0, Vec::new()), RobotError::NoLinks);
    let two_bases = refused(2, Vec::new());
    assert!(matches!(two_bases, RobotError::TwoBases { .. }));
    // A link with a misspelt name has no joint.
    for lone in ["link0", "link2"] {
        let held = if lone == "link0" {
            ["link1", "link2"]
        } else {
            ["link0", "link1"]
        };
        let (link, base) = (lone.into(), held[0].into());
        assert_eq!(
            refused(3, vec![hinge("a", held[0], held[1])]),
            RobotError::LinkWithoutJoint { link, base }
        );
    }
    let looped = |a, b| vec![hinge("a", "link1", a), hinge("b", "link2", b)];
    let error = refused(3, looped("link2", "link1"));
    assert_eq!(
        error,
        RobotError::Loop {
            link: "link1".into()
        }
    );
    let error = refused(3, looped("link2", "link2"));
    let (link, joint) = ("link2".into(), "b".into());
    assert_eq!(error, RobotError::TwoParents { link, joint });
    let error = refused(2, vec![hinge("a", "link0", "link7")]);
    assert_eq!(error.to_string(), "there is no link `link7`");
    let twice = vec![hinge("a", "link0", "link1"), hinge("a", "link1", "link2")];
    assert!(matches!(
        refused(3, twice),
        RobotError::JointNameTaken { .. }
    ));
    let same = vec![Link::named("x"), Link::named("x")];
    let error = Robot::new(same, Vec::new()).unwrap_err();
    assert!(matches!(error, RobotError::LinkNameTaken { .. }));
    let mut reversed = hinge("a", "link0", "link1");
    reversed.geometry = reversed.geometry.reversed();
    let error = refused(2, vec![reversed]);
    assert_eq!(error, RobotError::ReversedJoint { joint: "a".into() });
    // Two links that are each other's parents, beside a base.
    let error = refused(
        3,
        vec![hinge("a", "link1", "link2"), hinge("b", "link2", "link1")],
    );
    assert!(matches!(error, RobotError::Loop { .. }));
}

#[test]
fn joints_that_follow_nothing_are_refused() {
    let follows = |joint: &str| PositionRule::Follows {
        joint: joint.into(),
        multiplier: 1.0,
        offset: 0.0,
    };
    for followed in ["none", "b", "fixed"] {
        let mut b = hinge("b", "link1", "link2");
        b.position_rule = follows(followed);
        let fixed = trajectory::Joint::fixed(Pose::IDENTITY);
        let joints = vec![b, joint("fixed", "link0", "link1", fixed)];
        let error = Robot::new(links(3), joints).unwrap_err();
        let (joint, followed_joint) = ("b".into(), followed.into());
        let expected = match followed {
            "none" => RobotError::NoSuchMimicJoint {
                joint,
                followed_joint,
            },
            _ => RobotError::InvalidMimicJoint {
                joint,
                followed_joint,
            },
        };
        assert_eq!(error, expected);
    }
}

#[test]
fn configurations_that_do_not_fit_are_refused() {
    let mut limited = hinge("elbow", "link0", "link1");
    limited.geometry = limited.geometry.with_limits(-1.0..=1.0);
    let robot = Robot::new(links(2), vec![limited]).unwrap();
    let message =
        |configuration: &[f64]| robot.pose("link1", configuration).unwrap_err().to_string();
    assert_eq!(message(&[]), "0 positions for 1 joints: elbow");
    assert_eq!(
        message(&[1.5]),
        "joint `elbow`: the joint is at 1.5, but its limits are -1 and 1"
    );
    let error = robot.pose("link1", &[f64::NAN]).unwrap_err();
    let RobotError::InvalidPosition { error, .. } = error else {
        panic!("{error}");
    };
    assert!(matches!(error, InputError::JointOutOfLimits { .. }));
}

/// Tests that a joint that follows another joint may exceed its own limits.
#[test]
fn limits_of_a_joint_that_follows_do_not_count() {
    let mut follower = hinge("follower", "link0", "link2");
    follower.geometry = follower.geometry.with_limits(0.0..=0.1);
    follower.position_rule = PositionRule::Follows {
        joint: "leader".into(),
        multiplier: 3.0,
        offset: 0.0,
    };
    let joints = vec![hinge("leader", "link0", "link1"), follower];
    let robot = Robot::new(links(3), joints).unwrap();
    let turned = robot.pose("link2", &[0.5]).unwrap().rotation();
    assert!(turned.angle_between(DQuat::from_rotation_z(1.5)) < 1e-7);
}
