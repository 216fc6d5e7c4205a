use super::*;
use crate::skip_reason::SkipReason;
use rigid_ccd::glam::{DQuat, EulerRot};
use std::fs;
use std::sync::Arc;
use tempfile::TempDir;

const TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Writes a mesh and a URDF with three links: primitive shapes, a mirrored mesh, and a visual larger than the
/// collision shape.
fn write_robot_folder(joints: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("part.obj"), TETRAHEDRON_OBJ).unwrap();
    let text = format!(
        r#"<robot name="arm">
        <link name="base">
            <visual><geometry><sphere radius="3"/></geometry></visual>
            <collision><geometry><box size="2 4 6"/></geometry></collision>
            <collision><origin xyz="0 0 9"/><geometry><sphere radius="0.5"/></geometry></collision>
        </link>
        <link name="upper">
            <collision><geometry><cylinder radius="1" length="2"/></geometry></collision>
            <collision><geometry><capsule radius="1" length="2"/></geometry></collision>
        </link>
        <link name="lower">
            <collision><geometry><mesh filename="part.obj" scale="-2 1 0.5"/></geometry></collision>
            <collision><geometry><mesh filename="part.obj" scale="-2 1 0.5"/></geometry></collision>
        </link>
        {joints}
        </robot>"#
    );
    fs::write(folder.path().join("arm.urdf"), text).unwrap();
    folder
}

const JOINTS_XML: &str = r#"
    <joint name="turns" type="revolute"><parent link="base"/><child link="upper"/>
        <origin xyz="0 0 1" rpy="0.1 0.2 0.3"/><axis xyz="0 0 2"/>
        <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
    <joint name="slides" type="prismatic"><parent link="upper"/><child link="lower"/>
        <axis xyz="1 0 0"/><limit lower="0" upper="0.01" effort="1" velocity="1"/>
        <mimic joint="turns" multiplier="2"/></joint>"#;

fn urdf_in_folder(folder: &TempDir) -> RobotFile {
    RobotFile::from_path(folder.path().join("arm.urdf"))
}

#[test]
fn shapes_have_their_whole_sizes() {
    let robot = urdf_in_folder(&write_robot_folder(JOINTS_XML))
        .read()
        .unwrap();
    let spans: Vec<Vec<f64>> = robot
        .links()
        .iter()
        .map(|link| {
            link.bodies
                .iter()
                .map(|body| body.body.bounding_radius())
                .collect()
        })
        .collect();
    let mesh = 2.0;
    let expected = [[f64::sqrt(14.0), 0.5], [f64::sqrt(2.0), 2.0], [mesh, mesh]];
    for (found, expected) in spans.iter().flatten().zip(expected.iter().flatten()) {
        assert!(
            (1.0..1.3).contains(&(found / expected)),
            "{found} for {expected}"
        );
    }
    assert_eq!(robot.links()[0].bodies[1].pose.translation().z, 9.0);
    let excess = |link: usize, body: usize| robot.links()[link].bodies[body].body.excess();
    assert!(excess(1, 0) > 0.0 && excess(1, 1) == 0.0);
}

#[test]
fn a_mesh_is_made_once_and_mirrored_as_a_solid() {
    let robot = urdf_in_folder(&write_robot_folder(JOINTS_XML))
        .read()
        .unwrap();
    let bodies = &robot.links()[2].bodies;
    assert!(Arc::ptr_eq(&bodies[0].body, &bodies[1].body));
    assert_eq!(bodies[0].body.solidity(), rigid_ccd::body::Solidity::Solid);
    let hull = urdf_in_folder(&write_robot_folder(JOINTS_XML))
        .with_mesh_conversion(MeshConversion::OuterHull)
        .read()
        .unwrap();
    assert_eq!(hull.links()[2].bodies[0].body.pieces().len(), 1);
}

#[test]
fn visuals_are_a_choice() {
    let robot = urdf_in_folder(&write_robot_folder(JOINTS_XML))
        .with_body_element_kind(BodyElements::Visual)
        .read()
        .unwrap();
    let counts: Vec<usize> = robot.links().iter().map(|link| link.bodies.len()).collect();
    assert_eq!(counts, [1, 0, 0]);
}

/// Tests the order of roll, pitch and yaw, and that a mimic joint may exceed its own limits.
#[test]
fn joints_are_those_of_the_file() {
    let robot = urdf_in_folder(&write_robot_folder(JOINTS_XML))
        .read()
        .unwrap();
    assert_eq!(
        robot.independent_joint_names().collect::<Vec<_>>(),
        ["turns"]
    );
    assert_eq!(robot.limits().collect::<Vec<_>>(), [[-1.0, 2.0]]);
    let origin = robot.pose("upper", &[0.0]).unwrap();
    let by_axes =
        DQuat::from_rotation_z(0.3) * DQuat::from_rotation_y(0.2) * DQuat::from_rotation_x(0.1);
    assert!(origin.rotation().angle_between(by_axes) < 1e-7);
    let lower = robot.pose("lower", &[0.5]).unwrap();
    assert!((lower.translation().distance(origin.translation()) - 1.0).abs() < 1e-14);
}

