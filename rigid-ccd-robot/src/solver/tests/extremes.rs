//! Tests contacts that are missed if single precision is trusted too far: tiny robots, curves that jump, strange hulls.

use super::*;
use crate::JointCurve;
use rigid_ccd::body::Polytope;

/// Returns a cell with a body on a joint that slides along x from `origin`, and with an obstacle.
fn slider(origin: [f64; 3], body: Body, (obstacle, at): (Body, [f64; 3])) -> Cell {
    let links = vec![
        Link::named("base"),
        Link::named("slider").with_body(body, Pose::IDENTITY),
    ];
    let joint = Joint {
        name: "slide".into(),
        parent: "base".into(),
        child: "slider".into(),
        geometry: trajectory::Joint::prismatic(Pose::at(origin).unwrap(), [1.0, 0.0, 0.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    let robot = Robot::new(links, vec![joint]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    cell.add_obstacle("obstacle", obstacle, Pose::at(at).unwrap())
        .unwrap();
    cell
}

fn ball(radius: f64) -> Body {
    Body::sphere(radius).unwrap()
}

fn hull(points: Vec<DVec3>) -> Body {
    Body::polytope(Polytope {
        points,
        ..Polytope::default()
    })
    .unwrap()
}

fn touches<P: Path + ?Sized>(cell: &Cell, path: &P) -> bool {
    let mut solver = cell.solver();
    let is_free = solver.is_free(path).unwrap();
    let first = solver.first_contact(path).unwrap().outcome;
    assert_eq!(is_free, first == PathOutcome::Free);
    !is_free
}

#[test]
fn tiny_robots_are_not_lost_in_single_precision() {
    // The origin of the joint is tiny.
    let at = [9e-13, 0.0, 0.0];
    let cell = slider(at, ball(1e-13), (ball(1e-13), at));
    assert!(touches(&cell, &[[0.0], [1e-14]]));
    // Squares of the distances are below the least numbers.
    let cell = slider(
        [0.0; 3],
        ball(1.5e-23),
        (ball(1.5e-23), [2.9e-23, 0.0, 0.0]),
    );
    assert!(touches(&cell, &[[0.0], [1e-26]]));
}

/// The first segment ends at 1e-9, the second begins at 0.
#[test]
fn a_jump_of_a_curve_belongs_to_the_path() {
    let at = [2.009e-7, 0.0, 0.0];
    let cell = slider([0.0; 3], ball(1e-7), (ball(1e-7), at));
    let segments = [vec![vec![0.0, 1e-9]], vec![vec![0.0]]];
    let curve = JointCurve::from_polynomials(&[0.0, 1.0, 2.0], &segments).unwrap();
    let mut solver = cell.solver().with_settings(Settings {
        tolerance: 1e-12,
        ..Settings::DEFAULT
    });
    assert!(!solver.is_free(&curve).unwrap());
}

/// The hull of these points cannot be computed, because a coordinate is too small.
#[test]
fn a_body_without_a_hull_is_covered() {
    let corner = |x: f64, y: f64, z: f64| DVec3::new(0.5 * x, 0.1 * y, z);
    let corners: Vec<DVec3> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|x| [-1.0, 1.0].map(|y| [1e-95, 0.2].map(|z| corner(x, y, z))))
        .flatten()
        .collect();
    let body = hull(corners);
    let cell = slider([0.0; 3], body, (ball(0.01), [0.0, 0.1, 0.0]));
    assert!(touches(&cell, &[[0.0], [1e-6]]));
}

/// A triangle with a fourth point beside a corner is no rectangle.
#[test]
fn nearly_equal_corners_make_no_box() {
    let corners = [
        DVec3::ZERO,
        DVec3::X,
        DVec3::Y,
        DVec3::new(0.9e-12, 0.9e-12, 1.9e-12),
    ];
    let triangle = hull(corners.to_vec());
    let cell = slider([0.9, 0.9, 0.0], ball(0.1), (triangle, [0.0; 3]));
    assert!(!touches(&cell, &[[0.0], [1e-3]]));
}

/// In the last of many segments, eight intervals are so short that the last one has no length.
#[test]
fn intervals_without_length_are_left_out() {
    let cell = slider([0.0; 3], ball(1.0), (ball(1.0), [1002.005, 0.0, 0.0]));
    let path = vec![[1000.0]; 16386];
    assert!(!touches(&cell, &path[..]));
}

/// The midpoint of the last interval is rounded to the end of the path.
#[test]
fn a_contact_at_the_end_of_a_long_path_is_found() {
    let box_at = |x: f64| {
        let corners = (0..8).map(|k| {
            let coordinate = |bit: i32| if k >> bit & 1 == 1 { 0.5 } else { -0.5 };
            DVec3::new(x + coordinate(0), coordinate(1), coordinate(2))
        });
        Polytope {
            points: corners.collect(),
            ..Polytope::default()
        }
    };
    let pieces = Pieces::from_polytopes(&[box_at(-0.5), box_at(-3.0)]).unwrap();
    let body = Body::new(&pieces, Solidity::Solid).unwrap();
    let obstacle = Body::cuboid([0.5; 3]).unwrap();
    let cell = slider([0.0; 3], body, (obstacle, [0.5, 0.0, 0.0]));
    let mut path = vec![[-1.0]; 1025];
    path.push([0.0]);
    for tolerance in [1e-3, 1e-12] {
        let mut solver = cell.solver().with_settings(Settings {
            tolerance,
            ..Settings::DEFAULT
        });
        let PathOutcome::Contact(contact) = solver.first_contact(&path[..]).unwrap().outcome else {
            panic!("the last configuration touches");
        };
        assert_eq!(contact.at.segment, 1024);
        assert!(!solver.is_free(&path[..]).unwrap());
        let closest = solver.closest_approach(&path[..]).unwrap().outcome;
        assert!(closest.upper() <= 1e-9, "{closest:?}");
    }
}
