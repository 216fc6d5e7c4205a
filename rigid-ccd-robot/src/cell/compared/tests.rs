//! Tests which contacts are allowed, for how long, and that no others are.

use super::*;
use crate::pairs::LinkPairs;
use crate::robot::{Joint, Link, PositionRule, Robot};
use rigid_ccd::{Body, Pose, trajectory};

/// Returns two carts on parallel rails along x, a distance of 1 apart, with a table and a post around them.
fn cell() -> Cell {
    let cart =
        |name: &str| Link::named(name).with_body(Body::cuboid([0.1; 3]).unwrap(), Pose::IDENTITY);
    let rail = |name: &str, y: f64| Joint {
        name: format!("rail {name}"),
        parent: "base".into(),
        child: name.into(),
        geometry: trajectory::Joint::prismatic(at([0.0, y, 0.0]), [1.0, 0.0, 0.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    let links = vec![Link::named("base"), cart("red"), cart("blue")];
    let robot = Robot::new(links, vec![rail("red", 0.0), rail("blue", 1.0)]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    for (name, position) in [("post", [1.0, 0.0, 0.0]), ("wall", [1.0, 1.0, 0.0])] {
        let body = Body::cuboid([0.1; 3]).unwrap();
        cell.add_obstacle(name, body, at(position)).unwrap();
    }
    cell
}

fn at(position: [f64; 3]) -> Pose {
    Pose::at(position).unwrap()
}

/// Returns the names of all pairs in contact on the path: first the red cart moves by 2, then the blue one.
fn contacts(cell: &Cell) -> Vec<String> {
    let mut found = Vec::new();
    let mut rest = cell.clone();
    for path in [[[0.0, 0.0], [2.0, 0.0]], [[0.0, 0.0], [0.0, 2.0]]] {
        while let Some(contact) = {
            let solver = &mut rest.solver();
            solver
                .any_contact(&path)
                .unwrap()
                .contact()
                .unwrap()
                .map(|contact| contact.items.map(|item| item.name().to_owned()))
        } {
            let [a, b] = &contact;
            found.push(format!("{a} {b}"));
            let pair = [a, b].map(|name| rest.item_named(name).unwrap());
            rest.allow_contact(pair).unwrap();
        }
    }
    found.sort();
    found
}

const RED_POST: [Item<'_>; 2] = [Item::Link("red"), Item::Obstacle("post")];

#[test]
fn an_allowed_contact_is_the_only_one() {
    let mut cell = cell();
    assert_eq!(contacts(&cell), ["blue wall", "red post"]);
    cell.allow_contact(RED_POST).unwrap();
    assert_eq!(contacts(&cell), ["blue wall"]);
    assert_eq!(cell.allowed_contacts(), [RED_POST]);
    // Attaching a body changes the indices of the obstacles.
    cell.attach(
        "can",
        Body::sphere(0.05).unwrap(),
        ("red", at([0.0, 1.0, 0.2])),
        &[],
    )
    .unwrap();
    cell.add_obstacle(
        "floor",
        Body::cuboid([9.0, 9.0, 0.1]).unwrap(),
        at([0.0, 0.0, -5.0]),
    )
    .unwrap();
    assert_eq!(cell.allowed_contacts(), [RED_POST]);
    assert_eq!(contacts(&cell), ["blue wall"]);
    cell.forbid_contact(RED_POST).unwrap();
    assert_eq!(contacts(&cell), ["blue wall", "red post"]);
    // A clearance forbids the contact as well.
    cell.allow_contact(RED_POST).unwrap();
    cell.set_clearance(RED_POST, 0.0).unwrap();
    assert_eq!(contacts(&cell), ["blue wall", "red post"]);
}

#[test]
fn what_is_removed_takes_its_allowances_away() {
    let mut cell = cell();
    let post = |cell: &mut Cell| {
        cell.add_obstacle("post", Body::cuboid([0.1; 3]).unwrap(), at([1.0, 0.0, 0.0]))
    };
    cell.allow_contact(RED_POST).unwrap();
    cell.remove_obstacle("post").unwrap();
    post(&mut cell).unwrap();
    assert_eq!(contacts(&cell), ["blue wall", "red post"]);

    let rod = || Body::cuboid([0.05, 0.6, 0.05]).unwrap();
    let ahead = ("red", at([0.3, 0.75, 0.0]));
    cell.attach("rod", rod(), ahead, &["wall", "blue", "post"])
        .unwrap();
    assert_eq!(contacts(&cell), ["blue wall", "red post"]);
    cell.detach("rod").unwrap();
    cell.attach("rod", rod(), ahead, &["blue"]).unwrap();
    assert_eq!(contacts(&cell), ["blue wall", "red post", "rod wall"]);
}

#[test]
fn held_objects_touch_each_other_only_if_they_may() {
    let mut cell = cell();
    let can = || Body::sphere(0.2).unwrap();
    let beside = |y: f64| at([-0.5, y, 0.0]);
    cell.attach("a", can(), ("red", beside(0.4)), &[]).unwrap();
    // The body may touch the link, but not a body attached to the link.
    cell.attach("b", can(), ("blue", beside(-0.4)), &["red"])
        .unwrap();
    assert!(
        contacts(&cell).contains(&"b a".to_owned()),
        "{:?}",
        contacts(&cell)
    );
    cell.detach("b").unwrap();
    cell.attach("b", can(), ("blue", beside(-0.4)), &["a"])
        .unwrap();
    assert!(
        !contacts(&cell).contains(&"b a".to_owned()),
        "{:?}",
        contacts(&cell)
    );
}

#[test]
fn two_links_are_allowed_as_a_pair_that_is_not_checked() {
    let mut cell = cell();
    let links = [Item::Link("red"), Item::Link("blue")];
    assert_eq!(cell.link_pairs().checked_pairs().count(), 1);
    cell.allow_contact(links).unwrap();
    assert_eq!(cell.link_pairs().checked_pairs().count(), 0);
    assert!(
        cell.check_summary()
            .to_string()
            .contains("1 not (disabled: contact allowed)")
    );
    cell.forbid_contact(links).unwrap();
    assert_eq!(cell.link_pairs().checked_pairs().count(), 1);
}

#[test]
fn what_is_never_compared_is_not_allowed() {
    let mut cell = cell();
    let never = [
        [Item::Obstacle("post"), Item::Obstacle("wall")],
        [Item::Link("red"), Item::Link("red")],
        [Item::Link("base"), Item::Obstacle("post")],
    ];
    for pair in never {
        for changed in [cell.allow_contact(pair), cell.forbid_contact(pair)] {
            assert!(
                matches!(changed, Err(RobotError::NeverCompared { .. })),
                "{pair:?}"
            );
        }
    }
    // Allowing a contact of links that are unchecked anyway is accepted, as in an SRDF that disables adjacent links.
    let before = cell.check_summary().to_string();
    cell.allow_contact([Item::Link("base"), Item::Link("red")])
        .unwrap();
    assert_eq!(cell.check_summary().to_string(), before);
    for name in ["", "post"] {
        let body = Body::sphere(0.1).unwrap();
        let error = cell.add_obstacle(name, body, Pose::IDENTITY).unwrap_err();
        match name {
            "" => assert_eq!(error, RobotError::EmptyName),
            _ => assert!(matches!(error, RobotError::NameTaken { .. })),
        }
    }
    let unknown = [Item::Link("red"), Item::Obstacle("pots")];
    let error = cell.allow_contact(unknown).unwrap_err().to_string();
    assert_eq!(error, "there is no obstacle `pots`");
    let can = Body::sphere(0.1).unwrap();
    let error = cell
        .attach("can", can, ("red", Pose::IDENTITY), &["tabel"])
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "there is no link, attached body or obstacle `tabel`"
    );
    assert_eq!(cell.attached_names().count(), 0);
    let error = cell.set_clearance(RED_POST, -0.01).unwrap_err().to_string();
    assert!(error.contains("start policy `leave`"), "{error}");
}

#[test]
fn a_cell_in_which_all_is_allowed_answers_nothing() {
    let mut cell = cell();
    cell.check_any_compared().unwrap();
    for obstacle in ["post", "wall"] {
        for link in ["red", "blue"] {
            cell.allow_contact([Item::Link(link), Item::Obstacle(obstacle)])
                .unwrap();
        }
    }
    cell.allow_contact([Item::Link("red"), Item::Link("blue")])
        .unwrap();
    let text = cell.check_any_compared().unwrap_err().to_string();
    assert!(text.contains("2 obstacles, 4 contacts allowed"), "{text}");
    assert_eq!(cell.compared_pairs(0.0).count(), 0);
}
