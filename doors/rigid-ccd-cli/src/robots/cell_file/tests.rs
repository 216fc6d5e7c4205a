use super::*;
use rigid_ccd::trajectory;
use rigid_ccd_robot::{Joint, Link, LinkPairs, PositionRule, Robot};
use std::fs;

fn empty_cell() -> Cell {
    let ball = Link::named("arm").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let hinge = Joint {
        name: "hinge".into(),
        parent: "base".into(),
        child: "arm".into(),
        geometry: trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    let robot = Robot::new(vec![Link::named("base"), ball], vec![hinge]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    Cell::new(robot, pairs)
}

fn read(text: &str) -> Result<Cell> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("cell.toml");
    fs::write(&path, text)?;
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    fs::write(folder.path().join("corner.obj"), corners)?;
    let other = r#"<robot name="cart"><link name="deck"><collision><geometry><box size="1 1 0.2"/></geometry></collision></link>
        <link name="mast"/><joint name="lift" type="prismatic"><parent link="deck"/><child link="mast"/>
        <axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>"#;
    fs::write(folder.path().join("cart.urdf"), other)?;
    let cell = empty_cell();
    let source = CellSource::read(&path)?;
    let own = (cell.robot().clone(), cell.link_pairs().clone());
    let (robot, pairs) = source.combine(own, |urdf| urdf)?;
    let mut cell = Cell::new(robot, pairs);
    source.add_to(&mut cell)?;
    Ok(cell)
}

#[test]
fn a_cell_has_what_its_file_says() {
    let text = "
        [[obstacle]]
        name = 'table'
        body = 'box:1,1,0.1'
        position = [0, 0, -0.5]

        [[obstacle]]
        name = 'corner'
        body = 'corner.obj@scale=0.1'
        position = [0.15, 0, 0]
        quaternion_xyzw = [0, 0, 1, 0]

        [[attached]]
        name = 'tool'
        body = 'sphere:0.05'
        link = 'arm'
        position = [0.2, 0, 0]
        may_touch = ['arm']

        [padding]
        arm = 0.02

        [[clearance]]
        between = ['arm', 'table']
        distance = 0.35";
    let cell = read(text).unwrap();
    assert_eq!(
        cell.obstacle_names().collect::<Vec<_>>(),
        ["table", "corner"]
    );
    assert_eq!(cell.attached_names().collect::<Vec<_>>(), ["tool"]);
    // The table is 0.3 below the ball, which has to keep 0.35.
    let contact = cell
        .solver()
        .any_contact(&[[1.5]])
        .unwrap()
        .contact()
        .unwrap()
        .unwrap();
    assert_eq!(contact.items.map(|item| item.name()), ["arm", "table"]);
}

/// Tests that a message names the table that is wrong, and not the one above it.
#[test]
fn errors_name_their_own_table() {
    let allowed = "[[allowed]]\nbetween = ['arm', 'base']\n";
    for (text, expected) in [
        (
            "[[obstacles]]\nname = 'a'",
            "line 3, `[[obstacles]]`: unknown field `obstacles`",
        ),
        (
            "[[obstacle]]\nbody = 'sphere:1'",
            "line 3, `[[obstacle]]`: missing field `name`",
        ),
        (
            "[[obstacle]]\nname = 1",
            "line 4, `name = 1` of [[obstacle]]: invalid type",
        ),
    ] {
        let error = read(&format!("{allowed}{text}")).unwrap_err();
        let message = crate::console::causes::message_with_causes(&error);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

/// Tests that a plane is a half-space without an end, at the pose that the file gives.
#[test]
fn a_plane_has_no_end() {
    let cell = |z: f64| {
        let text = format!("[[plane]]\nname = 'floor'\nposition = [500, 0, {z}]\nrpy = [0, 0, 1]");
        read(&text).unwrap()
    };
    let touches = |z: f64| {
        let cell = cell(z);
        let contact = cell
            .solver()
            .any_contact(&[[1.5]])
            .unwrap()
            .contact()
            .unwrap();
        contact.map(|contact| contact.items.map(|item| item.name().to_owned()))
    };
    assert_eq!(touches(-0.101), None);
    assert_eq!(touches(-0.099), Some(["arm", "floor"].map(str::to_owned)));
    assert!(touches(99.0).is_some());
}

#[test]
fn errors_name_what_is_wrong() {
    for (text, expected) in [
        ("[[obstacle]]\nname = 'a'\nbody = 'box:1'", "obstacle a"),
        ("[[obstacle]]\nname = 'a'\nbody = 'none.obj'", "none.obj"),
        ("[[obstacle]]\nname = 'arm'\nbody = 'sphere:1'", "arm"),
        (
            "[[obstacle]]\nname = 'a'\nbody = 'sphere:1'\nrpy = [0, 0, 0]\nquaternion_xyzw = [1, 0, 0, 0]",
            "rpy",
        ),
        ("[[obstacles]]\nname = 'a'\nbody = 'sphere:1'", "obstacles"),
        ("[[plane]]\nname = 'arm'", "plane arm"),
        ("[[plane]]\nname = 'a'\nbody = 'sphere:1'", "body"),
        ("[padding]\nleg = 0.1", "leg"),
        (
            "[[clearance]]\nbetween = ['arm', 'wall']\ndistance = 0.1",
            "wall",
        ),
        (
            "[[attached]]\nname = 'a'\nbody = 'sphere:1'\nlink = 'hand'",
            "hand",
        ),
    ] {
        let error = read(text).map(|_| ()).unwrap_err();
        let message = crate::console::causes::message_with_causes(&error);
        assert!(message.contains(expected), "{message}");
    }
}

/// Tests that no clearance gets lost: a pair has one, and none if it may touch.
#[test]
fn a_pair_says_one_thing() {
    let things = "
        [[obstacle]]
        name = 'wall'
        body = 'sphere:1'
        position = [3, 0, 0]
        [[attached]]
        name = 'tool'
        body = 'sphere:0.05'
        link = 'arm'
        may_touch = ['wall']
        [[clearance]]
        between = ['arm', 'wall']
        distance = 0.1\n";
    read(things).unwrap();
    for (text, expected) in [
        (
            "[[clearance]]\nbetween = ['wall', 'arm']\ndistance = 0.05",
            "clearance between wall, arm: this pair has another clearance",
        ),
        (
            "[[allowed]]\nbetween = ['wall', 'arm']",
            "allowed wall, arm: this pair has a [[clearance]]",
        ),
        (
            "[[clearance]]\nbetween = ['wall', 'tool']\ndistance = 0.05",
            "may_touch wall of attached body tool: this pair has a [[clearance]]",
        ),
    ] {
        for text in [format!("{things}{text}"), format!("{text}\n{things}")] {
            let error = read(&text).map(|_| ()).unwrap_err();
            let message = crate::console::causes::message_with_causes(&error);
            let reversed = "clearance between arm, wall: this pair has another clearance";
            assert!(
                message.contains(expected) || message.contains(reversed),
                "{text}: {message}"
            );
        }
    }
}

/// Tests that no value is passed over: each array has as many as its key needs, and of one type.
#[test]
fn surplus_and_missing_values_are_refused() {
    let ball = "[[obstacle]]\nname = 'ball'\nbody = 'sphere:1'\nposition = [3, 0, 0]\n";
    for (text, expected) in [
        (
            "position = [0, 0, 0, 1]",
            "obstacle wall: position has 4 values, not 3",
        ),
        (
            "position = [0, 0]",
            "obstacle wall: position has 2 values, not 3",
        ),
        (
            "position = []",
            "obstacle wall: position has 0 values, not 3",
        ),
        (
            "position = [0, 0, 0, 'm']",
            "line 9, `position = [0, 0, 0, 'm']` of [[obstacle]]: invalid type",
        ),
        (
            "position = 1",
            "line 9, `position = 1` of [[obstacle]]: invalid type",
        ),
        (
            "rpy = [0, 0, 0, 1]",
            "obstacle wall: rpy has 4 values, not 3",
        ),
        (
            "quaternion_xyzw = [1, 0, 0, 0, 0]",
            "obstacle wall: quaternion_xyzw has 5 values, not 4",
        ),
        (
            "moves = 'planar'\nrpy = [0]",
            "obstacle wall: rpy has 1 values, not 3",
        ),
        ("orientation = [1, 0, 0, 0]", "unknown field `orientation`"),
        (
            "[[clearance]]\nbetween = ['ball', 'arm', 'wall']\ndistance = 0.1",
            "clearance between ball, arm, wall: between has 3 values, not 2",
        ),
        (
            "[[clearance]]\nbetween = ['ball']\ndistance = 0.1",
            "clearance between ball: between has 1 values, not 2",
        ),
        (
            "[[clearance]]\nbetween = ['ball', 'arm']",
            "missing field `distance`",
        ),
        (
            "[[attached]]\nname = 'tool'\nbody = 'sphere:1'\nlink = 'arm'\nposition = [1]",
            "attached body tool: position",
        ),
        (
            "[[robot]]\nname = 'r'\nurdf = 'cart.urdf'\nquaternion_xyzw = [1]",
            "robot r: quaternion_xyzw",
        ),
        ("[padding]\narm = [0.1, 0.2]", "of [padding]: invalid type"),
    ] {
        let text = format!("{ball}\n[[obstacle]]\nname = 'wall'\nbody = 'sphere:1'\n{text}");
        let error = read(&text).map(|_| ()).unwrap_err();
        let message = crate::console::causes::message_with_causes(&error);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn other_robots_and_moving_obstacles_have_positions_of_their_own() {
    let text = "
        [[robot]]
        name = 'cart'
        urdf = 'cart.urdf'
        position = [3, 0, 0]
        base = 'planar'

        [[obstacle]]
        name = 'ball'
        body = 'sphere:0.1'
        position = [0, 0, 2]
        moves = 'floating'

        [[clearance]]
        between = ['arm', 'ball/body']
        distance = 0.5";
    let cell = read(text).unwrap();
    let names: Vec<&str> = cell.robot().independent_joint_names().collect();
    let expected = [
        "hinge",
        "cart/base/x",
        "cart/base/y",
        "cart/base/yaw",
        "cart/lift",
        "ball/base/x",
        "ball/base/y",
        "ball/base/z",
        "ball/base/yaw",
        "ball/base/pitch",
        "ball/base/roll",
    ];
    assert_eq!(names, expected);
    let start = [0.0; 11];
    let with = |joint: usize, position: f64| {
        let mut end = start;
        end[joint] = position;
        [start, end]
    };
    let mut solver = cell.solver();
    assert!(solver.is_free(&with(1, -2.3)).unwrap());
    assert!(!solver.is_free(&with(1, -2.5)).unwrap());
    // The ball keeps 0.5 from the arm's ball at the origin.
    assert!(solver.is_free(&with(7, -1.29)).unwrap());
    assert!(!solver.is_free(&with(7, -1.31)).unwrap());
    let error = read(&format!("{text}\n[padding]\narm = 0.1")).unwrap_err();
    assert!(
        error.to_string().contains("obstacle ball moves"),
        "{error:#}"
    );
    let carried = "[[robot]]\nname = 'cart'\nurdf = 'cart.urdf'\nposition = [3, 0, 0]\non = ";
    let cell = read(&format!("{carried}'arm'")).unwrap();
    let lift = cell.robot().pose("cart/deck", &[0.3, 0.0]).unwrap();
    let arm = cell.robot().pose("arm", &[0.3, 0.0]).unwrap();
    let on_arm = arm.inverse().compose(&lift).translation();
    assert!(
        on_arm.distance(rigid_ccd::glam::DVec3::new(3.0, 0.0, 0.0)) < 1e-12,
        "{on_arm}"
    );
    assert!(read(&format!("{carried}'none'")).is_err());
    let error = read("[[robot]]\nname = 'cart'\nurdf = 'none.urdf'").unwrap_err();
    assert!(
        format!("{error:#}").starts_with("robot cart: "),
        "{error:#}"
    );
}
