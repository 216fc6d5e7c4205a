use super::*;
use crate::link_contacts::tests::classify;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::trajectory;

/// An SRDF file with two disabled pairs, and with other elements that MoveIt's setup assistant writes.
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

fn names(pairs: &[SrdfPair]) -> Vec<[&str; 3]> {
    pairs
        .iter()
        .map(|pair| [&*pair.links[0], &*pair.links[1], &*pair.reason])
        .collect()
}

#[test]
fn disabled_pairs_are_read_among_other_elements() {
    let srdf = Srdf::from_text(SRDF).unwrap();
    let expected = [["base", "upper", "Adjacent"], ["upper", "hand", ""]];
    assert_eq!(names(&srdf.disabled), expected);
    assert_eq!(names(&srdf.enabled), [["base", "hand", ""]]);
}

/// Tests that nothing is ignored that may disable or enable a pair.
#[test]
fn what_is_not_known_is_refused() {
    for (content, expected) in [
        (
            r#"<disable_collisions link1="a"/>"#,
            "an element `disable_collisions` needs an attribute `link2`",
        ),
        (
            r#"<disable_collisions link1="a" link2="b" link3="c"/>"#,
            "an element `disable_collisions` has no attribute `link3`",
        ),
        (
            r#"<disable_default_collisions/>"#,
            "an element `disable_default_collisions` needs an attribute `link`",
        ),
        (
            r#"<disable_colisions link1="a" link2="b"/>"#,
            "an element `disable_colisions` is not known in an SRDF",
        ),
        (
            r#"<xacro:arm xmlns:xacro="x"/>"#,
            "an element `arm` is not known in an SRDF",
        ),
        ("<disable_collisions", ""),
    ] {
        let error = Srdf::from_text(&format!("<robot>{content}</robot>")).unwrap_err();
        assert!(error.to_string().starts_with(expected), "{error}");
    }
    let error = Srdf::from_text("<semantics/>").unwrap_err();
    assert!(error.to_string().contains("`semantics`"), "{error}");
}

/// Tests that pairs agree with MoveIt: a link can be disabled as a whole, and its pairs enabled one by one.
#[test]
fn links_are_disabled_as_a_whole() {
    let links = ["a", "b", "c"].map(|name| {
        let ball = rigid_ccd::Body::sphere(0.1).unwrap();
        Link::named(name).with_body(ball, rigid_ccd::Pose::IDENTITY)
    });
    let slide = |parent: &str, child: &str| Joint {
        name: child.into(),
        parent: parent.into(),
        child: child.into(),
        geometry: trajectory::Joint::prismatic(rigid_ccd::Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    let robot = Robot::new(links.to_vec(), vec![slide("a", "b"), slide("b", "c")]).unwrap();
    let robot = robot.with_name("twin");
    let applied = |content: &str| {
        let mut pairs = LinkPairs::from_robot(&robot);
        let srdf = Srdf::from_text(&format!("<robot>{content}</robot>")).unwrap();
        srdf.apply(&robot, &mut pairs).map(|()| pairs)
    };
    let checked = |content: &str| {
        let pairs = applied(content).unwrap();
        (
            pairs.checked_pairs().collect::<Vec<_>>(),
            pairs.file_remarks().len(),
        )
    };
    let whole = r#"<disable_default_collisions link=" c "/>"#;
    assert_eq!(checked(""), (vec![[0, 2]], 0));
    assert_eq!(checked(whole), (vec![], 0));
    let enabled = format!(r#"<enable_collisions link1="a" link2="c"/>{whole}"#);
    assert_eq!(checked(&enabled), (vec![[0, 2]], 0));
    // Links of another variant of the robot are ignored, with one remark.
    let variant = r#"<disable_collisions link1="c" link2="tool"/><disable_collisions link1="a" link2="tail"/>"#;
    assert_eq!(checked(variant), (vec![[0, 2]], 1));
    let remark = applied(variant).unwrap().file_remarks()[0].to_string();
    assert!(remark.ends_with(": tail, tool"), "{remark}");
    let mut pairs = LinkPairs::from_robot(&robot);
    let twin = Srdf::from_text(r#"<robot name="other twin"/>"#).unwrap();
    twin.apply(&robot, &mut pairs).unwrap();
    let remark = pairs.file_remarks()[0].to_string();
    assert!(
        remark.ends_with("It is of `other twin`, and the robot is `twin`"),
        "{remark}"
    );
    let other = r#"<disable_collisions link1="tool" link2="tail"/>"#;
    let error = applied(other).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the file belongs to another robot: there is no link tail, tool"
    );
}

/// Tests that a written file reads back, with names that XML has to escape.
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
        geometry: joint,
        position_rule: PositionRule::Independent,
    };
    let fixed = || trajectory::Joint::fixed(rigid_ccd::Pose::IDENTITY);
    let slide = trajectory::Joint::prismatic(rigid_ccd::Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joints = vec![
        joint("one", "a & b", "c", fixed()),
        joint("two", "c", "d", fixed()),
        joint("three", "d", "e", slide.with_limits(-1.0..=1.0)),
    ];
    let robot = Robot::new(links, joints).unwrap().with_name("<box>");
    let meetings = classify(&robot, 1000);
    let pairs = LinkPairs::from_robot(&robot);
    let read = Srdf::from_text(&robot.to_srdf(&pairs, &meetings)).unwrap();
    assert_eq!(read.robot_name, "<box>");
    let expected = [
        ["a & b", "c", "Always (proven)"],
        ["a & b", "d", "Never (proven)"],
        ["c", "d", "Never (proven)"],
        ["d", "e", "Never (proven)"],
    ];
    assert_eq!(names(&read.disabled), expected);
}

/// Tests that pairs of adjacent links are not disabled if a file includes them and they can touch.
#[test]
fn neighbours_that_are_checked_stay_checked() {
    let links = ["base", "arm"].map(|name| {
        let ball = rigid_ccd::Body::sphere(0.5).unwrap();
        Link::named(name).with_body(ball, rigid_ccd::Pose::IDENTITY)
    });
    let slide = trajectory::Joint::prismatic(rigid_ccd::Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joint = Joint {
        name: "slide".into(),
        parent: "base".into(),
        child: "arm".into(),
        geometry: slide.with_limits(0.0..=3.0),
        position_rule: PositionRule::Independent,
    };
    let robot = Robot::new(links.to_vec(), vec![joint]).unwrap();
    let classes = classify(&robot, 1000);
    assert!(
        matches!(classes[0].1, LinkContactClass::Sometimes { .. }),
        "{classes:?}"
    );
    let disabled = |pairs: &LinkPairs| {
        let text = robot.to_srdf(pairs, &classes);
        Srdf::from_text(&text).unwrap().disabled.len()
    };
    let mut pairs = LinkPairs::from_robot(&robot);
    assert_eq!(disabled(&pairs), 1);
    pairs.include(0, 1);
    assert_eq!(disabled(&pairs), 0);
}
