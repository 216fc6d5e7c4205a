use super::*;

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
</robot>"#;

#[test]
fn disabled_pairs_are_read_among_other_elements() {
    let pairs = disabled_pairs(SRDF).unwrap();
    let named = |pair: &DisabledPair| (pair.link1.clone(), pair.link2.clone(), pair.reason.clone());
    let expected = [("base", "upper", "Adjacent"), ("upper", "hand", "")];
    let expected = expected.map(|(one, other, why)| (one.into(), other.into(), why.into()));
    assert_eq!(pairs.iter().map(named).collect::<Vec<_>>(), expected);
}

#[test]
fn a_pair_without_a_link_is_an_error() {
    let error = disabled_pairs(r#"<robot><disable_collisions link1="a"/></robot>"#).unwrap_err();
    assert!(error.to_string().contains("link2"), "{error}");
    assert!(disabled_pairs("<robot><disable_collisions").is_err());
}
