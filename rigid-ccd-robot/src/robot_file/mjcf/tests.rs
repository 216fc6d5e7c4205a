mod as_mujoco;

use super::super::{BodyElements, RobotFile, RobotFileError};
use crate::robot::Robot;
use crate::skip_reason::SkipReason;
use rigid_ccd::glam::{DAffine3, DQuat, DVec3};
use rigid_ccd::{Body, Pose, Solver};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

/// A model whose joints have anchors, references and axes. Two joints move the same body.
const LEG: &str = r#"<mujoco model="leg">
  <compiler angle="radian"/>
  <default><default class="shown"><geom contype="0" conaffinity="0" group="2"/></default></default>
  <worldbody>
    <geom name="wall" type="box" size="0.1 1 1" pos="2 0 0"/>
    <body name="hip" pos="0 0 1" quat="0.8 0 0.6 0">
      <joint name="turn" pos="0.1 0.2 0.3" axis="0 2 0" ref="0.4" range="-1 1"/>
      <joint name="tilt" pos="0 0.5 0" axis="1 0 0"/>
      <geom class="shown" type="sphere" size="3"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05"/>
      <body name="shank" pos="0 0 -0.5">
        <joint name="slide" type="slide" axis="0 0 3" ref="0.1" limited="false" range="0 0.2"/>
        <geom type="cylinder" size="0.05 0.2"/>
        <body name="plate" pos="0.1 0 0"><geom type="box" size="0.1 0.2 0.3"/></body>
        <body name="toe"><joint name="toe"/><geom name="toe" type="sphere" size="0.1"/></body>
      </body>
    </body>
    <body name="stone"><freejoint/><geom type="sphere" size="0.1"/></body>
  </worldbody>
  <contact><exclude body1="stone" body2="toe"/></contact>
  <equality><joint joint1="toe" joint2="turn" polycoef="0.5 -2 0 0 0"/></equality>
</mujoco>"#;

fn file_of(text: &str) -> RobotFile {
    RobotFile::from_text(text, "model.xml")
}

fn joint_about(anchor: DVec3, rotation: DQuat) -> DAffine3 {
    DAffine3::from_translation(anchor)
        * DAffine3::from_quat(rotation)
        * DAffine3::from_translation(-anchor)
}

/// Returns the frames of hip, shank and stone by MJCF's rule: each joint moves its body about its anchor, by the
/// distance from its reference.
fn expected_frames([turn, tilt, slide]: [f64; 3], stone: [f64; 6]) -> [DAffine3; 3] {
    let hip = DAffine3::from_rotation_translation(DQuat::from_xyzw(0.0, 0.6, 0.0, 0.8), DVec3::Z);
    let hip =
        hip * joint_about(
            DVec3::new(0.1, 0.2, 0.3),
            DQuat::from_rotation_y(turn - 0.4),
        ) * joint_about(DVec3::new(0.0, 0.5, 0.0), DQuat::from_rotation_x(tilt));
    let shank = hip * DAffine3::from_translation(DVec3::new(0.0, 0.0, slide - 0.1 - 0.5));
    let [x, y, z, yaw, pitch, roll] = stone;
    let rotation =
        DQuat::from_rotation_z(yaw) * DQuat::from_rotation_y(pitch) * DQuat::from_rotation_x(roll);
    let stone = DAffine3::from_rotation_translation(rotation, DVec3::new(x, y, z));
    [hip, shank, stone]
}

fn affine(pose: Pose) -> DAffine3 {
    DAffine3::from_rotation_translation(pose.rotation(), pose.translation())
}

fn largest_difference(pose: Pose, expected: DAffine3) -> f64 {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let distances = corners.map(|point| {
        pose.transform_point(point)
            .distance(expected.transform_point3(point))
    });
    distances.into_iter().fold(0.0, ccd_core::order::greater)
}

