//! Tests the start policy `leave` against the engine and against corner heights.

use super::*;
use crate::cell::Item;
use rigid_ccd::glam::DQuat;
use rigid_ccd::{Motion, Outcome, StartPolicy};
use std::f64::consts::TAU;

fn leave() -> Settings {
    Settings {
        start_policy: StartPolicy::Leave,
        ..Settings::DEFAULT
    }
}

fn at(position: [f64; 3]) -> Pose {
    Pose::at(position).unwrap()
}

/// Returns a robot with one bodiless link at the end of a chain of joints.
fn robot_of(joints: Vec<trajectory::Joint>) -> Robot {
    let name = |k: usize| format!("link{k}");
    let links = (0..=joints.len()).map(|k| Link::named(name(k))).collect();
    let joints = joints.into_iter().enumerate().map(|(k, joint)| Joint {
        name: format!("joint{k}"),
        parent: name(k),
        child: name(k + 1),
        geometry: joint,
        position_rule: PositionRule::Independent,
    });
    Robot::new(links, joints.collect()).unwrap()
}

/// Returns a cell with obstacles, in which the last link of a robot carries a can.
fn cell_with_can(
    robot: Robot,
    (can, pose): (Body, Pose),
    obstacles: &[(&str, Body, Pose)],
) -> Cell {
    let pairs = LinkPairs::from_robot(&robot);
    let last = format!("link{}", robot.joints().len());
    let mut cell = Cell::new(robot, pairs);
    for (name, body, pose) in obstacles {
        cell.add_obstacle(*name, body.clone(), *pose).unwrap();
    }
    cell.attach("can", can, (&last, pose), &[]).unwrap();
    cell
}

/// Returns a large slab with its top at height 0, as one polytope or as triangles.
fn slab(as_mesh: bool) -> Body {
    let [x, z] = [3.0, -0.2];
    let corners: Vec<DVec3> = (0..8)
        .map(|k| {
            let side = |bit: usize| if k >> bit & 1 == 1 { x } else { -x };
            DVec3::new(side(0), side(1), if k >> 2 & 1 == 1 { 0.0 } else { z })
        })
        .collect();
    if !as_mesh {
        return Body::polytope(rigid_ccd::body::Polytope {
            points: corners,
            ..Default::default()
        })
        .unwrap();
    }
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let faces: Vec<[u32; 3]> = quads
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    let ids: Vec<u32> = (0..12).collect();
    let pieces = Pieces::from_triangles(&corners, &faces, &ids).unwrap();
    Body::new(&pieces, Solidity::Solid).unwrap()
}

fn slide(axis: [f64; 3]) -> trajectory::Joint {
    trajectory::Joint::prismatic(Pose::IDENTITY, axis).unwrap()
}

