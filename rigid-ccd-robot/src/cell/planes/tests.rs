//! Tests planes against the heights of all corners, computed independently.

use super::super::{Cell, Item};
use crate::error::{PathError, RobotError};
use crate::link_contacts::tests::classify;
use crate::pairs::LinkPairs;
use crate::path_answer::PathOutcome;
use crate::robot::{CompoundKind, Link, Robot};
use crate::solver::RangeSettings;
use crate::solver::tests::{configuration_between, random_configuration};
use crate::test_robots::{random_body, random_pose, random_robot};
use crate::{LinkContactClass, PlacedRobot};
use ccd_core::order::lesser;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::answer::ClearanceVerdict;
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{Body, Pose, Settings};

const TOLERANCE: f64 = 1e-4;

/// Returns the least height, above several planes, of all moving links and of an attached body.
fn least_height(
    robot: &Robot,
    attached: Option<(&str, &Body, Pose)>,
    planes: &[Pose],
    at: &[f64],
) -> f64 {
    let mut least = f64::INFINITY;
    let mut measure = |body: &Body, pose: Pose| {
        for piece in body.pieces().iter() {
            for point in piece.points {
                for plane in planes {
                    let above = pose.transform_point(*point) - plane.translation();
                    let height = (plane.rotation() * DVec3::Z).dot(above) - piece.radius;
                    least = lesser(least, height);
                }
            }
        }
    };
    for (number, link) in robot.links().iter().enumerate() {
        if !robot.are_rigidly_connected(number, robot.base()) {
            let pose = robot.pose(&link.name, at).unwrap();
            for own in &link.bodies {
                measure(&own.body, pose.compose(&own.pose));
            }
        }
    }
    if let Some((link, body, pose)) = attached {
        measure(body, robot.pose(link, at).unwrap().compose(&pose));
    }
    least
}

/// Returns planes that are below most of a robot: a floor, a slope, or three planes that form a corner.
fn random_planes(random: &mut Pcg64) -> Vec<Pose> {
    let count = random.random_range(1..4);
    let planes = (0..count).map(|_| {
        let tilt = DQuat::from_scaled_axis(random_pose(random, 1.0).translation());
        let normal = tilt * DVec3::Z;
        let away = random_pose(random, 3.0).translation();
        let along = away - normal * normal.dot(away);
        Pose::new(along - normal * random.random_range(0.4..1.6), tilt).unwrap()
    });
    planes.collect()
}

/// Returns a robot without checked pairs of its own, above planes that are obstacles or belong to its base.
fn cell_over(robot: &Robot, planes: &[Pose], of_base: bool) -> Cell {
    let mut links = robot.links().to_vec();
    if of_base {
        links[robot.base()].planes = planes.to_vec();
    }
    let robot = Robot::new(links, robot.joints().to_vec()).unwrap();
    let mut pairs = LinkPairs::from_robot(&robot);
    for one in 0..robot.links().len() {
        for other in 0..one {
            pairs.skip(one, other, crate::SkipReason::NoMotion);
            let moves = !robot.are_rigidly_connected(one, other);
            if of_base && moves && (one == robot.base() || other == robot.base()) {
                pairs.include(one, other);
            }
        }
    }
    let mut cell = Cell::new(robot, pairs);
    if !of_base {
        for (k, plane) in planes.iter().enumerate() {
            cell.add_plane(format!("plane{k}"), *plane).unwrap();
        }
    }
    cell
}

/// Returns a robot whose base has no bodies, so that only planes on it are checked.
fn robot_on_bare_base(random: &mut Pcg64) -> Robot {
    let robot = random_robot(random);
    let mut links = robot.links().to_vec();
    links[robot.base()].bodies.clear();
    Robot::new(links, robot.joints().to_vec()).unwrap()
}

