//! Tests that the URDF reader ignores nothing that may matter, and that messages name the cause.

use crate::robot::Robot;
use crate::robot_file::{BodyElements, RobotFile};
use rigid_ccd::glam::DQuat;

/// An arm with all elements of URDF 1.0, and with harmless elements of other programs.
const ARM: &str = r#"<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    <material name="grey"><color rgba="0 0 0"/></material>
    <link name="base" type="laser_wall">
        <inertial><origin xyz="0 0"/><mass value="1"/></inertial>
        <collision name="foot"><verbose value="0"/><origin xyz="0 0 1" rpy="0 0 0"/><geometry><box size="1 2 3"/></geometry></collision>
        <visual name="foot"><geometry><sphere radius="2"/></geometry><material name="grey"/></visual>
        <contact><lateral_friction value="1"/></contact>
    </link>
    <link name="hand"><collision><geometry><cylinder radius="1" length="2"/></geometry></collision></link>
    <joint name="elbow" type="revolute" dont_collapse="true">
        <origin xyz="0 0 1" rpy="0 0 0.5"/><parent link="base"/><child link="hand"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="2" effort="1" velocity="1" drake:acceleration="2"/>
        <dynamics damping="x"/><safety_controller/><calibration/>
    </joint>
    <gazebo reference="hand"><joint name="loop"/></gazebo>
    <transmission name="t"><joint name="elbow"/></transmission>
    <ros2_control name="c"/><sensor name="s"/><mujoco/>
</robot>"#;

fn read(text: &str) -> Result<Robot, String> {
    let file = RobotFile::from_text(text, "arm.urdf");
    let visual = file
        .clone()
        .with_body_element_kind(BodyElements::Visual)
        .read();
    let collision = file.read();
    visual.and(collision).map_err(|error| error.to_string())
}

#[test]
fn all_that_is_known_is_read() {
    let robot = read(ARM).unwrap();
    assert_eq!(robot.limits().collect::<Vec<_>>(), [[-1.0, 2.0]]);
    assert_eq!(robot.file_remarks(), []);
    assert_eq!(robot.links()[0].bodies.len(), 1);
}

/// Tests that unknown elements and attributes, extra values and missing values are errors that name the element and
/// its link or joint.
#[test]
fn what_is_not_known_is_refused() {
    for (given, instead, expected) in [
        (
            "rpy=\"0 0 0.5\"",
            "rypy=\"0 0 0.5\"",
            "joint `elbow`: an element `origin` has no attribute `rypy`",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axes xyz=\"0 0 1\"/>",
            "joint `elbow`: an element `axes` in `joint` is not known",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0 1 0\"/>",
            "joint `elbow`: xyz=\"0 0 1 0\" of an element `axis` is not 3 numbers",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0\"/>",
            "joint `elbow`: xyz=\"0 0\" of an element `axis` is not 3 numbers",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0 1 x\"/>",
            "joint `elbow`: xyz=\"0 0 1 x\" of an element `axis` is not 3 numbers",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis/>",
            "joint `elbow`: an element `axis` needs an attribute `xyz`",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>",
            "joint `elbow`: there is more than one element `axis`",
        ),
        (
            "type=\"revolute\"",
            "type=\"screw\"",
            "joint `elbow`: type=\"screw\" of an element `joint` is not revolute, ",
        ),
        (
            "type=\"revolute\"",
            "",
            "joint `elbow`: an element `joint` needs an attribute `type`",
        ),
        (
            "<parent link=\"base\"/>",
            "",
            "joint `elbow`: an element `parent` is missing",
        ),
        (
            "<child link=\"hand\"/>",
            "<child name=\"hand\"/>",
            "joint `elbow`: an element `child` has no attribute `name`",
        ),
        (
            "upper=\"2\"",
            "uper=\"2\"",
            "joint `elbow`: an element `limit` has no attribute `uper`",
        ),
        (
            "upper=\"2\"",
            "upper=\"2 3\"",
            "joint `elbow`: upper=\"2 3\" of an element `limit` is not a number",
        ),
        (
            "<limit",
            "<mimic joint=\"elbow\" ofset=\"1\"/><limit",
            "joint `elbow`: an element `mimic` has no attribute `ofset`",
        ),
        (
            "<contact><lateral_friction value=\"1\"/></contact>",
            "<colision/>",
            "link `base`: an element `colision` in `link` is not known",
        ),
        (
            "<origin xyz=\"0 0 1\" rpy=\"0 0 0\"/>",
            "<origin xyz=\"0 0 1\" quat_xyzw=\"0 0 0 1\"/>",
            "link `base`: quat_xyzw of an element `origin` needs version=\"1.1\"",
        ),
        (
            "<box size=\"1 2 3\"/>",
            "<box size=\"1 2\"/>",
            "link `base`: size=\"1 2\" of an element `box` is not 3 numbers",
        ),
        (
            "<box size=\"1 2 3\"/>",
            "<box size=\"1 2 3\" radius=\"1\"/>",
            "link `base`: an element `box` has no attribute `radius`",
        ),
        (
            "<box size=\"1 2 3\"/>",
            "",
            "link `base`: an element `box, capsule, cylinder, mesh or sphere in geometry` is missing",
        ),
        (
            "<box size=\"1 2 3\"/>",
            "<box size=\"1 2 3\"/><sphere radius=\"1\"/>",
            "link `base`: there is more than one element `sphere in geometry`",
        ),
        (
            "<box size=\"1 2 3\"/>",
            "<plane normal=\"0 0 1\"/>",
            "link `base`: an element `plane` in `geometry` is not known",
        ),
        (
            "<box size=\"1 2 3\"/>",
            "<mesh filename=\"a.stl\" scale=\"1\"/>",
            "link `base`: scale=\"1\" of an element `mesh` is not 3 numbers",
        ),
        (
            "<sphere radius=\"2\"/>",
            "<sphere/>",
            "link `base`: an element `sphere` needs an attribute `radius`",
        ),
        (
            "<robot name=\"arm\"",
            "<robot name=\"arm\" version=\"9.9\"",
            "version=\"9.9\" of URDF is not supported",
        ),
        (
            "<robot name=\"arm\"",
            "<robot name=\"arm\" units=\"mm\"",
            "an element `robot` has no attribute `units`",
        ),
        (
            "<sensor name=\"s\"/>",
            "<sensr/>",
            "an element `sensr` in `robot` is not known",
        ),
        (
            "<link name=\"hand\">",
            "<link>",
            "an element `link` needs an attribute `name`",
        ),
        (
            "</robot>",
            "<xacro:arm/></robot>",
            "`xacro:arm` belongs to xacro",
        ),
        (
            "</robot>",
            "<m:macro xmlns:m=\"http://ros.org/wiki/xacro\"/></robot>",
            "`xacro:macro` belongs to xacro",
        ),
        (
            "xyz=\"0 0 1\" rpy=\"0 0 0.5\"",
            "xyz=\"0 0 ${height}\"",
            "joint `elbow`: `0 0 ${height}` belongs to xacro",
        ),
    ] {
        let text = ARM.replacen(given, instead, 1);
        assert_ne!(text, ARM, "{given}");
        let error = read(&text).map(|_| ()).expect_err(instead);
        assert!(error.starts_with(expected), "{instead}: {error}");
    }
    let no_limit = ARM.replace(
        "<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\" drake:acceleration=\"2\"/>",
        "",
    );
    let error = read(&no_limit).map(|_| ()).unwrap_err();
    assert_eq!(error, "joint `elbow`: an element `limit` is missing");
    let error = read("<sdf><model/></sdf>").map(|_| ()).unwrap_err();
    assert!(error.starts_with("the root element is `sdf`"), "{error}");
    let error = read("<!doctype html><html><body>").map(|_| ()).unwrap_err();
    assert!(error.starts_with("arm.urdf: is a page of HTML"), "{error}");
}