/// Tests a can that is lifted from a table and touches a shelf above it at 0.793 of the path.
#[test]
fn a_can_that_is_lifted_from_a_table_meets_the_shelf_above() {
    let can = Body::cylinder(0.033, 0.06).unwrap();
    let shelf = Body::cuboid([0.5, 0.5, 0.01]).unwrap();
    let shelf_bottom = 0.12 + 0.793;
    let obstacles = [
        ("table", slab(false), Pose::IDENTITY),
        ("shelf", shelf, at([0.0, 0.0, shelf_bottom + 0.01])),
    ];
    let mut cell = cell_with_can(
        robot_of(vec![slide([0.0, 0.0, 1.0])]),
        (can, at([0.0, 0.0, 0.06])),
        &obstacles,
    );
    let path = [[0.0], [1.0]];
    let reported = cell.solver().first_contact(&path).unwrap().outcome;
    assert!(matches!(reported, PathOutcome::Contact(at) if at.at.fraction == 0.0));
    let settings = Settings {
        tolerance: 1e-4,
        ..leave()
    };
    let mut solver = cell.solver().with_settings(settings.clone());
    let PathOutcome::Contact(contact) = solver.first_contact(&path).unwrap().outcome else {
        panic!("there is a shelf");
    };
    assert!(
        (0.7928..=0.793).contains(&contact.at.fraction),
        "{contact:?}"
    );
    assert_eq!(contact.items.map(Item::name), ["can", "shelf"]);
    assert!(!solver.is_free(&path).unwrap());
    assert!(solver.is_free(&[[0.0], [0.79]]).unwrap());
    assert!(solver.is_free(&[[0.0]]).unwrap());
    // On the way back down, the can touches the table again: a contact, because the two had separated.
    let PathOutcome::Contact(contact) = solver
        .first_contact(&[[0.0], [0.5], [0.0]])
        .unwrap()
        .outcome
    else {
        panic!("the can comes back");
    };
    assert_eq!(contact.items.map(Item::name), ["can", "table"]);
    assert!(
        contact.at.segment == 1 && contact.at.fraction > 0.999,
        "{contact:?}"
    );
    // Moving down into the table is a contact.
    assert!(!solver.is_free(&[[0.0], [-0.01]]).unwrap());
    assert!(!solver.is_free(&[[0.0], [0.0], [-0.01]]).unwrap());
    // Overlapping bodies are in contact, also while they separate.
    cell.move_obstacle("table", at([0.0, 0.0, 0.01])).unwrap();
    let found = cell
        .solver()
        .with_settings(settings.clone())
        .first_contact(&path)
        .unwrap()
        .outcome;
    assert!(matches!(found, PathOutcome::Contact(found) if found.at.fraction == 0.0));
    // An allowed contact is not checked.
    let pair = [Item::Attached("can"), Item::Obstacle("table")];
    cell.allow_contact(pair).unwrap();
    let found = cell
        .solver()
        .with_settings(settings)
        .first_contact(&path)
        .unwrap()
        .outcome;
    assert!(
        matches!(found, PathOutcome::Contact(found) if found.items[1] == Item::Obstacle("shelf"))
    );
}

/// How one joint moves a box that stands on a slab, as a joint and as a constant motion.
struct Case {
    joint: trajectory::Joint,
    motion: Motion,
    /// The joint's origin in the world.
    origin: DVec3,
    /// The joint's final position.
    end: f64,
}

/// Draws a joint by which a box with the given center rises, slides or sinks. Also returns the initial direction: 1, 0
/// or -1.
fn random_case(random: &mut Pcg64, center: DVec3) -> (Case, i32) {
    let kind = random.random_range(-1..=1);
    if random.random_range(0..2) == 0 {
        let side = random.random_range(0.0..TAU);
        let rise = f64::from(kind) * random.random_range(0.05..1.0);
        let axis = DVec3::new(side.cos(), side.sin(), rise).normalize();
        let length = random.random_range(0.05..1.0);
        let axis = axis.to_array();
        let joint = slide(axis);
        let motion = Motion::new(
            Pose::at(center).unwrap(),
            DVec3::from(axis) * length,
            [0.0; 3],
        );
        return (
            Case {
                joint,
                motion: motion.unwrap(),
                origin: DVec3::ZERO,
                end: length,
            },
            kind,
        );
    }
    let turn = random.random_range(0.05..1.2);
    let (origin, axis) = if kind == 0 {
        // About a vertical axis the box slides.
        (
            [
                random.random_range(-1.0..1.0),
                random.random_range(-1.0..1.0),
                0.0,
            ],
            DVec3::Z,
        )
    } else {
        // About a horizontal axis beside the box, it rises or sinks.
        let away = [-1.0f64, 1.0][random.random_range(0..2)] * random.random_range(0.4..1.0);
        let axis = DVec3::Y * away.signum() * f64::from(kind);
        ([center.x + away, 0.0, random.random_range(-0.1..0.3)], axis)
    };
    let joint = trajectory::Joint::revolute(at(origin), axis.to_array()).unwrap();
    let start = Pose::at(center).unwrap();
    let motion = Motion::about(start, [0.0; 3], axis * turn, DVec3::from(origin) - center);
    (
        Case {
            joint,
            motion: motion.unwrap(),
            origin: DVec3::from(origin),
            end: turn,
        },
        kind,
    )
}