/// Tests all questions about paths over planes against corner heights at many points.
#[test]
fn answers_agree_with_the_heights_of_all_corners() {
    let mut random = Pcg64::seed_from_u64(75);
    let (mut free, mut contacts, mut near) = (0, 0, f64::INFINITY);
    for round in 0..120 {
        let robot = robot_on_bare_base(&mut random);
        let planes = random_planes(&mut random);
        let mut cell = cell_over(&robot, &planes, round % 3 == 0);
        let last = robot.links().len() - 1;
        let names: Vec<&str> = robot.links().iter().map(|link| &*link.name).collect();
        let others: Vec<&str> = (0..=last)
            .filter(|&k| k != robot.base())
            .map(|k| names[k])
            .collect();
        let link = names[last];
        let holds = round % 4 == 0 && !robot.are_rigidly_connected(last, robot.base());
        let attached = holds.then(|| {
            let (body, pose) = (random_body(&mut random), random_pose(&mut random, 0.3));
            cell.attach("held", body.clone(), (link, pose), &others)
                .unwrap();
            (body, pose)
        });
        let attached = attached.as_ref().map(|(body, pose)| (link, body, *pose));
        let margin = [0.0, 0.05][round % 2];
        let mut solver = cell.solver().with_settings(Settings {
            margin,
            tolerance: TOLERANCE,
            ..Settings::DEFAULT
        });
        for _ in 0..6 {
            let from = random_configuration(&mut random, &robot);
            let to = random_configuration(&mut random, &robot);
            let to = configuration_between(&from, &to, [0.05, 0.4, 1.0][random.random_range(0..3)]);
            let path = [&from, &to];
            let height = |fraction: f64| {
                least_height(
                    &robot,
                    attached,
                    &planes,
                    &configuration_between(&from, &to, fraction),
                )
            };
            let until = match solver.first_contact(&path).unwrap().outcome {
                PathOutcome::Free => {
                    free += 1;
                    assert!(solver.is_free(&path).unwrap());
                    1.0
                }
                PathOutcome::Contact(contact) => {
                    contacts += 1;
                    assert!(!solver.is_free(&path).unwrap());
                    let there = height(contact.at.fraction);
                    assert!(there <= margin + TOLERANCE + 1e-9, "{there} in {contact:?}");
                    if there > 0.0 {
                        let [a, b] = contact.witnesses.unwrap();
                        assert!((a.distance(b) - there).abs() < 1e-6, "{there} {contact:?}");
                    }
                    contact.at.fraction
                }
                _ => panic!("no limit is set"),
            };
            let mut least = f64::INFINITY;
            for k in 0..=50 {
                let fraction = f64::from(k) / 50.0;
                let own = height(fraction);
                assert!(
                    fraction >= until || own > margin,
                    "{own} at {fraction} before {until}"
                );
                least = lesser(least, own);
            }
            let closest = solver.closest_approach(&path).unwrap().outcome;
            assert!(closest.lower() <= ccd_core::order::greater(least, 0.0) + 1e-9);
            let nearest = height(closest.nearest().unwrap().at.time());
            assert!(
                nearest <= closest.upper() + 1e-9,
                "{nearest} in {closest:?}"
            );
            assert!(
                closest.upper() - closest.lower() <= TOLERANCE + 1e-8,
                "{closest:?}"
            );
            if until == 1.0 {
                near = lesser(near, least - margin);
            }
            let ranges = solver
                .clearance_ranges(&path, RangeSettings::DEFAULT)
                .unwrap();
            for range in ranges {
                let fraction = 0.5 * (range.from.time() + range.to.time());
                match range.verdict {
                    ClearanceVerdict::Kept => assert!(height(fraction) > margin - 1e-9),
                    ClearanceVerdict::Violated => assert!(height(fraction) < margin + 1e-9),
                    ClearanceVerdict::Unverified => {}
                }
            }
        }
    }
    assert!(
        free > 150 && contacts > 150,
        "{free} free, {contacts} contacts"
    );
    assert!(near < 5e-3, "{near}: no free path is close");
}

