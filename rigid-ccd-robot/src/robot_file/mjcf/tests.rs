use super::super::{BodyElements, RobotFile, RobotFileError};
use crate::pairs::SkipReason;
use crate::robot::Robot;
use rigid_ccd::glam::{DAffine3, DQuat, DVec3};
use rigid_ccd::{Body, Pose, Solver};

/// A model whose joints have anchors, references and axes of their own; two of them move one body.
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

/// Returns the frames of hip, shank and stone by the rules of MJCF: each joint moves the body about its anchor by how far it
/// is from its reference.
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
    let names: Vec<&str> = robot.free_joint_names().collect();
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

/// Tests that a joint follows another one, as far from its own reference as the polynomial says.
#[test]
fn a_joint_follows_another_one() {
    let robot = file_of(LEG).read().unwrap();
    let mut at = vec![0.0; robot.free_joint_names().len()];
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
    assert_eq!(robot.free_joint_names().collect::<Vec<_>>(), ["q"]);
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

/// Tests that the pairs are those of MuJoCo: a body and its parent are none, nor are bodies that are fixed to these, but the
/// world is no such parent.
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

/// Returns the distance of a small ball at a point from the only body of a link, in the frame of the link.
fn distance_from_link(robot: &Robot, link: &str, point: DVec3) -> f64 {
    let held = &robot.links()[robot.link_number(link).unwrap()].bodies;
    let ball = Body::sphere(1e-9).unwrap();
    let answer = Solver::new().distance(
        (&*held[0].body, held[0].pose),
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
    // The capsule from 0 to −0.4, without the sphere that is only shown.
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

/// Tests that a mesh is scaled after it is moved to its reference pose.
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
    // (1, 0, 0) − (0, 0, 3), turned by −90° about z, scaled, and moved to the pose of the geom.
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
    let plane = error(r#"<geom name="floor" type="plane" size="0 0 1"/>"#);
    let advice = "is not supported; leave it out of the file, and model it as an obstacle";
    assert_eq!(plane, format!("link `a`: geom `floor`: a plane {advice}"));
    assert!(error(r#"<geom type="ellipsoid" size="1 2 3"/>"#).contains("an ellipsoid"));
    let missing = error(r#"<geom type="mesh" mesh="none"/>"#);
    assert!(
        missing.contains("geom `0`: `none` is not found"),
        "{missing}"
    );
    let syntax = file_of("<mujoco><worldbody></mujoco>").read().unwrap_err();
    assert!(matches!(syntax, RobotFileError::Syntax { .. }), "{syntax}");
    assert!(file_of("").read().is_err());
}
