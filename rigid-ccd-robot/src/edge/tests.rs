//! Tests of edges against sampled configurations, and of the bounds on which the search relies.

use super::displacement::Displacements;
use super::kinematics::Kinematics;
use super::rounding::point_error;
use super::*;
use crate::cell::part::PlacedBody;
use crate::pairs::LinkPairs;
use crate::robot::{Joint, Link, Position, Robot};
use ccd_core::order::{greater, lesser};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::body::{Facet, FacetOrigin, Pieces, Polytope, Volume};
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::oracle::Frame;
use rigid_ccd::{Body, Pose, Solver, trajectory};
use std::sync::Arc;

fn random_vector(random: &mut Pcg64, size: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| random.random_range(-size..size)))
}

fn random_pose(random: &mut Pcg64, size: f64) -> Pose {
    let at = random_vector(random, size);
    Pose::new(at, DQuat::from_scaled_axis(random_vector(random, 2.0))).unwrap()
}

/// Returns a random body of about the size 0.2: a box, a ball, a capsule, or two triangles that are not in one plane.
fn random_body(random: &mut Pcg64) -> Body {
    match random.random_range(0..4) {
        0 => Body::cuboid([(); 3].map(|()| random.random_range(0.02..0.2))).unwrap(),
        1 => Body::sphere(random.random_range(0.02..0.2)).unwrap(),
        2 => Body::capsule(0.05, random.random_range(0.02..0.2)).unwrap(),
        _ => {
            let corners: Vec<DVec3> = (0..4).map(|_| random_vector(random, 0.2)).collect();
            let faces = [[0, 1, 2], [2, 1, 3]];
            let pieces = Pieces::triangles(&corners, &faces, &[0, 1]).unwrap();
            Body::new(&pieces, Volume::Surface).unwrap()
        }
    }
}

/// Returns a random tree of links with joints that turn, slide, are fixed, or follow the first one.
fn random_robot(random: &mut Pcg64) -> Robot {
    let count = random.random_range(3..8);
    let links = (0..count).map(|k| {
        let link = Link::named(format!("link{k}"));
        let pose = random_pose(random, 0.1);
        link.with_body(random_body(random), pose)
    });
    let links: Vec<Link> = links.collect();
    let joints = (1..count).map(|k| {
        let origin = random_pose(random, 0.5);
        let axis = random_vector(random, 1.0).to_array();
        let joint = match k % 4 {
            3 => trajectory::Joint::prismatic(origin, axis),
            2 if k == 6 => Ok(trajectory::Joint::fixed(origin)),
            _ => trajectory::Joint::revolute(origin, axis),
        };
        let position = match k {
            4 => Position::Follows {
                joint: "joint1".into(),
                multiplier: -1.5,
                offset: 0.2,
            },
            _ => Position::Free,
        };
        Joint {
            name: format!("joint{k}"),
            parent: format!("link{}", random.random_range(0..k)),
            child: format!("link{k}"),
            joint: joint.unwrap(),
            position,
        }
    });
    let joints = joints.collect();
    Robot::new(links, joints).unwrap()
}

fn random_cell(random: &mut Pcg64) -> Cell {
    let robot = random_robot(random);
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    for k in 0..random.random_range(0..12) {
        let (body, pose) = (random_body(random), random_pose(random, 1.5));
        cell.add_obstacle(format!("obstacle{k}"), body, pose)
            .unwrap();
    }
    cell
}

fn random_configuration(random: &mut Pcg64, robot: &Robot) -> Vec<f64> {
    let names = robot.joint_names();
    names.map(|_| random.random_range(-1.5..1.5)).collect()
}

