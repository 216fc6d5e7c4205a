//! Tests unusual and invalid inputs: names, settings, positions that overflow, and wrong facets.

use super::*;
use crate::cell::part::PlacedBody;
use rigid_ccd::body::{Facet, FacetOrigin, Polytope};
use rigid_ccd::glam::DQuat;

/// Tests that names are unique, and that invalid configurations are refused.
#[test]
fn wrong_input_is_refused() {
    let mut random = Pcg64::seed_from_u64(7);
    let mut cell = random_cell(&mut random);
    let ball = || Body::sphere(0.1).unwrap();
    cell.add_obstacle("lamp", ball(), Pose::IDENTITY).unwrap();
    let link = cell.robot().links()[0].name.clone();
    cell.attach("cup", ball(), (&link, Pose::IDENTITY), &[])
        .unwrap();
    for taken in ["lamp", "cup", &link] {
        let known =
            format!("there is already a link, an attached body or an obstacle named `{taken}`");
        let error = cell
            .add_obstacle(taken, ball(), Pose::IDENTITY)
            .unwrap_err();
        assert_eq!(error.to_string(), known);
        let error = cell
            .attach(taken, ball(), (&link, Pose::IDENTITY), &[])
            .unwrap_err();
        assert_eq!(error.to_string(), known);
    }
    cell.detach("cup").unwrap();
    let start = random_configuration(&mut random, cell.robot());
    let mut solver = cell.solver();
    for wrong in [
        Vec::new(),
        vec![f64::NAN; start.len()],
        vec![f64::INFINITY; start.len()],
    ] {
        assert!(solver.is_free(&[&start, &wrong]).is_err(), "{wrong:?}");
        assert!(solver.is_free(&[&wrong, &start]).is_err(), "{wrong:?}");
    }
    for (margin, tolerance) in [(-0.1, 1e-3), (f64::NAN, 1e-3), (0.0, f64::NAN), (0.0, -1.0)] {
        let settings = Settings {
            margin,
            tolerance,
            ..Settings::DEFAULT
        };
        let mut solver = cell.solver().with_settings(settings);
        assert!(
            solver.is_free(&[&start, &start]).is_err(),
            "{margin} {tolerance}"
        );
    }
}

/// Tests that an edge is not free if a link slides through an obstacle so far that its frame overflows.
#[test]
fn an_edge_beyond_all_numbers_is_never_free() {
    let rail = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joint = Joint {
        name: "rail".into(),
        parent: "base".into(),
        child: "cart".into(),
        geometry: rail,
        position_rule: PositionRule::Independent,
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
        let free = cell.solver().is_free(&[[-far], [far]]);
        assert!(!matches!(free, Ok(true)), "{far:e}");
    }
}

/// Tests that a polytope with wrong facets is as solid as its hull.
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
    let cube = Body::new(
        &Pieces::from_polytopes(&[polytope]).unwrap(),
        Solidity::Solid,
    )
    .unwrap();
    let placed = PlacedBody::new(Arc::new(cube), Pose::IDENTITY, 0, 1);
    assert!(placed.body.has_surface());
    let corners = [DVec3::ZERO, 3.0 * DVec3::X, 3.0 * DVec3::Y, 3.0 * DVec3::Z];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let pieces = Pieces::from_triangles(&corners, &faces, &[0, 1, 2, 3]).unwrap();
    let large = Body::new(&pieces, Solidity::Solid).unwrap();
    // The path comes near the upper side, but not the lower one.
    let start = Pose::at([-0.3, -0.3, 3.0]).unwrap();
    let falls = rigid_ccd::Motion::new(start, [0.0, 0.0, -2.6], [0.0; 3]).unwrap();
    let cube = (&*placed.body, rigid_ccd::Motion::STILL);
    assert!(!Solver::new().is_free((&large, falls), cube, 1.0).unwrap());
}

/// Tests two overlaps by about 1e-10, below rounding: of a mesh far from its origin, whose pose moves it back, and of
/// a ball whose joint has a multiplier and an offset that cancel.
#[test]
fn numbers_that_cancel_are_rounded_as_what_they_are() {
    let far = [
        [-801931.4252534474, -1324358.995628145, -248361.62209524855],
        [-801930.7452534473, -1324360.235628145, -248361.62209524855],
        [-801932.6652534474, -1324359.675628145, -248360.62209524855],
        [-801932.6652534474, -1324359.675628145, -248362.62209524855],
    ];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let pieces = Pieces::from_triangles(&far.map(DVec3::from), &faces, &[0, 1, 2, 3]).unwrap();
    let mesh = Body::new(&pieces, Solidity::Solid).unwrap();
    let back = [-1495925.4348739847, 399033.64946742874, 248361.62209524855];
    let back = Pose::new(back, DQuat::from_xyzw(0.0, 0.0, 0.8, 0.6)).unwrap();
    let slides = |name: &str, position| Joint {
        name: name.into(),
        parent: "base".into(),
        child: format!("{name} link"),
        geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap(),
        position_rule: position,
    };
    let ball = || Body::sphere(0.5).unwrap();
    let follows = PositionRule::Follows {
        joint: "x".into(),
        multiplier: 1000000.1,
        offset: -1e6,
    };
    for (body, pose, joints, obstacle, at) in [
        (
            mesh,
            back,
            vec![slides("x", PositionRule::Independent)],
            [-0.5000000000043645, 4.718003765447065e-12, 0.0],
            0.0,
        ),
        (
            ball(),
            Pose::IDENTITY,
            vec![slides("x", PositionRule::Independent), slides("y", follows)],
            [1.1000000108069037, 0.0, 0.0],
            1.0000000000000109,
        ),
    ] {
        let mut links = vec![Link::named("base")];
        links.extend(joints.iter().map(|joint| Link::named(&joint.child)));
        let last = links.pop().unwrap().with_body(body, pose);
        links.push(last);
        let robot = Robot::new(links, joints).unwrap();
        let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
        cell.add_obstacle("obstacle", ball(), Pose::at(obstacle).unwrap())
            .unwrap();
        let settings = Settings {
            tolerance: 1e-14,
            ..Settings::DEFAULT
        };
        let mut solver = cell.solver().with_settings(settings);
        assert!(!solver.is_free(&[[at]]).unwrap());
    }
}
