//! Tests that typical mistakes give a remark, and that usual cells give none.

use super::*;
use crate::pairs::LinkPairs;
use crate::robot::{CompoundKind, Joint, Link, PositionRule, Robot};
use crate::{PlacedRobot, test_robots};
use rigid_ccd::{Pose, trajectory};

/// An arm of two links of the given size, 0.4 apart.
fn arm(size: f64) -> Robot {
    two_links(size, hinge(0.4))
}

/// An arm whose unit of length differs by a factor.
fn scaled_arm(scale: f64) -> Robot {
    two_links(0.4 * scale, hinge(0.4 * scale))
}

fn hinge(height: f64) -> trajectory::Joint {
    let origin = Pose::at([0.0, 0.0, height]).unwrap();
    trajectory::Joint::revolute(origin, [0.0, 1.0, 0.0]).unwrap()
}

/// A slide of two links of the given size, with limits.
fn slide(size: f64, limits: [f64; 2]) -> Robot {
    let slide = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    two_links(size, slide.with_limits(limits[0]..=limits[1]))
}

fn two_links(size: f64, geometry: trajectory::Joint) -> Robot {
    let rod = || Body::cuboid([size / 2.0, 0.1 * size, 0.1 * size]).unwrap();
    let links = ["base", "arm"].map(|name| Link::named(name).with_body(rod(), Pose::IDENTITY));
    let joint = Joint {
        name: "joint".into(),
        parent: "base".into(),
        child: "arm".into(),
        geometry,
        position_rule: PositionRule::Independent,
    };
    Robot::new(links.to_vec(), vec![joint]).unwrap()
}

fn cell_of(robot: Robot) -> Cell {
    let pairs = LinkPairs::from_robot(&robot);
    Cell::new(robot, pairs)
}

fn cell(robot: Robot, half_sides: [f64; 3]) -> Cell {
    let (mut cell, obstacle) = (cell_of(robot), Body::cuboid(half_sides).unwrap());
    let at = Pose::at([0.0, 0.0, -5.0]).unwrap();
    let message = cell.remark_on_size("table", &obstacle);
    cell.add_obstacle("table", obstacle, at).unwrap();
    assert_eq!(
        message.is_some(),
        warnings(&cell).iter().any(|text| text.contains("table is"))
    );
    cell
}

fn warnings(cell: &Cell) -> Vec<String> {
    let remarks = cell.remarks().into_iter().filter(CellRemark::is_warning);
    remarks.map(|remark| remark.to_string()).collect()
}

#[test]
fn sizes_in_another_unit_are_remarked_upon() {
    let table = [600.0, 400.0, 10.0];
    for (robot, half_sides, expected) in [
        (arm(0.4), table, "table is 1200 long, and the robot 0."),
        (slide(0.4, [-1.0, 1.0]), table, "table is 1200"),
        (
            slide(0.4, [f64::NEG_INFINITY, f64::INFINITY]),
            table,
            "table is 1200",
        ),
        // A robot with meshes in millimetres and joints in metres.
        (arm(400.0), table, "arm is 400 long, and the robot 0.4"),
        (arm(400.0), [0.0001; 3], "table is 0.0002"),
    ] {
        let warned = warnings(&cell(robot, half_sides));
        assert!(
            warned.iter().any(|text| text.contains(expected)),
            "{expected}: {warned:?}"
        );
    }
}

/// Tests that usual cells have no warning at a usual tolerance.
#[test]
fn usual_cells_have_no_warnings() {
    let endless = [f64::NEG_INFINITY, f64::INFINITY];
    let point = || slide(0.02, [0.0, 10.0]);
    let placed = |robot: &Robot| {
        let (robot, pairs) = Robot::combine(&[PlacedRobot {
            name: "drone",
            robot,
            pairs: &LinkPairs::from_robot(robot),
            carrier: None,
            pose: Pose::IDENTITY,
            base_motion: Some(CompoundKind::Floating),
        }])
        .unwrap();
        assert!(pairs.file_remarks().is_empty());
        robot
    };
    for (kind, robot, half_sides) in [
        ("an arm at a table", arm(0.4), [0.6, 0.4, 0.01]),
        ("an arm and a screw", arm(0.4), [0.004, 0.002, 0.002]),
        ("an arm in a hall", arm(0.4), [20.0, 20.0, 4.0]),
        ("an arm on a floor of 200 m", arm(0.4), [100.0, 100.0, 0.1]),
        (
            "an arm in millimetres",
            scaled_arm(1000.0),
            [600.0, 400.0, 10.0],
        ),
        (
            "a slide before a wall",
            slide(0.4, endless),
            [0.1, 5.0, 5.0],
        ),
        (
            "a cart in a building",
            slide(0.3, endless),
            [60.0, 40.0, 10.0],
        ),
        ("a point in a maze", point(), [5.0, 0.1, 0.5]),
        ("a point in a large maze", point(), [50.0, 0.1, 0.5]),
        ("a drone in a hall", placed(&arm(0.2)), [50.0, 50.0, 10.0]),
        (
            "a gripper and a can",
            slide(0.05, [0.0, 0.04]),
            [0.03, 0.03, 0.06],
        ),
        (
            "a row of links",
            test_robots::row_of_links(&test_robots::LINKS, &test_robots::LINKS),
            [1.0; 3],
        ),
    ] {
        let cell = cell(robot, half_sides);
        let warned = warnings(&cell);
        assert!(warned.is_empty(), "{kind}: {warned:?}");
        assert_eq!(cell.remark_on_tolerance(1e-4), None, "{kind}");
    }
}