/// Returns the least distance of all pairs that are checked at a configuration, by poses and distances of one pair after
/// another.
fn least_distance(cell: &Cell, configuration: &[f64]) -> f64 {
    let robot = cell.robot();
    let mut solver = Solver::new();
    let pose = |link: usize| {
        robot
            .pose(&robot.links()[link].name, configuration)
            .unwrap()
    };
    let mut least = f64::INFINITY;
    let mut measure = |a: (&Body, Pose), b: (&Body, Pose)| {
        least = lesser(least, solver.distance(a, b).unwrap().outcome.upper());
    };
    let poses: Vec<Pose> = (0..robot.links().len()).map(pose).collect();
    for (number, link) in robot.links().iter().enumerate() {
        for held in &link.bodies {
            let body = (&*held.body, poses[number].compose(&held.pose));
            for obstacle in &cell.bodies()[cell.robot_body_count()..] {
                // A body on the base never moves, and is not compared with obstacles.
                if cell.kinematics().link(number).0 > 0 {
                    measure(body, (&*obstacle.body, obstacle.pose));
                }
            }
        }
    }
    for [one, other] in LinkPairs::from_robot(robot).checked() {
        for a in &robot.links()[one].bodies {
            for b in &robot.links()[other].bodies {
                let at = |link: usize, pose: &Pose| poses[link].compose(pose);
                measure((&a.body, at(one, &a.pose)), (&b.body, at(other, &b.pose)));
            }
        }
    }
    least
}

fn between(from: &[f64], to: &[f64], share: f64) -> Vec<f64> {
    let ends = from.iter().zip(to);
    ends.map(|(from, to)| from + share * (to - from)).collect()
}

/// Tests random cells: on a free edge no sampled configuration is within the margin, and on another edge the pair that is
/// named is within margin + tolerance at the share that is named.
#[test]
fn edges_agree_with_sampled_configurations() {
    let mut random = Pcg64::seed_from_u64(3);
    let (mut free, mut contacts, mut closest) = (0, 0, f64::INFINITY);
    for _ in 0..150 {
        let cell = random_cell(&mut random);
        let margin = [0.0, 0.05][random.random_range(0..2)];
        let settings = Settings {
            margin,
            tolerance: 1e-4,
            ..Settings::DEFAULT
        };
        let mut edges = cell.edges().with_settings(settings);
        for _ in 0..8 {
            let from = random_configuration(&mut random, cell.robot());
            let reach = [0.05, 0.5, 1.0][random.random_range(0..3)];
            let to = between(
                &from,
                &random_configuration(&mut random, cell.robot()),
                reach,
            );
            match edges.any_contact(&from, &to).unwrap() {
                None => {
                    free += 1;
                    for k in 0..=12 {
                        let at = between(&from, &to, f64::from(k) / 12.0);
                        let distance = least_distance(&cell, &at);
                        assert!(distance > margin, "{distance} on a free edge");
                        closest = lesser(closest, distance - margin);
                    }
                }
                Some(contact) => {
                    contacts += 1;
                    let distance = least_distance(&cell, &between(&from, &to, contact.share));
                    assert!(
                        distance <= margin + 1e-4 + 1e-9,
                        "{distance} in {contact:?}"
                    );
                }
            }
        }
    }
    assert!(free > 200 && contacts > 200, "{free} {contacts}");
    assert!(closest < 2e-3, "{closest}: no free edge is close");
}

/// Tests that an edge is free or not whichever way it is passed, and that its parts are free if it is.
#[test]
fn an_edge_backward_and_its_halves_agree() {
    let mut random = Pcg64::seed_from_u64(4);
    let mut free = 0;
    for _ in 0..60 {
        let cell = random_cell(&mut random);
        let mut edges = cell.edges();
        let ends = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let [from, to] = &ends;
        let middle = between(from, to, 0.3);
        if edges.is_free(from, to).unwrap() {
            free += 1;
            assert!(edges.is_free(&middle, to).unwrap() && edges.is_free(from, &middle).unwrap());
        }
        if edges.is_free(from, to).unwrap() != edges.is_free(to, from).unwrap() {
            // Both answers are right only within the tolerance.
            let shares = (0..=400).map(|k| f64::from(k) / 400.0);
            let distances = shares.map(|share| least_distance(&cell, &between(from, to, share)));
            let least = distances.fold(f64::INFINITY, lesser);
            assert!(least > 0.0 && least < 0.05, "{least}");
        }
    }
    assert!(free > 5, "{free}");
}

