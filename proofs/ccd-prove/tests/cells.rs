//! Proofs of the paths of a small robot, including paths at the checker's limits.

use ccd_prove::{NotProven, PathNotProven, Proof, ProvenCell, Statement, StatementLink};
use rigid_ccd::{Body, Pose, Settings, StartPolicy, trajectory};
use rigid_ccd_robot::{Cell, Joint, Link, LinkPairs, PositionRule, Robot};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Returns a cell with an obstacle, a car on a prismatic joint along x, and a wheel on a revolute joint. The wheel may have a body.
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

/// Computes the first contact on a path, proves the answer, and checks all proofs.
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

/// Tests a body inside another body. The engine reports a contact, although the surfaces are apart.
#[test]
fn a_body_in_another_at_the_start_has_no_proof() {
    let ball = || Body::sphere(0.1).unwrap();
    for (car, obstacle) in [(ball(), block(2.0)), (block(1.0), block(0.1))] {
        let cell = cell(car, (obstacle, 0.0), None);
        let path = [[0.0, 0.0], [0.5, 0.0]];
        assert_eq!(prove_and_check(&cell, &path).unwrap().len(), 0);
    }
}

/// Tests a stop flag that is set after the query.
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

/// Tests answers to questions for which the free time of the path is not certified.
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

/// Tests a pair that starts within the tolerance, with the policy `Leave`. If there is a gap, the answer is proven. Otherwise the proof
/// is an error.
#[test]
fn a_pair_in_contact_at_the_start_is_proven_if_it_has_a_gap() {
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

/// Tests a gap that equals the tolerance up to rounding. The gap is at the start of a path, or between two segments.
#[test]
fn a_contact_at_the_tolerance_is_proven() {
    let at = 2.0 + Settings::DEFAULT.tolerance;
    let cell = cell(block(1.0), (block(1.0), at), None);
    let path = [[0.0, 0.0], [0.5, 0.0]];
    assert_eq!(prove_and_check(&cell, &path).unwrap().len(), 1);
    let path = [[-3.0, 0.0], [0.0, 0.0], [0.5, 0.0]];
    assert_eq!(prove_and_check(&cell, &path).unwrap().len(), 2);
}

/// Tests a wheel that rotates too far. A statement contains the wheel only if it has a body.
#[test]
fn rotations_beyond_the_range_of_the_checker_are_refused() {
    for (from, to) in [(300.0, 300.5), (0.0, 129.0)] {
        let path = [[0.0, from], [0.5, to]];
        let without_body = cell(block(1.0), (block(1.0), 9.0), None);
        assert_eq!(prove_and_check(&without_body, &path).unwrap().len(), 1);
        let with_body = cell(block(1.0), (block(1.0), 9.0), Some(block(0.5)));
        let refused = prove_and_check(&with_body, &path).map(|proofs| proofs.len());
        let reason = NotProven::RotationTooLarge { link: 2 };
        assert_eq!(refused, Err(PathNotProven::Segment { segment: 0, reason }));
    }
    let with_body = cell(block(1.0), (block(1.0), 9.0), Some(block(0.5)));
    let path = [[0.0, 255.0], [0.5, 129.0]];
    assert_eq!(prove_and_check(&with_body, &path).unwrap().len(), 1);
}

/// Tests that joint positions are read back exactly, although the prover scales the positions of prismatic joints by powers of two.
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
        // The margin or an obstacle differs.
        assert_eq!(proven.joints_of(&statement, 0.1), None);
        let other = self::cell(block(0.5), (block(0.4), 900.0), Some(block(1.0)));
        let other = ProvenCell::new(&other).unwrap();
        assert_eq!(other.joints_of(&statement, 0.0), None);
    }
}

/// Tests changes of joints in a statement, also of the numbers that the prover may scale by a power of two.
#[test]
fn statements_about_other_joints_are_rejected() {
    let cell = cell(block(0.5), (block(0.5), 900.0), Some(block(1.0)));
    let proven = ProvenCell::new(&cell).unwrap();
    let proof = &prove_and_check(&cell, &[[0.1, 0.2], [0.3, -0.4]]).unwrap()[0];
    let statement = Statement::read(&proof.bytes).unwrap();
    assert!(proven.joints_of(&statement, 0.0).is_some());
    let changes: [fn(&mut StatementLink); 8] = [
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
    // Scaling the velocity and the positions by a power of two keeps the motion.
    let mut same = statement.clone();
    same.links[0].velocity[0] *= 8.0;
    same.links[0].start /= 8.0;
    same.links[0].rate /= 8.0;
    let joints = |of| proven.joints_of(of, 0.0);
    assert_eq!(joints(&same), joints(&statement));
}