/// Tests that a plane gives the answers of a large box with its top in the plane.
#[test]
fn a_plane_is_a_large_box() {
    let mut random = Pcg64::seed_from_u64(76);
    let (mut free, mut contacts) = (0, 0);
    for _ in 0..60 {
        let robot = robot_on_bare_base(&mut random);
        let planes = random_planes(&mut random);
        let cell = cell_over(&robot, &planes, false);
        let mut boxes = cell_over(&robot, &[], false);
        for (k, plane) in planes.iter().enumerate() {
            let down = Pose::at([0.0, 0.0, -40.0]).unwrap();
            let body = Body::cuboid([60.0, 60.0, 40.0]).unwrap();
            boxes
                .add_obstacle(format!("box{k}"), body, plane.compose(&down))
                .unwrap();
        }
        let [from, to] = [(); 2].map(|()| random_configuration(&mut random, &robot));
        let [own, other] = [&cell, &boxes].map(|cell| {
            let mut solver = cell.solver();
            let closest = solver.closest_approach(&[&from, &to]).unwrap().outcome;
            (closest.lower(), closest.upper())
        });
        assert!(
            own.0 <= other.1 + 1e-9 && other.0 <= own.1 + 1e-9,
            "{own:?} {other:?}"
        );
        if own.0 > 0.0 {
            free += 1;
        } else {
            contacts += 1;
        }
    }
    assert!(free > 10 && contacts > 10, "{free} {contacts}");
}

/// Returns a free-flying ball of radius 0.1.
fn flying_ball() -> Cell {
    let ball = Link::named("ball").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let robot = Robot::new(vec![ball], vec![]).unwrap();
    let (robot, pairs) = Robot::combine(&[PlacedRobot {
        name: "",
        robot: &robot,
        pairs: &LinkPairs::from_robot(&robot),
        carrier: None,
        pose: Pose::IDENTITY,
        base_motion: Some(CompoundKind::Floating),
    }])
    .unwrap();
    Cell::new(robot, pairs)
}

fn at([x, y, z]: [f64; 3]) -> [f64; 6] {
    [x, y, z, 0.0, 0.0, 0.0]
}

/// Tests that a plane is exact far from the base, and that a path beyond its reach is refused.
#[test]
fn a_plane_has_no_end_or_is_refused() {
    let mut cell = flying_ball();
    let tilt = DQuat::from_axis_angle(DVec3::X, 0.5);
    let normal = tilt * DVec3::Z;
    for plane in [Pose::IDENTITY, Pose::new([40.0, 30.0, 20.0], tilt).unwrap()] {
        match cell.move_obstacle("floor", plane) {
            Ok(()) => {}
            Err(_) => cell.add_plane("floor", plane).unwrap(),
        }
        let normal = if plane == Pose::IDENTITY {
            DVec3::Z
        } else {
            normal
        };
        let along = if plane == Pose::IDENTITY {
            DVec3::X
        } else {
            tilt * DVec3::Y
        };
        let height = |height: f64, far: f64| {
            at((plane.translation() + height * normal + far * along).to_array())
        };
        let mut solver = cell.solver();
        for far in [0.0, 10.0, -300.0, 600.0] {
            assert!(solver.is_free(&[height(0.101, far)]).unwrap(), "{far}");
            assert!(!solver.is_free(&[height(0.0999, far)]).unwrap(), "{far}");
            assert!(!solver.is_free(&[height(-200.0, far)]).unwrap(), "{far}");
        }
        let refused = solver.is_free(&[height(0.5, 5e3)]);
        assert!(
            matches!(refused, Err(PathError::BeyondPlane { .. })),
            "{refused:?}"
        );
    }
    // The origin of a plane may be far from the robot.
    cell.move_obstacle("floor", Pose::at([1e9, 0.0, -1.0]).unwrap())
        .unwrap();
    let mut solver = cell.solver();
    assert!(solver.is_free(&[at([0.0, 0.0, -0.89])]).unwrap());
    assert!(!solver.is_free(&[at([0.0, 0.0, -0.91])]).unwrap());
    cell.move_obstacle("floor", Pose::at([9e11, 0.0, -1.0]).unwrap())
        .unwrap();
    let refused = cell.solver().is_free(&[at([0.0, 0.0, 5.0])]);
    assert!(
        matches!(refused, Err(PathError::BeyondPlane { .. })),
        "{refused:?}"
    );
}