#[test]
fn pairs_come_from_the_srdf() {
    let folder = write_robot_folder(JOINTS_XML);
    let srdf = folder.path().join("arm.srdf");
    fs::write(&srdf, r#"<robot name="arm"><disable_collisions link1="lower" link2="base" reason="Never"/></robot>"#).unwrap();
    let (urdf, robot) = (
        urdf_in_folder(&folder),
        urdf_in_folder(&folder).read().unwrap(),
    );
    assert_eq!(
        urdf.link_pairs(&robot, None)
            .unwrap()
            .checked_pairs()
            .collect::<Vec<_>>(),
        [[0, 2]]
    );
    let pairs = urdf.link_pairs(&robot, Some(&srdf)).unwrap();
    assert_eq!(pairs.checked_pairs().count(), 0);
    assert_eq!(
        pairs.skip_reason(0, 2),
        Some(&SkipReason::Disabled("Never".into()))
    );
    fs::write(
        &srdf,
        r#"<robot><disable_collisions link1="head" link2="tail"/></robot>"#,
    )
    .unwrap();
    let error = urdf
        .link_pairs(&robot, Some(&srdf))
        .unwrap_err()
        .to_string();
    assert!(
        error.ends_with("arm.srdf: the file belongs to another robot: there is no link head, tail"),
        "{error}"
    );
}

#[test]
fn errors_name_file_link_and_joint() {
    let message = |joints: &str| {
        urdf_in_folder(&write_robot_folder(joints))
            .read()
            .unwrap_err()
            .to_string()
    };
    let mimic = JOINTS_XML.replacen("type=\"revolute\"", "type=\"planar\"", 1);
    let mimic = mimic.replacen("</joint>", r#"<mimic joint="slides"/></joint>"#, 1);
    assert_eq!(
        message(&mimic),
        "joint `turns`: only a joint with one degree of freedom can mimic another one"
    );
    assert_eq!(
        message(""),
        "links `base` and `upper` are both children of no joint; a robot has one base"
    );
    let axis = JOINTS_XML.replace("0 0 2", "0 0 0");
    assert!(
        message(&axis).starts_with("joint `turns`: "),
        "{}",
        message(&axis)
    );

    let folder = write_robot_folder(JOINTS_XML);
    fs::remove_file(folder.path().join("part.obj")).unwrap();
    let error = urdf_in_folder(&folder).read().unwrap_err().to_string();
    assert!(
        error.starts_with("link `lower`: `part.obj` is not found; looked for "),
        "{error}"
    );
    fs::write(folder.path().join("part.obj"), "v 0 0\n").unwrap();
    let error = urdf_in_folder(&folder).read().unwrap_err().to_string();
    assert!(
        error.starts_with("link `lower`: ") && error.contains("part.obj"),
        "{error}"
    );
    let error = RobotFile::from_path("none.urdf")
        .read()
        .unwrap_err()
        .to_string();
    assert!(error.starts_with("none.urdf: "), "{error}");
    fs::write(folder.path().join("arm.urdf"), "<robot").unwrap();
    let error = urdf_in_folder(&folder).read().unwrap_err().to_string();
    assert!(error.contains("arm.urdf: "), "{error}");
}

/// Tests that joints with several degrees of freedom move as in URDF.
#[test]
fn planar_and_floating_joints_are_chains_of_joints() {
    let tree = |kind: &str, axis: &str| {
        let text = format!(
            r#"<robot name="cart"><link name="floor"/><link name="cart"/>
            <joint name="drive" type="{kind}"><parent link="floor"/><child link="cart"/>
            <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><axis xyz="{axis}"/></joint></robot>"#
        );
        RobotFile::from_text(text, "cart.urdf").read().unwrap()
    };
    let pose = |robot: &Robot, positions: &[f64]| robot.pose("cart", positions).unwrap();
    let planar = tree("planar", "0 0 1");
    let names: Vec<&str> = planar.independent_joint_names().collect();
    assert_eq!(names, ["drive/x", "drive/y", "drive/yaw"]);
    let moved = pose(&planar, &[2.0, 3.0, 0.5]);
    // The joint's frame is rotated by a quarter turn.
    let off = moved.translation().distance([-2.0, 2.0, 0.0].into());
    assert!(off < 1e-12, "{moved:?}");
    let upright = tree("planar", "1 0 0");
    let moved = pose(&upright, &[2.0, 3.0, 0.0]);
    let height = moved.translation();
    // The plane is perpendicular to the joint's x axis, which is the floor's y.
    assert!(
        height.y.abs() < 1e-12
            && (height.distance([1.0, 0.0, 0.0].into()) - 13f64.sqrt()).abs() < 1e-12
    );
    let floating = tree("floating", "0 0 1");
    assert_eq!(floating.independent_joint_names().len(), 6);
    let moved = pose(&floating, &[1.0, 2.0, 3.0, 0.3, 0.2, 0.1]);
    let expected = DQuat::from_euler(EulerRot::ZYX, 0.3 + std::f64::consts::FRAC_PI_2, 0.2, 0.1);
    assert!(moved.rotation().angle_between(expected) < 1e-7);
    assert!(moved.translation().distance([-1.0, 1.0, 3.0].into()) < 1e-12);
    let spherical = tree("spherical", "0 0 1");
    assert_eq!(
        spherical.independent_joint_names().last(),
        Some("drive/roll")
    );
}

/// Tests that an invalid material is ignored, and that everything else is kept, including comments and entities.
#[test]
fn materials_are_passed_over() {
    let text = r#"<?xml version="1.0"?><robot name="a&amp;b"><material name="m"><texture/></material><!-- <material> -->
        <link name="one"><visual><geometry><sphere radius="1"/></geometry><material name="m"/><material name="n">
        <color rgba="no colour"/></material></visual></link></robot>"#;
    let robot = RobotFile::from_text(text, "one.urdf")
        .with_body_element_kind(BodyElements::Visual)
        .read()
        .unwrap();
    assert_eq!(robot.links()[0].bodies.len(), 1);
    let error = RobotFile::from_text("<robot><material>", "one.urdf")
        .read()
        .unwrap_err();
    assert!(error.to_string().starts_with("one.urdf: "), "{error}");
}

/// Tests deeply nested elements: a recursive parser would overflow the stack.
#[test]
fn deeply_nested_elements_are_read() {
    let nested = |depth: usize| {
        let elements = "<gazebo>".repeat(depth) + &"</gazebo>".repeat(depth);
        let text = format!("<robot name=\"r\"><link name=\"l\"/>{elements}</robot>");
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("r.urdf");
        fs::write(&file, text).unwrap();
        RobotFile::from_path(file).read().map(|_| ())
    };
    assert!(nested(100).is_ok());
    assert!(nested(60_000).is_ok());
}

/// Tests that a file with nothing to check gives a remark, and a single part does not.
#[test]
fn a_file_without_shapes_and_joints_is_remarked_upon() {
    let remarks = |text: &str| {
        let file = RobotFile::from_text(text, "part.xml");
        let robot = file.read().unwrap();
        let remarks = file.link_pairs(&robot, None).unwrap().remarks(&robot);
        let warnings = remarks.into_iter().filter(CellRemark::is_warning);
        warnings
            .map(|remark| remark.to_string())
            .collect::<Vec<_>>()
    };
    let urdf = |content: &str| format!("<robot name='part'>{content}</robot>");
    let ball = "<geometry><sphere radius='1'/></geometry>";
    let visual = format!("<link name='base'><visual>{ball}</visual></link>");
    let part = format!("<link name='base'><collision>{ball}</collision></link>");
    let left_out = "<link name='base'/><drake:joint/><my:arm/>";
    for (text, expected) in [
        (
            urdf("<link name='base'/>"),
            "one link without shapes, base,",
        ),
        (urdf(&visual), "only shapes for drawing"),
        (urdf(left_out), "one link without shapes, base,"),
        (
            "<mujoco><worldbody/></mujoco>".to_owned(),
            "one link without shapes, world,",
        ),
    ] {
        let message = remarks(&text);
        assert!(
            message.iter().any(|one| one.contains(expected)),
            "{text}: {message:?}"
        );
    }
    let message = remarks(&urdf(left_out));
    let expected = "drake:joint in robot part, my:arm in robot part";
    assert!(
        message.len() == 2 && message.iter().any(|one| one.ends_with(expected)),
        "{message:?}"
    );
    assert!(remarks(&urdf(&part)).is_empty());
    let scene = "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>";
    assert!(remarks(scene).is_empty());
}

/// Tests that a note reports what the mesh reader ignored or changed.
#[test]
fn contents_of_meshes_are_noted() {
    let folder = tempfile::tempdir().unwrap();
    let obj =
        "v 0 0 0 2\nv 1 0 0\nv 0 1 0\nv 0 0 1\nl 1 2\nfoo 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    fs::write(folder.path().join("part.obj"), obj).unwrap();
    let text = "<robot name='r'><link name='a'><collision><geometry><mesh filename='part.obj'/></geometry></collision></link></robot>";
    let robot = RobotFile::from_text(text, folder.path().join("r.urdf"))
        .read()
        .unwrap();
    let [note] = robot.file_remarks() else {
        panic!("{:?}", robot.file_remarks());
    };
    assert!(!note.is_warning());
    let message = note.to_string();
    for expected in ["part.obj", "divided by their fourth number: 1", "foo"] {
        assert!(message.contains(expected), "{message}");
    }
}