#[test]
fn joints_move_bodies_about_their_anchors() {
    let robot = file_of(LEG).read().unwrap();
    let names: Vec<&str> = robot.independent_joint_names().collect();
    let stone = ["x", "y", "z", "yaw", "pitch", "roll"].map(|own| format!("stone/joint0/{own}"));
    let mut known = vec!["turn", "tilt", "slide"];
    known.extend(stone.iter().map(String::as_str));
    assert_eq!(names, known);
    let limits: Vec<[f64; 2]> = robot.limits().take(3).collect();
    let infinite = [f64::NEG_INFINITY, f64::INFINITY];
    assert_eq!(limits, [[-1.0, 1.0], infinite, infinite]);
    for own in [[0.0; 3], [0.4, 0.0, 0.1], [-0.7, 1.3, 0.6]] {
        let of_stone = [1.0, 2.0, 3.0, 0.4, -0.5, 0.6];
        let at = [&own[..], &of_stone].concat();
        for (link, expected) in ["hip", "shank", "stone"]
            .into_iter()
            .zip(expected_frames(own, of_stone))
        {
            let difference = largest_difference(robot.pose(link, &at).unwrap(), expected);
            assert!(difference < 1e-12, "{link} {difference} at {own:?}");
        }
    }
}

/// Tests the position of a joint that follows another one by a polynomial, relative to both references.
#[test]
fn a_joint_follows_another_one() {
    let robot = file_of(LEG).read().unwrap();
    let mut at = vec![0.0; robot.independent_joint_names().len()];
    at[0] = 0.7;
    let [shank, toe] = ["shank", "toe"].map(|link| robot.pose(link, &at).unwrap());
    let turned = (shank.rotation().inverse() * toe.rotation()).to_scaled_axis();
    // 0.5 − 2 (0.7 − 0.4)
    assert!(
        turned.distance(DVec3::new(0.0, 0.0, -0.1)) < 1e-12,
        "{turned}"
    );
}

#[test]
fn constraints_in_a_circle_are_broken_up() {
    let text = r#"<mujoco><worldbody><body name="a"><joint name="p"/><geom size="1"/>
        <body name="b"><joint name="q"/><geom size="1"/></body></body></worldbody>
        <equality><joint joint1="p" joint2="q"/><joint joint1="q" joint2="p"/></equality></mujoco>"#;
    let robot = file_of(text).read().unwrap();
    assert_eq!(robot.independent_joint_names().collect::<Vec<_>>(), ["q"]);
}

fn checked_names(text: &str, elements: BodyElements) -> Vec<String> {
    let file = file_of(text).with_body_element_kind(elements);
    let robot = file.read().unwrap();
    let pairs = file.link_pairs(&robot, None).unwrap();
    let name = |link: usize| robot.links()[link].name.clone();
    let mut names: Vec<String> = pairs
        .checked_pairs()
        .map(|pair| {
            let mut pair = pair.map(name);
            pair.sort();
            pair.join(" ")
        })
        .collect();
    names.sort();
    names
}

/// Tests that the pairs are MuJoCo's: a body is not checked against its parent or bodies fixed to it, unless that is
/// the world.
#[test]
fn pairs_are_those_of_mujoco() {
    let known = [
        "hip stone",
        "hip toe",
        "hip world",
        "plate stone",
        "plate world",
        "shank stone",
        "shank world",
        "stone world",
        "toe world",
    ];
    assert_eq!(checked_names(LEG, BodyElements::Collision), known);
}

#[test]
fn masks_and_pairs_decide() {
    let text = r#"<mujoco><worldbody>
        <body name="a"><freejoint/><geom name="a" size="1" contype="1" conaffinity="2"/></body>
        <body name="b"><freejoint/><geom name="b" size="1" contype="1" conaffinity="4"/></body>
        <body name="c"><freejoint/><geom name="c" size="1" contype="2" conaffinity="0"/></body>
        <body name="d"><freejoint/><geom name="d" size="1" contype="0" conaffinity="0"/></body>
        </worldbody><contact><pair geom1="b" geom2="d"/></contact></mujoco>"#;
    assert_eq!(checked_names(text, BodyElements::Collision), ["a c", "b d"]);
    assert_eq!(checked_names(text, BodyElements::Visual).len(), 6);
    let robot = file_of(text).read().unwrap();
    let pairs = file_of(text).link_pairs(&robot, None).unwrap();
    let [a, b] = ["a", "b"].map(|link| robot.link_number(link).unwrap());
    let reason = SkipReason::Disabled("contype and conaffinity".to_owned());
    assert_eq!(pairs.skip_reason(a, b), Some(&reason));
}

