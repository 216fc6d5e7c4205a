use super::*;
use crate::pairs::LinkPairs;
use crate::robot::{Joint, Link, PositionRule, Robot};
use crate::{Cell, CellSolver};
use rigid_ccd::{Body, Pose, Question, Settings, trajectory};

/// Returns a ball on a rail along x. It passes a post at x = 1 at a distance of 0.01.
fn cell() -> Cell {
    let rail = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let links = vec![
        Link::named("base"),
        Link::named("ball").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY),
    ];
    let joint = Joint {
        name: "rail".into(),
        parent: "base".into(),
        child: "ball".into(),
        geometry: rail,
        position_rule: PositionRule::Independent,
    };
    let robot = Robot::new(links, vec![joint]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let beside = Pose::at([1.0, 0.21, 0.0]).unwrap();
    cell.add_obstacle("post", Body::sphere(0.1).unwrap(), beside)
        .unwrap();
    cell
}

fn solver(cell: &Cell, margin: f64) -> CellSolver<'_> {
    cell.solver().with_settings(Settings {
        margin,
        ..Settings::DEFAULT
    })
}

const PATH: [[f64; 1]; 3] = [[0.0], [0.5], [2.0]];

/// Tests `free_until` of each question: nothing touches before it, and for a distance it is the start.
#[test]
fn each_question_says_until_where_the_path_is_free() {
    let cell = cell();
    for (margin, is_free) in [(0.0, true), (0.05, false)] {
        let mut solver = solver(&cell, margin);
        for question in CellSolver::QUESTIONS {
            let answer = solver.answer(question, &PATH).unwrap();
            let until = answer.free_until.time();
            match question {
                Question::ClosestApproach => {
                    assert!(answer.outcome.lower() > 0.0 && answer.outcome.upper() < 0.02);
                    assert_eq!((until, answer.is_free_until_contact()), (0.0, false));
                    assert!(matches!(answer.contact(), Err(PathError::NoContactAsked)));
                }
                _ if is_free => {
                    assert_eq!((until, answer.contact().unwrap()), (2.0, None));
                    assert!(answer.is_free_until_contact());
                }
                Question::FirstContact => {
                    let contact = answer.contact().unwrap().unwrap();
                    assert!(contact.at == answer.free_until && 1.0 < until && until < 4.0 / 3.0);
                    assert!(answer.is_free_until_contact());
                }
                _ => {
                    let contact = answer.contact().unwrap().unwrap();
                    assert!(contact.at.time() > 0.0 && until == 0.0);
                    assert!(!answer.is_free_until_contact());
                }
            }
        }
    }
}
