//! Random robots for tests, and a simple computation of link distances.

use crate::robot::{Joint, Link, PositionRule, Robot};
use ccd_core::order::lesser;
use rand::RngExt;
use rand_pcg::Pcg64;
use rigid_ccd::body::{Pieces, Solidity};
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{Body, Pose, Solver, trajectory};

pub(crate) fn random_vector(random: &mut Pcg64, size: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| random.random_range(-size..size)))
}

pub(crate) fn random_pose(random: &mut Pcg64, size: f64) -> Pose {
    let at = random_vector(random, size);
    Pose::new(at, DQuat::from_scaled_axis(random_vector(random, 2.0))).unwrap()
}

/// Returns a random body of a size of about 0.2: a box, a ball, a capsule, or two triangles that are not coplanar.
pub(crate) fn random_body(random: &mut Pcg64) -> Body {
    match random.random_range(0..4) {
        0 => Body::cuboid([(); 3].map(|()| random.random_range(0.02..0.2))).unwrap(),
        1 => Body::sphere(random.random_range(0.02..0.2)).unwrap(),
        2 => Body::capsule(0.05, random.random_range(0.02..0.2)).unwrap(),
        _ => {
            let corners: Vec<DVec3> = (0..4).map(|_| random_vector(random, 0.2)).collect();
            let faces = [[0, 1, 2], [2, 1, 3]];
            let pieces = Pieces::from_triangles(&corners, &faces, &[0, 1]).unwrap();
            Body::new(&pieces, Solidity::Surface).unwrap()
        }
    }
}

/// The links of [`row_of_links`].
pub(crate) const LINKS: [&str; 5] = ["base", "a", "b", "c", "d"];

/// Returns a serial arm with links at distances of 1. The links in `with_bodies` have a body.
pub(crate) fn row_of_links(links: &[&str], with_bodies: &[&str]) -> Robot {
    let link = |name: &&str| {
        if with_bodies.contains(name) {
            Link::named(*name).with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY)
        } else {
            Link::named(*name)
        }
    };
    let origin = Pose::at([1.0, 0.0, 0.0]).unwrap();
    let joints = links.windows(2).map(|pair| Joint {
        name: format!("to {}", pair[1]),
        parent: pair[0].into(),
        child: pair[1].into(),
        geometry: trajectory::Joint::revolute(origin, [0.0, 0.0, 1.0]).unwrap(),
        position_rule: PositionRule::Independent,
    });
    let joints = joints.collect();
    Robot::new(links.iter().map(link).collect(), joints).unwrap()
}

/// Returns a random tree of links. Its joints are revolute, prismatic, fixed or follow the first joint.
pub(crate) fn random_robot(random: &mut Pcg64) -> Robot {
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
            4 => PositionRule::Follows {
                joint: "joint1".into(),
                multiplier: -1.5,
                offset: 0.2,
            },
            _ => PositionRule::Independent,
        };
        Joint {
            name: format!("joint{k}"),
            parent: format!("link{}", random.random_range(0..k)),
            child: format!("link{k}"),
            geometry: joint.unwrap(),
            position_rule: position,
        }
    });
    let joints = joints.collect();
    Robot::new(links, joints).unwrap()
}

/// Returns a robot whose joints all have the limits `-limit` and `limit`.
pub(crate) fn with_symmetric_limits(robot: &Robot, limit: f64) -> Robot {
    let mut joints = robot.joints().to_vec();
    for joint in &mut joints {
        if !joint.geometry.is_fixed() {
            joint.geometry = joint.geometry.clone().with_limits(-limit..=limit);
        }
    }
    Robot::new(robot.links().to_vec(), joints).unwrap()
}

/// Returns the least distance between the bodies of two links at a configuration.
pub(crate) fn least_distance_of_links(robot: &Robot, links: [usize; 2], at: &[f64]) -> f64 {
    let [one, other] = links.map(|link| {
        let link = &robot.links()[link];
        let pose = robot.pose(&link.name, at).unwrap();
        let bodies = link.bodies.iter();
        let placed =
            bodies.map(|link_body| (link_body.body.clone(), pose.compose(&link_body.pose)));
        placed.collect::<Vec<_>>()
    });
    let mut solver = Solver::new();
    let mut least = f64::INFINITY;
    for (a, pose_a) in &one {
        for (b, pose_b) in &other {
            let found = solver.distance((&**a, *pose_a), (&**b, *pose_b)).unwrap();
            least = lesser(least, found.outcome.upper());
        }
    }
    least
}

/// Returns a cell of one static link with a body.
pub(crate) fn cell_of_body(body: Body) -> crate::cell::Cell {
    let link = Link::named("body").with_body(body, Pose::IDENTITY);
    let robot = Robot::new(vec![link], vec![]).unwrap();
    let pairs = crate::pairs::LinkPairs::from_robot(&robot);
    crate::cell::Cell::new(robot, pairs)
}
