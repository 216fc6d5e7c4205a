//! Scenes with exact answers, whose motions are screws.

use super::super::*;
use crate::method::rival::tests::samples::{
    constant_velocity_motion, cuboid, query, resting_motion,
};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::lesser;
use std::f64::consts::{FRAC_PI_4, PI};

/// The half length of the rod that rotates in these scenes.
const ROD_HALF_LENGTH: f64 = 2.0;
/// The half width of this rod.
const ROD_HALF_WIDTH: f64 = 0.05;

fn claim_for_query(
    a: &TriangleMesh,
    b: &TriangleMesh,
    tolerance: f64,
    query: &Motions,
) -> ContactClaim {
    Contact::new(a, b).answer(query, tolerance).claim
}

/// Asserts at three tolerances that a contact is not late, and early by at most the time to close 1.5 times the
/// tolerance.
fn assert_contact(meshes: [&TriangleMesh; 2], query: &Motions, exact: f64, speed: f64) {
    for tolerance in [1e-2, 1e-4, 1e-8] {
        let swapped = Motions {
            a: query.b,
            b: query.a,
            ..query.clone()
        };
        let claims = [
            claim_for_query(meshes[0], meshes[1], tolerance, query),
            claim_for_query(meshes[1], meshes[0], tolerance, &swapped),
        ];
        for claim in claims {
            let ContactClaim::Contact { time } = claim else {
                panic!("{claim:?} instead of {exact}")
            };
            let early = exact - time;
            assert!(
                (-1e-12..=1.5 * tolerance / speed).contains(&early),
                "{early} at {tolerance}"
            );
        }
    }
}

/// Returns the query of a body that falls from height 3 at speed 4 onto a body whose top is at height 0.
fn flat_fall_query() -> Motions {
    let down = -4.0 * DVec3::Z;
    let a = constant_velocity_motion(3.0 * DVec3::Z, DQuat::IDENTITY, down, DVec3::ZERO);
    query(a, resting_motion(-0.5 * DVec3::Z))
}

#[test]
fn a_cube_falls_flat_on_a_slab() {
    let query = flat_fall_query();
    let meshes = [&cuboid(0.5, 0.5, 0.5), &cuboid(3.0, 3.0, 0.5)];
    assert_contact(meshes, &query, 0.625, 4.0);
}

#[test]
fn a_corner_falls_on_a_slab() {
    // The diagonal of the cube points down.
    let upright = DQuat::from_rotation_arc(DVec3::ONE.normalize(), -DVec3::Z);
    let a = constant_velocity_motion(3.0 * DVec3::Z, upright, -4.0 * DVec3::Z, DVec3::ZERO);
    let query = query(a, resting_motion(-0.5 * DVec3::Z));
    let meshes = [&cuboid(0.5, 0.5, 0.5), &cuboid(3.0, 3.0, 0.5)];
    assert_contact(meshes, &query, (3.0 - 0.75f64.sqrt()) / 4.0, 4.0);
}

#[test]
fn two_edges_meet_across() {
    let about_x = DQuat::from_rotation_x(FRAC_PI_4);
    let a = constant_velocity_motion(3.0 * DVec3::Z, about_x, -4.0 * DVec3::Z, DVec3::ZERO);
    let b = constant_velocity_motion(
        DVec3::ZERO,
        DQuat::from_rotation_y(FRAC_PI_4),
        DVec3::ZERO,
        DVec3::ZERO,
    );
    let cube = cuboid(0.5, 0.5, 0.5);
    let exact = (3.0 - 2f64.sqrt()) / 4.0;
    assert_contact([&cube, &cube], &query(a, b), exact, 4.0);
}

#[test]
fn a_rod_turns_into_a_wall() {
    let radius = ROD_HALF_LENGTH.hypot(ROD_HALF_WIDTH);
    let rod = cuboid(ROD_HALF_WIDTH, 0.3, ROD_HALF_LENGTH);
    let wall = cuboid(0.5, 3.0, 3.0);
    for (turns, height) in [(1.0, 1.2), (1.9, 1.2), (2.0, 1.9), (7.0, 0.5)] {
        let spin = turns * PI;
        let a =
            constant_velocity_motion(DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO, spin * DVec3::Y);
        let query = query(a, resting_motion((height + 0.5) * DVec3::X));
        let angle = (height / radius).asin();
        let exact = (angle - ROD_HALF_WIDTH.atan2(ROD_HALF_LENGTH)) / spin;
        // The corner moves along its circle, with this part of its speed towards the wall.
        let speed = spin * radius * angle.cos();
        assert_contact(
            [&rod, &wall],
            &query,
            exact,
            speed * (radius / (radius + 1.0)),
        );
    }
}

#[test]
fn a_rod_turns_past_a_wall() {
    let radius = ROD_HALF_LENGTH.hypot(ROD_HALF_WIDTH);
    let (rod, wall) = (
        cuboid(ROD_HALF_WIDTH, 0.3, ROD_HALF_LENGTH),
        cuboid(0.5, 3.0, 3.0),
    );
    for (fraction, hits) in [(1.0 - 1e-3, true), (1.0 - 1e-6, true), (1.0 + 1e-3, false)] {
        let a = constant_velocity_motion(DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO, PI * DVec3::Y);
        let query = query(a, resting_motion((radius * fraction + 0.5) * DVec3::X));
        let exact = (lesser(1.0, fraction).asin() - ROD_HALF_WIDTH.atan2(ROD_HALF_LENGTH)) / PI;
        match claim_for_query(&rod, &wall, 1e-7, &query) {
            ContactClaim::Contact { time } => {
                assert!(
                    hits && time <= exact + 1e-9 && time > exact - 1e-3,
                    "{time} {exact}"
                );
            }
            claim => assert_eq!((claim, hits), (ContactClaim::NoContact, false)),
        }
    }
}

