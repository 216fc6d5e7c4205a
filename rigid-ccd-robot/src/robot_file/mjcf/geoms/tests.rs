use crate::cell::Cell;
use crate::robot::{LinkBody, Robot};
use crate::robot_file::{RobotFile, RobotFileError};
use ccd_core::order::greater;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{Body, Pose, Solver};
use std::path::Path;

fn robot_of(text: &str) -> Robot {
    RobotFile::from_text(text, "model.xml").read().unwrap()
}

fn bodies_of<'r>(robot: &'r Robot, link: &str) -> &'r [LinkBody] {
    &robot.links()[robot.link_number(link).unwrap()].bodies
}

/// Returns upper bounds of the distances of a small ball from all bodies of a link.
fn distances(robot: &Robot, link: &str, radius: f64, at: DVec3) -> Vec<f64> {
    let ball = Body::sphere(radius).unwrap();
    let mut solver = Solver::new();
    let bodies = bodies_of(robot, link).iter();
    let measured = bodies.map(|own| {
        let ball = (&ball, Pose::at(at).unwrap());
        let answer = solver.distance((&*own.body, own.pose), ball).unwrap();
        answer.outcome.upper()
    });
    measured.collect()
}

/// Tests that a flying ball touches planes of the world and of a static body, also outside their drawn size.
#[test]
fn planes_are_half_spaces() {
    let text = r#"<mujoco><worldbody><geom name="floor" type="plane" size="1 1 0.1"/>
        <body pos="5 0 0"><geom type="plane" size="0 0 1" zaxis="-1 0 0"/></body>
        <body name="ball"><freejoint name="free"/><geom size="0.1"/></body></worldbody></mujoco>"#;
    let file = RobotFile::from_text(text, "model.xml");
    let robot = file.read().unwrap();
    let pairs = file.link_pairs(&robot, None).unwrap();
    assert_eq!(pairs.checked_pairs().count(), 2);
    let cell = Cell::new(robot, pairs);
    let mut solver = cell.solver();
    let mut is_free = |[x, y, z]: [f64; 3]| solver.is_free(&[[x, y, z, 0.3, 0.2, 0.1]]).unwrap();
    assert!(is_free([0.0, 0.0, 0.101]) && is_free([-500.0, 300.0, 0.101]));
    assert!(!is_free([0.0, 0.0, 0.099]) && !is_free([-500.0, 300.0, 0.099]));
    assert!(
        is_free([4.899, 0.0, 9.0]) && !is_free([4.901, 300.0, 9.0]) && !is_free([90.0, 0.0, 9.0])
    );
    let path = [
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ];
    let contact = solver
        .any_contact(&path)
        .unwrap()
        .contact()
        .unwrap()
        .unwrap();
    let names = contact.items.map(|item| item.name());
    assert!(
        names.contains(&"ball") && names.contains(&"world"),
        "{names:?}"
    );
}

#[test]
fn ellipsoids_are_enclosed() {
    let text = r#"<mujoco><worldbody><geom type="ellipsoid" size="0.1 0.2 0.4" pos="1 0 0"/>
        <geom type="ellipsoid" size="0.1" fromto="0 0 0 2 0 0"/></worldbody></mujoco>"#;
    let robot = robot_of(text);
    let bodies = bodies_of(&robot, "world");
    for (own, axes) in bodies.iter().zip([[0.1, 0.2, 0.4], [0.1, 0.1, 1.0]]) {
        let excess = own.body.excess();
        assert!(excess > 0.0 && excess < axes[2] / 400.0, "{excess}");
        let farthest = own.body.bounding_radius();
        assert!(
            farthest >= axes[2] && farthest <= axes[2] + excess + 1e-6,
            "{farthest}"
        );
    }
    // The second capsule extends from 0 to 2 along x.
    let beyond = distances(&robot, "world", 1e-3, DVec3::new(-0.01, 0.0, 0.0))[1];
    assert!((beyond - 0.009).abs() < 1.0 / 400.0, "{beyond}");
}

