//! Compares the referee, which judges everything else, with closed forms.

use ccd_core::glam::DVec3;
use ccd_tests::analytic::{Expect, scenes};
use ccd_tests::models::{Mesh, cuboid};
use ccd_tests::query::{Actor, Query};
use ccd_tests::referee::{Finding, Referee, contains};

#[test]
fn it_brackets_every_closed_form() {
    let meshed = |scene: &ccd_tests::analytic::Scene| !scene.query.a.shape.mesh.faces.is_empty();
    for scene in scenes().iter().filter(|scene| meshed(scene)) {
        let referee = Referee::new(&scene.query);
        let finding = referee.finding();
        let name = &scene.name;
        match (&scene.expect, finding) {
            (Expect::Hit { earliest, latest }, Finding::Hit { lo, hi }) => {
                assert!(lo <= latest + 1e-12, "{name}: {lo} > {latest}");
                assert!(
                    hi >= earliest(0.0) - 1e-12,
                    "{name}: {hi} < {}",
                    earliest(0.0)
                );
                assert!(hi - lo <= 1e-4, "{name}: {lo} to {hi}");
            }
            (Expect::Free { gap }, Finding::Free { gap: seen }) => {
                assert!(
                    seen >= gap - scene.query.rounding(),
                    "{name}: {seen} < {gap}"
                );
            }
            // Within the distance at which the referee cannot exclude touching.
            (Expect::Free { gap }, Finding::Near { .. }) => assert!(*gap <= 2e-9, "{name}"),
            // Sliding at a small distance takes the referee more steps than its limit.
            (Expect::Free { gap }, Finding::Undecided { .. }) => assert!(*gap < 2e-6, "{name}"),
            // The contact grazes so briefly that intersection is not seen.
            (Expect::Hit { latest, .. }, Finding::Near { lo }) => {
                assert!(lo <= latest + 1e-12, "{name}: {lo} > {latest}");
            }
            (Expect::Overlap, Finding::Start) | (Expect::Unknown, _) => {}
            (Expect::Overlap, _) => assert!(referee.nested(0.0), "{name}: {finding:?}"),
            (_, finding) => panic!("{name}: {finding:?}"),
        }
    }
}

#[test]
fn the_screw_turns_freely_by_its_own_pitch_only() {
    for scene in scenes()
        .iter()
        .filter(|scene| scene.name.starts_with("T18"))
    {
        let finding = Referee::new(&scene.query).finding();
        let free = matches!(finding, Finding::Free { .. });
        assert_eq!(
            free,
            scene.name.contains("right"),
            "{}: {finding:?}",
            scene.name
        );
    }
}

#[test]
fn the_cuboids_in_the_distance_collide() {
    let scene = scenes()
        .into_iter()
        .find(|scene| scene.name.starts_with("T26"))
        .expect("T26");
    let finding = Referee::new(&scene.query).finding();
    assert!(matches!(finding, Finding::Hit { .. }), "{finding:?}");
}

#[test]
fn distances_of_boxes() {
    let gap = |offset: DVec3| {
        let query = Query {
            a: Actor::still(cuboid(DVec3::splat(0.5)), DVec3::ZERO),
            b: Actor::still(cuboid(DVec3::splat(0.5)), offset),
            duration: 1.0,
        };
        Referee::new(&query).gap(0.0)
    };
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-14, "{x} is not {y}");
    close(gap(3.0 * DVec3::X), 2.0);
    close(gap(DVec3::new(2.0, 2.0, 0.3)), 2.0_f64.sqrt());
    close(gap(DVec3::splat(2.0)), 3.0_f64.sqrt());
    close(gap(DVec3::new(0.7, 0.1, 0.2)), 0.0);
}

#[test]
fn winding_separates_inside_from_outside() {
    let Mesh { vertices, .. } = cuboid(DVec3::ONE).mesh;
    let mesh = cuboid(DVec3::ONE).mesh;
    for (p, inside) in [
        (DVec3::ZERO, true),
        (0.99 * DVec3::ONE, true),
        (1.01 * DVec3::X, false),
    ] {
        assert_eq!(contains(&mesh, &vertices, p), inside, "{p}");
    }
}
