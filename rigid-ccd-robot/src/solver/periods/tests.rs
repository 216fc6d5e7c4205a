//! Tests which pairs have periods, and that searching one period gives the answer for all.

use super::*;
use crate::cell::Cell;
use crate::pairs::LinkPairs;
use crate::path_answer::{PathContact, PathOutcome};
use crate::robot::{Joint, Link, PositionRule, Robot};
use rigid_ccd::body::{Pieces, Solidity};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Pose, Settings, trajectory};

/// Returns a gear with pointed teeth: a star-shaped plate of triangles that stand upright.
fn gear(radius: f64, teeth: usize, phase: f64) -> Body {
    let tooth = 0.1;
    let corner = |k: usize, z: f64| {
        let angle = phase + TAU * k as f64 / (2 * teeth) as f64;
        let at = if k.is_multiple_of(2) {
            radius + tooth
        } else {
            radius - tooth
        };
        DVec3::new(at * angle.cos(), at * angle.sin(), z)
    };
    let count = 2 * teeth;
    let corners: Vec<DVec3> = [-0.05, 0.05]
        .into_iter()
        .flat_map(|z| (0..count).map(move |k| corner(k, z)))
        .collect();
    let faces: Vec<[u32; 3]> = (0..count)
        .flat_map(|k| {
            let next = (k + 1) % count;
            [[k, next, k + count], [next, next + count, k + count]]
        })
        .map(|face| face.map(|corner| corner as u32))
        .collect();
    let labels: Vec<u32> = (0..faces.len() as u32).collect();
    let pieces = Pieces::from_triangles(&corners, &faces, &labels).unwrap();
    Body::new(&pieces, Solidity::Surface).unwrap()
}

fn hinge(name: &str, child: &str, at: f64, position_rule: PositionRule) -> Joint {
    let origin = Pose::at([at, 0.0, 0.0]).unwrap();
    Joint {
        name: name.into(),
        parent: "frame".into(),
        child: child.into(),
        geometry: trajectory::Joint::revolute(origin, [0.0, 0.0, 1.0]).unwrap(),
        position_rule,
    }
}

/// Returns two meshing gears with 8 and 12 teeth, with some play.
fn gears(multiplier: f64, play: f64) -> Cell {
    let wheel = PositionRule::Follows {
        joint: "pinion".into(),
        multiplier,
        offset: 0.0,
    };
    let joints = vec![
        hinge("pinion", "small", 0.0, PositionRule::Independent),
        hinge("wheel", "large", 1.0 + play, wheel),
    ];
    let half_tooth = TAU / 24.0;
    let links = vec![
        Link::named("frame"),
        Link::named("small").with_body(gear(0.4, 8, 0.0), Pose::IDENTITY),
        Link::named("large").with_body(gear(0.6, 12, 0.5 * TAU + half_tooth), Pose::IDENTITY),
    ];
    let robot = Robot::new(links, joints).unwrap();
    Cell::new(robot.clone(), LinkPairs::from_robot(&robot))
}

fn turns(count: f64) -> [[f64; 1]; 2] {
    [[0.3], [0.3 + TAU * count]]
}

fn settings() -> Settings {
    Settings {
        tolerance: 1e-4,
        ..Settings::DEFAULT
    }
}

/// Tests that many turns take little more work than one period and have the same distance.
#[test]
fn gears_over_many_turns_are_measured_by_one_period() {
    let cell = gears(-2.0 / 3.0, 0.15);
    let mut solver = cell.solver().with_settings(settings());
    let of_period = solver.closest_approach(&turns(3.0)).unwrap().outcome;
    let work = solver.search.stop_condition.work();
    assert!(
        of_period.limit().is_none() && of_period.lower() > 0.01,
        "{of_period:?}"
    );
    for count in [30.0, 3000.0] {
        let found = solver.closest_approach(&turns(count)).unwrap().outcome;
        assert!(found.limit().is_none(), "{found:?}");
        assert!(
            found.lower() <= of_period.upper() && of_period.lower() <= found.upper(),
            "{found:?} {of_period:?}"
        );
        assert_eq!(solver.met_tolerance(), 1e-4);
        let all = solver.search.stop_condition.work();
        assert!(all <= 3 * work, "{all} instead of {work} for {count} turns");
    }
    let margin = Settings {
        margin: of_period.lower() - 2e-4,
        ..settings()
    };
    solver.set_settings(margin);
    assert!(solver.is_free(&turns(3000.0)).unwrap());
    assert_eq!(
        solver.first_contact(&turns(3000.0)).unwrap().outcome,
        PathOutcome::Free
    );
}

/// Tests that a contact after many turns is found if the rates have no common period: one gear turns slightly less
/// than a tooth each time.
#[test]
fn rates_without_a_period_are_searched() {
    // In each turn of the pinion the phase shifts by a fiftieth of a tooth.
    let cell = gears(-(2.0 + 0.005) / 3.0, 0.02);
    let mut solver = cell.solver().with_settings(settings());
    let outcome = solver.first_contact(&turns(30.0)).unwrap().outcome;
    let PathOutcome::Contact(PathContact { at, .. }) = outcome else {
        panic!("{outcome:?}");
    };
    let before = [[0.3], [0.3 + TAU * 30.0 * (at.fraction - 1e-3)]];
    assert_eq!(
        solver.first_contact(&before).unwrap().outcome,
        PathOutcome::Free
    );
}

/// Tests that the first contact of a pair is found in its first period, while the search of another pair without a
/// period continues.
#[test]
fn each_pair_has_its_own_period() {
    let slide = Joint {
        geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
        ..hinge("slide", "ball", 0.0, PositionRule::Independent)
    };
    let joints = vec![hinge("turn", "arm", 0.0, PositionRule::Independent), slide];
    let ball = || Body::sphere(0.1).unwrap();
    let links = vec![
        Link::named("frame"),
        Link::named("arm").with_body(ball(), Pose::at([1.0, 0.0, 0.0]).unwrap()),
        Link::named("ball").with_body(ball(), Pose::at([3.0, 0.0, 0.0]).unwrap()),
    ];
    let robot = Robot::new(links, joints).unwrap();
    let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
    let at = |x: f64, z: f64| Pose::at([x, 0.0, z]).unwrap();
    cell.add_obstacle("beside", ball(), at(1.5, 0.0)).unwrap();
    cell.add_obstacle("above", ball(), at(3.0, 1.0)).unwrap();
    let path = [[0.5, 0.0], [0.5 + 40.0 * TAU, 1.0]];
    let mut solver = cell.solver().with_settings(settings());
    // The slide comes near after 0.8 of the segment.
    let PathOutcome::Contact(contact) = solver.first_contact(&path).unwrap().outcome else {
        panic!("the slide reaches the ball above it");
    };
    assert!((contact.at.fraction - 0.8).abs() < 1e-4, "{contact:?}");
    solver.set_settings(Settings {
        margin: 0.31,
        ..settings()
    });
    // The arm passes the ball beside it at a distance of 0.3, at the end of its first turn.
    let PathOutcome::Contact(contact) = solver.first_contact(&path).unwrap().outcome else {
        panic!("the arm comes near the ball beside it");
    };
    assert_eq!(
        contact.items.map(|item| item.name().to_owned()),
        ["arm", "beside"]
    );
    assert!(contact.at.fraction < 1.0 / 40.0, "{contact:?}");
}