/// Returns the distance of a small ball from the only body of a link, in the link's frame.
fn distance_from_link(robot: &Robot, link: &str, point: DVec3) -> f64 {
    let link_bodies = &robot.links()[robot.link_number(link).unwrap()].bodies;
    let ball = Body::sphere(1e-9).unwrap();
    let answer = Solver::new().distance(
        (&*link_bodies[0].body, link_bodies[0].pose),
        (&ball, Pose::at(point).unwrap()),
    );
    answer.unwrap().outcome.upper()
}

#[test]
fn geoms_have_the_sizes_of_halves_or_lie_between_points() {
    let robot = file_of(LEG).read().unwrap();
    let near = |link, point: [f64; 3], expected: f64| {
        let distance = distance_from_link(&robot, link, DVec3::from_array(point));
        assert!(
            (distance - expected).abs() < 1e-3,
            "{link} {point:?} {distance}"
        );
    };
    // The capsule from 0 to −0.4, without the visual sphere.
    near("hip", [0.0, 0.0, 0.5], 0.45);
    near("hip", [0.0, 0.0, -1.0], 0.55);
    near("hip", [0.3, 0.0, -0.2], 0.25);
    near("shank", [0.0, 0.0, 1.0], 0.8);
    near("plate", [0.0, 1.2, 0.0], 1.0);
    near("world", [0.0; 3], 1.9);
    let shown = file_of(LEG)
        .with_body_element_kind(BodyElements::Visual)
        .read()
        .unwrap();
    assert_eq!(
        shown.links()[shown.link_number("hip").unwrap()]
            .bodies
            .len(),
        2
    );
}

/// Tests that a mesh is moved to its reference pose before it is scaled.
#[test]
fn meshes_have_reference_poses_and_scales() {
    let folder = tempfile::tempdir().unwrap();
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::create_dir(folder.path().join("meshes")).unwrap();
    std::fs::write(folder.path().join("meshes/part.obj"), tetrahedron).unwrap();
    let text = r#"<mujoco><compiler meshdir="meshes"/>
        <asset><mesh file="part.obj" scale="2 1 -1" refpos="0 0 3" refquat="0.70710678118654752 0 0 0.70710678118654752"/></asset>
        <worldbody><body name="a"><joint/><geom type="mesh" mesh="part" pos="0 5 0"/></body></worldbody></mujoco>"#;
    let path = folder.path().join("model.xml");
    std::fs::write(&path, text).unwrap();
    let robot = RobotFile::from_path(&path).read().unwrap();
    // (1, 0, 0) − (0, 0, 3), rotated by −90° about z, scaled, and moved to the geom's pose.
    for (vertex, expected) in [
        ([1.0, 0.0, 0.0], [0.0, 4.0, 3.0]),
        ([0.0, 1.0, 0.0], [2.0, 5.0, 3.0]),
        ([0.0, 0.0, 1.0], [0.0, 5.0, 2.0]),
    ] {
        let distance = distance_from_link(&robot, "a", DVec3::from_array(expected));
        assert!(distance < 1e-6, "{vertex:?} {distance}");
    }
}