#[test]
fn a_tolerance_as_large_as_the_smallest_item_is_remarked_upon() {
    let mut cell = cell(arm(0.4), [3.0, 3.0, 0.1]);
    let text = |cell: &Cell, tolerance: f64| {
        let remark = cell.remark_on_tolerance(tolerance);
        remark.map(|remark| remark.to_string())
    };
    let large = text(&cell, 0.1).unwrap();
    assert!(large.starts_with("base: the tolerance is large"), "{large}");
    assert_eq!(text(&cell, 0.03), None);
    let pin = Body::sphere(0.05).unwrap();
    let far = Pose::at([9.0, 0.0, 0.0]).unwrap();
    cell.add_obstacle("pin", pin, far).unwrap();
    let large = text(&cell, 0.03).unwrap();
    assert!(large.starts_with("pin: the tolerance is large"), "{large}");
    cell.remove_obstacle("pin").unwrap();
    assert_eq!(text(&cell, 0.03), None);
}

#[test]
fn positions_in_degrees_are_remarked_upon() {
    let text = |robot: &Robot, position: f64| {
        let remark = robot.remark_on_configuration(&[position]);
        remark.map(|remark| remark.to_string())
    };
    let message = text(&arm(0.4), 90.0).unwrap();
    assert!(
        message.starts_with("joint joint: a joint's position is a round number"),
        "{message}"
    );
    for position in [0.0, 1.5, -6.3, 25.0, 91.3] {
        assert_eq!(text(&arm(0.4), position), None, "{position}");
    }
    assert_eq!(text(&slide(0.4, [0.0, 100.0]), 90.0), None);
}

#[test]
fn sizes_are_those_of_bodies() {
    let cell = cell(arm(0.4), [3.0, 3.0, 0.1]);
    let sizes: Vec<(&str, f64)> = cell
        .item_sizes()
        .map(|(item, size)| (item.name(), size))
        .collect();
    assert_eq!(sizes, [("base", 0.4), ("arm", 0.4), ("table", 6.0)]);
    assert_eq!(cell.sizes_text(), "robot 0.48, table 6");
}

#[test]
fn allowed_contacts_are_noted() {
    let mut cell = cell(arm(0.4), [3.0, 3.0, 0.1]);
    let ball = Body::sphere(0.1).unwrap();
    cell.attach("can", ball, ("arm", Pose::IDENTITY), &["table"])
        .unwrap();
    let last = cell.remarks().pop().unwrap();
    assert_eq!(last.to_string(), "1 contact allowed: can and table");
    assert!(!last.is_warning());
}

#[test]
fn links_that_never_move_are_named_beside_obstacles() {
    let resting = |cell: &Cell| {
        let texts = cell.remarks().into_iter().map(|remark| remark.to_string());
        texts
            .filter(|text| text.contains("no joint moves it"))
            .collect::<Vec<_>>()
    };
    assert_eq!(resting(&cell_of(arm(0.4))), [""; 0]);
    let mut cell = cell(arm(0.4), [0.2; 3]);
    let text = "not compared with obstacles, since no joint moves it: base";
    assert_eq!(resting(&cell), [text]);
    let ground = Link::named("ground").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let ground = Link {
        planes: vec![Pose::IDENTITY],
        ..ground
    };
    let bench = Link::named("bench").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let bench_joint = Joint {
        name: "legs".into(),
        parent: "ground".into(),
        child: "bench".into(),
        geometry: trajectory::Joint::fixed(Pose::at([0.0, 0.0, 1.0]).unwrap()),
        position_rule: PositionRule::Independent,
    };
    let on_ground = Robot::new(vec![ground, bench], vec![bench_joint]).unwrap();
    let mut workshop = cell_of(on_ground);
    let crate_at = Pose::at([0.0, 0.0, 5.0]).unwrap();
    let crate_body = Body::cuboid([0.1; 3]).unwrap();
    workshop
        .add_obstacle("crate", crate_body, crate_at)
        .unwrap();
    let of_workshop = "not compared with obstacles, since no joint moves it: ground, bench";
    assert_eq!(resting(&workshop), [of_workshop]);
    let at_base = ("base", Pose::at([1.0, 0.0, 0.0]).unwrap());
    cell.attach("pedestal", Body::cuboid([0.1; 3]).unwrap(), at_base, &[])
        .unwrap();
    assert_eq!(resting(&cell), [format!("{text}, pedestal")]);
}