/// Tests that frames are as near to the poses of links as the bound on rounding says, and that the bound is not a million
/// times too large.
#[test]
fn frames_are_within_the_bound_on_rounding() {
    let mut random = Pcg64::seed_from_u64(5);
    let mut largest_share = 0.0;
    for _ in 0..300 {
        let cell = random_cell(&mut random);
        let (robot, kinematics) = (cell.robot(), cell.kinematics());
        let configuration = random_configuration(&mut random, robot);
        let positions = kinematics
            .joints()
            .iter()
            .map(|joint| joint.source.position(&configuration));
        let positions: Vec<f64> = positions.collect();
        let mut frames = Vec::new();
        kinematics.place(positions.iter().copied(), &mut frames);
        let largest = positions.iter().map(|position| position.abs());
        let bound = point_error(kinematics, cell.parts(), largest);
        for part in &cell.parts()[..cell.robot_part_count()] {
            let link = cell.link_of(part.owner);
            let pose = robot
                .pose(&robot.links()[link].name, &configuration)
                .unwrap();
            let pose = pose.compose(&cell.pose_in_link(part.owner));
            let body = &cell.bodies()[part.owner].body;
            for &point in body.pieces().points() {
                let in_frame = cell.bodies()[part.owner].pose.transform_point(point);
                let found = frames[part.frame].point(in_frame);
                let share = found.distance(pose.transform_point(point)) / bound;
                largest_share = greater(largest_share, share);
            }
        }
    }
    assert!(
        largest_share < 1.0 && largest_share > 1e-4,
        "{largest_share}"
    );
}

/// Tests that no point of a part moves farther, as the base and each frame between see it, than the bound says.
#[test]
fn displacements_are_within_their_bounds() {
    let mut random = Pcg64::seed_from_u64(6);
    let mut largest_share = 0.0;
    for _ in 0..200 {
        let cell = random_cell(&mut random);
        let kinematics = cell.kinematics();
        let parts = &cell.parts()[..cell.robot_part_count()];
        let ends = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let half = random.random_range(0.01..0.5);
        let share = Shares::new(kinematics, &ends, 0.5);
        let mut displacements = Displacements::new(kinematics, parts);
        displacements.update(
            kinematics,
            parts,
            &share.frames,
            &share.rates,
            (half, 1e-12),
        );
        for _ in 0..10 {
            let later = Shares::new(kinematics, &ends, 0.5 + random.random_range(-half..half));
            for (number, part) in parts.iter().enumerate() {
                for seen_from in 0..part.frame {
                    let Some(slot) = displacements.slot(kinematics, number, seen_from) else {
                        continue;
                    };
                    let bound = displacements.bound(Some(slot));
                    for &point in &part.points {
                        let place = |frames: &[Frame]| {
                            frames[seen_from].inverse_point(frames[part.frame].point(point))
                        };
                        let moved = place(&share.frames).distance(place(&later.frames));
                        assert!(moved <= bound + 1e-12, "{moved} beyond {bound}");
                        if bound > 1e-6 {
                            largest_share = greater(largest_share, moved / bound);
                        }
                    }
                }
            }
        }
    }
    assert!(largest_share > 0.7, "{largest_share}");
}

/// The frames at a share of an edge, and the rates of its joints.
struct Shares {
    frames: Vec<Frame>,
    rates: Vec<f64>,
}

impl Shares {
    fn new(kinematics: &Kinematics, [from, to]: &[Vec<f64>; 2], share: f64) -> Self {
        let sources = kinematics.joints().iter().map(|joint| joint.source);
        let ends: Vec<[f64; 2]> = sources
            .map(|source| [source.position(from), source.position(to)])
            .collect();
        let mut frames = Vec::new();
        kinematics.place(
            ends.iter().map(|[from, to]| from + share * (to - from)),
            &mut frames,
        );
        let rates = ends.iter().map(|[from, to]| (to - from).abs()).collect();
        Shares { frames, rates }
    }
}