#[test]
fn what_has_no_body_is_an_error_that_names_it() {
    let error = |geom: &str| {
        let text =
            format!(r#"<mujoco><worldbody><body name="a">{geom}</body></worldbody></mujoco>"#);
        file_of(&text).read().unwrap_err().to_string()
    };
    let field = error(r#"<geom name="blob" type="sdf" size="0 0 1"/>"#);
    let advice = "is not supported; leave it out of the file, and model it as an obstacle";
    let expected = format!("link `a`: geom `blob`: a signed distance field {advice}");
    assert_eq!(field, expected);
    let moving = error(r#"<joint/><geom type="plane" size="0 0 1"/>"#);
    let advice = "has a plane, and a joint moves it; only a static link may have planes";
    assert_eq!(moving, format!("link `a` {advice}"));
    assert!(error(r#"<geom type="ellipsoid" size="1 2 0"/>"#).contains("size"));
    assert!(error(r#"<geom type="hfield" hfield="h"/>"#).contains("there is no hfield `h`"));
    let missing = error(r#"<geom type="mesh" mesh="none"/>"#);
    assert_eq!(missing, "link `a`: geom `0`: there is no mesh `none`");
    // A sphere needs one positive size, a box three.
    let size = "link `a`: geom `0`: size=\"1 2\" of an element `geom` is not valid";
    assert_eq!(error(r#"<geom type="box" size="1 2"/>"#), size);
    assert!(error("<geom/>").contains("size=\"\""));
    assert!(error(r#"<geom type="capsule" size="1 0"/>"#).contains("size"));
    assert!(error(r#"<geom type="blob" size="1"/>"#).contains("type=\"blob\""));
    let syntax = file_of("<mujoco><worldbody></mujoco>").read().unwrap_err();
    assert!(matches!(syntax, RobotFileError::Syntax { .. }), "{syntax}");
    assert!(file_of("").read().is_err());
}

/// Tests that unknown elements are refused wherever they may be a shape, a joint or a pair.
#[test]
fn nothing_is_passed_over() {
    let error = |world: &str, rest: &str| {
        let text = format!("<mujoco><worldbody>{world}</worldbody>{rest}</mujoco>");
        let file = file_of(&text);
        let read = file.read().and_then(|robot| file.link_pairs(&robot, None));
        read.unwrap_err().to_string()
    };
    let ball = r#"<geom size="1"/>"#;
    for element in ["composite", "flexcomp", "attach"] {
        let known = format!("element `{element}` in `body` is not supported");
        assert_eq!(
            error(&format!("<body><{element}>{ball}</{element}></body>"), ""),
            known
        );
    }
    assert!(error("<replicate count='0'/>", "").contains("count=\"0\""));
    let many = "<replicate count='9999999'><geom size='1'/></replicate>";
    assert!(error(many, "").contains("too many"));
    let deformable = error(ball, "<deformable/>");
    assert_eq!(
        deformable,
        "element `deformable` in `mujoco` is not supported"
    );
    let free_child = format!("<body>{ball}<body><freejoint/>{ball}</body></body>");
    assert!(error(&free_child, "").contains("`freejoint`"));
    assert!(error("<joint/>", "").contains("`joint`"));
    let closed = error(r#"<body><joint><geom size="1"/></joint></body>"#, "");
    assert_eq!(closed, "element `geom` in `joint` is not supported");
    let limited = format!(r#"<body><joint limited="true"/>{ball}</body>"#);
    assert!(error(&limited, "").contains("range=\"\""));
    let class = r#"<body><geom class="none" size="1"/></body>"#;
    assert_eq!(error(class, ""), "there is no class `none`");
    let pair = r#"<contact><pair geom1="a" geom2="b"/></contact>"#;
    assert_eq!(error(ball, pair), "there is no geom `a`");
    let exclude = r#"<contact><exclude body1="world" body2="none"/></contact>"#;
    assert_eq!(error(ball, exclude), "there is no body `none`");
    let equality = r#"<equality><joint joint1="p"/></equality>"#;
    assert_eq!(error(ball, equality), "there is no joint `p`");
    assert!(error("<include file=\"none.xml\"/>", "").starts_with("none.xml: "));
    assert!(error(r#"<geom size="1 nan"/>"#, "").contains("size=\"1 nan\""));
}

/// Tests that elements inherit from their class, sizes number by number, and inner classes from outer ones.
#[test]
fn classes_give_what_an_element_leaves_out() {
    let text = r#"<mujoco><compiler angle="radian"/>
        <worldbody><body childclass="inner">
            <geom size="0.1"/><geom class="outer" pos="0 0 3"/><geom type="sphere"/>
            <joint/></body></worldbody>
        <default><joint axis="0 1 0"/>
            <default class="outer"><geom type="capsule" size="0.05 0.2" quat="0.6 0.8 0 0" pos="0 0 1"/><joint range="0 2"/>
                <default class="inner"><geom euler="0 0 1"/><joint range="0 1"/></default></default></default></mujoco>"#;
    let robot = file_of(text).read().unwrap();
    assert_eq!(robot.limits().collect::<Vec<_>>(), [[0.0, 1.0]]);
    let link_bodies = &robot.links()[robot.link_number("body1").unwrap()].bodies;
    assert_eq!(link_bodies.len(), 3);
    // The half height 0.2 is the class's and the radius 0.1 the element's; the position is the class's and the
    // rotation the element's.
    assert!((link_bodies[0].body.bounding_radius() - 0.3).abs() < 1e-12);
    let expected = Pose::new([0.0, 0.0, 1.0], DQuat::from_rotation_z(1.0)).unwrap();
    assert!(largest_difference(link_bodies[0].pose, affine(expected)) < 1e-12);
    let expected = Pose::new([0.0, 0.0, 3.0], DQuat::from_xyzw(0.8, 0.0, 0.0, 0.6)).unwrap();
    assert!(largest_difference(link_bodies[1].pose, affine(expected)) < 1e-12);
    assert!((link_bodies[2].body.bounding_radius() - 0.05).abs() < 1e-12);
    // It is ambiguous if an element and its class specify the rotation by different attributes.
    let other = text.replace(r#"<geom size="0.1"/>"#, r#"<geom axisangle="1 0 0 1"/>"#);
    assert!(file_of(&other).read().is_err());
}

/// Tests all kinds of rotations against their definitions, also within frames.
#[test]
fn orientations_are_those_of_their_definitions() {
    let (x, y, z) = (
        DQuat::from_rotation_x,
        DQuat::from_rotation_y,
        DQuat::from_rotation_z,
    );
    for (compiler, attribute, expected) in [
        ("", r#"euler="90 0 30""#, x(FRAC_PI_2) * z(FRAC_PI_6)),
        (
            r#"eulerseq="XYZ""#,
            r#"euler="90 0 30""#,
            z(FRAC_PI_6) * x(FRAC_PI_2),
        ),
        (
            r#"angle="radian" eulerseq="zyx""#,
            r#"euler="0.1 0.2 0.3""#,
            z(0.1) * y(0.2) * x(0.3),
        ),
        ("", r#"axisangle="0 0 2 30""#, z(FRAC_PI_6)),
        ("", r#"xyaxes="0 2 0 -1 1 0""#, z(FRAC_PI_2)),
        ("", r#"zaxis="0 -3 0""#, x(FRAC_PI_2)),
        ("", r#"zaxis="0 0 -1""#, x(2.0 * FRAC_PI_2)),
        ("", r#"quat="3 0 0 3""#, z(FRAC_PI_2)),
    ] {
        let text = format!(
            r#"<mujoco><compiler {compiler}/><worldbody>
            <frame pos="1 0 0" quat="0.6 0 0 0.8"><frame pos="0 1 0">
                <body name="a" {attribute}><joint pos="0 0 1" axis="1 0 0"/><geom size="1"/></body></frame></frame>
            <body name="b"><frame pos="1 0 0" quat="0.6 0 0 0.8"><joint name="b" pos="0 0 1" axis="1 0 0"/>
                <geom type="box" size="1 1 1" {attribute}/></frame></body></worldbody></mujoco>"#
        );
        let robot = file_of(&text).read().unwrap();
        let frame =
            DAffine3::from_rotation_translation(DQuat::from_xyzw(0.0, 0.0, 0.8, 0.6), DVec3::X);
        let turned = frame * DAffine3::from_translation(DVec3::Y) * DAffine3::from_quat(expected);
        let moved = turned * joint_about(DVec3::Z, x(0.3));
        let found = robot.pose("a", &[0.3, 0.4]).unwrap();
        assert!(
            largest_difference(found, moved) < 1e-12,
            "{attribute} {found:?}"
        );
        let axis = DQuat::from_xyzw(0.0, 0.0, 0.8, 0.6) * DVec3::X;
        let anchor = frame.transform_point3(DVec3::Z);
        let moved = joint_about(anchor, DQuat::from_axis_angle(axis, 0.4));
        let found = robot.pose("b", &[0.3, 0.4]).unwrap();
        assert!(
            largest_difference(found, moved) < 1e-12,
            "{attribute} {found:?}"
        );
        let first_body = &robot.links()[robot.link_number("b").unwrap()].bodies[0];
        let expected = frame * DAffine3::from_quat(expected);
        assert!(
            largest_difference(first_body.pose, expected) < 1e-12,
            "{attribute}"
        );
    }
}

/// Tests that included elements replace their `include`, and that settings and classes apply wherever they are in the
/// file.
#[test]
fn files_are_included() {
    let folder = tempfile::tempdir().unwrap();
    let part = r#"<mujocoinclude><body name="part"><joint range="0 1"/><geom class="thin" type="capsule"/></body></mujocoinclude>"#;
    std::fs::write(folder.path().join("part.xml"), part).unwrap();
    let text = r#"<mujoco><worldbody><body name="a"><geom size="1"/><include file="part.xml"/></body></worldbody>
        <compiler angle="radian"/><default><default class="thin"><geom size="0.1 0.4"/></default></default></mujoco>"#;
    let path = folder.path().join("model.xml");
    let robot = RobotFile::from_text(text, &path).read().unwrap();
    assert_eq!(robot.limits().collect::<Vec<_>>(), [[0.0, 1.0]]);
    let part = &robot.links()[robot.link_number("part").unwrap()];
    assert!((part.bodies[0].body.bounding_radius() - 0.5).abs() < 1e-12);
    // A file that includes itself is an error.
    std::fs::write(
        folder.path().join("loop.xml"),
        "<x><include file='loop.xml'/></x>",
    )
    .unwrap();
    let text = "<mujoco><include file='loop.xml'/></mujoco>";
    let error = RobotFile::from_text(text, &path).read().unwrap_err();
    let expected = "there are several elements `include` with the name `loop.xml`";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn parents_are_checked_if_the_model_says_so_and_mocap_bodies_move() {
    let text = r#"<mujoco><option><flag filterparent="disable"/></option><worldbody>
        <body name="a"><joint/><geom size="1"/><body name="b"><joint/><geom size="1"/></body></body>
        <body name="target" mocap="true" pos="0 0 9"><geom size="1"/></body></worldbody></mujoco>"#;
    assert_eq!(
        checked_names(text, BodyElements::Collision),
        ["a b", "a target", "b target"]
    );
    let robot = file_of(text).read().unwrap();
    assert_eq!(robot.independent_joint_names().len(), 8);
    let with_parents = text.replace("disable", "enable");
    assert_eq!(
        checked_names(&with_parents, BodyElements::Collision).len(),
        2
    );
}

/// Tests that the last folder counts, that an empty range gives no limits, and that classes can switch equalities off.
#[test]
fn settings_are_those_that_mujoco_takes() {
    let folder = tempfile::tempdir().unwrap();
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::create_dir(folder.path().join("second")).unwrap();
    std::fs::write(folder.path().join("second/part.obj"), tetrahedron).unwrap();
    let text = r#"<mujoco><compiler meshdir="first"/><compiler assetdir="second"/>
        <equality><joint joint1="p" joint2="q"/></equality>
        <default><equality active="false"/><joint range="0 0"/></default>
        <asset><mesh file="part.obj"/></asset><worldbody><body><geom type="mesh" mesh="part"/>
        <joint name="p"/><joint name="q" type="slide" range="1 -1"/></body></worldbody></mujoco>"#;
    let robot = RobotFile::from_text(text, folder.path().join("model.xml"))
        .read()
        .unwrap();
    assert_eq!(
        robot.independent_joint_names().collect::<Vec<_>>(),
        ["p", "q"]
    );
    assert!(
        robot
            .limits()
            .all(|[low, high]| low == f64::NEG_INFINITY && high == f64::INFINITY)
    );
    // Nesting that is too deep is an error.
    let deep = format!(
        "<mujoco><worldbody>{}</worldbody></mujoco>",
        "<body>".repeat(60_000) + &"</body>".repeat(60_000)
    );
    assert!(file_of(&deep).read().is_err());
}

/// Tests that attributes outside MuJoCo's schema are refused, also in settings and classes, with the name of the
/// element.
#[test]
fn attributes_that_mjcf_does_not_have_are_refused() {
    let error = |text: &str| file_of(text).read().unwrap_err().to_string();
    let world = |content: &str| format!("<mujoco><worldbody>{content}</worldbody></mujoco>");
    let ball = r#"<geom name="ball" size="1" eulr="0 0 1"/>"#;
    let unknown = |element: &str, attribute: &str| {
        format!("an element `{element}` has no attribute `{attribute}`")
    };
    assert_eq!(error(&world(ball)), unknown("geom ball", "eulr"));
    let frame = world(r#"<frame foo="1"/>"#);
    assert_eq!(error(&frame), unknown("frame", "foo"));
    let class = r#"<mujoco><default><joint axes="1 0 0"/></default></mujoco>"#;
    assert_eq!(error(class), unknown("joint", "axes"));
    let setting = r#"<mujoco><compiler anlge="radian"/></mujoco>"#;
    assert_eq!(error(setting), unknown("compiler", "anlge"));
    let zero = world(r#"<geom name="ball" size="1" quat="0 0 0 0"/>"#);
    let expected = "quat=\"0 0 0 0\" of an element `geom ball` is not valid";
    assert!(error(&zero).ends_with(expected), "{}", error(&zero));
    // Elements that are unrelated to shapes, joints and pairs may have any attributes.
    let harmless = world(r#"<light shine="1"/><body><inertial heavy="1"/><geom size="1"/></body>"#);
    assert!(file_of(&harmless).read().is_ok());
}

/// Tests that limits of free and ball joints are ignored, for example from a class that limits all joints.
#[test]
fn limits_of_free_and_ball_joints_do_not_count() {
    let text = |joint: &str| {
        format!(
            r#"<mujoco><default><joint limited="true"/></default><worldbody><body>{joint}<geom size="1"/></body></worldbody>
            </mujoco>"#
        )
    };
    for joint in [
        r#"<joint type="ball"/>"#,
        r#"<joint type="free"/>"#,
        "<freejoint/>",
    ] {
        assert!(file_of(&text(joint)).read().is_ok(), "{joint}");
    }
    assert!(file_of(&text("<joint/>")).read().is_err());
}

#[test]
fn remarks_name_constraints_and_limits_in_degrees() {
    let text = r#"<mujoco><compiler angle="radian"/><worldbody><body name="a"><joint name="j" range="-90 90"/><geom size="1"/></body>
        </worldbody><equality><weld name="w" body1="a"/><connect body1="a" active="false"/></equality></mujoco>"#;
    let robot = file_of(text).read().unwrap();
    let remarks: Vec<String> = robot
        .file_remarks()
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    assert!(remarks[0].ends_with("weld w in equality"), "{remarks:?}");
    assert!(remarks[1].starts_with("joint j: "), "{remarks:?}");
}