/// Tests a mesh with vertices in the model: with triangles, without, and with a scale and a reference pose.
#[test]
fn meshes_stand_in_the_model() {
    let corners = "0 0 0 1 0 0 0 1 0 0 0 1";
    let text = format!(
        r#"<mujoco><asset><mesh name="given" vertex="{corners}" face="0 2 1 0 1 3 1 2 3 2 0 3"/>
        <mesh name="hull" vertex="{corners} 0.1 0.1 0.1" scale="2 2 2" refpos="0.5 0 0"/>
        <mesh name="odd" vertex="0 0"/></asset>
        <worldbody><geom type="mesh" mesh="given"/><geom type="mesh" mesh="hull"/></worldbody></mujoco>"#
    );
    assert!(RobotFile::from_text(&*text, "model.xml").read().is_err());
    let text = text.replace(r#"<mesh name="odd" vertex="0 0"/>"#, "");
    let robot = robot_of(&text);
    let close = |found: f64, expected: f64| (found - expected).abs() < 1e-9;
    let [given, hull] = distances(&robot, "world", 1e-3, DVec3::new(3.0, 0.0, 0.0))[..] else {
        panic!("there are two meshes");
    };
    assert!(
        close(given, 2.0 - 1e-3) && close(hull, 2.0 - 1e-3),
        "{given} {hull}"
    );
    assert_eq!(bodies_of(&robot, "world")[1].body.pieces().len(), 1);
    let inside = distances(&robot, "world", 1e-3, DVec3::splat(0.2));
    assert_eq!(inside, [0.0, 0.0]);
    for (attribute, value) in [
        ("face", "0 1 9"),
        ("face", "0 1"),
        ("face", "a b c"),
        ("vertex", "x"),
    ] {
        let text = format!(
            r#"<mujoco><asset><mesh name="m" vertex="{corners}" {attribute}="{value}"/></asset>
            <worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>"#
        );
        let text = text.replace(&format!(r#"vertex="{corners}" vertex"#), "vertex");
        assert!(
            RobotFile::from_text(text, "model.xml").read().is_err(),
            "{value}"
        );
    }
    let builtin = r#"<mujoco><asset><mesh name="m" builtin="cone" params="4 1"/></asset>
        <worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>"#;
    let error = RobotFile::from_text(builtin, "model.xml")
        .read()
        .unwrap_err();
    assert!(
        error.to_string().contains("a mesh that MuJoCo makes"),
        "{error}"
    );
}

/// Returns the height of a height field at a point, from the triangles of its cell.
fn height_at(heights: &[[f64; 3]; 3], [half_x, half_y]: [f64; 2], x: f64, y: f64) -> f64 {
    let (u, v) = (
        (x / half_x + 1.0).clamp(0.0, 2.0),
        (y / half_y + 1.0).clamp(0.0, 2.0),
    );
    let (column, row) = (u.floor().clamp(0.0, 1.0), v.floor().clamp(0.0, 1.0));
    let (u, v) = (u - column, v - row);
    let at = |r: usize, c: usize| heights[row as usize + r][column as usize + c];
    if u > v {
        at(0, 0) + u * (at(0, 1) - at(0, 0)) + v * (at(1, 1) - at(0, 1))
    } else {
        at(0, 0) + v * (at(1, 0) - at(0, 0)) + u * (at(1, 1) - at(1, 0))
    }
}

/// Tests points just above and below a height field, from the model and from a file with the rows in reverse order.
#[test]
fn height_fields_are_solid_below_their_triangles() {
    let mut random = Pcg64::seed_from_u64(16);
    let folder = tempfile::tempdir().unwrap();
    let (mut above, mut below) = (0, 0);
    for round in 0..6 {
        let given: [[f32; 3]; 3] =
            [(); 3].map(|()| [(); 3].map(|()| random.random_range(-2.0..5.0)));
        let all = given.as_flattened().iter().copied();
        let (low, high) = all.clone().fold((9f32, -9f32), |(low, high), own| {
            (
                if own < low { own } else { low },
                if own > high { own } else { high },
            )
        });
        let heights = given.map(|row| row.map(|own| 0.5 * f64::from((own - low) / (high - low))));
        let field = if round % 2 == 0 {
            let rows = given
                .iter()
                .rev()
                .map(|row| row.map(|own| own.to_string()).join(" "));
            let numbers = rows.collect::<Vec<_>>().join(" ");
            format!(r#"nrow="3" ncol="3" elevation="{numbers}""#)
        } else {
            let counts = [3i32, 3].map(i32::to_le_bytes);
            let words = all.map(f32::to_le_bytes);
            let bytes: Vec<u8> = counts.into_iter().chain(words).flatten().collect();
            std::fs::write(folder.path().join("field.hf"), bytes).unwrap();
            r#"file="field.hf""#.to_owned()
        };
        let text = format!(
            r#"<mujoco><asset><hfield name="h" size="1 2 0.5 0.3" {field}/></asset>
            <worldbody><geom type="hfield" hfield="h"/></worldbody></mujoco>"#
        );
        let robot = RobotFile::from_text(text, folder.path().join("model.xml"))
            .read()
            .unwrap();
        for _ in 0..60 {
            let (x, y) = (
                random.random_range(-0.99..0.99),
                random.random_range(-1.98..1.98),
            );
            let surface = height_at(&heights, [1.0, 2.0], x, y);
            let depth = random.random_range(0.0..1.0) * (surface + 0.3 - 2e-6) + 2e-6;
            let inside = distances(&robot, "world", 1e-6, DVec3::new(x, y, surface - depth))[0];
            assert_eq!(inside, 0.0, "{x} {y} {depth}");
            below += 1;
            let height = random.random_range(1e-5..0.2);
            let outside = distances(&robot, "world", 1e-6, DVec3::new(x, y, surface + height))[0];
            assert!(
                outside > 0.0 && outside < height + 1e-9,
                "{x} {y} {height} {outside}"
            );
            above += 1;
        }
        let bottom = distances(&robot, "world", 1e-6, DVec3::new(0.1, 0.2, -0.4))[0];
        assert!((bottom - 0.1).abs() < 1e-5, "{bottom}");
        let beside = distances(&robot, "world", 1e-6, DVec3::new(1.5, 0.2, -0.2))[0];
        assert!((beside - 0.5).abs() < 1e-5, "{beside}");
    }
    assert_eq!((above, below), (360, 360));
}

#[test]
fn height_fields_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("short.hf"), [0; 9]).unwrap();
    std::fs::write(folder.path().join("field.png"), "picture").unwrap();
    let error = |field: &str| {
        let text = format!(
            r#"<mujoco><asset><hfield name="h" {field}/></asset>
            <worldbody><geom type="hfield" hfield="h"/></worldbody></mujoco>"#
        );
        let read = RobotFile::from_text(text, folder.path().join("model.xml")).read();
        read.unwrap_err().to_string()
    };
    assert!(error(r#"nrow="2" ncol="2""#).contains("size=\"\""));
    let sized = |rest: &str| error(&format!(r#"size="1 1 1 1" {rest}"#));
    assert!(sized(r#"nrow="1" ncol="2""#).contains("nrow=\"1\""));
    assert!(sized(r#"nrow="99999999" ncol="99999999""#).contains("nrow"));
    assert!(sized(r#"nrow="2" ncol="2" elevation="1 2 3""#).contains("elevation"));
    assert!(sized(r#"file="short.hf""#).contains("short.hf"));
    assert!(sized(r#"file="none.hf""#).contains("is not found"));
    assert!(sized(r#"file="field.png""#).contains("a height field in a picture"));
    assert!(error(r#"size="1 1 0 1" nrow="2" ncol="2""#).contains("size"));
}

/// Tests the example of MuJoCo's documentation, and a robot replicated three times around a circle.
#[test]
fn elements_are_replicated() {
    let text = r#"<mujoco><worldbody><replicate count="2" offset="0 1 0" euler="90 0 0">
        <replicate count="2" sep="-" offset="1 0 0" euler="0 90 0"><geom name="Alice" size=".1"/></replicate></replicate>
        </worldbody><contact><pair geom1="Alice-01" geom2="Alice-11"/></contact></mujoco>"#;
    let robot = robot_of(text);
    let half = 0.5f64.sqrt();
    let expected = [
        ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]),
        ([1.0, 0.0, 0.0], [0.0, half, 0.0, half]),
        ([0.0, 1.0, 0.0], [half, 0.0, 0.0, half]),
        ([1.0, 1.0, 0.0], [0.5, 0.5, 0.5, 0.5]),
    ];
    let bodies = bodies_of(&robot, "world");
    assert_eq!(bodies.len(), 4);
    for (own, (position, rotation)) in bodies.iter().zip(expected) {
        let turned = own.pose.rotation().dot(DQuat::from_array(rotation)).abs();
        let moved = own.pose.translation().distance(DVec3::from_array(position));
        assert!(moved < 1e-12 && turned > 1.0 - 1e-12, "{:?}", own.pose);
    }
    let arms = r#"<mujoco><worldbody><replicate count="3" euler="0 0 120"><body name="arm" pos="1 0 0">
        <joint name="turn" range="-10 10"/><geom size="0.1"/></body></replicate></worldbody></mujoco>"#;
    let robot = robot_of(arms);
    let names: Vec<&str> = robot.independent_joint_names().collect();
    assert_eq!(names, ["turn0", "turn1", "turn2"]);
    for k in 0..3u32 {
        let pose = robot.pose(&format!("arm{k}"), &[0.0; 3]).unwrap();
        let (sine, cosine) = (f64::from(k) * 120f64.to_radians()).sin_cos();
        let expected = DVec3::new(cosine, sine, 0.0);
        assert!(pose.translation().distance(expected) < 1e-12, "{pose:?}");
    }
    let farthest = bodies.iter().map(|own| own.pose.translation().length());
    assert!(farthest.fold(0.0, greater) < 1.5);
}

#[test]
fn a_file_that_is_missing_is_named() {
    let text = r#"<mujoco><asset><mesh name="m" file="none.stl"/></asset>
        <worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>"#;
    let error = RobotFile::from_text(text, Path::new("model.xml"))
        .read()
        .unwrap_err();
    let RobotFileError::Within { kind, name, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!([*kind, name], ["link", "world"]);
    assert!(error.to_string().contains("none.stl"), "{error}");
}