/// Tests that elements which other programs may use are ignored with a remark.
#[test]
fn what_is_left_out_is_remarked_upon() {
    for (given, instead, expected) in [
        (
            "<gazebo",
            "<drake:collision_filter_group name=\"g\"/><gazebo",
            "drake:collision_filter_group in robot arm",
        ),
        (
            "<gazebo",
            "<loop_joint name=\"l\"/><gazebo",
            "loop_joint in robot arm",
        ),
        (
            "<inertial>",
            "<origin xyz=\"0 0 1\"/><inertial>",
            "origin in link base",
        ),
        (
            "rpy=\"0 0 0.5\"",
            "rpy=\"0 0 90\"",
            "joint elbow: roll, pitch or yaw",
        ),
        (
            "upper=\"2\"",
            "upper=\"90\"",
            "joint elbow: a joint's position is a round number of degrees",
        ),
    ] {
        let robot = read(&ARM.replacen(given, instead, 1)).unwrap();
        let remarks: Vec<String> = robot
            .file_remarks()
            .iter()
            .map(ToString::to_string)
            .collect();
        assert!(
            remarks.len() == 1 && remarks[0].contains(expected),
            "{instead}: {remarks:?}"
        );
    }
}

#[test]
fn versions_have_what_they_add() {
    let version = |version: &str, given: &str, instead: &str| {
        let text = ARM.replacen("<robot", &format!("<robot version=\"{version}\""), 1);
        read(&text.replacen(given, instead, 1))
    };
    let (angles, quaternion) = ("rpy=\"0 0 0.5\"", "quat_xyzw=\"0 0 0.6 0.8\"");
    let robot = version("1.1", angles, quaternion).unwrap();
    let turned = robot.pose("hand", &[0.0]).unwrap().rotation();
    assert!(turned.angle_between(DQuat::from_xyzw(0.0, 0.0, 0.6, 0.8)) < 1e-7);
    assert!(version("1.0", angles, quaternion).is_err());
    assert!(version("1.2", angles, "quat_xyzw=\"0 0 0 0\"").is_err());
    assert!(version("1.2", angles, &format!("{angles} {quaternion}")).is_err());
    assert_eq!(
        version("1.1", "upper=\"2\"", "").unwrap().limits().next(),
        Some([-1.0, 0.0])
    );
    let error = version("1.2", "upper=\"2\"", "").unwrap_err();
    assert_eq!(
        error,
        "joint `elbow`: an element `limit` needs an attribute `upper`"
    );
}