/// Returns the height of a moving box's lowest corner at a time, computed independently.
fn least_height(motion: &Motion, half: DVec3, time: f64) -> f64 {
    let turned = DQuat::from_scaled_axis(motion.angular_velocity() * time);
    let start = motion.start().translation();
    let pivot = start + motion.center() + motion.velocity() * time;
    let corners = (0..8).map(|k| {
        let side = |bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        half * DVec3::new(side(0), side(1), side(2)) - motion.center()
    });
    corners
        .map(|corner| (pivot + turned * corner).z)
        .fold(f64::INFINITY, lesser)
}

/// Tests random boxes on a slab that rise, slide or sink: the answer agrees with the engine, and before a contact no
/// corner is lower than at the start.
#[test]
fn a_pair_in_contact_at_the_start_answers_as_two_bodies_do() {
    let mut random = Pcg64::seed_from_u64(75);
    let (mut counts, mut later) = ([[0; 2]; 3], 0);
    for round in 0..600 {
        let half = DVec3::from_array([(); 3].map(|()| random.random_range(0.05..0.2)));
        let gap = [0.0, 0.0, 3e-5, 4e-4][random.random_range(0..4)];
        let center = DVec3::new(0.0, random.random_range(-0.3..0.3), half.z + gap);
        let (case, kind) = random_case(&mut random, center);
        let (ground, body) = (slab(round % 3 == 0), Body::cuboid(half).unwrap());
        let robot = robot_of(vec![case.joint]);
        let obstacles = [("slab", ground.clone(), Pose::IDENTITY)];
        let cell = cell_with_can(
            robot,
            (body.clone(), Pose::at(center - case.origin).unwrap()),
            &obstacles,
        );
        let mut solver = cell.solver().with_settings(leave());
        let path = [[0.0], [case.end]];
        let found = solver.first_contact(&path).unwrap().outcome;
        assert_eq!(
            solver.is_free(&path).unwrap(),
            found == PathOutcome::Free,
            "{round}"
        );
        let resting = Motion::STILL;
        let two_bodies = Solver::new()
            .with_settings(leave())
            .first_contact((&body, case.motion), (&ground, resting), 1.0)
            .unwrap()
            .outcome;
        // The end of the proven part, and the latest time of both contacts.
        let until = match (found, two_bodies) {
            (PathOutcome::Free, Outcome::Free { .. }) => 1.0,
            (PathOutcome::Contact(contact), Outcome::Contact { time, .. }) => {
                let height = |time: f64| least_height(&case.motion, half, time);
                let [own, other] = [contact.at.fraction, time].map(height);
                assert!((own - other).abs() <= 1e-3, "{round}: {contact:?} {time}");
                assert!(own <= gap + 1e-9, "{round}: {own} {contact:?}");
                contact.at.fraction
            }
            other => panic!("{round}: {kind} {gap} {other:?}"),
        };
        for k in 0..=400 {
            let time = f64::from(k) / 400.0;
            let height = least_height(&case.motion, half, time);
            assert!(
                time >= until || height >= -2e-9,
                "{round}: {height} at {time} of {until}"
            );
            // Half of the gap must be kept.
            assert!(
                time >= until || gap == 0.0 || height > 0.2 * gap,
                "{round}: {height}"
            );
        }
        counts[(kind + 1) as usize][usize::from(found == PathOutcome::Free)] += 1;
        later += usize::from(found != PathOutcome::Free && until > 1e-3);
    }
    let [sinks, slides, parts] = counts;
    assert!(sinks[0] > 150 && sinks[1] == 0, "{counts:?}");
    assert!(slides[1] > 150 && slides[0] == 0, "{counts:?}");
    assert!(parts[1] > 100, "{counts:?}");
    assert!(later > 5, "{counts:?} {later}");
}

