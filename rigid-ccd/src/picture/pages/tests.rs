use super::*;
use crate::picture::Claim;
use ccd_core::Body;

#[test]
fn names_are_plain_and_differ() {
    let ball = Body::sphere(1.0).unwrap();
    let asked = Asked {
        claim: Claim::First,
        margin: 0.0,
        clearance: None,
    };
    let bodies = Bodies { a: &ball, b: &ball };
    let folder = std::env::temp_dir();
    let mut pages = Pages::create(bodies, asked, String::new(), &folder).unwrap();
    let mut names = |id: &str| pages.name(id);
    assert_eq!(names("edge 12"), "edge_12.html");
    assert_eq!(names("edge_12"), "edge_12-1.html");
    assert_eq!(names("EDGE/12"), "EDGE_12-2.html");
    assert_eq!(names("../../etc"), "_.._etc.html");
    assert_eq!(names(""), "row.html");
    assert_eq!(names(""), "-1.html");
    assert!(names(&"a".repeat(1000)).len() < 255);
}
