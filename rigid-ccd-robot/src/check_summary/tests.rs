//! Tests of what is counted, and of the remarks about it.

use super::*;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::{Body, Pose, trajectory};

/// Returns an arm of links in a row, 1 apart, of which those that are named have a body.
fn arm(links: &[&str], with_bodies: &[&str]) -> Robot {
    let link = |name: &&str| {
        if with_bodies.contains(name) {
            Link::named(*name).with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY)
        } else {
            Link::named(*name)
        }
    };
    let joints = links.windows(2).map(|pair| Joint {
        name: format!("to {}", pair[1]),
        parent: pair[0].into(),
        child: pair[1].into(),
        axis_and_limits: trajectory::Joint::revolute(
            Pose::at([1.0, 0.0, 0.0]).unwrap(),
            [0.0, 0.0, 1.0],
        )
        .unwrap(),
        position_rule: PositionRule::Independent,
    });
    let joints = joints.collect();
    Robot::new(links.iter().map(link).collect(), joints).unwrap()
}

const LINKS: [&str; 5] = ["base", "a", "b", "c", "d"];

#[test]
fn counts_and_groups_are_of_all_links_and_pairs() {
    let robot = arm(&LINKS, &["a", "b", "c", "d"]);
    let mut pairs = LinkPairs::from_robot(&robot);
    pairs.skip(1, 3, SkipReason::Disabled("Never".into()));
    let summary = pairs.check_summary(&robot);
    assert_eq!(
        summary.to_string(),
        "5 links, 1 without bodies; 4 bodies; 2 pairs of links checked, 3 not (adjacent), 1 not (disabled: Never)"
    );
    let remarks: Vec<String> = summary.remarks().iter().map(ToString::to_string).collect();
    assert_eq!(
        remarks,
        [
            "1 link without bodies, compared with nothing: base",
            "3 pairs of links not checked (adjacent): a and b, b and c, c and d",
            "1 pair of links not checked (disabled: Never): a and c",
        ]
    );
    assert!(summary.warnings().is_empty());
}

#[test]
fn a_robot_that_is_mostly_unchecked_is_warned_about() {
    let robot = arm(&LINKS, &["d"]);
    let warnings = LinkPairs::from_robot(&robot)
        .check_summary(&robot)
        .warnings();
    let text = warnings[0].to_string();
    assert!(
        text.contains("3 of 4 moving links have no bodies: a, b, c"),
        "{text}"
    );
    assert_eq!(warnings.len(), 1);

    // Masks of an MJCF leave out what could be checked.
    let robot = arm(&LINKS, &LINKS);
    let mut pairs = LinkPairs::from_robot(&robot);
    for [a, b] in pairs.all_pairs().collect::<Vec<_>>() {
        pairs.skip(a, b, SkipReason::Disabled("contype and conaffinity".into()));
    }
    let warnings = pairs.check_summary(&robot).warnings();
    let text = warnings[0].to_string();
    assert!(
        text.contains("4 of 4 moving links are checked against no other link"),
        "{text}"
    );
    assert!(warnings[0].is_warning() && warnings.len() == 1);

    // A hinge has no pair that could be checked.
    let robot = arm(&["frame", "leaf"], &["frame", "leaf"]);
    let summary = LinkPairs::from_robot(&robot).check_summary(&robot);
    assert!(summary.warnings().is_empty());
}

#[test]
fn the_summary_of_a_cell_counts_what_is_around() {
    let robot = arm(&LINKS, &["a", "b", "c", "d"]);
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let ball = || Body::sphere(0.1).unwrap();
    cell.add_obstacle("post", ball(), Pose::at([0.0, 3.0, 0.0]).unwrap())
        .unwrap();
    cell.attach("can", ball(), ("d", Pose::IDENTITY), &["post"])
        .unwrap();
    let summary = cell.check_summary();
    let text = summary.to_string();
    assert!(
        text.ends_with("; 1 obstacle, 1 attached, 1 contact allowed"),
        "{text}"
    );
    let last = summary.remarks().pop().unwrap().to_string();
    assert_eq!(last, "1 contact allowed: can and post");
}