/// Tests arms of three joints that lift a box from a slab, along edges and along curves that start at rest.
#[test]
fn arms_lift_and_press_what_stands_on_a_slab() {
    let mut random = Pcg64::seed_from_u64(76);
    let mut counts = [[0; 2]; 2];
    for round in 0..300 {
        let half = DVec3::from_array([(); 3].map(|()| random.random_range(0.05..0.15)));
        let turn = |origin: [f64; 3], axis: [f64; 3]| {
            trajectory::Joint::revolute(at(origin), axis).unwrap()
        };
        let [shoulder, elbow] = [random.random_range(0.2..0.6), random.random_range(0.3..0.6)];
        let joints = vec![
            turn([0.0, 0.0, shoulder], [0.0, 0.0, 1.0]),
            turn([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            turn([elbow, 0.0, 0.3], [0.0, 1.0, 0.0]),
        ];
        let robot = robot_of(joints);
        let start = [
            random.random_range(-1.0..1.0),
            random.random_range(-0.4..0.4),
            random.random_range(-0.4..0.4),
        ];
        let link = robot.pose("link3", &start).unwrap();
        let center = DVec3::new(1.2, 0.1, half.z);
        let held = link.inverse().compose(&Pose::at(center).unwrap());
        let obstacles = [("slab", slab(round % 2 == 0), Pose::IDENTITY)];
        let cell = cell_with_can(robot, (Body::cuboid(half).unwrap(), held), &obstacles);
        let lifts = random.random_range(0..2) == 1;
        let rise = if lifts { -1.0f64 } else { 1.0 } * random.random_range(0.1..0.4);
        // The elbow turns against the shoulder, so that the box tilts only slightly.
        let end = [
            start[0] + random.random_range(-0.3..0.3),
            start[1] + rise,
            start[2] - 0.9 * rise,
        ];
        let mut solver = cell.solver().with_settings(leave());
        let outcome = match round % 3 {
            0 => {
                let still = [[0.0; 3]; 2];
                let curve = crate::JointCurve::cubic_hermite(&[0.0, 1.0], &[start, end], &still);
                solver.first_contact(&curve.unwrap()).unwrap().outcome
            }
            1 => {
                let still = [[0.0; 3]; 2];
                let curve =
                    crate::JointCurve::quintic_hermite(&[0.0, 1.0], &[start, end], &still, &still);
                solver.first_contact(&curve.unwrap()).unwrap().outcome
            }
            _ => solver.first_contact(&[start, end]).unwrap().outcome,
        };
        let until = match outcome {
            PathOutcome::Free => 1.0,
            PathOutcome::Contact(contact) => contact.at.fraction,
            _ => panic!("{round}: {outcome:?}"),
        };
        for k in 0..=300 {
            let fraction = f64::from(k) / 300.0;
            let eased = match round % 3 {
                0 => fraction * fraction * (3.0 - 2.0 * fraction),
                1 => fraction.powi(3) * (10.0 - fraction * (15.0 - 6.0 * fraction)),
                _ => fraction,
            };
            let placed = cell
                .placed_bodies(&configuration_between(&start, &end, eased))
                .unwrap();
            let pose = placed
                .iter()
                .find(|(item, ..)| item.name() == "can")
                .unwrap()
                .2;
            let corners = (0..8).map(|k| {
                let side = |bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
                pose.transform_point(half * DVec3::new(side(0), side(1), side(2)))
                    .z
            });
            let height = corners.fold(f64::INFINITY, lesser);
            assert!(
                fraction >= until || height >= -2e-9,
                "{round}: {height} at {fraction} of {until}"
            );
        }
        counts[usize::from(lifts)][usize::from(outcome == PathOutcome::Free)] += 1;
    }
    let [pressed, lifted] = counts;
    assert!(pressed[0] > 100 && pressed[1] == 0, "{counts:?}");
    assert!(lifted[1] > 100, "{counts:?}");
}

/// Tests that a pair within its margin at the start keeps its initial distance.
#[test]
fn a_pair_that_begins_inside_the_margin_may_part() {
    let body = Body::cuboid([0.1; 3]).unwrap();
    for gap in [0.0, 0.004] {
        let robot = robot_of(vec![slide([0.0, 0.0, 1.0])]);
        let obstacles = [("slab", slab(false), Pose::IDENTITY)];
        let cell = cell_with_can(robot, (body.clone(), at([0.0, 0.0, 0.1 + gap])), &obstacles);
        let settings = Settings {
            margin: 0.02,
            ..leave()
        };
        let mut solver = cell.solver().with_settings(settings);
        assert!(solver.is_free(&[[0.0], [0.3]]).unwrap(), "{gap}");
        assert!(!solver.is_free(&[[0.0], [-0.002]]).unwrap(), "{gap}");
        // Returning to the start restores the initial distance.
        assert!(solver.is_free(&[[0.0], [0.3], [0.001]]).unwrap(), "{gap}");
        assert!(!solver.is_free(&[[0.0], [0.3], [-0.001]]).unwrap(), "{gap}");
    }
}

#[test]
fn questions_without_the_start_policy_leave_refuse_it() {
    let robot = robot_of(vec![slide([0.0, 0.0, 1.0])]);
    let obstacles = [("slab", slab(false), Pose::IDENTITY)];
    let cell = cell_with_can(
        robot,
        (Body::sphere(0.1).unwrap(), at([0.0, 0.0, 0.1])),
        &obstacles,
    );
    let path = [[0.0], [0.3]];
    let mut solver = cell.solver().with_settings(leave());
    let is_refused = |error: PathError| matches!(error, PathError::UnsupportedSetting { .. });
    assert!(is_refused(solver.closest_approach(&path).unwrap_err()));
    assert!(is_refused(solver.distance_curve(&path, 2).unwrap_err()));
    let ranges = crate::RangeSettings::DEFAULT;
    assert!(is_refused(
        solver.clearance_ranges(&path, ranges).unwrap_err()
    ));
    let settings = Settings {
        clearance: Some(0.1),
        ..Settings::DEFAULT
    };
    let mut solver = cell.solver().with_settings(settings);
    assert!(is_refused(solver.closest_approach(&path).unwrap_err()));
    assert!(is_refused(solver.is_free(&path).unwrap_err()));
}

/// Tests that after a limit the reported part of the path is free.
#[test]
fn limits_leave_a_start_that_is_free() {
    let robot = robot_of(vec![slide([0.0, 0.0, 1.0])]);
    let obstacles = [("slab", slab(true), Pose::IDENTITY)];
    let cell = cell_with_can(
        robot,
        (Body::sphere(0.1).unwrap(), at([0.0, 0.0, 0.1])),
        &obstacles,
    );
    let path = [[0.0], [0.3]];
    let ended = [
        Settings {
            deadline: Some(std::time::Duration::ZERO),
            ..leave()
        },
        Settings {
            budget: 0,
            ..leave()
        },
    ];
    for settings in ended {
        let mut solver = cell.solver().with_settings(settings);
        let answer = solver.first_contact(&path).unwrap();
        assert!(
            matches!(answer.outcome, PathOutcome::Unresolved(_)),
            "{answer:?}"
        );
        assert_eq!(answer.free_until.time(), 0.0);
        assert!(solver.is_free(&path).is_err());
    }
}

/// Returns a can on slides along x and z, on a table, with a wall from x = `from` to `to`.
fn can_before_wall(from: f64, to: f64) -> Cell {
    let slides = [
        ("x", "base", "cart", [1.0, 0.0, 0.0]),
        ("z", "cart", "can", [0.0, 0.0, 1.0]),
    ];
    let joints = slides.map(|(name, parent, child, axis)| Joint {
        name: name.into(),
        parent: parent.into(),
        child: child.into(),
        geometry: trajectory::Joint::prismatic(Pose::IDENTITY, axis).unwrap(),
        position_rule: PositionRule::Independent,
    });
    let can = Body::cuboid([0.05, 0.05, 0.05]).unwrap();
    let links = vec![
        Link::named("base"),
        Link::named("cart"),
        Link::named("can").with_body(can, Pose::IDENTITY),
    ];
    let robot = Robot::new(links, joints.into()).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let half = [0.5 * (to - from), 1.0, 1.0];
    for (name, half, at) in [
        ("table", [9.0, 9.0, 1.0], [0.0, 0.0, -1.05]),
        ("wall", half, [0.5 * (from + to), 0.0, 1.2]),
    ] {
        let (body, pose) = (Body::cuboid(half).unwrap(), Pose::at(at).unwrap());
        cell.add_obstacle(name, body, pose).unwrap();
    }
    cell
}

/// Tests the order of two contacts, one of a pair in contact at the start and one of another pair. The search for one
/// of them meets, at a midpoint, a contact that is later than the other one.
#[test]
fn of_a_start_contact_and_another_one_the_first_is_reported() {
    let (high, low) = (0.3, -0.05);
    // On its way down, the can either hits a thin wall, or sinks into the table before it reaches a thick wall.
    for (wall, path, item, expected) in [
        (
            [0.5, 0.51],
            vec![
                [0.0, 0.0],
                [0.0, high],
                [0.0, high],
                [1.0, -0.01],
                [1.0, -0.01],
            ],
            "wall",
            2.45,
        ),
        (
            [0.5, 3.0],
            vec![[0.0, 0.0], [0.1, 0.0], [1.0, low], [1.0, low], [1.0, low]],
            "table",
            1.0,
        ),
    ] {
        let cell = can_before_wall(wall[0], wall[1]);
        let mut solver = cell.solver().with_settings(leave());
        let answer = solver.first_contact(&path).unwrap();
        let contact = answer.contact().unwrap().unwrap();
        assert_eq!(contact.items.map(Item::name), ["can", item], "{answer:?}");
        assert!((contact.at.time() - expected).abs() < 0.02, "{answer:?}");
        assert!(!solver.is_free(&path).unwrap());
    }
}

/// Tests that the start policy allocates no memory after a similar question.
#[test]
fn the_start_policy_leave_keeps_its_memory() {
    for as_mesh in [false, true] {
        let robot = robot_of(vec![slide([0.0, 0.0, 1.0])]);
        let obstacles = [("slab", slab(as_mesh), Pose::IDENTITY)];
        let can = (Body::cuboid([0.1; 3]).unwrap(), at([0.0, 0.0, 0.1]));
        let cell = cell_with_can(robot, can, &obstacles);
        let mut solver = cell.solver().with_settings(leave());
        let path = [[0.0], [0.3]];
        assert!(solver.is_free(&path).unwrap());
        let allocated = allocation_counter::measure(|| {
            assert!(solver.is_free(&path).unwrap());
            assert_eq!(
                solver.first_contact(&path).unwrap().outcome,
                PathOutcome::Free
            );
        });
        assert_eq!(allocated.count_total, 0, "{allocated:?}");
    }
}

/// Tests a body that one joint turns on a table, near its axis and far from it.
#[test]
fn what_stands_on_a_table_turns_there() {
    let bodies = [
        Body::cylinder(0.033, 0.06).unwrap(),
        Body::cuboid([0.05, 0.03, 0.06]).unwrap(),
        Body::capsule(0.03, 0.03).unwrap(),
    ];
    for (body, distance) in bodies.iter().flat_map(|body| [(body, 0.0), (body, 0.4)]) {
        for as_mesh in [false, true] {
            let hinge = trajectory::Joint::revolute(at([0.1, 0.2, 0.3]), [0.0, 0.0, 1.0]).unwrap();
            let cell = cell_with_can(
                robot_of(vec![hinge, slide([0.0, 0.0, 1.0])]),
                (body.clone(), at([distance, 0.0, 0.06 - 0.3])),
                &[("table", slab(as_mesh), Pose::IDENTITY)],
            );
            let mut solver = cell.solver().with_settings(leave());
            let mut answer =
                |to: [f64; 2]| solver.first_contact(&[[0.0, 0.0], to]).unwrap().outcome;
            assert_eq!(answer([2.0, 0.0]), PathOutcome::Free, "{body:?}");
            assert_eq!(answer([-3.0, 0.0]), PathOutcome::Free, "{body:?}");
            // The can sinks by a tenth of the tolerance.
            let sinks = answer([2.0, -1e-4]);
            assert!(matches!(sinks, PathOutcome::Contact(_)), "{sinks:?}");
        }
    }
}
