//! Tests the counts of a summary.

use super::*;
use crate::skip_reason::SkipReason;
use crate::test_robots::{LINKS, row_of_links};
use rigid_ccd::{Body, Pose};

#[test]
fn counts_are_of_all_links_and_pairs() {
    let robot = row_of_links(&LINKS, &["a", "b", "c", "d"]);
    let mut pairs = LinkPairs::from_robot(&robot);
    pairs.skip(1, 3, SkipReason::Disabled("Never".into()));
    assert_eq!(
        pairs.check_summary(&robot).to_string(),
        "5 links, 1 without bodies; 4 bodies; 2 pairs of links checked, 3 not (adjacent), 1 not (disabled: Never)"
    );
}

#[test]
fn the_summary_of_a_cell_counts_what_is_around() {
    let robot = row_of_links(&LINKS, &["a", "b", "c", "d"]);
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let ball = || Body::sphere(0.1).unwrap();
    cell.add_obstacle("post", ball(), Pose::at([0.0, 3.0, 0.0]).unwrap())
        .unwrap();
    cell.attach("can", ball(), ("d", Pose::IDENTITY), &["post"])
        .unwrap();
    let text = cell.check_summary().to_string();
    assert!(
        text.ends_with("; 1 obstacle, 1 attached, 1 contact allowed"),
        "{text}"
    );
}
