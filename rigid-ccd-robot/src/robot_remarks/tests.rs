//! Tests that a warning reports a mostly unchecked robot, and that notes name the unchecked parts.

use super::*;
use crate::test_robots::{LINKS, row_of_links};
use rigid_ccd::{Body, Pose};

fn texts(pairs: &LinkPairs, robot: &Robot) -> Vec<String> {
    let remarks = pairs.remarks(robot).into_iter();
    remarks.map(|remark| remark.to_string()).collect()
}

fn warnings(pairs: &LinkPairs, robot: &Robot) -> Vec<String> {
    let remarks = pairs.remarks(robot).into_iter();
    let warnings = remarks.filter(CellRemark::is_warning);
    warnings.map(|remark| remark.to_string()).collect()
}

#[test]
fn notes_name_links_and_pairs_by_reason() {
    let robot = row_of_links(&LINKS, &["a", "b", "c", "d"]);
    let mut pairs = LinkPairs::from_robot(&robot);
    pairs.skip(1, 3, SkipReason::Disabled("Never".into()));
    assert_eq!(
        texts(&pairs, &robot),
        [
            "1 link without bodies, compared with nothing: base",
            "3 pairs of links not checked (adjacent): a and b, b and c, c and d",
            "1 pair of links not checked (disabled: Never): a and c",
        ]
    );
    assert!(warnings(&pairs, &robot).is_empty());
}

#[test]
fn a_robot_that_is_mostly_unchecked_is_warned_about() {
    let robot = row_of_links(&LINKS, &["d"]);
    let warned = warnings(&LinkPairs::from_robot(&robot), &robot);
    assert!(
        warned.len() == 1 && warned[0].contains("3 of 4 moving links have no bodies: a, b, c"),
        "{warned:?}"
    );

    // The masks of an MJCF exclude pairs that could be checked.
    let robot = row_of_links(&LINKS, &LINKS);
    let mut pairs = LinkPairs::from_robot(&robot);
    for [a, b] in pairs.all_pairs().collect::<Vec<_>>() {
        pairs.skip(a, b, SkipReason::Disabled("contype and conaffinity".into()));
    }
    let warned = warnings(&pairs, &robot);
    assert!(
        warned.len() == 1
            && warned[0].contains("4 of 4 moving links are checked against no other link"),
        "{warned:?}"
    );

    // A single hinge has no pair that could be checked.
    let robot = row_of_links(&["frame", "leaf"], &["frame", "leaf"]);
    assert!(warnings(&LinkPairs::from_robot(&robot), &robot).is_empty());
}

#[test]
fn links_in_another_unit_than_joints_are_warned_about() {
    let robot = row_of_links(&LINKS, &LINKS);
    let mut links = robot.links().to_vec();
    let hull = Body::cuboid([150.0, 60.0, 250.0]).unwrap();
    links[2].bodies.clear();
    links[2] = links[2].clone().with_body(hull, Pose::IDENTITY);
    let robot = Robot::new(links, robot.joints().to_vec()).unwrap();
    let warned = warnings(&LinkPairs::from_robot(&robot), &robot);
    assert!(
        warned.len() == 1 && warned[0].ends_with("b is 500 long, and the robot 4"),
        "{warned:?}"
    );
}