/// Tests that names of obstacles are unique, and that wrong configurations are refused.
#[test]
fn wrong_input_is_refused() {
    let mut random = Pcg64::seed_from_u64(7);
    let mut cell = random_cell(&mut random);
    let ball = || Body::sphere(0.1).unwrap();
    cell.add_obstacle("lamp", ball(), Pose::IDENTITY).unwrap();
    let error = cell
        .add_obstacle("lamp", ball(), Pose::IDENTITY)
        .unwrap_err();
    assert_eq!(error.to_string(), "two obstacles are named `lamp`");
    let start = random_configuration(&mut random, cell.robot());
    let mut edges = cell.edges();
    for wrong in [
        Vec::new(),
        vec![f64::NAN; start.len()],
        vec![f64::INFINITY; start.len()],
    ] {
        assert!(edges.is_free(&start, &wrong).is_err(), "{wrong:?}");
        assert!(edges.is_free(&wrong, &start).is_err(), "{wrong:?}");
    }
    for (margin, tolerance) in [(-0.1, 1e-3), (f64::NAN, 1e-3), (0.0, f64::NAN), (0.0, -1.0)] {
        let settings = Settings {
            margin,
            tolerance,
            ..Settings::DEFAULT
        };
        let mut edges = cell.edges().with_settings(settings);
        assert!(
            edges.is_free(&start, &start).is_err(),
            "{margin} {tolerance}"
        );
    }
}

/// Tests that a link which slides so far that its frame overflows is never free of an obstacle on its way.
#[test]
fn an_edge_beyond_all_numbers_is_never_free() {
    let rail = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joint = Joint {
        name: "rail".into(),
        parent: "base".into(),
        child: "cart".into(),
        joint: rail,
        position: Position::Free,
    };
    let cart = Link::named("cart").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    let robot = Robot::new(vec![Link::named("base"), cart], vec![joint]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let (wall, pose) = (
        Body::cuboid([0.1; 3]).unwrap(),
        Pose::at([1.0, 0.0, 0.0]).unwrap(),
    );
    cell.add_obstacle("wall", wall, pose).unwrap();
    for far in [1e30, 1e200, f64::MAX] {
        let free = cell.edges().is_free(&[-far], &[far]);
        assert!(!matches!(free, Ok(true)), "{far:e}");
    }
}

/// Tests that a polytope whose facets are wrong is as solid as its hull.
#[test]
fn wrong_facets_open_no_hole() {
    let corner = |k: usize| DVec3::from_array([0, 1, 2].map(|axis| (k >> axis & 1) as f64 - 0.5));
    let polytope = Polytope {
        points: (0..8).map(corner).collect(),
        // Only the lower side of the cube.
        facets: vec![Facet {
            origin: FacetOrigin::Virtual,
            corners: vec![0, 2, 3, 1],
        }],
        ..Polytope::default()
    };
    let cube = Body::new(&Pieces::polytopes(&[polytope]).unwrap(), Volume::Solid).unwrap();
    let placed = PlacedBody::new(Arc::new(cube), Pose::IDENTITY, 0);
    assert!(placed.body.has_surface());
    let corners = [DVec3::ZERO, 3.0 * DVec3::X, 3.0 * DVec3::Y, 3.0 * DVec3::Z];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let pieces = Pieces::triangles(&corners, &faces, &[0, 1, 2, 3]).unwrap();
    let large = Body::new(&pieces, Volume::Solid).unwrap();
    // It comes near the upper side, and not the lower one.
    let start = Pose::at([-0.3, -0.3, 3.0]).unwrap();
    let falls = rigid_ccd::Motion::new(start, [0.0, 0.0, -2.6], [0.0; 3]).unwrap();
    let cube = (&*placed.body, rigid_ccd::Motion::STILL);
    assert!(!Solver::new().is_free((&large, falls), cube, 1.0).unwrap());
}
