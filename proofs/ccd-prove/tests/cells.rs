//! Proofs of paths of a small robot: each that is written holds, also at the limits.

use ccd_prove::{NotProven, PathNotProven, Proof, ProvenCell, StatedLink, Statement};
use rigid_ccd::{Body, Pose, Settings, StartPolicy, trajectory};
use rigid_ccd_robot::{Cell, Joint, Link, LinkPairs, PositionRule, Robot};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A car that slides along x towards an obstacle, and beside it a wheel that turns, with a body if one is given.
fn cell(car: Body, obstacle: (Body, f64), wheel: Option<Body>) -> Cell {
    let joint = |parent: &str, child: &str, geometry| Joint {
        name: child.into(),
        parent: parent.into(),
        child: child.into(),
        geometry,
        position_rule: PositionRule::Independent,
    };
    let x = [1.0, 0.0, 0.0];
    let slide = trajectory::Joint::prismatic(Pose::IDENTITY, x).unwrap();
    let axle = trajectory::Joint::revolute(Pose::at([0.0, 9.0, 0.0]).unwrap(), x).unwrap();
    let mut links = vec![
        Link::named("base"),
        Link::named("car").with_body(car, Pose::IDENTITY),
        Link::named("wheel"),
    ];
    if let Some(body) = wheel {
        links[2] = Link::named("wheel").with_body(body, Pose::IDENTITY);
    }
    let joints = vec![joint("base", "car", slide), joint("base", "wheel", axle)];
    let robot = Robot::new(links, joints).unwrap();
    let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
    let (body, at) = obstacle;
    let pose = Pose::at([at, 0.0, 0.0]).unwrap();
    cell.add_obstacle("obstacle", body, pose).unwrap();
    cell
}

fn block(half: f64) -> Body {
    Body::cuboid([half; 3]).unwrap()
}

/// Asks when the cell first touches on a path, and proves the answer; all proofs have to hold.
fn prove_and_check(cell: &Cell, path: &[[f64; 2]]) -> Result<Vec<Proof>, PathNotProven> {
    prove_with(cell, path, &Settings::DEFAULT)
}

fn prove_with(
    cell: &Cell,
    path: &[[f64; 2]],
    settings: &Settings,
) -> Result<Vec<Proof>, PathNotProven> {
    let mut solver = cell.solver().with_settings(settings.clone());
    let answer = solver.first_contact(path).unwrap();
    let proven = ProvenCell::new(cell).unwrap();
    let proofs = proven.prove_path(path, &answer, settings)?;
    for proof in &proofs {
        let read = |body: &ccd_prove::Body| {
            ccd_check::Body::new(body.mesh(), body.certificate(), &proof.bytes).unwrap()
        };
        let meshes: Vec<_> = proven.meshes().map(read).collect();
        assert_eq!(ccd_check::check(&meshes, &proof.bytes), Ok(()));
    }
    Ok(proofs)
}

/// Their surfaces are apart, so there is nothing to prove.
#[test]
fn a_body_in_another_at_the_start_has_no_proof() {
    let ball = || Body::sphere(0.1).unwrap();
    for (car, obstacle) in [(ball(), block(2.0)), (block(1.0), block(0.1))] {
        let cell = cell(car, (obstacle, 0.0), None);
        let path = [[0.0, 0.0], [0.5, 0.0]];
        assert_eq!(prove_and_check(&cell, &path).unwrap().len(), 0);
    }
}

/// The answer is found before the flag is set.
#[test]
fn a_proof_ends_when_it_is_stopped() {
    let cell = cell(block(0.1), (block(0.1), 2.0), None);
    let path = [[0.0, 0.0], [0.5, 0.0]];
    let answer = cell.solver().first_contact(&path).unwrap();
    let proven = ProvenCell::new(&cell).unwrap();
    let prove = |is_stopped: bool| {
        let settings = Settings {
            stop: Some(Arc::new(AtomicBool::new(is_stopped))),
            ..Settings::DEFAULT
        };
        proven.prove_path(&path, &answer, &settings)
    };
    assert_eq!(prove(false).unwrap().len(), 1);
    let (segment, reason) = (0, NotProven::Stopped { at: 0.0 });
    let stopped = PathNotProven::Segment { segment, reason };
    assert_eq!(prove(true).unwrap_err(), stopped);
}

/// Only the answer about the first contact says until where the path is free.
#[test]
fn answers_to_other_questions_are_not_proven() {
    let cell = cell(block(0.1), (block(0.1), 2.0), None);
    let path = [[0.0, 0.0], [4.0, 0.0]];
    let proven = ProvenCell::new(&cell).unwrap();
    let mut solver = cell.solver();
    let any = solver.any_contact(&path).unwrap();
    let closest = solver.closest_approach(&path).unwrap();
    for answer in [any, closest] {
        let refused = proven.prove_path(&path, &answer, &Settings::DEFAULT);
        assert_eq!(refused.unwrap_err(), PathNotProven::NoFirstContact);
    }
}