#[test]
fn planes_count_like_other_obstacles() {
    let mut cell = flying_ball();
    cell.add_plane("floor", Pose::IDENTITY).unwrap();
    let taken = cell.add_plane("floor", Pose::IDENTITY);
    assert!(matches!(taken, Err(RobotError::NameTaken { .. })));
    assert_eq!(cell.obstacle_names().collect::<Vec<_>>(), ["floor"]);
    let is_free = |cell: &Cell, z: f64| cell.solver().is_free(&[at([0.0, 0.0, z])]).unwrap();
    assert!(is_free(&cell, 0.15));
    cell.set_padding("ball", 0.1).unwrap();
    assert!(!is_free(&cell, 0.15) && is_free(&cell, 0.21));
    cell.set_clearance([Item::Link("ball"), Item::Obstacle("floor")], 0.01)
        .unwrap();
    assert!(is_free(&cell, 0.15) && !is_free(&cell, 0.105));
    // Larger than the robot when the plane was added.
    let slab = Body::cuboid([3000.0, 1.0, 1.0]).unwrap();
    let attached = Pose::at([3000.0, 0.0, 0.0]).unwrap();
    cell.attach("slab", slab, ("ball", attached), &[]).unwrap();
    assert!(!is_free(&cell, 0.9) && is_free(&cell, 1.1));
    let tilted = [0.0, 0.0, 60.0, 0.0, 0.02, 0.0];
    assert!(!cell.solver().is_free(&[tilted]).unwrap());
    cell.detach("slab").unwrap();
    assert!(cell.solver().is_free(&[tilted]).unwrap());
    cell.remove_obstacle("floor").unwrap();
    let nothing = cell.solver().is_free(&[at([0.0, 0.0, -7.0])]);
    assert!(
        matches!(nothing, Err(PathError::NothingCompared(_))),
        "{nothing:?}"
    );
}

/// Tests that static links may have planes, also in combined robots, and that moving links may not.
#[test]
fn only_links_at_rest_have_planes() {
    let floor = Link::named("floor").with_plane(Pose::IDENTITY);
    let robot = Robot::new(vec![floor], vec![]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let placed = |base_motion| {
        Robot::combine(&[PlacedRobot {
            name: "room",
            robot: &robot,
            pairs: &pairs,
            carrier: None,
            pose: Pose::at([0.0, 0.0, -1.0]).unwrap(),
            base_motion,
        }])
    };
    let (resting, _) = placed(None).unwrap();
    assert_eq!(resting.links()[1].planes.len(), 1);
    let moving = placed(Some(CompoundKind::Floating)).unwrap_err();
    assert_eq!(
        moving,
        RobotError::MovingPlane {
            link: "room/floor".to_owned()
        }
    );
}

/// Tests the classes of links above, in and partly in a floor.
#[test]
fn links_touch_a_floor_never_always_or_sometimes() {
    let text = r#"<mujoco><worldbody><geom type="plane" size="1 1 1"/>
        <body name="high" pos="0 0 2"><joint range="-90 90"/><geom type="capsule" size="0.1" fromto="0 0 0 1 0 0"/></body>
        <body name="low" pos="0 0 0.05"><joint range="-90 90"/><geom type="capsule" size="0.1" fromto="0 0 0 1 0 0"/></body>
        <body name="dips" pos="0 0 0.5"><joint axis="0 1 0" range="-90 90"/><geom type="capsule" size="0.1" fromto="0 0 0 1 0 0"/>
        </body></worldbody></mujoco>"#;
    let robot = crate::RobotFile::from_text(text, "floor.xml")
        .read()
        .unwrap();
    let classes = classify(&robot, 10_000);
    let of = |link: &str| {
        let link = robot.link_number(link).unwrap();
        let mut own = classes
            .iter()
            .filter(|(pair, _)| pair.contains(&robot.base()) && pair.contains(&link));
        own.next().unwrap().1.clone()
    };
    assert_eq!(of("high"), LinkContactClass::Never);
    assert_eq!(of("low"), LinkContactClass::Always);
    assert!(matches!(of("dips"), LinkContactClass::Sometimes { .. }));
}
