//! Tests that records read back exactly, that replays refute false records, and that another cell is refused.

use super::{Evidence, EvidenceError, RecordedAnswer, RecordedPath, Verdict};
use crate::cell::Cell;
use crate::joint_curve::JointCurve;
use crate::pairs::LinkPairs;
use crate::path::Path;
use crate::path_point::PathPoint;
use crate::robot::{Joint, Link, PositionRule, Robot};
use rigid_ccd::{Body, Pose, Settings, trajectory};
use std::time::Duration;

/// Returns an arm of two links in the plane z = 0, beside a ball that it reaches by turning its shoulder.
fn cell() -> Cell {
    let link_body = || Body::cuboid([0.35, 0.05, 0.05]).unwrap();
    let links = ["upper", "lower"]
        .map(|name| Link::named(name).with_body(link_body(), Pose::at([0.5, 0.0, 0.0]).unwrap()));
    let joints = [("base", "upper", 0.0), ("upper", "lower", 1.0)].map(|(parent, child, x)| {
        let origin = Pose::at([x, 0.0, 0.0]).unwrap();
        Joint {
            name: format!("to {child}"),
            parent: parent.into(),
            child: child.into(),
            geometry: trajectory::Joint::revolute(origin, [0.0, 0.0, 1.0]).unwrap(),
            position_rule: PositionRule::Independent,
        }
    });
    let links = [vec![Link::named("base")], links.into()].concat();
    let robot = Robot::new(links, joints.into()).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let ball = Body::sphere(0.2).unwrap();
    cell.add_obstacle("ball", ball, Pose::at([1.2, 0.5, 0.0]).unwrap())
        .unwrap();
    cell
}

fn path() -> Vec<[f64; 2]> {
    vec![[-0.5, 0.1], [-0.2, 0.0], [0.9, 0.3]]
}

fn record(cell: &Cell, settings: &Settings, path: RecordedPath, asked: &dyn Path) -> Evidence {
    let mut solver = cell.solver().with_settings(settings.clone());
    let answer = RecordedAnswer::try_from(&solver.first_contact(asked).unwrap()).unwrap();
    let record = Evidence::new(cell, settings, path, answer).unwrap();
    let read = Evidence::from_json(&record.to_json().unwrap()).unwrap();
    assert_eq!(read, record);
    read
}

fn contact_record(cell: &Cell) -> Evidence {
    let path = path();
    let record = record(
        cell,
        &Settings::DEFAULT,
        RecordedPath::configurations(&path),
        &path,
    );
    assert!(matches!(record.answer, RecordedAnswer::Contact { .. }));
    record
}

#[test]
fn the_same_question_has_the_same_answer() {
    let cell = cell();
    let found = contact_record(&cell).replay(&cell).unwrap();
    assert_eq!(found.verdict, Verdict::SameAnswer);

    let curve = JointCurve::cubic_hermite(
        &[0.0, 0.7, 2.0],
        &path(),
        &[[0.0, 0.0], [0.1, 0.3], [0.0, 0.0]],
    )
    .unwrap();
    let record = record(
        &cell,
        &Settings::DEFAULT,
        RecordedPath::Curve(curve.clone()),
        &curve,
    );
    assert_eq!(record.replay(&cell).unwrap().verdict, Verdict::SameAnswer);
}

#[test]
fn what_a_deadline_left_free_holds() {
    let (cell, path) = (cell(), path());
    let settings = Settings {
        deadline: Some(Duration::ZERO),
        ..Settings::DEFAULT
    };
    let record = record(&cell, &settings, RecordedPath::configurations(&path), &path);
    assert!(matches!(record.answer, RecordedAnswer::Unresolved { .. }));
    let found = record.replay(&cell).unwrap();
    assert_eq!(found.verdict, Verdict::Holds);
    assert!(matches!(found.answer, RecordedAnswer::Contact { .. }));
}

