use super::*;
use crate::results::names;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::{Body, Pose, Settings, trajectory};
use rigid_ccd_robot::{Cell, Joint, Link, LinkPairs, PositionRule, Robot};
use std::time::Duration;

fn without_clearance(question: Question) -> PathQuestion {
    PathQuestion {
        question,
        clearance: None,
    }
}

/// Returns a cell of an arm of two rods among some balls. Both joints turn about z.
fn random_cell(random: &mut Pcg64) -> Cell {
    let rod = || Body::cuboid([0.4, 0.1, 0.1]).unwrap();
    let middle = Pose::at([0.5, 0.0, 0.0]).unwrap();
    let mut links = vec![Link::named("base")];
    let mut joints = Vec::new();
    for (parent, child, at) in [("base", "upper", 0.0), ("upper", "fore", 1.0)] {
        links.push(Link::named(child).with_body(rod(), middle));
        let place = Pose::at([at, 0.0, 0.0]).unwrap();
        joints.push(Joint {
            name: child.into(),
            parent: parent.into(),
            child: child.into(),
            geometry: trajectory::Joint::revolute(place, [0.0, 0.0, 1.0]).unwrap(),
            position_rule: PositionRule::Independent,
        });
    }
    let robot = Robot::new(links, joints).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    for number in 0..random.random_range(1..4) {
        let ball = Body::sphere(random.random_range(0.1..0.3)).unwrap();
        let place = [0; 3].map(|_| random.random_range(-2.0..2.0));
        let pose = Pose::at([place[0], place[1], 0.2 * place[2]]).unwrap();
        cell.add_obstacle(format!("ball{number}"), ball, pose)
            .unwrap();
    }
    cell
}

fn random_configuration(random: &mut Pcg64) -> Vec<f64> {
    vec![
        random.random_range(-3.0..3.0),
        random.random_range(-1.5..1.5),
    ]
}

#[test]
fn rows_are_the_answers_of_the_solver() {
    let mut random = Pcg64::seed_from_u64(1);
    let mut statuses = [0; 2];
    for _ in 0..60 {
        let cell = random_cell(&mut random);
        let path = [(); 3].map(|()| random_configuration(&mut random));
        let mut solver = cell.solver();
        let is_free = without_clearance(Question::AnyContact)
            .answer(&mut solver, &path)
            .row;
        let first = without_clearance(Question::FirstContact)
            .answer(&mut solver, &path)
            .row;
        assert_eq!(is_free.status == Status::Free, first.status == Status::Free);
        match solver.first_contact(&path).unwrap().outcome {
            PathOutcome::Contact(contact) => {
                assert!(matches!(
                    first.status,
                    Status::Contact | Status::Overlapping
                ));
                assert_eq!(
                    first.status == Status::Overlapping,
                    contact.distance_bounds == [0.0; 2] && contact.at.time() == 0.0
                );
                assert_eq!(first.distance_upper, Some(contact.distance_bounds[1]));
                assert_eq!(first.time, Some(contact.at.time()));
                assert_eq!(first.item_a.as_deref(), Some(contact.items[0].name()));
                assert_eq!(first.item_b.as_deref(), Some(contact.items[1].name()));
            }
            PathOutcome::Free => assert_eq!((first.status, first.time), (Status::Free, Some(2.0))),
            _ => panic!("no limit is set"),
        }
        statuses[usize::from(first.status == Status::Free)] += 1;

        let nearest = without_clearance(Question::ClosestApproach)
            .answer(&mut solver, &path)
            .row;
        assert_eq!(nearest.status, Status::Measured);
        let (lower, upper) = (nearest.distance_lower.unwrap(), nearest.distance_upper);
        let mut status = |clearance| {
            let question = PathQuestion {
                question: Question::ClosestApproach,
                clearance: Some(clearance),
            };
            question.answer(&mut solver, &path).row.status
        };
        // What may touch keeps no clearance.
        assert_eq!(status(lower) == Status::Kept, lower > 0.0);
        if let Some(upper) = upper {
            assert_eq!(status(upper + 0.1), Status::Violated);
        }
    }
    assert!(statuses.iter().all(|&count| count > 5), "{statuses:?}");
}

#[test]
fn limits_and_errors_are_rows() {
    let cell = random_cell(&mut Pcg64::seed_from_u64(2));
    let path = [random_configuration(&mut Pcg64::seed_from_u64(3))];
    let settings = Settings {
        deadline: Some(Duration::ZERO),
        ..Settings::DEFAULT
    };
    let mut solver = cell.solver().with_settings(settings);
    for question in CellSolver::QUESTIONS {
        let asked = without_clearance(question);
        let row = asked.answer(&mut solver, &path).row;
        assert_eq!(row.status, Status::Unresolved, "{question}");
        assert_eq!(row.reason.as_deref(), Some("deadline"));
        let empty: [Vec<f64>; 0] = [];
        let row = asked.answer(&mut solver, &empty).row;
        assert_eq!(row.status, Status::Error);
        assert!(
            row.reason
                .is_some_and(|reason| reason.contains("no configuration"))
        );
    }
}

#[test]
fn columns_are_those_of_the_question() {
    let columns = |question| names(&columns(question)).join(",");
    assert_eq!(columns(Question::AnyContact), "id,status,micros,reason");
    let first = "id,status,time,a,b,distance_lower,distance_upper,witness_a_x,witness_a_y,witness_a_z,witness_b_x,witness_b_y,witness_b_z,feature_a,feature_b,micros,reason";
    assert_eq!(columns(Question::FirstContact), first);
    assert_eq!(columns(Question::ClosestApproach), first);
}

/// Tests that a question that is none about paths is an error in each row, not another question's answer.
#[test]
fn other_questions_are_refused() {
    let mut random = Pcg64::seed_from_u64(4);
    let cell = random_cell(&mut random);
    let path = [random_configuration(&mut random)];
    for question in Question::ALL {
        let row = without_clearance(question)
            .answer(&mut cell.solver(), &path)
            .row;
        let is_known = CellSolver::QUESTIONS.contains(&question);
        assert_eq!(row.status != Status::Error, is_known, "{question}");
        assert_eq!(row.reason.is_none(), is_known, "{question}");
    }
}
