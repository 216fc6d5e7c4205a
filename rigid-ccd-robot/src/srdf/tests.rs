use super::*;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::trajectory;

/// An SRDF file with two disabled pairs of links among other elements that MoveIt's setup assistant writes.
const SRDF: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<!-- A comment. -->
<robot name="arm">
    <group name="arm"><chain base_link="base" tip_link="hand"/></group>
    <disable_collisions link1="base" link2="upper" reason="Adjacent"/>
    <group_state name="home" group="arm"><joint name="a" value="0"/></group_state>
    <end_effector name="hand" parent_link="hand" group="hand"/>
    <virtual_joint name="world" type="fixed" parent_frame="world" child_link="base"/>
    <disable_collisions link1="upper" link2="hand"/>
    <enable_collisions link1="base" link2="hand"/>
</robot>"#;

#[test]
fn disabled_pairs_are_read_among_other_elements() {
    let [pairs, enabled] = disabled_and_enabled_pairs(SRDF).unwrap();
    let named = |pair: &SrdfPair| (pair.link1.clone(), pair.link2.clone(), pair.reason.clone());
    let expected = [("base", "upper", "Adjacent"), ("upper", "hand", "")];
    let expected = expected.map(|(one, other, why)| (one.into(), other.into(), why.into()));
    assert_eq!(pairs.iter().map(named).collect::<Vec<_>>(), expected);
    let enabled: Vec<_> = enabled.iter().map(named).collect();
    assert_eq!(enabled, [("base".into(), "hand".into(), String::new())]);
}

#[test]
fn a_pair_without_a_link_is_an_error() {
    let error = disabled_and_enabled_pairs(r#"<robot><disable_collisions link1="a"/></robot>"#)
        .unwrap_err();
    assert!(error.to_string().contains("link2"), "{error}");
    assert!(disabled_and_enabled_pairs("<robot><disable_collisions").is_err());
}

/// Tests that what is written is read again, with names that XML has to escape.
#[test]
fn proven_pairs_are_written_and_read() {
    let ball = |name: &str, x: f64| {
        let pose = rigid_ccd::Pose::at([x, 0.0, 0.0]).unwrap();
        Link::named(name).with_body(rigid_ccd::Body::sphere(0.1).unwrap(), pose)
    };
    let links = vec![
        ball("a & b", 0.0),
        ball("c", 0.15),
        ball("d", 3.0),
        ball("e", 0.5),
    ];
    let joint = |name: &str, parent: &str, child: &str, joint| Joint {
        name: name.into(),
        parent: parent.into(),
        child: child.into(),
        axis_and_limits: joint,
        position_rule: PositionRule::Independent,
    };
    let fixed = || trajectory::Joint::fixed(rigid_ccd::Pose::IDENTITY);
    let slide = trajectory::Joint::prismatic(rigid_ccd::Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joints = vec![
        joint("one", "a & b", "c", fixed()),
        joint("two", "c", "d", fixed()),
        joint("three", "d", "e", slide.with_limits(-1.0..=1.0)),
    ];
    let robot = Robot::new(links, joints).unwrap();
    let meetings = robot.classify_link_contacts(1000).unwrap();
    let [read, _] = disabled_and_enabled_pairs(&robot.to_srdf("<box>", &meetings)).unwrap();
    let pairs: Vec<[&str; 3]> = read
        .iter()
        .map(|pair| [&*pair.link1, &*pair.link2, &*pair.reason])
        .collect();
    let expected = [
        ["a & b", "c", "Always (proven)"],
        ["a & b", "d", "Never (proven)"],
        ["c", "d", "Never (proven)"],
        ["d", "e", "Never (proven)"],
    ];
    assert_eq!(pairs, expected);
}