#[test]
fn a_record_that_says_free_for_longer_is_refuted() {
    let cell = cell();
    let true_record = contact_record(&cell);
    let end = RecordedAnswer::Unresolved {
        limit: "deadline".to_owned(),
        segment: 1,
        fraction: 0.999,
    };
    for answer in [RecordedAnswer::Free, end] {
        let forged = Evidence {
            answer,
            ..true_record.clone()
        };
        let verdict = forged.replay(&cell).unwrap().verdict;
        assert!(matches!(verdict, Verdict::Refuted { at } if at.segment == 1));
    }
    let not_a_number = RecordedAnswer::Unresolved {
        limit: "deadline".to_owned(),
        segment: 1,
        fraction: f64::NAN,
    };
    let forged = Evidence {
        answer: not_a_number,
        ..true_record
    };
    let verdict = forged.replay(&cell).unwrap().verdict;
    assert!(matches!(verdict, Verdict::Refuted { .. }));
}

#[test]
fn another_cell_is_refused_with_what_differs() {
    let cell = cell();
    let record = contact_record(&cell);
    let refused = |change: fn(&mut Cell)| {
        let mut other = cell.clone();
        change(&mut other);
        record.replay(&other).unwrap_err()
    };
    let at = |x| Pose::at([x, 0.5, 0.0]).unwrap();
    let moved = |cell: &mut Cell| cell.move_obstacle("ball", Pose::at([1.3, 0.5, 0.0]).unwrap());
    let error =
        refused(|cell| drop(cell.move_obstacle("ball", Pose::at([1.3, 0.5, 0.0]).unwrap())));
    assert!(error.to_string().contains("`ball` is elsewhere"), "{error}");
    let mut other = cell.clone();
    moved(&mut other).unwrap();
    other.remove_obstacle("ball").unwrap();
    let error = record.replay(&other).unwrap_err();
    assert!(error.to_string().contains("bodies"), "{error}");
    other
        .add_obstacle("ball", Body::sphere(0.25).unwrap(), at(1.2))
        .unwrap();
    let error = record.replay(&other).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("`ball` is not the recorded body"),
        "{error}"
    );
    let error = refused(|cell| cell.set_padding("upper", 0.1).unwrap());
    assert!(matches!(error, EvidenceError::OtherPairs), "{error}");
}

#[test]
fn what_is_no_record_is_refused() {
    let json = contact_record(&cell()).to_json().unwrap();
    let other = json.replace("evidence 2", "evidence 1");
    let error = Evidence::from_json(&other).unwrap_err();
    assert!(error.to_string().contains("evidence 2"), "{error}");
    assert!(Evidence::from_json("{}").is_err());
    let curve = r#"{"times":[0,1],"joint_count":1,"degree":1,"coefficients":[0,1]}"#;
    assert!(serde_json::from_str::<JointCurve>(curve).is_ok());
    for (from, to) in [
        (r#""degree":1"#, r#""degree":0"#),
        (r#""degree":1"#, r#""degree":10"#),
        ("[0,1],\"j", "[1,0],\"j"),
        ("[0,1]}", "[0,1,2]}"),
        (
            r#""joint_count":1"#,
            r#""joint_count":18446744073709551615"#,
        ),
    ] {
        let wrong = curve.replace(from, to);
        assert_ne!(wrong, curve);
        assert!(
            serde_json::from_str::<JointCurve>(&wrong).is_err(),
            "{wrong}"
        );
    }
}

/// Tests that an answer to another question is not recorded as one about the first contact.
#[test]
fn only_first_contacts_are_recorded() {
    let (cell, path) = (cell(), path());
    let mut solver = cell.solver();
    let closest = solver.closest_approach(&path).unwrap();
    let any = solver.any_contact(&path).unwrap();
    assert!(
        any.contact()
            .unwrap()
            .is_some_and(|contact| contact.at.time() > 0.0)
    );
    for answer in [closest, any] {
        let recorded = RecordedAnswer::try_from(&answer);
        assert!(matches!(recorded, Err(EvidenceError::NoFirstContact)));
    }
    // An unresolved distance says nothing about contacts.
    let mut spent = cell.solver().with_settings(Settings {
        deadline: Some(Duration::ZERO),
        ..Settings::DEFAULT
    });
    let unresolved = spent.closest_approach(&path).unwrap();
    assert!(unresolved.outcome.limit().is_some());
    let recorded = RecordedAnswer::try_from(&unresolved).unwrap();
    assert_eq!(recorded.free_until(), Some(PathPoint::START));
}
