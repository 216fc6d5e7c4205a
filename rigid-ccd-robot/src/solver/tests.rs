//! Tests paths in random cells against sampled configurations.

mod bounds;
mod budgets;
mod extremes;
mod features;
mod history;
mod hostile_edges;
mod inputs;
mod questions;
mod start;
mod tolerances;
mod twin;

use super::*;
use crate::JointCurve;
use crate::pairs::LinkPairs;
use crate::path::joint_path::JointPath;
use crate::robot::{Joint, Link, PositionRule, Robot};
use crate::test_robots::{random_body, random_pose, random_robot};
use ccd_core::order::{greater, lesser};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::body::{Pieces, Solidity};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Pose, Solver, trajectory};
use std::sync::Arc;

pub(crate) fn random_cell(random: &mut Pcg64) -> Cell {
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

pub(crate) fn random_configuration(random: &mut Pcg64, robot: &Robot) -> Vec<f64> {
    let names = robot.independent_joint_names();
    names.map(|_| random.random_range(-1.5..1.5)).collect()
}

/// Returns a path of one segment between two configurations, every other one curved.
pub(crate) fn random_segment(random: &mut Pcg64, cell: &Cell, ends: [&Vec<f64>; 2]) -> JointPath {
    let mut path = JointPath::default();
    if random.random_range(0..2) == 0 {
        path.set_configurations(cell.kinematics(), &ends);
    } else {
        let velocities = [(); 2].map(|()| random_configuration(random, cell.robot()));
        let curve =
            JointCurve::cubic_hermite(&[0.0, 1.0], &ends, &[&velocities[0], &velocities[1]]);
        let curve = curve.unwrap();
        path.set_curve(cell.kinematics(), &curve);
    }
    path
}

/// Returns the least distance of all checked pairs at a configuration, from the distances of single pairs.
pub(crate) fn least_distance(cell: &Cell, configuration: &[f64]) -> f64 {
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
        for link_body in &link.bodies {
            let body = (&*link_body.body, poses[number].compose(&link_body.pose));
            for obstacle in &cell.bodies()[cell.robot_body_count()..] {
                // A static body is not checked against obstacles.
                if cell.kinematics().link_frame_and_pose(number).0 > 0 {
                    measure(body, (&*obstacle.body, obstacle.pose));
                }
            }
        }
    }
    for [one, other] in cell.link_pairs().checked_pairs() {
        for a in &robot.links()[one].bodies {
            for b in &robot.links()[other].bodies {
                let at = |link: usize, pose: &Pose| poses[link].compose(pose);
                measure((&a.body, at(one, &a.pose)), (&b.body, at(other, &b.pose)));
            }
        }
    }
    least
}

pub(crate) fn configuration_between(from: &[f64], to: &[f64], fraction: f64) -> Vec<f64> {
    let ends = from.iter().zip(to);
    ends.map(|(from, to)| from + fraction * (to - from))
        .collect()
}

/// Tests random cells: no sample of a free edge is within the margin. On any other edge the reported pair is within
/// margin + tolerance at the reported point.
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
        let mut solver = cell.solver().with_settings(settings);
        for _ in 0..8 {
            let from = random_configuration(&mut random, cell.robot());
            let reach = [0.05, 0.5, 1.0][random.random_range(0..3)];
            let to = configuration_between(
                &from,
                &random_configuration(&mut random, cell.robot()),
                reach,
            );
            match solver
                .any_contact(&[&from, &to])
                .unwrap()
                .contact()
                .unwrap()
            {
                None => {
                    free += 1;
                    for k in 0..=12 {
                        let at = configuration_between(&from, &to, f64::from(k) / 12.0);
                        let distance = least_distance(&cell, &at);
                        assert!(distance > margin, "{distance} on a free edge");
                        closest = lesser(closest, distance - margin);
                    }
                }
                Some(contact) => {
                    contacts += 1;
                    let distance = least_distance(
                        &cell,
                        &configuration_between(&from, &to, contact.at.fraction),
                    );
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

/// Tests that an edge and its reverse have the same answer, and that the halves of a free edge are free.
#[test]
fn an_edge_backward_and_its_halves_agree() {
    let mut random = Pcg64::seed_from_u64(4);
    let mut free = 0;
    for _ in 0..60 {
        let cell = random_cell(&mut random);
        let mut solver = cell.solver();
        let ends = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let [from, to] = &ends;
        let middle = configuration_between(from, to, 0.3);
        if solver.is_free(&[from, to]).unwrap() {
            free += 1;
            assert!(
                solver.is_free(&[&middle, to]).unwrap()
                    && solver.is_free(&[from, &middle]).unwrap()
            );
        }
        if solver.is_free(&[from, to]).unwrap() != solver.is_free(&[to, from]).unwrap() {
            // Answers may differ within the tolerance.
            let fractions = (0..=400).map(|k| f64::from(k) / 400.0);
            let distances = fractions
                .map(|fraction| least_distance(&cell, &configuration_between(from, to, fraction)));
            let least = distances.fold(f64::INFINITY, lesser);
            assert!(least > 0.0 && least < 0.05, "{least}");
        }
    }
    assert!(free > 5, "{free}");
}