#[test]
fn parallel_edges_meet() {
    let (reach, polar) = (1.3, 1.0f64);
    let exact = (polar - f64::asin(ROD_HALF_WIDTH / reach)) / 1.5;
    let a = constant_velocity_motion(DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO, 1.5 * DVec3::Z);
    let (sin, cos) = polar.sin_cos();
    let edge = reach * DVec3::new(cos, sin, 0.0);
    let onward = DVec3::new(-sin, cos, 0.0);
    // The corner (−, −) of the post's square faces the rod.
    let half = 0.2;
    let post = constant_velocity_motion(
        edge + onward * (half * 2f64.sqrt()),
        DQuat::from_rotation_z(polar + FRAC_PI_4),
        DVec3::ZERO,
        DVec3::ZERO,
    );
    let meshes = [
        &cuboid(ROD_HALF_LENGTH, ROD_HALF_WIDTH, 0.1),
        &cuboid(half, half, 1.0),
    ];
    let speed = 1.5 * reach * (reach / (ROD_HALF_LENGTH + ROD_HALF_WIDTH + 0.1));
    assert_contact(meshes, &query(a, post), exact, speed);
}

#[test]
fn both_bodies_turn() {
    let radius = ROD_HALF_LENGTH.hypot(ROD_HALF_WIDTH);
    let rod = cuboid(ROD_HALF_WIDTH, 0.3, ROD_HALF_LENGTH);
    let spin = 2.0 * DVec3::Y;
    let a = constant_velocity_motion(DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO, spin);
    let b = constant_velocity_motion(3.0 * DVec3::X, DQuat::IDENTITY, DVec3::ZERO, -spin);
    let angle = (1.5 / radius).asin();
    let exact = (angle - ROD_HALF_WIDTH.atan2(ROD_HALF_LENGTH)) / 2.0;
    assert_contact(
        [&rod, &rod],
        &query(a, b),
        exact,
        2.0 * radius * angle.cos(),
    );
}

#[test]
fn surfaces_that_cross_at_the_start_touch_there() {
    let cube = cuboid(0.5, 0.5, 0.5);
    let a = constant_velocity_motion(0.9 * DVec3::Z, DQuat::IDENTITY, DVec3::Z, DVec3::Y);
    let claim = claim_for_query(&cube, &cube, 1e-3, &query(a, resting_motion(DVec3::ZERO)));
    assert_eq!(claim, ContactClaim::Contact { time: 0.0 });
}

#[test]
fn bodies_at_rest_are_free() {
    let cube = cuboid(0.5, 0.5, 0.5);
    let apart = query(
        resting_motion(1.001 * DVec3::Z),
        resting_motion(DVec3::ZERO),
    );
    assert_eq!(
        claim_for_query(&cube, &cube, 1e-3, &apart),
        ContactClaim::NoContact
    );
}

#[test]
fn work_is_limited() {
    let (cube, slab) = (cuboid(0.5, 0.5, 0.5), cuboid(3.0, 3.0, 0.5));
    let tilt = DQuat::from_scaled_axis(DVec3::new(0.5, 0.3, 0.2));
    let tilted: Vec<DVec3> = slab.vertices().iter().map(|&v| tilt * v).collect();
    let tilted = TriangleMesh::new(tilted, slab.faces()).unwrap();
    // The body slides over the slab at a distance of a millionth.
    let position = tilt * DVec3::new(0.0, 0.0, 1.0 + 1e-6);
    let slide = constant_velocity_motion(position, tilt, tilt * DVec3::X, DVec3::ZERO);
    let slide = query(slide, resting_motion(DVec3::ZERO));
    let fall = constant_velocity_motion(
        3.0 * DVec3::Z,
        DQuat::IDENTITY,
        -4.0 * DVec3::Z,
        DVec3::ZERO,
    );
    let fall = query(fall, resting_motion(-0.5 * DVec3::Z));
    let halvings = WorkLimit {
        max_steps: 1000,
        ..WORK_LIMIT
    };
    let pairs = WorkLimit {
        max_pairs: 5,
        ..WORK_LIMIT
    };
    for (limits, slab, query, end) in [(halvings, tilted, slide, 1.0), (pairs, slab, fall, 0.625)] {
        let mut contact = Contact::new(&cube, &slab);
        contact.work_limit = limits;
        let reply = contact.answer(&query, 1e-9);
        let ContactClaim::Unresolved { safe_until } = reply.claim else {
            panic!("{reply:?}")
        };
        assert!((0.0..=end).contains(&safe_until), "{safe_until}");
        assert!(reply.steps <= 1000, "{}", reply.steps);
    }
}

#[test]
fn invalid_tolerances_are_never_late() {
    let query = flat_fall_query();
    let (cube, slab) = (cuboid(0.5, 0.5, 0.5), cuboid(3.0, 3.0, 0.5));
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        match claim_for_query(&cube, &slab, tolerance, &query) {
            ContactClaim::Contact { time } => assert!(time <= 0.625 + 1e-12),
            ContactClaim::Unresolved { safe_until } => assert!(safe_until <= 0.625 + 1e-12),
            claim => panic!("{claim:?} at tolerance {tolerance}"),
        }
    }
}