/// A pair that is let go with a gap has a proof; one that touches has none, and that is said.
#[test]
fn a_pair_that_is_let_go_is_proven_if_it_has_a_gap() {
    let path = [[0.0, 0.0], [-0.5, 0.0]];
    let leave = || Settings {
        start_policy: StartPolicy::Leave,
        ..Settings::DEFAULT
    };
    for (gap, proof_count) in [(4e-4, Some(1)), (0.0, None)] {
        let cell = cell(block(1.0), (block(1.0), 2.0 + gap), None);
        let mut solver = cell.solver().with_settings(leave());
        assert!(solver.is_free(&path).unwrap());
        let proofs = prove_with(&cell, &path, &leave());
        assert_eq!(proofs.map(|proofs| proofs.len()).ok(), proof_count);
    }
}

/// The gap is the tolerance but for rounding: at a start, or where one segment ends and the next one begins.
#[test]
fn a_contact_at_the_tolerance_is_proven() {
    let at = 2.0 + Settings::DEFAULT.tolerance;
    let cell = cell(block(1.0), (block(1.0), at), None);
    let path = [[0.0, 0.0], [0.5, 0.0]];
    assert_eq!(prove_and_check(&cell, &path).unwrap().len(), 1);
    let path = [[-3.0, 0.0], [0.0, 0.0], [0.5, 0.0]];
    assert_eq!(prove_and_check(&cell, &path).unwrap().len(), 2);
}

/// A wheel that moves no body is in no statement, one that does turns too far.
#[test]
fn turns_beyond_the_range_of_the_checker_are_refused() {
    for (from, to) in [(300.0, 300.5), (0.0, 129.0)] {
        let path = [[0.0, from], [0.5, to]];
        let unused = cell(block(1.0), (block(1.0), 9.0), None);
        assert_eq!(prove_and_check(&unused, &path).unwrap().len(), 1);
        let used = cell(block(1.0), (block(1.0), 9.0), Some(block(0.5)));
        let refused = prove_and_check(&used, &path).map(|proofs| proofs.len());
        let reason = NotProven::TurnsTooFar { link: 2 };
        assert_eq!(refused, Err(PathNotProven::Segment { segment: 0, reason }));
    }
    let used = cell(block(1.0), (block(1.0), 9.0), Some(block(0.5)));
    let path = [[0.0, 255.0], [0.5, 129.0]];
    assert_eq!(prove_and_check(&used, &path).unwrap().len(), 1);
}

/// Positions of joints are stated as they are asked for, whatever power of two a sliding one has given to its line.
#[test]
fn positions_of_joints_are_read_from_statements() {
    let cell = cell(block(0.5), (block(0.5), 900.0), Some(block(1.0)));
    let proven = ProvenCell::new(&cell).unwrap();
    let paths = [
        [[0.0, 0.0], [0.0, 0.0]],
        [[0.1, 0.2], [0.3, -0.4]],
        [[600.7, -100.0], [-0.3, 20.0]],
    ];
    for path in paths {
        let [proof] = &prove_and_check(&cell, &path).unwrap()[..] else {
            panic!("one proof for a segment");
        };
        let statement = Statement::read(&proof.bytes).unwrap();
        let joints = proven.joints_of(&statement, 0.0).unwrap();
        let [from, to] = [0, 1].map(|k| [joints[0].1[k], joints[1].1[k]]);
        assert_eq!([joints[0].0, joints[1].0], ["car", "wheel"]);
        let ends = [
            path[0],
            [0, 1].map(|k| path[0][k] + (path[1][k] - path[0][k])),
        ];
        assert_eq!([from, to], ends);
        // Other margins, other obstacles.
        assert_eq!(proven.joints_of(&statement, 0.1), None);
        let other = self::cell(block(0.5), (block(0.4), 900.0), Some(block(1.0)));
        let other = ProvenCell::new(&other).unwrap();
        assert_eq!(other.joints_of(&statement, 0.0), None);
    }
}

/// Joints that are not those of the statement, in what it leaves to a power of two.
#[test]
fn statements_about_other_joints_are_seen() {
    let cell = cell(block(0.5), (block(0.5), 900.0), Some(block(1.0)));
    let proven = ProvenCell::new(&cell).unwrap();
    let proof = &prove_and_check(&cell, &[[0.1, 0.2], [0.3, -0.4]]).unwrap()[0];
    let statement = Statement::read(&proof.bytes).unwrap();
    assert!(proven.joints_of(&statement, 0.0).is_some());
    let changes: [fn(&mut StatedLink); 8] = [
        |link| link.velocity[0] *= 3.0,
        |link| link.velocity[0] *= -1.0,
        |link| link.velocity[1] = 1.0,
        |link| link.velocity = [0.0; 3],
        |link| link.velocity[0] = f64::NAN,
        |link| link.axis[0] += 0.5,
        |link| link.axes = 0,
        |link| link.position[2] = 1.0,
    ];
    for (number, change) in changes.into_iter().enumerate() {
        for link in 0..2 {
            let mut other = statement.clone();
            change(&mut other.links[link]);
            let is_same = other == statement;
            assert_eq!(proven.joints_of(&other, 0.0).is_some(), is_same, "{number}");
        }
    }
    // A power of two is taken from positions and given to the line.
    let mut same = statement.clone();
    same.links[0].velocity[0] *= 8.0;
    same.links[0].start /= 8.0;
    same.links[0].rate /= 8.0;
    let joints = |of| proven.joints_of(of, 0.0);
    assert_eq!(joints(&same), joints(&statement));
}
