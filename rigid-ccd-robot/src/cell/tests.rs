//! Tests of changes to a cell: obstacles, attached bodies, paddings and clearances.

use super::*;
use crate::error::PathError;
use crate::path_answer::PathOutcome;
use crate::robot::{Joint, Link, PositionRule};
use rigid_ccd::trajectory;

/// Returns a cart with a ball of radius 0.1 on a rail along x, and a second link with such a ball at (0, 1, 0).
fn cart_cell() -> Cell {
    let ball = || Body::sphere(0.1).unwrap();
    let links = vec![
        Link::named("base"),
        Link::named("cart").with_body(ball(), Pose::IDENTITY),
        Link::named("post").with_body(ball(), Pose::IDENTITY),
    ];
    let slide = |name: &str, child: &str, y: f64| Joint {
        name: name.into(),
        parent: "base".into(),
        child: child.into(),
        geometry: trajectory::Joint::prismatic(Pose::at([0.0, y, 0.0]).unwrap(), [1.0, 0.0, 0.0])
            .unwrap(),
        position_rule: PositionRule::Independent,
    };
    let joints = vec![slide("rail", "cart", 0.0), slide("side", "post", 1.0)];
    let robot = Robot::new(links, joints).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    Cell::new(robot, pairs)
}

/// Returns the position at which the cart first touches something on the way to 10, and the touching pair.
fn stop(cell: &Cell) -> Option<(f64, [Item<'_>; 2])> {
    match cell
        .solver()
        .first_contact(&[[0.0, 0.0], [10.0, 0.0]])
        .unwrap()
        .outcome
    {
        PathOutcome::Free => None,
        PathOutcome::Contact(contact) => Some((10.0 * contact.at.fraction, contact.items)),
        _ => panic!("a limit was reached"),
    }
}

fn assert_stops_at(cell: &Cell, position: f64, between: [Item<'_>; 2]) {
    let (found, pair) = stop(cell).expect("the cart meets something");
    assert!(
        (found - position).abs() <= 1e-3 && found <= position,
        "{found}"
    );
    assert_eq!(pair, between);
}

#[test]
fn obstacles_are_moved_and_removed() {
    let mut cell = cart_cell();
    let wall = Body::cuboid([0.1, 1.0, 1.0]).unwrap();
    let at = |x: f64| Pose::at([x, 0.0, 0.0]).unwrap();
    cell.add_obstacle("far", Body::sphere(0.5).unwrap(), at(8.0))
        .unwrap();
    cell.add_obstacle("wall", wall, at(5.0)).unwrap();
    let [cart, wall, far] = [
        Item::Link("cart"),
        Item::Obstacle("wall"),
        Item::Obstacle("far"),
    ];
    assert_stops_at(&cell, 4.8, [cart, wall]);
    cell.move_obstacle("wall", at(6.0)).unwrap();
    assert_stops_at(&cell, 5.8, [cart, wall]);
    cell.set_clearance([cart, far], 1.0).unwrap();
    cell.remove_obstacle("wall").unwrap();
    assert_stops_at(&cell, 6.4, [cart, far]);
    cell.remove_obstacle("far").unwrap();
    assert_eq!(stop(&cell), None);
    let error = cell.remove_obstacle("far").unwrap_err();
    assert_eq!(error.to_string(), "there is no obstacle `far`");
}

#[test]
fn attached_bodies_move_with_their_link() {
    let mut cell = cart_cell();
    let rod = Body::capsule(0.05, 0.5).unwrap();
    cell.add_obstacle(
        "wall",
        Body::cuboid([0.1; 3]).unwrap(),
        Pose::at([5.0, 0.0, 1.0]).unwrap(),
    )
    .unwrap();
    assert_eq!(stop(&cell), None);
    let upright = Pose::at([0.0, 0.0, 0.6]).unwrap();
    cell.attach("rod", rod, ("cart", upright), &[]).unwrap();
    let [rod, wall] = [Item::Attached("rod"), Item::Obstacle("wall")];
    assert_stops_at(&cell, 4.85, [rod, wall]);
    // Attaching and detaching another body does not change the obstacle's clearances.
    cell.set_clearance([rod, wall], 0.5).unwrap();
    assert_stops_at(&cell, 4.35, [rod, wall]);
    let plate = Body::cuboid([0.1, 1.2, 0.1]).unwrap();
    let ahead = Pose::at([2.0, 0.0, 0.0]).unwrap();
    cell.attach("plate", plate, ("cart", ahead), &[]).unwrap();
    assert_stops_at(&cell, 4.35, [rod, wall]);
    // The plate collides with the other link, unless that contact is allowed.
    let back = [[0.0, 0.0], [-4.0, 0.0]];
    assert!(!cell.solver().is_free(&back).unwrap());
    cell.detach("plate").unwrap();
    assert!(cell.solver().is_free(&back).unwrap());
    let plate = Body::cuboid([0.1, 1.2, 0.1]).unwrap();
    cell.attach("plate", plate, ("cart", ahead), &["post"])
        .unwrap();
    assert!(cell.solver().is_free(&back).unwrap());
    cell.detach("rod").unwrap();
    cell.detach("plate").unwrap();
    assert_eq!(stop(&cell), None);
    let error = cell.detach("rod").unwrap_err();
    assert_eq!(error.to_string(), "there is no attached body `rod`");
}

#[test]
fn paddings_keep_obstacles_away_but_not_links() {
    let mut cell = cart_cell();
    let wall = Body::cuboid([0.1, 0.5, 0.5]).unwrap();
    cell.add_obstacle("wall", wall, Pose::at([5.0, 0.0, 0.0]).unwrap())
        .unwrap();
    let [cart, wall] = [Item::Link("cart"), Item::Obstacle("wall")];
    cell.set_padding("cart", 0.25).unwrap();
    assert_stops_at(&cell, 4.55, [cart, wall]);
    // The other link is 0.8 away at the start.
    cell.set_padding("cart", 1.0).unwrap();
    assert_stops_at(&cell, 3.8, [cart, wall]);
    cell.set_clearance([wall, cart], 0.0).unwrap();
    assert_stops_at(&cell, 4.8, [cart, wall]);
    for wrong in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(cell.set_padding("cart", wrong).is_err());
        assert!(cell.set_clearance([wall, cart], wrong).is_err());
    }
    assert!(cell.set_padding("wall", 0.1).is_err());
    let unknown = cell
        .set_clearance([Item::Link("wall"), cart], 0.1)
        .unwrap_err();
    assert_eq!(unknown.to_string(), "there is no link `wall`");
}

#[test]
fn a_clearance_includes_a_pair_of_neighbours() {
    let hinge = Joint {
        name: "hinge".into(),
        parent: "frame".into(),
        child: "lever".into(),
        geometry: trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    let ball = |x: f64| (Body::sphere(0.1).unwrap(), Pose::at([x, 0.0, 0.0]).unwrap());
    let (stop, end) = (ball(-0.5), ball(0.5));
    let links = vec![
        Link::named("frame").with_body(stop.0, stop.1),
        Link::named("lever").with_body(end.0, end.1),
    ];
    let robot = Robot::new(links, vec![hinge]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let error = cell.solver().is_free(&[[0.0], [3.1]]).unwrap_err();
    assert!(matches!(error, PathError::NothingCompared(_)), "{error}");
    let pair = [Item::Link("frame"), Item::Link("lever")];
    cell.set_clearance(pair, 0.0).unwrap();
    cell.check_any_compared().unwrap();
    assert!(!cell.solver().is_free(&[[0.0], [3.1]]).unwrap());
    assert!(cell.solver().is_free(&[[0.0], [1.5]]).unwrap());
}

/// Tests that a coordinate that is too large gives an error with the name of its element.
#[test]
fn coordinates_that_are_too_large_are_named() {
    let far = Pose::at([0.0, 1e30, 0.0]).unwrap();
    let ball = || Body::sphere(0.1).unwrap();
    let slide = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let robot = |at: Pose, joint: trajectory::Joint| {
        let links = vec![
            Link::named("rail"),
            Link::named("cart").with_body(ball(), at),
        ];
        let joint = Joint {
            name: "drive".into(),
            parent: "rail".into(),
            child: "cart".into(),
            geometry: joint,
            position_rule: PositionRule::Independent,
        };
        Robot::new(links, vec![joint])
    };
    let message = |error: &dyn std::fmt::Display| error.to_string();
    let error = message(&robot(far, slide.clone()).unwrap_err());
    assert!(
        error.starts_with("a body of link `cart` has a coordinate of 1"),
        "{error}"
    );
    let error = message(&robot(Pose::IDENTITY, trajectory::Joint::fixed(far)).unwrap_err());
    assert!(
        error.starts_with("joint `drive` has a coordinate of 1"),
        "{error}"
    );
    let robot = robot(Pose::IDENTITY, slide).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    let error = message(&cell.add_obstacle("post", ball(), far).unwrap_err());
    assert!(
        error.starts_with("obstacle `post` has a coordinate of 1"),
        "{error}"
    );
    cell.add_obstacle("post", ball(), Pose::IDENTITY).unwrap();
    assert!(cell.move_obstacle("post", far).is_err());
    let error = message(&cell.attach("tool", ball(), ("cart", far), &[]).unwrap_err());
    assert!(
        error.starts_with("attached body `tool` has a coordinate of 1"),
        "{error}"
    );
    let error = message(&cell.solver().is_free(&[[0.0], [1e30]]).unwrap_err());
    assert!(
        error.contains("joint `drive`: ") && error.contains("position"),
        "{error}"
    );
}
