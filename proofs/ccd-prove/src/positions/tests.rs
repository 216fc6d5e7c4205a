use super::*;
use ccd_core::Pose;
use rigid_ccd::trajectory;
use rigid_ccd_robot::Link;

/// Returns a gripper with three fingers. The second finger mimics the first, and the third finger mimics the second.
fn gripper(factor: f64, offset: f64) -> Robot {
    let joint = |name: &str, rule| Joint {
        name: name.into(),
        parent: "palm".into(),
        child: format!("{name} finger"),
        geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0])
            .unwrap()
            .with_limits(0.0..=0.05),
        position_rule: rule,
    };
    let follows = |followed: &str, multiplier, offset| PositionRule::Follows {
        joint: followed.into(),
        multiplier,
        offset,
    };
    let joints = vec![
        joint("grip", PositionRule::Independent),
        joint("grip2", follows("grip", factor, offset)),
        joint("grip3", follows("grip2", 3.0, 0.1)),
    ];
    let links = ["palm", "grip finger", "grip2 finger", "grip3 finger"];
    Robot::new(links.map(Link::named).to_vec(), joints).unwrap()
}

fn error_text(robot: &Robot, joints: &[(&str, [f64; 2])]) -> String {
    check_positions(robot, joints).unwrap_err().to_string()
}

#[test]
fn a_finger_that_breaks_its_mimic_rule_is_refused() {
    let robot = gripper(-1.0, 0.0);
    let both = |second| [("grip", [0.01, 0.05]), ("grip2", second)];
    assert_eq!(check_positions(&robot, &both([-0.01, -0.05])), Ok(()));
    assert_eq!(
        error_text(&robot, &both([0.01, 0.05])),
        "joint grip2 is at 0.01, but by its mimic rule for grip it would be at -0.01"
    );
    assert_eq!(
        error_text(&robot, &both([-0.01, -0.050_000_001])),
        "joint grip2 is at -0.050000001, but by its mimic rule for grip it would be at -0.05"
    );
    assert!(check_positions(&robot, &both([-0.01, f64::NAN])).is_err());
}

#[test]
fn limits_are_kept_at_both_ends() {
    let robot = gripper(1.0, 0.0);
    assert_eq!(check_positions(&robot, &[("grip", [0.0, 0.05])]), Ok(()));
    let text = error_text(&robot, &[("grip", [0.0, 0.050_001])]);
    assert_eq!(
        text,
        "joint grip is at 0.050001, beyond its limits 0 to 0.05"
    );
    assert!(check_positions(&robot, &[("grip", [-1e-9, 0.0])]).is_err());
    // The statement has no position of `grip`. It is computed from a follower.
    let text = error_text(&robot, &[("grip2", [0.0, 0.06])]);
    assert_eq!(text, "joint grip is at 0.06, beyond its limits 0 to 0.05");
    let text = error_text(&robot, &[("grip2", [0.0, 0.05]), ("grip3", [0.1, 0.2])]);
    let begin = "joint grip3 is at 0.2, but by its mimic rule for grip it would be at 0.25";
    assert!(text.starts_with(begin), "{text}");
}

/// Tests that positions computed by the robot are accepted after the rounding of a start and a rate.
#[test]
fn positions_that_the_robot_computes_are_possible() {
    let mut state = 5u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..10_000 {
        let robot = gripper(20.0 * random() - 10.0, 10f64.powf(20.0 * random() - 17.0));
        let [from, to] = [(); 2].map(|()| robot.joint_positions(&[0.05 * random()]).unwrap());
        let names = robot.joints().iter().map(|joint| &*joint.name);
        let ends = from
            .iter()
            .zip(&to)
            .map(|(from, to)| [*from, from + (to - from)]);
        let joints: Vec<_> = names.zip(ends).collect();
        assert_eq!(check_positions(&robot, &joints), Ok(()));
        assert_eq!(check_positions(&robot, &joints[1..]), Ok(()));
    }
}
