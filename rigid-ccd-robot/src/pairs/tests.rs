use super::*;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::{Body, Pose, trajectory};

/// Returns a base with a camera, and an arm of two hinged links with a camera at its end.
fn robot() -> Robot {
    let body = || Body::sphere(0.1).unwrap();
    let link = |name| Link::named(name).with_body(body(), Pose::IDENTITY);
    let names = ["base", "upper", "lower", "camera", "wrist camera"];
    let hinge = || trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap();
    let fixed = || trajectory::Joint::fixed(Pose::IDENTITY);
    let joint = |parent: &str, child: &str, joint| Joint {
        name: child.into(),
        parent: parent.into(),
        child: child.into(),
        geometry: joint,
        position_rule: PositionRule::Independent,
    };
    let joints = vec![
        joint("base", "upper", hinge()),
        joint("upper", "lower", hinge()),
        joint("base", "camera", fixed()),
        joint("lower", "flange", fixed()),
        joint("flange", "wrist camera", fixed()),
    ];
    let links = names.map(link).into_iter().chain([Link::named("flange")]);
    Robot::new(links.collect(), joints).unwrap()
}

#[test]
fn neighbours_and_rigid_pairs_are_left_out() {
    let pairs = LinkPairs::from_robot(&robot());
    assert_eq!(pairs.skip_reason(1, 0), Some(&SkipReason::Adjacent));
    assert_eq!(pairs.skip_reason(3, 0), Some(&SkipReason::Adjacent));
    assert_eq!(pairs.skip_reason(2, 4), Some(&SkipReason::NoMotion));
    // The flange has no body.
    let checked: Vec<[usize; 2]> = pairs.checked_pairs().collect();
    assert_eq!(checked, [[0, 2], [0, 4], [1, 3], [1, 4], [2, 3], [3, 4]]);
}

#[test]
fn pairs_can_be_left_out_and_checked_again() {
    let mut pairs = LinkPairs::from_robot(&robot());
    pairs.skip(4, 0, SkipReason::Disabled("Never".into()));
    pairs.skip(1, 0, SkipReason::Disabled("User".into()));
    assert_eq!(pairs.skip_reason(0, 1), Some(&SkipReason::Adjacent));
    assert!(!pairs.checked_pairs().any(|pair| pair == [0, 4]));
    pairs.include(0, 4);
    assert_eq!(pairs.skip_reason(4, 0), None);
    assert!(pairs.checked_pairs().any(|pair| pair == [0, 4]));
}
