//! Tests that typical mistakes give a remark, and that usual cells give none.

use super::*;
use crate::pairs::LinkPairs;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::{Body, trajectory};

/// An arm of two links of a given size, 0.4 apart.
fn arm(size: f64) -> Robot {
    let rod = || Body::cuboid([size / 2.0, 0.1 * size, 0.1 * size]).unwrap();
    let links = vec![
        Link::named("base").with_body(rod(), Pose::IDENTITY),
        Link::named("arm").with_body(rod(), Pose::IDENTITY),
    ];
    let origin = Pose::at([0.0, 0.0, 0.4]).unwrap();
    let hinge = Joint {
        name: "hinge".into(),
        parent: "base".into(),
        child: "arm".into(),
        axis_and_limits: trajectory::Joint::revolute(origin, [0.0, 1.0, 0.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    Robot::new(links, vec![hinge]).unwrap()
}

fn cell(robot: Robot, obstacle: Body) -> Cell {
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let at = Pose::at([0.0, 0.0, -5.0]).unwrap();
    cell.add_obstacle("table", obstacle, at).unwrap();
    cell
}

fn texts(cell: &Cell, tolerance: f64) -> Vec<String> {
    cell.remarks(tolerance)
        .iter()
        .map(CellRemark::to_string)
        .collect()
}

#[test]
fn sizes_in_another_unit_are_remarked_upon() {
    let table = || Body::cuboid([600.0, 400.0, 10.0]).unwrap();
    let texts_of_table = texts(&cell(arm(0.4), table()), 1e-4);
    assert_eq!(texts_of_table.len(), 1, "{texts_of_table:?}");
    assert!(
        texts_of_table[0].contains("table is 1200"),
        "{texts_of_table:?}"
    );
    // A robot whose meshes are in millimetres, while its joints are in metres.
    let remarks = texts(&cell(arm(400.0), table()), 1e-4);
    assert!(
        remarks.iter().any(|text| text.contains("arm is 400")),
        "{remarks:?}"
    );
    let crumb = texts(&cell(arm(400.0), Body::sphere(0.1).unwrap()), 1e-4);
    assert!(
        crumb.iter().any(|text| text.contains("table is 0.2")),
        "{crumb:?}"
    );
}

#[test]
fn usual_cells_have_no_remarks() {
    for obstacle in [
        Body::cuboid([20.0, 20.0, 0.1]).unwrap(),
        Body::sphere(0.004).unwrap(),
        Body::cuboid([0.6, 0.4, 0.01]).unwrap(),
    ] {
        let remarks = texts(&cell(arm(0.4), obstacle), 1e-4);
        assert!(remarks.is_empty(), "{remarks:?}");
    }
}

#[test]
fn a_tolerance_as_large_as_a_link_is_remarked_upon() {
    let cell = cell(arm(0.4), Body::cuboid([3.0, 3.0, 0.1]).unwrap());
    let remarks = texts(&cell, 0.1);
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    assert!(
        remarks[0].starts_with("base: the tolerance is large"),
        "{remarks:?}"
    );
}

#[test]
fn sizes_are_those_of_bodies() {
    let cell = cell(arm(0.4), Body::cuboid([3.0, 3.0, 0.1]).unwrap());
    let sizes: Vec<(&str, f64)> = cell
        .item_sizes()
        .iter()
        .map(|(item, size)| (item.name(), *size))
        .collect();
    assert_eq!(sizes, [("base", 0.4), ("arm", 0.4), ("table", 6.0)]);
    let size = cell.robot_size().unwrap();
    assert!((0.5..1.0).contains(&size), "{size}");
}
